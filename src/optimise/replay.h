/* The journal of a search: earlier evaluations answer without a run, further ones are kept.
 *
 * A search is deterministic given seed and answers, so a search that is repeated with the answers
 * of its journal continues where the journal ends. Without a journal every design is run.
 */
#ifndef CZ_OPTIMISE_REPLAY_H
#define CZ_OPTIMISE_REPLAY_H

#include "base/arena.h"
#include "base/index.h"
#include "optimise/search.h"
#include "optimise/selection.h"

/* What verifications found: designs that were not verified, and margins that are required because
 * of them. Where another method changes a verdict, a design has to keep as much margin as that
 * method changes. */
typedef struct CzRequired {
    CzArena arena;
    double *margin; /* (n_constraint) */
    int n;
    const double **x; /* the designs, in the variables' units (n, each n_variable) */
} CzRequired;

typedef struct CzReplay {
    CzEvaluator *evaluator;
    const CzJournal *journal; /* NULL when none */
    CzArena arena;
    CzSelection selection;
    const CzRequired *required; /* NULL for nothing */
    CzIndex earlier;            /* the answers that come in any order */
    long next;                  /* the first answer in order that is still to come */
    long n_evaluation;          /* of the search so far */
    CzRecord best;              /* of the designs so far that a file may contain */
    double *best_x;             /* (n_variable) */
    bool has_best;
    bool is_best_kept; /* the news had it */
} CzReplay;

/* `journal` may be NULL. The caller frees the replay in any case. Status: CZ_OK,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_replay_begin(CzReplay *replay, CzEvaluator *evaluator,
                                       const CzJournal *journal, CzError *error);
void cz_replay_free(CzReplay *replay);

/* Designs that are evaluated side by side. x is (n x n_variable), objective (n), constraint (n x
 * n_constraint) with all constraints of the evaluator, detail (n x cz_evaluator_n_detail) or NULL;
 * the last three are filled, with NaN for constraints and details of scenarios that are left out.
 */
typedef struct CzBatch {
    CzArena arena;
    int n;
    double *x, *objective, *constraint, *detail;
    bool *is_whole;           /* the design is run in all scenarios (n) */
    int n_new;                /* designs that were run */
    int *run;                 /* their numbers (n_new) */
    CzEvaluation *evaluation; /* (n_new) */
} CzBatch;

/* Memory for n designs; the caller frees the batch in any case. Status: CZ_OK, CZ_STATUS_NO_MEMORY.
 */
CZ_MUST_CHECK CzStatus cz_batch_create(const CzReplay *replay, int n, bool with_detail,
                                       CzBatch *batch, CzError *error);
void cz_batch_free(CzBatch *batch);

/* Fills the values of a batch, in the working set of scenarios. Statuses: as cz_evaluator_search;
 * CZ_STATUS_INPUT when the journal has another design. */
CZ_MUST_CHECK CzStatus cz_replay_evaluate(CzReplay *replay, CzBatch *batch, CzError *error);

/* Runs a design of the batch in the scenarios that were left out. Statuses: as cz_evaluator_search;
 * CZ_STATUS_INPUT when the journal has the design without them. */
CZ_MUST_CHECK CzStatus cz_replay_complete(CzReplay *replay, CzBatch *batch, int design,
                                          CzError *error);

/* Notes the record of a design as the best one if it is. */
void cz_replay_note(CzReplay *replay, const CzRecord *record, const double *x);

/* Keeps the designs of the batch that were run. Statuses: those of CzJournal.keep. */
CZ_MUST_CHECK CzStatus cz_replay_keep(CzReplay *replay, const char *phase, const CzBatch *batch,
                                      CzError *error);

/* A journal without its first n answers, for the next of several searches. */
static inline CzJournal cz_journal_remaining(const CzJournal *journal, long n) {
    CzJournal rest = *journal;
    const long n_used = n < journal->n_answer ? n : journal->n_answer;
    rest.answer = n_used > 0 ? journal->answer + n_used : journal->answer;
    rest.n_answer -= n_used;
    return rest;
}

#endif
