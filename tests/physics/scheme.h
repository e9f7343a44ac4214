/* The two-step scheme on Bathe's example of two degrees of freedom (M = diag(2, 1), K = [6 -2; -2
 * 4], a force of 10 on the second, from rest), and its limit of stability. */
#ifndef CZ_TESTS_PHYSICS_SCHEME_H
#define CZ_TESTS_PHYSICS_SCHEME_H

#include "physics/rows.h"

/* Exact: static solution (1, 3) less its two modes, w^2 = 2 with (1, 1) and w^2 = 5 with (1, -2).
 */
void exact_answer(double t, double *u);
void rows_of_published_answer(Rows *rows);

/* Largest error at the twelve instants of the example, with so many steps from one to the next. */
double largest_error(int per_instant);
void rows_of_known_errors(Rows *rows);
void rows_of_order(Rows *rows);

/* A wheelset onto a rail, both without springs, by the law of wheel and rail. */
void rows_of_hertz_impact(Rows *rows);

/* Whether an undamped oscillator of 1 rad/s stays bounded at this step. */
bool is_stable(double step);
void rows_of_stability(Rows *rows);

#endif
