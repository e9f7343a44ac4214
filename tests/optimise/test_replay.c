/* Searches with a journal, on a stand-in simulator that counts its runs. */
#include "support/check.h"

#include "evaluate/stand_in.h"
#include "optimise/loopholes.h"
#include "optimise/journal_in_memory.h"
#include "optimise/outcome.h"

#include <stdlib.h>

static const char sizing[] =
    "checks:\n"
    "  limits: [{name: force, metric: interfaces.peak_force_kN, max: 1400}]\n"
    "optimise:\n"
    "  subject_to: [force, stroke used]\n"
    "  minimise: design.installed_length_mm\n"
    "  evaluations: 80\n"
    "  variables:\n"
    "    - {path: \"parts.tube.stages[0].stroke_mm\", min: 100, max: 500, increment: 10}\n"
    "    - {path: \"parts.anti-climber.stages[0].force_kN\", min: 100, max: 900, increment: 50}\n";

/* Searches with the first n answers of `from` (NULL: none), of which `n_earlier` come in any
 * order, and keeps the rest. */
static CzStatus search(const Kept *from, long n, long n_earlier, long evaluations, Kept *kept,
                       CzOutcome **outcome, CzError *error) {
    CzProblem *problem = small_problem(sizing);
    CzEvaluator *evaluator;
    const CzEvaluatorOptions how = cz_evaluator_options_default();
    assert_int_equal(cz_evaluator_build(problem, &how, &evaluator, error), CZ_OK);
    kept->evaluator = evaluator;
    const CzJournal journal = {.n_answer = n,
                               .answer = from != NULL ? from->answer : NULL,
                               .n_earlier = n_earlier,
                               .keep = journal_keep,
                               .keep_data = kept};
    CzOptimiseOptions options = cz_optimise_options_default();
    options.journal = &journal;
    options.evaluations = evaluations;
    options.verify_methods = 0;
    *outcome = NULL;
    const CzStatus status = cz_optimise(evaluator, &options, outcome, error);
    cz_evaluator_free(evaluator);
    cz_problem_free(problem);
    return status;
}

static void assert_same(const CzOutcome *one, const CzOutcome *other) {
    const size_t n = (size_t)one->n_variable;
    assert_int_equal(one->n_trial, other->n_trial);
    assert_memory_equal(one->best, other->best, n * sizeof(double));
    assert_memory_equal(one->trial_x, other->trial_x, (size_t)one->n_trial * n * sizeof(double));
    for (long i = 0; i < one->n_trial; i++)
        assert_memory_equal(&one->trial[i].objective, &other->trial[i].objective, sizeof(double));
    assert_string_equal(one->why_stopped, other->why_stopped);
}

static void search_with_its_whole_journal_makes_no_run(void **state) {
    (void)state;
    CzOutcome *outcome, *again;
    CzError error = {0};
    Kept all = {0}, rest = {0};
    stand_in_reset();
    assert_int_equal(search(NULL, 0, 0, 80, &all, &outcome, &error), CZ_OK);
    assert_int_equal(all.n, outcome->n_evaluation);
    stand_in_reset();
    assert_int_equal(search(&all, all.n, 0, 80, &rest, &again, &error), CZ_OK);
    /* Only start, best design and its sensitivities are run, after the search; the start once more
     * in the scenario that decides, recorded. */
    const int n_design = 2 + 1 + outcome->n_variable;
    assert_true(stand_in.n_run <= n_design * outcome->best_evaluation.n_run + 1);
    assert_int_equal(rest.n, 0);
    assert_same(outcome, again);
    journal_forget(&all);
    cz_outcome_free(outcome);
    cz_outcome_free(again);
}

static void search_goes_on_from_any_part_of_its_journal(void **state) {
    (void)state;
    CzOutcome *outcome, *again;
    CzError error = {0};
    Kept all = {0};
    stand_in_reset();
    assert_int_equal(search(NULL, 0, 0, 80, &all, &outcome, &error), CZ_OK);
    for (long n = 0; n < all.n; n += 7) {
        Kept rest = {0};
        assert_int_equal(search(&all, n, 0, 80, &rest, &again, &error), CZ_OK);
        assert_int_equal(rest.n, all.n - n);
        for (long i = 0; i < rest.n; i++)
            assert_memory_equal(rest.answer[i].x, all.answer[n + i].x, 2 * sizeof(double));
        assert_same(outcome, again);
        journal_forget(&rest);
        cz_outcome_free(again);
    }
    journal_forget(&all);
    cz_outcome_free(outcome);
}

