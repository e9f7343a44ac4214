/* Multiples of an increment. */
#include "support/check.h"

#include "base/increment.h"

static void multiples_next_to_a_value_are_found(void **state) {
    (void)state;
    assert_near(cz_increment_not_above(10, 239), 230, 0, 0);
    assert_near(cz_increment_not_below(10, 231), 240, 0, 0);
    assert_near(cz_increment_not_above(10, -1), -10, 0, 0);
    assert_near(cz_increment_not_below(10, -11), -10, 0, 0);
}

/* 0.1 is not a binary fraction, but ten times 0.1 counts as 1. */
static void a_value_within_rounding_of_a_multiple_counts_as_a_multiple(void **state) {
    (void)state;
    for (int i = 1; i < 1000; i++) {
        const double value = 0.1 * i;
        assert_near(cz_increment_not_above(0.1, value), value, 1e-15, 0);
        assert_near(cz_increment_not_below(0.1, value), value, 1e-15, 0);
        assert_int_equal(cz_increment_count(0.1, value, value), 1);
    }
}

static void increments_within_bounds_are_counted_up_to_two(void **state) {
    (void)state;
    assert_int_equal(cz_increment_count(40, 190, 230), 1);
    assert_int_equal(cz_increment_count(40, 190, 195), 0);
    assert_int_equal(cz_increment_count(40, 160, 200), 2);
    assert_int_equal(cz_increment_count(40, 160, 199.9), 1);
    assert_int_equal(cz_increment_count(1, 0, 1e6), 2);
    assert_int_equal(cz_increment_count(50, -20, 20), 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(multiples_next_to_a_value_are_found),
        cmocka_unit_test(a_value_within_rounding_of_a_multiple_counts_as_a_multiple),
        cmocka_unit_test(increments_within_bounds_are_counted_up_to_two)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
