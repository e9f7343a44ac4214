/* Runs of a problem with one value changed in each, judged by the climbing margin. */
#ifndef CZ_EVALUATE_CANDIDATE_RUNS_H
#define CZ_EVALUATE_CANDIDATE_RUNS_H

#include <signal.h>

#include "evaluate/climbing.h"

/* One change of one value, and its margin. */
typedef struct CzCandidate {
    int kind;
    double change, value;
    double margin; /* NaN when it is not valid in a file, or its run failed */
} CzCandidate;

/* Fills value and margin of n candidates, by the executor of the evaluator. Statuses: CZ_OK,
 * CZ_STATUS_INTERRUPTED when the stop flag is set (NULL: none), CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_candidates_run(const CzEvaluator *evaluator, const CzClimbing *climbing,
                                         const volatile sig_atomic_t *stop, int n,
                                         CzCandidate *candidate, CzError *error);

#endif
