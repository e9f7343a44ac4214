/* Collisions of rigid cars whose outcome is known in closed form.
 *
 * Tolerances: plateaus within 1e-3 at the default step and within 1e-4 at 0.01 ms, because a
 * plateau that begins at contact loses half a step of its impulse; continuous curves within 1e-5.
 */
#include "physics/collision.h"

#define STEP_OF_10_US "simulation.time_step_ms=0.01", "simulation.output_step_ms=0.01"
#define UNTIL_OPEN "simulation.duration_s=0.3"
#define OUTPUT_OF_100_US "simulation.output_step_ms=0.1"

/* ---- two masses and one plateau ---- */

/* crush mu dv^2 / (2 F), duration mu dv / F, common speed, energy mu dv^2 / 2. */
typedef struct {
    const char *set[5]; /* masses, speeds, force */
    double mass[2];     /* [kg] */
    double crush, duration, after, energy;
} Plateau;

static const Plateau plateaus[] = {
    {{"trains.A.vehicles.A1.mass_t=40", "trains.B.vehicles.B1.mass_t=40", "trains.A.speed_km_h=25",
      "trains.B.speed_km_h=-25", "1.5"},
     {40e3, 40e3},
     1.286008,
     0.185185,
     0.0,
     1929.012e3},
    {{"trains.A.vehicles.A1.mass_t=40", "trains.B.vehicles.B1.mass_t=40", "trains.A.speed_m_s=10",
      "trains.B.speed_m_s=0", "1.5"},
     {40e3, 40e3},
     0.666667,
     0.133333,
     5.0,
     1000.000e3},
    {{"trains.A.vehicles.A1.mass_t=129", "trains.B.vehicles.B1.mass_t=80", "trains.A.speed_m_s=10",
      "trains.B.speed_m_s=0", "2.0"},
     {129e3, 80e3},
     1.234450,
     0.246890,
     6.172249,
     2468.900e3},
    {{"trains.A.vehicles.A1.mass_t=462", "trains.B.vehicles.B1.mass_t=462", "trains.A.speed_m_s=10",
      "trains.B.speed_m_s=0", "3.0"},
     {462e3, 462e3},
     3.850000,
     0.770000,
     5.0,
     11550.000e3},
};

/* `elastic` is the way over which the force builds up: half of it is lost to the plateau. */
static void assert_plateau(const Collision *collision, const Plateau *row, double elastic,
                           double tolerance) {
    assert_completed(collision);
    const double closing = channel(collision, "v_A1_m_s")[0] - channel(collision, "v_B1_m_s")[0];
    const CzRunSummary *summary = collision->summary;
    const double *v_a = channel(collision, "v_A1_m_s"), *v_b = channel(collision, "v_B1_m_s");
    assert_near(summary->interface[0].shortening, row->crush + 0.5 * elastic, tolerance, 0.0);
    assert_near(time_of_fall(collision, v_a, v_b), row->duration + 0.5 * elastic / closing,
                tolerance, 0.0);
    assert_near(summary->interface[0].energy, row->energy, tolerance, 0.0);
    const double after = (row->mass[0] * summary->vehicle[0].final_speed +
                          row->mass[1] * summary->vehicle[1].final_speed) /
                         (row->mass[0] + row->mass[1]);
    assert_near(after, row->after, tolerance, 1e-6);
}

static void two_masses(const char *file, const char *force_key, const char *force_key_b,
                       double elastic, const char *step, double tolerance) {
    for (size_t i = 0; i < sizeof plateaus / sizeof plateaus[0]; i++) {
        const Plateau *row = &plateaus[i];
        char force[2][96];
        snprintf(force[0], sizeof force[0], "%s=%s", force_key, row->set[4]);
        snprintf(force[1], sizeof force[1], "%s=%s", force_key_b, row->set[4]);
        Collision collision =
            collide(file,
                    WITH(row->set[0], row->set[1], row->set[2], row->set[3], force[0], force[1],
                         OUTPUT_OF_100_US, step, "simulation.output_step_ms=0.01"),
                    0);
        assert_plateau(&collision, row, elastic, tolerance);
        collision_free(&collision);
    }
}

