/* Points that fill the unit cube evenly.
 *
 *   u_i(k) = frac(shift_i + k / phi^(i + 1)),   phi^(n + 1) = phi + 1
 *
 * the additive recurrence of M. Roberts (2018) with the generalised golden ratio; the shift is
 * generated from the seed by splitmix64.
 */
#include "optimise/strategy.h"

#include <math.h>
#include <stdint.h>

/* The root above 1 of x^(n + 1) = x + 1, by a fixed number of Newton steps. */
static double generalised_golden_ratio(int n) {
    double x = 1.5;
    for (int step = 0; step < 60; step++) {
        double power = 1; /* x^n */
        for (int i = 0; i < n; i++)
            power *= x;
        x -= (power * x - x - 1) / ((n + 1) * power - 1);
    }
    return x;
}

static uint64_t next_random(uint64_t *state) {
    uint64_t z = *state += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

void cz_sample_point(unsigned long seed, long index, int n, double *u) {
    const double phi = generalised_golden_ratio(n);
    uint64_t state = seed;
    double stride = 1;
    for (int i = 0; i < n; i++) {
        const double shift = (double)(next_random(&state) >> 11) * 0x1p-53;
        stride /= phi;
        const double value = shift + (double)(index + 1) * stride;
        u[i] = value - floor(value);
    }
}
