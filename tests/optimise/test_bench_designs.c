/* The design problems of problems/bench-designs: each is read, and its best known design gives the
 * objective that is recorded beside it. */
#include "bench/best_known.h"
#include "support/check.h"

#include <dirent.h>

enum { MIN_DESIGNS = 8, MAX_DESIGNS = 40 };

static int list_files(char file[MAX_DESIGNS][256]) {
    DIR *folder = opendir(CZ_SOURCE_FOLDER "/problems/bench-designs");
    int n = 0;
    assert_non_null(folder);
    for (const struct dirent *entry; (entry = readdir(folder)) != NULL;) {
        if (strstr(entry->d_name, ".yaml") == NULL)
            continue;
        assert_true(n < MAX_DESIGNS);
        snprintf(file[n++], 256, CZ_SOURCE_FOLDER "/problems/bench-designs/%.100s", entry->d_name);
    }
    closedir(folder);
    return n;
}

static void check_best(const char *file) {
    const BestKnown best = best_known_of(file);
    const CzEvaluatorOptions options = {.n_job = 1, .step_factor = 1};
    CzProblem *problem;
    CzEvaluator *evaluator;
    CzEvaluation evaluation;
    CzError error = {0};
    if (cz_problem_read(file, NULL, &problem, &error) != CZ_OK ||
        cz_evaluator_build(problem, &options, &evaluator, &error) != CZ_OK)
        fail_msg("%s: %s", file, error.message);
    if (best.n != cz_evaluator_n_variable(evaluator))
        fail_msg("%s: the best known design has %d numbers", file, best.n);
    assert_int_equal(cz_evaluate(evaluator, 1, best.x, false, &evaluation, &error), CZ_OK);
    /* both are the same computation; the file has all digits */
    if (fabs(evaluation.objective - best.objective) > 1e-9 * fabs(best.objective) ||
        (evaluation.violation <= 0) != best.is_feasible)
        fail_msg("%s: objective %.17g, violation %g", file, evaluation.objective,
                 evaluation.violation);
    cz_evaluation_free(&evaluation);
    cz_evaluator_free(evaluator);
    cz_problem_free(problem);
}

static void best_known_designs_have_the_recorded_objective(void **state) {
    (void)state;
    char file[MAX_DESIGNS][256];
    const int n = list_files(file);
    assert_true(n >= MIN_DESIGNS);
    for (int i = 0; i < n; i++)
        check_best(file[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(best_known_designs_have_the_recorded_objective),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
