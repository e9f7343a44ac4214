/* The next best design where the best one is not verified. */
#ifndef CZ_OPTIMISE_VERIFIED_H
#define CZ_OPTIMISE_VERIFIED_H

#include "optimise/outcome.h"

/* Notes a design (n_variable) that is not verified, with the reason; the outcome has room for it.
 * Status: CZ_OK, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_outcome_reject(CzOutcome *outcome, const double *x, double objective,
                                         const CzVerification *verification, CzError *error);

/* Adds the designs that are not verified to the reason why the search stopped. */
void cz_outcome_note_rejected(CzOutcome *outcome);

/* Whether a design is like a refused one: equal on the increments; between them, nowhere more than
 * 2 % of a variable's range away (ours). */
bool cz_is_alike(const CzEvaluator *evaluator, const double *x, const double *refused,
                 bool on_grid);

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
