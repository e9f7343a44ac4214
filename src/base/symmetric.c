/* Symmetric matrices: Jacobi's method and Cholesky's factor.
 *
 *   rotation by t = tan(phi):  a_pq = 0  for  t = sign(theta) / (|theta| + sqrt(theta^2 + 1)),
 *                              theta = (a_qq - a_pp) / (2 a_pq)
 */
#include "base/symmetric.h"

#include <math.h>

enum { MAX_SWEEPS = 30 };

#define NEGLIGIBLE                                                                                 \
    1e-18 /* of two diagonal elements: a rotation would not change them by a smaller element */

/* Rotates two rows. */
static void rotate_rows(int n, double *restrict p, double *restrict q, double c, double s) {
#pragma omp simd
    for (int k = 0; k < n; k++) {
        const double pk = p[k], qk = q[k];
        p[k] = c * pk - s * qk;
        q[k] = s * pk + c * qk;
    }
}

/* Rotates rows and columns p and q so that a[p][q] vanishes, and the rows of the vectors with them.
 */
static void rotate(int n, double *a, double *vectors, int p, int q) {
    const double theta = (a[q * n + q] - a[p * n + p]) / (2.0 * a[p * n + q]);
    const double t = (theta >= 0.0 ? 1.0 : -1.0) / (fabs(theta) + sqrt(theta * theta + 1.0));
    const double c = 1.0 / sqrt(t * t + 1.0), s = t * c;
    for (int k = 0; k < n; k++) {
        const double kp = a[k * n + p], kq = a[k * n + q];
        a[k * n + p] = c * kp - s * kq;
        a[k * n + q] = s * kp + c * kq;
    }
    rotate_rows(n, &a[p * n], &a[q * n], c, s);
    rotate_rows(n, &vectors[p * n], &vectors[q * n], c, s);
}

/* Returns the number of rotations. */
static int sweep(int n, double *a, double *vectors) {
    int n_rotation = 0;
    for (int p = 0; p < n; p++)
        for (int q = p + 1; q < n; q++)
            if (fabs(a[p * n + q]) > NEGLIGIBLE * (fabs(a[p * n + p]) + fabs(a[q * n + q]))) {
                rotate(n, a, vectors, p, q);
                n_rotation++;
            }
    return n_rotation;
}

static void transpose(int n, double *a) {
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++) {
            const double kept = a[i * n + j];
            a[i * n + j] = a[j * n + i];
            a[j * n + i] = kept;
        }
}

void cz_symmetric_diagonalise(int n, double *a, double *vectors) {
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            vectors[i * n + j] = i == j;
    for (int i = 0; i < MAX_SWEEPS && sweep(n, a, vectors) > 0; i++)
        ;
    transpose(n, vectors); /* to columns */
}

bool cz_symmetric_factor(int n, double *a) {
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++) {
            double rest = a[i * n + j];
            for (int k = 0; k < j; k++)
                rest -= a[i * n + k] * a[j * n + k];
            if (i == j && !(rest > 0.0))
                return false;
            a[i * n + j] = i == j ? sqrt(rest) : rest / a[j * n + j];
        }
    return true;
}

void cz_lower_solve(int n, const double *factor, double *b, int stride) {
    for (int i = 0; i < n; i++) {
        double rest = b[i * stride];
        for (int k = 0; k < i; k++)
            rest -= factor[i * n + k] * b[k * stride];
        b[i * stride] = rest / factor[i * n + i];
    }
}

void cz_upper_solve(int n, const double *factor, double *b, int stride) {
    for (int i = n - 1; i >= 0; i--) {
        double rest = b[i * stride];
        for (int k = i + 1; k < n; k++)
            rest -= factor[k * n + i] * b[k * stride];
        b[i * stride] = rest / factor[i * n + i];
    }
}
