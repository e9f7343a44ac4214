/* How a search is led: the usual strategy, one algorithm by name, and the way to catalogue
 * increments.
 */
#ifndef CZ_OPTIMISE_STRATEGY_H
#define CZ_OPTIMISE_STRATEGY_H

#include "optimise/surface.h"

/* Fits parameters: screen, then Gauss and Newton's method from the best points that lie apart, then
 * that, BOBYQA, Sbplx and COBYLA by turns from the best with smaller and smaller steps, then snap.
 * Statuses as below. */
CZ_MUST_CHECK CzStatus cz_strategy_fit(CzSearch *search, unsigned long seed, CzError *error);

/* Screen, descend, polish, snap. Statuses of the NLopt adapter; how the search ended is in it.
 */
CZ_MUST_CHECK CzStatus cz_strategy_auto(CzSearch *search, unsigned long seed, CzError *error);

/* One NLopt algorithm from the start, begun anew from the best design while that gains, then snap.
 */
CZ_MUST_CHECK CzStatus cz_strategy_named(CzSearch *search, const char *algorithm,
                                         unsigned long seed, CzError *error);

/* Moves from the best design to the best one on the catalogue increments, with at most this many
 * evaluations, until nothing gains. The surface is begun anew there when
 * that can be afforded.
 */
void cz_snap(CzSurface *surface, long evaluations);

/* Evaluations that a strategy sets aside for the catalogue increments. */
long cz_snap_reserve(const CzSearch *search);

/* Point of a sequence that fills the unit cube evenly (Roberts' additive recurrence), shifted by
 * the seed. */
void cz_sample_point(unsigned long seed, long index, int n, double *u);

#endif
