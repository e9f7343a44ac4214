/* Collisions whose outcome is known in closed form. */
#include "physics/closed_forms.h"

#include "physics/collision.h"

#define STEP_OF_10_US "simulation.time_step_ms=0.01", "simulation.output_step_ms=0.01"
#define UNTIL_OPEN "simulation.duration_s=0.3"
#define OUTPUT_OF_100_US "simulation.output_step_ms=0.1"

const Step default_step = {1e-4, "default step", 1e-3, NAN};
const Step fine_step = {1e-5, "step 0.01 ms", 1e-4, NAN};

/* An interface that begins to close from rest builds its force up over a quarter of an oscillation
 * on its elastic stiffness k, so its response is delayed by a time that falls with the square root
 * of k only: at 8e11 N/m, the largest value that the reader accepts, crushes are wrong by 0.4 %.
 * The closed forms have no elasticity, so k is 1e14 N/m for a thousandth and 4e15 N/m for a
 * ten-thousandth, with steps below the bound 2 sqrt(m / 2k): shorter than 1e-5 s, at which no
 * stiffness is both stable and high enough. */
const Step stiff_step = {1e-5, "1e14 N/m, step 0.01 ms", 1e-3, 1e14};
const Step stiffer_step = {2e-6, "4e15 N/m, step 0.002 ms", 1e-4, 4e15};

static void stiffen(CzVehicle *vehicle, double stiffness) {
    vehicle->front.anti_climber.stiffness = stiffness / 8.0; /* eight devices side by side */
}

/* Crush zones yield after a micrometre: a stiffness of 1.5e12 N/m and more, where a file begins at
 * a tenth of a millimetre. A plateau loses half of the stroke over which the force builds up. */
#define A_MICROMETRE 1e-6
static void yield_at_once(CzVehicle *vehicle, double travel) {
    CzEnd *const ends[] = {&vehicle->front, &vehicle->rear};
    for (int end = 0; end < 2; end++)
        if (ends[end]->n_stages > 0)
            ends[end]->stages[0].stroke = travel;
}

/* ---- two masses and one plateau ---- */

/* crush mu dv^2 / (2 F), duration mu dv / F, common speed, energy mu dv^2 / 2. */
typedef struct {
    const char *name;
    const char *set[5]; /* masses, speeds, force */
    double mass[2];     /* [kg] */
    double crush, duration, after, energy;
} Plateau;

static const Plateau plateaus[] = {
    {"40 t, 40 t, +-25 km/h, 1.5 MN",
     {"trains.A.vehicles.A1.mass_t=40", "trains.B.vehicles.B1.mass_t=40", "trains.A.speed_km_h=25",
      "trains.B.speed_km_h=-25", "1.5"},
     {40e3, 40e3},
     1.286008,
     0.185185,
     0.0,
     1929.012},
    {"40 t, 40 t, 10 m/s, 1.5 MN",
     {"trains.A.vehicles.A1.mass_t=40", "trains.B.vehicles.B1.mass_t=40", "trains.A.speed_m_s=10",
      "trains.B.speed_m_s=0", "1.5"},
     {40e3, 40e3},
     0.666667,
     0.133333,
     5.0,
     1000.000},
    {"129 t, 80 t, 10 m/s, 2 MN",
     {"trains.A.vehicles.A1.mass_t=129", "trains.B.vehicles.B1.mass_t=80", "trains.A.speed_m_s=10",
      "trains.B.speed_m_s=0", "2.0"},
     {129e3, 80e3},
     1.234450,
     0.246890,
     6.172249,
     2468.900},
    {"462 t, 462 t, 10 m/s, 3 MN",
     {"trains.A.vehicles.A1.mass_t=462", "trains.B.vehicles.B1.mass_t=462", "trains.A.speed_m_s=10",
      "trains.B.speed_m_s=0", "3.0"},
     {462e3, 462e3},
     3.850000,
     0.770000,
     5.0,
     11550.000},
};

static void rows_of_plateau(Rows *rows, const Collision *collision, const Plateau *plateau,
                            const Step *step) {
    assert_completed(collision);
    const double *v_a = channel(collision, CZ_CHANNEL_BODY_SPEED, "A1"),
                 *v_b = channel(collision, CZ_CHANNEL_BODY_SPEED, "B1");
    const CzRunSummary *summary = collision->summary;
    const double after = (plateau->mass[0] * summary->vehicle[0].final_speed +
                          plateau->mass[1] * summary->vehicle[1].final_speed) /
                         (plateau->mass[0] + plateau->mass[1]);
    ROW(rows, "m", summary->interface[0].shortening, plateau->crush, step->tolerance, 0.0,
        "%s: crush, %s", plateau->name, step->name);
    ROW(rows, "s", time_of_fall(collision, v_a, v_b), plateau->duration, step->tolerance, 0.0,
        "%s: duration, %s", plateau->name, step->name);
    ROW(rows, "m/s", after, plateau->after, step->tolerance, 1e-6, "%s: common speed, %s",
        plateau->name, step->name);
    ROW(rows, "kJ", 1e-3 * summary->interface[0].energy, plateau->energy, step->tolerance, 0.0,
        "%s: energy, %s", plateau->name, step->name);
}

