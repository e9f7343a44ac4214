/* The whole search, from a problem file to an outcome, on a stand-in simulator; and loopholes of
 * the model that an optimiser would use. */
#include "support/check.h"

#include "evaluate/stand_in.h"
#include "optimise/loopholes.h"

/* The start needs the ends at 27.5 km/h; stronger anti-climbers satisfy its force limit and the
 * reserve of strokes. */
static const char sizing[] =
    "checks:\n"
    "  limits: [{name: force, metric: interfaces.peak_force_kN, max: 1400}]\n"
    "optimise:\n"
    "  subject_to: [force, stroke used, stroke used under overload, stroke / retraction space,\n"
    "               installed length / available length, section force / proof strength, no "
    "shear-off at 15 km/h (service),\n"
    "               tube force / shear-off force, shear-off force / proof strength]\n"
    "  minimise: design.installed_length_mm\n"
    "  evaluations: 600\n"
    "  variables:\n"
    "    - {path: \"parts.tube.stages[0].stroke_mm\", min: 100, max: 500, increment: 10}\n"
    "    - {path: \"parts.anti-climber.stages[0].force_kN\", min: 100, max: 900, increment: 50}\n"
    "    - {path: \"parts.anti-climber.stages[0].stroke_mm\", min: 100, max: 700, increment: 10}\n"
    "    - {path: parts.shear-off.force_kN, min: 900, max: 1500, increment: 50}\n";

static void design_that_passes_is_found_on_the_catalogue_steps(void **state) {
    (void)state;
    stand_in_reset();
    Case made = begin(sizing, 2);
    optimise(&made, NULL);
    const CzOutcome *outcome = made.outcome;
    assert_int_equal(outcome->status, CZ_OUTCOME_FEASIBLE);
    assert_true(outcome->n_evaluation <= 600);
    assert_int_equal(outcome->n_trial, outcome->n_evaluation);
    for (int i = 0; i < outcome->n_variable; i++) {
        const CzVariableInfo *info = cz_evaluator_variable(made.evaluator, i);
        assert_near(outcome->best[i] / info->increment, round(outcome->best[i] / info->increment),
                    ROUNDING_OF_A_FORMULA, 0);
        assert_true(outcome->best[i] >= info->min && outcome->best[i] <= info->max);
        assert_near(outcome->start[i], info->start, 0, 0);
    }
    assert_true(outcome->best_evaluation.violation <= 0);
    assert_int_equal(outcome->best_evaluation.n_run, 5);
    /* 0.9 x tube + 0.9 x climbers must absorb 241 kJ on each side at 25 km/h, without the reserve
     * 321 kJ at overload; the strongest devices allowed are the shortest: the anti-climbers carry
     * 1400 kN */
    assert_true(outcome->best_evaluation.objective < outcome->start_evaluation.objective);
    end(&made);
}

/* Each increment of a variable is evaluated again from scratch. */
static void sensitivities_are_differences_of_designs(void **state) {
    (void)state;
    stand_in_reset();
    Case made = begin(sizing, 2);
    optimise(&made, NULL);
    const CzOutcome *outcome = made.outcome;
    CzError error = {0};
    bool any = false;
    for (int i = 0; i < outcome->n_variable; i++) {
        const CzVariableInfo *info = cz_evaluator_variable(made.evaluator, i);
        CzEvaluation changed;
        double x[8];
        memcpy(x, outcome->best, (size_t)outcome->n_variable * sizeof *x);
        x[i] += outcome->sensitivity_increment[i];
        assert_true(outcome->sensitivity_increment[i] != 0 && x[i] >= info->min &&
                    x[i] <= info->max);
        assert_int_equal(cz_evaluate(made.evaluator, 1, x, false, &changed, &error), CZ_OK);
        assert_near(outcome->objective_change[i],
                    changed.objective - outcome->best_evaluation.objective, 0, 1e-9);
        for (int k = 0; k < changed.n_constraint; k++)
            if (changed.constraint_check[k].is_flag)
                assert_true(isnan(outcome->constraint_change[i * changed.n_constraint + k]));
            else
                assert_near(outcome->constraint_change[i * changed.n_constraint + k],
                            changed.constraint[k] - outcome->best_evaluation.constraint[k], 0,
                            1e-9);
        any |= outcome->objective_change[i] != 0;
        cz_evaluation_free(&changed);
    }
    assert_true(any);
    end(&made);
}

