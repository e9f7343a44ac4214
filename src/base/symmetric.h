/* Symmetric matrices of moderate size, stored whole by rows: eigenvalues and triangular factors.
 * The bytes of every result are the same on every machine. */
#ifndef CZ_BASE_SYMMETRIC_H
#define CZ_BASE_SYMMETRIC_H

#include <stdbool.h>

/* Jacobi's rotations: leaves the eigenvalues on the diagonal of a (n x n), in no particular order,
 * and their eigenvectors, of length 1, in the columns of vectors (n x n). A matrix of unconnected
 * blocks keeps them. */
void cz_symmetric_diagonalise(int n, double *a, double *vectors);

/* Replaces the lower triangle of a positive definite a (n x n) by L, a = L L^T. Returns false when
 * it is not positive definite. */
bool cz_symmetric_factor(int n, double *a);

/* Solves L x = b and L^T x = b in place for the lower triangle of `factor`; the components of b are
 * `stride` apart. */
void cz_lower_solve(int n, const double *factor, double *b, int stride);
void cz_upper_solve(int n, const double *factor, double *b, int stride);

#endif
