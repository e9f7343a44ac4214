/* Published vehicles, and bulk numbers of full-scale tests. */
#include "physics/published.h"

#include "model/fill.h"
#include "model/vertical_modes.h"
#include "physics/motion.h"

#define MPH 0.44704 /* [m/s] */
#define FOOT 0.3048 /* [m] */

/* ---- coaches ---- */

static const char coaches[] = "tests/physics/cases/coaches.yaml";

/* The frequencies were computed with an independent eigenvalue routine. */
static void rows_of_modes(Rows *rows, const CzVehicle *vehicle, const char *name,
                          const double *expected) {
    const CzStatics statics = {.body_inertia = vehicle->pitch_inertia,
                               .body_mass = vehicle->mass - 2.0 * vehicle->bogie.mass -
                                            4.0 * vehicle->bogie.wheelset_mass -
                                            vehicle->front.mass - vehicle->rear.mass};
    const CzVerticalModes modes = cz_vertical_modes(vehicle, &statics);
    ROW(rows, "Hz", modes.bounce, expected[0], 0.0, 5e-5, "%s: bounce", name);
    ROW(rows, "Hz", modes.pitch, expected[1], 0.0, 5e-5, "%s: pitch", name);
    for (int mode = 2; mode < CZ_N_VERTICAL_MODE; mode++)
        ROW(rows, "Hz", modes.frequency[mode], expected[mode], 0.0, 5e-5, "%s: mode %d", name,
            mode + 1);
}

void rows_of_coaches(Rows *rows) {
    static const double manchester[] = {1.0725, 1.2973, 7.4187, 7.4255, 11.6174, 11.6174};
    static const double velaro[] = {0.8037, 1.0898, 6.3167, 6.3233, 10.5249, 10.5249};
    Collision collision = collision_model(coaches, AS_WRITTEN, 0);
    int n_vehicle = 0;
    const CzVehicle *vehicle = cz_problem_vehicles(collision.problem, &n_vehicle);
    rows_of_modes(rows, &vehicle[0], "Manchester coach", manchester);
    rows_of_modes(rows, &vehicle[1], "Velaro coach", velaro);
    const CzVehicleProperties properties = cz_model_vehicle_properties(collision.model, 0);
    ROW(rows, "Hz", properties.bounce_frequency, manchester[0], 0.0, 5e-5,
        "Manchester coach: bounce, as predicted before a run");
    ROW(rows, "Hz", properties.pitch_frequency, manchester[1], 0.0, 5e-5,
        "Manchester coach: pitch, as predicted before a run");
    for (int axle = 0; axle < 4; axle++)
        ROW(rows, "kN", 1e-3 * properties.axle_load[axle], 91.275 + 17.779, 0.0, 1e-3,
            "Manchester coach: load of axle %d", axle + 1);
    collision_free(&collision);
}

/* 1 MN at 0.8 m from the centre of gravity requires 0.8 MN m, that is 42.105 kN more on one bogie
 * and less on the other at 19 m; on secondary and primary springs in series the body then pitches
 * by 6.077 mrad. The pitch is imposed on the kernel, each bogie is placed so that its link is not
 * stretched and its springs balance, and the kernel's own forces are read. */
void rows_of_pitch_by_force(Rows *rows) {
    const double pitch = 6.077e-3, force_wanted = 1e6, height = 0.8;
    Motion motion = motion_open(coaches, AS_WRITTEN);
    motion_start(&motion);
    const double k = *parameter(&motion, CZ_PARAMETER(secondary.stiffness), 0);
    const double primaries = 2.0 * *parameter(&motion, CZ_PARAMETER(primary.stiffness), 0);
    const double half = *parameter(&motion, CZ_PARAMETER(bogie_x), 0);
    *position(&motion, CZ_DOF(body.pitch), 0) = pitch;
    *position(&motion, CZ_DOF(end[0].pitch), 0) = pitch;
    *position(&motion, CZ_DOF(end[1].pitch), 0) = pitch;
    for (int bogie = 0; bogie < 2; bogie++) {
        const double lift = (bogie == 0 ? -1.0 : 1.0) * half * pitch;
        *position(&motion, CZ_DOF(bogie[bogie].z), 0) = lift * k / (k + primaries);
        *position(&motion, CZ_DOF(bogie[bogie].x), 0) =
            -pitch * *parameter(&motion, CZ_PARAMETER(link.body_z), 0);
    }
    /* The springs of a tilted body differ from a level one's by the square of its pitch. */
    for (int pass = 0; pass < 3; pass++) {
        motion.kernel->evaluate(motion.dynamics, motion.step);
        for (int bogie = 0; bogie < 2; bogie++)
            *position(&motion, CZ_DOF(bogie[bogie].z), 0) +=
                force(&motion, CZ_DOF(bogie[bogie].z), 0) / (k + primaries);
    }
    motion.kernel->evaluate(motion.dynamics, motion.step);
    double transfer = 0.0, residual = 0.0, moment = 0.0;
    for (int axle = 0; axle < 4; axle++)
        transfer += (axle < 2 ? -0.5 : 0.5) * force(&motion, CZ_DOF(wheelset[axle].z), 0);
    for (int bogie = 0; bogie < 2; bogie++)
        residual = fmax(residual, fabs(force(&motion, CZ_DOF(bogie[bogie].z), 0)));
    moment = transfer * 2.0 * half;
    ROW(rows, "kN", 1e-3 * transfer, 1e-3 * force_wanted * height / (2.0 * half), 2e-4, 0.0,
        "pitched by 6.077 mrad: load shifted from bogie to bogie"); /* the pitch has four digits */
    ROW(rows, "kNm", 1e-3 * moment, 1e-3 * force_wanted * height, 2e-4, 0.0,
        "pitched by 6.077 mrad: moment of 1 MN at 0.8 m");
    ROW(rows, "N", residual, 0.0, 0.0, 1.0, "unbalanced force on the bogies");
    motion_close(&motion);
}