static void history_keeps_the_designs(void **state) {
    (void)state;
    stand_in_reset();
    Case made = begin(sizing, 2);
    optimise(&made, NULL);
    const CzOutcome *outcome = made.outcome;
    CzError error = {0};
    for (long i = 0; i < outcome->n_trial; i += outcome->n_trial / 5) {
        CzEvaluation again;
        const double *x = &outcome->trial_x[i * outcome->n_variable];
        assert_int_equal(cz_evaluate(made.evaluator, 1, x, false, &again, &error), CZ_OK);
        assert_near(again.objective, outcome->trial[i].objective, 0, 0);
        cz_evaluation_free(&again);
    }
    end(&made);
}

static void outcome_does_not_depend_on_the_number_of_threads(void **state) {
    (void)state;
    stand_in_reset();
    Case one = begin(sizing, 1), many = begin(sizing, 5);
    optimise(&one, NULL);
    optimise(&many, NULL);
    const CzOutcome *a = one.outcome, *b = many.outcome;
    assert_int_equal(a->n_trial, b->n_trial);
    for (long i = 0; i < a->n_trial; i++) {
        assert_memory_equal(&a->trial[i].objective, &b->trial[i].objective, sizeof(double));
        assert_memory_equal(&a->trial[i].violation, &b->trial[i].violation, sizeof(double));
    }
    assert_memory_equal(a->best, b->best, (size_t)a->n_variable * sizeof(double));
    end(&one);
    end(&many);
}

static void an_infeasible_problem_gives_the_least_violated_design(void **state) {
    (void)state;
    stand_in_reset();
    Case made =
        begin("checks:\n"
              "  design_rules: false\n"
              "  limits:\n"
              "    - {name: low, metric: elements.coupler *.peak_force_kN, max: 500}\n"
              "    - {name: high, metric: elements.coupler *.energy_kJ, min: 200,\n"
              "       scenarios: [crash]}\n"
              "optimise:\n"
              "  evaluations: 200\n"
              "  variables:\n"
              "    - {path: \"parts.tube.stages[0].force_kN\", min: 100, max: 900, increment: 10}\n"
              "    - {path: parts.shear-off.force_kN, min: 950, max: 1500}\n",
              2);
    optimise(&made, NULL);
    const CzOutcome *outcome = made.outcome;
    assert_int_equal(outcome->status, CZ_OUTCOME_INFEASIBLE);
    assert_true(outcome->best_evaluation.violation > 0);
    assert_int_equal(outcome->best_evaluation.verdict, CZ_VERDICT_FAIL);
    assert_true(outcome->best_evaluation.violation <= outcome->start_evaluation.violation);
    end(&made);
}

/* No increment of 50 kN gives a peak between 1030 and 1070 kN, as each end has two anti-climbers.
 */
static void a_design_that_passes_only_between_the_increments_is_given_and_reported(void **state) {
    (void)state;
    stand_in_reset();
    Case made =
        begin("checks:\n"
              "  design_rules: false\n"
              "  limits:\n"
              "    - {name: low, metric: elements.anti-climber *.peak_force_kN, max: 1070,\n"
              "       scenarios: [crash]}\n"
              "    - {name: high, metric: elements.anti-climber *.peak_force_kN, min: 1030,\n"
              "       scenarios: [crash]}\n"
              "optimise:\n"
              "  evaluations: 200\n"
              "  variables:\n"
              "    - {path: \"parts.anti-climber.stages[0].force_kN\", min: 300, max: 700, "
              "increment: 50}\n"
              "    - {path: parts.shear-off.force_kN, min: 950, max: 1500}\n",
              2);
    optimise(&made, NULL);
    const CzOutcome *outcome = made.outcome;
    assert_int_equal(outcome->status, CZ_OUTCOME_FEASIBLE);
    assert_true(outcome->best_evaluation.violation <= 0);
    assert_true(fabs(outcome->best[0] / 50 - round(outcome->best[0] / 50)) > 1e-6);
    assert_non_null(
        strstr(outcome->why_stopped, "the best design is between catalogue increments"));
    end(&made);
}

