/* The runs that an evaluation kept. */
#ifndef CZ_REPORT_RUNS_H
#define CZ_REPORT_RUNS_H

#include <string.h>

#include "crushzone/evaluate.h"

/* Summary of the run of a scenario; NULL when it was left out or not kept. */
static inline const CzRunSummary *cz_kept_run(const CzEvaluation *evaluation, int scenario) {
    if (evaluation->run == NULL || evaluation->run[scenario] == NULL)
        return NULL;
    return cz_run_summary(evaluation->run[scenario]);
}

/* Number of the scenario of a name whose run was kept; -1 for none. */
static inline int cz_find_kept_run(const CzEvaluation *evaluation, const char *scenario) {
    for (int i = 0; i < evaluation->n_run; i++) {
        const CzRunSummary *run = cz_kept_run(evaluation, i);
        if (run != NULL && strcmp(run->scenario, scenario) == 0)
            return i;
    }
    return -1;
}

/* Number of these runs. */
static inline int cz_n_kept_run(const CzEvaluation *evaluation) {
    int n = 0;
    for (int i = 0; i < evaluation->n_run; i++)
        n += cz_kept_run(evaluation, i) != NULL;
    return n;
}

/* A run with an error above this share gets a warning: of the energy balance, over the initial
 * energy; of the laws of series chains, over the largest force of the interface. The error of the
 * work is no larger than that of the force. */
#define CZ_WARNING_SHARE 1e-3

static inline bool cz_run_is_unbalanced(const CzRunSummary *run) {
    return run->status == CZ_OK && run->energy.balance_error > CZ_WARNING_SHARE;
}

static inline bool cz_run_misses_laws(const CzRunSummary *run) {
    return run->status == CZ_OK && run->law_error > CZ_WARNING_SHARE;
}

#endif