/* The same force applied suddenly, without dampers: the body oscillates about the static pitch, up
 * to twice of it. By linearity this equals the free oscillation from the static pitch after the
 * force is removed, which is run here. The bogies' own inertia changes it by some parts in a
 * thousand, as do their modes at 7 Hz. */
void rows_of_step_force(Rows *rows) {
    const double pitch = 6.077e-3;
    Motion motion = motion_open(coaches, AS_WRITTEN);
    /* The links would pull at bogies in their initial position. */
    static const CzParameter none[] = {
        CZ_PARAMETER(link.strut.stiffness), CZ_PARAMETER(link.strut.damping),
        CZ_PARAMETER(secondary.damping), CZ_PARAMETER(primary.damping)};
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++)
        *parameter(&motion, none[i], 0) = 0.0;
    motion_start(&motion);
    const double k = *parameter(&motion, CZ_PARAMETER(secondary.stiffness), 0);
    const double primaries = 2.0 * *parameter(&motion, CZ_PARAMETER(primary.stiffness), 0);
    const double half = *parameter(&motion, CZ_PARAMETER(bogie_x), 0);
    static const int pitches[] = {CZ_DOF(body.pitch), CZ_DOF(end[0].pitch), CZ_DOF(end[1].pitch)};
    for (int i = 0; i < 3; i++)
        *position(&motion, pitches[i], 0) = pitch;
    for (int bogie = 0; bogie < 2; bogie++)
        *position(&motion, CZ_DOF(bogie[bogie].z), 0) =
            (bogie == 0 ? -1.0 : 1.0) * half * pitch * k / (k + primaries);
    motion_evaluate(&motion);
    double lowest = 0.0;
    while ((double)motion.n_step * motion.step < 0.6) {
        motion_advance(&motion);
        motion_evaluate(&motion);
        lowest = fmin(lowest, *position(&motion, CZ_DOF(body.pitch), 0));
    }
    ROW(rows, "", 1.0 - lowest / pitch, 2.0, 1e-2, 0.0,
        "1 MN at 0.8 m switched on at once, undamped: largest pitch over the static one");
    motion_close(&motion);
}

/* ---- full-scale tests ---- */

/* FRA, 31 January 2002: two trains of about 635 kip (288 t) at 30 mph onto rest; the cab car was
 * crushed by about 20 ft. The mean force is the published energy over the published crush, so it is
 * input; the result is that momentum and energy agree. */
void rows_of_train_to_train(Rows *rows) {
    const double v = 30.0 * MPH, mean = 12.95e6 / (20.0 * FOOT);
    char speed[64], force[96];
    snprintf(speed, sizeof speed, "trains.A.speed_m_s=%.6f", v);
    snprintf(force, sizeof force, "trains.A.vehicles.A1.front.anti_climber.stages[0].force_MN=%.6f",
             1e-6 * mean);
    Collision collision =
        collide("tests/physics/cases/plateau.yaml",
                WITH("trains.A.vehicles.A1.mass_t=288", "trains.B.vehicles.B1.mass_t=288", speed,
                     force, "simulation.time_step_ms=0.1"),
                0);
    assert_completed(&collision);
    const CzRunSummary *summary = collision.summary;
    const double after = 0.5 * (summary->vehicle[0].final_speed + summary->vehicle[1].final_speed);
    ROW(rows, "MJ", 1e-6 * summary->energy.initial, 25.90, 1e-3, 0.0, "initial energy");
    ROW(rows, "m/s", after, 6.706, 1e-3, 0.0, "common speed");
    ROW(rows, "MJ", 1e-6 * summary->energy.dissipated, 12.95, 1e-3, 0.0, "dissipated");
    ROW(rows, "m", summary->interface[0].shortening, 20.0 * FOOT, 2e-3, 0.0,
        "crush at the mean force of %.2f MN (put in)", 1e-6 * mean);
    collision_free(&collision);
}