static void interrupt_at_once(const CzProgress *progress, void *data) {
    if (progress->n_evaluation >= 100)
        *(volatile sig_atomic_t *)data = 1;
}

static bool is_on_increments(const Case *made, const double *x) {
    bool is_on = true;
    for (int i = 0; i < cz_evaluator_n_variable(made->evaluator); i++) {
        const double step = cz_evaluator_variable(made->evaluator, i)->increment;
        is_on &= !(step > 0) || round(x[i] / step) * step == x[i];
    }
    return is_on;
}

static void interruption_gives_the_best_so_far(void **state) {
    (void)state;
    stand_in_reset();
    Case made = begin(sizing, 2);
    volatile sig_atomic_t stop = 0;
    CzOptimiseOptions options = cz_optimise_options_default();
    options.stop = &stop;
    options.progress = interrupt_at_once;
    options.progress_data = (void *)&stop;
    optimise(&made, &options);
    const CzOutcome *outcome = made.outcome;
    assert_int_equal(outcome->status, CZ_OUTCOME_INTERRUPTED);
    assert_string_equal(outcome->why_stopped, "interrupted");
    assert_true(outcome->n_evaluation < 150);
    double least = INFINITY; /* of the designs on the increments */
    for (long i = 0; i < outcome->n_trial; i++)
        if (outcome->trial[i].feasible &&
            is_on_increments(&made, &outcome->trial_x[i * outcome->n_variable]))
            least = fmin(least, outcome->trial[i].objective);
    assert_true(least < outcome->start_evaluation.objective);
    assert_near(outcome->best_evaluation.objective, least, 1e-12, 0);
    end(&made);
}

/* With many scenarios, only those with the smallest margins are run after the interruption. */
static void an_interruption_does_not_run_many_scenarios_again(void **state) {
    (void)state;
    stand_in_reset();
    char more[4096] = "";
    for (int speed = 9; speed < 15; speed++)
        snprintf(more + strlen(more), sizeof more - strlen(more),
                 "  - {name: at-%d, speed_km_h: %d}\n", speed, speed);
    strcat(more, sizing);
    Case made = begin(more, 2);
    volatile sig_atomic_t stop = 0;
    CzOptimiseOptions options = cz_optimise_options_default();
    options.stop = &stop;
    options.progress = interrupt_at_once;
    options.progress_data = (void *)&stop;
    optimise(&made, &options);
    const CzEvaluation *best = &made.outcome->best_evaluation;
    assert_int_equal(made.outcome->status, CZ_OUTCOME_INTERRUPTED);
    assert_int_equal(best->n_run, 2);
    assert_true(isfinite(best->objective));
    assert_int_equal(find(best, "force", "at-9")->verdict, CZ_VERDICT_NOT_CHECKED);
    assert_int_equal(find(best, "force", "crash")->verdict, CZ_VERDICT_PASS);
    end(&made);
}

/* An executor that sets the stop flag when a batch begins. */
typedef struct Stopper {
    int n_batch, at;
    volatile sig_atomic_t stop;
} Stopper;

static CzStatus count_batch(const CzExecutor *executor, CzTasks *tasks, CzError *error) {
    Stopper *stopper = executor->data;
    (void)tasks;
    (void)error;
    if (++stopper->n_batch == stopper->at)
        stopper->stop = SIGTERM;
    return CZ_OK;
}

static CzStatus run_batch(const CzExecutor *executor, CzTasks *tasks, CzError *error) {
    (void)executor;
    (void)error;
    for (int task = 0; task < cz_tasks_n(tasks); task++)
        cz_task_run(tasks, task);
    return CZ_OK;
}

