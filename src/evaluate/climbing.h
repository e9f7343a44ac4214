/* Climbing margin of a run: the smallest over wheel lift, overlap and vertical capacity. */
#ifndef CZ_EVALUATE_CLIMBING_H
#define CZ_EVALUATE_CLIMBING_H

#include "evaluate/evaluator_parts.h"

enum { CZ_MAX_CLIMBING_CHECKS = 32 };

/* The checks for climbing in one scenario. */
typedef struct CzClimbing {
    int scenario;
    int n_check;
    CzCheck check[CZ_MAX_CLIMBING_CHECKS];
} CzClimbing;

/* Whether a check of this kind is one of climbing. */
bool cz_climbing_judges(const CzMetricKind *kind);

/* The problem's own limits in a scenario, and default limits where it has none. */
CzClimbing cz_climbing_of(const CzEvaluator *evaluator, int scenario);

/* The judged check with the smallest margin. Its verdict is NOT CHECKED, with the reason, when one
 * of the others is unknown and none fails. Its margin is NaN when the run failed or is incomplete,
 * or when no vehicle could climb. */
CzCheckResult cz_climbing_judge(const CzClimbing *climbing, const CzEvaluator *evaluator,
                                const CzVehicle *vehicles, const CzRunSummary *run);

#endif
