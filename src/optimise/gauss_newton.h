/* Least squares by the method of Gauss and Newton. */
#ifndef CZ_OPTIMISE_GAUSS_NEWTON_H
#define CZ_OPTIMISE_GAUSS_NEWTON_H

#include "optimise/search.h"

/* Moves from scaled variables u (n_variable) with at most so many evaluations, until nothing gains.
 * The details of the search are the residuals, its objective is their sum of squares. The result is
 * in the search. Status: CZ_OK, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_gauss_newton(CzSearch *search, const char *phase, const double *u,
                                       long evaluations, CzError *error);

#endif
