/* Normal force of two faces that a series chain presses together, with damping while they close;
 * both fall with a small remaining overlap.
 *
 *   o    = overlap - |offset|                          remaining overlap
 *   lost = max(lost before, 1 - clamp(o / p, 0, 1))    over one rib pitch p; 0 once they part
 *   N    = (1 - lost) (F + min(c max(x', 0) fade(x), F))
 *
 * F is the chain's force, x the closure. Faces that have lost contact do not engage again before
 * they have parted.
 */
#ifndef CZ_LAWS_FACE_H
#define CZ_LAWS_FACE_H

#include "laws/law.h"

typedef struct {
    double damping; /* c [N s/m] */
    double overlap; /* of level faces [m] */
    double pitch;   /* p [m] */
} CzFaceLaw;

typedef struct {
    double normal;    /* N [N] */
    double held;      /* 1 - lost [-] */
    double damped;    /* damping before that share [N] */
    double lost;      /* to remember [-] */
    double remaining; /* o [m] */
} CzFaceResponse;

static inline CzFaceResponse cz_face(const CzFaceLaw *law, double chain, double closure,
                                     double rate, double offset, double lost) {
    const double wanted =
        law->damping * cz_positive_part(rate) * cz_fade_in(closure, CZ_FADE_LENGTH);
    CzFaceResponse response;
    response.damped = cz_smaller(wanted, chain);
    response.remaining = law->overlap - fabs(offset);
    const double released = 1.0 - cz_clamp(response.remaining / law->pitch, 0.0, 1.0);
    const double most = cz_larger(lost, released);
    response.held = 1.0 - most;
    response.lost = closure > 0.0 ? most : 0.0;
    response.normal = response.held * (chain + response.damped);
    return response;
}

/* Closing speed at first contact [m/s], frozen from then on; 0 before. */
static inline double cz_first_speed(double closure, double rate, double speed) {
    const double touching = closure > 0.0 ? cz_larger(rate, 1e-9) : 0.0;
    return speed > 0.0 ? speed : touching;
}

#endif
