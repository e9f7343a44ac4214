/* Parts of an outcome that a search and its recall share. */
#ifndef CZ_OPTIMISE_OUTCOME_H
#define CZ_OPTIMISE_OUTCOME_H

#include "crushzone/optimise.h"

/* Fills `at_bound` from `best`. */
void cz_outcome_mark_bounds(const CzEvaluator *evaluator, CzOutcome *outcome);

/* Computes a design that passes once more by independent means. A signal leaves it unverified. */
CZ_MUST_CHECK CzStatus cz_outcome_verify(CzEvaluator *evaluator, const CzOptimiseOptions *options,
                                         CzOutcome *outcome, CzError *error);

#endif
