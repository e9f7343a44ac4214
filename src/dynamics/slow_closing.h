/* An interface that is closed slowly. */
#ifndef CZ_DYNAMICS_SLOW_CLOSING_H
#define CZ_DYNAMICS_SLOW_CLOSING_H

#include "model/lanes.h"

/* Force over closure of an interface as the sum of its load paths, without rate, inertia, friction
 * and elastic parts: coupler (until it shears off), anti-climbers with the ends behind them, side
 * buffers. `lanes` are those of one design. Writes n points from no closure to `longest` [m]:
 * closure [m] and force [N]. */
void cz_slow_closing(const CzLanes *lanes, int interface, double longest, int n, double *closure,
                     double *force);

#endif
