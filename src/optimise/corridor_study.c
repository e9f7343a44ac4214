/* A corridor in workers, which prepare it as its owner does. */
#include <stdlib.h>

#include "base/error.h"
#include "evaluate/tasks.h"
#include "optimise/corridor.h"
#include "problem/problem_bytes.h"

static void describe(const void *data, CzMemoryText *description) {
    const CzCorridor *corridor = data;
    const CzCorridorOptions *options = &corridor->parts->options;
    cz_problem_put(description, corridor->problem);
    cz_put_text(description, options->part);
    cz_put_int(description, options->has_scatter);
    cz_put_int(description, corridor->n_random);
    cz_put(description, &corridor->seed, 1, sizeof corridor->seed);
}

/* The study of a worker. */
typedef struct Opened {
    CzProblemSteps problem;
    CzArena arena;
    CzCorridor *corridor; /* its problem is that above */
} Opened;

static CzCorridor *create(const CzCorridorOptions *options, CzProblem *problem) {
    CzCorridor *made = calloc(1, sizeof *made);
    CzCorridorParts *parts = calloc(1, sizeof *parts);
    if (made == NULL || parts == NULL) {
        free(made);
        free(parts);
        return NULL;
    }
    parts->options = *options;
    parts->executor = cz_executor_none();
    made->parts = parts;
    made->problem = problem;
    return made;
}

static CzStatus open_corridor(CzReading *description, void **study, CzError *error) {
    Opened *opened = *study = calloc(1, sizeof *opened);
    CzCorridorOptions options = cz_corridor_options_default();
    if (opened == NULL)
        return cz_no_memory(error, "a study");
    CZ_TRY(cz_problem_get(description, &opened->problem, error));
    options.part = cz_get_text(description, &opened->arena);
    options.has_scatter = cz_get_int(description) != 0;
    options.n_random = cz_get_int(description);
    cz_get(description, &options.seed, 1, sizeof options.seed);
    if (options.part == NULL || description->has_ended)
        return cz_no_memory(error, "a study");
    opened->corridor = create(&options, opened->problem.step[opened->problem.n - 1]);
    if (opened->corridor == NULL)
        return cz_no_memory(error, "a study");
    return cz_corridor_prepare(opened->corridor, error);
}

static CzStatus answer_task(void *study, CzReading *request, CzMemoryText *answer, CzError *error) {
    CzCorridor *corridor = ((Opened *)study)->corridor;
    switch (cz_get_int(request)) {
    case CZ_CORRIDOR_CURVES:
        return cz_corridor_answer_curves(corridor, request, answer, error);
    case CZ_CORRIDOR_ADVERSARY:
        return cz_corridor_answer_adversary(corridor, request, answer, error);
    default:
        return cz_no_memory(error, "a task");
    }
}

static void close_corridor(void *study) {
    Opened *opened = study;
    if (opened == NULL)
        return;
    if (opened->corridor != NULL)
        opened->corridor->problem = NULL;
    cz_corridor_free(opened->corridor);
    cz_problem_steps_free(&opened->problem);
    cz_arena_free(&opened->arena);
    free(opened);
}

const CzStudyKind cz_study_of_corridor = {open_corridor, answer_task, close_corridor};

CzStudy cz_corridor_study(const CzCorridor *corridor) {
    return (CzStudy){.executor = corridor->parts->executor,
                     .kind = CZ_STUDY_OF_CORRIDOR,
                     .describe = describe,
                     .data = corridor};
}
