/* A problem as bytes, for another process: how it was read, and what was then added to it. */
#ifndef CZ_PROBLEM_PROBLEM_BYTES_H
#define CZ_PROBLEM_PROBLEM_BYTES_H

#include "base/bytes.h"
#include "crushzone/problem.h"

/* Appends file or text, options, and the settings, scenarios and variables that were added; fails
 * for a problem that was changed in another way. */
void cz_problem_put(CzMemoryText *bytes, const CzProblem *problem);

enum { CZ_MAX_STEPS = 4 };

/* A problem that was read again, and those that it was made from, which it must not outlive. */
typedef struct CzProblemSteps {
    int n;
    CzProblem *step[CZ_MAX_STEPS]; /* the last one is the problem (n) */
} CzProblemSteps;
static inline const CzProblem *cz_problem_of(const CzProblemSteps *steps) {
    return steps->step[steps->n - 1];
}

/* Reads the same files, or the text, in the same way. Freed also after a failure. Statuses:
 * CZ_OK, CZ_STATUS_INPUT also when the files differ, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_problem_get(CzReading *reading, CzProblemSteps *steps, CzError *error);
void cz_problem_steps_free(CzProblemSteps *steps);

#endif
