/* What a name of a response means, and its value in an evaluation. */
#ifndef CZ_SERVE_DAKOTA_RESPONSES_H
#define CZ_SERVE_DAKOTA_RESPONSES_H

#include "base/arena.h"
#include "crushzone/evaluate.h"

typedef enum CzResponseKind {
    CZ_RESPONSE_OBJECTIVE,
    CZ_RESPONSE_VIOLATION,
    CZ_RESPONSE_SMALLEST_MARGIN, /* of all checks that have one */
    CZ_RESPONSE_MARGIN,          /* of the checks of a name; 1 or -1 for a yes or no */
    CZ_RESPONSE_METRIC
} CzResponseKind;

typedef struct CzResponse {
    CzResponseKind kind;
    const char *name;     /* of the checks; of a metric its text */
    const char *scenario; /* of the checks: only this scenario; NULL for all */
    int metric;           /* its place among the values of the evaluator */
} CzResponse;

/* Reads a name. Spaces and other signs in the name of a check are any signs, such as _. Statuses:
 * CZ_OK, CZ_STATUS_INPUT with a did-you-mean, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_response_read(const CzEvaluator *evaluator, CzArena *arena,
                                        const char *text, CzResponse *response, CzError *error);

/* Its value in an evaluation that did not fail; NaN without one, and then the reason. */
double cz_response_value(const CzResponse *response, const CzEvaluation *evaluation,
                         const char **why);

#endif
