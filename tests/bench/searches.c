/* Compares the usual search with single algorithms of NLopt on the problems of
 * problems/bench-designs.
 *
 *   bench_searches METHOD FILE...       one line for each problem and seed: problem, method, seed,
 *                                       and each improvement of the best design so far as
 *                                       evaluations:objective
 *   bench_searches --evaluations N METHOD FILE...   the same with N evaluations and three seeds
 *   bench_searches --table FILE <LINES  a line of CSV for each problem and method, from such lines
 *                                       and the best known objectives of FILE: share of seeds with
 *                                       a design that passes and median distance from the best
 *                                       known after 50, 100, 200 and 400 evaluations, and median
 *                                       evaluations to within 1 %
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
    MAX_COUNT = 400,
    N_SEED = 10,
    MAX_SEED = 20,
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
static void compare(CzEvaluator *evaluator, const BestKnown *best, const char *method, long seed,
                    long evaluations) {
    CzOutcome *outcome = search(evaluator, method, seed, evaluations);
    double least = INFINITY;
    printf("%s %s %ld", best->problem, method, seed);
    for (long i = 0; i < outcome->n_trial; i++) {
        const CzTrial *trial = &outcome->trial[i];
        if ((trial->feasible || !best->is_feasible) && trial->objective < least &&
            is_on_increments(evaluator, outcome->trial_x + i * outcome->n_variable)) {
            least = trial->objective;
            printf(" %ld:%.9g", i + 1, least);
        }
    }
    putchar('\n');
    cz_outcome_free(outcome);
}

/* ---- the table ---- */

/* All seeds of one problem and method. */
typedef struct Group {
    char problem[64], method[32];
    int n;
    double least[N_COUNT][MAX_SEED]; /* distances, infinite while no design passes */
    double reached[MAX_SEED];        /* evaluations to within 1 %, infinite when never */
} Group;

static int compare_numbers(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *number, int n) {
    qsort(number, (size_t)n, sizeof *number, compare_numbers);
    return n % 2 == 1 ? number[n / 2] : (number[n / 2 - 1] + number[n / 2]) / 2;
}

static void put_number(double number, int digits) {
    if (isfinite(number))
        printf(",%.*f", digits, number);
    else
        printf(",");
}

static void put_group(Group *group) {
    if (group->n == 0)
        return;
    printf("%s,%s,%d", group->problem, group->method, group->n);
    for (int k = 0; k < N_COUNT; k++) {
        int n_passed = 0;
        for (int i = 0; i < group->n; i++)
            n_passed += isfinite(group->least[k][i]);
        printf(",%.2f", (double)n_passed / group->n);
    }
    for (int k = 0; k < N_COUNT; k++)
        put_number(median(group->least[k], group->n), 5);
    put_number(median(group->reached, group->n), 0);
    put_number(group->reached[group->n - 1], 0); /* they are sorted now */
    putchar('\n');
    group->n = 0;
}

/* Adds the improvements of one line to a group. */
static void add_line(Group *group, char *improvements, const BestKnown *best) {
    const int at = group->n++;
    const bool is_margin = best->objective < 0 || !best->is_feasible;
    const double scale = is_margin ? 1.0 : best->objective;
    group->reached[at] = INFINITY;
    for (int k = 0; k < N_COUNT; k++)
        group->least[k][at] = INFINITY;
    for (char *word = strtok(improvements, " \n"); word != NULL; word = strtok(NULL, " \n")) {
        const long evaluations = atol(word);
        const double distance = (atof(strchr(word, ':') + 1) - best->objective) / scale;
        for (int k = 0; k < N_COUNT; k++)
            if (evaluations <= counts[k])
                group->least[k][at] = distance;
        if (distance <= 0.01 && !isfinite(group->reached[at]))
            group->reached[at] = (double)evaluations;
    }
}

static void make_table(const char *best_known) {
    static char line[1 << 16];
    Group group = {.n = 0};
    puts("problem,method,seeds,passed_50,passed_100,passed_200,passed_400,distance_50,distance_100,"
         "distance_200,distance_400,within_1_percent,slowest");
    while (fgets(line, sizeof line, stdin) != NULL) {
        char problem[64], method[32], file[512];
        int at = 0;
        if (sscanf(line, "%63s %31s %*d%n", problem, method, &at) != 2)
            continue;
        if (strcmp(problem, group.problem) != 0 || strcmp(method, group.method) != 0)
            put_group(&group);
        memcpy(group.problem, problem, sizeof problem);
        memcpy(group.method, method, sizeof method);
        snprintf(file, sizeof file, "%.*s%s.yaml", (int)(strrchr(best_known, '/') + 1 - best_known),
                 best_known, problem);
        const BestKnown best = best_known_of(file);
        if (group.n < MAX_SEED)
            add_line(&group, line + at, &best);
    }
    put_group(&group);
}

/* ---- the best known designs ---- */

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

/* Whether an algorithm uses random numbers; the others are run once. */
static bool is_random(const char *method) {
    return strcmp(method, "auto") == 0 || strstr(method, "ISRES") != NULL ||
           strstr(method, "CRS2") != NULL;
}

int main(int argc, char **argv) {
    if (argc == 3 && strcmp(argv[1], "--table") == 0) {
        make_table(argv[2]);
        return 0;
    }
    const bool is_long = argc > 3 && strcmp(argv[1], "--long") == 0;
    const bool is_counted = argc > 4 && strcmp(argv[1], "--evaluations") == 0;
    const char *method = argv[is_counted ? 3 : 1];
    const long evaluations = is_counted ? atol(argv[2]) : MAX_COUNT;
    const long n_seed = !is_random(method) ? 1 : is_counted ? N_LONG_SEED : N_SEED;
    for (int i = is_counted ? 4 : is_long ? 3 : 2; i < argc; i++) {
        CzProblem *problem = NULL;
        CzEvaluator *evaluator = NULL;
        CzError error = {0};
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
            for (long seed = 1; seed <= n_seed; seed++) {
                compare(evaluator, &best, method, seed, evaluations);
                fflush(stdout);
            }
        }
        fflush(stdout);
        cz_evaluator_free(evaluator);
        cz_problem_free(problem);
    }
    return 0;
}
