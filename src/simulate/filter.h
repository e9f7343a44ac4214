/* Channel frequency class filters, for accelerations in figures. */
#ifndef CZ_SIMULATE_FILTER_H
#define CZ_SIMULATE_FILTER_H

#include "crushzone/status.h"

/* Filters n equally spaced samples as SAE J211-1 describes: a Butterworth low-pass of two poles,
 * run forwards and backwards, so that nothing is shifted in time. `class_hz` is 60 or 180 (CFC),
 * `step` the time between samples [s]. Requires at least ten samples per cycle of the class; the
 * caller checks cz_filter_fits first. `out` may be `in`. Status: CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_filter_cfc(double class_hz, double step, int n, const double *in,
                                     double *out);

/* Whether samples are dense enough for a class. */
int cz_filter_fits(double class_hz, double step);

#endif
