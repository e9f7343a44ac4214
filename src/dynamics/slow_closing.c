/* A load path is a row of members, each with a force over its stroke. Closed slowly, the weakest
 * deflects: of all members the one with the smallest force at its own stroke moves on, and the path
 * carries that force. The forces of parallel paths add up.
 */
#include "dynamics/slow_closing.h"

#include <math.h>

#include "laws/shear_off.h"

enum { MAX_MEMBERS = 8 };

typedef struct Member {
    CzCurveId curve;
    size_t lane;
    double stroke; /* so far [m] */
} Member;

typedef struct Path {
    const CzLanes *lanes;
    int n_member;
    Member member[MAX_MEMBERS];
    double starts_at; /* closure at which it touches [m] */
    CzShearOffLaw shear_off;
    double released_at; /* closure at which it began to shear; NaN before [m] */
} Path;

static double strength(const Path *path, const Member *member) {
    return cz_curve_value(&path->lanes->curve[member->curve], member->lane, member->stroke);
}

/* Adds a member unless it is rigid. */
static void add(Path *path, CzCurveId curve, size_t lane) {
    const Member member = {curve, lane, 1e-6};
    if (strength(path, &member) < 1e20 * member.stroke)
        path->member[path->n_member++] = (Member){curve, lane, 0.0};
}

static double advance(Path *path, double closure, double step) {
    if (path->n_member == 0 || closure < path->starts_at)
        return 0.0;
    if (!isnan(path->released_at))
        return cz_shear_off(&path->shear_off, closure - path->released_at).strength;
    Member *weakest = &path->member[0];
    for (int i = 1; i < path->n_member; i++)
        if (strength(path, &path->member[i]) < strength(path, weakest))
            weakest = &path->member[i];
    const double force = strength(path, weakest);
    if (force > path->shear_off.force) {
        path->released_at = closure;
        return path->shear_off.force;
    }
    weakest->stroke += step;
    return force;
}

/* The retraction space behind a shear-off is left out: another load path acts. */
static Path path_of(const CzLanes *lanes) {
    return (Path){
        .lanes = lanes, .released_at = NAN, .shear_off = {.force = INFINITY, .space = CZ_NEVER}};
}

static void add_end(Path *path, int interface, int side) {
    add(path, side == 0 ? CZ_CURVE(end[1]) : CZ_CURVE(end[0]), (size_t)(interface + side));
}

static Path coupler_path(const CzLanes *lanes, int interface) {
    Path path = path_of(lanes);
    const size_t lane = (size_t)interface;
    const CzLane at = cz_lane_at(lanes, lane);
    const CzCouplerRows *rows = &at.rows->coupler;
    if (rows->exists[at.i] < 0.5)
        return path;
    path.starts_at = rows->pivot.distance[at.i] - rows->length[at.i];
    for (int side = 0; side < 2; side++) {
        add(&path, CZ_CURVE(buffer[side]), lane);
        add(&path, CZ_CURVE(tube[side]), lane);
        add(&path, CZ_CURVE(second_tube[side]), lane);
        if (rows->side[side].on_end[at.i] > 0.5)
            add_end(&path, interface, side);
        const double force = rows->side[side].shear.force[at.i];
        const double softening = rows->side[side].shear.softening[at.i];
        CzShearOffLaw *weaker = &path.shear_off;
        if (force < weaker->force || (force == weaker->force && softening > weaker->softening)) {
            weaker->softening = softening; /* of the weaker one: that of a wall does not count */
            weaker->residual = rows->side[side].shear.residual[at.i];
        }
        weaker->force = fmin(weaker->force, force);
    }
    return path;
}

static bool has_end_mass(const CzLanes *lanes, int interface, int side) {
    const CzLane at = cz_lane_at(lanes, (size_t)(interface + side));
    return at.rows->slaved_ends[1 - side][at.i] < 0.5;
}

/* A path of two members on each side, and of the crush zones behind them. */
static Path contact_path(const CzLanes *lanes, int interface, double starts_at,
                         const CzCurveId member[4]) {
    Path path = path_of(lanes);
    path.starts_at = starts_at;
    for (int k = 0; k < 4; k++)
        add(&path, member[k], (size_t)interface);
    for (int side = 0; side < 2; side++)
        if (has_end_mass(lanes, interface, side))
            add_end(&path, interface, side);
    return path;
}

static Path face_path(const CzLanes *lanes, int interface) {
    static const CzCurveId member[] = {CZ_CURVE(face[0]), CZ_CURVE(massless[0]), CZ_CURVE(face[1]),
                                       CZ_CURVE(massless[1])};
    const CzLane at = cz_lane_at(lanes, (size_t)interface);
    return contact_path(lanes, interface, at.rows->face.contact.distance[at.i], member);
}

static Path side_path(const CzLanes *lanes, int interface) {
    static const CzCurveId member[] = {CZ_CURVE(side_buffer[0]), CZ_CURVE(side_tube[0]),
                                       CZ_CURVE(side_buffer[1]), CZ_CURVE(side_tube[1])};
    const CzLane at = cz_lane_at(lanes, (size_t)interface);
    if (at.rows->side_buffers.exists[at.i] < 0.5)
        return path_of(lanes);
    return contact_path(lanes, interface, at.rows->side_buffers.contact.distance[at.i], member);
}

void cz_slow_closing(const CzLanes *lanes, int interface, double longest, int n, double *closure,
                     double *force) {
    Path path[3] = {coupler_path(lanes, interface), face_path(lanes, interface),
                    side_path(lanes, interface)};
    const double step = longest / (n - 1);
    for (int i = 0; i < n; i++) {
        closure[i] = i * step;
        force[i] = 0.0;
        for (int k = 0; k < 3; k++)
            force[i] += advance(&path[k], closure[i], step);
    }
}
