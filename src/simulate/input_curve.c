/* A load path is a row of members, each with a force over its stroke. Closed slowly, the weakest
 * gives way: of all members the one with the smallest force at its own stroke moves on, and the
 * path carries that force. Paths side by side add up.
 */
#include "simulate/input_curve.h"

#include <math.h>

#include "base/error.h"
#include "dynamics/stored.h"
#include "model/own_design.h"

enum { MOST_MEMBERS = 8 };

typedef struct Member {
    CzCurveId curve;
    size_t lane;
    double stroke; /* so far [m] */
} Member;

typedef struct Path {
    const CzLanes *lanes;
    int n_member;
    Member member[MOST_MEMBERS];
    double starts_at; /* closure at which it touches [m] */
    double shear_off; /* force that lets it go [N] */
    double residual;  /* force that it keeps then [N] */
    double softening; /* closure over which it falls to that [m] */
    double let_go;    /* closure at which it began to; NaN before */
} Path;

static double strength(const Path *path, const Member *member) {
    return cz_curve_value(&path->lanes->curve[member->curve], path->lanes->stride, member->lane,
                          member->stroke);
}

/* Adds a member unless it is one that never gives way. */
static void add(Path *path, CzCurveId curve, size_t lane) {
    const Member member = {curve, lane, 1e-6};
    if (strength(path, &member) < 1e20 * member.stroke)
        path->member[path->n_member++] = (Member){curve, lane, 0.0};
}

static double advance(Path *path, double closure, double step) {
    if (path->n_member == 0 || closure < path->starts_at)
        return 0.0;
    if (!isnan(path->let_go)) {
        const double left = 1.0 - (closure - path->let_go) / path->softening;
        return path->residual + fmax(left, 0.0) * (path->shear_off - path->residual);
    }
    Member *weakest = &path->member[0];
    for (int i = 1; i < path->n_member; i++)
        if (strength(path, &path->member[i]) < strength(path, weakest))
            weakest = &path->member[i];
    const double force = strength(path, weakest);
    if (force > path->shear_off) {
        path->let_go = closure;
        return path->shear_off;
    }
    weakest->stroke += step;
    return force;
}

static Path coupler_path(const CzLanes *lanes, int interface) {
    Path path = {.lanes = lanes, .let_go = NAN, .shear_off = INFINITY};
    const size_t lane = (size_t)interface;
    if (cz_lane_value(lanes, interface, CZ_PARAMETER(coupler.exists)) < 0.5)
        return path;
    path.starts_at = cz_lane_value(lanes, interface, CZ_PARAMETER(coupler.pivot.distance)) -
                     cz_lane_value(lanes, interface, CZ_PARAMETER(coupler.length));
    for (int side = 0; side < 2; side++) {
        const int car = interface + side;
        add(&path, CZ_CURVE(buffer[side]), lane);
        add(&path, CZ_CURVE(tube[side]), lane);
        add(&path, CZ_CURVE(second_tube[side]), lane);
        if (cz_lane_value(lanes, interface, CZ_PARAMETER(coupler.side[side].on_end)) > 0.5)
            add(&path, side == 0 ? CZ_CURVE(end[1]) : CZ_CURVE(end[0]), (size_t)car);
        const double force =
            cz_lane_value(lanes, interface, CZ_PARAMETER(coupler.side[side].shear.force));
        const double softening =
            cz_lane_value(lanes, interface, CZ_PARAMETER(coupler.side[side].shear.softening));
        if (force < path.shear_off || (force == path.shear_off && softening > path.softening)) {
            path.softening = softening; /* of the weaker one: a wall has none that counts */
            path.residual =
                cz_lane_value(lanes, interface, CZ_PARAMETER(coupler.side[side].shear.residual));
        }
        path.shear_off = fmin(path.shear_off, force);
    }
    return path;
}

/* Crush zones that stand behind what presses on the end of a car. */
static void add_ends(Path *path, const CzModel *model, int interface) {
    for (int side = 0; side < 2; side++) {
        const int car = interface + side;
        if (model->car[car].model == CZ_MODEL_FULL)
            add(path, side == 0 ? CZ_CURVE(end[1]) : CZ_CURVE(end[0]), (size_t)car);
    }
}

static Path face_path(const CzModel *model, const CzLanes *lanes, int interface) {
    Path path = {.lanes = lanes, .let_go = NAN, .shear_off = INFINITY};
    path.starts_at = cz_lane_value(lanes, interface, CZ_PARAMETER(face.contact.distance));
    for (int side = 0; side < 2; side++) {
        add(&path, CZ_CURVE(face[side]), (size_t)interface);
        add(&path, CZ_CURVE(massless[side]), (size_t)interface);
    }
    add_ends(&path, model, interface);
    return path;
}

static Path side_path(const CzModel *model, const CzLanes *lanes, int interface) {
    Path path = {.lanes = lanes, .let_go = NAN, .shear_off = INFINITY};
    if (cz_lane_value(lanes, interface, CZ_PARAMETER(side_buffers.exists)) < 0.5)
        return path;
    path.starts_at = cz_lane_value(lanes, interface, CZ_PARAMETER(side_buffers.contact.distance));
    for (int side = 0; side < 2; side++) {
        add(&path, CZ_CURVE(side_buffer[side]), (size_t)interface);
        add(&path, CZ_CURVE(side_tube[side]), (size_t)interface);
    }
    add_ends(&path, model, interface);
    return path;
}

CzStatus cz_input_curve(const CzModel *model, int interface, double longest, int n, double *closure,
                        double *force, CzError *error) {
    CzArena arena = {0};
    CzLanes *lanes = cz_lanes_create(model, 1, &arena);
    int n_vehicle;
    CzStatus status = lanes == NULL
                          ? cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the input curve")
                          : cz_model_fill(model, cz_problem_vehicles(model->problem, &n_vehicle), 0,
                                          lanes, error);
    if (status == CZ_OK) {
        Path path[3] = {coupler_path(lanes, interface), face_path(model, lanes, interface),
                        side_path(model, lanes, interface)};
        const double step = longest / (n - 1);
        for (int i = 0; i < n; i++) {
            closure[i] = i * step;
            force[i] = 0.0;
            for (int k = 0; k < 3; k++)
                force[i] += advance(&path[k], closure[i], step);
        }
    }
    cz_arena_free(&arena);
    return status;
}
