/* Scenarios of the profile that do not apply to a problem. */
#ifndef CZ_EVALUATE_NOT_APPLICABLE_H
#define CZ_EVALUATE_NOT_APPLICABLE_H

#include "evaluate/checks.h"

/* Lists them with their reasons, as "name: reason". Memory comes from the arena. Statuses: CZ_OK,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_not_applicable_list(const CzProblem *problem, CzArena *arena,
                                              CzChecklist *list, CzError *error);

#endif
