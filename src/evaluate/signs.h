/* Signs: what a run shows of each cause of climbing. */
#ifndef CZ_EVALUATE_SIGNS_H
#define CZ_EVALUATE_SIGNS_H

#include "crushzone/explain.h"
#include "problem/input.h"

/* Fills the signs of a run up to its climb, or over all of it when there is none. */
void cz_signs_find(const CzRunSummary *run, CzExplanation *explanation);

#endif
