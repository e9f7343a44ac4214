/* Largest stable time step of each element.
 *
 * An element of stiffness k and damping c between points of mobility b (acceleration per force, all
 * points together) vibrates with w^2 = k b and 2 zeta w = c b. Zhai's explicit two-step scheme,
 * whose damping forces lag by a step, is stable for
 *
 *   w dt < 2 (sqrt(1 + 4 zeta^2) - 2 zeta)     that is     dt < 2 / (sqrt(k b + (c b)^2) + c b)
 *
 * Members that a body carries in pairs count twice in its mobility. Wheel and rail are taken at
 * four times the static load (ours).
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
    OnRails *on_rails; /* the last one */
} Car;

static double value(const Car *car, CzParameter parameter) {
    return cz_lane_value(car->lanes, car->car, parameter);
}

/* Keeps the list in order, the smallest first. */
static void note_bound(CzModel *model, const char *what, const char *of, const char *where,
                       double value_of) {
    CzStepBound bound = {.bound = value_of};
    snprintf(bound.element, sizeof bound.element, "%s%s %s", what, of, where);
    int place = model->n_bound++;
    for (; place > 0 && model->bound[place - 1].bound > bound.bound; place--)
        model->bound[place] = model->bound[place - 1];
    model->bound[place] = bound;
}

static void note(CzModel *model, const char *what, const char *where, double stiffness,
                 double damping, double mobility) {
    if (!(mobility > 0.0) || stiffness >= CZ_NEVER || stiffness + damping <= 0.0)
        return;
    const double square = stiffness * mobility, rate = damping * mobility;
    note_bound(model, what, rate * rate > square ? " damper" : "", where,
               2.0 / (sqrt(square + rate * rate) + rate));
}

/* Steepest part of a curve in one lane. */
static double steepest(const CzLanes *lanes, CzCurveId id, int lane) {
    const CzCurveLanes *curve = &lanes->curve[id];
    double largest = 0.0;
    for (int i = 0; i < curve->n_kink; i++) {
        const double x = curve->at[(size_t)i * lanes->stride + (size_t)lane];
        double slope = 0.0;
        for (int j = 0; j < curve->n_kink; j++) {
            const size_t slot = (size_t)j * lanes->stride + (size_t)lane;
            slope += curve->at[slot] <= x ? curve->slope_change[slot] : 0.0;
        }
        largest = fmax(largest, slope);
    }
    return largest;
}

/* ---- one car ---- */

/* Cars that are alike share a bound that is searched for. */
static void note_elastic_track(const Car *car, const char *name, double contact, double primary) {
    const double wheelset = value(car, CZ_P_INVERSE_WHEELSET_MASS);
    OnRails *last = car->on_rails;
    if (last->bound == 0.0 || last->contact != contact || last->wheelset != wheelset ||
        last->primary != primary)
        *last =
            (OnRails){contact, wheelset, primary,
                      cz_track_longest_step(car->model->track, 1.0 / contact, wheelset, primary)};
    note_bound(car->model, "wheel on elastic rail", "", name, last->bound);
}

static void note_wheels(const Car *car, const char *name) {
    const double wheelset = value(car, CZ_P_INVERSE_WHEELSET_MASS);
    const double spin = value(car, CZ_P_INVERSE_WHEELSET_INERTIA);
    const double radius = value(car, CZ_P_WHEEL_RADIUS);
    double indentation = 0.0;
    for (int axle = 0; axle < 4; axle++)
        indentation = fmax(indentation, value(car, (CzParameter)(CZ_P_INDENTATION_0 + axle)));
    const double contact = 1.5 * value(car, CZ_P_HERTZ) * sqrt(FOURFOLD_LOAD * indentation);
    const double stop =
        fmax(value(car, CZ_P_PRIMARY_BUMP_STIFFNESS), value(car, CZ_P_PRIMARY_LIFT_STIFFNESS));
    const double primary = value(car, CZ_P_PRIMARY_STIFFNESS) + stop;
    if (car->model->track == NULL)
        note(car->model, "wheel-rail contact", name, contact + primary,
             value(car, CZ_P_PRIMARY_DAMPING), wheelset);
    else
        note_elastic_track(car, name, contact, primary);
    note(car->model, "creep", name, value(car, CZ_P_CREEP_STIFFNESS), 0.0,
         wheelset + radius * radius * spin);
    note(car->model, "brake", name, value(car, CZ_P_BRAKE_STIFFNESS), 0.0, spin);
    if (value(car, CZ_P_ROLLING_RESISTANCE) > 0.0)
        note_bound(car->model, "rolling resistance", "", name, CZ_DRAG_TIME);
}

