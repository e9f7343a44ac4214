/* Calibration of the co-running track. */
#include "model/co_running.h"

#define LOWEST 6.3  /* where the search for the resonance begins: 1 Hz [rad/s] (ours) */
#define HIGHEST 9e3 /* and where it ends: 1.4 kHz, below the cut of the modes [rad/s] (ours) */
#define GROWTH 1.1  /* from one frequency to the next (ours) */
enum { HALVINGS = 40 };
#define MOST_DAMPED 0.999 /* damping ratio (ours) */

/* Mean of the flexibility over a bay: the powers of a cosine and |sin| have the means 1, 0, 1/2, 0
 * and 2 / pi. */
static double mean_flexibility(const CzTrackModes *modes) {
    const CzTrackFlexibility flexibility = cz_track_flexibility(modes, 0.0);
    double mean = flexibility.kink * 2.0 / CZ_PI, power = 1.0;
    for (int k = 0; k < CZ_TRACK_FLEX_TERMS; k += 2) {
        mean += power * flexibility.term[k];
        power *= (k + 1.0) / (k + 2.0);
    }
    return mean;
}

static CzComplex receptance(const CzTrackModes *modes, double flexibility, double w) {
    CzComplex sum = {flexibility, 0.0};
    for (int k = 0; k < modes->n_group; ++k) {
        const CzTrackGroup *group = &modes->group[k];
        for (int i = 0; i < CZ_TRACK_WIDTH; ++i) {
            const CzComplex g = group->direct[i], a = group->alias[i], lambda = group->lambda[i];
            if (cz_complex_square_size(g) == 0.0)
                continue;
            /* Squared shape, its mean over a bay: half, but all of the one wave that is everywhere
             * the same. A pair is stored once. */
            const double share = group->vector == 0 && i == 0 ? 1.0 : 0.5;
            const CzComplex square = cz_complex_scaled(
                0.5 * share, cz_complex_sum(cz_complex_product(g, g), cz_complex_product(a, a)));
            const CzComplex one = {-lambda.re, w - lambda.im}, other = {-lambda.re, w + lambda.im};
            const CzComplex turned = {square.re, -square.im};
            sum = cz_complex_sum(sum, cz_complex_ratio(square, one));
            sum = cz_complex_sum(sum, cz_complex_ratio(turned, other));
        }
    }
    return sum;
}

CzComplex cz_track_receptance(const CzTrackModes *modes, double w) {
    return receptance(modes, mean_flexibility(modes), w);
}

/* Where the deflection first lags by a quarter of a period. */
static double first_quarter(const CzTrackModes *modes, double flexibility) {
    double low = LOWEST;
    while (low < HIGHEST && receptance(modes, flexibility, low * GROWTH).re > 0.0)
        low *= GROWTH;
    double high = low * GROWTH;
    for (int i = 0; i < HALVINGS; ++i) {
        const double middle = 0.5 * (low + high);
        if (receptance(modes, flexibility, middle).re > 0.0)
            low = middle;
        else
            high = middle;
    }
    return high;
}

CzCoRunning cz_co_running(const CzTrackModes *modes) {
    const double flexibility = mean_flexibility(modes), w = first_quarter(modes, flexibility);
    const double k = 1.0 / receptance(modes, flexibility, 0.0).re;
    const double c = 1.0 / (w * cz_complex_size(receptance(modes, flexibility, w)));
    const double most = 2.0 * MOST_DAMPED * k / w;
    return (CzCoRunning){.stiffness = k, .damping = c < most ? c : most, .mass = k / (w * w)};
}
