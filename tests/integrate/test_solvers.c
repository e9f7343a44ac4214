/* The adaptive solvers on problems with a known solution: Bathe's example of two degrees of
 * freedom, an oscillator, a ball that meets a floor, equations. */
#include "support/check.h"

#include <stdbool.h>

#include "integrate/integrator.h"

static const CzMethod methods[] = {CZ_METHOD_ERK, CZ_METHOD_ADAMS};

static CzSolver *solver_of(CzMethod method, CzOde *ode, const double *state, double longest) {
    CzError error = {0};
    CzSolver *solver = NULL;
    if (cz_solver_create(method, ode, 0.0, state, longest, &solver, &error) != CZ_OK)
        fail_msg("%s", error.message);
    return solver;
}

/* Integrates to a time; returns the state. */
static const double *go_to(CzSolver *solver, double time) {
    CzError error = {0};
    CzSolverStep step = {0};
    while (step.time < time)
        if (cz_solver_advance(solver, time, &step, &error) != CZ_OK)
            fail_msg("%s", error.message);
    assert_near(step.time, time, 0.0, 0.0);
    return step.state;
}

/* ---- M = diag(2, 1), K = [6 -2; -2 4], a force of 10 on the second, from rest ---- */

static bool bathe(CzOde *ode, double time, const double *y, double *rate) {
    (void)ode, (void)time;
    rate[0] = y[2];
    rate[1] = y[3];
    rate[2] = 0.5 * -(6.0 * y[0] - 2.0 * y[1]);
    rate[3] = 10.0 - (4.0 * y[1] - 2.0 * y[0]);
    return true;
}

/* Static solution (1, 3) less the modes of w^2 = 2 with (1, 1) and w^2 = 5 with (1, -2). */
static void exact(double t, double *u) {
    const double slow = cos(sqrt(2.0) * t), fast = cos(sqrt(5.0) * t);
    u[0] = 1.0 - 5.0 / 3.0 * slow + 2.0 / 3.0 * fast;
    u[1] = 3.0 - 5.0 / 3.0 * slow - 4.0 / 3.0 * fast;
}

/* Largest error at the twelve instants of the example. */
static double error_of(CzMethod method, double tolerance) {
    const double allowed[] = {tolerance, tolerance, tolerance, tolerance}, rest[4] = {0.0};
    CzOde ode = {.n_unknown = 4, .allowed = allowed, .rates = bathe};
    CzSolver *solver = solver_of(method, &ode, rest, 0.28);
    double worst = 0.0;
    for (int i = 1; i <= 12; i++) {
        const double *u = go_to(solver, 0.28 * i);
        double truth[2];
        exact(0.28 * i, truth);
        worst = fmax(worst, fmax(fabs(u[0] - truth[0]), fabs(u[1] - truth[1])));
    }
    cz_solver_free(solver);
    return worst;
}

/* Local errors of one tolerance per step, about a hundred steps, in the worst case all of one sign.
 */
static void the_example_is_solved_to_the_tolerance(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++)
        for (double tolerance = 1e-3; tolerance > 1e-9; tolerance *= 0.1)
            assert_near(error_of(methods[i], tolerance), 0.0, 0.0, 30.0 * tolerance);
}

static void the_error_falls_with_the_tolerance(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++)
        assert_true(error_of(methods[i], 1e-8) < 0.01 * error_of(methods[i], 1e-4));
}

/* ---- an oscillator of 1 rad/s beside a body that moves on freely ---- */

static bool oscillate(CzOde *ode, double time, const double *y, double *rate) {
    (void)ode, (void)time;
    rate[0] = y[1];
    rate[1] = -y[0];
    rate[2] = y[3];
    rate[3] = 0.0;
    return true;
}

/* Runge-Kutta of order 3 dissipates (w h)^4 / 12 of the energy in a step: with steps of at most
 * 0.01 this is 5.2e-4 after 6283 radians, and Adams dissipates less. A free body is not slowed
 * down. */
static void oscillations_keep_their_energy_and_free_bodies_their_speed(void **state) {
    (void)state;
    const double allowed[] = {1e-8, 1e-8, 1e-8, 1e-8}, start[] = {1.0, 0.0, 0.0, 7.0};
    for (int i = 0; i < 2; i++) {
        CzOde ode = {.n_unknown = 4, .allowed = allowed, .rates = oscillate};
        CzSolver *solver = solver_of(methods[i], &ode, start, 0.01);
        const double end = 2000.0 * 3.14159265358979323846;
        const double *y = go_to(solver, end);
        assert_near(y[0] * y[0] + y[1] * y[1], 1.0, 0.0, 5.3e-4);
        assert_near(y[3], 7.0, 1e-14, 0.0);
        assert_near(y[2], 7.0 * end, 1e-10, 0.0);
        cz_solver_free(solver);
    }
}

/* ---- a ball of 1 kg on a spring that breaks ---- */

typedef struct {
    CzOde ode;
    bool is_broken;
} Spring;

static bool pull(CzOde *ode, double time, const double *y, double *rate) {
    (void)time;
    rate[0] = y[1];
    rate[1] = ((Spring *)ode)->is_broken ? 0.0 : -y[0];
    return true;
}

