/* Invalid runs fail, with place and time in words. */
#include "physics/collision.h"

/* Runs with a step given by the caller, above every bound. */
static Collision collide_with(const char *file, double step) {
    Collision collision = collision_model(file, WITH("simulation.track=rigid"), 0);
    CzSimulateOptions options = cz_simulate_options_default();
    options.time_step = step;
    CzError error = {0};
    if (cz_simulate(collision.model, &options, &collision.run, &error) != CZ_OK)
        fail_msg("%s", error.message);
    collision.summary = cz_run_summary(collision.run);
    return collision;
}

/* A failed run is incomplete, and has no number that could be mistaken for a result. */
static void assert_failed(const Collision *collision, const char *where, const char *what) {
    const CzRunSummary *summary = collision->summary;
    assert_int_equal(summary->status, CZ_STATUS_RUN_FAILED);
    assert_int_equal(summary->ended, CZ_ENDED_INCOMPLETE);
    if (strncmp(summary->failure, where, strlen(where)) != 0 ||
        strstr(summary->failure, what) == NULL)
        fail_msg("'%s' is not '%s ... %s'", summary->failure, where, what);
    assert_true(isnan(summary->energy.dissipated));
    assert_true(isnan(summary->energy.balance_error));
    assert_true(isnan(summary->interface[0].peak_force));
    assert_true(isnan(summary->interface[0].element[0].energy));
    assert_true(isnan(summary->vehicle[0].final_speed));
}

/* One and a half times the largest stable step multiplies the fastest motion by a few per step: the
 * error of the energy balance exceeds 1 % long before a number overflows. */
static void a_run_that_loses_its_energy_balance_fails(void **state) {
    (void)state;
    Collision collision =
        collision_model("problems/two-cars-25kmh.yaml", WITH("simulation.track=rigid"), 0);
    const double bound = cz_model_step_bound(collision.model, 0)->bound;
    collision_free(&collision);
    collision = collide_with("problems/two-cars-25kmh.yaml", 1.5 * bound);
    assert_failed(&collision, "A1: ", ": energy balance lost (most work here) at ");
    assert_null(strstr(collision.summary->failure, "_"));
    collision_free(&collision);
}

/* The square of the step is beyond the range of numbers. */
static void a_run_that_overflows_fails(void **state) {
    (void)state;
    Collision collision = collide_with("problems/two-cars-25kmh.yaml", 1e160);
    assert_failed(&collision, "A1: longitudinal motion of the body: not a finite number at ",
                  " ms");
    collision_free(&collision);
}

/* Superstructures that touch within one step and part again dissipate nothing, so that the error of
 * that step, here 5 J, is all of their energy. */
static void superstructures_that_barely_touch_do_not_fail_a_run(void **state) {
    (void)state;
    Collision collision = collide("tests/physics/cases/superstructures-touch.yaml",
                                  WITH("trains.A.speed_km_h=300"), 0);
    assert_string_equal(collision.summary->failure, "");
    collision_free(&collision);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_run_that_loses_its_energy_balance_fails),
        cmocka_unit_test(a_run_that_overflows_fails),
        cmocka_unit_test(superstructures_that_barely_touch_do_not_fail_a_run),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
