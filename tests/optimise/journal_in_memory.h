/* A journal of a search in memory. */
#ifndef CZ_TESTS_JOURNAL_IN_MEMORY_H
#define CZ_TESTS_JOURNAL_IN_MEMORY_H

#include "support/check.h"

#include "crushzone/optimise.h"

#include <stdlib.h>

enum { MAX_EVALUATIONS = 400 }; /* evaluations */

/* What a search kept. */
typedef struct Kept {
    const CzEvaluator *evaluator;
    CzAnswer answer[MAX_EVALUATIONS];
    long n;
    long fails_at; /* number of evaluations from which nothing can be kept; 0 for never */
    double best[8], best_violation;
} Kept;

static inline double *journal_copy(const double *value, int n) {
    double *made = malloc(((size_t)n + 1) * sizeof *made);
    memcpy(made, value, (size_t)n * sizeof *made);
    return made;
}

static inline CzStatus journal_keep(const CzNews *news, void *data, CzError *error) {
    Kept *kept = data;
    for (int i = 0; i < news->n; i++) {
        if (kept->fails_at > 0 && kept->n >= kept->fails_at) {
            snprintf(error->message, sizeof error->message, "the disk is full");
            return CZ_STATUS_OUTPUT;
        }
        assert_true(kept->n < MAX_EVALUATIONS);
        kept->answer[kept->n++] = (CzAnswer){
            .x = journal_copy(news->answer[i].x, cz_evaluator_n_variable(kept->evaluator)),
            .objective = news->answer[i].objective,
            .n_constraint = news->answer[i].n_constraint,
            .n_detail = news->answer[i].n_detail,
            .constraint = journal_copy(news->answer[i].constraint, news->answer[i].n_constraint),
            .detail = journal_copy(news->answer[i].detail, news->answer[i].n_detail)};
    }
    if (news->best != NULL) {
        memcpy(kept->best, news->best,
               (size_t)cz_evaluator_n_variable(kept->evaluator) * sizeof(double));
        kept->best_violation = news->best_violation;
    }
    return CZ_OK;
}

static inline void journal_forget(Kept *kept) {
    for (long i = 0; i < kept->n; i++) {
        free((double *)kept->answer[i].x);
        free((double *)kept->answer[i].constraint);
        free((double *)kept->answer[i].detail);
    }
    kept->n = 0;
}

#endif