static void a_plateau_between_two_masses_follows_the_closed_form(void **state) {
    (void)state;
    const char *file = "tests/physics/cases/plateau.yaml";
    const char *force = "trains.A.vehicles.A1.front.anti_climber.stages[0].force_MN";
    two_masses(file, force, force, 0.0, "simulation.output_step_ms=0.1", 1e-3);
    two_masses(file, force, force, 0.0, "simulation.time_step_ms=0.01", 1e-4);
}

/* Two zones that yield after 0.1 mm each. */
static void crush_zones_in_series_follow_the_closed_form(void **state) {
    (void)state;
    const char *file = "tests/physics/cases/plateau-of-ends.yaml";
    const char *first = "parts.zone.stages[0].force_MN", *second = "parts.zone.stages[1].force_MN";
    two_masses(file, first, second, 2e-4, "simulation.output_step_ms=0.1", 1e-3);
    two_masses(file, first, second, 2e-4, "simulation.time_step_ms=0.01", 1e-4);
}

/* ---- one mass against a wall ---- */

static double largest(const Collision *collision, const double *values, int *where) {
    double value = -INFINITY;
    for (int i = 0; i < n_sample(collision); i++) {
        if (values[i] > value) {
            value = values[i];
            *where = i;
        }
    }
    return value;
}

/* Yield at 0.010907831 s; 0.680504115 m at 0.190611 s; open at 0.225736 s with 0.661754115 m left;
 * rebound F_y / sqrt(k_u m) = 0.838525492 m/s; 950.443673 kJ. */
static void an_elastic_and_plastic_spring_follows_the_closed_form(void **state) {
    (void)state;
    Collision collision =
        collide("tests/physics/cases/spring-and-plateau.yaml", WITH(STEP_OF_10_US, UNTIL_OPEN), 0);
    assert_completed(&collision);
    const CzRunSummary *summary = collision.summary;
    const double *v = channel(&collision, "v_A1_m_s");
    assert_near(summary->interface[0].shortening, 0.680504115, 1e-5, 0.0);
    assert_near(time_of_fall(&collision, v, NULL), 0.190611, 1e-5, 1e-6);
    assert_near(summary->vehicle[0].final_speed, -0.838525492, 1e-5, 0.0);
    assert_near(summary->interface[0].energy, 950.443673e3, 1e-5, 0.0);
    assert_near(summary->interface[0].peak_force, 1.5e6, 1e-5, 0.0);
    const double *force = channel(&collision, "F_A1-wall_kN"), *x = channel(&collision, "x_A1_m");
    const double open = time_of_opening(&collision, force);
    assert_near(open, 0.225736, 1e-5, 0.0);
    assert_near(value_at(&collision, x, open), 0.661754115, 1e-5, 0.0);
    collision_free(&collision);
}

static void four_stages_and_two_stages_back_follow_the_closed_form(void **state) {
    (void)state;
    Collision collision =
        collide("tests/physics/cases/four-stages.yaml", WITH(STEP_OF_10_US, UNTIL_OPEN), 0);
    assert_completed(&collision);
    const CzRunSummary *summary = collision.summary;
    int where = 0;
    const double *x = channel(&collision, "x_A1_m");
    assert_near(largest(&collision, x, &where), 0.573619, 1e-5, 0.0);
    assert_near(time_of_fall(&collision, channel(&collision, "v_A1_m_s"), NULL), 0.128219, 1e-5,
                1e-6);
    assert_near(summary->interface[0].peak_force, 4104.289e3, 1e-5, 0.0);
    assert_near(summary->vehicle[0].final_speed, -2.582225, 1e-5, 0.0);
    assert_near(summary->interface[0].energy, 831.148e3, 1e-5, 0.0);
    const double *force = channel(&collision, "F_A1-wall_kN");
    const double open = time_of_opening(&collision, force);
    assert_near(value_at(&collision, x, open), 0.484693, 1e-5, 0.0);
    collision_free(&collision);
}

/* ---- stages in sequence, trains ---- */

