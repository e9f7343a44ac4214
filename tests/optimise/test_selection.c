/* Searches that run most designs in a few of many scenarios, on the stand-in simulator. */
#include "support/check.h"

#include "evaluate/stand_in.h"
#include "optimise/loopholes.h"
#include "optimise/journal_in_memory.h"
#include "optimise/selection.h"

/* At the start the anti-climbers are used most at 25 km/h. The shortest design has long tubes, and
 * uses them most where a tube is weak: in a scenario that does not matter at the start. */
static const char sizing[] =
    "  - {name: many, sweep: {speed_km_h: 6:25:20}}\n"
    "  - {name: weak-tube, speed_km_h: 20, changes: [{path: \"parts.tube.stages[0].force_kN\", "
    "factor: 0.1}]}\n"
    "checks:\n"
    "  design_rules: false\n"
    "  limits:\n"
    "    - {name: used, metric: elements.anti-climber *.stroke_used, max: 0.9,\n"
    "       scenarios: [many, weak-tube]}\n"
    "optimise:\n"
    "  subject_to: [used]\n"
    "  minimise: design.installed_length_mm\n"
    "  evaluations: 80\n"
    "  variables:\n"
    "    - {path: \"parts.tube.stages[0].stroke_mm\", min: 100, max: 350, increment: 10}\n"
    "    - {path: \"parts.anti-climber.stages[0].stroke_mm\", min: 100, max: 700, increment: 10}\n";

enum { N_SCENARIO = 26 };

static Case begin_many(int n_job) {
    CzError error = {0};
    const char *set[] = {"parts.tube.stages[0].stroke_mm=100"};
    CzProblem *problem = NULL;
    assert_int_equal(small_problem_read(sizing, 1, set, &problem, &error), CZ_OK);
    return begin_with(problem, n_job);
}

static Case search(int n_job, const CzJournal *journal, long evaluations) {
    Case made = begin_many(n_job);
    CzOptimiseOptions options = cz_optimise_options_default();
    options.verify_methods = 0;
    options.journal = journal;
    options.evaluations = evaluations;
    optimise(&made, &options);
    return made;
}

static const CzScenarioUse *use_of(const CzOutcome *outcome, const char *name) {
    for (int s = 0; s < outcome->n_scenario; s++)
        if (strcmp(outcome->scenario[s].name, name) == 0)
            return &outcome->scenario[s];
    return NULL;
}

static void scenario_that_becomes_active_joins_and_few_designs_are_run_in_the_others(void **state) {
    (void)state;
    stand_in_reset();
    Case made = search(2, NULL, 0);
    const CzOutcome *outcome = made.outcome;
    assert_int_equal(outcome->status, CZ_OUTCOME_FEASIBLE);
    assert_int_equal(outcome->n_scenario, N_SCENARIO);
    const CzScenarioUse *fast = use_of(outcome, "many_25km_h");
    const CzScenarioUse *slow = use_of(outcome, "many_10km_h");
    const CzScenarioUse *weak = use_of(outcome, "weak-tube");
    assert_true(fast->is_in_set && weak->is_in_set && !slow->is_in_set);
    assert_int_equal(fast->n_run, outcome->n_evaluation);
    assert_int_equal(slow->n_run, outcome->n_whole);
    assert_true(weak->n_run < outcome->n_evaluation && weak->n_run > outcome->n_whole);
    assert_true(2 * outcome->n_whole < outcome->n_evaluation);
    assert_true(2 * stand_in.n_run < outcome->n_evaluation * N_SCENARIO);
    const CzCheckResult *used = find(&outcome->best_evaluation, "used", "weak-tube");
    assert_true(used->margin >= 0 && used->margin < 0.05); /* it limits the optimum */
    end(&made);
}

