/* Shear-off: strength of the overload device over its travel s.
 *
 *   damage(s)   = clamp(s / softening, 0, 1)
 *   strength(s) = F_r + (F_s - F_r) (1 - damage) + k_bottom max(s - space, 0)
 *
 * F_r is the friction force after the device has sheared at F_s. Irreversible because s
 * never shrinks. `space` is softening length plus retraction space: beyond it the released coupler
 * meets its stop and is a second load path at coupler height.
 */
#ifndef CZ_LAWS_SHEAR_OFF_H
#define CZ_LAWS_SHEAR_OFF_H

#include "laws/law.h"

typedef struct {
    double strength; /* [N] */
    double slope;    /* of the rising part [N/m] */
    double damage;   /* 0 undamaged, 1 sheared off [-] */
} CzShearOffResponse;

typedef struct {
    double force;     /* F_s [N] */
    double residual;  /* F_r, below F_s [N] */
    double softening; /* travel over which the force falls from F_s to F_r [m] */
    double space;     /* [m] */
    double bottom;    /* k_bottom [N/m] */
} CzShearOffLaw;

static inline CzShearOffResponse cz_shear_off(const CzShearOffLaw *law, double travel) {
    CzShearOffResponse response;
    response.damage = cz_clamp(travel / law->softening, 0.0, 1.0);
    response.strength = law->residual + (law->force - law->residual) * (1.0 - response.damage) +
                        law->bottom * cz_positive_part(travel - law->space);
    response.slope = travel > law->space ? law->bottom : 0.0;
    return response;
}

#endif