static void two_masses(Rows *rows, const char *file, const char *const *force_key,
                       const Step *step) {
    for (size_t i = 0; i < sizeof plateaus / sizeof plateaus[0]; i++) {
        const Plateau *plateau = &plateaus[i];
        char force[2][96];
        for (int k = 0; k < 2; k++)
            snprintf(force[k], sizeof force[k], "%s=%s", force_key[k], plateau->set[4]);
        Collision collision =
            collide_changed(file,
                            WITH(plateau->set[0], plateau->set[1], plateau->set[2], plateau->set[3],
                                 force[0], force[1], OUTPUT_OF_100_US),
                            yield_at_once, A_MICROMETRE, step->length);
        rows_of_plateau(rows, &collision, plateau, step);
        collision_free(&collision);
    }
}

void rows_of_plateaus(Rows *rows, const Step *step) {
    static const char *const keys[] = {
        "trains.A.vehicles.A1.front.anti_climber.stages[0].force_MN",
        "trains.A.vehicles.A1.front.anti_climber.stages[0].force_MN"};
    two_masses(rows, "tests/physics/cases/plateau.yaml", keys, step);
}

void rows_of_crush_zones_in_series(Rows *rows, const Step *step) {
    static const char *const keys[] = {"parts.zone.stages[0].force_MN",
                                       "parts.zone.stages[1].force_MN"};
    two_masses(rows, "tests/physics/cases/plateau-of-ends.yaml", keys, step);
}

/* ---- one mass against a wall ---- */

/* First time at which a channel reaches a value, on the line between two samples [s]. */
static double time_of_rise(const Collision *collision, const double *values, double value) {
    const double *t = channel(collision, CZ_CHANNEL_TIME, "");
    for (int i = 1; i < n_sample(collision); i++)
        if (values[i] >= value)
            return 1e-3 * (t[i - 1] + (t[i] - t[i - 1]) * (value - values[i - 1]) /
                                          (values[i] - values[i - 1]));
    return NAN;
}

static double largest(const Collision *collision, const double *values) {
    double value = -INFINITY;
    for (int i = 0; i < n_sample(collision); i++)
        value = fmax(value, values[i]);
    return value;
}

/* 40 t at 25 km/h; 20 MN/m up to 1.5 MN, unloading with 80 MN/m; rebound F_y / sqrt(k_u m). */
void rows_of_spring_and_plateau(Rows *rows) {
    Collision collision =
        collide("tests/physics/cases/spring-and-plateau.yaml", WITH(STEP_OF_10_US, UNTIL_OPEN), 0);
    assert_completed(&collision);
    const CzRunSummary *summary = collision.summary;
    const double *v = channel(&collision, CZ_CHANNEL_BODY_SPEED, "A1"),
                 *x = channel(&collision, CZ_CHANNEL_BODY_DISPLACEMENT, "A1");
    const double open =
        time_of_opening(&collision, channel(&collision, CZ_CHANNEL_INTERFACE_FORCE, "A1-wall"));
    const double rebound = -summary->vehicle[0].final_speed;
    ROW(rows, "s", time_of_rise(&collision, x, 0.075), 0.010907831, 1e-5, 1e-7, "time of yielding");
    ROW(rows, "m", summary->interface[0].shortening, 0.680504115, 1e-5, 0.0, "largest crush");
    ROW(rows, "s", time_of_fall(&collision, v, NULL), 0.190611, 1e-5, 1e-6,
        "time of the largest crush");
    ROW(rows, "kN", 1e-3 * summary->interface[0].peak_force, 1500.0, 1e-5, 0.0, "largest force");
    ROW(rows, "s", open, 0.225736, 1e-5, 0.0, "time of separation");
    ROW(rows, "m", value_at(&collision, x, open), 0.661754115, 1e-5, 0.0, "residual crush");
    ROW(rows, "m/s", rebound, 0.838525492, 1e-5, 0.0, "rebound");
    ROW(rows, "", rebound / (25.0 / 3.6), 0.120747671, 1e-5, 0.0, "restitution");
    ROW(rows, "kJ", 1e-3 * summary->interface[0].energy, 950.443673, 1e-5, 0.0, "dissipated");
    collision_free(&collision);
}

