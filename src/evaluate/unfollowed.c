/* Contacts of the colliding ends whose course the model does not follow. */
#include "evaluate/unfollowed.h"

#include <math.h>

#include "problem/meeting.h"

#define STEEL_ON_STEEL 0.15 /* friction where the end declares none (ours) */

/* An end of the colliding interface, and the other one, which is higher by `rise` [m]. */
typedef struct Facing {
    const CzEnd *end, *opposite;
    double rise;
} Facing;

static bool face_passes(const Facing *facing) {
    const CzMeets meets = cz_part_meets(facing->end, CZ_PART_FACE, facing->opposite, facing->rise);
    return facing->end->anti_climber.given && (meets == CZ_PASSES_OVER || meets == CZ_PASSES_UNDER);
}

static bool may_pass_its_kind(const Facing *facing) {
    return cz_parts_may_pass(facing->end, CZ_PART_COUPLER, facing->opposite, facing->rise) ||
           cz_parts_may_pass(facing->end, CZ_PART_SIDE_BUFFERS, facing->opposite, facing->rise);
}

/* The model holds a coupler to the place that it struck; beyond the friction of the struck end it
 * would slide. `swing` is the largest angle of its line against that end [rad]. */
static bool coupler_slides(const Facing *facing, double swing) {
    const double friction = facing->opposite->face_friction;
    const double slope = swing * (1.0 + swing * swing / 3.0); /* of a small angle */
    return cz_part_strikes(facing->end, CZ_PART_COUPLER, facing->opposite, facing->rise) &&
           slope > (isnan(friction) ? STEEL_ON_STEEL : friction);
}

/* The two ends that meet; false where heights decide nothing: between rigid vehicles, and at a
 * fixed one. */
static bool find_ends(const CzScene *scene, const CzVehicle *behind, const CzVehicle *ahead,
                      Facing facing[2]) {
    facing[0] = (Facing){&behind->front, &ahead->rear, scene->rise};
    facing[1] = (Facing){&ahead->rear, &behind->front, -scene->rise};
    return (behind->model == CZ_MODEL_FULL || ahead->model == CZ_MODEL_FULL) &&
           behind->model != CZ_MODEL_FIXED && ahead->model != CZ_MODEL_FIXED;
}

const char *cz_contact_unfollowed(const CzPlace *place) {
    const CzScene *scene = place->scene;
    Facing facing[2];
    if (!find_ends(scene, &place->vehicles[scene->record[scene->colliding]],
                   &place->vehicles[scene->record[scene->colliding + 1]], facing))
        return NULL;
    const double *swing = place->run->interface[scene->colliding].swing;
    for (int side = 0; side < 2; side++) {
        if (face_passes(&facing[side]))
            return "an anti-climber passes over or under the other end";
        if (may_pass_its_kind(&facing[side]))
            return "couplers or side buffers may pass each other, so far are they apart in height";
        if (coupler_slides(&facing[side], swing[1 - side]))
            return "a coupler pushes a bare end at an angle at which it would slide";
    }
    return NULL;
}

bool cz_contact_may_be_unfollowed(const CzScene *scene) {
    Facing facing[2];
    if (!find_ends(scene, scene->vehicle[scene->colliding], scene->vehicle[scene->colliding + 1],
                   facing))
        return false;
    for (int side = 0; side < 2; side++)
        if (face_passes(&facing[side]) || may_pass_its_kind(&facing[side]) ||
            cz_part_strikes(facing[side].end, CZ_PART_COUPLER, facing[side].opposite,
                            facing[side].rise))
            return true;
    return false;
}
