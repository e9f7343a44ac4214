/* How results depend on the time step, and how well the energy books of shipped problems close. */
#include "physics/collision.h"

/* Runs a scenario with a step of its own. */
static Collision collide_with(const char *file, int scenario, double step) {
    Collision collision = collision_model(file, AS_WRITTEN, scenario);
    CzSimulateOptions options = cz_simulate_options_default();
    options.time_step = step;
    CzError error = {0};
    if (cz_simulate(collision.model, &options, &collision.run, &error) != CZ_OK)
        fail_msg("%s", error.message);
    collision.summary = cz_run_summary(collision.run);
    return collision;
}

/* Two masses of 40 t and 20 MN/m: x_A - 5 t = 5 sin(w t) / w, v_A = 5 + 5 cos(w t), w^2 = k / mu;
 * after half a period they have exchanged their speeds. */
static double error_at_80_ms(double step) {
    Collision elastic = collide_with("tests/physics/cases/elastic.yaml", 0, step);
    assert_completed(&elastic);
    const double w = sqrt(20e6 / 20e3);
    const double truth = 5.0 + 5.0 * cos(w * 0.08);
    const double error = fabs(elastic.summary->vehicle[0].final_speed - truth);
    collision_free(&elastic);
    return error;
}

static void an_elastic_collision_converges_with_the_square_of_the_step(void **state) {
    (void)state;
    for (double step = 1e-3; step > 1.2e-4; step *= 0.5)
        assert_near(log2(error_at_80_ms(step) / error_at_80_ms(0.5 * step)), 2.0, 0.0, 0.1);
}

static void an_elastic_collision_exchanges_the_speeds(void **state) {
    (void)state;
    Collision elastic =
        collide("tests/physics/cases/elastic.yaml",
                WITH("simulation.duration_ms=200", "simulation.time_step_ms=0.01"), 0);
    assert_completed(&elastic);
    assert_near(elastic.summary->vehicle[0].final_speed, 0.0, 0.0, 1e-4);
    assert_near(elastic.summary->vehicle[1].final_speed, 10.0, 1e-5, 0.0);
    assert_near(elastic.summary->energy.dissipated, 0.0, 0.0,
                1e-5 * elastic.summary->energy.initial);
    collision_free(&elastic);
}

/* What yields at first contact costs half a step of its force, so shipped problems converge with
 * the step itself; where a change is below a few parts in ten thousand already, its order says
 * nothing. */
enum { N_VALUE = 3 };

static void values_at(const char *file, double step, double *value) {
    Collision collision = collide_with(file, 0, step);
    assert_completed(&collision);
    const int at = cz_model_colliding_interface(collision.model);
    value[0] = collision.summary->interface[at].shortening;
    value[1] = collision.summary->energy.dissipated;
    value[2] = collision.summary->vehicle[0].max_pitch;
    collision_free(&collision);
}

static void shipped_problems_converge_with_the_step(void **state) {
    (void)state;
    static const char *const files[] = {"problems/first-collision.yaml",
                                        "problems/two-cars-25kmh.yaml", "problems/wall.yaml"};
    for (int file = 0; file < 3; file++) {
        double coarse[N_VALUE], middle[N_VALUE], fine[N_VALUE];
        values_at(files[file], 1e-4, coarse);
        values_at(files[file], 4e-5, middle);
        values_at(files[file], 1.6e-5, fine);
        for (int i = 0; i < N_VALUE; i++) {
            const double order =
                log(fabs(coarse[i] - middle[i]) / fabs(middle[i] - fine[i])) / log(2.5);
            if (getenv("CZ_TOL_SCALE") != NULL)
                print_message("%s: value %d: order %g, changes by %g\n", files[file], i, order,
                              fabs(coarse[i] - fine[i]) / fabs(fine[i]));
            assert_true(order > 0.9 || fabs(coarse[i] - fine[i]) < 3e-4 * fabs(fine[i]));
            assert_near(coarse[i], fine[i], 1e-3, 0.0);
        }
    }
}

static void the_books_of_shipped_problems_close(void **state) {
    (void)state;
    static const char *const files[] = {"problems/first-collision.yaml",
                                        "problems/two-cars-25kmh.yaml",
                                        "problems/wall.yaml",
                                        "problems/wagon.yaml",
                                        "problems/buffer-stop.yaml",
                                        "problems/metro-6-car.yaml"};
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        Collision first = collision_model(files[i], AS_WRITTEN, 0);
        const int n = cz_problem_n_scenario(first.problem);
        collision_free(&first);
        for (int scenario = 0; scenario < n; scenario++) {
            Collision collision = collide_with(files[i], scenario, 0.0);
            assert_completed(&collision);
            const CzEnergy *energy = &collision.summary->energy;
            if (getenv("CZ_TOL_SCALE") != NULL)
                print_message("%s, %s: balance %.2g, momentum %.2g\n", files[i],
                              collision.summary->scenario, energy->balance_error,
                              collision.summary->momentum_error);
            assert_near(energy->balance_error, 0.0, 0.0, 1e-4);
            assert_near(collision.summary->momentum_error, 0.0, 0.0, 1e-9);
            assert_near(energy->final_kinetic + energy->dissipated + energy->stored,
                        energy->initial, 1e-4, 0.0);
            collision_free(&collision);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_elastic_collision_converges_with_the_square_of_the_step),
        cmocka_unit_test(an_elastic_collision_exchanges_the_speeds),
        cmocka_unit_test(shipped_problems_converge_with_the_step),
        cmocka_unit_test(the_books_of_shipped_problems_close),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
