/* Refusals of an evaluator: invalid variables, bounds and limits, each with its place. */
#include "support/check.h"

#include "evaluate/small_problem.h"
#include "evaluate/evaluator.h"

/* Reading or building must fail with a place and a sentence that contains these words. */
static void expect_refusal(const char *more, const char *words) {
    CzError error = {0};
    CzEvaluator *evaluator = NULL;
    CzProblem *problem = NULL;
    CzStatus status = small_problem_read(more, 0, NULL, &problem, &error);
    if (status == CZ_OK)
        status = cz_evaluator_build(problem, NULL, &evaluator, &error);
    assert_int_equal(status, CZ_STATUS_INPUT);
    assert_null(evaluator);
    if (strstr(error.message, words) == NULL)
        print_error("'%s' lacks '%s'\n", error.message, words);
    assert_non_null(strstr(error.message, words));
    assert_true(error.line > 0);
    cz_problem_free(problem);
}

static void a_variable_of_fixed_data_is_refused_by_name(void **state) {
    (void)state;
    expect_refusal(
        "optimise: {variables: [{path: parts.head.proof_strength_kN, min: 1, max: 9}]}\n",
        "cannot be a design variable");
    expect_refusal(
        "optimise: {variables: [{path: trains.A.vehicles.A1.mass_t, min: 1, max: 90}]}\n",
        "cannot be a design variable");
    expect_refusal("optimise: {variables: [{path: parts.tube.stagse, min: 1, max: 9}]}\n", "path");
}

static void softening_the_opponent_is_refused(void **state) {
    (void)state;
    expect_refusal(
        "optimise: {variables: [{path: \"trains.B.vehicles.B1.rear.coupler.tube.stages[0]"
        ".force_kN\", min: 400, max: 900}]}\n",
        "a softer partner does not improve");
    expect_refusal(
        "optimise: {variables: [{path: \"trains.A.vehicles.A1.front.coupler.tube.stages[0]"
        ".force_kN\", min: 400, max: 900}]}\n",
        "counterpart");
}

static void bounds_and_starts_that_do_not_fit_are_refused(void **state) {
    (void)state;
    expect_refusal("optimise: {variables: [{path: \"parts.tube.stages[0].force_kN\", min: 900, "
                   "max: 400}]}\n",
                   "above max");
    expect_refusal("optimise: {variables: [{path: \"parts.tube.stages[0].force_kN\", min: 400, "
                   "max: 1400}, {path: \"parts.tube.stages[0].force_kN\", min: 400, max: 1400}]}\n",
                   "two variables");
}

static void parameters_that_a_metric_does_not_have_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *metric, *words;
    } wrong[] = {
        {"vehicles.siv_m_s", "needs its free-flight distance"},
        {"vehicles.siv_m_s(gap_mm=600)", "has no parameter 'gap_mm'"},
        {"vehicles.siv_m_s(gap_m=x)", "'gap_m=x' is not a parameter and its number"},
        {"vehicles.siv_m_s(0.6)", "'0.6' is not a parameter and its number"},
        {"vehicles.siv_m_s(gap_m=0)", "gap_m of vehicles.siv_m_s must be from 0.001 to 10"},
        {"vehicles.siv_m_s(gap_m=0.6", "no metric 'vehicles.siv_m_s(gap_m=0.6'"},
        {"interfaces.peak_force_kN(window_ms=1)", "has no parameter 'window_ms'"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        char more[256];
        snprintf(more, sizeof more, "checks: {limits: [{name: a, metric: \"%s\", max: 1}]}\n",
                 wrong[i].metric);
        expect_refusal(more, wrong[i].words);
    }
}

static void limits_of_unknown_metrics_are_refused(void **state) {
    (void)state;
    expect_refusal("checks: {limits: [{name: a, metric: interfaces.peak_force, max: 1}]}\n",
                   "no metric 'interfaces.peak_force'");
    expect_refusal("checks: {limits: [{name: a, metric: interfaces.C1-*.peak_force_kN, max: 1}]}\n",
                   "matches no place");
    expect_refusal("checks: {limits: [{name: a, metric: interfaces.peak_force_kN, max: 1, "
                   "scenarios: [crush]}]}\n",
                   "no scenario 'crush'");
    expect_refusal("checks: {limits: [{name: a, metric: interfaces.peak_force_kN}]}\n",
                   "'max' and 'min'");
    expect_refusal("optimise: {subject_to: [nothing], variables: [{path: "
                   "\"parts.tube.stages[0].force_kN\", min: 400, max: 1400}]}\n",
                   "no check 'nothing'");
}

static void one_name_is_one_check_and_one_override(void **state) {
    (void)state;
    expect_refusal("checks: {limits: [{name: stroke used, metric: interfaces.peak_force_kN, max: "
                   "1}]}\n",
                   "there is a design rule 'stroke used'");
    expect_refusal("checks: {override: {stroke usd: {max: 1}}}\n",
                   "no limit, scenario or design rule 'stroke usd'");
    expect_refusal("checks: {override: {stroke used: {min: 1}}}\n",
                   "design rule 'stroke used' is an upper limit: write 'max'");
    expect_refusal("checks: {design_rules: false, override: {stroke used: {max: 1}}}\n",
                   "no limit, scenario or design rule 'stroke used'");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_variable_of_fixed_data_is_refused_by_name),
        cmocka_unit_test(softening_the_opponent_is_refused),
        cmocka_unit_test(bounds_and_starts_that_do_not_fit_are_refused),
        cmocka_unit_test(limits_of_unknown_metrics_are_refused),
        cmocka_unit_test(one_name_is_one_check_and_one_override),
        cmocka_unit_test(parameters_that_a_metric_does_not_have_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
