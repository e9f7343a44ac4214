/* Force over closure of an interface according to the input, when it is closed slowly. */
#ifndef CZ_SIMULATE_INPUT_CURVE_H
#define CZ_SIMULATE_INPUT_CURVE_H

#include "model/model.h"

/* Force over closure of an interface as the sum of its load paths, without rate, inertia, friction
 * and elastic parts: coupler (until it shears off), anti-climbers with the ends behind them, side
 * buffers. Writes n points from no closure to `longest` [m]: closure [m] and force [N]. Status:
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_input_curve(const CzModel *model, int interface, double longest, int n,
                                      double *closure, double *force, CzError *error);

#endif
