/* The draws of a sample: which random numbers `uncertainty:` needs, and their values. */
#ifndef CZ_EVALUATE_DRAWS_H
#define CZ_EVALUATE_DRAWS_H

#include "base/arena.h"
#include "crushzone/sample.h"
#include "problem/problem.h"

/* Lists the draws of a problem's parameters, in the order of the file: one for all places of a
 * parameter, for each part, or for each place; `scenario` is one that is sampled. Memory comes from
 * the arena. Statuses: CZ_OK, CZ_STATUS_INPUT with the place in the file, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_draws_list(const CzProblem *problem, int scenario, CzArena *arena,
                                     int *n_draw, CzDraw **draw, CzError *error);

/* A span of the envelope as a draw. Statuses as above. */
CZ_MUST_CHECK CzStatus cz_draw_of_span(const CzProblem *problem, int scenario, const CzSpan *span,
                                       CzDraw *draw, CzError *error);

/* Fills the values of all draws in n samples; value is (n x n_draw). Statuses: CZ_OK,
 * CZ_STATUS_INPUT for more draws than the method has, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_draws_fill(const CzProblem *problem, long seed, int n, int n_draw,
                                     const CzDraw *draw, double *value, CzError *error);

#endif