/* The end of four loading and two unloading stages, 40 t at 25 km/h. */
void rows_of_four_stages(Rows *rows) {
    Collision collision =
        collide("tests/physics/cases/four-stages.yaml", WITH(STEP_OF_10_US, UNTIL_OPEN), 0);
    assert_completed(&collision);
    const CzRunSummary *summary = collision.summary;
    const double *x = channel(&collision, CZ_CHANNEL_BODY_DISPLACEMENT, "A1");
    const double open =
        time_of_opening(&collision, channel(&collision, CZ_CHANNEL_INTERFACE_FORCE, "A1-wall"));
    const double rebound = -summary->vehicle[0].final_speed;
    ROW(rows, "m", largest(&collision, x), 0.573619, 1e-5, 0.0, "largest crush");
    ROW(rows, "kN", 1e-3 * summary->interface[0].peak_force, 4104.289, 1e-5, 0.0, "largest force");
    ROW(rows, "s", time_of_fall(&collision, channel(&collision, CZ_CHANNEL_BODY_SPEED, "A1"), NULL),
        0.128219, 1e-5, 1e-6, "time of the largest crush");
    ROW(rows, "m/s", rebound, 2.582225, 1e-5, 0.0, "rebound");
    ROW(rows, "", rebound / (25.0 / 3.6), 0.371840, 1e-5, 5e-7, "restitution");
    ROW(rows, "m", value_at(&collision, x, open), 0.484693, 1e-5, 0.0, "residual crush");
    ROW(rows, "kJ", 1e-3 * summary->interface[0].energy, 831.148, 1e-5, 0.0, "dissipated");
    collision_free(&collision);
}

/* ---- stages in sequence, trains ---- */

/* The ends of the stages from the remaining speed: the energy of each stage gives it, and the car
 * has slowed down to it at the end of the stage. */
void rows_of_sequence(Rows *rows, const Step *step) {
    static const struct {
        const char *name;
        double time, speed, travel;
    } ends[] = {{"end of the coupler", 0.045429, 6.263011, 0.30},
                {"anti-climber contact", 0.048622, 6.263011, 0.32},
                {"end of the anti-climber", 0.102266, 4.921921, 0.62}};
    char output[48]; /* a stage's end lies between two samples */
    snprintf(output, sizeof output, "simulation.output_step_ms=%g", 1e3 * step->length);
    Collision collision = collide_changed("tests/physics/cases/sequence.yaml", WITH(output),
                                          yield_at_once, A_MICROMETRE, step->length);
    assert_completed(&collision);
    const CzRunSummary *summary = collision.summary;
    const double *v = channel(&collision, CZ_CHANNEL_BODY_SPEED, "A1"),
                 *x = channel(&collision, CZ_CHANNEL_BODY_DISPLACEMENT, "A1");
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++) {
        ROW(rows, "m/s", value_at(&collision, v, ends[i].time), ends[i].speed, step->tolerance, 0.0,
            "%s, %g s: speed, %s", ends[i].name, ends[i].time, step->name);
        ROW(rows, "m", value_at(&collision, x, ends[i].time), ends[i].travel, step->tolerance, 0.0,
            "%s, %g s: displacement, %s", ends[i].name, ends[i].time, step->name);
    }
    ROW(rows, "s", time_of_fall(&collision, v, NULL), 0.167891, step->tolerance, 0.0,
        "standstill, %s", step->name);
    ROW(rows, "m", 0.5 * summary->interface[0].shortening, 0.781502, step->tolerance, 0.0,
        "total displacement of a car, %s", step->name);
    ROW(rows, "kJ", 1e-3 * summary->interface[0].energy, 1929.012, step->tolerance, 0.0,
        "dissipated, %s", step->name);
    collision_free(&collision);
}

enum { MAX_OUTCOME = 24 };
typedef int Measure(const Collision *collision, double *outcome);

static int outcomes_of_rigid_plastic(const char *file, const Step *step, Measure *measure,
                                     double *outcome) {
    Collision collision =
        collide_changed(file, WITH(OUTPUT_OF_100_US), stiffen, step->stiffness, step->length);
    assert_completed(&collision);
    const int n_outcome = measure(&collision, outcome);
    collision_free(&collision);
    return n_outcome;
}

/* When the leading and when the rear car stop; crush and energy of both interfaces, total energy,
 * initial energy. */
