/* A result of a search is verified, or the search has none: on the stand-in simulator, which
 * responds to the time step as a test wants. */
#include "support/check.h"

#include "crushzone/robust.h"
#include "evaluate/stand_in.h"
#include "optimise/loopholes.h"

/* The weaker the anti-climbers the better, as long as their stroke is used up to the limit at most.
 */
static const char sizing[] =
    "checks:\n"
    "  design_rules: false\n"
    "  limits: [{name: used, metric: elements.anti-climber *.stroke_used, max: %.9f, scenarios: "
    "[crash]}]\n"
    "optimise:\n"
    "  minimise: elements.anti-climber *.peak_force_kN\n"
    "  subject_to: [used]\n"
    "  evaluations: 60\n"
    "  variables:\n"
    "    - {path: \"parts.anti-climber.stages[0].force_kN\", min: 50, max: 700, increment: 10}\n";

static Case search_within(double limit) {
    char more[2048];
    snprintf(more, sizeof more, sizing, limit);
    Case made = begin(more, 2);
    optimise(&made, NULL);
    return made;
}

static Case search(void) {
    return search_within(0.9);
}

static double best_force(void) {
    Case made = search();
    const double force = made.outcome->best[0];
    assert_int_equal(made.outcome->status, CZ_OUTCOME_FEASIBLE);
    assert_int_equal(made.outcome->verification->verdict, CZ_VERDICT_PASS);
    end(&made);
    return force;
}

static void design_that_is_not_verified_is_not_the_best(void **state) {
    (void)state;
    stand_in_reset();
    const double force = best_force();
    stand_in.unsteady_below = (force + 15) * 1e3; /* it, and the next one */
    Case made = search();
    const CzOutcome *outcome = made.outcome;
    assert_int_equal(outcome->status, CZ_OUTCOME_FEASIBLE);
    assert_int_equal(outcome->verification->verdict, CZ_VERDICT_PASS);
    assert_true(outcome->best[0] * 1e3 >= stand_in.unsteady_below);
    assert_true(outcome->best_evaluation.violation <= 0);
    assert_true(outcome->n_rejected > 0);
    assert_near(outcome->rejected[0].x[0], force, 0, 0);
    assert_int_equal(outcome->rejected[0].method, CZ_METHOD_HALF_STEP);
    assert_true(outcome->rejected[0].value.change[CZ_METHOD_HALF_STEP] > 0.01);
    assert_true(outcome->rejected[0].objective < outcome->best_evaluation.objective);
    assert_non_null(strstr(outcome->why_stopped, "with a better objective not verified"));
    end(&made);
}

static void without_a_verified_design_there_is_no_success(void **state) {
    (void)state;
    stand_in_reset();
    const double force = best_force();
    stand_in.unsteady_below = INFINITY;
    Case made = search();
    const CzOutcome *outcome = made.outcome;
    assert_int_equal(outcome->status, CZ_OUTCOME_UNVERIFIED);
    assert_string_equal(cz_outcome_text(outcome->status), "unverified");
    assert_int_equal(outcome->verification->verdict, CZ_VERDICT_FAIL);
    assert_near(outcome->best[0], force, 0, 0);
    assert_true(outcome->n_rejected > 1);
    assert_true(outcome->n_evaluation <= 60);
    end(&made);
}

/* The halved time step changes the use of a stroke by less than a verification allows, but by more
 * than the best design has left. */
static void change_of_a_verdict_becomes_a_required_margin(void **state) {
    (void)state;
    stand_in_reset();
    Case made = search();
    const CzCheckResult *used = find(&made.outcome->best_evaluation, "used", "crash");
    const double force = made.outcome->best[0], limit = used->value * (1 + 1e-4);
    end(&made);
    stand_in.step_energy = 3e-4;
    made = search_within(limit);
    const CzOutcome *outcome = made.outcome;
    assert_int_equal(outcome->status, CZ_OUTCOME_FEASIBLE);
    assert_int_equal(outcome->verification->verdict, CZ_VERDICT_PASS);
    assert_int_equal(outcome->n_rejected, 1);
    const CzRejected *rejected = &outcome->rejected[0];
    assert_true(rejected->value.flips[rejected->method]);
    assert_true(rejected->value.change[rejected->method] < 0.01);
    assert_near(rejected->x[0], force, 0, 0);
    used = find(&outcome->best_evaluation, "used", "crash");
    assert_true(used->margin >= rejected->value.change[rejected->method]);
    end(&made);
}

