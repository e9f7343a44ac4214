/* Strategies of a search: the default one, that of a fit, single algorithms by name; catalogue
 * increments.
 */
#ifndef CZ_OPTIMISE_STRATEGY_H
#define CZ_OPTIMISE_STRATEGY_H

#include "optimise/surface.h"

/* Searches with one NLopt algorithm, from the start and again from the best design as long as that
 * is an improvement; NULL selects the default strategy, or that of a fit (strategy.c). Finally the
 * best design is moved to the catalogue increments. Statuses of the NLopt adapter; the search
 * contains its own end status.
 */
CZ_MUST_CHECK CzStatus cz_strategy(CzSearch *search, const char *algorithm, unsigned long seed,
                                   CzError *error);

/* Moves from the best design to the best one on the catalogue increments, with at most this many
 * evaluations, until there is no improvement. The surface is moved to that base when there are
 * evaluations for its slopes. */
void cz_snap(CzSurface *surface, long evaluations, bool is_last);

/* Evaluations that a strategy reserves for the catalogue increments. */
long cz_snap_reserve(const CzSearch *search);

/* Point of a sequence that fills the unit cube evenly (Roberts' additive recurrence), shifted by
 * the seed. */
void cz_sample_point(unsigned long seed, long index, int n, double *u);

#endif
