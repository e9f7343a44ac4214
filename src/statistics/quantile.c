/* Quantiles, mean and deviation. */
#include "statistics/quantile.h"

#include <math.h>
#include <stdlib.h>

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void cz_sort_numbers(int n, double *value) {
    qsort(value, (size_t)n, sizeof *value, compare);
}

double cz_quantile_of(int n, const double *sorted, double p) {
    if (n == 0)
        return NAN;
    const double place = (n - 1) * p;
    const int below = (int)place;
    const double part = place - below;
    if (part <= 0 || below + 1 >= n)
        return sorted[below];
    if (!isfinite(sorted[below]) || !isfinite(sorted[below + 1]))
        return isfinite(sorted[below]) ? sorted[below + 1] : sorted[below];
    return sorted[below] + part * (sorted[below + 1] - sorted[below]);
}

double cz_mean_of(int n, const double *value) {
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += value[i];
    return n > 0 ? sum / n : NAN;
}

double cz_deviation_of(int n, const double *value) {
    const double mean = cz_mean_of(n, value);
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += (value[i] - mean) * (value[i] - mean);
    return n > 1 ? sqrt(sum / (n - 1)) : NAN;
}
