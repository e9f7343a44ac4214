/* The two-step scheme on plain arrays. */
#include "integrate/two_step.h"

void cz_two_step_advance(size_t n, double h, int first, double *restrict position,
                         double *restrict velocity, const double *restrict acceleration,
                         double *restrict last) {
    const double psi = first ? 0.0 : 0.5;
    const double now_x = (0.5 + psi) * h * h, before_x = psi * h * h;
    const double now_v = (1.0 + psi) * h, before_v = psi * h;
#pragma omp simd
    for (size_t i = 0; i < n; ++i) {
        position[i] += velocity[i] * h + (acceleration[i] * now_x - last[i] * before_x);
        velocity[i] += acceleration[i] * now_v - last[i] * before_v;
        last[i] = acceleration[i];
    }
}
