/* Decimation of a curve without a visible change, by the algorithm of Douglas and Peucker. */
#ifndef CZ_REPORT_DECIMATION_H
#define CZ_REPORT_DECIMATION_H

#include <stdbool.h>

/* Marks in keep[n] the points of the path (x, y) that are drawn, the first and the last always. No
 * omitted point is further than the tolerance from the line that replaces it, so peaks stay and
 * loops keep their path. Where more than `most` points would stay the tolerance is doubled.
 * Coordinates are finite. Returns the tolerance that was used; negative without memory. */
double cz_decimate(int n, const double *x, const double *y, double tolerance, int most, bool *keep);

#endif
