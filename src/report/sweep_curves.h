/* Curves of all points of a sweep over one another. */
#ifndef CZ_REPORT_SWEEP_CURVES_H
#define CZ_REPORT_SWEEP_CURVES_H

#include "crushzone/sweep.h"
#include "report/markup.h"

/* Writes a section of a page with the figures; nothing when the sweep has no curves. */
void cz_sweep_write_curves(const CzSweep *sweep, CzMarkup *markup);

#endif
