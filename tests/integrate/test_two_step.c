/* The two-step scheme: errors, order, stability, and no damping of its own. */
#include "physics/scheme.h"

#include "integrate/two_step.h"

static void the_exact_solution_is_the_published_one(void **state) {
    (void)state;
    assert_rows_of(rows_of_published_answer);
}

static void the_errors_are_the_published_ones(void **state) {
    (void)state;
    assert_rows_of(rows_of_known_errors);
}

static void the_order_is_two(void **state) {
    (void)state;
    assert_rows_of(rows_of_order);
}

static void an_undamped_oscillator_is_stable_up_to_two(void **state) {
    (void)state;
    assert_rows_of(rows_of_stability);
    assert_true(is_stable(1.999));
    assert_false(is_stable(2.001));
}

/* No numerical damping: the amplitude is unchanged after ten thousand periods. */
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

static void a_wheelset_bounces_off_a_rail_as_in_hertz_theory(void **state) {
    (void)state;
    assert_rows_of(rows_of_hertz_impact);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_exact_solution_is_the_published_one),
        cmocka_unit_test(the_errors_are_the_published_ones),
        cmocka_unit_test(the_order_is_two),
        cmocka_unit_test(an_undamped_oscillator_is_stable_up_to_two),
        cmocka_unit_test(the_scheme_does_not_damp),
        cmocka_unit_test(a_wheelset_bounces_off_a_rail_as_in_hertz_theory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
