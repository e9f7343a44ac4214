/* Numbers of one car: inertia, crush zones, running gear, wheels and rails, start velocities.
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
#define HELD_AXLE_FREQUENCY 300.0 /* of a held wheelset in torsion [rad/s] (ours) */
#define CONTACT_LENGTH 0.006      /* that carries tangential deflection away [m] (ours) */

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

static void put_dof(const CzFill *fill, int car, int dof, double mass, double velocity) {
    const size_t lane = cz_fill_lane(fill, car);
    *cz_lane_mass(fill->lanes, dof, lane) = mass;
    *cz_lane_velocity(fill->lanes, dof, lane) = velocity;
}

/* ---- crush zones ---- */

static CzStatus fill_crush_zone(const CzFill *fill, int car, int which) {
    const CzVehicle *vehicle = cz_fill_vehicle(fill, car);
    const CzEnd *end = cz_end_of(vehicle, which);
    const double speed = fill->model->car[car].speed;
    const bool is_rear = which == CZ_REAR;

    cz_put(fill, car, CZ_PARAMETER(inverse.end[which].mass), 1.0 / end->mass);
    cz_put(fill, car, CZ_PARAMETER(inverse.end[which].inertia_pitch), inverse(end->pitch_inertia));
    cz_put(fill, car, CZ_PARAMETER(end[which].x), is_rear ? -end->distance : end->distance);
    cz_put(fill, car, CZ_PARAMETER(end[which].body_z), end->crush_height - vehicle->cg_height);
    cz_put(fill, car, CZ_PARAMETER(end[which].mass_z), end->crush_height - end->cg_height);
    put_dof(fill, car, CZ_DOF(end[which].x), end->mass, speed);
    put_dof(fill, car, CZ_DOF(end[which].z), end->mass, 0.0);
    put_dof(fill, car, CZ_DOF(end[which].pitch), end->pitch_inertia, 0.0);

    /* Along the car. */
    CZ_TRY(cz_fill_end(fill, (CzPartName){car, which, car, "end"}, end, CZ_CURVE(end[which])));
    const CzCurveLanes *curve = &fill->lanes->curve[CZ_CURVE(end[which])];
    const size_t lane = cz_fill_lane(fill, car);
    double first_slope = 0.0;
    for (int i = 0; i < curve->n_kink; i++) {
        const size_t slot = (size_t)i * fill->lanes->stride + lane;
        first_slope += curve->at[slot] == 0.0 ? curve->slope_change[slot] : 0.0;
    }
    cz_put(fill, car, CZ_PARAMETER(end[which].crush.unloading), end->unloading_stiffness);
    cz_put(fill, car, CZ_PARAMETER(end[which].crush.share), end->unloading_share);
    cz_put(fill, car, CZ_PARAMETER(end[which].crush.second_unloading), cz_second_unloading(end));
    cz_put(fill, car, CZ_PARAMETER(end[which].crush.damping), end->damping);
    cz_put(fill, car, CZ_PARAMETER(end[which].crush.tension), first_slope);

    /* Across it. */
    const bool z_locked = end->vertical == CZ_GUIDANCE_LOCKED;
    const bool pitch_locked = end->pitch == CZ_GUIDANCE_LOCKED;
    const double square = LOCKED_FREQUENCY * LOCKED_FREQUENCY;
    const double guide = z_locked ? end->mass * square : end->vertical_stiffness;
    const double fold = pitch_locked ? end->pitch_inertia * square : end->pitch_stiffness;
    const double fold_damping =
        pitch_locked ? 2.0 * GUIDE_DAMPING * sqrt(fold * end->pitch_inertia) : end->pitch_damping;
    cz_put(fill, car, CZ_PARAMETER(end[which].guide_vertical.stiffness), guide);
    cz_put(fill, car, CZ_PARAMETER(end[which].guide_vertical.damping),
           2.0 * GUIDE_DAMPING * sqrt(guide * end->mass));
    cz_put(fill, car, CZ_PARAMETER(end[which].fold_pitch.stiffness), fold);
    cz_put(fill, car, CZ_PARAMETER(end[which].fold_pitch.damping), fold_damping);
    cz_put(fill, car, CZ_PARAMETER(end[which].fold_pitch.moment),
           pitch_locked ? CZ_NEVER : end->hinge_moment);
    return CZ_OK;
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

static void fill_suspensions(const CzFill *fill, int car, const CzBogie *bogie,
                             const CzStatics *statics) {
    const CzSuspension *secondary = &bogie->secondary, *primary = &bogie->primary;
    cz_put(fill, car, CZ_PARAMETER(secondary.stiffness), secondary->stiffness);
    cz_put(fill, car, CZ_PARAMETER(secondary_preload[0]),
           secondary->carries_tension ? CZ_NEVER : statics->secondary_load[CZ_REAR]);
    cz_put(fill, car, CZ_PARAMETER(secondary_preload[1]),
           secondary->carries_tension ? CZ_NEVER : statics->secondary_load[CZ_FRONT]);
    cz_put(fill, car, CZ_PARAMETER(secondary.damping), secondary->damping);
    cz_put(fill, car, CZ_PARAMETER(secondary.blow_off_rate), blow_off_rate(secondary));
    cz_put(fill, car, CZ_PARAMETER(secondary.damping_beyond), secondary->damping_beyond);
    cz_put(fill, car, CZ_PARAMETER(secondary.bump_gap), gap_or_never(secondary->bump_gap));
    cz_put(fill, car, CZ_PARAMETER(secondary.bump_stiffness), secondary->bump_stiffness);
    cz_put(fill, car, CZ_PARAMETER(secondary.lift_gap), gap_or_never(secondary->lift_gap));
    cz_put(fill, car, CZ_PARAMETER(secondary.lift_stiffness), secondary->lift_stiffness);

    cz_put(fill, car, CZ_PARAMETER(primary.stiffness), primary->stiffness);
    for (int axle = 0; axle < 4; axle++)
        cz_put(fill, car, CZ_PARAMETER(primary_preload[axle]),
               primary->carries_tension ? CZ_NEVER : statics->primary_load[axle]);
    cz_put(fill, car, CZ_PARAMETER(primary.damping), primary->damping);
    cz_put(fill, car, CZ_PARAMETER(primary.blow_off_rate), blow_off_rate(primary));
    cz_put(fill, car, CZ_PARAMETER(primary.damping_beyond), primary->damping_beyond);
    cz_put(fill, car, CZ_PARAMETER(primary.bump_gap), gap_or_never(primary->bump_gap));
    cz_put(fill, car, CZ_PARAMETER(primary.bump_stiffness), primary->bump_stiffness);
    cz_put(fill, car, CZ_PARAMETER(primary.lift_gap), gap_or_never(primary->lift_gap));
    cz_put(fill, car, CZ_PARAMETER(primary.lift_stiffness), primary->lift_stiffness);
}

static void fill_bogies(const CzFill *fill, int car) {
    const CzVehicle *vehicle = cz_fill_vehicle(fill, car);
    const CzBogie *bogie = &vehicle->bogie;
    const double speed = fill->model->car[car].speed;
    cz_put(fill, car, CZ_PARAMETER(inverse.bogie.mass), 1.0 / bogie->mass);
    cz_put(fill, car, CZ_PARAMETER(inverse.bogie.inertia_pitch), 1.0 / bogie->pitch_inertia);
    cz_put(fill, car, CZ_PARAMETER(bogie_x), vehicle->bogie_spacing / 2.0);
    cz_put(fill, car, CZ_PARAMETER(link.body_z), bogie->link.height - vehicle->cg_height);
    cz_put(fill, car, CZ_PARAMETER(link.bogie_z), bogie->link.height - bogie->cg_height);
    cz_put(fill, car, CZ_PARAMETER(link.strut.stiffness), bogie->link.stiffness);
    cz_put(fill, car, CZ_PARAMETER(link.strut.damping), bogie->link.damping);
    cz_put(fill, car, CZ_PARAMETER(axle_x), bogie->axle_spacing / 2.0);
    cz_put(fill, car, CZ_PARAMETER(axle_z), bogie->wheel_radius - bogie->cg_height);
    cz_put(fill, car, CZ_PARAMETER(axle_guidance.stiffness), bogie->guidance_stiffness);
    cz_put(fill, car, CZ_PARAMETER(axle_guidance.damping), bogie->guidance_damping);
    for (int dof = CZ_DOF(bogie[0].x); dof <= CZ_DOF(bogie[1].pitch); dof += 3) {
        put_dof(fill, car, dof, bogie->mass, speed);
        put_dof(fill, car, (int)(dof + 1), bogie->mass, 0.0);
        put_dof(fill, car, (int)(dof + 2), bogie->pitch_inertia, 0.0);
    }
}

typedef struct {
    double peak, sliding;
} Friction;

/* A scenario's own peak keeps the share that is left in sliding. */
static Friction friction_of(const CzModel *model) {
    const CzAdhesion *adhesion = &model->simulation->adhesion;
    const bool falls = !isnan(adhesion->sliding_friction) && adhesion->friction > 0.0;
    const double left = falls ? adhesion->sliding_friction / adhesion->friction : 1.0;
    return (Friction){model->friction, model->friction * left};
}

/* Axles are braked from the front of the car on, the last one by what is left of the share. */
static double braked_part(const CzBrake *brake, int axle) {
    const double n_braked = brake == NULL ? 0.0 : 4.0 * brake->axle_share;
    return fmin(fmax(n_braked - (3 - axle), 0.0), 1.0);
}

static void fill_wheels(const CzFill *fill, int car, const CzStatics *statics) {
    const CzCar *place = &fill->model->car[car];
    const CzVehicle *vehicle = cz_fill_vehicle(fill, car);
    const CzBogie *bogie = &vehicle->bogie;
    const CzAdhesion *adhesion = &fill->model->simulation->adhesion;
    const double radius = bogie->wheel_radius;
    const double hertz = hertz_constant(radius, bogie->tread);
    double load = 0.0;

    cz_put(fill, car, CZ_PARAMETER(inverse.wheelset.mass), 1.0 / bogie->wheelset_mass);
    cz_put(fill, car, CZ_PARAMETER(inverse.wheelset.inertia_pitch), 1.0 / bogie->wheelset_inertia);
    cz_put(fill, car, CZ_PARAMETER(wheel.radius), radius);
    cz_put(fill, car, CZ_PARAMETER(wheel.hertz), hertz);
    for (int axle = 0; axle < 4; axle++) {
        const double indentation = cbrt(statics->wheel_load[axle] / hertz);
        const double moment = place->brake_ratio * statics->wheel_load[axle] * radius;
        cz_put(fill, car, CZ_PARAMETER(wheel.indentation[axle]), indentation * indentation);
        cz_put(fill, car, CZ_PARAMETER(wheel.brake_moment[axle]),
               braked_part(place->brake, axle) * moment);
        put_dof(fill, car, (int)(CZ_DOF(wheelset[axle].x)), bogie->wheelset_mass, place->speed);
        put_dof(fill, car, (int)(CZ_DOF(wheelset[axle].z)), bogie->wheelset_mass, 0.0);
        put_dof(fill, car, (int)(CZ_DOF(wheelset[axle].spin)), bogie->wheelset_inertia,
                place->speed / radius);
        load += statics->wheel_load[axle] / 4.0;
    }
    cz_put(fill, car, CZ_PARAMETER(wheel.brake_stiffness),
           bogie->wheelset_inertia * HELD_AXLE_FREQUENCY * HELD_AXLE_FREQUENCY);

    const Friction friction = friction_of(fill->model);
    cz_put(fill, car, CZ_PARAMETER(wheel.creep_stiffness),
           friction.peak * load / (adhesion->peak_creepage * CONTACT_LENGTH));
    cz_put(fill, car, CZ_PARAMETER(wheel.creep_length), CONTACT_LENGTH);
    cz_put(fill, car, CZ_PARAMETER(wheel.friction_peak), friction.peak);
    cz_put(fill, car, CZ_PARAMETER(wheel.friction_sliding), friction.sliding);
    cz_put(fill, car, CZ_PARAMETER(wheel.friction_fall_speed), adhesion->fall_speed);
    cz_put(fill, car, CZ_PARAMETER(wheel.rolling_resistance), vehicle->rolling_resistance);
    fill->lanes->has_rolling |= vehicle->rolling_resistance > 0.0;
}

/* ---- cars without running gear ---- */

/* Brakes that require more than the peak friction lock the wheels. */
static void fill_drag(const CzFill *fill, int car, const CzStatics *statics) {
    const CzCar *place = &fill->model->car[car];
    const CzVehicle *vehicle = cz_fill_vehicle(fill, car);
    const Friction friction = friction_of(fill->model);
    const double braked = place->brake == NULL ? 0.0 : place->brake->axle_share * statics->weight;
    const double ratio = fmin(place->brake_ratio, friction.peak);
    const bool locks = place->brake_ratio > friction.peak;
    const double rolling = vehicle->rolling_resistance * statics->weight;
    cz_put(fill, car, CZ_PARAMETER(drag.brake), ratio * braked);
    cz_put(fill, car, CZ_PARAMETER(drag.brake_sliding),
           (locks ? friction.sliding : ratio) * braked);
    cz_put(fill, car, CZ_PARAMETER(wheel.friction_fall_speed),
           fill->model->simulation->adhesion.fall_speed);
    cz_put(fill, car, CZ_PARAMETER(drag.rolling), rolling);
    fill->lanes->has_drag |= ratio * braked + rolling > 0.0;
}

static void fill_slide(const CzFill *fill, int car, const CzSlide *slide) {
    if (slide == NULL)
        return;
    cz_put(fill, car, CZ_PARAMETER(drag.slide), slide->force);
    cz_put(fill, car, CZ_PARAMETER(drag.slide_length), slide->length);
    cz_put(fill, car, CZ_PARAMETER(drag.slide_stiffness), slide->bottom_stiffness);
    fill->lanes->has_drag = 1;
}

CzStatus cz_fill_car(const CzFill *fill, int car, const CzStatics *statics) {
    const CzCar *place = &fill->model->car[car];
    cz_put(fill, car, CZ_PARAMETER(inverse.body.mass), inverse(statics->body_mass));
    cz_put(fill, car, CZ_PARAMETER(inverse.body.inertia_pitch), inverse(statics->body_inertia));
    put_dof(fill, car, CZ_DOF(body.x), statics->body_mass, place->speed);
    if (place->model != CZ_MODEL_FULL) {
        put_dof(fill, car, CZ_DOF(end[0].x), 0.0, place->speed);
        put_dof(fill, car, CZ_DOF(end[1].x), 0.0, place->speed);
        if (place->model == CZ_MODEL_RIGID)
            fill_drag(fill, car, statics);
        else
            fill_slide(fill, car, cz_slide_of(cz_fill_vehicle(fill, car)));
        return CZ_OK;
    }
    fill->lanes->has_full_cars = 1;
    cz_put(fill, car, CZ_PARAMETER(slaved_ends), 0.0);
    put_dof(fill, car, CZ_DOF(body.z), statics->body_mass, 0.0);
    put_dof(fill, car, CZ_DOF(body.pitch), statics->body_inertia, 0.0);
    CZ_TRY(fill_crush_zone(fill, car, CZ_REAR));
    CZ_TRY(fill_crush_zone(fill, car, CZ_FRONT));
    fill_suspensions(fill, car, &cz_fill_vehicle(fill, car)->bogie, statics);
    fill_bogies(fill, car);
    fill_wheels(fill, car, statics);
    return CZ_OK;
}
