/* Least squares by Householder's reflections. */
#include "base/least_squares.h"

#include <math.h>

#define DEPENDENT 1e-14 /* of a column's length: a smaller remainder is rounding (ours) */

/* Four partial sums, which fill a register. */
static double product(int n, const double *restrict a, const double *restrict b) {
    double sum[4] = {0.0};
    int i = 0;
    for (; i + 4 <= n; i += 4)
        for (int k = 0; k < 4; k++)
            sum[k] += a[i + k] * b[i + k];
    for (; i < n; i++)
        sum[0] += a[i] * b[i];
    return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}

/* Mirrors `target` by the reflection whose vector is v, with v v / 2 = v[0] length. */
static void reflect(int n, const double *restrict v, double half_square, double *restrict target) {
    const double factor = product(n, v, target) / half_square;
    for (int i = 0; i < n; i++)
        target[i] -= factor * v[i];
}

/* Solves R x = b for R above the diagonal of a, whose columns are m long. */
static void solve_upper(int m, int n, const double *a, double *b) {
    for (int k = n - 1; k >= 0; k--) {
        b[k] /= a[(long)k * m + k];
        for (int i = 0; i < k; i++)
            b[i] -= a[(long)k * m + i] * b[k];
    }
}

bool cz_least_squares(int m, int n, double *a, int n_right, double *b) {
    for (int k = 0; k < n; k++) {
        double *column = a + (long)k * m, *v = column + k;
        const double whole = sqrt(product(m, column, column)), rest = sqrt(product(m - k, v, v));
        if (!(rest > DEPENDENT * whole))
            return false;
        const double diagonal = v[0] > 0.0 ? -rest : rest;
        const double half_square = rest * (rest + fabs(v[0]));
        v[0] -= diagonal;
        for (int j = k + 1; j < n; j++)
            reflect(m - k, v, half_square, a + (long)j * m + k);
        for (int j = 0; j < n_right; j++)
            reflect(m - k, v, half_square, b + (long)j * m + k);
        v[0] = diagonal;
    }
    for (int j = 0; j < n_right; j++)
        solve_upper(m, n, a, b + (long)j * m);
    return true;
}
