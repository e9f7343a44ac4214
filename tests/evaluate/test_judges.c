/* Scenarios that name the checks by which they are judged: beyond the design speed strokes may be
 * exhausted, which must not relax the checks up to it. */
#include "support/check.h"

#include "evaluate/evaluator.h"
#include "evaluate/judged_problem.h"
#include "evaluate/small_problem.h"
#include "evaluate/stand_in.h"

static const char fast[] =
    "  - {name: fast, speed_km_h: 40, judged_by: [force, stroke used]}\n"
    "checks: {limits: [{name: force, metric: interfaces.peak_force_kN, max: "
    "9000},\n"
    "  {name: named, metric: interfaces.peak_force_kN, max: 9000, scenarios: "
    "[fast]}]}\n";

static Case judge(const char *more) {
    stand_in_reset();
    return judged(small_problem(more), false);
}

static void only_the_named_checks_and_limits_that_name_it_judge_a_scenario(void **state) {
    (void)state;
    Case made = judge(fast);
    assert_non_null(find(&made, "force", "fast"));
    assert_non_null(find(&made, "stroke used", "fast"));
    assert_non_null(find(&made, "named", "fast"));
    int n = 0;
    for (int i = 0; i < made.evaluation.n_check; i++)
        n += strcmp(made.evaluation.check[i].scenario, "fast") == 0;
    assert_int_equal(n, 3);
    assert_non_null(find(&made, "bottoming out", "crash")); /* other scenarios have all checks */
    end(&made);
}

/* 25 km/h is the largest speed that every check judges: its overload covers it, and 40 km/h
 * requires none. */
static void a_scenario_with_selected_checks_is_not_a_design_speed(void **state) {
    (void)state;
    Case made = judge(fast);
    assert_null(find(&made, "bottoming out under overload", "design"));
    assert_non_null(find(&made, "bottoming out under overload", "overload"));
    end(&made);
    made = judge("  - {name: fast, speed_km_h: 40}\n");
    assert_int_equal(find(&made, "bottoming out under overload", "design")->verdict,
                     CZ_VERDICT_NOT_CHECKED);
    end(&made);
}

#define LEVEL_CROSSING                                                                             \
    "schema: 1\n"                                                                                  \
    "title: a car, another, and an obstacle\n"                                                     \
    "parts:\n"                                                                                     \
    "  end: {face_gap_mm: 0, unloading_stiffness_MN_m: 600, stages: [{stroke_mm: 5, force_MN: "    \
    "3}]}\n"                                                                                       \
    "trains:\n"                                                                                    \
    "  - {name: A, vehicles: [{name: A1, model: rigid, mass_t: 40, front: {use: end}}]}\n"         \
    "  - {name: B, vehicles: [{name: B1, model: rigid, mass_t: 40, rear: {use: end}}]}\n"          \
    "  - {name: O, role: obstacle, vehicles: [{name: O1, model: rigid, mass_t: 15, rear: {use: "   \
    "end}}]}\n"                                                                                    \
    "scenarios:\n"

/* The speed onto an obstacle is that of a level crossing: neither an overload case nor a speed
 * between service and design speed follows from it, unless there is no other partner. */
static void the_speed_onto_an_obstacle_is_no_design_speed_beside_another_train(void **state) {
    (void)state;
    Case made = {0};
    CzError error = {0};
    static const char *const scenarios[] = {
        "  - {name: crash, speed_km_h: 25}\n"
        "  - {name: crossing, trains: [A, O], speed_km_h: 90}\n"
        "  - {name: overload, speed_km_h: 27.5, mass_factor: 1.1}\n",
        "  - {name: crash, speed_km_h: 25}\n"
        "  - {name: overload, trains: [A, O], speed_km_h: 99, mass_factor: 1.1}\n",
        "  - {name: crossing, trains: [A, O], speed_km_h: 90}\n"
        "  - {name: overload, trains: [A, O], speed_km_h: 99, mass_factor: 1.1}\n",
        "  - {name: crossing, trains: [A, O], speed_km_h: 90}\n"
        "  - {name: overload, trains: [A, O], speed_km_h: 27.5, mass_factor: 1.1}\n",
    };
    static const bool is_covered[] = {true, false, true, false};
    for (int i = 0; i < 4; i++) {
        stand_in_reset();
        made.problem = problem_of_text(LEVEL_CROSSING, scenarios[i]);
        assert_int_equal(cz_evaluator_build(made.problem, NULL, &made.evaluator, &error), CZ_OK);
        assert_int_equal(cz_evaluate(made.evaluator, 1, NULL, false, &made.evaluation, &error),
                         CZ_OK);
        assert_int_equal(find(&made, "bottoming out under overload", "design") == NULL,
                         is_covered[i]);
        end(&made);
        made = (Case){0};
    }
}

/* The objective belongs to the design case: a scenario beyond the design speed does not count. */
static void the_objective_leaves_out_a_scenario_with_selected_checks(void **state) {
    (void)state;
    static const char objective[] = "%s"
                                    "optimise:\n"
                                    "  minimise: elements.coupler *.energy_kJ\n"
                                    "  variables: [{path: \"parts.tube.stages[0].force_kN\", min: "
                                    "400, max: 1500}]\n";
    char more[1024];
    snprintf(more, sizeof more, objective, "");
    Case without = judge(more);
    snprintf(more, sizeof more, objective, fast);
    Case with = judge(more);
    assert_near(with.evaluation.objective, without.evaluation.objective, 0, 0);
    end(&without);
    end(&with);
}

