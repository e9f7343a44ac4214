/* The evaluator as a function of the numbers of one combination of choices. */
#include "optimise/subspace.h"
#include "base/error.h"
#include "evaluate/evaluator.h"
#include "evaluate/listed.h"

#include <math.h>
#include <string.h>

void cz_subspace_expand(const CzSubspace *subspace, const double *number, double *x) {
    memcpy(x, subspace->made, (size_t)subspace->n_all * sizeof *x);
    for (int i = 0; i < subspace->function.n_variable; i++)
        x[subspace->number[i]] = cz_search_value(
            cz_evaluator_variable(subspace->evaluator, subspace->number[i]), number[i]);
}

/* Adds the required margins; a design that was not verified counts as one that fails a yes or no.
 */
static void require(const CzSubspace *subspace, const double *x, double *constraint) {
    const double failed_flag = 0.01;
    const CzRequired *required = subspace->replay->required;
    const int m = subspace->function.n_constraint;
    for (int j = 0; j < m; j++)
        constraint[j] += required->margin[subspace->constraint[j]];
    for (int i = 0; i < required->n; i++)
        if (m > 0 && memcmp(required->x[i], x, (size_t)subspace->n_all * sizeof *x) == 0)
            constraint[m - 1] = fmax(constraint[m - 1], failed_flag);
}

/* Adds the required margins to the details of a design. */
static void require_details(const CzSubspace *subspace, double *detail) {
    const CzRequired *required = subspace->replay->required;
    for (int j = 0; j < cz_evaluator_n_constraint(subspace->evaluator); j++)
        for (int i = cz_evaluator_n_detail_of(subspace->evaluator, j); i > 0; i--)
            *detail++ += required->margin[j];
}

/* Values of a design of a batch for the search; the record says how they rank. */
static CzRecord values_of(const CzSubspace *subspace, const CzBatch *batch, int design,
                          double *constraint) {
    const CzSelection *selection = &subspace->replay->selection;
    const int m_all = cz_evaluator_n_constraint(subspace->evaluator);
    const double *known = batch->constraint + design * m_all;
    for (int j = 0; j < subspace->function.n_constraint; j++)
        constraint[j] = isnan(batch->objective[design])
                            ? known[subspace->constraint[j]]
                            : cz_selection_value(selection, known, subspace->constraint[j]);
    if (subspace->replay->required != NULL)
        require(subspace, batch->x + design * subspace->n_all, constraint);
    CzRecord record = cz_search_judge(&subspace->function, subspace->search.phase,
                                      batch->objective[design], constraint);
    record.is_partial = !batch->is_whole[design];
    return record;
}

/* How designs are compared: a search continues from the best of all and ends at the best on the
 * increments, or at that with the smallest violation. */
typedef enum Rank { BEST, BEST_ON_GRID, MIN_VIOLATED, N_RANK } Rank;

static bool is_ranked_before(Rank rank, const CzRecord *one, const CzRecord *other) {
    if (other == NULL || isnan(one->objective))
        return !isnan(one->objective) && (rank != BEST_ON_GRID || one->on_grid);
    if (rank == MIN_VIOLATED)
        return other->violation > 0 && one->violation < other->violation;
    return (rank == BEST || one->on_grid) && cz_record_is_better(one, other);
}

/* The first of the designs that are run in all scenarios so far; NULL when there is none. */
static const CzRecord *first_of_search(const CzSearch *search, Rank rank) {
    const long number = rank == BEST_ON_GRID ? search->best_on_grid : search->best;
    const CzRecord *first = number >= 0 ? &search->record[number] : NULL;
    for (long i = 0; i < search->n_record && rank == MIN_VIOLATED; i++)
        if (!search->record[i].is_partial && is_ranked_before(rank, &search->record[i], first))
            first = &search->record[i];
    return first;
}

/* The first design of a batch that is not run in all scenarios and would be before all that are; -1
 * for none. */
static int find_leader(const CzSubspace *subspace, Rank rank, int n, const CzRecord *record) {
    const CzRecord *first = first_of_search(&subspace->search, rank);
    int leader = -1;
    for (int i = 0; i < n; i++)
        if (!record[i].is_partial && is_ranked_before(rank, &record[i], first))
            first = &record[i];
    for (int i = 0; i < n; i++)
        if (record[i].is_partial && is_ranked_before(rank, &record[i], first))
            first = &record[leader = i];
    return leader;
}

/* Whether a design that did not fail has no objective. */
static bool is_without_objective(const CzSubspace *subspace, const CzBatch *batch, int design) {
    const int m = cz_evaluator_n_constraint(subspace->evaluator);
    for (int j = 0; j < m && isnan(batch->objective[design]); j++)
        if (!isnan(batch->constraint[design * m + j]))
            return true;
    return false;
}

/* Runs one design in all scenarios. */
static CzStatus complete(const CzSubspace *subspace, CzBatch *batch, int design, double *constraint,
                         CzRecord *record, CzError *error) {
    const bool on_grid = record[design].on_grid;
    CZ_TRY(cz_replay_complete(subspace->replay, batch, design, error));
    record[design] =
        values_of(subspace, batch, design, constraint + design * subspace->function.n_constraint);
    record[design].on_grid = on_grid;
    return CZ_OK;
}

