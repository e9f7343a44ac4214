/* Collisions of rigid cars whose outcome is known in closed form. */
#include "physics/closed_forms.h"

static Rows rows; /* large; each test starts it afresh */

static void with_steps(void (*rows_of)(Rows *, const Step *), const Step *a, const Step *b) {
    rows.n = 0;
    rows_of(&rows, a);
    rows_of(&rows, b);
    assert_rows(&rows);
}

static void with_both_steps(void (*rows_of)(Rows *, const Step *)) {
    with_steps(rows_of, &default_step, &fine_step);
}

static void a_plateau_between_two_masses_follows_the_closed_form(void **state) {
    (void)state;
    with_both_steps(rows_of_plateaus);
}

static void crush_zones_in_series_follow_the_closed_form(void **state) {
    (void)state;
    with_both_steps(rows_of_crush_zones_in_series);
}

static void an_elastic_and_plastic_spring_follows_the_closed_form(void **state) {
    (void)state;
    assert_rows_of(rows_of_spring_and_plateau);
}

static void four_stages_and_two_stages_back_follow_the_closed_form(void **state) {
    (void)state;
    assert_rows_of(rows_of_four_stages);
}

static void coupler_gap_anti_climber_and_end_work_in_sequence(void **state) {
    (void)state;
    with_both_steps(rows_of_sequence);
}

static void two_cars_into_a_wall_stop_one_after_the_other(void **state) {
    (void)state;
    with_steps(rows_of_two_into_wall, &stiff_step, &stiffer_step);
}

static void eight_cars_onto_eight_crush_at_three_interfaces(void **state) {
    (void)state;
    with_steps(rows_of_eight_and_eight, &stiff_step, &stiffer_step);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_plateau_between_two_masses_follows_the_closed_form),
        cmocka_unit_test(crush_zones_in_series_follow_the_closed_form),
        cmocka_unit_test(an_elastic_and_plastic_spring_follows_the_closed_form),
        cmocka_unit_test(four_stages_and_two_stages_back_follow_the_closed_form),
        cmocka_unit_test(coupler_gap_anti_climber_and_end_work_in_sequence),
        cmocka_unit_test(two_cars_into_a_wall_stop_one_after_the_other),
        cmocka_unit_test(eight_cars_onto_eight_crush_at_three_interfaces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
