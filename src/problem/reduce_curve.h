/* Fewer points for a measured curve.
 *
 * The point whose removal changes the curve least (smallest area of the triangle with its
 * neighbours) is removed first. End points and the highest point stay. The other kept points are
 * scaled together, so that the area under the curve, the energy, is the same.
 */
#ifndef CZ_PROBLEM_REDUCE_CURVE_H
#define CZ_PROBLEM_REDUCE_CURVE_H

#include "base/arena.h"

typedef struct CzCurveChange {
    double area;               /* under the curve, before and after [SI of x times y] */
    double largest_difference; /* of y at the points of the full curve [SI] */
} CzCurveChange;

/* Reduces a curve with rising x to at most n_most points, at least 3. x, y (*n_point) are changed
 * in place; without need nothing changes. The time grows as n log n. False without memory. */
bool cz_reduce_curve(CzArena *arena, double *x, double *y, int *n_point, int n_most,
                     CzCurveChange *change);

#endif
