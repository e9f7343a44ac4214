/* Shear-off: strength of the overload device over its travel s.
 *
 *   damage(s)   = clamp(s / softening, 0, 1)
 *   strength(s) = F_s (1 - damage) + k_bottom max(s - space, 0)
 *
 * Irreversible because s never shrinks. `space` is softening length plus retraction space: beyond
 * it the released coupler meets its stop and is a second load path at coupler height.
 */
#ifndef CZ_LAWS_SHEAR_OFF_H
#define CZ_LAWS_SHEAR_OFF_H

#include "laws/law.h"

typedef struct {
    double strength; /* [N] */
    double slope;    /* of the rising part [N/m] */
    double damage;   /* 0 whole, 1 gone [-] */
} CzShearOffResponse;

static inline CzShearOffResponse cz_shear_off(double force, double softening, double space,
                                              double bottom, double travel) {
    CzShearOffResponse response;
    response.damage = cz_clamp(travel / softening, 0.0, 1.0);
    response.strength = force * (1.0 - response.damage) + bottom * cz_positive_part(travel - space);
    response.slope = travel > space ? bottom : 0.0;
    return response;
}

#endif
