/* The next best design where the best one is not verified. */
#ifndef CZ_OPTIMISE_VERIFIED_H
#define CZ_OPTIMISE_VERIFIED_H

#include "optimise/combinations.h"

/* Continues the searches, where evaluations are left, and tries the next best designs, until one is
 * verified. It replaces the best design of the outcome; when there is none, the outcome keeps its
 * design and its status. Does nothing for an outcome of another status than CZ_OUTCOME_UNVERIFIED.
 * Statuses: those of cz_optimise; CZ_OK after the stop flag was set, and the outcome is
 * interrupted.
 */
CZ_MUST_CHECK CzStatus cz_verified_find(CzEvaluator *evaluator, CzCombinations *combinations,
                                        const CzOptimiseOptions *options, CzOutcome *outcome,
                                        CzError *error);

#endif
