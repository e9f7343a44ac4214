/* The step at which wheel and rail begin to oscillate from step to step.
 *
 * A motion that changes its sign with every step is the first to grow. Then a force P of
 * alternating sign moves the wheel by -h^2 / (4 m - h^2 k) P, k the spring above it, and the modes
 * by the sum of -g^2 (2 / lambda) sinh(lambda h / 2) e / (1 + e) P with e = exp(lambda h), while
 * contact and the flexibility added to the modes deflect by (1 / k_c + r(h)) P. The step is stable
 * while
 *
 *   1 / k_c + r(h) > h^2 / (4 m - h^2 k) + sum of g^2 (2 / lambda) sinh(lambda h / 2) e / (1 + e)
 *
 * at every place between two seats. The modes are stable by themselves at any step, but a step must
 * resolve them: w h < 2 for the fastest, a third of its period.
 */
#include "model/track_bound.h"

#define SHORTEST 1e-6   /* [s] */
#define SWEEP 2.0       /* of the fastest mode in a step [rad] */
enum { HALVINGS = 12 }; /* of the ratio of the longest to the shortest: to a permille */

static CzComplex alternating_answer(CzComplex lambda, double step) {
    const CzComplex e = cz_complex_exponential(cz_complex_scaled(step, lambda));
    const CzComplex share = cz_complex_ratio(e, (CzComplex){1.0 + e.re, e.im});
    return cz_complex_product(cz_track_kick(lambda, step), share);
}

static bool is_stable(const CzTrackModes *modes, double contact, double inverse_mass, double spring,
                      double step) {
    const double held = 4.0 / (step * step * inverse_mass) - spring;
    if (!(held > 0.0))
        return false;
    double sum[2] = {0.0, 0.0};
    cz_track_add_modes(modes, alternating_answer, step, sum);
    const CzTrackFlexibility beside = cz_track_flexibility(modes, step);
    for (int place = 0; place <= 4; ++place) {
        const double cosine = cz_turned(0.125 * place).re;
        const double left = contact + cz_track_flexibility_at(&beside, cosine);
        if (!(left > 1.0 / held + sum[0] + sum[1] * cosine))
            return false;
    }
    return true;
}

double cz_track_longest_step(const CzTrackModes *modes, double contact, double inverse_mass,
                             double spring) {
    double low = SHORTEST, high = SWEEP / modes->cut;
    if (is_stable(modes, contact, inverse_mass, spring, high))
        return high;
    for (int i = 0; i < HALVINGS; ++i) {
        const double middle = sqrt(low * high);
        if (is_stable(modes, contact, inverse_mass, spring, middle))
            low = middle;
        else
            high = middle;
    }
    return low;
}
