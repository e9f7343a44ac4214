/* Largest stable time step of each element.
 *
 * An element of stiffness k and damping c between points of mobility b (acceleration per force, all
 * points together) vibrates with w^2 = k b and 2 zeta w = c b. Zhai's explicit two-step scheme,
 * whose damping forces lag by a step, is stable for
 *
 *   w dt < 2 (sqrt(1 + 4 zeta^2) - 2 zeta)     that is     dt < 2 / (sqrt(k b + (c b)^2) + c b)
 *
 * Members that are connected to a body in pairs count twice in its mobility. Wheel and rail are
 * taken at four times the static load (ours).
 */
#include "base/error.h"
#include "laws/drag.h"
#include "model/fill.h"
#include "model/own_design.h"
#include "model/track_bound.h"

#include <stdio.h>

enum { BOUNDS_PER_CAR = 22 };

#define SHORTEST_STRUT 0.2               /* of a coupler, as a share of its length (ours) */
#define FOURFOLD_LOAD 2.5198420997897464 /* indentation at four times the load: 4^(2/3) */

/* A wheelset on the elastic track and its bound. */
typedef struct OnRails {
    double contact;  /* stiffness [N/m] */
    double wheelset; /* inverse mass [1/kg] */
    double primary;  /* stiffness [N/m] */
    double bound;    /* [s] */
} OnRails;

typedef struct Car {
    CzModel *model;
    const CzLanes *lanes;
    int car;
    const char *name;         /* of the car, or of the interface in front of it */
    OnRails *on_rails;        /* the last one */
    const CzParameters *rows; /* of its block */
    size_t i;                 /* its place there */
} Car;

/* Adds a bound to the sorted list, the smallest first. */
static void note_bound(CzModel *model, const char *what, const char *of, const char *where,
                       double value_of) {
    CzStepBound bound = {.bound = value_of};
    snprintf(bound.element, sizeof bound.element, "%s%s %s", what, of, where);
    int place = model->n_bound++;
    for (; place > 0 && model->bound[place - 1].bound > bound.bound; place--)
        model->bound[place] = model->bound[place - 1];
    model->bound[place] = bound;
}

static void note(const Car *car, const char *what, double stiffness, double damping,
                 double mobility) {
    if (!(mobility > 0.0) || stiffness >= CZ_NEVER || stiffness + damping <= 0.0)
        return;
    const double square = stiffness * mobility, rate = damping * mobility;
    note_bound(car->model, what, rate * rate > square ? " damper" : "", car->name,
               2.0 / (sqrt(square + rate * rate) + rate));
}

/* Steepest part of a curve. */
static double steepest(const Car *car, CzCurveId id) {
    const CzCurveLanes *curve = &car->lanes->curve[id];
    const size_t lane = (size_t)car->car;
    double largest = 0.0;
    for (int i = 0; i < curve->n_breakpoint; i++)
        largest =
            fmax(largest, cz_curve_slope(curve, lane, curve->at[(size_t)i * curve->stride + lane]));
    return largest;
}

/* A crush zone with its backbone. */
static double crush_stiffness(const Car *car, const CzCrushRows *crush, CzCurveId backbone) {
    return fmax(steepest(car, backbone),
                fmax(crush->unloading[car->i], crush->second_unloading[car->i]));
}

static double with_stops(const CzSuspensionRows *suspension, size_t i) {
    return suspension->stiffness[i] +
           fmax(suspension->bump_stiffness[i], suspension->lift_stiffness[i]);
}

static double point_mobility(const CzInverse *inverse, size_t i, double arm) {
    return inverse->mass[i] + arm * arm * inverse->inertia_pitch[i];
}

/* ---- one car ---- */

/* Equal cars share a bound, because finding it requires a search. */
static void note_elastic_track(const Car *car, double contact, double primary) {
    const double wheelset = car->rows->inverse.wheelset.mass[car->i];
    OnRails *last = car->on_rails;
    if (last->bound == 0.0 || last->contact != contact || last->wheelset != wheelset ||
        last->primary != primary)
        *last =
            (OnRails){contact, wheelset, primary,
                      cz_track_longest_step(car->model->track, 1.0 / contact, wheelset, primary)};
    note_bound(car->model, "wheel on elastic rail", "", car->name, last->bound);
}

