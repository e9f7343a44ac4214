/* Scenarios of the profile that a problem does not run as the profile has them, and those that are
 * not confirmed.
 */
#ifndef CZ_EVALUATE_NOT_APPLICABLE_H
#define CZ_EVALUATE_NOT_APPLICABLE_H

#include "evaluate/checks.h"

/* Lists those that do not apply with their reasons, as "name: reason", and the names of those that
 * the problem replaces or changes. Memory comes from the arena. Statuses: CZ_OK,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_not_applicable_list(const CzProblem *problem, CzArena *arena,
                                              CzChecklist *list, CzError *error);

/* Whether a scene runs a scenario of the profile, as the profile has it, whose numbers are not
 * confirmed. */
bool cz_asked_is_unconfirmed(const CzProblem *problem, const CzScene *scene);

#endif
