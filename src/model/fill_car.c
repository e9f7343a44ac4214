/* Parameters of one car: inertia, crush zones, running gear, wheels and rails, start velocities.
 *
 *   Hertz constant of a wheelset (two wheels):   H = 2 G^-1.5            N = H d^1.5
 *     G = 3.86 R^-0.115 1e-8 (worn), 4.57 R^-0.149 1e-8 (conical) [m/N^(2/3)]   Zhai, Vehicle-Track
 *     Coupled Dynamics
 *   static indentation:                          d = (N_0 / H)^(2/3)
 */
#include "model/fill.h"

#include "base/error.h"

#define LOCKED_FREQUENCY 600.0    /* of a locked end guidance [rad/s] (ours) */
#define GUIDE_DAMPING 0.1         /* damping ratio of the end guidance (ours) */
#define HELD_AXLE_FREQUENCY 300.0 /* of a braked wheelset in torsion [rad/s] (ours) */
#define CONTACT_LENGTH 0.006      /* that removes tangential deflection by rolling [m] (ours) */

/* base^exponent for 0 <= exponent < 1 from square roots alone: the same bits on every machine. */
static double power(double base, double exponent) {
    double result = 1.0, root = base;
    for (int bit = 0; bit < 53; bit++) {
        root = sqrt(root);
        exponent *= 2.0;
        if (exponent >= 1.0) {
            result *= root;
            exponent -= 1.0;
        }
    }
    return result;
}

static double hertz_constant(double radius, int tread) {
    const double g =
        tread == CZ_TREAD_CONICAL ? 4.57e-8 / power(radius, 0.149) : 3.86e-8 / power(radius, 0.115);
    return 2.0 / (g * sqrt(g));
}

static double inverse(double value) {
    return value > 0.0 ? 1.0 / value : 0.0;
}

/* A car of a design: its rows, and its place in them. */
typedef struct Car {
    const CzFill *fill;
    int car;
    const CzCar *place;
    const CzVehicle *vehicle;
    const CzStatics *statics;
    CzLaneBlock *block;
    CzParameters *rows; /* of the block */
    size_t i;
} Car;

/* Mass and start velocity of a body that moves in all directions of the plane. */
static void put_plane(const Car *car, CzPlane *masses, CzPlane *velocity, double mass,
                      double inertia) {
    masses->x[car->i] = masses->z[car->i] = mass;
    masses->pitch[car->i] = inertia;
    velocity->x[car->i] = car->place->speed;
    velocity->z[car->i] = velocity->pitch[car->i] = 0.0;
}

/* ---- crush zones ---- */

void cz_fill_crush(CzCrushRows *rows, size_t i, const CzEnd *end) {
    rows->unloading[i] = end->unloading_stiffness;
    rows->share[i] = end->unloading_share;
    rows->second_unloading[i] = cz_second_unloading(end);
    rows->damping[i] = end->damping;
}

/* Guidance of an end mass across the crush zone, and against pitching. */
static void fill_guidance(CzEndRows *rows, size_t i, const CzEnd *end, double mass) {
    const bool z_locked = end->vertical == CZ_GUIDANCE_LOCKED;
    const bool pitch_locked = end->pitch == CZ_GUIDANCE_LOCKED;
    const double square = LOCKED_FREQUENCY * LOCKED_FREQUENCY;
    const double guide = z_locked ? mass * square : end->vertical_stiffness;
    const double fold = pitch_locked ? end->pitch_inertia * square : end->pitch_stiffness;
    rows->guide_vertical.stiffness[i] = guide;
    rows->guide_vertical.damping[i] = 2.0 * GUIDE_DAMPING * sqrt(guide * mass);
    rows->fold_pitch.stiffness[i] = fold;
    rows->fold_pitch.damping[i] =
        pitch_locked ? 2.0 * GUIDE_DAMPING * sqrt(fold * end->pitch_inertia) : end->pitch_damping;
    rows->fold_pitch.moment[i] = pitch_locked ? CZ_NEVER : end->hinge_moment;
}

