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
    const double wheelset = value(car, CZ_PARAMETER(inverse.wheelset.mass));
    OnRails *last = car->on_rails;
    if (last->bound == 0.0 || last->contact != contact || last->wheelset != wheelset ||
        last->primary != primary)
        *last =
            (OnRails){contact, wheelset, primary,
                      cz_track_longest_step(car->model->track, 1.0 / contact, wheelset, primary)};
    note_bound(car->model, "wheel on elastic rail", "", name, last->bound);
}

static void note_wheels(const Car *car, const char *name) {
    const double wheelset = value(car, CZ_PARAMETER(inverse.wheelset.mass));
    const double spin = value(car, CZ_PARAMETER(inverse.wheelset.inertia_pitch));
    const double radius = value(car, CZ_PARAMETER(wheel.radius));
    double indentation = 0.0;
    for (int axle = 0; axle < 4; axle++)
        indentation = fmax(indentation, value(car, CZ_PARAMETER(wheel.indentation[axle])));
    const double contact =
        1.5 * value(car, CZ_PARAMETER(wheel.hertz)) * sqrt(FOURFOLD_LOAD * indentation);
    const double stop = fmax(value(car, CZ_PARAMETER(primary.bump_stiffness)),
                             value(car, CZ_PARAMETER(primary.lift_stiffness)));
    const double primary = value(car, CZ_PARAMETER(primary.stiffness)) + stop;
    if (car->model->track == NULL)
        note(car->model, "wheel-rail contact", name, contact + primary,
             value(car, CZ_PARAMETER(primary.damping)), wheelset);
    else
        note_elastic_track(car, name, contact, primary);
    note(car->model, "creep", name, value(car, CZ_PARAMETER(wheel.creep_stiffness)), 0.0,
         wheelset + radius * radius * spin);
    note(car->model, "brake", name, value(car, CZ_PARAMETER(wheel.brake_stiffness)), 0.0, spin);
    if (value(car, CZ_PARAMETER(wheel.rolling_resistance)) > 0.0)
        note_bound(car->model, "rolling resistance", "", name, CZ_DRAG_TIME);
}

/* Of a car without running gear. */
static void note_drag(const Car *car, const char *name) {
    if (value(car, CZ_PARAMETER(drag.brake)) + value(car, CZ_PARAMETER(drag.rolling)) +
            value(car, CZ_PARAMETER(drag.slide)) >
        0.0)
        note_bound(car->model, "drag of the track", "", name, CZ_DRAG_TIME);
    note(car->model, "end of the slide", name, value(car, CZ_PARAMETER(drag.slide_stiffness)), 0.0,
         value(car, CZ_PARAMETER(inverse.body.mass)));
}

static void note_bogies(const Car *car, const char *name) {
    const double bogie = value(car, CZ_PARAMETER(inverse.bogie.mass));
    const double bogie_spin = value(car, CZ_PARAMETER(inverse.bogie.inertia_pitch));
    const double body = value(car, CZ_PARAMETER(inverse.body.mass));
    const double body_spin = value(car, CZ_PARAMETER(inverse.body.inertia_pitch));
    const double wheelset = value(car, CZ_PARAMETER(inverse.wheelset.mass));
    const double axle_x = value(car, CZ_PARAMETER(axle_x)),
                 axle_z = value(car, CZ_PARAMETER(axle_z));
    const double bogie_x = value(car, CZ_PARAMETER(bogie_x));
    const double link_body = value(car, CZ_PARAMETER(link.body_z));
    const double link_bogie = value(car, CZ_PARAMETER(link.bogie_z));

    const double primary_stop = fmax(value(car, CZ_PARAMETER(primary.bump_stiffness)),
                                     value(car, CZ_PARAMETER(primary.lift_stiffness)));
    note(car->model, "primary suspension", name,
         value(car, CZ_PARAMETER(primary.stiffness)) + primary_stop,
         fmax(value(car, CZ_PARAMETER(primary.damping)),
              value(car, CZ_PARAMETER(primary.damping_beyond))),
         wheelset + 2.0 * fmax(bogie, axle_x * axle_x * bogie_spin));
    const double secondary_stop = fmax(value(car, CZ_PARAMETER(secondary.bump_stiffness)),
                                       value(car, CZ_PARAMETER(secondary.lift_stiffness)));
    note(car->model, "secondary suspension", name,
         value(car, CZ_PARAMETER(secondary.stiffness)) + secondary_stop,
         fmax(value(car, CZ_PARAMETER(secondary.damping)),
              value(car, CZ_PARAMETER(secondary.damping_beyond))),
         bogie + 2.0 * fmax(body, bogie_x * bogie_x * body_spin));
    note(car->model, "traction link", name, value(car, CZ_PARAMETER(link.strut.stiffness)),
         value(car, CZ_PARAMETER(link.strut.damping)),
         bogie + link_bogie * link_bogie * bogie_spin +
             2.0 * (body + link_body * link_body * body_spin));
    note(car->model, "axle guidance", name, value(car, CZ_PARAMETER(axle_guidance.stiffness)),
         value(car, CZ_PARAMETER(axle_guidance.damping)),
         wheelset + 2.0 * (bogie + axle_z * axle_z * bogie_spin));
}

