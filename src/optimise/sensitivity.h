/* What a small change of each variable does to the best design. */
#ifndef CZ_OPTIMISE_SENSITIVITY_H
#define CZ_OPTIMISE_SENSITIVITY_H

#include "crushzone/optimise.h"

/* Fills `sensitivity_increment`, `objective_change` and `constraint_change` of the outcome from one
 * run of each changed design, made as in a search; leaves them NULL when the stop flag is up.
 * Statuses: CZ_OK, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_sensitivity_take(CzEvaluator *evaluator,
                                           const volatile sig_atomic_t *stop, CzOutcome *outcome,
                                           CzError *error);

#endif
