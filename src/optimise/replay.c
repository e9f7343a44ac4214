/* The journal of a search. */
#include "optimise/replay.h"
#include "base/error.h"

#include <math.h>
#include <string.h>

static size_t design_size(const CzReplay *replay) {
    return (size_t)cz_evaluator_n_variable(replay->evaluator) * sizeof(double);
}

/* Whether an answer has the constraints of the evaluator. */
static bool is_of_evaluator(const CzReplay *replay, const CzAnswer *answer) {
    return answer->n_constraint == cz_evaluator_n_constraint(replay->evaluator) &&
           answer->n_detail == cz_evaluator_n_detail(replay->evaluator);
}

CzStatus cz_replay_begin(CzReplay *replay, CzEvaluator *evaluator, const CzJournal *journal,
                         CzError *error) {
    *replay = (CzReplay){.evaluator = evaluator, .journal = journal};
    replay->earlier.arena = &replay->arena;
    CZ_TRY(cz_selection_begin(&replay->selection, evaluator, error));
    if (journal == NULL)
        return CZ_OK;
    const size_t size = design_size(replay);
    replay->next = journal->n_earlier;
    replay->best_x = cz_arena_numbers(&replay->arena, size / sizeof(double));
    bool has_memory = replay->best_x != NULL;
    for (long i = 0; i < journal->n_earlier && has_memory; i++) {
        const char *design = (const char *)journal->answer[i].x;
        if (is_of_evaluator(replay, &journal->answer[i]) &&
            cz_index_find(&replay->earlier, design, size) < 0)
            has_memory = cz_index_add(&replay->earlier, design, size, (int)i);
    }
    return has_memory ? CZ_OK : cz_no_memory(error, "the journal");
}

void cz_replay_free(CzReplay *replay) {
    cz_selection_free(&replay->selection);
    cz_arena_free(&replay->arena);
}

CzStatus cz_batch_create(const CzReplay *replay, int n, bool with_detail, CzBatch *batch,
                         CzError *error) {
    const CzEvaluator *evaluator = replay->evaluator;
    const size_t room = (size_t)n, n_detail = (size_t)cz_evaluator_n_detail(evaluator);
    *batch = (CzBatch){.n = n};
    batch->x = cz_arena_numbers(&batch->arena, room * (size_t)cz_evaluator_n_variable(evaluator));
    batch->objective = cz_arena_numbers(&batch->arena, room);
    batch->constraint =
        cz_arena_numbers(&batch->arena, room * (size_t)cz_evaluator_n_constraint(evaluator));
    if (n_detail > 0 && (with_detail || replay->journal != NULL)) /* a journal has all of them */
        batch->detail = cz_arena_numbers(&batch->arena, room * n_detail);
    batch->is_whole = cz_arena_allocate(&batch->arena, room, sizeof *batch->is_whole);
    batch->run = cz_arena_allocate(&batch->arena, room, sizeof *batch->run);
    batch->evaluation = cz_arena_allocate(&batch->arena, room, sizeof *batch->evaluation);
    return batch->arena.out_of_memory ? cz_no_memory(error, "the designs") : CZ_OK;
}

void cz_batch_free(CzBatch *batch) {
    for (int i = 0; i < batch->n_new; i++)
        cz_evaluation_free(&batch->evaluation[i]);
    cz_arena_free(&batch->arena);
}

/* Where the values of a design of a batch are. */
static CzAnswer answer_at(const CzReplay *replay, const CzBatch *batch, int design) {
    const CzEvaluator *evaluator = replay->evaluator;
    return (CzAnswer){
        .x = batch->x + (size_t)design * (size_t)cz_evaluator_n_variable(evaluator),
        .objective = batch->objective[design],
        .n_constraint = cz_evaluator_n_constraint(evaluator),
        .n_detail = cz_evaluator_n_detail(evaluator),
        .constraint =
            batch->constraint + (size_t)design * (size_t)cz_evaluator_n_constraint(evaluator),
        .detail = batch->detail != NULL
                      ? batch->detail + (size_t)design * (size_t)cz_evaluator_n_detail(evaluator)
                      : NULL};
}

/* Whether an answer of a search with a lower limit has the scenarios of the working set, which may
 * be another one here. A design that failed has no values to compare. */
static bool is_usable(const CzReplay *replay, const CzAnswer *answer) {
    return !replay->selection.is_on ||
           (!isnan(answer->objective) &&
            cz_selection_is_of_set(&replay->selection, answer->constraint));
}

/* Finds the answer of the journal to a design; NULL where there is none yet. */
static CzStatus find(CzReplay *replay, const double *x, const CzAnswer **answer, CzError *error) {
    const CzJournal *journal = replay->journal;
    *answer = NULL;
    if (journal == NULL)
        return CZ_OK;
    const int number = cz_index_find(&replay->earlier, (const char *)x, design_size(replay));
    if (number >= 0 && is_usable(replay, &journal->answer[number]))
        *answer = &journal->answer[number];
    else if (replay->next < journal->n_answer)
        *answer = &journal->answer[replay->next++];
    if (*answer == NULL ||
        (is_of_evaluator(replay, *answer) && memcmp((*answer)->x, x, design_size(replay)) == 0))
        return CZ_OK;
    return cz_fail(error, CZ_STATUS_INPUT,
                   "evaluation %ld of the journal is of another design than the search asks for",
                   replay->next);
}