/* Of a car without running gear. */
static void note_drag(const Car *car, const char *name) {
    if (value(car, CZ_P_DRAG_BRAKE) + value(car, CZ_P_DRAG_ROLLING) + value(car, CZ_P_DRAG_SLIDE) >
        0.0)
        note_bound(car->model, "drag of the track", "", name, CZ_DRAG_TIME);
    note(car->model, "end of the slide", name, value(car, CZ_P_SLIDE_STIFFNESS), 0.0,
         value(car, CZ_P_INVERSE_BODY_MASS));
}

static void note_bogies(const Car *car, const char *name) {
    const double bogie = value(car, CZ_P_INVERSE_BOGIE_MASS);
    const double bogie_spin = value(car, CZ_P_INVERSE_BOGIE_INERTIA);
    const double body = value(car, CZ_P_INVERSE_BODY_MASS);
    const double body_spin = value(car, CZ_P_INVERSE_BODY_INERTIA);
    const double wheelset = value(car, CZ_P_INVERSE_WHEELSET_MASS);
    const double axle_x = value(car, CZ_P_AXLE_X), axle_z = value(car, CZ_P_AXLE_Z);
    const double bogie_x = value(car, CZ_P_BOGIE_X);
    const double link_body = value(car, CZ_P_LINK_BODY_Z);
    const double link_bogie = value(car, CZ_P_LINK_BOGIE_Z);

    const double primary_stop =
        fmax(value(car, CZ_P_PRIMARY_BUMP_STIFFNESS), value(car, CZ_P_PRIMARY_LIFT_STIFFNESS));
    note(car->model, "primary suspension", name, value(car, CZ_P_PRIMARY_STIFFNESS) + primary_stop,
         fmax(value(car, CZ_P_PRIMARY_DAMPING), value(car, CZ_P_PRIMARY_DAMPING_BEYOND)),
         wheelset + 2.0 * fmax(bogie, axle_x * axle_x * bogie_spin));
    const double secondary_stop =
        fmax(value(car, CZ_P_SECONDARY_BUMP_STIFFNESS), value(car, CZ_P_SECONDARY_LIFT_STIFFNESS));
    note(car->model, "secondary suspension", name,
         value(car, CZ_P_SECONDARY_STIFFNESS) + secondary_stop,
         fmax(value(car, CZ_P_SECONDARY_DAMPING), value(car, CZ_P_SECONDARY_DAMPING_BEYOND)),
         bogie + 2.0 * fmax(body, bogie_x * bogie_x * body_spin));
    note(car->model, "traction link", name, value(car, CZ_P_LINK_STIFFNESS),
         value(car, CZ_P_LINK_DAMPING),
         bogie + link_bogie * link_bogie * bogie_spin +
             2.0 * (body + link_body * link_body * body_spin));
    note(car->model, "axle guidance", name, value(car, CZ_P_AXLE_GUIDANCE_STIFFNESS),
         value(car, CZ_P_AXLE_GUIDANCE_DAMPING),
         wheelset + 2.0 * (bogie + axle_z * axle_z * bogie_spin));
}

