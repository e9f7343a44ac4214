/* Sobol points: they fill the unit cube more evenly than random points or a Latin hypercube, best
 * when their number is a power of 2.
 *
 *   x_i = v_1 g_1 xor v_2 g_2 xor ...,   g the binary digits of i xor i / 2, v the direction
 * numbers
 *
 * The direction numbers are those of S. Joe and F. Y. Kuo, "Constructing Sobol sequences with
 * better two-dimensional projections", SIAM J. Sci. Comput. 30 (2008), file new-joe-kuo-6.21201, of
 * which sobol.def has the first CZ_SOBOL_MAX_DRAWS dimensions. The seed shifts each dimension
 * digit by digit (xor with 32 random bits), which keeps the evenness.
 */
#ifndef CZ_STATISTICS_SOBOL_H
#define CZ_STATISTICS_SOBOL_H

#include <stdint.h>

enum { CZ_SOBOL_MAX_DRAWS = 256 };

/* The first 32 binary digits of the point of that number, without a shift. */
uint32_t cz_sobol_digits(int draw, uint32_t point);

/* Values of one draw in all samples, within (0, 1); u is (n), draw less than CZ_SOBOL_MAX_DRAWS.
 */
void cz_sobol_draw(uint64_t seed, int draw, int n, double *u);

#endif
