/* Requirements of a profile that this program cannot check. */
#ifndef CZ_EVALUATE_NOT_COVERED_H
#define CZ_EVALUATE_NOT_COVERED_H

#include "crushzone/problem.h"

/* Those of the profile of a problem, and their number; NULL for none. */
const char *const *cz_not_covered(const CzProblem *problem, int *n);

#endif