static void note_end(const Car *car, const char *name, int which) {
    const double end = value(car, CZ_OF_END(CZ_P_INVERSE_END_MASS, which));
    const double end_spin = value(car, CZ_OF_END(CZ_P_INVERSE_END_INERTIA, which));
    const double body = value(car, CZ_P_INVERSE_BODY_MASS);
    const double body_spin = value(car, CZ_P_INVERSE_BODY_INERTIA);
    const double x = value(car, CZ_OF_END(CZ_P_END_X, which));
    const double body_z = value(car, CZ_OF_END(CZ_P_END_BODY_Z, which));
    const double mass_z = value(car, CZ_OF_END(CZ_P_END_MASS_Z, which));
    const bool is_rear = which == CZ_REAR;

    const double backbone = steepest(car->lanes, CZ_OF_END(CZ_CURVE_END, which), car->car);
    const double unloading = fmax(value(car, CZ_OF_END(CZ_P_END_UNLOADING, which)),
                                  value(car, CZ_OF_END(CZ_P_END_SECOND_UNLOADING, which)));
    note(car->model, is_rear ? "crush zone rear end" : "crush zone front end", name,
         fmax(backbone, unloading), value(car, CZ_OF_END(CZ_P_END_DAMPING, which)),
         end + mass_z * mass_z * end_spin + body + body_z * body_z * body_spin);
    note(car->model, is_rear ? "rear end guidance" : "front end guidance", name,
         value(car, CZ_OF_END(CZ_P_GUIDE_STIFFNESS, which)),
         value(car, CZ_OF_END(CZ_P_GUIDE_DAMPING, which)), end + body + x * x * body_spin);
    note(car->model, is_rear ? "rear end hinge" : "front end hinge", name,
         value(car, CZ_OF_END(CZ_P_FOLD_STIFFNESS, which)),
         value(car, CZ_OF_END(CZ_P_FOLD_DAMPING, which)), end_spin + body_spin);
}

/* ---- one interface; `car` is the one behind ---- */

/* Inverse mass and inertia of the body that carries a part of one side. */
typedef struct Carrier {
    double inverse_mass, inverse_inertia;
} Carrier;

static Carrier carrier_of(const Car *car, int side, bool on_end) {
    const Car own = {car->model, car->lanes, car->car + side, car->on_rails};
    const int which = side == CZ_SIDE_A ? CZ_FRONT : CZ_REAR;
    if (on_end && value(&own, CZ_P_SLAVED_ENDS) == 0.0)
        return (Carrier){value(&own, CZ_OF_END(CZ_P_INVERSE_END_MASS, which)),
                         value(&own, CZ_OF_END(CZ_P_INVERSE_END_INERTIA, which))};
    return (Carrier){value(&own, CZ_P_INVERSE_BODY_MASS), value(&own, CZ_P_INVERSE_BODY_INERTIA)};
}

/* Mobility of two points of arms a and b across the direction of the force. */
static double mobility(const Carrier carrier[2], double arm_a, double arm_b) {
    return carrier[0].inverse_mass + arm_a * arm_a * carrier[0].inverse_inertia +
           carrier[1].inverse_mass + arm_b * arm_b * carrier[1].inverse_inertia;
}

/* Both sides of a chain in series with the compliance of its plastic members. */
static double chain_stiffness(double a, double b, double compliance) {
    const double sum = 1.0 / a + 1.0 / b + compliance;
    return sum > 1.0 / CZ_NEVER * 4.0 ? 1.0 / sum : CZ_NEVER;
}

static double limp_stiffness(const Car *car, int side) {
    if (value(car, CZ_OF_SIDE(CZ_P_LIMP_END, side)) == 0.0)
        return CZ_NEVER;
    return fmax(steepest(car->lanes, CZ_OF_SIDE(CZ_CURVE_LIMP_END, side), car->car),
                fmax(value(car, CZ_OF_SIDE(CZ_P_LIMP_UNLOADING, side)),
                     value(car, CZ_OF_SIDE(CZ_P_LIMP_SECOND_UNLOADING, side))));
}

static void note_faces(const Car *car, const char *name) {
    const Carrier carrier[2] = {carrier_of(car, CZ_SIDE_A, true), carrier_of(car, CZ_SIDE_B, true)};
    note(car->model, "anti-climber", name,
         chain_stiffness(limp_stiffness(car, CZ_SIDE_A), limp_stiffness(car, CZ_SIDE_B),
                         value(car, CZ_P_FACE_COMPLIANCE)),
         value(car, CZ_P_FACE_DAMPING) +
             fmax(value(car, CZ_P_LIMP_DAMPING_A), value(car, CZ_P_LIMP_DAMPING_B)),
         mobility(carrier, value(car, CZ_P_FACE_Z_A), value(car, CZ_P_FACE_Z_B)));
    if (value(car, CZ_P_RIB_CAPACITY) + value(car, CZ_P_FACE_FRICTION) > 0.0)
        note(car->model, "anti-climber ribs", name, value(car, CZ_P_FACE_VERTICAL_STIFFNESS), 0.0,
             mobility(carrier, value(car, CZ_P_FACE_X_A), value(car, CZ_P_FACE_X_B)));
}

