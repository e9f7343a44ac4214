/* Buffer: hysteresis between a loading and an unloading curve, damping of its own rate, draw side
 * with slack.
 *
 *   upper(x) = min(loading(x), k_t max(x, 0))
 *   lower(x) = min(share * loading(x), k_t max(x, 0))
 *   static(x, p) = clamp(k_t (x - p), lower, upper) + k_b max(x - s, 0) - k_d max(-x - slack, 0)
 *   p' = x - clamped / k_t
 *   F = static + (c1 + c2 |x'|) * fade(x) * x'        c2 while loading only; at most 0 where x < 0
 *
 * fade(x) is taken at the larger of the strokes at both ends of a step, so that the force of the
 * step never falls while its stroke moves on. A gear in tension does not push before it has
 * returned: its damping reduces the pull, and the returning force fades in from 0.
 *
 * loading(x) rises nowhere faster than k_t, or a cycle between the curves would create energy.
 * Beyond the usable stroke s it is constant, and an elastic stop k_b acts in parallel, stiff and
 * without hysteresis.
 *
 * Inside a series chain the stroke x follows from the force, so the law is linearised about a
 * stroke that is `moved` beyond the committed one: over one step of length h, x_next = x + (F -
 * force) * compliance,  with one compliance for loading and one for unloading. |x'| in the
 * hydraulic damping is the committed rate. Each compliance is the exact tangent of the law, so a
 * step that passes a breakpoint is solved by linearising again about the new stroke.
 */
#ifndef CZ_LAWS_BUFFER_H
#define CZ_LAWS_BUFFER_H

#include "laws/law.h"

#define CZ_SMALLEST_STIFFNESS                                                                      \
    1e4 /* stiffness inside the slack, so that the chain has a unique solution [N/m] (ours) */

typedef struct {
    double transition;     /* k_t, stiffness between the curves [N/m] */
    double share;          /* unloading force over loading force [-] */
    double damping;        /* c1 [N s/m] */
    double quadratic;      /* c2 [N s2/m2] */
    double draw_stiffness; /* k_d [N/m] */
    double draw_slack;     /* [m] */
    double usable;         /* s, stroke at which it bottoms out [m]; 1e30 for none */
} CzBufferLaw;

typedef struct {
    double force;     /* at the stroke, with the damping of the movement [N] */
    double loading;   /* compliance of the step while the stroke grows [m/N] */
    double unloading; /* compliance of the step while it shrinks [m/N] */
    double offset;    /* next p [m] */
} CzBufferResponse;

/* `curve` and `slope` are those of the loading curve with its stop, at the stroke. */
static inline CzBufferResponse cz_buffer_of(const CzBufferLaw *law, double compliance, double curve,
                                            double slope, double stroke, double moved, double rate,
                                            double offset, double step) {
    /* The stop, and the curves at this stroke, both starting from zero along the transition. */
    const double stop_slope = stroke >= law->usable ? slope : 0.0;
    const double stop = stop_slope * cz_positive_part(stroke - law->usable);
    const double line = law->transition * cz_positive_part(stroke);
    const double upper_curve = curve - stop;
    const double lower_curve = law->share * upper_curve;
    const double curve_slope = slope - stop_slope;
    const double upper = cz_smaller(upper_curve, line);
    const double lower = cz_smaller(lower_curve, line);
    const double upper_slope = line < upper_curve ? law->transition : curve_slope;
    const double lower_slope = line < lower_curve ? law->transition : law->share * curve_slope;

    /* Hysteresis by return mapping, and the draw side. */
    const double inside = cz_clamp(law->transition * (stroke - offset), lower, upper);
    const double drawn = cz_positive_part(-stroke - law->draw_slack);
    const double draw_slope = -stroke >= law->draw_slack ? law->draw_stiffness : 0.0;

    /* Tangents for loading and unloading from here. Within the step the offset is constant, so a
     * stroke along a curve also returns along it: the two differ only where nothing moved. */
    const double line_here = law->transition * (stroke - offset);
    const double up_lower = moved < 0.0 && line_here < lower ? lower_slope : law->transition;
    const double down_upper = moved > 0.0 && line_here > upper ? upper_slope : law->transition;
    const double push_up = stop_slope + (inside >= upper ? upper_slope : up_lower);
    const double push_down = stop_slope + (inside <= lower ? lower_slope : down_upper);
    const double up = stroke >= 0.0 ? push_up : draw_slope;
    const double down = stroke > 0.0 ? push_down : draw_slope;

    /* Damping by the larger of the strokes at both ends of the step, so that its force never falls
     * while the stroke moves on, and its growth as it fades in. */
    const double after = fabs(stroke);
    const double returned = stroke > 0.0 && moved > stroke ? 0.0 : fabs(stroke - moved);
    const double fade = cz_fade_in(cz_larger(returned, after), CZ_FADE_LENGTH);
    const double growing = stroke > 0.0 ? law->quadratic * cz_positive_part(rate) : 0.0;
    const double slow = law->damping, fast = law->damping + growing;
    const double still_fades = after > returned && after < CZ_FADE_LENGTH ? 1.0 : 0.0;
    const double fading = fade + still_fades * fabs(moved) * (1.0 / CZ_FADE_LENGTH);
    const double per_step = 1.0 / step;
    const double damped = (moved > 0.0 ? fast : slow) * fade;
    const double damping_up = (moved < 0.0 ? slow : fast) * fading;
    const double damping_down = (moved > 0.0 ? fast : slow) * fading;
    const double pull = damped * moved * per_step - law->draw_stiffness * drawn;
    const double outside = stroke < 0.0 && pull > 0.0 ? 0.0 : pull;
    const double follows = stroke < 0.0 && pull >= 0.0 ? 0.0 : 1.0; /* returning without contact */

    CzBufferResponse response;
    response.force = inside + stop + outside;
    response.loading =
        1.0 / (cz_larger(follows * up, CZ_SMALLEST_STIFFNESS) + follows * damping_up * per_step);
    response.unloading = 1.0 / (cz_larger(follows * down, CZ_SMALLEST_STIFFNESS) +
                                follows * damping_down * per_step);
    response.offset = stroke - inside * compliance;
    return response;
}

static inline CzBufferResponse cz_buffer(const CzBufferLaw *law, double curve, double slope,
                                         double stroke, double moved, double rate, double offset,
                                         double step) {
    return cz_buffer_of(law, 1.0 / law->transition, curve, slope, stroke, moved, rate, offset,
                        step);
}

#endif