static void kept_best_design_is_that_of_the_search(void **state) {
    (void)state;
    CzOutcome *outcome;
    CzError error = {0};
    Kept all = {0};
    stand_in_reset();
    assert_int_equal(search(NULL, 0, 0, 80, &all, &outcome, &error), CZ_OK);
    double best = INFINITY;
    for (long i = 0; i < outcome->n_trial; i++)
        if (outcome->trial[i].feasible)
            best = fmin(best, outcome->trial[i].objective);
    assert_true(isfinite(best));
    assert_near(all.best_violation, 0, 0, 0);
    bool is_found = false;
    for (long i = 0; i < outcome->n_trial; i++)
        is_found |= outcome->trial[i].objective == best &&
                    memcmp(all.best, outcome->trial_x + 2 * i, 2 * sizeof(double)) == 0;
    assert_true(is_found);
    journal_forget(&all);
    cz_outcome_free(outcome);
}

static void search_with_a_higher_limit_takes_what_it_finds(void **state) {
    (void)state;
    CzOutcome *shorter, *longer, *continued;
    CzError error = {0};
    Kept few = {0}, all = {0}, rest = {0};
    stand_in_reset();
    assert_int_equal(search(NULL, 0, 0, 40, &few, &shorter, &error), CZ_OK);
    assert_int_equal(search(NULL, 0, 0, 80, &all, &longer, &error), CZ_OK);
    assert_int_equal(search(&few, few.n, few.n, 80, &rest, &continued, &error), CZ_OK);
    assert_same(longer, continued);
    assert_true(rest.n < all.n);
    journal_forget(&few);
    journal_forget(&all);
    journal_forget(&rest);
    cz_outcome_free(shorter);
    cz_outcome_free(longer);
    cz_outcome_free(continued);
}

static void journal_of_another_search_is_refused(void **state) {
    (void)state;
    CzOutcome *outcome, *again;
    CzError error = {0};
    Kept all = {0}, rest = {0};
    stand_in_reset();
    assert_int_equal(search(NULL, 0, 0, 80, &all, &outcome, &error), CZ_OK);
    ((double *)all.answer[20].x)[0] += 1e-13 * all.answer[20].x[0];
    assert_int_equal(search(&all, all.n, 0, 80, &rest, &again, &error), CZ_STATUS_INPUT);
    assert_null(again);
    assert_non_null(strstr(error.message, "evaluation 21 of the journal is of another design"));
    journal_forget(&all);
    cz_outcome_free(outcome);
}

static void evaluation_that_cannot_be_kept_ends_the_search(void **state) {
    (void)state;
    CzOutcome *outcome, *again;
    CzError error = {0};
    Kept all = {.fails_at = 30}, rest = {0};
    stand_in_reset();
    assert_int_equal(search(NULL, 0, 0, 80, &all, &outcome, &error), CZ_STATUS_OUTPUT);
    assert_null(outcome);
    assert_string_equal(error.message, "the disk is full");
    assert_int_equal(all.n, 30);
    assert_int_equal(search(&all, all.n, 0, 80, &rest, &again, &error), CZ_OK);
    journal_forget(&all);
    journal_forget(&rest);
    cz_outcome_free(again);
}

/* The search itself was not interrupted, but its design is not verified. */
static void interrupted_verification_is_an_interruption(void **state) {
    (void)state;
    CzError error = {0};
    volatile sig_atomic_t stop = 0;
    CzOptimiseOptions options = cz_optimise_options_default();
    stand_in_reset();
    Case made = begin(sizing, 1);
    options.verify_methods = 0;
    optimise(&made, &options);
    assert_int_equal(made.outcome->status, CZ_OUTCOME_FEASIBLE);
    options = cz_optimise_options_default();
    options.stop = &stop;
    stop = 1;
    assert_int_equal(cz_outcome_verify(made.evaluator, &options, made.outcome, &error), CZ_OK);
    assert_null(made.outcome->verification);
    assert_int_equal(made.outcome->status, CZ_OUTCOME_INTERRUPTED);
    assert_string_equal(made.outcome->why_stopped, "interrupted during the verification");
    end(&made);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(search_with_its_whole_journal_makes_no_run),
        cmocka_unit_test(search_goes_on_from_any_part_of_its_journal),
        cmocka_unit_test(kept_best_design_is_that_of_the_search),
        cmocka_unit_test(search_with_a_higher_limit_takes_what_it_finds),
        cmocka_unit_test(journal_of_another_search_is_refused),
        cmocka_unit_test(evaluation_that_cannot_be_kept_ends_the_search),
        cmocka_unit_test(interrupted_verification_is_an_interruption),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
