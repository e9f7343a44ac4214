/* Budgets: the sources that act on a body add up to its momenta, for every car of every run. */
#include "physics/collision.h"

/* The impulses are a sum by rectangles, which differs from the velocities of the scheme by half a
 * step of the last force: some thousandths of the impulse of the largest source over a third of a
 * second, and a tenth of that with a tenth of the step. */
static void assert_closes(const CzVehicleBudget *budget, const char *name, double share) {
    double spin = 0.0, rise = 0.0, largest_spin = 0.0, largest_rise = 0.0;
    for (int source = 0; source < CZ_N_BUDGET; source++) {
        if (!cz_budget_counts((CzBudgetSource)source))
            continue;
        spin += budget->moment[source];
        rise += budget->lift[source];
        largest_spin = fmax(largest_spin, fabs(budget->moment[source]));
        largest_rise = fmax(largest_rise, fabs(budget->lift[source]));
    }
    if (getenv("CZ_TOL_SCALE") != NULL)
        print_message("%s at %.3f s: spin %g of %g, rise %g of %g\n", name, budget->time,
                      spin - budget->spin, largest_spin, rise - budget->rise, largest_rise);
    assert_true(largest_spin > 0.0);
    assert_near(spin, budget->spin, 0.0, share * largest_spin);
    assert_near(rise, budget->rise, 0.0, share * largest_rise);
}

static void check_all(const char *file, const char *const *settings, double share) {
    Collision run = collide(file, settings, 0);
    assert_completed(&run);
    assert_non_null(run.summary->budget);
    for (int i = 0; i < run.summary->n_vehicle; i++)
        assert_closes(&run.summary->budget[i], run.summary->vehicle[i].name, share);
    collision_free(&run);
}

static void sources_add_up_to_the_momenta_of_every_body(void **state) {
    (void)state;
    check_all("tests/physics/cases/offset-collision.yaml",
              WITH("simulation.duration_s=0.4", "simulation.time_step_ms=0.1"), 5e-3);
}

static void the_error_of_the_budget_falls_with_the_step(void **state) {
    (void)state;
    check_all("tests/physics/cases/offset-collision.yaml",
              WITH("simulation.duration_s=0.4", "simulation.time_step_ms=0.01"), 5e-4);
}

/* The bits of a run do not depend on whether its budget is recorded. */
static void recording_a_budget_changes_no_result(void **state) {
    (void)state;
    const char *const *settings = WITH("simulation.duration_s=0.3");
    Collision noted = collide("tests/physics/cases/offset-collision.yaml", settings, 0);
    CzSimulateOptions options = cz_simulate_options_default();
    options.record = false;
    CzRun *run = NULL;
    CzError error = {0};
    assert_int_equal(cz_simulate(noted.model, &options, &run, &error), CZ_OK);
    const CzRunSummary *plain = cz_run_summary(run);
    assert_null(plain->budget);
    for (int i = 0; i < plain->n_vehicle; i++)
        assert_near(plain->vehicle[i].max_pitch, noted.summary->vehicle[i].max_pitch, 0.0, 0.0);
    assert_near(plain->energy.dissipated, noted.summary->energy.dissipated, 0.0, 0.0);
    cz_run_free(run);
    collision_free(&noted);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sources_add_up_to_the_momenta_of_every_body),
        cmocka_unit_test(the_error_of_the_budget_falls_with_the_step),
        cmocka_unit_test(recording_a_budget_changes_no_result),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
