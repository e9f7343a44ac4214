/* Indicators: what a run shows of each cause of climbing. */
#ifndef CZ_EVALUATE_OVERRIDE_INDICATORS_H
#define CZ_EVALUATE_OVERRIDE_INDICATORS_H

#include "crushzone/explain.h"
#include "problem/input.h"

/* Fills the indicators of a run up to its climb, or over all of it when there is none. */
void cz_override_indicators_find(const CzRunSummary *run, CzExplanation *explanation);

#endif