/* Runs the designs of a batch that would be the best so far in all scenarios, one after the other:
 * most are then not. */
static CzStatus complete_leaders(const CzSubspace *subspace, CzBatch *batch, double *constraint,
                                 CzError *error) {
    const int m = subspace->function.n_constraint;
    const size_t n_variable = (size_t)subspace->function.n_variable;
    CzRecord *record = cz_arena_allocate(&batch->arena, (size_t)batch->n, sizeof *record);
    double *number = cz_arena_numbers(&batch->arena, n_variable);
    if (record == NULL || number == NULL)
        return cz_no_memory(error, "the designs");
    for (int i = 0; i < batch->n; i++) {
        record[i] = values_of(subspace, batch, i, constraint + i * m);
        for (size_t k = 0; k < n_variable; k++)
            number[k] = batch->x[i * subspace->n_all + subspace->number[k]];
        record[i].on_grid = cz_search_is_on_grid(&subspace->search, number);
    }
    for (int i = 0; i < batch->n; i++) /* the objective may have a value in other scenarios */
        if (record[i].is_partial && is_without_objective(subspace, batch, i))
            CZ_TRY(complete(subspace, batch, i, constraint, record, error));
    for (Rank rank = BEST; rank < N_RANK; rank++) {
        if (rank == MIN_VIOLATED && !subspace->function.is_minimax)
            break;
        for (int leader; (leader = find_leader(subspace, rank, batch->n, record)) >= 0;)
            CZ_TRY(complete(subspace, batch, leader, constraint, record, error));
    }
    return CZ_OK;
}

/* Evaluates the designs of a batch and returns their values in the constraints of the search. */
static CzStatus evaluate_batch(CzSubspace *subspace, CzBatch *batch, double *objective,
                               double *constraint, double *detail, CzError *error) {
    CzReplay *replay = subspace->replay;
    const char *phase = subspace->search.phase;
    const int m = subspace->function.n_constraint;
    const int m_all = cz_evaluator_n_constraint(subspace->evaluator);
    CZ_TRY(cz_replay_evaluate(replay, batch, error));
    if (replay->selection.has_begun)
        CZ_TRY(complete_leaders(subspace, batch, constraint, error));
    for (int i = 0; i < batch->n; i++) {
        objective[i] = batch->objective[i];
        const CzRecord record = values_of(subspace, batch, i, constraint + i * m);
        cz_replay_note(replay, &record, batch->x + i * subspace->n_all);
    }
    for (int i = 0; i < batch->n; i++)
        cz_selection_note(&replay->selection, batch->is_whole[i], batch->objective[i],
                          batch->constraint + i * m_all);
    subspace->function.is_partial = NULL;
    if (replay->selection.is_on) {
        bool *is_partial = cz_arena_allocate(&replay->arena, (size_t)batch->n, sizeof(bool));
        if (is_partial == NULL)
            return cz_no_memory(error, "the designs");
        for (int i = 0; i < batch->n; i++)
            is_partial[i] = !batch->is_whole[i];
        subspace->function.is_partial = is_partial;
    }
    const int n_detail = subspace->function.n_detail;
    if (detail != NULL)
        memcpy(detail, batch->detail, (size_t)batch->n * (size_t)n_detail * sizeof *detail);
    for (int i = 0; i < batch->n && detail != NULL && replay->required != NULL; i++)
        require_details(subspace, detail + i * n_detail);
    return cz_replay_keep(replay, phase, batch, error);
}

static CzStatus evaluate_designs(void *data, int n_point, const double *numbers, double *objective,
                                 double *constraint, double *detail, CzError *error) {
    CzSubspace *subspace = data;
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
    CzDetailKind *detail_kind =
        cz_arena_allocate(arena, (size_t)cz_evaluator_n_detail(evaluator) + 1, sizeof *detail_kind);
    int *number = cz_arena_allocate(arena, room, sizeof *number);
    int *shown = cz_arena_allocate(arena, (size_t)n_constraint + 1, sizeof *shown);
    if (arena->out_of_memory)
        return false;
    int n = 0;
    cz_evaluator_detail_kinds(evaluator, detail_kind);
    cz_evaluator_set_combination(evaluator, combination, made);
    for (int i = 0; i < n_all; i++) {
        const CzVariableInfo *info = cz_evaluator_variable(evaluator, i);
        if (info->is_fixed)
            made[i] = info->fixed_at;
        if (info->is_fixed || info->n_choice > 0)
            continue;
        const CzSearchRange range = cz_search_range(info, start != NULL ? start[i] : info->start);
        min[n] = range.min;
        max[n] = range.max;
        first[n] = range.start;
        step[n] = range.step;
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
                                      .detail_kind = detail_kind,
                                      .is_minimax = cz_evaluator_maximises_margin(evaluator),
                                      .is_fit = cz_evaluator_is_fit(evaluator),
                                      .evaluate = evaluate_designs,
                                      .data = subspace};
    return true;
}
