/* A small problem for evaluator and optimiser. */
#ifndef CZ_TESTS_SMALL_PROBLEM_H
#define CZ_TESTS_SMALL_PROBLEM_H

#include "problem/problem.h"

/* Two rigid cars with parts `head`, `tube`, `shear-off`, `anti-climber`; trains A and B;
 * scenarios 25, 20, 15, 8 km/h and an overload case. `more` is put at the end, such as "optimise:
 * ...". Asserts that it can be read. */
CzProblem *small_problem(const char *more);

/* The same with settings and without asserting; the status is returned. */
CzStatus small_problem_read(const char *more, int n_set, const char *const *set,
                            CzProblem **problem, CzError *error);

/* A problem of its own text with `more` at the end, paths relative to the project's root. Asserts
 * that it can be read. */
CzProblem *problem_of_text(const char *text, const char *more);

#endif