static void note_wheels(const Car *car) {
    const CzParameters *rows = car->rows;
    const CzWheelRows *wheel = &rows->wheel;
    const size_t i = car->i;
    double indentation = 0.0;
    for (int axle = 0; axle < 4; axle++)
        indentation = fmax(indentation, wheel->indentation[axle][i]);
    const double contact = 1.5 * wheel->hertz[i] * sqrt(FOURFOLD_LOAD * indentation);
    const double primary = with_stops(&rows->primary, i);
    if (car->model->track == NULL)
        note(car, "wheel-rail contact", contact + primary, rows->primary.damping[i],
             rows->inverse.wheelset.mass[i]);
    else
        note_elastic_track(car, contact, primary);
    note(car, "creep", wheel->creep_stiffness[i], 0.0,
         point_mobility(&rows->inverse.wheelset, i, wheel->radius[i]));
    note(car, "brake", wheel->brake_stiffness[i], 0.0, rows->inverse.wheelset.inertia_pitch[i]);
    if (wheel->rolling_resistance[i] > 0.0)
        note_bound(car->model, "rolling resistance", "", car->name, CZ_DRAG_TIME);
}

/* Bound of the drag of a car without running gear. */
static void note_drag(const Car *car) {
    const CzDragRows *drag = &car->rows->drag;
    const size_t i = car->i;
    if (drag->brake[i] + drag->rolling[i] + drag->slide[i] > 0.0)
        note_bound(car->model, "drag of the track", "", car->name, CZ_DRAG_TIME);
    note(car, "end of the slide", drag->slide_stiffness[i], 0.0, car->rows->inverse.body.mass[i]);
}

/* `behind` is the body that carries the suspension in pairs, `arm` its distance from the middle. */
static void note_suspension(const Car *car, const char *what, const CzSuspensionRows *suspension,
                            double ahead, const CzInverse *behind, double arm) {
    const size_t i = car->i;
    note(car, what, with_stops(suspension, i),
         fmax(suspension->damping[i], suspension->damping_beyond[i]),
         ahead + 2.0 * fmax(behind->mass[i], arm * arm * behind->inertia_pitch[i]));
}

static void note_bogies(const Car *car) {
    const CzParameters *rows = car->rows;
    const CzInverse *bogie = &rows->inverse.bogie, *body = &rows->inverse.body;
    const size_t i = car->i;
    const double wheelset = rows->inverse.wheelset.mass[i];
    note_suspension(car, "primary suspension", &rows->primary, wheelset, bogie, rows->axle_x[i]);
    note_suspension(car, "secondary suspension", &rows->secondary, bogie->mass[i], body,
                    rows->bogie_x[i]);
    note(car, "traction link", rows->link.strut.stiffness[i], rows->link.strut.damping[i],
         point_mobility(bogie, i, rows->link.bogie_z[i]) +
             2.0 * point_mobility(body, i, rows->link.body_z[i]));
    note(car, "axle guidance", rows->axle_guidance.stiffness[i], rows->axle_guidance.damping[i],
         wheelset + 2.0 * point_mobility(bogie, i, rows->axle_z[i]));
}

static void note_end(const Car *car, int which) {
    static const char *const crush[] = {"crush zone rear end", "crush zone front end"};
    static const char *const guide[] = {"rear end guidance", "front end guidance"};
    static const char *const hinge[] = {"rear end hinge", "front end hinge"};
    const CzInverse *end = &car->rows->inverse.end[which], *body = &car->rows->inverse.body;
    const CzEndRows *rows = &car->rows->end[which];
    const size_t i = car->i;
    const double mass_z = rows->mass_z[i], body_z = rows->body_z[i], x = rows->x[i];
    note(car, crush[which], crush_stiffness(car, &rows->crush, CZ_CURVE(end[which])),
         rows->crush.damping[i],
         end->mass[i] + mass_z * mass_z * end->inertia_pitch[i] + body->mass[i] +
             body_z * body_z * body->inertia_pitch[i]);
    note(car, guide[which], rows->guide_vertical.stiffness[i], rows->guide_vertical.damping[i],
         end->mass[i] + body->mass[i] + x * x * body->inertia_pitch[i]);
    note(car, hinge[which], rows->fold_pitch.stiffness[i], rows->fold_pitch.damping[i],
         end->inertia_pitch[i] + body->inertia_pitch[i]);
}

/* ---- one interface; `car` is the one behind ---- */

/* Inverse mass and inertia of the bodies that carry a part of each side. */
typedef struct Carriers {
    struct {
        double inverse_mass, inverse_inertia;
    } side[2];
} Carriers;

static Carriers carriers_of(const Car *car, bool a_on_end, bool b_on_end) {
    const bool on_end[2] = {a_on_end, b_on_end};
    Carriers carriers;
    for (int side = CZ_SIDE_A; side <= CZ_SIDE_B; side++) {
        const CzLane own = cz_lane_at(car->lanes, (size_t)(car->car + side));
        const int end = side == CZ_SIDE_A ? CZ_FRONT : CZ_REAR;
        const CzInverse *inverse = on_end[side] && own.rows->slaved_ends[end][own.i] == 0.0
                                       ? &own.rows->inverse.end[end]
                                       : &own.rows->inverse.body;
        carriers.side[side].inverse_mass = inverse->mass[own.i];
        carriers.side[side].inverse_inertia = inverse->inertia_pitch[own.i];
    }
    return carriers;
}

