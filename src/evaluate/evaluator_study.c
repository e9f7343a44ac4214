/* An evaluator in a worker: the same problem with the same options. */
#include "base/error.h"
#include "evaluate/evaluator_parts.h"
#include "problem/problem_bytes.h"

#include <stdlib.h>

void cz_evaluator_describe(const void *described, CzMemoryText *description) {
    const CzEvaluator *evaluator = described;
    const CzAim *aim = evaluator->aim;
    cz_problem_put(description, evaluator->problem);
    cz_put_text(description, evaluator->only);
    cz_put_int(description, evaluator->first_scenario);
    cz_put(description, &evaluator->manner, 1, sizeof evaluator->manner);
    cz_put_int(description, aim != NULL);
    if (aim == NULL)
        return;
    cz_put_text(description, aim->minimise);
    cz_put_text(description, aim->bounded);
    cz_put(description, aim, 1, sizeof *aim);
}

/* Problem and evaluator of a worker. */
typedef struct Opened {
    CzProblemSteps problem;
    CzEvaluator *evaluator;
} Opened;

static const CzAim *get_aim(CzReading *description, CzArena *arena, CzAim *aim) {
    if (cz_get_int(description) == 0)
        return NULL;
    const char *minimise = cz_get_text(description, arena);
    const char *bounded = cz_get_text(description, arena);
    cz_get(description, aim, 1, sizeof *aim);
    aim->minimise = minimise;
    aim->bounded = bounded;
    return aim;
}

CzStatus cz_evaluator_open(CzReading *description, void **study, CzError *error) {
    Opened *opened = *study = calloc(1, sizeof *opened);
    if (opened == NULL)
        return cz_no_memory(error, "a study");
    CzArena arena = {0};
    CzAim aim;
    CzManner manner;
    CzEvaluatorOptions options = cz_evaluator_options_default();
    CZ_TRY(cz_problem_get(description, &opened->problem, error));
    options.n_job = 1;
    options.scenario = cz_get_text(description, &arena);
    options.first_scenario = cz_get_int(description);
    cz_get(description, &manner, 1, sizeof manner);
    options.step_factor = manner.step_factor;
    options.integrator = manner.integrator;
    options.aim = get_aim(description, &arena, &aim);
    const CzStatus status = arena.out_of_memory || description->has_ended
                                ? cz_no_memory(error, "a study")
                                : cz_evaluator_build(cz_problem_of(&opened->problem), &options,
                                                     &opened->evaluator, error);
    cz_arena_free(&arena);
    return status;
}

void cz_evaluator_close(void *study) {
    Opened *opened = study;
    if (opened == NULL)
        return;
    cz_evaluator_free(opened->evaluator);
    cz_problem_steps_free(&opened->problem);
    free(opened);
}

const CzEvaluator *cz_evaluator_opened(void *study) {
    return ((Opened *)study)->evaluator;
}