static int measure_two(const Collision *collision, double *outcome) {
    const CzRunSummary *summary = collision->summary;
    outcome[0] =
        time_on_line(collision, channel(collision, CZ_CHANNEL_BODY_SPEED, "A2"), NULL, 0.05, 0.25);
    outcome[1] =
        time_on_line(collision, channel(collision, CZ_CHANNEL_BODY_SPEED, "A1"), NULL, 0.05, 0.25);
    outcome[2] = summary->interface[1].shortening;
    outcome[3] = 1e-3 * summary->interface[1].energy;
    outcome[4] = summary->interface[0].shortening;
    outcome[5] = 1e-3 * summary->interface[0].energy;
    outcome[6] = 1e-3 * summary->energy.dissipated;
    outcome[7] = 1e-3 * summary->energy.initial;
    return 8;
}

void rows_of_two_into_wall(Rows *rows, const Step *step) {
    static const struct {
        const char *name, *unit;
        double expected;
    } known[] = {{"leading car stops", "s", 0.266667},  {"rear car stops", "s", 0.400000},
                 {"crush at the wall", "m", 1.6},       {"energy at the wall", "kJ", 4800.0},
                 {"crush between the cars", "m", 0.8},  {"energy between the cars", "kJ", 960.0},
                 {"dissipated in total", "kJ", 5760.0}, {"initial energy", "kJ", 5760.0}};
    double outcome[MAX_OUTCOME];
    const int n = outcomes_of_rigid_plastic("tests/physics/cases/two-into-wall.yaml", step,
                                            measure_two, outcome);
    for (int i = 0; i < n; i++)
        ROW(rows, known[i].unit, outcome[i], known[i].expected, step->tolerance, 0.0, "%s, %s",
            known[i].name, step->name);
}

/* Mean speed of the seven cars behind A8 less that of the seven behind B1; the caller frees it. */
static double *rear_closing_speed(const Collision *collision) {
    double *closing = calloc((size_t)n_sample(collision), sizeof *closing);
    assert_non_null(closing);
    for (int car = 1; car <= 7; car++) {
        char name[2][8];
        snprintf(name[0], sizeof name[0], "A%d", car);
        snprintf(name[1], sizeof name[1], "B%d", car + 1);
        const double *a = channel(collision, CZ_CHANNEL_BODY_SPEED, name[0]);
        const double *b = channel(collision, CZ_CHANNEL_BODY_SPEED, name[1]);
        for (int i = 0; i < n_sample(collision); i++)
            closing[i] += (a[i] - b[i]) / 7.0;
    }
    return closing;
}

/* When the two front cars and when all reach one speed, all energy, mean speed, the closures. */
static int measure_sixteen(const Collision *collision, double *outcome) {
    const CzRunSummary *summary = collision->summary;
    outcome[0] = time_on_line(collision, channel(collision, CZ_CHANNEL_BODY_SPEED, "A8"),
                              channel(collision, CZ_CHANNEL_BODY_SPEED, "B1"), 0.05, 0.19);
    double *closing = rear_closing_speed(collision);
    outcome[1] = time_on_line(collision, closing, NULL, 0.05, 1.3);
    free(closing);
    outcome[2] = outcome[3] = 0.0;
    for (int i = 0; i < 15; i++) {
        outcome[2] += 1e-3 * summary->interface[i].energy;
        outcome[4 + i] = summary->interface[i].shortening;
    }
    for (int car = 0; car < 16; car++)
        outcome[3] += summary->vehicle[car].final_speed / 16.0;
    return 19;
}

void rows_of_eight_and_eight(Rows *rows, const Step *step) {
    static const struct {
        const char *name, *unit;
        double expected;
    } known[] = {{"front cars have one speed", "s", 0.20625},
                 {"all cars have one speed", "s", 1.34750},
                 {"dissipated in total", "kJ", 11550.0},
                 {"mean speed after", "m/s", 5.0}};
    double outcome[MAX_OUTCOME], others = 0.0;
    outcomes_of_rigid_plastic("tests/physics/cases/eight-and-eight.yaml", step, measure_sixteen,
                              outcome);
    for (int i = 0; i < 4; i++)
        ROW(rows, known[i].unit, outcome[i], known[i].expected, step->tolerance, 0.0, "%s, %s",
            known[i].name, step->name);
    for (int i = 0; i < 15; i++) {
        if (i < 6 || i > 8)
            others = fmax(others, fabs(outcome[4 + i]));
    }
    ROW(rows, "m", outcome[4 + 7], 1.03125, step->tolerance, 0.0, "closure between the trains, %s",
        step->name);
    ROW(rows, "m", outcome[4 + 6], 2.853125, step->tolerance, 0.0, "closure A7-A8, %s", step->name);
    ROW(rows, "m", outcome[4 + 8], 2.853125, step->tolerance, 0.0, "closure B1-B2, %s", step->name);
    ROW(rows, "m", others, 0.0, 0.0, 1e-3, "largest closure anywhere else, %s", step->name);
}
