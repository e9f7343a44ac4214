/* All searches of one optimisation: one for each combination of choices, and a further one from the
 * best of them. Without choices it is a single search.
 */
#ifndef CZ_OPTIMISE_COMBINATIONS_H
#define CZ_OPTIMISE_COMBINATIONS_H

#include "optimise/subspace.h"

typedef struct CzCombinations {
    CzArena arena;
    CzReplay replay;      /* of all searches */
    int n;                /* searches that were begun */
    CzSubspace *subspace; /* with their searches (n) */
    int chosen;           /* search with the best design */
    long n_reserved;      /* evaluations for the case that the best design is not verified */
} CzCombinations;

/* Runs all searches; `options` has no default values left to fill in. Statuses: CZ_OK, also when
 * stopped; CZ_STATUS_RUN_FAILED when designs of every combination failed, CZ_STATUS_INPUT,
 * CZ_STATUS_NO_MEMORY. The caller frees the combinations in any case. */
CZ_MUST_CHECK CzStatus cz_combinations(CzEvaluator *evaluator, const CzOptimiseOptions *options,
                                       CzCombinations *combinations, CzError *error);

enum {
    CZ_MAX_FURTHER = 1,
    CZ_FEWEST_EVALUATIONS = 12 /* for a further search (ours) */
};

/* Searches once more with the choices of a design (n_variable), from it, with at most this many
 * evaluations; no more than CZ_MAX_FURTHER times. `required` is borrowed until the end. Statuses
 * as above. */
CZ_MUST_CHECK CzStatus cz_combinations_go_on(CzCombinations *combinations, const double *x,
                                             long evaluations, const CzRequired *required,
                                             const CzOptimiseOptions *options, CzError *error);

void cz_combinations_free(CzCombinations *combinations);

/* Number of designs that all searches evaluated, and the designs in order: trial (n), x (n x
 * n_variable). */
long cz_combinations_n_record(const CzCombinations *combinations);
void cz_combinations_history(const CzCombinations *combinations, int n_variable, CzTrial *trial,
                             double *x);

/* The record with the result of a search: the best one on the catalogue increments when there are
 * any. -1 when the search evaluated no design that is valid in a file and has no failed run. */
long cz_combinations_record(const CzSearch *search);

#endif