static Case optimise_until(Stopper *stopper, int at) {
    CzError error = {0};
    const CzExecutor executor = {
        .n_place = 1, .submit = count_batch, .wait = run_batch, .data = stopper};
    const CzEvaluatorOptions evaluator_options = {.executor = &executor, .step_factor = 1};
    CzOptimiseOptions options = cz_optimise_options_default();
    Case made = {.problem = small_problem(sizing)};
    *stopper = (Stopper){.at = at};
    options.stop = &stopper->stop;
    assert_int_equal(cz_evaluator_build(made.problem, &evaluator_options, &made.evaluator, &error),
                     CZ_OK);
    optimise(&made, &options);
    return made;
}

static void a_search_without_its_sensitivities_is_cut_short(void **state) {
    (void)state;
    stand_in_reset();
    Stopper stopper;
    Case whole = optimise_until(&stopper, 0);
    assert_false(whole.outcome->is_cut_short);
    assert_non_null(whole.outcome->sensitivity_increment);
    Case cut = optimise_until(&stopper, stopper.n_batch);
    assert_true(cut.outcome->is_cut_short);
    assert_null(cut.outcome->sensitivity_increment);
    assert_int_equal(cut.outcome->status, CZ_OUTCOME_FEASIBLE);
    assert_non_null(strstr(cut.outcome->why_stopped, "; interrupted, without sensitivities"));
    assert_memory_equal(cut.outcome->best, whole.outcome->best,
                        (size_t)whole.outcome->n_variable * sizeof(double));
    end(&whole);
    end(&cut);
}

static void a_violation_in_the_full_run_is_never_reported_as_success(void **state) {
    (void)state;
    stand_in_reset();
    const char *more =
        "optimise:\n"
        "  minimise: elements.anti-climber *.peak_force_kN\n"
        "  subject_to: [residual closing speed, section force / proof strength]\n"
        "  evaluations: 200\n"
        "  variables:\n"
        "    - {path: \"parts.anti-climber.stages[0].force_kN\", min: 300, max: 700, "
        "increment: 10}\n";
    Case made = begin(more, 2);
    stand_in.late_below = 305e3; /* the best design of the search and no other */
    optimise(&made, NULL);
    assert_int_equal(made.outcome->status, CZ_OUTCOME_FEASIBLE);
    assert_true(made.outcome->best[0] >= 310);
    end(&made);
    stand_in_reset();
    made = begin(more, 2);
    stand_in.late_below = INFINITY;
    optimise(&made, NULL);
    assert_int_equal(made.outcome->status, CZ_OUTCOME_INFEASIBLE);
    assert_true(made.outcome->best_evaluation.violation > 0);
    end(&made);
}

static void problem_without_variables_is_refused(void **state) {
    (void)state;
    stand_in_reset();
    Case made = begin("", 1);
    CzError error = {0};
    assert_int_equal(cz_optimise(made.evaluator, NULL, &made.outcome, &error), CZ_STATUS_INPUT);
    assert_non_null(strstr(error.message, "no design variables"));
    assert_null(made.outcome);
    end(&made);
}

static void unknown_algorithm_is_refused_before_anything_runs(void **state) {
    (void)state;
    stand_in_reset();
    Case made = begin(sizing, 1);
    CzError error = {0};
    CzOptimiseOptions options = cz_optimise_options_default();
    options.algorithm = "LN_COBYLLA";
    assert_int_equal(cz_optimise(made.evaluator, &options, &made.outcome, &error), CZ_STATUS_INPUT);
    assert_non_null(strstr(error.help, "LN_COBYLA"));
    assert_int_equal(stand_in.n_run, 0);
    end(&made);
}

static void search_in_which_most_designs_fail_ends_as_failed(void **state) {
    (void)state;
    stand_in_reset();
    Case made = begin(sizing, 2);
    stand_in.failing_above = 0;
    CzError error = {0};
    assert_int_equal(cz_optimise(made.evaluator, NULL, &made.outcome, &error),
                     CZ_STATUS_RUN_FAILED);
    assert_non_null(strstr(error.message, "of the last 50 designs failed"));
    assert_null(made.outcome);
    end(&made);
}

/* ---- loopholes that need a simulator with given results --------------------------- */

