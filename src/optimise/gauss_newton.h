/* Least squares by the Gauss-Newton method. */
#ifndef CZ_OPTIMISE_GAUSS_NEWTON_H
#define CZ_OPTIMISE_GAUSS_NEWTON_H

#include "optimise/search.h"

/* Moves from scaled variables u (n_variable) with at most `evaluations` evaluations, until no step
 * is an improvement. The details of the search are the residuals, its objective is their sum of
 * squares. The result is in the search. Status: CZ_OK, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_gauss_newton(CzSearch *search, const char *phase, const double *u,
                                       long evaluations, CzError *error);

#endif
