/* Published vehicles and bulk numbers of full-scale tests. */
#include "physics/published.h"

static void published_coaches_have_their_frequencies_and_loads(void **state) {
    (void)state;
    assert_rows_of(rows_of_coaches);
}

static void a_force_off_the_centre_of_gravity_loads_the_bogies_unequally(void **state) {
    (void)state;
    assert_rows_of(rows_of_pitch_by_force);
}

static void a_sudden_force_pitches_a_body_twice_as_far(void **state) {
    (void)state;
    assert_rows_of(rows_of_step_force);
}

static void two_trains_have_the_published_energy_and_speed(void **state) {
    (void)state;
    assert_rows_of(rows_of_train_to_train);
}

static void constant_forces_do_not_explain_the_crush_of_two_cars(void **state) {
    (void)state;
    assert_rows_of(rows_of_crush_of_single_cars);
}

static void a_push_back_device_deflects_at_the_last_coupling_speed_only(void **state) {
    (void)state;
    assert_rows_of(rows_of_coupling_speeds);
}

static void eight_car_trains_have_the_published_energy(void **state) {
    (void)state;
    assert_rows_of(rows_of_eight_car_trains);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(published_coaches_have_their_frequencies_and_loads),
        cmocka_unit_test(a_force_off_the_centre_of_gravity_loads_the_bogies_unequally),
        cmocka_unit_test(a_sudden_force_pitches_a_body_twice_as_far),
        cmocka_unit_test(two_trains_have_the_published_energy_and_speed),
        cmocka_unit_test(constant_forces_do_not_explain_the_crush_of_two_cars),
        cmocka_unit_test(a_push_back_device_deflects_at_the_last_coupling_speed_only),
        cmocka_unit_test(eight_car_trains_have_the_published_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
