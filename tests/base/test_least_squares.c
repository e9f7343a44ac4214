/* Linear least squares against solutions by hand. */
#include "support/check.h"

#include "base/least_squares.h"

/* A line through points that are not on a line: its normal equations solved by hand. */
static void a_line_has_the_smallest_squares(void **state) {
    (void)state;
    double a[8] = {1.0, 1.0, 1.0, 1.0, 0.0, 1.0, 2.0, 3.0}, b[4] = {1.0, 0.0, 2.0, 5.0};
    assert_true(cz_least_squares(4, 2, a, 1, b));
    assert_near(b[0], -0.1, 0.0, 1e-14); /* rounding, here and below */
    assert_near(b[1], 1.4, 0.0, 1e-14);
}

static void a_square_system_is_solved_for_every_right_hand_side(void **state) {
    (void)state;
    double a[9] = {2.0, 1.0, 0.0, -1.0, 3.0, 2.0, 4.0, 0.0, 1.0};
    double b[6] = {5.0, 4.0, 3.0, 12.0, 7.0, 7.0};
    assert_true(cz_least_squares(3, 3, a, 2, b));
    const double x[6] = {1.0, 1.0, 1.0, 1.0, 2.0, 3.0};
    for (int i = 0; i < 6; i++)
        assert_near(b[i], x[i], 0.0, 1e-14); /* rounding */
}

static void dependent_columns_are_reported(void **state) {
    (void)state;
    double a[6] = {1.0, 2.0, 3.0, 2.0, 4.0, 6.0}, none[3] = {0.0}, b[3] = {1.0, 1.0, 1.0};
    assert_false(cz_least_squares(3, 2, a, 1, b));
    assert_false(cz_least_squares(3, 1, none, 1, b));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_line_has_the_smallest_squares),
        cmocka_unit_test(a_square_system_is_solved_for_every_right_hand_side),
        cmocka_unit_test(dependent_columns_are_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
