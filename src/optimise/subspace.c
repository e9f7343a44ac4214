/* The evaluator as a function of the numbers of one combination of choices. */
#include "optimise/subspace.h"
#include "base/error.h"
#include "evaluate/evaluator.h"

#include <string.h>

void cz_subspace_expand(const CzSubspace *subspace, const double *number, double *x) {
    memcpy(x, subspace->made, (size_t)subspace->n_all * sizeof *x);
    for (int i = 0; i < subspace->function.n_variable; i++)
        x[subspace->number[i]] = number[i];
}

/* Evaluates the designs of a batch and returns their values in the constraints of the search. */
static CzStatus evaluate_batch(const CzSubspace *subspace, CzBatch *batch, double *objective,
                               double *constraint, double *detail, CzError *error) {
    CzReplay *replay = subspace->replay;
    const char *phase = subspace->search.phase;
    const int m = subspace->function.n_constraint;
    const int m_all = cz_evaluator_n_constraint(subspace->evaluator);
    CZ_TRY(cz_replay_evaluate(replay, batch, error));
    for (int i = 0; i < batch->n; i++) {
        objective[i] = batch->objective[i];
        for (int j = 0; j < m; j++)
            constraint[i * m + j] = batch->constraint[i * m_all + subspace->constraint[j]];
        const CzRecord record =
            cz_search_judge(&subspace->function, phase, objective[i], constraint + i * m);
        cz_replay_note(replay, &record, batch->x + i * subspace->n_all);
    }
    if (detail != NULL)
        memcpy(detail, batch->detail,
               (size_t)batch->n * (size_t)subspace->function.n_detail * sizeof *detail);
    return cz_replay_keep(replay, phase, batch, error);
}

static CzStatus evaluate_designs(void *data, int n_point, const double *numbers, double *objective,
                                 double *constraint, double *detail, CzError *error) {
    const CzSubspace *subspace = data;
    CzBatch batch;
    CzStatus status = cz_batch_create(subspace->replay, n_point, detail != NULL, &batch, error);
    for (int i = 0; i < n_point && status == CZ_OK; i++)
        cz_subspace_expand(subspace, numbers + i * subspace->function.n_variable,
                           batch.x + i * subspace->n_all);
    if (status == CZ_OK)
        status = evaluate_batch(subspace, &batch, objective, constraint, detail, error);
    cz_batch_free(&batch);
    return status;
}

bool cz_subspace_create(CzReplay *replay, int combination, const double *start, CzArena *arena,
                        CzSubspace *subspace) {
    CzEvaluator *evaluator = replay->evaluator;
    const int n_all = cz_evaluator_n_variable(evaluator);
    const int n_constraint = cz_evaluator_n_constraint(evaluator);
    const size_t room = (size_t)n_all;
    double *min = cz_arena_numbers(arena, room), *max = cz_arena_numbers(arena, room);
    double *first = cz_arena_numbers(arena, room), *step = cz_arena_numbers(arena, room);
    double *made = cz_arena_numbers(arena, room);
    CzConstraintKind *kind = cz_arena_allocate(arena, (size_t)n_constraint + 1, sizeof *kind);
    bool *is_activation = cz_arena_allocate(arena, (size_t)cz_evaluator_n_detail(evaluator) + 1,
                                            sizeof *is_activation);
    int *number = cz_arena_allocate(arena, room, sizeof *number);
    int *shown = cz_arena_allocate(arena, (size_t)n_constraint + 1, sizeof *shown);
    if (arena->out_of_memory)
        return false;
    int n = 0;
    cz_evaluator_mark_activations(evaluator, is_activation);
    cz_evaluator_set_combination(evaluator, combination, made);
    for (int i = 0; i < n_all; i++) {
        const CzVariableInfo *info = cz_evaluator_variable(evaluator, i);
        if (info->is_fixed)
            made[i] = info->fixed_at;
        if (info->is_fixed || info->n_choice > 0)
            continue;
        min[n] = info->min;
        max[n] = info->max;
        first[n] = start != NULL ? start[i] : info->start;
        step[n] = info->increment;
        number[n++] = i;
    }
    int m = 0;
    for (int j = 0; j < n_constraint; j++) {
        kind[m] = cz_evaluator_constraint_kind(evaluator, j);
        if (kind[m] != CZ_CONSTRAINT_NAMED_RULE)
            shown[m++] = j;
    }
    *subspace = (CzSubspace){.evaluator = evaluator,
                             .replay = replay,
                             .n_all = n_all,
                             .number = number,
                             .constraint = shown,
                             .made = made};
    subspace->function = (CzFunction){.n_variable = n,
                                      .n_constraint = m,
                                      .min = min,
                                      .max = max,
                                      .start = first,
                                      .step = step,
                                      .n_detail = cz_evaluator_n_detail(evaluator),
                                      .kind = kind,
                                      .is_activation = is_activation,
                                      .is_minimax = cz_evaluator_maximises_margin(evaluator),
                                      .is_fit = cz_evaluator_is_fit(evaluator),
                                      .evaluate = evaluate_designs,
                                      .data = subspace};
    return true;
}