/* Stage ends by the speed that is left: the energy of each stage fixes it, and the time at which
 * the car has slowed down to it is the end of the stage. */
static void sequence(const char *step, double tolerance) {
    Collision collision =
        collide("tests/physics/cases/sequence.yaml",
                WITH(OUTPUT_OF_100_US, step, "simulation.output_step_ms=0.01"), 0);
    assert_completed(&collision);
    const CzRunSummary *summary = collision.summary;
    const double *v = channel(&collision, "v_A1_m_s"), *x = channel(&collision, "x_A1_m");
    const double ends[][3] = {
        {0.045429, 6.263011, 0.30}, {0.048622, 6.263011, 0.32}, {0.102266, 4.921921, 0.62}};
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++) {
        assert_near(value_at(&collision, v, ends[i][0]), ends[i][1], tolerance, 0.0);
        assert_near(value_at(&collision, x, ends[i][0]), ends[i][2], tolerance, 0.0);
    }
    /* The end yields after 0.1 mm: half of that is lost to its plateau. */
    const double lost = 0.5 * 1e-4;
    assert_near(time_of_fall(&collision, v, NULL), 0.167891 + lost / 4.921921, tolerance, 0.0);
    assert_near(0.5 * summary->interface[0].shortening, 0.781502 + lost, tolerance, 0.0);
    assert_near(summary->interface[0].energy, 1929.012e3, tolerance, 0.0);
    collision_free(&collision);
}

static void coupler_gap_anti_climber_and_end_work_in_sequence(void **state) {
    (void)state;
    sequence("simulation.output_step_ms=0.1", 1e-3);
    sequence("simulation.time_step_ms=0.01", 1e-4);
}

/* Elastic stiffness delays the force of an interface that closes slowly, and the error falls with
 * its square root only. So three stiffnesses are run, each four times the last, and the outcome for
 * a rigid-plastic interface follows by extrapolation: f = f0 + a k^-1/2 + b / k + ... */
enum { MAX_OUTCOME = 24 };
typedef int Measure(const Collision *collision, double *outcome);

static int outcomes_of_rigid_plastic(const char *file, const char *const *stiffness_key, int n_key,
                                     const char *step, Measure *measure, double *outcome) {
    double with[3][MAX_OUTCOME];
    int n_outcome = 0;
    for (int i = 0; i < 3; i++) {
        static const int stiffness[] = {6250, 25000, 100000};
        char set[2][96];
        for (int key = 0; key < 2; key++)
            snprintf(set[key], sizeof set[key], "%s=%d", stiffness_key[key % n_key], stiffness[i]);
        Collision collision = collide(file, WITH(step, OUTPUT_OF_100_US, set[0], set[1]), 0);
        assert_completed(&collision);
        n_outcome = measure(&collision, with[i]);
        collision_free(&collision);
    }
    for (int i = 0; i < n_outcome; i++) {
        const double coarse = 2.0 * with[1][i] - with[0][i], fine = 2.0 * with[2][i] - with[1][i];
        outcome[i] = (4.0 * fine - coarse) / 3.0;
    }
    return n_outcome;
}

/* When the leading and when the rear car stop; crush and energy of both interfaces, energy of the
 * whole. */
static int measure_two(const Collision *collision, double *outcome) {
    const CzRunSummary *summary = collision->summary;
    assert_near(summary->energy.initial, 5760e3, 1e-12, 0.0);
    outcome[0] = time_on_line(collision, channel(collision, "v_A2_m_s"), NULL, 0.05, 0.25);
    outcome[1] = time_on_line(collision, channel(collision, "v_A1_m_s"), NULL, 0.05, 0.25);
    outcome[2] = summary->interface[1].shortening;
    outcome[3] = summary->interface[1].energy;
    outcome[4] = summary->interface[0].shortening;
    outcome[5] = summary->interface[0].energy;
    outcome[6] = summary->energy.dissipated;
    return 7;
}

