/* The evaluator as a function of the numbers alone, and the search over them.
 *
 * Parts have no order, so algorithms do not vary choices: each combination of choices is a search
 * of its own over the numbers.
 */
#ifndef CZ_OPTIMISE_SUBSPACE_H
#define CZ_OPTIMISE_SUBSPACE_H

#include "base/arena.h"
#include "optimise/search.h"

typedef struct CzSubspace {
    CzEvaluator *evaluator;
    int n_all;           /* variables of the problem */
    int *number;         /* those that are no choice and can vary (function.n_variable) */
    int *constraint;     /* those of the evaluator that the search has: all but the named rules of
                            files, which one constraint covers (function.n_constraint) */
    double *made;        /* a design with the choices made and what is fixed (n_all) */
    CzFunction function; /* of the numbers alone */
    CzSearch search;     /* over them, begun by the user of the subspace */
} CzSubspace;

/* Fills a subspace; `start` NULL begins at the file's own values, else at these numbers
 * (n_variable). Memory comes from the arena, also that of every evaluation's scratch. False without
 * memory. */
bool cz_subspace_create(CzEvaluator *evaluator, int combination, const double *start,
                        CzArena *arena, CzSubspace *subspace);

/* The whole design with these numbers; x is (n_all). */
void cz_subspace_expand(const CzSubspace *subspace, const double *number, double *x);

#endif