/* Mobility of both carriers of a pair whose displacements act by `share` and pitches by `arm`. */
static double pair_mobility(const Carriers *carriers, double share, const double arm[2]) {
    double sum = 0.0;
    for (int side = CZ_SIDE_A; side <= CZ_SIDE_B; side++)
        sum += share * share * carriers->side[side].inverse_mass +
               arm[side] * arm[side] * carriers->side[side].inverse_inertia;
    return sum;
}

/* The same for two points, with their arms across the direction of the force. */
static double mobility(const Carriers *carriers, const CzRow arm[2], size_t i) {
    const double arms[2] = {arm[CZ_SIDE_A][i], arm[CZ_SIDE_B][i]};
    return pair_mobility(carriers, 1.0, arms);
}

/* Both sides of a chain in series with the compliance of its plastic members. */
static double chain_stiffness(const double side[2], double compliance) {
    const double sum = 1.0 / side[0] + 1.0 / side[1] + compliance;
    return sum > 1.0 / CZ_NEVER * 4.0 ? 1.0 / sum : CZ_NEVER;
}

static void note_faces(const Car *car) {
    const CzFaceRows *rows = &car->rows->face;
    const size_t i = car->i;
    const Carriers carriers = carriers_of(car, true, true);
    double stiffness[2];
    for (int side = CZ_SIDE_A; side <= CZ_SIDE_B; side++)
        stiffness[side] =
            rows->side[side].has_massless[i] == 0.0
                ? CZ_NEVER
                : crush_stiffness(car, &rows->side[side].massless, CZ_CURVE(massless[side]));
    note(car, "anti-climber", chain_stiffness(stiffness, rows->compliance[i]),
         rows->damping[i] +
             fmax(rows->side[0].massless.damping[i], rows->side[1].massless.damping[i]),
         mobility(&carriers, rows->contact.z, i));
    if (rows->rib_capacity[i] + rows->friction[i] > 0.0)
        note(car, "anti-climber ribs", rows->stiffness_vertical[i], 0.0,
             mobility(&carriers, rows->contact.x, i));
}

static void note_superstructures(const Car *car) {
    const CzSuperstructureRows *rows = &car->rows->superstructure;
    const Carriers carriers = carriers_of(car, true, true);
    if (rows->strength[car->i] > 0.0)
        note(car, "superstructure", rows->stiffness[car->i], 0.0,
             mobility(&carriers, rows->contact.z, car->i));
}

static void note_draw_gears(const Car *car) {
    const CzDrawGearRows *rows = &car->rows->draw_gear;
    const Carriers carriers = carriers_of(car, false, false);
    if (rows->slack[car->i] < CZ_MISSING)
        note(car, "draw gear", rows->stiffness[car->i], 0.0,
             mobility(&carriers, rows->contact.z, car->i));
}

/* Largest closing speed at which the hydraulic damping can act. */
static double closing_speed(const Car *car) {
    const CzCar *cars = car->model->car;
    const int front = car->model->colliding;
    return fmax(cars[front].speed - cars[front + 1].speed, 0.0);
}

/* Both members of a chain damp; the stiffer side may be held, so the stronger damper counts. The
 * rate at which hydraulic damping acts is no larger than the closing speed, nor than the rate that
 * the weakest plastic member of the chain allows: c2 rate^2 <= weakest. */
static double buffer_damping(const Car *car, const CzBufferRows *const buffer[2], double weakest) {
    double strongest = 0.0;
    for (int side = CZ_SIDE_A; side <= CZ_SIDE_B; side++) {
        const double quadratic = buffer[side]->quadratic[car->i];
        const double force = quadratic * closing_speed(car) * closing_speed(car);
        const double rate_slope = 2.0 * sqrt(quadratic * fmin(force, weakest));
        strongest = fmax(strongest, buffer[side]->damping[car->i] + rate_slope);
    }
    return strongest;
}

/* Length of the strut once all strokes are exhausted [m]. */
static double shortest_strut(const Car *car) {
    static const CzCurveId strokes[] = {CZ_CURVE(buffer[0]),      CZ_CURVE(buffer[1]),
                                        CZ_CURVE(tube[0]),        CZ_CURVE(tube[1]),
                                        CZ_CURVE(second_tube[0]), CZ_CURVE(second_tube[1])};
    const double full = car->rows->coupler.length[car->i];
    double length = full;
    for (size_t i = 0; i < sizeof strokes / sizeof strokes[0]; i++) {
        const double usable = car->lanes->curve[strokes[i]].usable[car->car];
        length -= usable < CZ_NEVER ? usable : 0.0;
    }
    return fmax(length, SHORTEST_STRUT * full);
}

