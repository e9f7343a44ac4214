/* Resistance of coupler faces to swinging: full where they are coupled and undamaged, none where
 * they are apart or sheared off; faces that are not coupled engage over a small closure.
 *
 *   engaged = (coupled ? 1 : s^2 (3 - 2 s)) (1 - damage),   s = clamp(closure / 5 mm, 0, 1)
 *   U       = engaged u(swing)
 *
 * u is the energy of their hinges and stops with fully engaged faces. Moment and push follow from
 * U: faces that meet at an angle are flattened by a push of dU / dclosure, so that no closed path
 * creates energy. The energy stored at the moment of damage is lost.
 */
#ifndef CZ_LAWS_COUPLER_H
#define CZ_LAWS_COUPLER_H

#include "laws/law.h"

#define CZ_ENGAGING_CLOSURE 0.005 /* [m] (ours) */

typedef struct {
    double engaged; /* [-] */
    double grows;   /* with the closure [1/m] */
} CzEngagement;

/* `exists` is 1 where there are couplers, `coupled` 1 where they carry tension. */
static inline CzEngagement cz_coupler_engagement(double exists, double coupled, double closure,
                                                 double damage) {
    const double s = cz_clamp(closure * (1.0 / CZ_ENGAGING_CLOSURE), 0.0, 1.0);
    const double undamaged = exists * (1.0 - damage);
    const double mated = s * s * (3.0 - 2.0 * s);
    const double mating = 6.0 * s * (1.0 - s) * (1.0 / CZ_ENGAGING_CLOSURE);
    CzEngagement engagement;
    engagement.engaged = undamaged * (coupled > 0.5 ? 1.0 : mated);
    engagement.grows = undamaged * (coupled > 0.5 ? 0.0 : mating);
    return engagement;
}

#endif
