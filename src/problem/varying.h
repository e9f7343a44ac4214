/* Numbers of a problem that a search may change, found without variables of its own. */
#ifndef CZ_PROBLEM_VARYING_H
#define CZ_PROBLEM_VARYING_H

#include "problem/problem.h"

/* A number as it is written in a file, in the unit of its key. */
typedef struct CzVaryingNumber {
    char path[CZ_PATH_SIZE]; /* as `set:` takes it, such as parts.head-tube.stages[0].force_kN */
    double value;
    double min, max; /* range of its key */
    double size;     /* of a change of 100 %: the value, or of a length of 0 one of 100 mm */
} CzVaryingNumber;

/* Finds the numbers of vehicle ends that a search may change, each where it is written, in the
 * order of the file; at most `room`, of which *n are filled. Those that belong to marked vehicles
 * alone, such as obstacles, are left out; `is_left_out` is NULL for none. Statuses: CZ_OK,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_problem_find_varying(const CzProblem *problem, const bool *is_left_out,
                                               int room, CzVaryingNumber *number, int *n,
                                               CzError *error);

/* Reads the problem again with these numbers as the only variables of its optimisation. Shares the
 * problem's tree, so it must not outlive it; freed by the caller. Statuses: CZ_OK, CZ_STATUS_INPUT
 * with the first mistake, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_problem_read_varying(const CzProblem *problem, int n,
                                               const CzVaryingNumber *number, CzProblem **made,
                                               CzError *error);

#endif
