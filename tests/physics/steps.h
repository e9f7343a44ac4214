/* Dependence of results on the time step, energy balance of shipped problems, and differences of
 * other solvers: as rows. */
#ifndef CZ_TESTS_PHYSICS_STEPS_H
#define CZ_TESTS_PHYSICS_STEPS_H

#include "physics/collision.h"
#include "physics/rows.h"

/* Runs a scenario with a step of its own [s]; 0: that of the model. */
Collision collide_with(const char *file, int scenario, double step);

void rows_of_elastic_order(Rows *rows);
void rows_of_elastic_exchange(Rows *rows);
void rows_of_step_convergence(Rows *rows);
void rows_of_balances(Rows *rows);
void rows_of_balances_on_rigid_rails(Rows *rows); /* those that require them */

/* Largest relative differences of the judged results of two runs. Small values are relative to a
 * floor (10 kN, 1 mm, 10 mm of an element's stroke, a `share` of all dissipated energy, 1 mm/s2,
 * 0.1 mrad). */
typedef struct Difference {
    double force, stroke, energy, motion;
} Difference;
Difference difference_of(const CzRunSummary *a, const CzRunSummary *b, double share);

/* The production run against the adaptive solvers: short trains, and six and six cars. */
void rows_of_solvers_for_short_trains(Rows *rows);
void rows_of_solvers_for_the_metro(Rows *rows);

/* A rigid car onto an identical one, and the car at half the speed against a wall. */
void rows_of_equivalence(Rows *rows);

#endif