static void best_design_is_the_best_of_all_that_were_evaluated(void **state) {
    (void)state;
    stand_in_reset();
    Case made = search(2, NULL, 0);
    const CzOutcome *outcome = made.outcome;
    const size_t n = (size_t)outcome->n_trial;
    CzError error = {0};
    CzEvaluation *whole = calloc(n, sizeof *whole);
    assert_int_equal(cz_evaluate(made.evaluator, (int)n, outcome->trial_x, false, whole, &error),
                     CZ_OK);
    double best = INFINITY;
    for (size_t i = 0; i < n; i++) {
        const double *x = outcome->trial_x + i * 2;
        if (whole[i].violation <= 0 && fmod(x[0], 10) == 0 && fmod(x[1], 10) == 0)
            best = fmin(best, whole[i].objective);
        assert_true(!outcome->trial[i].feasible || whole[i].violation <= 0);
        assert_true(outcome->trial[i].violation <= whole[i].violation);
        cz_evaluation_free(&whole[i]);
    }
    free(whole);
    assert_near(outcome->best_evaluation.objective, best, 0, 0);
    end(&made);
}

static void assert_same(const CzOutcome *one, const CzOutcome *other) {
    const size_t n = (size_t)one->n_variable;
    assert_int_equal(one->n_trial, other->n_trial);
    assert_memory_equal(one->best, other->best, n * sizeof(double));
    assert_memory_equal(one->trial_x, other->trial_x, (size_t)one->n_trial * n * sizeof(double));
    for (long i = 0; i < one->n_trial; i++)
        assert_memory_equal(&one->trial[i].objective, &other->trial[i].objective, sizeof(double));
    assert_int_equal(one->n_whole, other->n_whole);
    for (int s = 0; s < one->n_scenario; s++) {
        assert_int_equal(one->scenario[s].n_run, other->scenario[s].n_run);
        assert_int_equal(one->scenario[s].is_in_set, other->scenario[s].is_in_set);
    }
}

static void selection_does_not_depend_on_threads(void **state) {
    (void)state;
    stand_in_reset();
    Case one = search(1, NULL, 0), four = search(4, NULL, 0);
    assert_same(one.outcome, four.outcome);
    end(&one);
    end(&four);
}

static void search_with_a_selection_goes_on_from_any_part_of_its_journal(void **state) {
    (void)state;
    stand_in_reset();
    Case first = begin_many(1);
    Kept all = {.evaluator = first.evaluator};
    const CzJournal empty = {.keep = journal_keep, .keep_data = &all};
    end(&first);
    Case straight = begin_many(1);
    all.evaluator = straight.evaluator;
    CzOptimiseOptions options = cz_optimise_options_default();
    options.verify_methods = 0;
    options.journal = &empty;
    optimise(&straight, &options);
    for (long n = 0; n <= all.n; n += 9) {
        Kept rest = {.evaluator = straight.evaluator};
        const CzJournal journal = {
            .n_answer = n, .answer = all.answer, .keep = journal_keep, .keep_data = &rest};
        Case again = search(2, &journal, 0);
        assert_int_equal(rest.n, all.n - n);
        assert_same(straight.outcome, again.outcome);
        end(&again);
        journal_forget(&rest);
    }
    /* with a higher limit: as from the beginning */
    Kept rest = {.evaluator = straight.evaluator};
    const CzJournal journal = {.n_answer = all.n,
                               .answer = all.answer,
                               .n_earlier = all.n,
                               .keep = journal_keep,
                               .keep_data = &rest};
    Case longer = search(1, NULL, 120), continued = search(1, &journal, 120);
    assert_same(longer.outcome, continued.outcome);
    assert_true(rest.n < continued.outcome->n_evaluation);
    end(&longer);
    end(&continued);
    journal_forget(&rest);
    journal_forget(&all);
    end(&straight);
}

/* A few scenarios fill the lanes of one batch. */
static void few_scenarios_are_all_run(void **state) {
    (void)state;
    stand_in_reset();
    Case made = begin("optimise:\n"
                      "  subject_to: [stroke used]\n"
                      "  evaluations: 20\n"
                      "  variables: [{path: \"parts.tube.stages[0].stroke_mm\", min: 100, max: "
                      "500}]\n",
                      1);
    optimise(&made, NULL);
    assert_int_equal(made.outcome->n_scenario, 0);
    assert_int_equal(made.outcome->n_whole, made.outcome->n_evaluation);
    end(&made);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenario_that_becomes_active_joins_and_few_designs_are_run_in_the_others),
        cmocka_unit_test(best_design_is_the_best_of_all_that_were_evaluated),
        cmocka_unit_test(selection_does_not_depend_on_threads),
        cmocka_unit_test(search_with_a_selection_goes_on_from_any_part_of_its_journal),
        cmocka_unit_test(few_scenarios_are_all_run),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
