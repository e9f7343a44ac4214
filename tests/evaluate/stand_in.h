/* A stand-in for the simulator: two rigid cars whose collision has a closed form.
 *
 * Half of the energy m v^2 / 4 goes into each side: first into the coupler's tube, which shears off
 * when it is exhausted or too strong, then into the anti-climber, then into the end. It replaces
 * model and simulator in a test program, so that evaluator and optimiser are tested without them.
 */
#ifndef CZ_TESTS_STAND_IN_H
#define CZ_TESTS_STAND_IN_H

#include "crushzone/simulate.h"

/* Settings of a test. Reset them before use. */
typedef struct StandIn {
    double failing_above;    /* tube force from which a run fails [N]; infinite for never */
    double incomplete_above; /* the same for a run that does not end [N] */
    double late_below; /* anti-climber force below which only a full run shows a closing speed of
                          1 m/s at the end [N]; 0 for never */
    double unsteady_below; /* anti-climber force below which a halved time step adds 5 % to the
                              energy [N]; 0 for never */
    double step_energy;    /* share of the energy that a halved time step adds */
    int batch_width;
    long n_run;  /* runs made since the reset */
    int scatter; /* energy scatter of a few per mille, a function of the design */
} StandIn;
extern StandIn stand_in;
void stand_in_reset(void);

#endif
