/* Plastic member of a series chain: collapse tube, anti-climber, shear-off. It is rigid until the
 * chain's force reaches its strength, then it crushes; its elasticity is the chain's compliance.
 *
 *   over one step:  crush(F) = max(F - strength(s), 0) / resistance,   s' = s + crush
 *   resistance = max(strength'(s), 0) + strength * rate_factor / h + smallest
 *
 * The strength is taken at the committed stroke s, so a falling strength (trigger peak, shear-off)
 * releases the chain's elastic energy over a few steps; the rate factor acts on plastic stroke
 * alone. The smallest resistance (ours) makes the split between equal members unique and adds a
 * force of resistance * crush per step, some ten newtons.
 */
#ifndef CZ_LAWS_PLASTIC_MEMBER_H
#define CZ_LAWS_PLASTIC_MEMBER_H

#include "laws/law.h"

#define CZ_SMALLEST_RESISTANCE 1e5 /* [N/m] (ours) */

/* Increase of the force with the plastic stroke over one step [N/m]. */
static inline double cz_plastic_resistance(double strength, double slope, double rate_factor,
                                           double step) {
    const double per_step = 1.0 / step; /* one division for all lanes */
    return cz_positive_part(slope) + strength * rate_factor * per_step + CZ_SMALLEST_RESISTANCE;
}

/* Plastic stroke per excess force over one step [m/N]. */
static inline double cz_plastic_compliance(double strength, double slope, double rate_factor,
                                           double step) {
    return 1.0 / cz_plastic_resistance(strength, slope, rate_factor, step);
}

/* Plastic stroke of the step under the chain's force [m], never negative. */
static inline double cz_plastic_crush(double force, double strength, double compliance) {
    return cz_positive_part(force - strength) * compliance;
}

#endif