static void note_end(const Car *car, const char *name, int which) {
    const double end = value(car, CZ_PARAMETER(inverse.end[which].mass));
    const double end_spin = value(car, CZ_PARAMETER(inverse.end[which].inertia_pitch));
    const double body = value(car, CZ_PARAMETER(inverse.body.mass));
    const double body_spin = value(car, CZ_PARAMETER(inverse.body.inertia_pitch));
    const double x = value(car, CZ_PARAMETER(end[which].x));
    const double body_z = value(car, CZ_PARAMETER(end[which].body_z));
    const double mass_z = value(car, CZ_PARAMETER(end[which].mass_z));
    const bool is_rear = which == CZ_REAR;

    const double backbone = steepest(car->lanes, CZ_CURVE(end[which]), car->car);
    const double unloading = fmax(value(car, CZ_PARAMETER(end[which].crush.unloading)),
                                  value(car, CZ_PARAMETER(end[which].crush.second_unloading)));
    note(car->model, is_rear ? "crush zone rear end" : "crush zone front end", name,
         fmax(backbone, unloading), value(car, CZ_PARAMETER(end[which].crush.damping)),
         end + mass_z * mass_z * end_spin + body + body_z * body_z * body_spin);
    note(car->model, is_rear ? "rear end guidance" : "front end guidance", name,
         value(car, CZ_PARAMETER(end[which].guide_vertical.stiffness)),
         value(car, CZ_PARAMETER(end[which].guide_vertical.damping)),
         end + body + x * x * body_spin);
    note(car->model, is_rear ? "rear end hinge" : "front end hinge", name,
         value(car, CZ_PARAMETER(end[which].fold_pitch.stiffness)),
         value(car, CZ_PARAMETER(end[which].fold_pitch.damping)), end_spin + body_spin);
}

/* ---- one interface; `car` is the one behind ---- */

/* Inverse mass and inertia of the body that carries a part of one side. */
typedef struct Carrier {
    double inverse_mass, inverse_inertia;
} Carrier;