/* Crush zone between body and end mass. */
static CzStatus fill_zone(const Car *car, int which, double mass) {
    const CzEnd *end = cz_end_of(car->vehicle, which);
    const CzCurveId backbone = CZ_CURVE(end[which]);
    CzEndRows *rows = &car->rows->end[which];
    const size_t i = car->i;
    car->rows->inverse.end[which].mass[i] = 1.0 / mass;
    car->rows->slaved_ends[which][i] = 0.0;
    CZ_TRY(cz_fill_end(car->fill, (CzPartName){car->car, which, car->car, "end"}, end, backbone));
    cz_fill_crush(&rows->crush, i, end);
    rows->crush.tension[i] =
        cz_curve_slope(&car->fill->lanes->curve[backbone], cz_fill_lane(car->fill, car->car), 0.0);
    return CZ_OK;
}

static CzStatus fill_crush_zone(const Car *car, int which) {
    const CzEnd *end = cz_end_of(car->vehicle, which);
    CzEndRows *rows = &car->rows->end[which];
    const size_t i = car->i;
    car->rows->inverse.end[which].inertia_pitch[i] = inverse(end->pitch_inertia);
    put_plane(car, &car->block->mass.end[which], &car->block->velocity.end[which], end->mass,
              end->pitch_inertia);
    rows->x[i] = which == CZ_REAR ? -end->distance : end->distance;
    rows->body_z[i] = end->crush_height - car->vehicle->cg_height;
    rows->mass_z[i] = end->crush_height - end->cg_height;
    fill_guidance(rows, i, end, end->mass);
    return fill_zone(car, which, end->mass);
}

/* Crush zone of a rigid car in front of which its end has a mass, which moves along the track. */
static CzStatus fill_rigid_zone(const Car *car, int which) {
    const double mass = cz_fill_end_mass(car->fill, car->car, which);
    if (mass == 0.0)
        return CZ_OK;
    car->fill->lanes->has.full_cars = 1;
    car->block->mass.end[which].x[car->i] = mass;
    return fill_zone(car, which, mass);
}

/* ---- running gear ---- */

/* Rate at which the relief valve of a damper opens [m/s]. */
static double blow_off_rate(const CzSuspension *suspension) {
    if (isnan(suspension->blow_off) || suspension->damping == 0.0)
        return CZ_NEVER;
    return suspension->blow_off / suspension->damping;
}

static double gap_or_never(double gap) {
    return isnan(gap) ? CZ_NEVER : gap;
}

static void fill_suspension(CzSuspensionRows *rows, size_t i, const CzSuspension *suspension) {
    rows->stiffness[i] = suspension->stiffness;
    rows->damping[i] = suspension->damping;
    rows->blow_off_rate[i] = blow_off_rate(suspension);
    rows->damping_beyond[i] = suspension->damping_beyond;
    rows->bump_gap[i] = gap_or_never(suspension->bump_gap);
    rows->bump_stiffness[i] = suspension->bump_stiffness;
    rows->lift_gap[i] = gap_or_never(suspension->lift_gap);
    rows->lift_stiffness[i] = suspension->lift_stiffness;
}

