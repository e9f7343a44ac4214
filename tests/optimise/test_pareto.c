/* Fronts on a stand-in simulator, and their parts: a search from a given design, an objective and a
 * bound in place of those of the file. */
#include "support/check.h"

#include "crushzone/pareto.h"
#include "evaluate/stand_in.h"
#include "optimise/loopholes.h"

#define LENGTH "design.installed_length_mm"
#define FORCE "interfaces.peak_force_kN"

static const char sizing[] =
    "checks:\n"
    "  design_rules: false\n"
    "  limits: [{name: stroke, metric: elements.stroke_used, max: 0.9, scenarios: [crash]}]\n"
    "optimise:\n"
    "  subject_to: [stroke]\n"
    "  evaluations: 120\n"
    "  margin: 0.02\n"
    "  variables:\n"
    "    - {path: \"parts.anti-climber.stages[0].force_kN\", min: 300, max: 1300, increment: 10}\n"
    "    - {path: \"parts.anti-climber.stages[0].stroke_mm\", min: 100, max: 900, increment: 10}\n";

static CzParetoOptions options_for(const char *one, const char *other, int n_point) {
    CzParetoOptions options = cz_pareto_options_default();
    options.minimise[0] = one;
    options.minimise[1] = other;
    options.n_point = n_point;
    options.n_job = 1;
    options.search.verify_methods = 0;
    return options;
}

/* The margin is that of the strokes. */
static void shorter_devices_leave_less_margin(void **state) {
    (void)state;
    stand_in_reset();
    CzProblem *problem = small_problem(sizing);
    CzParetoOptions options = options_for(LENGTH, CZ_PARETO_MARGIN, 5);
    CzPareto *pareto;
    CzError error = {0};
    assert_int_equal(cz_pareto(problem, &options, &pareto, &error), CZ_OK);
    assert_int_equal(pareto->bounded, 1);
    const double first = pareto->point[0].value[1], last = pareto->point[4].value[1];
    assert_true(isnan(pareto->point[0].bound) && isnan(pareto->point[4].bound));
    assert_true(first >= 0.02 && first < last); /* the file requires a margin of 2 % */
    for (int i = 0; i < 5; i++) {
        const CzParetoPoint *point = &pareto->point[i];
        assert_int_equal(point->state, CZ_PARETO_VERIFIED);
        assert_near(point->violation, 0, 0, 0);
        if (i == 0 || i == 4)
            continue;
        assert_near(point->bound, first + (last - first) * i / 4, ROUNDING_OF_A_FORMULA, 0);
        assert_true(point->value[1] >= point->bound);
        assert_true(point->value[0] >= pareto->point[0].value[0]);
        assert_true(point->value[0] <= pareto->point[4].value[0]);
    }
    cz_pareto_free(pareto);
    cz_problem_free(problem);
}

static void failed_runs_fail_their_point_alone(void **state) {
    (void)state;
    stand_in_reset();
    stand_in.failing_above = 0; /* every run */
    CzProblem *problem = small_problem(sizing);
    CzParetoOptions options = options_for(CZ_PARETO_MARGIN, LENGTH, 3);
    CzPareto *pareto;
    CzError error = {0};
    assert_int_equal(cz_pareto(problem, &options, &pareto, &error), CZ_OK);
    assert_int_equal(pareto->bounded, 0);
    assert_int_equal(pareto->point[0].state, CZ_PARETO_FAILED);
    assert_int_equal(pareto->point[2].state, CZ_PARETO_FAILED);
    assert_int_equal(pareto->point[1].state, CZ_PARETO_NOT_RUN);
    assert_string_equal(pareto->point[1].why, "an end has no design that passes");
    assert_null(pareto->point[0].x);
    cz_pareto_free(pareto);
    cz_problem_free(problem);
    stand_in_reset();
}

