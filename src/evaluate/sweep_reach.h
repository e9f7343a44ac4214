/* Scenarios that the values of a sweep do not reach. */
#ifndef CZ_EVALUATE_SWEEP_REACH_H
#define CZ_EVALUATE_SWEEP_REACH_H

#include "crushzone/sweep.h"

/* Finds the scenarios, or those of one name or family (NULL: all), that set a varied value
 * themselves. Status: CZ_OK, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_sweep_find_unreached(CzSweep *sweep, const char *scenario,
                                               CzError *error);

#endif