static void optimiser_cannot_win_by_crushing_the_survival_space(void **state) {
    (void)state;
    stand_in_reset();
    check_loophole(&(Loophole){
        .limits = "{name: visible, metric: energy.survival_kJ, max: 1e9, scenarios: [crash]}",
        .minimise = "design.installed_length_mm",
        .variables = "{path: \"parts.anti-climber.stages[0].stroke_mm\", min: 1, max: 900}",
        .check = "energy in survival space",
        .scenario = "crash"});
}

static void optimiser_cannot_win_where_the_simulation_fails(void **state) {
    (void)state;
    stand_in_reset();
    /* The lowest stroke used is at the highest tube force, where every run fails. */
    const char *more = "checks: {design_rules: false}\n"
                       "optimise:\n"
                       "  minimise: elements.anti-climber *.stroke_used\n"
                       "  evaluations: 200\n"
                       "  variables: [{path: \"parts.tube.stages[0].force_kN\", min: 300, max: "
                       "1100, increment: 10}]\n";
    for (int incomplete = 0; incomplete < 2; incomplete++) {
        stand_in_reset();
        Case made = begin(more, 2);
        *(incomplete ? &stand_in.incomplete_above : &stand_in.failing_above) = 905e3;
        optimise(&made, NULL);
        assert_near(made.outcome->best[0], 900, ROUNDING_OF_A_SUM, 0);
        assert_int_equal(made.outcome->best_evaluation.status, CZ_OK);
        end(&made);
    }
}

static void optimiser_cannot_dilute_the_mean_deceleration(void **state) {
    (void)state;
    stand_in_reset();
    /* The stand-in's mean over 120 ms is a tenth above that over the contact: the larger one
     * counts.
     */
    Case made =
        begin("checks:\n"
              "  design_rules: false\n"
              "  limits:\n"
              "    - {name: worse, metric: vehicles.mean_deceleration_g, max: 2.4}\n"
              "    - {name: diluted, metric: vehicles.mean_deceleration_contact_g, max: 9}\n"
              "optimise:\n"
              "  minimise: elements.anti-climber *.stroke_used\n"
              "  subject_to: [worse]\n"
              "  evaluations: 200\n"
              "  variables:\n"
              "    - {path: parts.shear-off.force_kN, min: 850, max: 1300}\n"
              "    - {path: \"parts.anti-climber.stages[0].force_kN\", min: 100, max: 900}\n",
              2);
    optimise(&made, NULL);
    assert_int_equal(made.outcome->status, CZ_OUTCOME_FEASIBLE);
    assert_true(value_of(&made, "diluted", "crash") <= 2.4 / 1.1 * (1 + 1e-9));
    end(&made);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        LOOPHOLES,
        cmocka_unit_test(design_that_passes_is_found_on_the_catalogue_steps),
        cmocka_unit_test(sensitivities_are_differences_of_designs),
        cmocka_unit_test(history_keeps_the_designs),
        cmocka_unit_test(outcome_does_not_depend_on_the_number_of_threads),
        cmocka_unit_test(an_infeasible_problem_gives_the_least_violated_design),
        cmocka_unit_test(a_design_that_passes_only_between_the_increments_is_given_and_reported),
        cmocka_unit_test(interruption_gives_the_best_so_far),
        cmocka_unit_test(an_interruption_does_not_run_many_scenarios_again),
        cmocka_unit_test(a_search_without_its_sensitivities_is_cut_short),
        cmocka_unit_test(a_violation_in_the_full_run_is_never_reported_as_success),
        cmocka_unit_test(problem_without_variables_is_refused),
        cmocka_unit_test(unknown_algorithm_is_refused_before_anything_runs),
        cmocka_unit_test(search_in_which_most_designs_fail_ends_as_failed),
        cmocka_unit_test(optimiser_cannot_win_by_crushing_the_survival_space),
        cmocka_unit_test(optimiser_cannot_win_where_the_simulation_fails),
        cmocka_unit_test(optimiser_cannot_dilute_the_mean_deceleration),
    };
    stand_in_reset();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
