/* Criteria of standards as limits of runs: with parameters, in a search and in recorded runs. */
#include "support/check.h"

#include "evaluate/evaluator.h"
#include "evaluate/small_problem.h"

/* An evaluator of the small problem with further lines, and the evaluation of the file's design. */
typedef struct Case {
    CzProblem *problem;
    CzEvaluator *evaluator;
    CzEvaluation evaluation;
} Case;

static Case judge(const char *more, bool keep_runs) {
    Case made = {.problem = small_problem(more)};
    CzError error = {0};
    if (cz_evaluator_build(made.problem, NULL, &made.evaluator, &error) != CZ_OK)
        fail_msg("%s", error.message);
    assert_int_equal(cz_evaluate(made.evaluator, 1, NULL, keep_runs, &made.evaluation, &error),
                     CZ_OK);
    return made;
}

static void end(Case *made) {
    cz_evaluation_free(&made->evaluation);
    cz_evaluator_free(made->evaluator);
    cz_problem_free(made->problem);
}

static const CzCheckResult *find(const Case *made, const char *name, const char *scenario) {
    for (int i = 0; i < made->evaluation.n_check; i++)
        if (strcmp(made->evaluation.check[i].name, name) == 0 &&
            strcmp(made->evaluation.check[i].scenario, scenario) == 0)
            return &made->evaluation.check[i];
    fail_msg("there is no check %s", name);
    return NULL;
}

static const char pulses[] =
    "checks: {limits: [\n"
    "  {name: siv, metric: vehicles.siv_m_s(gap_m=0.75), max: 11},\n"
    "  {name: far, metric: vehicles.A1.siv_m_s(gap_m=9), max: 11},\n"
    "  {name: usual, metric: vehicles.mean_deceleration_sliding_g, max: 5},\n"
    "  {name: 120 ms, metric: vehicles.mean_deceleration_120ms_g, max: 5},\n"
    "  {name: short, metric: vehicles.mean_deceleration_sliding_g(window_ms=40).max, max: 5},\n"
    "  {name: contact, metric: vehicles.mean_deceleration_contact_g, max: 5},\n"
    "  {name: all, metric: \"vehicles.mean_deceleration_contact_g(floor=0.02, shortest_ms=0)\", "
    "max: 5},\n"
    "  {name: filtered, metric: vehicles.peak_deceleration_cfc60_g, max: 9}]}\n";

/* Two equal cars at 25 km/h: each changes its speed by half of it. */
static void a_limit_gives_the_parameters_of_its_metric(void **state) {
    (void)state;
    Case made = judge(pulses, true);
    const double change = 25 / 3.6 / 2;
    assert_in_range((long)(1e3 * find(&made, "far", "crash")->value), (long)(1e3 * change),
                    (long)(1.1e3 * change));
    assert_true(find(&made, "siv", "crash")->value <= find(&made, "far", "crash")->value);
    assert_true(find(&made, "siv", "crash")->when[0] > 0);
    assert_near(find(&made, "usual", "crash")->value, find(&made, "120 ms", "crash")->value, 0, 0);
    assert_true(find(&made, "short", "crash")->value > find(&made, "usual", "crash")->value);
    assert_true(find(&made, "all", "crash")->value >= find(&made, "contact", "crash")->value);
    assert_true(find(&made, "filtered", "crash")->value > find(&made, "short", "crash")->value);
    end(&made);
}

/* Runs that record nothing keep pulses only when a metric reads them. */
static void values_are_the_same_without_a_recording(void **state) {
    (void)state;
    Case recorded = judge(pulses, true), bare = judge(pulses, false);
    assert_int_equal(recorded.evaluation.n_check, bare.evaluation.n_check);
    for (int i = 0; i < bare.evaluation.n_check; i++) {
        const double value = recorded.evaluation.check[i].value;
        assert_int_equal(isnan(value), isnan(bare.evaluation.check[i].value));
        if (!isnan(value))
            assert_near(bare.evaluation.check[i].value, value, 0, 0);
    }
    end(&recorded);
    end(&bare);
}

static void a_search_has_values_of_pulses_as_objective_and_constraint(void **state) {
    (void)state;
    Case made = judge("checks: {limits: [{name: siv, metric: vehicles.siv_m_s(gap_m=0.6), max: "
                      "11}]}\n"
                      "optimise:\n"
                      "  minimise: vehicles.peak_deceleration_cfc60_g\n"
                      "  subject_to: [siv]\n"
                      "  variables: [{path: \"parts.tube.stages[0].force_kN\", min: 400, max: "
                      "1200}]\n",
                      false);
    const double x[] = {500, 1000};
    CzEvaluation evaluation[2];
    CzError error = {0};
    assert_int_equal(cz_evaluator_search(made.evaluator, 2, x, evaluation, NULL, &error), CZ_OK);
    for (int i = 0; i < 2; i++) {
        assert_true(isfinite(evaluation[i].objective) && isfinite(evaluation[i].constraint[0]));
        cz_evaluation_free(&evaluation[i]);
    }
    end(&made);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_limit_gives_the_parameters_of_its_metric),
        cmocka_unit_test(values_are_the_same_without_a_recording),
        cmocka_unit_test(a_search_has_values_of_pulses_as_objective_and_constraint),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
