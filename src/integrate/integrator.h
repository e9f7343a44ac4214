/* Solvers that are independent of our own scheme: adaptive integration of y' = f(t, y), and roots
 * of F(q) = 0.
 *
 * They see flat arrays and no train. A step is taken on trial; once it is accepted the caller may
 * commit its memory, so f must be continuous there. One solver belongs to one thread.
 */
#ifndef CZ_INTEGRATE_INTEGRATOR_H
#define CZ_INTEGRATE_INTEGRATOR_H

#include <stdbool.h>
#include <stddef.h>

#include "crushzone/status.h"

typedef enum CzMethod {
    CZ_METHOD_ERK,  /* explicit Runge-Kutta, Bogacki and Shampine 3(2) */
    CZ_METHOD_ADAMS /* Adams-Moulton of variable order, solved by fixed-point iteration */
} CzMethod;

/* A system of differential equations. The caller embeds it as the first member of its own record
 * and finds that one back in the functions. */
typedef struct CzOde CzOde;
struct CzOde {
    size_t n_unknown;
    const double *allowed; /* local error allowed in each unknown, in its unit (n_unknown) */

    /* Fills the rates (n_unknown) at a trial state; false when there are none: the solver stops. */
    bool (*rates)(CzOde *ode, double time, const double *state, double *rate);

    /* Functions that cross zero where a force drops, scaled to the order of 1 (n_drop). */
    int n_drop;
    void (*drops)(CzOde *ode, double time, const double *state, double *value);
};

typedef struct CzSolver CzSolver;

/* A solver at a state (n_unknown). Steps are no longer than `longest` [s]; the first is a
 * thousandth of that (ours). `ode` is borrowed. Statuses: CZ_OK, CZ_STATUS_NO_MEMORY,
 * CZ_STATUS_RUN_FAILED. */
CZ_MUST_CHECK CzStatus cz_solver_create(CzMethod method, CzOde *ode, double time,
                                        const double *state, double longest, CzSolver **solver,
                                        CzError *error);
void cz_solver_free(CzSolver *solver);

/* The end of an accepted step. */
typedef struct CzSolverStep {
    double time;
    const double *state; /* borrowed from the solver until the next step (n_unknown) */
    bool at_drop;        /* the step ends where a force drops: restart there */
} CzSolverStep;

/* Takes one step that does not go beyond `until`. Statuses: CZ_OK, CZ_STATUS_RUN_FAILED. */
CZ_MUST_CHECK CzStatus cz_solver_advance(CzSolver *solver, double until, CzSolverStep *step,
                                         CzError *error);

/* Restarts with short steps and without history from the end of the last step. */
CZ_MUST_CHECK CzStatus cz_solver_restart(CzSolver *solver, CzError *error);

/* A system of equations, embedded as CzOde is. */
typedef struct CzEquations CzEquations;
struct CzEquations {
    size_t n_unknown;
    const double *unknown_scale;  /* size of a change that matters (n_unknown) */
    const double *residual_scale; /* size of a residual that matters (n_unknown) */
    void (*residuals)(CzEquations *equations, const double *unknown, double *residual);
};

/* Solves F(q) = 0 by Newton's method with a line search; `unknown` holds the first guess and
 * receives the solution, in which no residual exceeds `tolerance` of its scale. Statuses: CZ_OK,
 * CZ_STATUS_NO_MEMORY, CZ_STATUS_RUN_FAILED. */
CZ_MUST_CHECK CzStatus cz_equations_solve(CzEquations *equations, double tolerance, double *unknown,
                                          CzError *error);

/* Version of the SUNDIALS libraries in use, such as "6.4.1". Writes at most n bytes. */
void cz_solver_version(char *text, size_t n);

#endif