/* A rule that is left out in every scenario does not pass. */
static void a_rule_that_judges_nowhere_is_not_checked(void **state) {
    (void)state;
    static const char text[] =
        "schema: 1\n"
        "title: one scenario, one judge\n"
        "parts:\n"
        "  end: {face_gap_mm: 0, unloading_stiffness_MN_m: 600, stages: [{stroke_mm: 500, "
        "force_MN: 3}]}\n"
        "trains:\n"
        "  - {name: A, vehicles: [{name: A1, model: rigid, mass_t: 40, front: {use: end}}]}\n"
        "  - {name: B, vehicles: [{name: B1, model: rigid, mass_t: 40, rear: {use: end}}]}\n"
        "scenarios:\n"
        "  - {name: crash, speed_km_h: 25, judged_by: [stroke used]}\n";
    stand_in_reset();
    Case made = {.problem = problem_of_text(text, "")};
    CzError error = {0};
    if (cz_evaluator_build(made.problem, NULL, &made.evaluator, &error) != CZ_OK)
        fail_msg("%s", error.message);
    assert_int_equal(cz_evaluate(made.evaluator, 1, NULL, false, &made.evaluation, &error), CZ_OK);
    const CzCheckResult *left_out = find(&made, "energy in survival space", "design");
    assert_non_null(left_out);
    assert_int_equal(left_out->verdict, CZ_VERDICT_NOT_CHECKED);
    assert_string_equal(left_out->why, "no scenario lists it in judged_by");
    assert_non_null(find(&made, "stroke used", "crash"));
    assert_int_not_equal(made.evaluation.verdict, CZ_VERDICT_PASS);
    end(&made);
}

static void an_unknown_check_in_judged_by_is_refused_with_its_place(void **state) {
    (void)state;
    CzError error = {0};
    CzEvaluator *evaluator = NULL;
    CzProblem *problem =
        small_problem("  - {name: fast, speed_km_h: 40, judged_by: [stroke usd]}\n");
    assert_int_equal(cz_evaluator_build(problem, NULL, &evaluator, &error), CZ_STATUS_INPUT);
    assert_string_equal(error.message, "judged_by: there is no check 'stroke usd'");
    assert_string_equal(error.help, "did you mean 'stroke used'?");
    assert_true(error.line > 0);
    cz_problem_free(problem);
}

static void a_family_alone_can_be_run(void **state) {
    (void)state;
    CzProblem *problem = small_problem(
        "  - {name: head, sweep: {speed_km_h: [10, 30]}, judged_by: [stroke used]}\n");
    CzEvaluatorOptions options = cz_evaluator_options_default();
    options.scenario = "head";
    CzEvaluator *evaluator = NULL;
    CzEvaluation evaluation;
    CzError error = {0};
    stand_in_reset();
    assert_int_equal(cz_evaluator_build(problem, &options, &evaluator, &error), CZ_OK);
    assert_int_equal(cz_evaluate(evaluator, 1, NULL, true, &evaluation, &error), CZ_OK);
    assert_int_equal(evaluation.n_run, 2);
    Case made = {.evaluation = evaluation};
    assert_int_not_equal(find(&made, "stroke used", "head_10km_h")->verdict,
                         CZ_VERDICT_NOT_CHECKED);
    assert_string_equal(find(&made, "stroke used", "crash")->why, "this scenario was not run");
    cz_evaluation_free(&evaluation);
    cz_evaluator_free(evaluator);
    cz_problem_free(problem);
}

/* The distance of series chains from their laws can be limited like the energy balance.
 */
static void the_distance_from_the_laws_can_be_judged(void **state) {
    (void)state;
    Case made =
        judge("checks: {limits: [{name: laws, metric: law_error, max: 0.001}, {name: laws too, "
              "metric: law_error, max: 0.004}]}\n");
    const CzCheckResult *broken = find(&made, "laws", "crash");
    assert_non_null(broken);
    assert_near(broken->value, 2e-3, 1e-15, 0);
    assert_near(broken->margin, -1, 1e-12, 0); /* of the limit, which is above the scale of 1e-4 */
    assert_int_equal(broken->verdict, CZ_VERDICT_FAIL);
    assert_near(find(&made, "laws too", "crash")->margin, 0.5, 1e-12, 0);
    end(&made);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_the_named_checks_and_limits_that_name_it_judge_a_scenario),
        cmocka_unit_test(a_scenario_with_selected_checks_is_not_a_design_speed),
        cmocka_unit_test(the_speed_onto_an_obstacle_is_no_design_speed_beside_another_train),
        cmocka_unit_test(the_objective_leaves_out_a_scenario_with_selected_checks),
        cmocka_unit_test(a_rule_that_judges_nowhere_is_not_checked),
        cmocka_unit_test(an_unknown_check_in_judged_by_is_refused_with_its_place),
        cmocka_unit_test(a_family_alone_can_be_run),
        cmocka_unit_test(the_distance_from_the_laws_can_be_judged),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
