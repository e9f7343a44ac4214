/* The runs that an evaluation kept. */
#ifndef CZ_REPORT_RUNS_H
#define CZ_REPORT_RUNS_H

#include "crushzone/evaluate.h"

/* Summary of the run of a scenario; NULL when it was left out or not kept. */
static inline const CzRunSummary *cz_kept_run(const CzEvaluation *evaluation, int scenario) {
    if (evaluation->run == NULL || evaluation->run[scenario] == NULL)
        return NULL;
    return cz_run_summary(evaluation->run[scenario]);
}

/* How many there are. */
static inline int cz_n_kept_run(const CzEvaluation *evaluation) {
    int n = 0;
    for (int i = 0; i < evaluation->n_run; i++)
        n += cz_kept_run(evaluation, i) != NULL;
    return n;
}

/* Whether a run that was not stopped for it still lost or made more energy than results should
 * rest on. */
static inline bool cz_run_is_inaccurate(const CzRunSummary *run) {
    const double largest = 1e-3; /* of the initial energy */
    return run->status == CZ_OK && run->energy.balance_error > largest;
}

#endif
