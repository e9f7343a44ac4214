/* What surrounds a run: start of the program, reading, building, recording, writing. */
#include "bench/cases.h"

#include <fcntl.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

static const char problem_file[] = "problems/metro-6-car.yaml";
static const char recorded_file[] = "problems/two-cars-25kmh.yaml";
static const char result_folder[] = "build/bench-results";
static const char search_folder[] = "build/bench-search";

/* ---- the program ---- */

/* Runs the program to its end without output; the time on the wall [s]. */
static double run_program(char *const arguments[]) {
    char *const environment[] = {NULL};
    posix_spawn_file_actions_t quiet;
    pid_t child;
    int status = 1;
    posix_spawn_file_actions_init(&quiet);
    posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    const double start = cz_clock();
    if (posix_spawn(&child, arguments[0], &quiet, NULL, arguments, environment) != 0 ||
        waitpid(child, &status, 0) != child || status != 0)
        bench_stop("the program cannot be run, or fails");
    const double time = cz_clock() - start;
    posix_spawn_file_actions_destroy(&quiet);
    return time;
}

static double start_program(void *program) {
    return run_program((char *const[]){program, "version", NULL});
}

static double search_metro(void *program) {
    return run_program((char *const[]){program, "optimise", (char *)problem_file, "--output",
                                       (char *)search_folder, "--quiet", NULL});
}

/* ---- reading and building ---- */

static double read_problem(void *data) {
    const double start = cz_processor_clock();
    CzProblem *problem = bench_read(data, NULL);
    const double time = cz_processor_clock() - start;
    cz_problem_free(problem);
    return time;
}

static double build_model(void *data) {
    CzModel *model = NULL;
    CzError error = {0};
    const double start = cz_processor_clock();
    if (cz_model_build(data, 0, &model, &error) != CZ_OK)
        bench_stop(error.message);
    const double time = cz_processor_clock() - start;
    cz_model_free(model);
    return time;
}

/* ---- writing ---- */

/* An evaluation with everything recorded, made once. */
typedef struct Finished {
    CzProblem *problem;
    CzEvaluator *evaluator;
    CzEvaluation evaluation;
} Finished;

static Finished *finish(const char *file) {
    Finished *finished = calloc(1, sizeof *finished);
    CzEvaluatorOptions options = cz_evaluator_options_default();
    CzError error = {0};
    if (finished == NULL)
        bench_stop("no memory");
    finished->problem = bench_read(file, NULL);
    if (cz_evaluator_build(finished->problem, &options, &finished->evaluator, &error) != CZ_OK ||
        cz_evaluate(finished->evaluator, 1, NULL, true, &finished->evaluation, &error) != CZ_OK)
        bench_stop(error.message);
    return finished;
}

static CzReport report_of(const Finished *finished) {
    return (CzReport){
        .kind = CZ_REPORT_RUN, .problem = finished->problem, .evaluation = &finished->evaluation};
}

static double write_page(void *data) {
    const CzReport report = report_of(data);
    CzError error = {0};
    FILE *stream = tmpfile();
    if (stream == NULL)
        bench_stop("no temporary file");
    const double start = cz_processor_clock();
    if (cz_report_write_page(&report, stream, &error) != CZ_OK)
        bench_stop(error.message);
    const double time = cz_processor_clock() - start;
    fclose(stream);
    return time;
}

static double write_folder(void *data) {
    const CzReport report = report_of(data);
    CzError error = {0};
    const double start = cz_processor_clock();
    if (cz_report_write_folder(&report, result_folder, &error) != CZ_OK)
        bench_stop(error.message);
    return cz_processor_clock() - start;
}

void bench_add_program(Bench *bench, const char *program) {
    bench_add(bench, "program.start", "crushzone version", start_program, (void *)program)
        ->is_wall = true;
    bench_add(bench, "program.read", "reading metro-6-car.yaml", read_problem,
              (void *)problem_file);
    bench_add(bench, "program.build", "set-up of one scenario of the metro", build_model,
              bench_read(problem_file, NULL));
    BenchRun *plain = bench_problem(recorded_file, NULL);
    BenchRun *recorded = bench_problem(recorded_file, NULL);
    recorded->options.record = true;
    bench_add(bench, "program.run", "two cars at 25 km/h each, not recorded", bench_run, plain);
    bench_add(bench, "program.record", "two cars at 25 km/h each, recorded", bench_run, recorded);
    Finished *finished = finish(recorded_file);
    bench_add(bench, "program.page", "report of the same as one page", write_page, finished);
    bench_add(bench, "program.folder", "whole result folder of the same", write_folder, finished);
}

void bench_add_search(Bench *bench, const char *program) {
    BenchCase *added = bench_add(bench, "long.search", "metro-6-car.yaml optimised by default",
                                 search_metro, (void *)program);
    added->is_wall = true;
    added->most = 1;
}
