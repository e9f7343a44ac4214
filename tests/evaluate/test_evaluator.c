/* The evaluator on a stand-in simulator: margins, verdicts, constraints, failures, repetition. */
#include "support/check.h"

#include "evaluate/small_problem.h"
#include "evaluate/stand_in.h"
#include "evaluate/evaluator.h"

static const char variables[] =
    "optimise:\n"
    "  variables:\n"
    "    - {path: \"parts.tube.stages[0].force_kN\", min: 400, max: 1500}\n"
    "    - {path: \"parts.anti-climber.stages[0].force_kN\", min: 100, max: 900, increment: 50}\n";

typedef struct Case {
    CzProblem *problem;
    CzEvaluator *evaluator;
    CzEvaluation evaluation;
} Case;

static Case begin(const char *more) {
    Case made = {0};
    CzError error = {0};
    stand_in_reset();
    made.problem = small_problem(more);
    const CzEvaluatorOptions options = {.n_job = 2, .step_factor = 1};
    const CzStatus status = cz_evaluator_build(made.problem, &options, &made.evaluator, &error);
    if (status != CZ_OK)
        print_error("%d:%d: %s\n", error.line, error.column, error.message);
    assert_int_equal(status, CZ_OK);
    return made;
}

static void evaluate(Case *made, const double *x) {
    CzError error = {0};
    cz_evaluation_free(&made->evaluation);
    assert_int_equal(cz_evaluate(made->evaluator, 1, x, false, &made->evaluation, &error), CZ_OK);
}

static void end(Case *made) {
    cz_evaluation_free(&made->evaluation);
    cz_evaluator_free(made->evaluator);
    cz_problem_free(made->problem);
}

static const CzCheckResult *find(const CzEvaluation *evaluation, const char *name,
                                 const char *scenario) {
    for (int i = 0; i < evaluation->n_check; i++)
        if (strcmp(evaluation->check[i].name, name) == 0 &&
            strcmp(evaluation->check[i].scenario, scenario) == 0)
            return &evaluation->check[i];
    return NULL;
}

/* 40 t at 25 km/h: 482 kJ are dissipated, 241 kJ on each side; the tube absorbs 200 kJ of them. */
static void margin_is_the_distance_to_the_limit_over_the_limit(void **state) {
    (void)state;
    Case made = begin("checks:\n"
                      "  design_rules: false\n"
                      "  limits:\n"
                      "    - {name: force, metric: interfaces.peak_force_kN, max: 1500}\n"
                      "    - {name: work, metric: elements.coupler A1.energy_kJ, min: 150,\n"
                      "       scenarios: [crash]}\n"
                      "    - {name: none, metric: elements.end *.energy_kJ, max: 0.1}\n");
    evaluate(&made, NULL);
    const CzCheckResult *force = find(&made.evaluation, "force", "crash");
    assert_near(force->value, 1300, 1e-12, 0);
    assert_near(force->margin, 200.0 / 1500, 1e-12, 0);
    assert_string_equal(force->where, "A1-B1");
    assert_string_equal(force->unit, "kN");
    assert_string_equal(force->confidence, "user");
    const CzCheckResult *work = find(&made.evaluation, "work", "crash");
    assert_near(work->value, 200, 1e-9, 0);
    assert_near(work->margin, 50.0 / 150, 1e-9, 0);
    assert_true(work->is_minimum);
    const CzCheckResult *none = find(&made.evaluation, "none", "crash");
    assert_near(none->value, 0, 0, 0);
    assert_near(none->margin, 1, 1e-12, 0);
    assert_null(find(&made.evaluation, "force", "overload")); /* judged for bottoming only */
    assert_int_equal(made.evaluation.verdict, CZ_VERDICT_PASS);
    assert_near(made.evaluation.violation, 0, 0, 0);
    end(&made);
}

