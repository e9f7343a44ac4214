/* A stand-in for the simulator: two rigid cars whose collision has a closed form.
 *
 * Half of the energy m v^2 / 4 goes into each side: first into the coupler's tube, which shears off
 * when it is used up or too strong, then into the anti-climber, then into the end. It replaces
 * model and simulator in a test program, so that evaluator and optimiser are tested without them.
 */
#ifndef CZ_TESTS_STAND_IN_H
#define CZ_TESTS_STAND_IN_H

#include "crushzone/simulate.h"
#include "problem/problem.h"

/* What a test may change. Reset it before use. */
typedef struct StandIn {
    double failing_above;    /* tube force from which a run fails [N]; infinite for never */
    double incomplete_above; /* likewise for a run that does not end [N] */
    double late_below; /* anti-climber force below which only a full run shows a closing speed of
                          1 m/s at the end [N]; 0 for never */
    int batch_width;
    long n_run; /* runs made since the reset */
    int rattle; /* energy scatter of a few per mille, a function of the design */
} StandIn;
extern StandIn stand_in;
void stand_in_reset(void);

/* The problem that it simulates: parts `head`, `tube`, `shear-off`, `anti-climber`; trains A and B;
 * scenarios 25, 20, 15, 8 km/h and an overload case. `more` is put at the end, such as "optimise:
 * ...". Asserts that it can be read. */
CzProblem *stand_in_problem(const char *more);

/* The same with settings and without asserting; the status is returned. */
CzStatus stand_in_read(const char *more, int n_set, const char *const *set, CzProblem **problem,
                       CzError *error);

#endif
