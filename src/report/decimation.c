/* Decimation of curves: a span is split at the point furthest from its chord until all points are
 * within the tolerance. */
#include "report/decimation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct Span {
    int from, to;
} Span;

/* Distance of a point from the segment between two others. */
static double distance(const double *x, const double *y, int point, Span span) {
    const double dx = x[span.to] - x[span.from], dy = y[span.to] - y[span.from];
    const double px = x[point] - x[span.from], py = y[point] - y[span.from];
    const double square = dx * dx + dy * dy;
    double along = square > 0 ? (px * dx + py * dy) / square : 0;
    along = along < 0 ? 0 : along > 1 ? 1 : along;
    const double ex = px - along * dx, ey = py - along * dy;
    return sqrt(ex * ex + ey * ey);
}

/* Furthest point between the ends of a span; -1 when none is beyond the tolerance. */
static int furthest(const double *x, const double *y, Span span, double tolerance) {
    double largest = tolerance;
    int found = -1;
    for (int i = span.from + 1; i < span.to; i++) {
        const double d = distance(x, y, i, span);
        if (d > largest) {
            largest = d;
            found = i;
        }
    }
    return found;
}

/* Decimates with one tolerance; returns the number of points kept. `stack` has room for n spans,
 * which suffices, because every split adds one and a span of one step is not split. */
static int decimate_once(int n, const double *x, const double *y, double tolerance, bool *keep,
                         Span *stack) {
    int n_stack = 0, n_kept = n > 1 ? 2 : n;
    memset(keep, 0, (size_t)n * sizeof *keep);
    keep[0] = keep[n - 1] = true;
    stack[n_stack++] = (Span){0, n - 1};
    while (n_stack > 0) {
        const Span span = stack[--n_stack];
        const int middle = furthest(x, y, span, tolerance);
        if (middle < 0)
            continue;
        keep[middle] = true;
        n_kept++;
        stack[n_stack++] = (Span){span.from, middle};
        stack[n_stack++] = (Span){middle, span.to};
    }
    return n_kept;
}

double cz_decimate(int n, const double *x, const double *y, double tolerance, int most,
                   bool *keep) {
    if (n <= 0)
        return tolerance;
    Span *stack = malloc((size_t)(n + 1) * sizeof *stack);
    if (stack == NULL)
        return -1;
    while (decimate_once(n, x, y, tolerance, keep, stack) > most && most > 2)
        tolerance *= 2;
    free(stack);
    return tolerance;
}