static void minimum_is_judged_at_the_smallest_place(void **state) {
    (void)state;
    Case made =
        begin("checks:\n"
              "  design_rules: false\n"
              "  limits:\n"
              "    - {name: each, metric: elements.*.energy_kJ, min: 1, scenarios: [crash]}\n"
              "    - {name: sum, metric: elements.coupler *.energy_kJ.sum, min: 400,\n"
              "       scenarios: [crash]}\n");
    evaluate(&made, NULL);
    const CzCheckResult *each = find(&made.evaluation, "each", "crash");
    assert_near(each->value, 0, 0, 0);
    assert_int_equal(each->verdict, CZ_VERDICT_FAIL);
    assert_near(find(&made.evaluation, "sum", "crash")->value, 400, ROUNDING_OF_A_SUM, 0);
    assert_int_equal(made.evaluation.verdict, CZ_VERDICT_FAIL);
    end(&made);
}

static void unconfirmed_limit_passes_provisionally_until_the_user_sets_it(void **state) {
    (void)state;
    const char *limit = "checks:\n"
                        "  design_rules: false\n"
                        "  limits:\n"
                        "    - {name: force, metric: interfaces.peak_force_kN, max: 1500,\n"
                        "       confidence: %s}\n";
    const struct {
        const char *confidence;
        CzVerdict verdict;
    } cases[] = {{"S1", CZ_VERDICT_PASS},        {"user", CZ_VERDICT_PASS},
                 {"M1", CZ_VERDICT_PROVISIONAL}, {"S2", CZ_VERDICT_PROVISIONAL},
                 {"X", CZ_VERDICT_PROVISIONAL},  {"M2", CZ_VERDICT_PROVISIONAL},
                 {"M3", CZ_VERDICT_PROVISIONAL}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char more[512];
        snprintf(more, sizeof more, limit, cases[i].confidence);
        Case made = begin(more);
        evaluate(&made, NULL);
        assert_int_equal(made.evaluation.verdict, cases[i].verdict);
        end(&made);
    }
}

static void design_rules_judge_the_design_and_every_scenario(void **state) {
    (void)state;
    Case made = begin("");
    evaluate(&made, NULL);
    const CzEvaluation *evaluation = &made.evaluation;
    /* the tube is exhausted at 25 km/h and the coupler shears, as it may; at 15 km/h it must not */
    assert_int_equal(find(evaluation, "no shear-off at 15 km/h (service)", "service")->verdict,
                     CZ_VERDICT_PASS);
    assert_null(find(evaluation, "no shear-off at 15 km/h (service)", "crash"));
    /* 24.7 kJ a side at 8 km/h: the stand-in has no buffer, so its tube collapses */
    const CzCheckResult *buffing =
        find(evaluation, "collapse tubes inactive at 8 km/h (buffing)", "buffing");
    assert_near(buffing->value, 40e3 / 8 * (8 / 3.6) * (8 / 3.6) / 1e3, 1e-9, 0);
    assert_int_equal(buffing->verdict, CZ_VERDICT_FAIL);
    assert_near(find(evaluation, "tube force / shear-off force", "design")->value, 800.0 / 1300,
                1e-12, 0);
    assert_near(find(evaluation, "stroke / retraction space", "design")->value, 400.0 / 1500,
                ROUNDING_OF_A_SUM, 0);
    assert_non_null(find(evaluation, "bottoming out under overload", "overload"));
    assert_null(find(evaluation, "bottoming out", "overload"));
    /* no wheels, so override is not checked, which is not a pass */
    assert_int_equal(find(evaluation, "override", "crash")->verdict, CZ_VERDICT_NOT_CHECKED);
    end(&made);
}

/* 241 kJ on each side use 96 % of a tube of 1 MN x 0.25 m, and the shear-off behind it stays
 * intact.
 */
static void tube_in_front_of_a_shear_off_may_be_exhausted(void **state) {
    (void)state;
    Case made = begin(variables);
    const double x[2] = {1000, 400};
    evaluate(&made, x);
    const CzCheckResult *check = find(&made.evaluation, "stroke used", "crash");
    assert_non_null(check);
    assert_near(check->value, 0, 0, 1e-12);
    end(&made);
}