static Carrier carrier_of(const Car *car, int side, bool on_end) {
    const Car own = {car->model, car->lanes, car->car + side, car->on_rails};
    const int which = side == CZ_SIDE_A ? CZ_FRONT : CZ_REAR;
    if (on_end && value(&own, CZ_PARAMETER(slaved_ends)) == 0.0)
        return (Carrier){value(&own, CZ_PARAMETER(inverse.end[which].mass)),
                         value(&own, CZ_PARAMETER(inverse.end[which].inertia_pitch))};
    return (Carrier){value(&own, CZ_PARAMETER(inverse.body.mass)),
                     value(&own, CZ_PARAMETER(inverse.body.inertia_pitch))};
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

static double massless_stiffness(const Car *car, int side) {
    if (value(car, CZ_PARAMETER(face.side[side].has_massless)) == 0.0)
        return CZ_NEVER;
    return fmax(steepest(car->lanes, CZ_CURVE(massless[side]), car->car),
                fmax(value(car, CZ_PARAMETER(face.side[side].massless.unloading)),
                     value(car, CZ_PARAMETER(face.side[side].massless.second_unloading))));
}

static void note_faces(const Car *car, const char *name) {
    const Carrier carrier[2] = {carrier_of(car, CZ_SIDE_A, true), carrier_of(car, CZ_SIDE_B, true)};
    note(car->model, "anti-climber", name,
         chain_stiffness(massless_stiffness(car, CZ_SIDE_A), massless_stiffness(car, CZ_SIDE_B),
                         value(car, CZ_PARAMETER(face.compliance))),
         value(car, CZ_PARAMETER(face.damping)) +
             fmax(value(car, CZ_PARAMETER(face.side[0].massless.damping)),
                  value(car, CZ_PARAMETER(face.side[1].massless.damping))),
         mobility(carrier, value(car, CZ_PARAMETER(face.contact.z[0])),
                  value(car, CZ_PARAMETER(face.contact.z[1]))));
    if (value(car, CZ_PARAMETER(face.rib_capacity)) + value(car, CZ_PARAMETER(face.friction)) > 0.0)
        note(car->model, "anti-climber ribs", name,
             value(car, CZ_PARAMETER(face.stiffness_vertical)), 0.0,
             mobility(carrier, value(car, CZ_PARAMETER(face.contact.x[0])),
                      value(car, CZ_PARAMETER(face.contact.x[1]))));
}

static void note_superstructures(const Car *car, const char *name) {
    const Carrier carrier[2] = {carrier_of(car, CZ_SIDE_A, true), carrier_of(car, CZ_SIDE_B, true)};
    if (value(car, CZ_PARAMETER(superstructure.strength)) > 0.0)
        note(car->model, "superstructure", name, value(car, CZ_PARAMETER(superstructure.stiffness)),
             0.0,
             mobility(carrier, value(car, CZ_PARAMETER(superstructure.contact.z[0])),
                      value(car, CZ_PARAMETER(superstructure.contact.z[1]))));
}

static void note_draw_gears(const Car *car, const char *name) {
    const Carrier carrier[2] = {carrier_of(car, CZ_SIDE_A, false),
                                carrier_of(car, CZ_SIDE_B, false)};
    if (value(car, CZ_PARAMETER(draw_gear.slack)) < CZ_MISSING)
        note(car->model, "draw gear", name, value(car, CZ_PARAMETER(draw_gear.stiffness)), 0.0,
             mobility(carrier, value(car, CZ_PARAMETER(draw_gear.contact.z[0])),
                      value(car, CZ_PARAMETER(draw_gear.contact.z[1]))));
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
static double buffer_damping(const Car *car, const CzParameter linear_of[2],
                             const CzParameter quadratic_of[2], double weakest) {
    double strongest = 0.0;
    for (int side = CZ_SIDE_A; side <= CZ_SIDE_B; side++) {
        const double linear = value(car, linear_of[side]);
        const double quadratic = value(car, quadratic_of[side]);
        const double force = quadratic * closing_speed(car) * closing_speed(car);
        const double rate_slope = 2.0 * sqrt(quadratic * fmin(force, weakest));
        strongest = fmax(strongest, linear + rate_slope);
    }
    return strongest;
}

/* Length of the strut once all strokes are used [m]. */
static double shortest_strut(const Car *car) {
    static const CzCurveId strokes[] = {CZ_CURVE(buffer[0]),      CZ_CURVE(buffer[1]),
                                        CZ_CURVE(tube[0]),        CZ_CURVE(tube[1]),
                                        CZ_CURVE(second_tube[0]), CZ_CURVE(second_tube[1])};
    const double full = value(car, CZ_PARAMETER(coupler.length));
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
    const double per_length =
        value(car, CZ_PARAMETER(tilts)) > 0.0 ? 1.0 / shortest_strut(car) : 0.0;
    const double a = value(car, CZ_PARAMETER(coupler.pivot.x[0])) * per_length + 1.0;
    const double b = value(car, CZ_PARAMETER(coupler.pivot.x[1])) * per_length - 1.0;
    const double across =
        (carrier[0].inverse_mass + carrier[1].inverse_mass) * per_length * per_length +
        a * a * carrier[0].inverse_inertia + b * b * carrier[1].inverse_inertia;
    const double stop =
        fmax(value(car, CZ_PARAMETER(coupler.side[0].hinge_vertical.stop_stiffness)),
             value(car, CZ_PARAMETER(coupler.side[1].hinge_vertical.stop_stiffness)));
    const double hinge = fmax(value(car, CZ_PARAMETER(coupler.side[0].hinge_vertical.stiffness)),
                              value(car, CZ_PARAMETER(coupler.side[1].hinge_vertical.stiffness)));
    note(car->model, "swing stop", name, stop + hinge, 0.0, 2.0 * across);
}

/* Force that the coupler's tubes and shear-offs let through. */
static double weakest_member(const Car *car) {
    const double tubes = car->model->interface_properties[car->car].tube_force;
    const double shear = fmin(value(car, CZ_PARAMETER(coupler.side[0].shear.force)),
                              value(car, CZ_PARAMETER(coupler.side[1].shear.force)));
    return isnan(tubes) ? shear : fmin(tubes, shear);
}

static void note_coupler(const Car *car, const char *name) {
    static const CzParameter damping[] = {CZ_PARAMETER(coupler.side[0].buffer.damping),
                                          CZ_PARAMETER(coupler.side[1].buffer.damping)};
    static const CzParameter quadratic[] = {CZ_PARAMETER(coupler.side[0].buffer.quadratic),
                                            CZ_PARAMETER(coupler.side[1].buffer.quadratic)};
    if (value(car, CZ_PARAMETER(coupler.exists)) == 0.0)
        return;
    const Carrier carrier[2] = {
        carrier_of(car, CZ_SIDE_A, value(car, CZ_PARAMETER(coupler.side[0].on_end)) > 0.0),
        carrier_of(car, CZ_SIDE_B, value(car, CZ_PARAMETER(coupler.side[1].on_end)) > 0.0)};
    const double a = fmax(
        buffer_stiffness(car, CZ_CURVE(buffer[0]), CZ_PARAMETER(coupler.side[0].buffer.transition)),
        value(car, CZ_PARAMETER(coupler.side[0].buffer.draw_stiffness)));
    const double b = fmax(
        buffer_stiffness(car, CZ_CURVE(buffer[1]), CZ_PARAMETER(coupler.side[1].buffer.transition)),
        value(car, CZ_PARAMETER(coupler.side[1].buffer.draw_stiffness)));
    note(car->model, "coupler buffer", name,
         chain_stiffness(a, b, value(car, CZ_PARAMETER(coupler.compliance))),
         buffer_damping(car, damping, quadratic, weakest_member(car)),
         mobility(carrier, value(car, CZ_PARAMETER(coupler.pivot.z[0])),
                  value(car, CZ_PARAMETER(coupler.pivot.z[1]))));
    note_swing(car, name, carrier);
}

static void note_side_buffers(const Car *car, const char *name) {
    static const CzParameter damping[] = {CZ_PARAMETER(side_buffers.side[0].buffer.damping),
                                          CZ_PARAMETER(side_buffers.side[1].buffer.damping)};
    static const CzParameter quadratic[] = {CZ_PARAMETER(side_buffers.side[0].buffer.quadratic),
                                            CZ_PARAMETER(side_buffers.side[1].buffer.quadratic)};
    if (value(car, CZ_PARAMETER(side_buffers.exists)) == 0.0)
        return;
    const Carrier carrier[2] = {carrier_of(car, CZ_SIDE_A, true), carrier_of(car, CZ_SIDE_B, true)};
    const double a = buffer_stiffness(car, CZ_CURVE(side_buffer[0]),
                                      CZ_PARAMETER(side_buffers.side[0].buffer.transition));
    const double b = buffer_stiffness(car, CZ_CURVE(side_buffer[1]),
                                      CZ_PARAMETER(side_buffers.side[1].buffer.transition));
    note(car->model, "side buffers", name,
         chain_stiffness(a, b, value(car, CZ_PARAMETER(side_buffers.compliance))),
         buffer_damping(car, damping, quadratic, CZ_NEVER),
         mobility(carrier, value(car, CZ_PARAMETER(side_buffers.contact.z[0])),
                  value(car, CZ_PARAMETER(side_buffers.contact.z[1]))));
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
        note_draw_gears(&car, model->interface_name[i]);
        note_coupler(&car, model->interface_name[i]);
        note_side_buffers(&car, model->interface_name[i]);
    }
    return CZ_OK;
}
