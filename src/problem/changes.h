/* Scenarios that change values of the problem: for each its problem with these values. */
#ifndef CZ_PROBLEM_CHANGES_H
#define CZ_PROBLEM_CHANGES_H

#include "problem/rules.h"

/* Reads the problem of each scenario with changes, which needs a problem without mistakes.
 * Statuses: CZ_OK, CZ_STATUS_INPUT with the mistake and *failed, the scenario that has it,
 * CZ_STATUS_NO_MEMORY.
 */
CZ_MUST_CHECK CzStatus cz_changes_read(CzProblem *problem, const void **field, CzError *error);

/* The path of a change as settings take it: `scenario.` at its start becomes that of the scenario,
 * which is written to `text`. */
const char *cz_change_path(const char *path, int scenario, char text[CZ_PATH_SIZE]);

/* Whether the path is followed when the trains have been written out: all but those of parts. */
bool cz_change_is_late(const char *path);

#endif
