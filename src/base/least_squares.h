/* Linear least squares. The bytes of every result are the same on every machine. */
#ifndef CZ_BASE_LEAST_SQUARES_H
#define CZ_BASE_LEAST_SQUARES_H

#include <stdbool.h>

/* Finds x of the smallest |A x - b| for each of n_right right-hand sides by Householder's
 * reflections. A (m x n, m >= n) and b (m x n_right) are stored column after column; A is
 * overwritten, and the first n places of each column of b take its x. Returns false when a column
 * of A is zero or depends on those before it. With m = n it solves A x = b. */
bool cz_least_squares(int m, int n, double *a, int n_right, double *b);

#endif