/* The designs on the increments of 200 kN are refused, the start between them is not. */
static void verified_design_between_the_increments_is_given_and_reported(void **state) {
    (void)state;
    char more[2048];
    const char *set[] = {"parts.anti-climber.stages[0].force_kN=480"};
    CzProblem *problem = NULL;
    CzError error = {0};
    stand_in_reset();
    snprintf(more, sizeof more, sizing, 0.9);
    memcpy(strstr(more, "max: 700, increment: 10"), "max: 490,increment: 200", 23);
    assert_int_equal(small_problem_read(more, 1, set, &problem, &error), CZ_OK);
    stand_in.unsteady_below = 450e3;
    Case made = begin_with(problem, 2);
    optimise(&made, NULL);
    const CzOutcome *outcome = made.outcome;
    assert_int_equal(outcome->status, CZ_OUTCOME_FEASIBLE);
    assert_true(outcome->best[0] >= 450);
    assert_near(outcome->rejected[0].x[0], 200, 0, 0);
    assert_non_null(strstr(outcome->why_stopped, "between catalogue increments"));
    end(&made);
}

/* With many scenarios a quarter of the evaluations is left for a design that is not verified. */
static Case search_many(void) {
    char more[2048];
    CzProblem *problem = NULL;
    CzError error = {0};
    const int n = snprintf(more, sizeof more, "  - {name: many, sweep: {speed_km_h: 6:25:20}}\n");
    snprintf(more + n, sizeof more - (size_t)n, sizing, 0.9);
    memcpy(strstr(more, "increment: 10}"), "increment: 0.5}", 15);
    assert_int_equal(small_problem_read(more, 0, NULL, &problem, &error), CZ_OK);
    Case made = begin_with(problem, 2);
    optimise(&made, NULL);
    return made;
}

static void evaluations_are_left_for_a_design_that_is_not_verified(void **state) {
    (void)state;
    stand_in_reset();
    Case made = search_many();
    assert_int_equal(made.outcome->status, CZ_OUTCOME_FEASIBLE);
    const double force = made.outcome->best[0];
    assert_true(made.outcome->n_evaluation <= 45);
    assert_non_null(
        strstr(made.outcome->why_stopped, "reserved for designs that are not verified"));
    end(&made);
    stand_in.unsteady_below = (force + 5) * 1e3;
    made = search_many();
    assert_true(made.outcome->n_evaluation > 45);
    assert_int_equal(made.outcome->status, CZ_OUTCOME_FEASIBLE);
    end(&made);
}

static CzRobust *search_robust(CzProblem **problem) {
    char more[2048];
    CzRobust *robust = NULL;
    CzError error = {0};
    const int n = snprintf(more, sizeof more, sizing, 0.9);
    snprintf(more + n, sizeof more - (size_t)n,
             "uncertainty:\n"
             "  samples: 8\n"
             "  parameters: [{path: 'trains.*.vehicles.*.mass_t', tolerance_percent: 5}]\n");
    *problem = small_problem(more);
    if (cz_optimise_robust(*problem, NULL, NULL, &robust, &error) != CZ_OK)
        fail_msg("%s", error.message);
    return robust;
}

/* The next best design is one that was met in a round, and holds in all samples. */
static void a_design_against_scatter_that_is_not_verified_is_not_the_best(void **state) {
    (void)state;
    CzProblem *problem;
    stand_in_reset();
    CzRobust *robust = search_robust(&problem);
    const double force = robust->outcome->best[0];
    assert_int_equal(robust->outcome->status, CZ_OUTCOME_FEASIBLE);
    assert_int_equal(robust->outcome->n_rejected, 0);
    cz_robust_free(robust);
    cz_problem_free(problem);
    stand_in.unsteady_below = (force + 5) * 1e3;
    robust = search_robust(&problem);
    const CzOutcome *outcome = robust->outcome;
    assert_int_equal(outcome->status, CZ_OUTCOME_FEASIBLE);
    assert_int_equal(outcome->verification->verdict, CZ_VERDICT_PASS);
    assert_true(outcome->best[0] > force);
    assert_true(outcome->n_rejected > 0);
    assert_near(outcome->rejected[0].x[0], force, 0, 0);
    assert_int_equal(robust->sampling->passing.n_pass, 8);
    assert_true(robust->round[robust->n_round - 1].is_best);
    assert_int_equal(robust->round[robust->n_round - 1].n_evaluation, 0);
    assert_non_null(strstr(outcome->why_stopped, "with a better objective not verified"));
    cz_robust_free(robust);
    cz_problem_free(problem);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(design_that_is_not_verified_is_not_the_best),
        cmocka_unit_test(without_a_verified_design_there_is_no_success),
        cmocka_unit_test(change_of_a_verdict_becomes_a_required_margin),
        cmocka_unit_test(a_design_against_scatter_that_is_not_verified_is_not_the_best),
        cmocka_unit_test(evaluations_are_left_for_a_design_that_is_not_verified),
        cmocka_unit_test(verified_design_between_the_increments_is_given_and_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