static void rules_without_their_scenarios_are_not_checked(void **state) {
    (void)state;
    stand_in_reset();
    const char *const set[] = {"scenarios[0].speed_km_h=27.5", "scenarios[1].speed_km_h=27.5",
                               "scenarios[2].speed_km_h=27.5", "scenarios[3].speed_km_h=27.5",
                               "scenarios[4].mass_factor=1"};
    CzProblem *problem = NULL;
    CzError error = {0};
    assert_int_equal(small_problem_read("", 5, set, &problem, &error), CZ_OK);
    CzEvaluator *evaluator = NULL;
    assert_int_equal(cz_evaluator_build(problem, NULL, &evaluator, &error), CZ_OK);
    CzEvaluation evaluation;
    assert_int_equal(cz_evaluate(evaluator, 1, NULL, false, &evaluation, &error), CZ_OK);
    static const char *const names[] = {
        "bottoming out under overload", "collapse tubes inactive at 8 km/h (buffing)",
        "no shear-off at 15 km/h (service)", "scenario between 15 km/h and the design speed"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        const CzCheckResult *check = find(&evaluation, names[i], "design");
        assert_non_null(check);
        assert_int_equal(check->verdict, CZ_VERDICT_NOT_CHECKED);
        assert_non_null(check->why);
    }
    cz_evaluation_free(&evaluation);
    cz_evaluator_free(evaluator);
    cz_problem_free(problem);
}

static void failed_run_is_infeasible_and_not_checked(void **state) {
    (void)state;
    Case made = begin(variables);
    stand_in.failing_above = 1e6;
    const double good[] = {800, 300}, bad[] = {1200, 300};
    evaluate(&made, good);
    assert_int_equal(made.evaluation.status, CZ_OK);
    evaluate(&made, bad);
    assert_int_equal(made.evaluation.status, CZ_STATUS_RUN_FAILED);
    assert_true(isnan(made.evaluation.objective) && isinf(made.evaluation.violation));
    for (int j = 0; j < made.evaluation.n_constraint; j++)
        assert_true(isnan(made.evaluation.constraint[j]));
    const CzCheckResult *check = find(&made.evaluation, "stroke used", "crash");
    assert_int_equal(check->verdict, CZ_VERDICT_NOT_CHECKED);
    assert_string_equal(check->why, "the run of this scenario failed");
    assert_int_not_equal(made.evaluation.verdict, CZ_VERDICT_PASS);
    end(&made);
}

/* The remaining oscillation after a pitch period without collision does not count as closing speed.
 */
static void a_run_that_met_its_end_criterion_has_no_closing_speed(void **state) {
    (void)state;
    Case made = begin(variables);
    const double x[] = {800, 300};
    evaluate(&made, x);
    const CzCheckResult *check = find(&made.evaluation, "residual closing speed", "crash");
    assert_near(check->value, 0.0, 0.0, 0.0);
    assert_near(check->margin, 1.0, 0.0, 1e-15);
    end(&made);
}

static void incomplete_run_is_never_a_pass(void **state) {
    (void)state;
    Case made = begin(variables);
    stand_in.incomplete_above = 1e6;
    const double bad[] = {1200, 300};
    evaluate(&made, bad);
    assert_int_equal(made.evaluation.status, CZ_STATUS_RUN_FAILED);
    assert_int_not_equal(made.evaluation.verdict, CZ_VERDICT_PASS);
    assert_true(isinf(made.evaluation.violation));
    end(&made);
}

static void default_objective_is_the_smallest_margin(void **state) {
    (void)state;
    Case made = begin(variables);
    evaluate(&made, NULL);
    double smallest = INFINITY;
    for (int j = 0; j < made.evaluation.n_constraint; j++) {
        const CzCheckResult *check = &made.evaluation.constraint_check[j];
        assert_near(made.evaluation.constraint[j],
                    isnan(check->margin) ? made.evaluation.constraint[j] : -check->margin, 0, 0);
        smallest = fmin(smallest, check->margin);
    }
    assert_near(made.evaluation.objective, -smallest, 0, 0);
    end(&made);
}