/* Rotation of the strut against its carriers: (z_B - z_A) / l - pitch; of a line along the track,
 * -pitch. */
static void note_swing(const Car *car, const Carriers *carriers) {
    const CzCouplerRows *rows = &car->rows->coupler;
    const size_t i = car->i;
    const CzHingeRows *hinge_a = &rows->side[0].hinge_vertical,
                      *hinge_b = &rows->side[1].hinge_vertical;
    const double per_length = car->rows->tilts[i] > 0.0 ? 1.0 / shortest_strut(car) : 0.0;
    const double arm[2] = {rows->pivot.x[0][i] * per_length + 1.0,
                           rows->pivot.x[1][i] * per_length - 1.0};
    note(car, "swing stop",
         fmax(hinge_a->stop_stiffness[i], hinge_b->stop_stiffness[i]) +
             fmax(hinge_a->stiffness[i], hinge_b->stiffness[i]),
         0.0, 2.0 * pair_mobility(carriers, per_length, arm));
}

/* Largest force that the coupler's tubes and shear-offs transmit. */
static double weakest_member(const Car *car) {
    const CzCouplerRows *rows = &car->rows->coupler;
    const double tubes = car->model->interface_properties[car->car].tube_force;
    const double shear = fmin(rows->side[0].shear.force[car->i], rows->side[1].shear.force[car->i]);
    return isnan(tubes) ? shear : fmin(tubes, shear);
}

static void note_coupler(const Car *car) {
    const CzCouplerRows *rows = &car->rows->coupler;
    const CzBufferRows *const buffer[] = {&rows->side[0].buffer, &rows->side[1].buffer};
    const size_t i = car->i;
    double stiffness[2];
    if (rows->exists[i] == 0.0)
        return;
    const Carriers carriers =
        carriers_of(car, rows->side[0].on_end[i] > 0.0, rows->side[1].on_end[i] > 0.0);
    for (int side = CZ_SIDE_A; side <= CZ_SIDE_B; side++)
        stiffness[side] =
            fmax(fmax(steepest(car, CZ_CURVE(buffer[side])), buffer[side]->transition[i]),
                 buffer[side]->draw_stiffness[i]);
    note(car, "coupler buffer", chain_stiffness(stiffness, rows->compliance[i]),
         buffer_damping(car, buffer, weakest_member(car)), mobility(&carriers, rows->pivot.z, i));
    note_swing(car, &carriers);
}

static void note_side_buffers(const Car *car) {
    const CzSideBufferRows *rows = &car->rows->side_buffers;
    const CzBufferRows *const buffer[] = {&rows->side[0].buffer, &rows->side[1].buffer};
    const size_t i = car->i;
    double stiffness[2];
    if (rows->exists[i] == 0.0)
        return;
    const Carriers carriers = carriers_of(car, true, true);
    for (int side = CZ_SIDE_A; side <= CZ_SIDE_B; side++)
        stiffness[side] =
            fmax(steepest(car, CZ_CURVE(side_buffer[side])), buffer[side]->transition[i]);
    note(car, "side buffers", chain_stiffness(stiffness, rows->compliance[i]),
         buffer_damping(car, buffer, CZ_NEVER), mobility(&carriers, rows->contact.z, i));
}

CzStatus cz_model_find_bounds(CzModel *model, const CzLanes *lanes, CzError *error) {
    const size_t n = (size_t)model->n_car * BOUNDS_PER_CAR;
    model->bound = cz_arena_allocate(&model->arena, n, sizeof *model->bound);
    if (model->bound == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for %d cars", model->n_car);
    OnRails on_rails = {0};
    for (int i = 0; i < model->n_car; i++) {
        const CzLane at = cz_lane_at(lanes, (size_t)i);
        Car car = {model, lanes, i, model->car[i].name, &on_rails, at.rows, at.i};
        if (model->car[i].model == CZ_MODEL_FULL) {
            note_wheels(&car);
            note_bogies(&car);
        } else
            note_drag(&car);
        for (int end = CZ_REAR; end <= CZ_FRONT; end++)
            if (at.rows->slaved_ends[end][at.i] == 0.0)
                note_end(&car, end);
        if (i == model->n_car - 1)
            break;
        car.name = model->interface_name[i];
        note_faces(&car);
        note_superstructures(&car);
        note_draw_gears(&car);
        note_coupler(&car);
        note_side_buffers(&car);
    }
    return CZ_OK;
}
