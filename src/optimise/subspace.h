/* The evaluator as a function of the numbers alone, and the search over them.
 *
 * Parts have no order, so algorithms do not vary choices: each combination of choices has its own
 * search over the numbers.
 */
#ifndef CZ_OPTIMISE_SUBSPACE_H
#define CZ_OPTIMISE_SUBSPACE_H

#include "base/arena.h"
#include "optimise/replay.h"

typedef struct CzSubspace {
    CzEvaluator *evaluator;
    CzReplay *replay; /* evaluates the designs, shared by all subspaces */
    int n_all;        /* variables of the problem */
    int *number;      /* variables that are not choices and can vary (function.n_variable) */
    int *constraint;  /* constraints of the evaluator in the search: all except the named rules of
                         files, which one constraint covers (function.n_constraint) */
    double *made;     /* a design with the choices and fixed values set (n_all) */
    CzFunction function; /* of the numbers alone */
    CzSearch search;     /* over them, begun by the caller */
} CzSubspace;

/* Fills a subspace; `start` NULL begins at the file's own values, else at the numbers of this whole
 * design (n_all). Memory comes from the arena, also the scratch memory of evaluations. False
 * without memory. */
bool cz_subspace_create(CzReplay *replay, int combination, const double *start, CzArena *arena,
                        CzSubspace *subspace);

/* The whole design with these numbers; x is (n_all). */
void cz_subspace_expand(const CzSubspace *subspace, const double *number, double *x);

#endif