static void required_margin_is_part_of_the_constraint(void **state) {
    (void)state;
    Case made =
        begin("checks: {design_rules: false}\n"
              "optimise:\n"
              "  minimise: interfaces.peak_force_kN\n"
              "  margin: 0.1\n"
              "  variables: [{path: \"parts.tube.stages[0].force_kN\", min: 400, max: 1500}]\n"
              "  targets:\n"
              "    - {name: coupler works, metric: elements.colliding coupler *.energy_kJ,\n"
              "       min: 150, scenarios: [crash]}\n");
    evaluate(&made, NULL);
    assert_int_equal(made.evaluation.n_check, 0);
    assert_near(made.evaluation.constraint[0], 0.1 - 50.0 / 150, ROUNDING_OF_A_SUM, 0);
    assert_true(made.evaluation.n_constraint > 2);
    for (int i = 1; i < made.evaluation.n_constraint; i++) /* rules of files require no reserve */
        assert_near(made.evaluation.constraint[i],
                    isnan(made.evaluation.constraint_check[i].margin)
                        ? -1
                        : -made.evaluation.constraint_check[i].margin,
                    0, 1e-12);
    assert_near(made.evaluation.objective, 1300, 1e-12, 0);
    assert_string_equal(cz_evaluator_constraint_name(made.evaluator, 0), "coupler works, crash");
    assert_int_equal(made.evaluation.verdict, CZ_VERDICT_NOT_CHECKED); /* nothing was checked */
    end(&made);
}

static void result_depends_neither_on_neighbours_nor_on_threads(void **state) {
    (void)state;
    enum { N = 150 };
    stand_in_reset();
    stand_in.scatter = 1;
    CzProblem *problem = small_problem(variables);
    double x[2 * N];
    for (int i = 0; i < N; i++) {
        x[2 * i] = 400 + 7.3 * i;
        x[2 * i + 1] = 900 - 5.1 * i;
    }
    double objective[3][N];
    for (int way = 0; way < 3; way++) {
        const CzEvaluatorOptions options = {.n_job = way == 2 ? 7 : 1, .step_factor = 1};
        CzEvaluator *evaluator = NULL;
        CzEvaluation evaluation[N];
        CzError error = {0};
        assert_int_equal(cz_evaluator_build(problem, &options, &evaluator, &error), CZ_OK);
        const int n = way == 0 ? 1 : N; /* one by one, or all at once */
        for (int first = 0; first < N; first += n) {
            assert_int_equal(cz_evaluate(evaluator, n, x + 2 * first, false, evaluation, &error),
                             CZ_OK);
            for (int i = 0; i < n; i++) {
                objective[way][first + i] = evaluation[i].objective;
                cz_evaluation_free(&evaluation[i]);
            }
        }
        cz_evaluator_free(evaluator);
    }
    assert_memory_equal(objective[0], objective[1], sizeof objective[0]);
    assert_memory_equal(objective[0], objective[2], sizeof objective[0]);
    cz_problem_free(problem);
}

/* The worst detail is the worst constraint, and there is one for each place. */
static void details_are_the_constraints_before_the_worst_is_taken(void **state) {
    (void)state;
    Case made = begin("checks:\n"
                      "  design_rules: false\n"
                      "  limits:\n"
                      "    - {name: force, metric: elements.coupler *.peak_force_kN, max: 1000,\n"
                      "       scenarios: [crash]}\n"
                      "    - {name: sum, metric: elements.*.energy_kJ.sum, max: 300,\n"
                      "       scenarios: [crash]}\n"
                      "    - {name: flag, metric: elements.bottomed_out, max: 0,\n"
                      "       scenarios: [crash]}\n"
                      "optimise:\n"
                      "  variables: [{path: \"parts.tube.stages[0].force_kN\", min: 400, max: "
                      "1500}]\n");
    enum { COUPLERS = 2, SUM = 1 };
    assert_int_equal(cz_evaluator_n_detail(made.evaluator), COUPLERS + SUM);
    double detail[COUPLERS + SUM];
    const double x[] = {800};
    CzError error = {0};
    assert_int_equal(cz_evaluator_search(made.evaluator, 1, x, &made.evaluation, detail, &error),
                     CZ_OK);
    assert_near(fmax(detail[0], detail[1]), made.evaluation.constraint[0], 0, 0);
    assert_near(detail[2], made.evaluation.constraint[1], 0, 0);
    end(&made);
}

