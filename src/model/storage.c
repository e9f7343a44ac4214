/* Available storage by structured doubling.
 *
 * Bellman's equation of the largest energy that can be extracted, with the work row n = c' (A - 1)
 * and d = c' b,
 *
 *   x' H x = max over f of   - f n x - f d f + (A x + b f)' H (A x + b f)
 *
 * is a discrete Riccati equation. With A0 = A - b n / (2 d), G0 = -b b' / d, H0 = n' n / (4 d) the
 * iteration
 *
 *   W = 1 + G H     A <- A W^-1 A     G <- G + A W^-1 G A'     H <- H + A' H W^-1 A
 *
 * doubles the number of steps ahead that H covers each time (Chu, Fan, Lin and Wang 2004).
 */
#include "model/storage.h"

#include <math.h>
#include <string.h>

#include "base/least_squares.h"

enum { MAX_DOUBLINGS = 24 }; /* 16 million steps (ours) */
#define LAST_CHANGE 1e-6     /* of the largest entry of H (ours) */

/* Square matrices of the same order, stored by columns as cz_least_squares requires. */
typedef struct Doubling {
    int n;
    double *a, *g, *h; /* the iterates */
    double *w, *wa;    /* 1 + G H; W^-1 A and, after it, W^-1 G */
    double *transposed, *product, *next;
} Doubling;

/* target = left right, sums over columns of left. */
static void multiply(int n, const double *left, const double *right, double *target) {
    memset(target, 0, (size_t)(n * n) * sizeof *target);
    for (int j = 0; j < n; j++)
        for (int k = 0; k < n; k++) {
            const double factor = right[j * n + k];
            for (int i = 0; i < n; i++)
                target[j * n + i] += factor * left[k * n + i];
        }
}

static void transpose(int n, const double *matrix, double *target) {
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++)
            target[j * n + i] = matrix[i * n + j];
}

static double largest(int n, const double *matrix) {
    double size = 0.0;
    for (int i = 0; i < n * n; i++)
        size = fmax(size, fabs(matrix[i]));
    return size;
}

static void add(int n, const double *change, double *matrix) {
    for (int i = 0; i < n * n; i++)
        matrix[i] += change[i];
}

/* Returns how much H changed, of its size; NaN when W has no inverse. */
static double double_once(Doubling *d) {
    const int n = d->n;
    const size_t size = (size_t)(n * n), bytes = size * sizeof(double);
    multiply(n, d->g, d->h, d->w);
    for (int i = 0; i < n; i++)
        d->w[i * n + i] += 1.0;
    memcpy(d->wa, d->a, bytes);
    memcpy(d->wa + size, d->g, bytes);
    if (!cz_least_squares(n, n, d->w, 2 * n, d->wa))
        return NAN;
    transpose(n, d->a, d->transposed);
    multiply(n, d->h, d->wa, d->product);
    multiply(n, d->transposed, d->product, d->next);
    const double change = largest(n, d->next);
    add(n, d->next, d->h);
    multiply(n, d->a, d->wa + size, d->product);
    multiply(n, d->product, d->transposed, d->next);
    add(n, d->next, d->g);
    multiply(n, d->a, d->wa, d->next);
    memcpy(d->a, d->next, bytes);
    return change / largest(n, d->h);
}

static bool start(Doubling *d, const double *a, const double *b, const double *c) {
    const int n = d->n;
    double *work = d->product, gain = 0.0;
    for (int j = 0; j < n; j++) {
        work[j] = -c[j];
        for (int i = 0; i < n; i++)
            work[j] += c[i] * a[i * n + j];
        gain += c[j] * b[j];
    }
    if (!(gain > 0.0))
        return false;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            d->a[j * n + i] = a[i * n + j] - 0.5 * b[i] * work[j] / gain;
            d->g[j * n + i] = -b[i] * b[j] / gain;
            d->h[j * n + i] = 0.25 * work[i] * work[j] / gain;
        }
    return true;
}

bool cz_available_storage(int n, const double *a, const double *b, const double *c, double *h,
                          CzArena *scratch) {
    const size_t size = (size_t)n * (size_t)n;
    double *memory = cz_arena_allocate(scratch, 9 * size, sizeof *memory);
    if (memory == NULL)
        return false;
    Doubling d = {.n = n,
                  .a = memory,
                  .g = memory + size,
                  .h = memory + 2 * size,
                  .w = memory + 3 * size,
                  .wa = memory + 4 * size,
                  .transposed = memory + 6 * size,
                  .product = memory + 7 * size,
                  .next = memory + 8 * size};
    if (!start(&d, a, b, c))
        return false;
    double change = 1.0;
    for (int i = 0; i < MAX_DOUBLINGS && change > LAST_CHANGE; i++)
        change = double_once(&d);
    memcpy(h, d.h, size * sizeof *h);
    return isfinite(change);
}