static void search_begins_at_a_given_design(void **state) {
    (void)state;
    stand_in_reset();
    Case made = begin(sizing, 1);
    const double start[] = {640, 560};
    CzOptimiseOptions options = cz_optimise_options_default();
    options.start = start;
    options.verify_methods = 0;
    optimise(&made, &options);
    assert_memory_equal(made.outcome->start, start, sizeof start);
    assert_memory_equal(made.outcome->trial_x, start, sizeof start);
    end(&made);
}

/* The bound holds as it is, whatever margin the checks need. */
/* As of a front: the smallest margin that it reports contains these scenarios too. */
static void aimed_margin_holds_in_scenarios_without_reserves(void **state) {
    (void)state;
    stand_in_reset();
    static const char *const set[] = {"scenarios.crash.reserves=false"};
    CzProblem *problem;
    const CzAim aim = {.minimise = LENGTH, .margin = 0.05, .bound = NAN};
    CzEvaluatorOptions options = cz_evaluator_options_default();
    CzEvaluator *plain, *aimed;
    CzEvaluation with, without;
    CzError error = {0};
    assert_int_equal(small_problem_read(sizing, 1, set, &problem, &error), CZ_OK);
    assert_int_equal(cz_evaluator_build(problem, &options, &plain, &error), CZ_OK);
    options.aim = &aim;
    assert_int_equal(cz_evaluator_build(problem, &options, &aimed, &error), CZ_OK);
    assert_int_equal(cz_evaluate(plain, 1, NULL, false, &without, &error), CZ_OK);
    assert_int_equal(cz_evaluate(aimed, 1, NULL, false, &with, &error), CZ_OK);
    int n_bare = 0;
    for (int i = 0; i < with.n_constraint; i++) {
        const CzCheckResult *check = &with.constraint_check[i];
        if (strcmp(check->name, "stroke") != 0)
            continue;
        assert_near(with.constraint[i] - without.constraint[i], 0.05, ROUNDING_OF_A_FORMULA, 0);
        n_bare++;
    }
    assert_true(n_bare > 0);
    cz_evaluation_free(&with);
    cz_evaluation_free(&without);
    cz_evaluator_free(plain);
    cz_evaluator_free(aimed);
    cz_problem_free(problem);
}

static void aim_replaces_objective_and_adds_a_bound(void **state) {
    (void)state;
    stand_in_reset();
    CzProblem *problem = small_problem(sizing);
    const CzAim aim = {.minimise = FORCE, .margin = 0.05, .bounded = LENGTH, .bound = 5000};
    CzEvaluatorOptions options = cz_evaluator_options_default();
    CzEvaluator *plain, *aimed;
    CzEvaluation with, without;
    CzError error = {0};
    assert_int_equal(cz_evaluator_build(problem, &options, &plain, &error), CZ_OK);
    options.aim = &aim;
    assert_int_equal(cz_evaluator_build(problem, &options, &aimed, &error), CZ_OK);
    assert_string_equal(cz_evaluator_objective_name(aimed), FORCE);
    assert_int_equal(cz_evaluator_n_constraint(aimed), cz_evaluator_n_constraint(plain) + 1);
    assert_int_equal(cz_evaluate(plain, 1, NULL, false, &without, &error), CZ_OK);
    assert_int_equal(cz_evaluate(aimed, 1, NULL, false, &with, &error), CZ_OK);
    const CzCheckResult *bound = &with.constraint_check[with.n_constraint - 1];
    assert_string_equal(bound->name, LENGTH);
    assert_near(with.constraint[with.n_constraint - 1], -bound->margin, 0, 0);
    assert_near(with.constraint[0] - without.constraint[0], 0.05 - 0.02, ROUNDING_OF_A_FORMULA, 0);
    cz_evaluation_free(&with);
    cz_evaluation_free(&without);
    cz_evaluator_free(plain);
    cz_evaluator_free(aimed);
    cz_problem_free(problem);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shorter_devices_leave_less_margin),
        cmocka_unit_test(failed_runs_fail_their_point_alone),
        cmocka_unit_test(search_begins_at_a_given_design),
        cmocka_unit_test(aimed_margin_holds_in_scenarios_without_reserves),
        cmocka_unit_test(aim_replaces_objective_and_adds_a_bound),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
