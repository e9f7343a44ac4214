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

bool cz_contact_is_unfollowed(const CzPlace *place) {
    const CzScene *scene = place->scene;
    const CzVehicle *behind = &place->vehicles[scene->record[scene->colliding]];
    const CzVehicle *ahead = &place->vehicles[scene->record[scene->colliding + 1]];
    /* heights decide where a vehicle is full and none is fixed */
    if ((behind->model != CZ_MODEL_FULL && ahead->model != CZ_MODEL_FULL) ||
        behind->model == CZ_MODEL_FIXED || ahead->model == CZ_MODEL_FIXED)
        return false;
    const Facing facing[2] = {{&behind->front, &ahead->rear, scene->rise},
                              {&ahead->rear, &behind->front, -scene->rise}};
    const double *swing = place->run->interface[scene->colliding].swing;
    for (int side = 0; side < 2; side++)
        if (face_passes(&facing[side]) || may_pass_its_kind(&facing[side]) ||
            coupler_slides(&facing[side], swing[1 - side]))
            return true;
    return false;
}
