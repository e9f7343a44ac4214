/* The filter of SAE J211-1 (ISO 6487 has the same classes): with T the time between samples,
 *
 *   w_d = 2 pi CFC 2.0775        w_a = tan(w_d T / 2)
 *   a_0 = w_a^2 / (1 + sqrt(2) w_a + w_a^2),   a_1 = 2 a_0,   a_2 = a_0
 *   b_1 = -2 (w_a^2 - 1) / (...),   b_2 = (-1 + sqrt(2) w_a - w_a^2) / (...)
 *   y_t = a_0 x_t + a_1 x_(t-1) + a_2 x_(t-2) + b_1 y_(t-1) + b_2 y_(t-2)
 *
 * forwards and then backwards. The samples are extended at both ends by point reflection about the
 * end point, for the memory of the filter.
 */
#include "simulate/filter.h"

#include <math.h>
#include <stdlib.h>

#define PI 3.14159265358979323846
#define SAMPLES_PER_CYCLE 10.0 /* as SAE J211-1 requires */

int cz_filter_fits(double class_hz, double step) {
    return step > 0.0 && SAMPLES_PER_CYCLE * class_hz * step <= 1.0 + 1e-9;
}

/* Tangent of an angle below 1 by its series, so that every mathematics library gives the same
 * bits. */
static double tangent(double angle) {
    double sine = 0.0, cosine = 0.0, term = 1.0;
    for (int power = 0; power < 24; power++) {
        const double sign = power % 4 < 2 ? 1.0 : -1.0;
        if (power % 2 == 0)
            cosine += sign * term;
        else
            sine += sign * term;
        term *= angle / (power + 1);
    }
    return sine / cosine;
}

/* Runs the filter over n samples that lie `stride` (1 or -1) apart, in place. It starts at rest at
 * the first sample. */
static void run(const double a0, const double b1, const double b2, int n, int stride, double *x) {
    double x1 = x[0], x2 = x[0], y1 = x[0], y2 = x[0];
    for (int i = 0; i < n; i++, x += stride) {
        const double y = a0 * (*x + 2.0 * x1 + x2) + b1 * y1 + b2 * y2;
        x2 = x1;
        x1 = *x;
        y2 = y1;
        y1 = y;
        *x = y;
    }
}

CzStatus cz_filter_cfc(double class_hz, double step, int n, const double *in, double *out) {
    const double wa = tangent(PI * class_hz * 2.0775 * step);
    const double below = 1.0 + sqrt(2.0) * wa + wa * wa;
    const double a0 = wa * wa / below;
    const double b1 = -2.0 * (wa * wa - 1.0) / below;
    const double b2 = (-1.0 + sqrt(2.0) * wa - wa * wa) / below;
    const int memory =
        (int)ceil(1.0 / (class_hz * step)); /* a cycle of the class [sample] (ours) */
    const int more = memory < n ? memory : n > 0 ? n - 1 : 0;
    double *x = malloc((size_t)(n + 2 * more + 1) * sizeof *x);
    if (x == NULL)
        return CZ_STATUS_NO_MEMORY;
    for (int i = 0; i < more; i++) {
        x[i] = 2.0 * in[0] - in[more - i];
        x[more + n + i] = 2.0 * in[n - 1] - in[n - 2 - i];
    }
    for (int i = 0; i < n; i++)
        x[more + i] = in[i];
    if (n > 0) {
        run(a0, b1, b2, n + 2 * more, 1, x);
        run(a0, b1, b2, n + 2 * more, -1, x + n + 2 * more - 1);
    }
    for (int i = 0; i < n; i++)
        out[i] = x[more + i];
    free(x);
    return CZ_OK;
}
