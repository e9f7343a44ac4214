/* The two-step scheme on Bathe's example of two degrees of freedom (M = diag(2, 1), K = [6 -2; -2
 * 4], a force of 10 on the second, from rest), and its limit of stability. */
#include "support/check.h"

#include <stdbool.h>

#include "integrate/two_step.h"

/* Exact: static answer (1, 3) less its two modes, w^2 = 2 with (1, 1) and w^2 = 5 with (1, -2). */
static void exact(double t, double *u) {
    const double slow = cos(sqrt(2.0) * t), fast = cos(sqrt(5.0) * t);
    u[0] = 1.0 - 5.0 / 3.0 * slow + 2.0 / 3.0 * fast;
    u[1] = 3.0 - 5.0 / 3.0 * slow - 4.0 / 3.0 * fast;
}

static void accelerate(const double *u, double *a) {
    a[0] = 0.5 * -(6.0 * u[0] - 2.0 * u[1]);
    a[1] = 10.0 - (4.0 * u[1] - 2.0 * u[0]);
}

/* Largest error at the twelve instants of the example. */
static double largest_error(int per_instant) {
    const double step = 0.28 / per_instant;
    double u[2] = {0}, v[2] = {0}, a[2], last[2] = {0}, worst = 0.0;
    accelerate(u, a);
    for (int i = 1; i <= 12 * per_instant; i++) {
        cz_two_step_advance(2, step, i == 1, u, v, a, last);
        accelerate(u, a);
        if (i % per_instant != 0)
            continue;
        double truth[2];
        exact(i * step, truth);
        worst = fmax(worst, fmax(fabs(u[0] - truth[0]), fabs(u[1] - truth[1])));
    }
    return worst;
}

static void the_exact_answer_is_the_published_one(void **state) {
    (void)state;
    static const double published[][2] = {
        {.00251, .38188},   {.03807, 1.41160},  {.17559, 2.78095},  {.48603, 4.09356},
        {.99635, 4.99623},  {1.65696, 5.29051}, {2.33820, 4.98571}, {2.86081, 4.27665},
        {3.05171, 3.45748}, {2.80572, 2.80622}, {2.13058, 2.48433}, {1.15723, 2.48876}};
    for (int i = 0; i < 12; i++) {
        double u[2];
        exact(0.28 * (i + 1), u);
        assert_near(u[0], published[i][0], 0.0, 6e-6);
        assert_near(u[1], published[i][1], 0.0, 6e-6);
    }
}

static void the_errors_are_the_known_ones(void **state) {
    (void)state;
    assert_near(largest_error(1), 0.1349, 1e-3, 0.0);
    assert_near(largest_error(10), 1.289e-3, 1e-3, 0.0);
    assert_near(largest_error(100), 1.288e-5, 1e-3, 0.0);
}

static void the_order_is_two(void **state) {
    (void)state;
    for (int n = 10; n <= 160; n *= 2)
        assert_near(log2(largest_error(n) / largest_error(2 * n)), 2.0, 0.0, 0.1);
}

/* Whether an undamped oscillator of 1 rad/s stays bounded at this step. */
static bool is_stable(double step) {
    double u = 1.0, v = 0.0, a = -1.0, last = 0.0;
    for (int i = 0; i < 20000; i++) {
        cz_two_step_advance(1, step, i == 0, &u, &v, &a, &last);
        a = -u;
        if (!(fabs(u) < 1e6))
            return false;
    }
    return true;
}

static void an_undamped_oscillator_is_stable_up_to_two(void **state) {
    (void)state;
    assert_true(is_stable(1.999));
    assert_false(is_stable(2.001));
}

/* No numerical damping: the amplitude is what it was after ten thousand periods. */
static void the_scheme_does_not_damp(void **state) {
    (void)state;
    const double step = 0.1;
    double u = 1.0, v = 0.0, a = -1.0, last = 0.0, largest[2] = {0};
    for (int i = 0; i < 640000; i++) {
        cz_two_step_advance(1, step, i == 0, &u, &v, &a, &last);
        a = -u;
        double *part = &largest[i < 320000 ? 0 : 1];
        *part = fmax(*part, fabs(u));
    }
    assert_near(largest[1], largest[0], 1e-6, 0.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_exact_answer_is_the_published_one),
        cmocka_unit_test(the_errors_are_the_known_ones),
        cmocka_unit_test(the_order_is_two),
        cmocka_unit_test(an_undamped_oscillator_is_stable_up_to_two),
        cmocka_unit_test(the_scheme_does_not_damp),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