static void note_superstructures(const Car *car, const char *name) {
    const Carrier carrier[2] = {carrier_of(car, CZ_SIDE_A, true), carrier_of(car, CZ_SIDE_B, true)};
    if (value(car, CZ_P_SUPERSTRUCTURE_STRENGTH) > 0.0)
        note(car->model, "superstructure", name, value(car, CZ_P_SUPERSTRUCTURE_STIFFNESS), 0.0,
             mobility(carrier, value(car, CZ_P_SUPERSTRUCTURE_Z_A),
                      value(car, CZ_P_SUPERSTRUCTURE_Z_B)));
}

static double buffer_stiffness(const Car *car, CzCurveId curve, CzParameter transition) {
    return fmax(steepest(car->lanes, curve, car->car), value(car, transition));
}

/* Largest closing speed that the hydraulic damping can meet. */
static double closing_speed(const Car *car) {
    const CzCar *cars = car->model->car;
    const int front = car->model->colliding;
    return fmax(cars[front].speed - cars[front + 1].speed, 0.0);
}

/* Both members of a chain damp; the stiffer side may be held, so the stronger damper counts. The
 * rate at which hydraulic damping acts is no larger than the closing speed, nor than what the
 * weakest plastic member of the chain lets it be: c2 rate^2 <= weakest. */
static double buffer_damping(const Car *car, CzParameter linear_a, CzParameter quadratic_a,
                             double weakest) {
    double strongest = 0.0;
    for (int side = CZ_SIDE_A; side <= CZ_SIDE_B; side++) {
        const double linear = value(car, (CzParameter)(linear_a + side));
        const double quadratic = value(car, (CzParameter)(quadratic_a + side));
        const double force = quadratic * closing_speed(car) * closing_speed(car);
        const double rate_slope = 2.0 * sqrt(quadratic * fmin(force, weakest));
        strongest = fmax(strongest, linear + rate_slope);
    }
    return strongest;
}

/* Length of the strut once all strokes are used [m]. */
static double shortest_strut(const Car *car) {
    static const CzCurveId strokes[] = {CZ_CURVE_BUFFER_A,      CZ_CURVE_BUFFER_B,
                                        CZ_CURVE_TUBE_A,        CZ_CURVE_TUBE_B,
                                        CZ_CURVE_SECOND_TUBE_A, CZ_CURVE_SECOND_TUBE_B};
    const double full = value(car, CZ_P_COUPLER_LENGTH);
    double length = full;
    for (size_t i = 0; i < sizeof strokes / sizeof strokes[0]; i++) {
        const double usable = car->lanes->curve[strokes[i]].usable[car->car];
        length -= usable < CZ_NEVER ? usable : 0.0;
    }
    return fmax(length, SHORTEST_STRUT * full);
}

/* Rotation of the strut against its carriers: (z_B - z_A) / l - pitch; of a line along the track,
 * -pitch. */
static void note_swing(const Car *car, const char *name, const Carrier carrier[2]) {
    const double per_length = value(car, CZ_P_TILTS) > 0.0 ? 1.0 / shortest_strut(car) : 0.0;
    const double a = value(car, CZ_P_PIVOT_X_A) * per_length + 1.0;
    const double b = value(car, CZ_P_PIVOT_X_B) * per_length - 1.0;
    const double across =
        (carrier[0].inverse_mass + carrier[1].inverse_mass) * per_length * per_length +
        a * a * carrier[0].inverse_inertia + b * b * carrier[1].inverse_inertia;
    const double stop =
        fmax(value(car, CZ_P_SWING_STIFFNESS_A), value(car, CZ_P_SWING_STIFFNESS_B));
    const double hinge =
        fmax(value(car, CZ_P_HINGE_STIFFNESS_A), value(car, CZ_P_HINGE_STIFFNESS_B));
    note(car->model, "swing stop", name, stop + hinge, 0.0, 2.0 * across);
}