static void fill_bogies(const Car *car) {
    const CzVehicle *vehicle = car->vehicle;
    const CzBogie *bogie = &vehicle->bogie;
    CzParameters *rows = car->rows;
    const size_t i = car->i;
    rows->inverse.bogie.mass[i] = 1.0 / bogie->mass;
    rows->inverse.bogie.inertia_pitch[i] = 1.0 / bogie->pitch_inertia;
    rows->bogie_x[i] = vehicle->bogie_spacing / 2.0;
    rows->link.body_z[i] = bogie->link.height - vehicle->cg_height;
    rows->link.bogie_z[i] = bogie->link.height - bogie->cg_height;
    rows->link.strut.stiffness[i] = bogie->link.stiffness;
    rows->link.strut.damping[i] = bogie->link.damping;
    rows->axle_x[i] = bogie->axle_spacing / 2.0;
    rows->axle_z[i] = bogie->wheel_radius - bogie->cg_height;
    rows->axle_guidance.stiffness[i] = bogie->guidance_stiffness;
    rows->axle_guidance.damping[i] = bogie->guidance_damping;
    fill_suspension(&rows->secondary, i, &bogie->secondary);
    fill_suspension(&rows->primary, i, &bogie->primary);
    for (int k = 0; k < 2; k++) {
        put_plane(car, &car->block->mass.bogie[k], &car->block->velocity.bogie[k], bogie->mass,
                  bogie->pitch_inertia);
        rows->secondary_preload[k][i] =
            bogie->secondary.carries_tension ? CZ_NEVER : car->statics->secondary_load[k];
    }
    for (int axle = 0; axle < 4; axle++)
        rows->primary_preload[axle][i] =
            bogie->primary.carries_tension ? CZ_NEVER : car->statics->primary_load[axle];
}

typedef struct {
    double peak, sliding;
} Friction;

/* With a peak friction of the scenario the ratio of sliding friction to peak is unchanged. */
static Friction friction_of(const CzModel *model) {
    const CzAdhesion *adhesion = &model->simulation->adhesion;
    const bool falls = !isnan(adhesion->sliding_friction) && adhesion->friction > 0.0;
    const double left = falls ? adhesion->sliding_friction / adhesion->friction : 1.0;
    return (Friction){model->friction, model->friction * left};
}

/* Axles are braked from the front of the car; the last one has the rest of the share. */
static double braked_part(const CzBrake *brake, int axle) {
    const double n_braked = brake == NULL ? 0.0 : 4.0 * brake->axle_share;
    return fmin(fmax(n_braked - (3 - axle), 0.0), 1.0);
}

static void fill_wheelset(const Car *car, int axle) {
    const CzBogie *bogie = &car->vehicle->bogie;
    CzWheelset *mass = &car->block->mass.wheelset[axle];
    CzWheelset *velocity = &car->block->velocity.wheelset[axle];
    CzWheelRows *rows = &car->rows->wheel;
    const double load = car->statics->wheel_load[axle], radius = bogie->wheel_radius;
    const size_t i = car->i;
    const double indentation = cbrt(load / rows->hertz[i]);
    rows->indentation[axle][i] = indentation * indentation;
    rows->brake_moment[axle][i] =
        braked_part(car->place->brake, axle) * (car->place->brake_ratio * load * radius);
    mass->x[i] = mass->z[i] = bogie->wheelset_mass;
    mass->spin[i] = bogie->wheelset_inertia;
    velocity->x[i] = car->place->speed;
    velocity->z[i] = 0.0;
    velocity->spin[i] = car->place->speed / radius;
}

static void fill_wheels(const Car *car) {
    const CzBogie *bogie = &car->vehicle->bogie;
    const CzModel *model = car->fill->model;
    const CzAdhesion *adhesion = &model->simulation->adhesion;
    const Friction friction = friction_of(model);
    CzWheelRows *rows = &car->rows->wheel;
    const size_t i = car->i;
    double load = 0.0;
    car->rows->inverse.wheelset.mass[i] = 1.0 / bogie->wheelset_mass;
    car->rows->inverse.wheelset.inertia_pitch[i] = 1.0 / bogie->wheelset_inertia;
    rows->radius[i] = bogie->wheel_radius;
    rows->hertz[i] = hertz_constant(bogie->wheel_radius, bogie->tread);
    for (int axle = 0; axle < 4; axle++) {
        fill_wheelset(car, axle);
        load += car->statics->wheel_load[axle] / 4.0;
    }
    rows->brake_stiffness[i] = bogie->wheelset_inertia * HELD_AXLE_FREQUENCY * HELD_AXLE_FREQUENCY;
    rows->creep_stiffness[i] = friction.peak * load / (adhesion->peak_creepage * CONTACT_LENGTH);
    rows->creep_length[i] = CONTACT_LENGTH;
    rows->friction_peak[i] = friction.peak;
    rows->friction_sliding[i] = friction.sliding;
    rows->friction_fall_speed[i] = adhesion->fall_speed;
    rows->rolling_resistance[i] = car->vehicle->rolling_resistance;
    car->fill->lanes->has.rolling |= car->vehicle->rolling_resistance > 0.0;
}

