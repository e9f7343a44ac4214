/* Full vehicles: lengths and tracks, batches and threads, gradient, second solvers, the published
 * example. */
#include "bench/cases.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "evaluate/evaluator.h"
#include "simulate/batch.h"

enum { MAX_DESIGNS = 8, MAX_SET = 4, GRADIENT = 12 };

/* ---- problems and runs ---- */

CzProblem *bench_read(const char *file, const char *const *set) {
    CzProblemOptions options = cz_problem_options_default();
    CzProblem *problem = NULL;
    CzError error = {0};
    options.share_folder = "problems";
    options.set = set;
    while (set != NULL && set[options.n_set] != NULL)
        options.n_set++;
    if (cz_problem_read(file, &options, &problem, &error) != CZ_OK)
        bench_stop(error.message);
    return problem;
}

BenchRun *bench_problem(const char *file, const char *const *set) {
    BenchRun *run = calloc(1, sizeof *run);
    CzError error = {0};
    if (run == NULL)
        bench_stop("no memory");
    run->problem = bench_read(file, set);
    if (cz_model_build(run->problem, 0, &run->model, &error) != CZ_OK)
        bench_stop(error.message);
    run->options = cz_simulate_options_default();
    run->options.record = false;
    run->n_design = 1;
    return run;
}

BenchRun *bench_chain(int n) {
    char first[64], second[64];
    snprintf(first, sizeof first, "trains.A.vehicles[0].repeat=%d", n - 1);
    snprintf(second, sizeof second, "trains.B.vehicles[0].repeat=%d", n);
    return bench_problem("tests/bench/chain.yaml", (const char *const[]){first, second, NULL});
}

BenchRun *bench_train(int n, const char *track) {
    char length[64], on[48];
    snprintf(on, sizeof on, "simulation.track=%s", track);
    snprintf(length, sizeof length, "trains.A.vehicles[0].repeat=%d", n - 1);
    if (n == 1)
        return bench_problem("tests/bench/pair.yaml", (const char *const[]){on, NULL});
    return bench_problem("tests/bench/train.yaml", (const char *const[]){on, length, NULL});
}

/* Runs all designs once and gives the first run, to be freed. */
static CzRun *simulate(const BenchRun *run) {
    CzRun *made[MAX_DESIGNS] = {NULL};
    CzPlannedRun planned[MAX_DESIGNS];
    CzError error = {0};
    for (int i = 0; i < run->n_design; i++)
        planned[i] = (CzPlannedRun){run->model, NULL};
    if (cz_simulate_batch(run->n_design, planned, &run->options, made, &error) != CZ_OK)
        bench_stop(error.message);
    for (int i = 0; i < run->n_design; i++)
        if (cz_run_summary(made[i])->status != CZ_OK)
            bench_stop(cz_run_summary(made[i])->failure);
    for (int i = 1; i < run->n_design; i++)
        cz_run_free(made[i]);
    return made[0];
}

double bench_run(void *run) {
    const double start = cz_processor_clock();
    CzRun *made = simulate(run);
    const double time = cz_processor_clock() - start;
    cz_run_free(made);
    return time;
}

/* ---- lengths and tracks ---- */

static const char *const tracks[] = {"rigid", "receptance", "modal"};

void bench_add_trains(Bench *bench, bool is_short) {
    char key[48], what[96];
    for (int n = 1; n <= (is_short ? 1 : 16); n *= 2)
        for (size_t track = 0; track < sizeof tracks / sizeof *tracks; track++) {
            snprintf(key, sizeof key, "train.%s.%d", tracks[track], n);
            snprintf(what, sizeof what, "full vehicles %d+%d, track %s", n, n, tracks[track]);
            bench_add(bench, key, what, bench_run, bench_train(n, tracks[track]));
        }
}

/* ---- batches and threads ---- */

/* Designs through all scenarios as a search runs them. */
typedef struct Search {
    CzEvaluator *evaluator;
    int n_design;
    const double *x; /* (n_design x n_variable); NULL: the file's own values */
    bool is_wall;
} Search;

static double search(void *data) {
    const Search *made = data;
    double (*const clock)(void) = made->is_wall ? cz_clock : cz_processor_clock;
    CzEvaluation *evaluation = calloc((size_t)made->n_design, sizeof *evaluation);
    CzError error = {0};
    if (evaluation == NULL)
        bench_stop("no memory");
    const double start = clock();
    if (cz_evaluator_search(made->evaluator, made->n_design, made->x, evaluation, NULL, &error) !=
        CZ_OK)
        bench_stop(error.message);
    const double time = clock() - start;
    for (int i = 0; i < made->n_design; i++)
        cz_evaluation_free(&evaluation[i]);
    free(evaluation);
    return time;
}

static Search *new_search(const CzProblem *problem, int n_job, int n_design, const double *x) {
    Search *made = calloc(1, sizeof *made);
    CzEvaluatorOptions options = cz_evaluator_options_default();
    CzError error = {0};
    options.n_job = n_job;
    if (made == NULL || cz_evaluator_build(problem, &options, &made->evaluator, &error) != CZ_OK)
        bench_stop(made == NULL ? "no memory" : error.message);
    made->n_design = n_design;
    made->x = x;
    return made;
}

