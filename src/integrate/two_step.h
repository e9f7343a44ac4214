/* The explicit two-step scheme of Zhai (Int. J. Numer. Meth. Engng 39, 1996), psi = phi = 1/2.
 *
 *   x' = x + v h + (1/2 + psi) a h^2 - psi a_last h^2
 *   v' = v + (1 + phi) a h - phi a_last h                  the first step has psi = phi = 0
 *   a' = M^-1 F(x', v')                                    one force evaluation a step
 *
 * Second order, without numerical damping, stable for w h < 2 without physical damping. Inline, so
 * that the kernel of each instruction set has its own copy.
 */
#ifndef CZ_INTEGRATE_TWO_STEP_H
#define CZ_INTEGRATE_TWO_STEP_H

#include <stddef.h>

/* Advances n positions and velocities by one step of length h. `acceleration` is a at the start of
 * the step; `last` is a one step earlier, and receives the present one. `first` marks the first
 * step. */
static inline void cz_two_step_advance(size_t n, double h, int first, double *restrict position,
                                       double *restrict velocity,
                                       const double *restrict acceleration, double *restrict last) {
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

#endif
