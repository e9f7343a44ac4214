/* Slider: a spring that yields at a capacity, for hinges, folding ends, braked wheelsets and
 * sticking faces.
 *
 *   F = clamp(k (d - p), -capacity, capacity),   p' = d - F / k
 *
 * p is the slipped offset. The capacity may change from step to step; a shrinking one only
 * dissipates.
 */
#ifndef CZ_LAWS_SLIDER_H
#define CZ_LAWS_SLIDER_H

#include "laws/law.h"

typedef struct {
    double force;  /* [N] or [N m] */
    double offset; /* next p [m] or [rad] */
} CzSliderResponse;

/* `compliance` is 1/k, 0 for a slider without stiffness: saves a division where k is constant. */
static inline CzSliderResponse cz_slider_of(double stiffness, double compliance, double capacity,
                                            double displacement, double offset) {
    CzSliderResponse response;
    response.force = cz_clamp(stiffness * (displacement - offset), -capacity, capacity);
    response.offset = displacement - response.force * compliance;
    return response;
}

static inline CzSliderResponse cz_slider(double stiffness, double capacity, double displacement,
                                         double offset) {
    const double compliance = stiffness > 0.0 ? 1.0 / stiffness : 0.0;
    return cz_slider_of(stiffness, compliance, capacity, displacement, offset);
}

/* Work to move it from its offset to a displacement with a constant offset [J]: |F| (|d - p| - |F|
 * / 2 k). Where the offset follows, the part above F^2 / 2 k is dissipated. */
static inline double cz_slider_energy(double compliance, double force, double displacement,
                                      double offset) {
    const double elastic = fabs(force) * compliance;
    const double beyond = cz_positive_part(fabs(displacement - offset) - elastic);
    return fabs(force) * (0.5 * elastic + beyond);
}

/* Stop at both ends of a free travel: k max(|d| - range, 0) with the sign of d. */
static inline double cz_stop(double stiffness, double range, double displacement) {
    return stiffness * (displacement - cz_clamp(displacement, -range, range));
}

/* Stored energy [J]. */
static inline double cz_stop_energy(double stiffness, double range, double displacement) {
    const double beyond = displacement - cz_clamp(displacement, -range, range);
    return 0.5 * stiffness * beyond * beyond;
}

#endif
