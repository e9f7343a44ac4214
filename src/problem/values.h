/* The values of a resolved problem as a list, for comparing problems. */
#ifndef CZ_PROBLEM_VALUES_H
#define CZ_PROBLEM_VALUES_H

#include "base/arena.h"
#include "problem/problem.h"

/* One value. Texts are in the arena. */
typedef struct CzProblemValue {
    const char *path;   /* such as trains.A.vehicles.A1.front.stages[0].force, without a unit */
    const char *text;   /* as written: a number in SI */
    const char *unit;   /* in which it was typed, such as "kN"; "" for none */
    double number;      /* in that unit; NaN for a text */
    const char *origin; /* file and line, and the part; "default" when it is not in a file */
} CzProblemValue;

/* Lists the values of a problem with parts, copies and defaults filled in, in the order of the
 * resolved file; of a file that is resolved already with the origins in its comments. Statuses:
 * CZ_OK, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_problem_list_values(const CzProblem *problem, CzArena *arena, int *n,
                                              CzProblemValue **value, CzError *error);

/* The symbol of a unit for a reader, such as "km/h" for "km_h"; the unit itself where there is
 * none.
 */
const char *cz_problem_unit_symbol(const char *unit);

/* A number in another unit of its dimension, such as "mm"; "" is that of SI. */
double cz_problem_value_in(const CzProblemValue *value, const char *unit);

#endif
