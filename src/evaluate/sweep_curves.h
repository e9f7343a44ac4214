/* Histories of the points of a sweep, for figures with all points in one. */
#ifndef CZ_EVALUATE_SWEEP_CURVES_H
#define CZ_EVALUATE_SWEEP_CURVES_H

#include "crushzone/sweep.h"

/* Reads the problem with the values of a point; `data` is passed on. */
typedef CzStatus CzPointReader(const void *data, const CzSweepPoint *point, CzProblem **problem,
                               CzError *error);

/* Runs completed points once more in one scenario, on threads of this process, and keeps their
 * histories. Statuses: CZ_OK, also after an interruption, then without curves; CZ_STATUS_NO_MEMORY.
 */
CZ_MUST_CHECK CzStatus cz_sweep_record(CzSweep *sweep, const CzSweepOptions *options,
                                       CzPointReader *read, const void *data, CzError *error);
void cz_sweep_free_curves(CzSweep *sweep);

#endif
