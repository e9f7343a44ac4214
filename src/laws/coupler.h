/* Coupler faces against swinging: held fully where they are coupled and undamaged, not at all where
 * they are apart or sheared off; faces that are not coupled take up moments over a small closure.
 *
 *   engaged = (coupled ? 1 : clamp(max(closure, 0) / 5 mm, 0, 1)) (1 - damage)
 */
#ifndef CZ_LAWS_COUPLER_H
#define CZ_LAWS_COUPLER_H

#include "laws/law.h"

#define CZ_ENGAGING_CLOSURE 0.005 /* [m] (ours) */

/* `exists` is 1 where there are couplers, `coupled` 1 where they carry tension. */
static inline double cz_coupler_engagement(double exists, double coupled, double closure,
                                           double damage) {
    const double mated = cz_fade_in(cz_positive_part(closure), CZ_ENGAGING_CLOSURE);
    return exists * (coupled > 0.5 ? 1.0 : mated) * (1.0 - damage);
}

#endif