static void two_into_wall(const char *step, double tolerance) {
    static const char *const keys[] = {
        "trains.A.vehicles.A1.front.anti_climber.stiffness_MN_m",
        "trains.A.vehicles.A2.front.anti_climber.stiffness_MN_m",
    };
    static const double expected[] = {0.266667, 0.400000, 1.6, 4800e3, 0.8, 960e3, 5760e3};
    double outcome[MAX_OUTCOME];
    const int n = outcomes_of_rigid_plastic("tests/physics/cases/two-into-wall.yaml", keys, 2, step,
                                            measure_two, outcome);
    for (int i = 0; i < n; i++)
        assert_near(outcome[i], expected[i], tolerance, 0.0);
}

static void two_cars_into_a_wall_stop_one_after_the_other(void **state) {
    (void)state;
    two_into_wall("simulation.output_step_ms=0.1", 1e-3);
    two_into_wall("simulation.time_step_ms=0.01", 1e-4);
}

/* Mean speed of the seven cars behind A8 less that of the seven behind B1; the caller frees it. */
static double *rear_closing_speed(const Collision *collision) {
    double *closing = calloc((size_t)n_sample(collision), sizeof *closing);
    assert_non_null(closing);
    for (int car = 1; car <= 7; car++) {
        char name[2][24];
        snprintf(name[0], sizeof name[0], "v_A%d_m_s", car);
        snprintf(name[1], sizeof name[1], "v_B%d_m_s", car + 1);
        const double *a = channel(collision, name[0]), *b = channel(collision, name[1]);
        for (int i = 0; i < n_sample(collision); i++)
            closing[i] += (a[i] - b[i]) / 7.0;
    }
    return closing;
}

/* When the two front cars and when all reach one speed, the closures, all energy, mean speed. */
static int measure_sixteen(const Collision *collision, double *outcome) {
    const CzRunSummary *summary = collision->summary;
    outcome[0] = time_on_line(collision, channel(collision, "v_A8_m_s"),
                              channel(collision, "v_B1_m_s"), 0.05, 0.19);
    double *closing = rear_closing_speed(collision);
    outcome[1] = time_on_line(collision, closing, NULL, 0.05, 1.3);
    free(closing);
    outcome[2] = outcome[3] = 0.0;
    for (int i = 0; i < 15; i++) {
        outcome[2] += summary->interface[i].energy;
        outcome[4 + i] = summary->interface[i].shortening;
    }
    for (int car = 0; car < 16; car++)
        outcome[3] += summary->vehicle[car].final_speed / 16.0;
    return 19;
}

static void eight_and_eight(const char *step, double tolerance) {
    static const char *const keys[] = {"parts.yielding.anti_climber.stiffness_MN_m"};
    static const double expected[] = {0.20625, 1.34750, 11550e3, 5.0};
    double outcome[MAX_OUTCOME];
    outcomes_of_rigid_plastic("tests/physics/cases/eight-and-eight.yaml", keys, 1, step,
                              measure_sixteen, outcome);
    for (int i = 0; i < 4; i++)
        assert_near(outcome[i], expected[i], tolerance, 0.0);
    for (int i = 0; i < 15; i++) {
        const double closed = i == 7 ? 1.03125 : i == 6 || i == 8 ? 2.853125 : 0.0;
        assert_near(outcome[4 + i], closed, tolerance, closed > 0.0 ? 0.0 : 1e-3);
    }
}

static void eight_cars_onto_eight_crush_at_three_interfaces(void **state) {
    (void)state;
    eight_and_eight("simulation.output_step_ms=0.1", 1e-3);
    eight_and_eight("simulation.time_step_ms=0.01", 1e-4);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_plateau_between_two_masses_follows_the_closed_form),
        cmocka_unit_test(crush_zones_in_series_follow_the_closed_form),
        cmocka_unit_test(an_elastic_and_plastic_spring_follows_the_closed_form),
        cmocka_unit_test(four_stages_and_two_stages_back_follow_the_closed_form),
        cmocka_unit_test(coupler_gap_anti_climber_and_end_work_in_sequence),
        cmocka_unit_test(two_cars_into_a_wall_stop_one_after_the_other),
        cmocka_unit_test(eight_cars_onto_eight_crush_at_three_interfaces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
