/* Further parameter sets of a fit, from the history of its search. */
#ifndef CZ_OPTIMISE_ALTERNATIVES_H
#define CZ_OPTIMISE_ALTERNATIVES_H

#include "optimise/subspace.h"

/* Adds to the outcome the best sets that fit about as well as record `best` and lie apart from it
 * and from one another. Statuses: CZ_OK, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_alternatives_find(const CzSubspace *subspace, long best,
                                            CzOutcome *outcome, CzError *error);

#endif
