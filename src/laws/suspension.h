/* Vertical suspension: spring without tension, bump and lift stops, damper with a relief valve;
 * increments from rest.
 *
 *   spring(d) = max(k d, -F_0) + k_bump max(d - bump, 0) - k_lift max(-d - lift, 0)
 *   damper(d') = c clamp(d', -v_b, v_b) + c_b (d' - clamp(d', -v_b, v_b))
 *
 * d is the compression from static rest and F_0 the static load: the spring force never falls below
 * zero.
 */
#ifndef CZ_LAWS_SUSPENSION_H
#define CZ_LAWS_SUSPENSION_H

#include "laws/law.h"

typedef struct {
    double stiffness;      /* k [N/m] */
    double preload;        /* F_0 [N]; never (1e30) when the spring carries tension */
    double bump_gap;       /* [m]; 1e30 without a stop */
    double bump_stiffness; /* [N/m] */
    double lift_gap;       /* [m]; 1e30 without a stop */
    double lift_stiffness; /* [N/m] */
    double damping;        /* c [N s/m] */
    double blow_off_rate;  /* v_b [m/s] */
    double damping_beyond; /* c_b [N s/m] */
} CzSuspensionLaw;

/* Bump and lift stop alone. */
static inline double cz_suspension_stops(const CzSuspensionLaw *law, double compression) {
    const double bump = law->bump_stiffness * cz_positive_part(compression - law->bump_gap);
    const double lift = law->lift_stiffness * cz_positive_part(-compression - law->lift_gap);
    return bump - lift;
}

static inline double cz_suspension_spring(const CzSuspensionLaw *law, double compression) {
    const double spring = cz_larger(law->stiffness * compression, -law->preload);
    return spring + cz_suspension_stops(law, compression);
}

/* Energy of the spring and its stops, from static rest [J]. */
static inline double cz_suspension_stored(const CzSuspensionLaw *law, double compression) {
    const double least = -law->preload / cz_larger(law->stiffness, 1.0);
    const double bound = cz_larger(compression, least), free = compression - bound;
    const double bump = cz_positive_part(compression - law->bump_gap);
    const double lift = cz_positive_part(-compression - law->lift_gap);
    return 0.5 * law->stiffness * bound * bound - law->preload * free +
           0.5 * (law->bump_stiffness * bump * bump + law->lift_stiffness * lift * lift);
}

static inline double cz_suspension_damper(const CzSuspensionLaw *law, double rate) {
    const double small = cz_clamp(rate, -law->blow_off_rate, law->blow_off_rate);
    return law->damping * small + law->damping_beyond * (rate - small);
}

#endif
