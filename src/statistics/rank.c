/* Ranks and their correlation. */
#include "statistics/rank.h"

#include "statistics/quantile.h"

#include <math.h>
#include <stdlib.h>

typedef struct Numbered {
    double value;
    int number;
} Numbered;

static int compare(const void *a, const void *b) {
    const Numbered *x = a, *y = b;
    return (x->value > y->value) - (x->value < y->value);
}

bool cz_rank(int n, const double *value, double *rank) {
    Numbered *sorted = malloc(((size_t)n + 1) * sizeof *sorted);
    if (sorted == NULL)
        return false;
    for (int i = 0; i < n; i++)
        sorted[i] = (Numbered){value[i], i};
    qsort(sorted, (size_t)n, sizeof *sorted, compare);
    for (int first = 0, next; first < n; first = next) {
        for (next = first + 1; next < n && sorted[next].value <= sorted[first].value;)
            next++;
        for (int i = first; i < next; i++)
            rank[sorted[i].number] = (first + 1 + next) / 2.0;
    }
    free(sorted);
    return true;
}

double cz_rank_correlation(int n, const double *x_rank, const double *y_rank) {
    const double x_mean = cz_mean_of(n, x_rank), y_mean = cz_mean_of(n, y_rank);
    double xx = 0, yy = 0, xy = 0;
    for (int i = 0; i < n; i++) {
        const double x = x_rank[i] - x_mean, y = y_rank[i] - y_mean;
        xx += x * x;
        yy += y * y;
        xy += x * y;
    }
    if (!(xx > 0) || !(yy > 0))
        return NAN;
    return fmin(fmax(xy / sqrt(xx * yy), -1), 1);
}