/* Writes an answer into the batch. */
static void take(const CzReplay *replay, const CzBatch *batch, int design, const CzAnswer *answer) {
    const CzAnswer to = answer_at(replay, batch, design);
    batch->objective[design] = answer->objective;
    memcpy((double *)to.constraint, answer->constraint,
           (size_t)to.n_constraint * sizeof *to.constraint);
    if (to.detail != NULL)
        memcpy((double *)to.detail, answer->detail, (size_t)to.n_detail * sizeof *to.detail);
}

/* Whether an answer of the journal has the values of all scenarios, as that of a design that failed
 * in the working set does not. */
static bool is_answer_whole(const CzReplay *replay, const CzAnswer *answer) {
    for (int j = 0; j < answer->n_constraint && replay->selection.is_on; j++)
        if (isnan(answer->constraint[j]))
            return false;
    return true;
}

/* Runs the designs that have no answer, all of them side by side, in the working set. */
static CzStatus run(CzReplay *replay, CzBatch *batch, int n, CzError *error) {
    const CzSelection *selection = &replay->selection;
    const size_t n_variable = (size_t)cz_evaluator_n_variable(replay->evaluator);
    const size_t n_detail = (size_t)cz_evaluator_n_detail(replay->evaluator);
    const bool is_whole = cz_selection_is_whole(selection);
    double *x = cz_arena_numbers(&batch->arena, (size_t)n * n_variable);
    double *detail =
        batch->detail != NULL ? cz_arena_numbers(&batch->arena, (size_t)n * n_detail) : NULL;
    if (batch->arena.out_of_memory)
        return cz_no_memory(error, "the designs");
    for (int i = 0; i < n; i++)
        memcpy(x + (size_t)i * n_variable, batch->x + (size_t)batch->run[i] * n_variable,
               n_variable * sizeof *x);
    CZ_TRY(is_whole ? cz_evaluator_search(replay->evaluator, n, x, batch->evaluation, detail, error)
                    : cz_evaluator_search_some(replay->evaluator, selection->works, n, x,
                                               batch->evaluation, detail, error));
    batch->n_new = n;
    for (int i = 0; i < n; i++) {
        const CzAnswer answer = {.objective = batch->evaluation[i].objective,
                                 .constraint = batch->evaluation[i].constraint,
                                 .detail = detail != NULL ? detail + (size_t)i * n_detail : NULL};
        cz_selection_blank(selection, batch->evaluation[i].constraint, (double *)answer.detail);
        take(replay, batch, batch->run[i], &answer);
        batch->is_whole[batch->run[i]] = is_whole;
    }
    return CZ_OK;
}

CzStatus cz_replay_complete(CzReplay *replay, CzBatch *batch, int design, CzError *error) {
    const CzAnswer at = answer_at(replay, batch, design);
    for (int i = 0; i < batch->n_new; i++) {
        CzEvaluation *evaluation = &batch->evaluation[i];
        if (batch->run[i] != design)
            continue;
        CZ_TRY(cz_evaluator_search_remaining(replay->evaluator, replay->selection.works, at.x,
                                             evaluation, (double *)at.detail, error));
        batch->objective[design] = evaluation->objective;
        memcpy((double *)at.constraint, evaluation->constraint,
               (size_t)at.n_constraint * sizeof *at.constraint);
        batch->is_whole[design] = true;
        return CZ_OK;
    }
    return cz_fail(error, CZ_STATUS_INPUT,
                   "evaluation %ld of the journal lacks scenarios that the search asks for",
                   replay->next);
}

CzStatus cz_replay_evaluate(CzReplay *replay, CzBatch *batch, CzError *error) {
    int n_open = 0;
    for (int i = 0; i < batch->n; i++) {
        const CzAnswer *answer;
        CZ_TRY(find(replay, answer_at(replay, batch, i).x, &answer, error));
        if (answer != NULL) {
            take(replay, batch, i, answer);
            batch->is_whole[i] = is_answer_whole(replay, answer);
        } else {
            batch->run[n_open++] = i;
        }
    }
    CZ_TRY(n_open > 0 ? run(replay, batch, n_open, error) : CZ_OK);
    replay->n_evaluation += batch->n;
    return CZ_OK;
}

void cz_replay_note(CzReplay *replay, const CzRecord *record, const double *x) {
    if (replay->journal == NULL || isnan(record->objective) || record->is_barred ||
        record->is_partial || (replay->has_best && !cz_record_is_better(record, &replay->best)))
        return;
    memcpy(replay->best_x, x, design_size(replay));
    replay->best = *record;
    replay->has_best = true;
    replay->is_best_kept = false;
}

CzStatus cz_replay_keep(CzReplay *replay, const char *phase, const CzBatch *batch, CzError *error) {
    const CzJournal *journal = replay->journal;
    if (journal == NULL || journal->keep == NULL || batch->n_new == 0)
        return CZ_OK;
    CzArena arena = {0};
    CzAnswer *answer = cz_arena_allocate(&arena, (size_t)batch->n_new, sizeof *answer);
    CzStatus status = answer != NULL ? CZ_OK : cz_no_memory(error, "the journal");
    for (int i = 0; i < batch->n_new && status == CZ_OK; i++)
        answer[i] = answer_at(replay, batch, batch->run[i]);
    const CzNews news = {.phase = phase,
                         .n = batch->n_new,
                         .answer = answer,
                         .evaluation = batch->evaluation,
                         .n_evaluation = replay->n_evaluation,
                         .best = replay->is_best_kept || !replay->has_best ? NULL : replay->best_x,
                         .best_violation = replay->best.violation};
    if (status == CZ_OK)
        status = journal->keep(&news, journal->keep_data, error);
    replay->is_best_kept |= status == CZ_OK;
    cz_arena_free(&arena);
    return status;
}