/* ---- cars without running gear ---- */

/* Brakes that require more than the peak friction lock the wheels. */
static void fill_drag(const Car *car) {
    const CzModel *model = car->fill->model;
    const CzBrake *brake = car->place->brake;
    CzDragRows *rows = &car->rows->drag;
    const Friction friction = friction_of(model);
    const double weight = car->statics->weight, brake_ratio = car->place->brake_ratio;
    const double braked = brake == NULL ? 0.0 : brake->axle_share * weight;
    const double ratio = fmin(brake_ratio, friction.peak);
    const bool locks = brake_ratio > friction.peak;
    rows->brake[car->i] = ratio * braked;
    rows->brake_sliding[car->i] = (locks ? friction.sliding : ratio) * braked;
    rows->rolling[car->i] = car->vehicle->rolling_resistance * weight;
    car->rows->wheel.friction_fall_speed[car->i] = model->simulation->adhesion.fall_speed;
    car->fill->lanes->has.drag |= rows->brake[car->i] + rows->rolling[car->i] > 0.0;
}

static void fill_slide(const Car *car) {
    const CzSlide *slide = cz_slide_of(car->vehicle);
    CzDragRows *rows = &car->rows->drag;
    if (slide == NULL)
        return;
    rows->slide[car->i] = slide->force;
    rows->slide_length[car->i] = slide->length;
    rows->slide_stiffness[car->i] = slide->bottom_stiffness;
    car->fill->lanes->has.drag = 1;
}

CzStatus cz_fill_car(const CzFill *fill, int number, const CzStatics *statics) {
    const size_t lane = cz_fill_lane(fill, number), i = lane % CZ_LANE_BLOCK;
    CzLaneBlock *block = cz_lane_block(fill->lanes, lane);
    const Car car = {.fill = fill,
                     .car = number,
                     .place = &fill->model->car[number],
                     .vehicle = cz_fill_vehicle(fill, number),
                     .statics = statics,
                     .block = block,
                     .rows = &block->parameter,
                     .i = i};
    block->parameter.inverse.body.mass[i] = inverse(statics->body_mass);
    block->parameter.inverse.body.inertia_pitch[i] = inverse(statics->body_inertia);
    block->mass.body.x[i] = statics->body_mass;
    block->velocity.body.x[i] = block->velocity.end[0].x[i] = block->velocity.end[1].x[i] =
        car.place->speed;
    if (car.place->model == CZ_MODEL_FULL) {
        fill->lanes->has.full_cars = 1;
        block->parameter.rises[i] = 1.0;
        put_plane(&car, &block->mass.body, &block->velocity.body, statics->body_mass,
                  statics->body_inertia);
        CZ_TRY(fill_crush_zone(&car, CZ_REAR));
        CZ_TRY(fill_crush_zone(&car, CZ_FRONT));
        fill_bogies(&car);
        fill_wheels(&car);
    } else if (car.place->model == CZ_MODEL_RIGID) {
        fill_drag(&car);
        CZ_TRY(fill_rigid_zone(&car, CZ_REAR));
        CZ_TRY(fill_rigid_zone(&car, CZ_FRONT));
    } else
        fill_slide(&car);
    return CZ_OK;
}
