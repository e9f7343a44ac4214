/* A linear program in a box, in which violations of constraints have a price:
 *
 *   minimise  g . d + sum_k w_k max(0, c_k + a_k . d),   lo <= d <= hi
 *
 * It has a solution for any constraints, and with prices above the multipliers the solution
 * satisfies all that can be satisfied.
 */
#ifndef CZ_OPTIMISE_LINEAR_PROGRAM_H
#define CZ_OPTIMISE_LINEAR_PROGRAM_H

#include <stdbool.h>

typedef struct CzLinearProgram {
    int n, m;              /* variables, constraints */
    const double *g;       /* (n) */
    const double *c;       /* (m) */
    const double *a;       /* (m x n) */
    const double *w;       /* price of a violation, 0 or more (m) */
    const double *lo, *hi; /* (n) */
} CzLinearProgram;

/* Solves it by the simplex method. d (n) is the first point, within the box, and gets the solution.
 * False without memory. */
bool cz_linear_program(const CzLinearProgram *program, double *d);

#endif