static void add_threads(Bench *bench, int n_design) {
    char key[48], what[96];
    for (int n_job = 1; n_job <= 2; n_job++) {
        const BenchRun *run = bench_train(8, "receptance");
        Search *made = new_search(run->problem, n_job, n_design, NULL);
        made->is_wall = true;
        snprintf(key, sizeof key, "threads.%d", n_job);
        snprintf(what, sizeof what, "a design of %d, 8+8 in a search, %d thread%s", n_design, n_job,
                 n_job > 1 ? "s" : "");
        BenchCase *added = bench_add(bench, key, what, search, made);
        added->is_wall = true;
        added->per = n_design;
    }
}

/* Designs of a problem in all of its scenarios on one thread; a time for each run. */
static void add_scenarios(Bench *bench, const char *key, const char *what, const char *file,
                          const char *only, int n_design, int n_scenario) {
    CzEvaluatorOptions options = cz_evaluator_options_default();
    Search *made = calloc(1, sizeof *made);
    CzError error = {0};
    options.n_job = 1;
    options.scenario = only;
    if (made == NULL ||
        cz_evaluator_build(bench_read(file, NULL), &options, &made->evaluator, &error) != CZ_OK)
        bench_stop(made == NULL ? "no memory" : error.message);
    made->n_design = n_design;
    bench_add(bench, key, what, search, made)->per = n_design * n_scenario;
}

static void add_mixed(Bench *bench) {
    const char *const metro = "problems/metro-6-car.yaml", *const samples =
                                                               "tests/bench/samples.yaml";
    add_scenarios(bench, "scenarios.metro.1", "a run of 1 design in 7 scenarios, metro", metro,
                  NULL, 1, 7);
    add_scenarios(bench, "scenarios.metro.12", "a run of 12 designs in 7 scenarios, metro", metro,
                  NULL, 12, 7);
    add_scenarios(bench, "scenarios.pair.64", "a run of 64 scenarios, 1+1", samples, NULL, 1, 64);
    add_scenarios(bench, "scenarios.pair.1", "one of these scenarios alone", samples,
                  "sample_30km_h_5mm_0.25", 1, 1);
}

void bench_add_batches(Bench *bench, bool is_short) {
    char key[48], what[96];
    for (int n = 1; n <= (is_short ? 1 : 8); n *= 8)
        for (int n_design = 1; n_design <= MAX_DESIGNS; n_design *= 2) {
            BenchRun *run = bench_train(n, "receptance");
            run->options.brief = true;
            run->n_design = n_design;
            snprintf(key, sizeof key, "batch.%d.%d", n, n_design);
            snprintf(what, sizeof what, "a design of %d in lanes, %d+%d as in a search", n_design,
                     n, n);
            bench_add(bench, key, what, bench_run, run)->per = n_design;
        }
    if (is_short)
        return;
    add_threads(bench, 24);
    add_mixed(bench);
}

/* ---- gradient ---- */

void bench_add_gradient(Bench *bench) {
    static double x[(GRADIENT + 1) * GRADIENT]; /* the start, and a step along each variable */
    const CzProblem *problem = bench_read("tests/bench/variables.yaml", NULL);
    Search *all = new_search(problem, 1, GRADIENT + 1, x), *one = new_search(problem, 1, 1, x);
    if (cz_evaluator_n_variable(all->evaluator) != GRADIENT)
        bench_stop("variables.yaml has not twelve variables");
    for (int point = 0; point <= GRADIENT; point++)
        for (int i = 0; i < GRADIENT; i++) {
            const CzVariableInfo *info = cz_evaluator_variable(all->evaluator, i);
            x[point * GRADIENT + i] =
                info->start + (point == i + 1 ? 1e-3 * (info->max - info->min) : 0.0);
        }
    bench_add(bench, "gradient.13", "two cars, value and 12 differences together", search, all);
    bench_add(bench, "gradient.1", "two cars, one evaluation in a search", search, one);
}

/* ---- second solvers ---- */

void bench_add_references(Bench *bench, bool is_short) {
    static const char *const names[] = {"zhai", "erk", "adams"};
    char key[48], what[96];
    for (int n = 1; n <= (is_short ? 1 : 8); n *= 8)
        for (int i = 0; i < CZ_N_INTEGRATOR; i++) {
            BenchRun *run = bench_train(n, "rigid");
            run->options.integrator = (CzIntegrator)i;
            snprintf(key, sizeof key, "solver.%s.%d", names[i], n);
            snprintf(what, sizeof what, "full vehicles %d+%d, rigid track, %s", n, n,
                     cz_integrator_text((CzIntegrator)i));
            bench_add(bench, key, what, bench_run, run);
        }
}

/* ---- the published example ---- */

static const char *const example[] = {"simulation.track=modal", "simulation.duration_ms=200", NULL};

/* The steps alone, by the run's own clock. */
static double run_example(void *data) {
    CzRun *made = simulate(data);
    const double time = cz_run_summary(made)->wall_s;
    cz_run_free(made);
    return time;
}

/* Everything before the first step. */
static double set_up_example(void *data) {
    (void)data;
    const double start = cz_clock();
    BenchRun *run = bench_problem("problems/paper-25kmh.yaml", example);
    double time = cz_clock() - start;
    CzRun *made = simulate(run);
    time += cz_run_summary(made)->setup_s;
    cz_run_free(made);
    cz_model_free(run->model);
    cz_problem_free(run->problem);
    free(run);
    return time;
}

void bench_add_example(Bench *bench) {
    BenchRun *run = bench_problem("problems/paper-25kmh.yaml", example);
    bench_add(bench, "example.run", "published example, modal track, 0.2 s: steps", run_example,
              run)
        ->is_wall = true;
    bench_add(bench, "example.setup", "published example: reading and set-up", set_up_example, NULL)
        ->is_wall = true;
}
