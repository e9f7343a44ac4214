/* Latin hypercube. */
#include "statistics/latin.h"

#include "statistics/random.h"

void cz_latin_draw(uint64_t seed, int draw, int n, double *u) {
    for (int i = 0; i < n; i++)
        u[i] = i;
    for (int i = n - 1; i > 0; i--) { /* the i-th place takes one of the first i + 1 */
        const int other = (int)(cz_random_unit(seed, CZ_RANDOM_ORDER, draw, i) * (i + 1));
        const double swapped = u[i];
        u[i] = u[other];
        u[other] = swapped;
    }
    for (int i = 0; i < n; i++)
        u[i] = (u[i] + cz_random_unit(seed, CZ_RANDOM_PLACE, draw, i)) / n;
}