/* Breaks at a stretch of 0.5; the function is scaled to the order of 1. */
static void stretch(CzOde *ode, double time, const double *y, double *value) {
    (void)time;
    value[0] = ((Spring *)ode)->is_broken ? 1.0 : y[0] / 0.5 - 1.0;
}

/* From the middle at 1 m/s: 0.5 = sin t at t = pi / 6, where the speed is sqrt(3) / 2. */
static void a_force_that_drops_does_so_at_its_time(void **state) {
    (void)state;
    const double allowed[] = {1e-9, 1e-9}, start[] = {0.0, 1.0};
    for (int i = 0; i < 2; i++) {
        Spring spring = {
            .ode = {
                .n_unknown = 2, .allowed = allowed, .rates = pull, .n_drop = 1, .drops = stretch}};
        CzSolver *solver = solver_of(methods[i], &spring.ode, start, 0.05);
        CzError error = {0};
        CzSolverStep step = {0};
        int n_drop = 0;
        while (step.time < 1.0) {
            assert_int_equal(cz_solver_advance(solver, 1.0, &step, &error), CZ_OK);
            if (!step.at_drop)
                continue;
            n_drop++;
            assert_near(step.time, 3.14159265358979323846 / 6.0, 0.0, 1e-7);
            assert_near(step.state[0], 0.5, 0.0, 1e-7);
            spring.is_broken = true;
            assert_int_equal(cz_solver_restart(solver, &error), CZ_OK);
        }
        assert_int_equal(n_drop, 1);
        assert_near(step.state[1], sqrt(0.75), 0.0, 1e-7);
        cz_solver_free(solver);
    }
}

/* ---- failures ---- */

static bool refuse(CzOde *ode, double time, const double *y, double *rate) {
    (void)ode, (void)y;
    rate[0] = 1.0;
    return time < 0.5;
}

static void a_solver_that_fails_reports_time_and_reason(void **state) {
    (void)state;
    const double allowed[] = {1e-6}, start[] = {0.0};
    for (int i = 0; i < 2; i++) {
        CzOde ode = {.n_unknown = 1, .allowed = allowed, .rates = refuse};
        CzSolver *solver = solver_of(methods[i], &ode, start, 0.1);
        CzError error = {0};
        CzSolverStep step = {0};
        CzStatus status = CZ_OK;
        while (status == CZ_OK && step.time < 1.0)
            status = cz_solver_advance(solver, 1.0, &step, &error);
        assert_int_equal(status, CZ_STATUS_RUN_FAILED);
        assert_non_null(strstr(error.message, "failed at"));
        assert_true(step.time > 0.1 && step.time <= 0.5);
        cz_solver_free(solver);
    }
}

/* ---- equations ---- */

/* x^2 + y^2 = 2 and x = y^3, with a breakpoint where x is negative: (1, 1). */
static void circle_and_cube(CzEquations *equations, const double *q, double *residual) {
    (void)equations;
    residual[0] = q[0] * q[0] + q[1] * q[1] - 2.0;
    residual[1] = (q[0] > 0.0 ? q[0] : 3.0 * q[0]) - q[1] * q[1] * q[1];
}

static void equations_are_solved_to_their_tolerance(void **state) {
    (void)state;
    const double ones[] = {1.0, 1.0};
    CzEquations equations = {2, ones, ones, circle_and_cube};
    double q[] = {-0.2, 2.0};
    CzError error = {0};
    if (cz_equations_solve(&equations, 1e-12, q, &error) != CZ_OK)
        fail_msg("%s", error.message);
    assert_near(q[0], 1.0, 0.0, ROUNDING_OF_A_SUM);
    assert_near(q[1], 1.0, 0.0, ROUNDING_OF_A_SUM);
}

static void never_zero(CzEquations *equations, const double *q, double *residual) {
    (void)equations;
    residual[0] = 1.0 + q[0] * q[0];
}

static void equations_without_a_solution_are_a_failure(void **state) {
    (void)state;
    const double one[] = {1.0};
    CzEquations equations = {1, one, one, never_zero};
    double q[] = {0.3};
    CzError error = {0};
    assert_int_equal(cz_equations_solve(&equations, 1e-12, q, &error), CZ_STATUS_RUN_FAILED);
    assert_non_null(strstr(error.message, "no equilibrium"));
}

static void the_library_returns_its_version(void **state) {
    (void)state;
    char text[32] = "";
    int major = 0, minor = 0;
    cz_solver_version(text, sizeof text);
    assert_int_equal(sscanf(text, "%d.%d", &major, &minor), 2);
    assert_true(major > 6 || (major == 6 && minor >= 4));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_example_is_solved_to_the_tolerance),
        cmocka_unit_test(the_error_falls_with_the_tolerance),
        cmocka_unit_test(oscillations_keep_their_energy_and_free_bodies_their_speed),
        cmocka_unit_test(a_force_that_drops_does_so_at_its_time),
        cmocka_unit_test(a_solver_that_fails_reports_time_and_reason),
        cmocka_unit_test(equations_are_solved_to_their_tolerance),
        cmocka_unit_test(equations_without_a_solution_are_a_failure),
        cmocka_unit_test(the_library_returns_its_version),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