/* Force that the coupler's tubes and shear-offs let through. */
static double weakest_member(const Car *car) {
    const double tubes = car->model->interface_facts[car->car].tube_force;
    const double shear = fmin(value(car, CZ_P_SHEAR_FORCE_A), value(car, CZ_P_SHEAR_FORCE_B));
    return isnan(tubes) ? shear : fmin(tubes, shear);
}

static void note_coupler(const Car *car, const char *name) {
    if (value(car, CZ_P_COUPLER) == 0.0)
        return;
    const Carrier carrier[2] = {
        carrier_of(car, CZ_SIDE_A, value(car, CZ_P_COUPLER_ON_END_A) > 0.0),
        carrier_of(car, CZ_SIDE_B, value(car, CZ_P_COUPLER_ON_END_B) > 0.0)};
    const double a = fmax(buffer_stiffness(car, CZ_CURVE_BUFFER_A, CZ_P_BUFFER_TRANSITION_A),
                          value(car, CZ_P_BUFFER_DRAW_STIFFNESS_A));
    const double b = fmax(buffer_stiffness(car, CZ_CURVE_BUFFER_B, CZ_P_BUFFER_TRANSITION_B),
                          value(car, CZ_P_BUFFER_DRAW_STIFFNESS_B));
    note(car->model, "coupler buffer", name,
         chain_stiffness(a, b, value(car, CZ_P_COUPLER_COMPLIANCE)),
         buffer_damping(car, CZ_P_BUFFER_DAMPING_A, CZ_P_BUFFER_QUADRATIC_A, weakest_member(car)),
         mobility(carrier, value(car, CZ_P_PIVOT_Z_A), value(car, CZ_P_PIVOT_Z_B)));
    note_swing(car, name, carrier);
}

static void note_side_buffers(const Car *car, const char *name) {
    if (value(car, CZ_P_SIDE_BUFFERS) == 0.0)
        return;
    const Carrier carrier[2] = {carrier_of(car, CZ_SIDE_A, true), carrier_of(car, CZ_SIDE_B, true)};
    const double a = buffer_stiffness(car, CZ_CURVE_SIDE_BUFFER_A, CZ_P_SIDE_TRANSITION_A);
    const double b = buffer_stiffness(car, CZ_CURVE_SIDE_BUFFER_B, CZ_P_SIDE_TRANSITION_B);
    note(car->model, "side buffers", name, chain_stiffness(a, b, value(car, CZ_P_SIDE_COMPLIANCE)),
         buffer_damping(car, CZ_P_SIDE_DAMPING_A, CZ_P_SIDE_QUADRATIC_A, CZ_NEVER),
         mobility(carrier, value(car, CZ_P_SIDE_Z_A), value(car, CZ_P_SIDE_Z_B)));
}

CzStatus cz_model_find_bounds(CzModel *model, const CzLanes *lanes, CzError *error) {
    const size_t n = (size_t)model->n_car * BOUNDS_PER_CAR;
    model->bound = cz_arena_allocate(&model->arena, n, sizeof *model->bound);
    if (model->bound == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for %d cars", model->n_car);
    OnRails on_rails = {0};
    for (int i = 0; i < model->n_car; i++) {
        const Car car = {model, lanes, i, &on_rails};
        const char *name = model->car[i].name;
        if (model->car[i].model == CZ_MODEL_FULL) {
            note_wheels(&car, name);
            note_bogies(&car, name);
            note_end(&car, name, CZ_REAR);
            note_end(&car, name, CZ_FRONT);
        } else
            note_drag(&car, name);
        if (i == model->n_car - 1)
            break;
        note_faces(&car, model->interface_name[i]);
        note_superstructures(&car, model->interface_name[i]);
        note_coupler(&car, model->interface_name[i]);
        note_side_buffers(&car, model->interface_name[i]);
    }
    return CZ_OK;
}
