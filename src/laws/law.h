/* Conventions of all force laws, and the three operations they are made of.
 *
 * SI units. x forward, z up, pitch positive nose-up. Compression and shortening are positive, and
 * so is the force that resists them. A law is a pure function: parameters, shortening, rate and
 * memory in; force and next memory out. It is continuous in every input, writes nothing, and is the
 * only place of its formula.
 */
#ifndef CZ_LAWS_LAW_H
#define CZ_LAWS_LAW_H

#include <math.h>

#define CZ_FADE_LENGTH 0.01 /* stroke over which damping sets in [m] (ours) */

static inline double cz_larger(double a, double b) {
    return a > b ? a : b;
}

static inline double cz_smaller(double a, double b) {
    return a < b ? a : b;
}

static inline double cz_clamp(double value, double low, double high) {
    const double raised = value > low ? value : low;
    return raised < high ? raised : high;
}

static inline double cz_positive_part(double value) {
    return value > 0.0 ? value : 0.0;
}

/* 0 at 0, 1 from `length` on, linear in |value| in between. */
static inline double cz_fade_in(double value, double length) {
    return cz_clamp(fabs(value) * (1.0 / length), 0.0, 1.0); /* all lengths are constants */
}

#endif
