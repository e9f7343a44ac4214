/* Logarithm and exponential by series.
 *
 *   ln x  = k ln 2 + 2 (s + s^3 / 3 + s^5 / 5 + ...),   s = (m - 1) / (m + 1),  x = m 2^k
 *   e^x   = 2^k (1 + r + r^2 / 2 + r^3 / 6 + ...),      r = x - k ln 2
 *
 * with m from sqrt(1/2) to sqrt(2), so that |s| < 0.172, and |r| < 0.347. ln 2 has two parts, the
 * first short enough for k times it to be exact.
 */
#include "statistics/elementary.h"

#include <math.h>

enum { LOGARITHM_TERMS = 12, EXPONENTIAL_TERMS = 15 }; /* the next one is below 1e-17 */

static const double half_root = 0.70710678118654752;
static const double ln2_high = 0x1.62e42feep-1, ln2_low = 0x1.a39ef35793c76p-33;

double cz_logarithm(double x) {
    int k;
    double m = frexp(x, &k); /* from 1/2 to 1 */
    if (m < half_root) {
        m *= 2;
        k--;
    }
    const double s = (m - 1) / (m + 1), square = s * s;
    double sum = 0;
    for (int i = LOGARITHM_TERMS - 1; i > 0; i--)
        sum = square * (sum + 1.0 / (2 * i + 1));
    return k * ln2_high + (2 * s + (2 * s * sum + k * ln2_low));
}

double cz_exponential(double x) {
    const double k = floor(x / (ln2_high + ln2_low) + 0.5);
    const double r = (x - k * ln2_high) - k * ln2_low;
    double sum = 1;
    for (int i = EXPONENTIAL_TERMS; i > 0; i--)
        sum = 1 + sum * r / i;
    return ldexp(sum, (int)k);
}
