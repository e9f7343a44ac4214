/* Fewer points for a measured curve. */
#include "problem/reduce_curve.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

static double area_under(const double *x, const double *y, const int *kept, int n_kept) {
    double area = 0;
    for (int i = 1; i < n_kept; i++)
        area += 0.5 * (y[kept[i]] + y[kept[i - 1]]) * (x[kept[i]] - x[kept[i - 1]]);
    return area;
}

static double triangle(const double *x, const double *y, int a, int b, int c) {
    return 0.5 * fabs((x[b] - x[a]) * (y[c] - y[a]) - (x[c] - x[a]) * (y[b] - y[a]));
}

/* Drops the point that matters least. */
static int drop_one(const double *x, const double *y, int peak, int *kept, int n_kept) {
    int least = -1;
    double least_area = 0;
    for (int i = 1; i < n_kept - 1; i++) {
        const double area = triangle(x, y, kept[i - 1], kept[i], kept[i + 1]);
        if (kept[i] != peak && (least < 0 || area < least_area)) {
            least = i;
            least_area = area;
        }
    }
    memmove(&kept[least], &kept[least + 1], (size_t)(n_kept - least - 1) * sizeof kept[0]);
    return n_kept - 1;
}

/* Factor on the kept points other than the ends and the peak that gives the area wanted. */
static double scale_for(const double *x, const double *y, int peak, const int *kept, int n_kept,
                        double wanted) {
    double movable = 0;
    for (int i = 1; i < n_kept - 1; i++)
        if (kept[i] != peak)
            movable += 0.5 * y[kept[i]] * (x[kept[i + 1]] - x[kept[i - 1]]);
    const double lost = wanted - area_under(x, y, kept, n_kept);
    return movable > 0 && movable + lost > 0 ? (movable + lost) / movable : 1;
}

/* Largest difference of the kept, scaled curve to the full one at the full one's points. */
static double largest_difference(const double *x, const double *y, int peak, const int *kept,
                                 int n_kept, double scale) {
    double largest = 0;
    for (int i = 1; i < n_kept; i++) {
        const int a = kept[i - 1], b = kept[i];
        const double y_a = i - 1 == 0 || a == peak ? y[a] : y[a] * scale;
        const double y_b = i == n_kept - 1 || b == peak ? y[b] : y[b] * scale;
        for (int k = a; k <= b; k++) {
            const double share = (x[k] - x[a]) / (x[b] - x[a]);
            largest = fmax(largest, fabs(y_a + share * (y_b - y_a) - y[k]));
        }
    }
    return largest;
}

CzCurveChange cz_reduce_curve(double *x, double *y, int *n_point, int n_most, int *kept) {
    int n_kept = *n_point, peak = 0;
    for (int i = 0; i < n_kept; i++) {
        kept[i] = i;
        peak = y[i] > y[peak] ? i : peak;
    }
    CzCurveChange change = {.area = area_under(x, y, kept, n_kept)};
    if (n_kept <= n_most)
        return change;
    while (n_kept > n_most)
        n_kept = drop_one(x, y, peak, kept, n_kept);
    const double scale = scale_for(x, y, peak, kept, n_kept, change.area);
    change.largest_difference = largest_difference(x, y, peak, kept, n_kept, scale);
    for (int i = 0; i < n_kept; i++) {
        const bool is_fixed = i == 0 || i == n_kept - 1 || kept[i] == peak;
        x[i] = x[kept[i]];
        y[i] = is_fixed ? y[kept[i]] : y[kept[i]] * scale;
    }
    *n_point = n_kept;
    return change;
}
