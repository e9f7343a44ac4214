/* Compares the usual search with single algorithms of NLopt on the problems of
 * problems/bench-designs.
 *
 *   bench_searches FILE...              one line of CSV for each problem, method and seed: distance
 *                                       of the best design from the best known one after 50, 100,
 *                                       200 and 400 evaluations, empty while no design passes, and
 *                                       the evaluations until it is within 1 %
 *   bench_searches --only METHOD N FILE...  of one method with N seeds
 *   bench_searches --long N FILE...     the best design of all methods and three seeds with N
 *                                       evaluations each, as a line of best-known.csv
 *
 * The distance is a share of the objective, of a margin its difference. Where variables have
 * catalogue increments, only designs on them count. Of a problem that no design passes, the
 * smallest margin counts. The numbers are the same on every machine.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/best_known.h"

static const char *const methods[] = {"auto",        "LN_COBYLA", "GN_ISRES",
                                      "GN_DIRECT_L", "LD_SLSQP",  "GN_CRS2_LM"};
static const long counts[] = {50, 100, 200, 400};
enum {
    N_METHOD = sizeof methods / sizeof *methods,
    N_COUNT = sizeof counts / sizeof *counts,
    MOST_COUNT = 400,
    N_SEED = 10,
    N_LONG_SEED = 3
};

static void stop(const char *what, const char *why) {
    fprintf(stderr, "bench_searches: %s: %s\n", what, why);
    exit(1);
}

/* Whether every number of a design is on its catalogue increment. */
static bool is_on_increments(const CzEvaluator *evaluator, const double *x) {
    for (int i = 0; i < cz_evaluator_n_variable(evaluator); i++) {
        const double step = cz_evaluator_variable(evaluator, i)->increment;
        if (step > 0 && round(x[i] / step) * step != x[i])
            return false;
    }
    return true;
}

static CzOutcome *search(CzEvaluator *evaluator, const char *method, long seed, long evaluations) {
    CzOptimiseOptions options = cz_optimise_options_default();
    CzOutcome *outcome;
    CzError error = {0};
    options.algorithm = method;
    options.evaluations = evaluations;
    options.seed = seed;
    options.verify_methods = 0;
    if (cz_optimise(evaluator, &options, &outcome, &error) != CZ_OK)
        stop(method, error.message);
    return outcome;
}

/* Prints the line of one search. */
static void compare(CzEvaluator *evaluator, const BestKnown *best, const char *method, long seed) {
    CzOutcome *outcome = search(evaluator, method, seed, MOST_COUNT);
    const double scale = cz_evaluator_maximises_margin(evaluator) ? 1.0 : fabs(best->objective);
    double least = INFINITY;
    long reached = -1;
    int next = 0;
    printf("%s,%s,%ld", best->problem, method, seed);
    for (long i = 0; i < MOST_COUNT; i++) {
        const CzTrial *trial = i < outcome->n_trial ? &outcome->trial[i] : NULL;
        if (trial != NULL && (trial->feasible || !best->is_feasible) && trial->objective < least &&
            is_on_increments(evaluator, outcome->trial_x + i * outcome->n_variable))
            least = trial->objective;
        const double distance = (least - best->objective) / scale;
        if (reached < 0 && distance <= 0.01)
            reached = i + 1;
        if (i + 1 != counts[next])
            continue;
        next++;
        if (isfinite(distance))
            printf(",%.5f", distance);
        else
            printf(",");
    }
    if (reached > 0)
        printf(",%ld\n", reached);
    else
        printf(",\n");
    cz_outcome_free(outcome);
}

/* Prints the best design of long searches by all methods. */
static void find_best(CzEvaluator *evaluator, const char *problem, long evaluations) {
    CzOutcome *best = NULL;
    char how[64] = "";
    for (int method = 0; method < N_METHOD; method++)
        for (long seed = 1; seed <= N_LONG_SEED; seed++) {
            CzOutcome *outcome = search(evaluator, methods[method], seed, evaluations);
            const CzEvaluation *found = &outcome->best_evaluation;
            const CzEvaluation *so_far = best != NULL ? &best->best_evaluation : NULL;
            fprintf(stderr, "%s %s %ld: %.9g, violation %.3g\n", problem, methods[method], seed,
                    found->objective, found->violation);
            const bool is_better = so_far == NULL || (found->violation > 0 || so_far->violation > 0
                                                          ? found->violation < so_far->violation
                                                          : found->objective < so_far->objective);
            if (is_better) {
                snprintf(how, sizeof how, "%s,%ld,%ld", methods[method], seed, evaluations);
                cz_outcome_free(best);
                best = outcome;
            } else {
                cz_outcome_free(outcome);
            }
        }
    printf("%s,%.17g,%s,%s,", problem, best->best_evaluation.objective,
           best->best_evaluation.violation <= 0 ? "yes" : "no", how);
    for (int i = 0; i < best->n_variable; i++)
        printf("%s%.17g", i > 0 ? " " : "", best->best[i]);
    putchar('\n');
    cz_outcome_free(best);
}

int main(int argc, char **argv) {
    const bool is_long = argc > 2 && strcmp(argv[1], "--long") == 0;
    const bool is_one = argc > 3 && strcmp(argv[1], "--only") == 0;
    CzError error = {0};
    if (!is_long)
        puts("problem,method,seed,after_50,after_100,after_200,after_400,within_1_percent");
    for (int i = is_long ? 3 : is_one ? 4 : 1; i < argc; i++) {
        CzProblem *problem = NULL;
        CzEvaluator *evaluator = NULL;
        CzEvaluatorOptions options = cz_evaluator_options_default();
        options.n_job = 1;
        char name[64];
        best_known_name(argv[i], name);
        if (cz_problem_read(argv[i], NULL, &problem, &error) != CZ_OK ||
            cz_evaluator_build(problem, &options, &evaluator, &error) != CZ_OK)
            stop(argv[i], error.message);
        if (is_long) {
            find_best(evaluator, name, atol(argv[2]));
        } else {
            const BestKnown best = best_known_of(argv[i]);
            const int n_method = is_one ? 1 : N_METHOD;
            const long n_seed = is_one ? atol(argv[3]) : N_SEED;
            for (int method = 0; method < n_method; method++)
                for (long seed = 1; seed <= n_seed; seed++)
                    compare(evaluator, &best, is_one ? argv[2] : methods[method], seed);
        }
        fflush(stdout);
        cz_evaluator_free(evaluator);
        cz_problem_free(problem);
    }
    return 0;
}