static double most_force(int n_scenario, const CzRunSummary *const *summary, void *data) {
    double most = 0;
    ++*(int *)data;
    for (int s = 0; s < n_scenario; s++)
        most = fmax(most, summary[s]->interface[0].peak_force);
    return most;
}

static void own_objective_replaces_the_files(void **state) {
    (void)state;
    Case made = begin(variables);
    int n_call = 0;
    cz_evaluator_set_objective(made.evaluator, "mine", "N", most_force, &n_call);
    evaluate(&made, NULL);
    assert_int_equal(n_call, 1);
    assert_near(made.evaluation.objective, 1300e3, ROUNDING_OF_A_SUM, 0);
    assert_string_equal(cz_evaluator_objective_name(made.evaluator), "mine");
    end(&made);
}

static void runs_are_kept_when_asked_for(void **state) {
    (void)state;
    Case made = begin("");
    CzError error = {0};
    assert_int_equal(cz_evaluate(made.evaluator, 1, NULL, true, &made.evaluation, &error), CZ_OK);
    assert_int_equal(made.evaluation.n_run, 5);
    assert_string_equal(cz_run_summary(made.evaluation.run[4])->scenario, "overload");
    end(&made);
}

static void one_scenario_alone_leaves_the_others_unchecked(void **state) {
    (void)state;
    stand_in_reset();
    CzProblem *problem = small_problem("");
    CzEvaluatorOptions options = cz_evaluator_options_default();
    options.scenario = "service";
    CzEvaluator *evaluator = NULL;
    CzEvaluation evaluation;
    CzError error = {0};
    assert_int_equal(cz_evaluator_build(problem, &options, &evaluator, &error), CZ_OK);
    assert_int_equal(cz_evaluate(evaluator, 1, NULL, true, &evaluation, &error), CZ_OK);
    assert_int_equal(evaluation.n_run, 1);
    assert_int_equal(find(&evaluation, "stroke used", "service")->verdict, CZ_VERDICT_PASS);
    assert_int_equal(find(&evaluation, "stroke used", "crash")->verdict, CZ_VERDICT_NOT_CHECKED);
    assert_string_equal(find(&evaluation, "stroke used", "crash")->why,
                        "this scenario was not run");
    cz_evaluation_free(&evaluation);
    cz_evaluator_free(evaluator);
    options.scenario = "servce";
    assert_int_equal(cz_evaluator_build(problem, &options, &evaluator, &error), CZ_STATUS_INPUT);
    cz_problem_free(problem);
}

/* ---- variables ------------------------------------------------------------------------------- */

static void variables_have_names_units_bounds_and_places(void **state) {
    (void)state;
    Case made = begin(variables);
    assert_int_equal(cz_evaluator_n_variable(made.evaluator), 2);
    const CzVariableInfo *force = cz_evaluator_variable(made.evaluator, 0);
    assert_string_equal(force->name, "parts.tube.stages[0].force_kN");
    assert_string_equal(force->unit, "kN");
    assert_near(force->start, 800, ROUNDING_OF_A_SUM, 0);
    assert_near(cz_evaluator_variable(made.evaluator, 1)->increment, 50, 0, 0);
    assert_int_equal(force->n_place, 1); /* one part, both trains */
    assert_string_equal(force->place[0].path, "parts.tube.stages[0].force_kN");
    end(&made);
}

static void variable_changes_both_trains_through_a_part(void **state) {
    (void)state;
    Case made =
        begin("checks:\n"
              "  design_rules: false\n"
              "  limits:\n"
              "    - {name: a, metric: elements.coupler A1.peak_force_kN, max: 1e9}\n"
              "    - {name: b, metric: elements.coupler B1.peak_force_kN, max: 1e9}\n"
              "optimise:\n"
              "  variables: [{path: \"parts.tube.stages[0].force_kN\", min: 400, max: 1500}]\n");
    const double x[] = {1000};
    evaluate(&made, x);
    assert_near(find(&made.evaluation, "a", "service")->value, 1000, ROUNDING_OF_A_SUM, 0);
    assert_near(find(&made.evaluation, "b", "service")->value, 1000, ROUNDING_OF_A_SUM, 0);
    end(&made);
}

