/* How long a step takes: two cars, and a train as wide batches of designs, on every instruction set
 * that this processor has. Prints processor times as JSON; no test compares them, because machines
 * differ.
 *
 *   bench [--short]     from the project's root; --short runs everything once
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "crushzone/crushzone.h"
#include "dynamics/dynamics.h"
#include "simulate/batch.h"

enum { MOST_REPEATS = 7, MOST_DESIGNS = 16 };

typedef struct {
    const char *name, *file;
    int n_design;
    bool record, brief;
} Case;

static const Case cases[] = {
    {"two cars, recorded", "problems/two-cars-25kmh.yaml", 1, true, false},
    {"two cars", "problems/two-cars-25kmh.yaml", 4, false, false},
    {"two cars", "problems/two-cars-25kmh.yaml", 16, false, false},
    {"metro", "problems/metro-6-car.yaml", 1, false, true},
    {"metro", "problems/metro-6-car.yaml", 4, false, true},
    {"metro", "problems/metro-6-car.yaml", 8, false, true},
};
static const char *const isas[] = {"baseline", "v3", "v4"};

/* Processor time: other work on the machine does not count [s]. */
static double seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int by_size(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void stop(const char *message) {
    fprintf(stderr, "bench: %s\n", message);
    exit(1);
}

/* One run of all designs [s]; the number of steps into *n_step. */
static double time_run(const CzModel *model, const Case *c, const CzSimulateOptions *options,
                       long *n_step) {
    CzRun *run[MOST_DESIGNS] = {NULL};
    CzError error = {0};
    const double start = seconds();
    if (cz_simulate_batch(model, c->n_design, NULL, options, run, &error) != CZ_OK)
        stop(error.message);
    const double end = seconds();
    *n_step = cz_run_summary(run[0])->n_step;
    for (int i = 0; i < c->n_design; ++i)
        cz_run_free(run[i]);
    return end - start;
}

static void print_case(const CzModel *model, const Case *c, const char *isa, int n_repeat,
                       const char *separator) {
    CzSimulateOptions options = cz_simulate_options_default();
    options.record = c->record;
    options.brief = c->brief;
    options.isa = isa;
    double time[MOST_REPEATS];
    long n_step = 0;
    for (int i = 0; i < n_repeat; ++i)
        time[i] = time_run(model, c, &options, &n_step);
    qsort(time, (size_t)n_repeat, sizeof time[0], by_size);
    const double least = time[0], median = time[n_repeat / 2], per_step = 1e6 / (double)n_step;
    printf("%s\n  {\"case\": \"%s\", \"designs\": %d, \"isa\": \"%s\", \"repeats\": %d, "
           "\"steps\": %ld,\n   \"min_ms\": %.3f, \"median_ms\": %.3f, \"min_us_per_step\": %.4f, "
           "\"median_us_per_step\": %.4f, \"min_us_per_design_step\": %.4f}",
           separator, c->name, c->n_design, isa, n_repeat, n_step, 1e3 * least, 1e3 * median,
           least * per_step, median * per_step, least * per_step / c->n_design);
    fflush(stdout);
}

int main(int argc, char **argv) {
    const bool is_short = argc > 1 && strcmp(argv[1], "--short") == 0;
    CzProblemOptions options = cz_problem_options_default();
    options.share_folder = "problems";
    const char *separator = "";
    printf("{\"version\": \"%s\", \"fastest\": \"%s\", \"results\": [", CZ_VERSION, cz_isa_name());
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        CzProblem *problem = NULL;
        CzModel *model = NULL;
        CzError error = {0};
        if (cz_problem_read(cases[k].file, &options, &problem, &error) != CZ_OK ||
            cz_model_build(problem, 0, &model, &error) != CZ_OK)
            stop(error.message);
        for (size_t i = 0; i < sizeof isas / sizeof isas[0]; ++i) {
            if (cz_kernel(isas[i]) == NULL)
                continue;
            print_case(model, &cases[k], isas[i], is_short ? 1 : MOST_REPEATS, separator);
            separator = ",";
        }
        cz_model_free(model);
        cz_problem_free(problem);
    }
    printf("\n]}\n");
    return 0;
}
