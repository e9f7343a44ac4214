/* Corridors: from a problem file to the edges of a device's curve.
 *
 *   part --problem/device.c--> stages --> pieces --problem/cases.c--> problem with the pieces
 *   factors of a curve --> values of the pieces --evaluate/cases.c--> scenarios --> verdict
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/clock.h"
#include "base/error.h"
#include "evaluate/tasks.h"
#include "optimise/corridor.h"

#define RESOLUTION 0.005 /* of the widths (ours) */
#define WIDEST 0.5       /* (ours) */
enum { USUAL_RANDOM = 16 /* quasi-random curves in a widest corridor (ours) */ };

CzCorridorOptions cz_corridor_options_default(void) {
    return (CzCorridorOptions){.seed = -1, .has_scatter = true};
}

static CzStatus read_problem(const char *file, const CzProblemOptions *problem_options,
                             CzCorridor *corridor, CzError *error) {
    const CzCorridorOptions *options = &corridor->parts->options;
    const CzProblemOptions none = cz_problem_options_default();
    const CzProblemOptions *with = problem_options != NULL ? problem_options : &none;
    return options->text != NULL
               ? cz_problem_read_text(options->text, options->n_text, "<standard input>", ".", with,
                                      &corridor->problem, error)
               : cz_problem_read(file, with, &corridor->problem, error);
}

/* Judges the design as written, with its reserves. */
static CzStatus evaluate_design(CzCorridor *corridor, CzError *error) {
    CzCorridorParts *parts = corridor->parts;
    CzEvaluatorOptions options = cz_evaluator_options_default();
    options.executor = &parts->executor;
    CZ_TRY(cz_evaluator_build(corridor->problem, &options, &parts->evaluator, error));
    cz_evaluator_set_stop(parts->evaluator, parts->options.stop);
    return cz_evaluate(parts->evaluator, 1, NULL, false, &corridor->design, error);
}

CzStatus cz_corridor_prepare(CzCorridor *corridor, CzError *error) {
    const CzCorridorParts *parts = corridor->parts;
    const CzUncertainty *uncertainty = &cz_problem_input(corridor->problem)->uncertainty;
    corridor->seed = parts->options.seed >= 0 ? parts->options.seed
                     : uncertainty->given     ? uncertainty->seed
                                              : 1;
    corridor->n_random = parts->options.n_random > 0 ? parts->options.n_random : USUAL_RANDOM;
    corridor->resolution = RESOLUTION;
    corridor->widest = WIDEST;
    corridor->edge[0].failing = corridor->edge[1].failing = -1;
    CZ_TRY(cz_corridor_divide(corridor, error));
    return cz_corridor_begin(corridor, error);
}

static CzStatus find(const char *file, const CzProblemOptions *problem_options,
                     CzCorridor *corridor, CzError *error) {
    CZ_TRY(read_problem(file, problem_options, corridor, error));
    CZ_TRY(cz_corridor_prepare(corridor, error));
    corridor->parts->study = cz_corridor_study(corridor);
    CzStatus status = evaluate_design(corridor, error);
    if (status == CZ_OK)
        status = cz_corridor_search(corridor, error);
    corridor->is_interrupted = status == CZ_STATUS_INTERRUPTED;
    CZ_TRY(corridor->is_interrupted ? CZ_OK : status);
    cz_corridor_fill_points(corridor);
    return CZ_OK;
}

CzStatus cz_corridor(const char *file, const CzProblemOptions *problem_options,
                     const CzCorridorOptions *options, CzCorridor **corridor, CzError *error) {
    const double started = cz_clock();
    CzCorridor *made = calloc(1, sizeof *made);
    CzCorridorParts *parts = calloc(1, sizeof *parts);
    *corridor = NULL;
    if (made == NULL || parts == NULL) {
        free(made);
        free(parts);
        return cz_no_memory(error, "a corridor");
    }
    made->parts = parts;
    parts->options = *options;
    parts->executor = cz_executor_choose(options->executor, options->n_job);
    const CzStatus status = find(file, problem_options, made, error);
    cz_study_end(&parts->study);
    made->wall_s = cz_clock() - started;
    if (status == CZ_OK)
        *corridor = made;
    else
        cz_corridor_free(made);
    return status;
}

void cz_corridor_free(CzCorridor *corridor) {
    if (corridor == NULL)
        return;
    CzCorridorParts *parts = corridor->parts;
    cz_evaluation_free(&corridor->design);
    cz_evaluator_free(parts->evaluator);
    cz_placed_device_free(&parts->device);
    cz_problem_free(parts->divided);
    cz_problem_free(corridor->problem);
    cz_arena_free(&parts->arena);
    free(corridor->curve);
    free(parts);
    free(corridor);
}