static void design_that_could_not_be_read_back_is_infeasible(void **state) {
    (void)state;
    Case made = begin("checks: {design_rules: false}\n"
                      "optimise:\n"
                      "  variables: [{path: \"parts.anti-climber.gap_mm\", min: 0, max: 2000}]\n");
    const double behind_the_end = 1990;
    evaluate(&made, NULL);
    assert_near(made.evaluation.violation, 0, 0, 0);
    evaluate(&made, &behind_the_end);
    assert_true(made.evaluation.violation > 0);
    int n_broken = 0;
    for (int i = 0; i < made.evaluation.n_constraint; i++)
        if (made.evaluation.constraint[i] > 0) { /* 1990 mm of 900, and of 1000 mm of coupler */
            const char *name = made.evaluation.constraint_check[i].name;
            n_broken++;
            assert_true(strcmp(name, "rule: anti-climber in front of the bare end") == 0 ||
                        strcmp(name, "rule: anti-climber behind the coupler face") == 0 ||
                        strcmp(name, "rule: anti-climber contact within the retraction space") ==
                            0 ||
                        strcmp(name, "rules between values") == 0);
        }
    assert_true(n_broken >= 3);
    assert_int_equal(made.evaluation.n_check, 0); /* no metric of the list */
    end(&made);
}

/* The base text ends in its list of scenarios, so `more` can go on with it. */
static void limit_of_a_family_is_judged_in_each_of_its_members(void **state) {
    (void)state;
    Case made = begin("  - name: climb\n"
                      "    sweep: {speed_km_h: [10, 30]}\n"
                      "checks:\n"
                      "  design_rules: false\n"
                      "  limits:\n"
                      "    - {name: force, metric: interfaces.peak_force_kN, max: 1500,\n"
                      "       scenarios: [climb]}\n"
                      "optimise:\n"
                      "  variables:\n"
                      "    - {path: \"parts.tube.stages[0].force_kN\", min: 400, max: 1500}\n"
                      "  subject_to: [force]\n");
    evaluate(&made, NULL);
    assert_int_equal(made.evaluation.n_check, 2);
    assert_non_null(find(&made.evaluation, "force", "climb_10km_h"));
    const CzCheckResult *fast = find(&made.evaluation, "force", "climb_30km_h");
    assert_non_null(fast);
    assert_string_equal(fast->family, "climb");
    assert_string_equal(cz_evaluator_constraint_name(made.evaluator, 1), "force, climb_30km_h");
    end(&made);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(margin_is_the_distance_to_the_limit_over_the_limit),
        cmocka_unit_test(limit_of_a_family_is_judged_in_each_of_its_members),
        cmocka_unit_test(minimum_is_judged_at_the_smallest_place),
        cmocka_unit_test(unconfirmed_limit_passes_provisionally_until_the_user_sets_it),
        cmocka_unit_test(design_rules_judge_the_design_and_every_scenario),
        cmocka_unit_test(tube_in_front_of_a_shear_off_may_be_exhausted),
        cmocka_unit_test(rules_without_their_scenarios_are_not_checked),
        cmocka_unit_test(failed_run_is_infeasible_and_not_checked),
        cmocka_unit_test(a_run_that_met_its_end_criterion_has_no_closing_speed),
        cmocka_unit_test(incomplete_run_is_never_a_pass),
        cmocka_unit_test(default_objective_is_the_smallest_margin),
        cmocka_unit_test(required_margin_is_part_of_the_constraint),
        cmocka_unit_test(result_depends_neither_on_neighbours_nor_on_threads),
        cmocka_unit_test(details_are_the_constraints_before_the_worst_is_taken),
        cmocka_unit_test(own_objective_replaces_the_files),
        cmocka_unit_test(runs_are_kept_when_asked_for),
        cmocka_unit_test(one_scenario_alone_leaves_the_others_unchecked),
        cmocka_unit_test(variables_have_names_units_bounds_and_places),
        cmocka_unit_test(variable_changes_both_trains_through_a_part),
        cmocka_unit_test(design_that_could_not_be_read_back_is_infeasible),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
