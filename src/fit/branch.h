/* One branch of a measured curve: straight lines between points whose stroke never falls.
 *
 * Points of equal stroke are a jump. Integrals over any part are differences of sums that are
 * computed once, so the cost of a least-squares fit does not depend on the number of points.
 */
#ifndef CZ_FIT_BRANCH_H
#define CZ_FIT_BRANCH_H

#include "base/arena.h"

typedef struct CzBranch {
    int n;
    double *x, *f;   /* stroke [m], force [N] (n) */
    double *area;    /* integral of f up to each point [J] (n) */
    double *moment;  /* integral of f x [J m] (n) */
    double *squares; /* integral of f^2 [N2 m] (n) */
} CzBranch;

typedef struct CzBranchSums {
    double area, moment, squares;
} CzBranchSums;

/* Begins a branch with room for n points; false without memory. */
bool cz_branch_begin(CzArena *arena, int n, CzBranch *branch);

static inline void cz_branch_add(CzBranch *branch, double x, double f) {
    branch->x[branch->n] = x;
    branch->f[branch->n++] = f;
}

/* Completes a branch; false without memory. Strokes that fall, by noise, are moved as little as
 * possible in the sense of least squares until they do not. */
bool cz_branch_end(CzArena *arena, CzBranch *branch);

/* The part from `from` to `to` with strokes counted from `from`. */
bool cz_branch_cut(CzArena *arena, const CzBranch *branch, double from, double to, CzBranch *part);

/* Integrals from the first point to a stroke. */
CzBranchSums cz_branch_sums(const CzBranch *branch, double x);

/* Force at a stroke; at a jump the one after it. */
double cz_branch_force(const CzBranch *branch, double x);

static inline double cz_branch_last(const CzBranch *branch) {
    return branch->x[branch->n - 1];
}

/* Mean force between two strokes. */
double cz_branch_mean(const CzBranch *branch, double from, double to);

#endif
