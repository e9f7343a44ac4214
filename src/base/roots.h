/* All roots of a polynomial, without expanding it. */
#ifndef CZ_BASE_ROOTS_H
#define CZ_BASE_ROOTS_H

#include "base/complex.h"

/* P'/P of the polynomial at s. */
typedef CzComplex CzLogarithmicSlope(const void *polynomial, CzComplex s);

/* Aberth's method: moves n different guesses to the n roots of the polynomial, until the last sweep
 * moves none by more than rounding. */
void cz_find_roots(CzLogarithmicSlope *slope, const void *polynomial, int n, CzComplex *root);

#endif