/* Two cars into a wall with forces per mass [m/s2]. */
static Collision into_wall(double speed, double lead, double between) {
    char set[3][96];
    snprintf(set[0], sizeof set[0], "trains.A.speed_m_s=%.6f", speed);
    snprintf(set[1], sizeof set[1],
             "trains.A.vehicles.A1.front.anti_climber.stages[0].force_MN=%.6f",
             between * 40e3 / 8.0 * 1e-6);
    snprintf(set[2], sizeof set[2],
             "trains.A.vehicles.A2.front.anti_climber.stages[0].force_MN=%.6f",
             lead * 40e3 / 8.0 * 1e-6);
    Collision collision = collide("tests/physics/cases/two-into-wall.yaml",
                                  WITH(set[0], set[1], set[2], "simulation.time_step_ms=0.01"), 0);
    assert_completed(&collision);
    return collision;
}

/* FRA crash energy management, a single car at 35 mph crushed by about 3 ft and two coupled cars at
 * 29 mph by about 3 ft in front and 2 ft between them. No mass and no curve is published, so forces
 * are per mass. With constant forces of the published means the cars would stop together without
 * any crush between them, because the interface would have to yield below half of the leading car's
 * force; so the published crush says that the forces were not constant, and that is all that can be
 * said.
 */
void rows_of_crush_of_single_cars(Rows *rows) {
    const double lead = pow(35.0 * MPH, 2.0) / (2.0 * 3.0 * FOOT);
    const double two = pow(29.0 * MPH, 2.0);
    const double between = (two - lead * 3.0 * FOOT) / (2.0 * FOOT);
    ROW(rows, "m/s2", lead, 133.9, 1e-3, 0.0, "lead force over mass, from the single car");
    ROW(rows, "m/s2", between, 74.9, 2e-3, 0.0, "interface force over mass, from two cars");
    /* A single car is represented by two that do not crush between them. */
    Collision single = into_wall(35.0 * MPH, 2.0 * lead, 1e3);
    ROW(rows, "m", single.summary->interface[1].shortening, 3.0 * FOOT, 2e-3, 0.0,
        "crush of the lead end at 35 mph with that force");
    collision_free(&single);
    Collision pair = into_wall(29.0 * MPH, lead, between);
    ROW_UP_TO(rows, "m", pair.summary->interface[0].shortening, 0.01,
              "two cars at 29 mph, constant forces: crush between them (published: 0.61 m)");
    ROW(rows, "m", pair.summary->interface[1].shortening, two / lead, 2e-3, 0.0,
        "two cars at 29 mph, constant forces: crush in front (published: 0.91 m)");
    collision_free(&pair);
}

/* FRA coupling tests, October 2017: of six speeds only the last made the push-back coupler deflect.
 * With an elastic draft gear the peak force grows with the speed, so the trigger lies between the
 * peaks of the last two; it is placed between them here, and the runs must reproduce the outcome of
 * each speed. */
void rows_of_coupling_speeds(Rows *rows) {
    static const double speeds[] = {1.8, 3.74, 5.66, 6.84, 7.63, 8.85};
    const double mass = 0.5 * 117.9e3, stiffness = 5e6; /* two masses, two gears in series */
    const double peak = sqrt(mass * stiffness) * MPH;   /* per mph */
    const double trigger = 0.5 * (speeds[4] + speeds[5]) * peak;
    char set[2][80];
    snprintf(set[1], sizeof set[1], "parts.head.coupler.tube.stages[0].force_MN=%.6f",
             1e-6 * trigger);
    for (int i = 0; i < 6; i++) {
        snprintf(set[0], sizeof set[0], "trains.A.speed_m_s=%.6f", speeds[i] * MPH);
        Collision collision = collide("tests/physics/cases/coupling.yaml", WITH(set[0], set[1]), 0);
        assert_completed(&collision);
        const double flows =
            isfinite(event_time(&collision, CZ_EVENT_TUBE_ACTIVATION, "")) ? 1.0 : 0.0;
        ROW(rows, "", flows, i == 5 ? 1.0 : 0.0, 0.0, 0.0, "%g mph: device released (1) or not (0)",
            speeds[i]);
        collision_free(&collision);
    }
}

/* CRRC Changchun, March 2021: 36 km/h onto rest, 462 t each. Forces are ours. */
void rows_of_eight_car_trains(Rows *rows) {
    Collision collision = collide("tests/physics/cases/eight-and-eight.yaml", AS_WRITTEN, 0);
    assert_completed(&collision);
    const CzRunSummary *summary = collision.summary;
    double speed = 0.0;
    for (int car = 0; car < 16; car++)
        speed += 3.6 * summary->vehicle[car].final_speed / 16.0;
    ROW(rows, "MJ", 1e-6 * summary->energy.initial, 23.10, 1e-3, 0.0, "initial energy");
    ROW(rows, "MJ", 1e-6 * summary->energy.dissipated, 11.55, 1e-3, 0.0, "dissipated");
    ROW(rows, "km/h", speed, 18.0, 1e-3, 0.0, "mean speed after");
    collision_free(&collision);
}
