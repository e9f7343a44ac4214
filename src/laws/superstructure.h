/* Superstructures in contact: elastic up to their strength, then crushed at that force.
 *
 *   F = clamp(k (d - p), 0, F_s),   p' = max(p, d - F / k)
 *
 * d is the closure and p the permanent set, which never decreases.
 */
#ifndef CZ_LAWS_SUPERSTRUCTURE_H
#define CZ_LAWS_SUPERSTRUCTURE_H

#include "laws/law.h"

typedef struct {
    double force; /* [N] */
    double set;   /* next p [m] */
} CzSuperstructureResponse;

static inline CzSuperstructureResponse cz_superstructure(double stiffness, double strength,
                                                         double closure, double set) {
    CzSuperstructureResponse response;
    response.force = cz_clamp(stiffness * (closure - set), 0.0, strength);
    response.set = cz_larger(set, closure - response.force / stiffness);
    return response;
}

#endif
