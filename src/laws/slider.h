/* Slider: a spring that yields at a capacity, for hinges, folding ends, held brakes and faces that
 * stick.
 *
 *   F = clamp(k (d - p), -capacity, capacity),   p' = d - F / k
 *
 * p is the offset that has slipped. The capacity may change from step to step; a shrinking one only
 * dissipates.
 */
#ifndef CZ_LAWS_SLIDER_H
#define CZ_LAWS_SLIDER_H

#include "laws/law.h"

typedef struct {
    double force;  /* [N] or [N m] */
    double offset; /* next p [m] or [rad] */
} CzSliderResponse;

static inline CzSliderResponse cz_slider(double stiffness, double capacity, double displacement,
                                         double offset) {
    CzSliderResponse response;
    response.force = cz_clamp(stiffness * (displacement - offset), -capacity, capacity);
    response.offset = displacement - response.force / cz_larger(stiffness, 1e-30);
    return response;
}

/* Stop at both sides of a free range: k max(|d| - range, 0) with the sign of d. */
static inline double cz_stop(double stiffness, double range, double displacement) {
    return stiffness * (displacement - cz_clamp(displacement, -range, range));
}

#endif
