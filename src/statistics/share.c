/* Wilson's interval. */
#include "statistics/share.h"

#include <math.h>

void cz_share_interval(int k, int n, double *low, double *high) {
    static const double z = 1.959963984540054; /* 2.5 % of a normal distribution lies above it */
    *low = 0;
    *high = 1;
    if (n == 0)
        return;
    const double p = (double)k / n, square = z * z / n;
    const double half = z * sqrt(p * (1 - p) / n + square / (4 * (double)n));
    if (k > 0)
        *low = (p + square / 2 - half) / (1 + square);
    if (k < n)
        *high = (p + square / 2 + half) / (1 + square);
}
