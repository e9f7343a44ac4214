/* Latin hypercube: of n samples exactly one lies in each n-th part of the range of each draw.
 *
 *   u_i = (order_i + place_i) / n,   order a random permutation of 0 ... n - 1, place within (0, 1)
 *
 * of McKay, Beckman and Conover, Technometrics 21 (1979). The permutation is that of Fisher and
 * Yates. A draw depends on the seed, its number and n alone.
 */
#ifndef CZ_STATISTICS_LATIN_H
#define CZ_STATISTICS_LATIN_H

#include <stdint.h>

/* Values of one draw in all samples, within (0, 1); u is (n). */
void cz_latin_draw(uint64_t seed, int draw, int n, double *u);

#endif
