/* Suspension, wheel and rail: every branch, steady states and published constants. */
#include "support/check.h"

#include <stdbool.h>

#include "laws/suspension.h"
#include "laws/wheel_rail.h"

static const CzSuspensionLaw secondary = {8.6e5, 1.4e5, 0.04, 2e7, 0.30, 2e7, 4e4, 0.5, 4e3};

static void a_spring_carries_its_load_and_no_tension(void **state) {
    (void)state;
    assert_near(cz_suspension_spring(&secondary, 0.02), 1.72e4, ROUNDING_OF_A_SUM, 0.0);
    assert_near(cz_suspension_spring(&secondary, -0.1), -8.6e4, ROUNDING_OF_A_SUM, 0.0);
    assert_near(cz_suspension_spring(&secondary, -0.2), -1.4e5, ROUNDING_OF_A_SUM, 0.0);
}

static void a_spring_that_carries_tension_has_no_lower_end(void **state) {
    (void)state;
    CzSuspensionLaw law = secondary;
    law.preload = 1e30;
    assert_near(cz_suspension_spring(&law, -0.25), -8.6e5 * 0.25, ROUNDING_OF_A_SUM, 0.0);
}

static void stops_add_their_stiffness_beyond_their_gaps(void **state) {
    (void)state;
    assert_near(cz_suspension_spring(&secondary, 0.05), 8.6e5 * 0.05 + 2e7 * 0.01,
                ROUNDING_OF_A_SUM, 0.0);
    assert_near(cz_suspension_spring(&secondary, -0.31), -1.4e5 - 2e7 * 0.01, ROUNDING_OF_A_SUM,
                0.0);
    CzSuspensionLaw law = secondary;
    law.bump_gap = law.lift_gap = 1e30;
    assert_near(cz_suspension_spring(&law, 0.05), 8.6e5 * 0.05, ROUNDING_OF_A_SUM, 0.0);
    assert_near(cz_suspension_spring(&law, -0.31), -1.4e5, ROUNDING_OF_A_SUM, 0.0);
}

static void a_damper_is_soft_beyond_its_relief_valve(void **state) {
    (void)state;
    assert_near(cz_suspension_damper(&secondary, 0.3), 1.2e4, ROUNDING_OF_A_SUM, 0.0);
    assert_near(cz_suspension_damper(&secondary, 1.5), 2e4 + 4e3, ROUNDING_OF_A_SUM, 0.0);
    assert_near(cz_suspension_damper(&secondary, -1.5), -2e4 - 4e3, ROUNDING_OF_A_SUM, 0.0);
}

/* G = 3.86 R^-0.115 1e-8 m/N^(2/3), per wheel, worn profile, R = 0.43 m: Zhai's constant and its
 * consequence. */
static double hertz_of_one_wheel(void) {
    const double g = 3.86e-8 * pow(0.43, -0.115);
    assert_near(g, 4.253e-8, 2e-4, 0.0);
    return pow(g, -1.5);
}

static void the_hertz_constant_agrees_with_the_published_one(void **state) {
    (void)state;
    const double hertz = hertz_of_one_wheel();
    assert_near(hertz, 1.140e11, 0.0, 0.0005e11); /* half of its last digit */
    const double indentation = pow(70e3 / hertz, 2.0 / 3.0);
    assert_near(indentation, 0.0722e-3, 0.0, 0.00005e-3); /* likewise */
    assert_near(cz_wheel_normal_force(hertz, indentation), 70e3, ROUNDING_OF_A_SUM, 0.0);
    const double small = 1e-9;
    const double tangent = (cz_wheel_normal_force(hertz, indentation + small) -
                            cz_wheel_normal_force(hertz, indentation - small)) /
                           (2.0 * small);
    assert_near(tangent, 1.45e9, 0.0, 0.005e9); /* likewise */
    /* An independent value, of railFE: 1.0e11 N/m^1.5. */
    assert_near(hertz, 1.0e11, 0.15, 0.0);
}

static void a_lifted_wheel_has_no_contact_force(void **state) {
    (void)state;
    assert_near(cz_wheel_normal_force(2.28e11, 0.0), 0.0, 0.0, 0.0);
    assert_near(cz_wheel_normal_force(2.28e11, -1e-3), 0.0, 0.0, 0.0);
}

static const CzCreepLaw creep = {3.5e8, 0.006, 0.3, 0.15, 3.0};
static const double normal = 1e5;

/* Deflection after so many steps of steady slip. */
static double after(double deflection, double slip, double speed, double load, double step,
                    int n_step) {
    for (int i = 0; i < n_step; i++)
        deflection =
            cz_creep_deflection(&creep, 1.0 / creep.stiffness, deflection, slip, speed, load, step);
    return deflection;
}

/* T = k a xi at any step and either direction of travel. */
static void steady_creepage_gives_a_force_in_proportion(void **state) {
    (void)state;
    for (double step = 1e-5; step < 2e-3; step *= 10.0) {
        for (int direction = -1; direction <= 1; direction += 2) {
            const double speed = direction * 7.0, creepage = 0.005;
            const double e = after(0.0, creepage * 7.0, speed, normal, step, 5000);
            assert_near(creep.stiffness * e, creep.stiffness * creep.length * creepage, 1e-9, 0.0);
        }
    }
}

static void the_force_opposes_the_slip(void **state) {
    (void)state;
    assert_true(after(0.0, 0.03, 7.0, normal, 1e-4, 100) > 0.0);
    assert_true(after(0.0, -0.03, 7.0, normal, 1e-4, 100) < 0.0);
}

static void large_slip_saturates_and_falls_to_sliding_friction(void **state) {
    (void)state;
    const double slow = creep.stiffness * after(0.0, 0.2, 7.0, normal, 1e-4, 5000);
    assert_near(slow, (0.15 + 0.15 / (1.0 + 0.2 / 3.0)) * normal, ROUNDING_OF_A_SUM, 0.0);
    const double half = creep.stiffness * after(0.0, 3.0, 7.0, normal, 1e-4, 5000);
    assert_near(half, 0.225 * normal, ROUNDING_OF_A_SUM, 0.0);
    const double fast = creep.stiffness * after(0.0, 3000.0, 7.0, normal, 1e-4, 5000);
    assert_near(fast, (0.15 + 0.15 / (1.0 + 3000.0 / 3.0)) * normal, ROUNDING_OF_A_SUM, 0.0);
}

static void the_force_over_creepage_rises_peaks_and_falls(void **state) {
    (void)state;
    double last = 0.0;
    int n_turn = 0;
    bool rising = true;
    for (double creepage = 1e-4; creepage < 1.0; creepage *= 1.1) {
        const double e = after(0.0, creepage * 10.0, 10.0, normal, 1e-3, 2000);
        if (rising != (e > last)) {
            rising = !rising;
            n_turn++;
        }
        last = e;
    }
    assert_int_equal(n_turn, 1);
    assert_false(rising);
}

/* Displaced by 1 um and released, a standing wheel keeps its deflection; that of a rolling wheel
 * decays. */
static void a_standing_wheel_keeps_its_deflection_and_a_rolling_one_loses_it(void **state) {
    (void)state;
    const double pushed = after(0.0, 1e-3, 0.0, normal, 1e-3, 1);
    assert_near(pushed, 1e-6, 1e-12, 0.0);
    assert_near(after(pushed, 0.0, 0.0, normal, 1e-3, 100000), pushed, 1e-12, 0.0);
    assert_near(after(pushed, 0.0, 5.0, normal, 1e-3, 100), 0.0, 0.0, 1e-15);
}

static void a_standing_wheel_slips_at_the_friction_limit(void **state) {
    (void)state;
    const double e = after(0.0, 0.01, 0.0, normal, 1e-3, 10000);
    assert_near(creep.stiffness * e, (0.15 + 0.15 / (1.0 + 0.01 / 3.0)) * normal, ROUNDING_OF_A_SUM,
                0.0);
}

static void a_lifted_wheel_or_none_has_no_tangential_force(void **state) {
    (void)state;
    assert_near(after(1e-5, 0.1, 5.0, 0.0, 1e-4, 1), 0.0, 0.0, 0.0);
    assert_near(cz_creep_deflection(&creep, 0.0, 0.0, 0.1, 5.0, normal, 1e-4), 0.0, 0.0, 0.0);
}

/* The law never overshoots its steady state, at any step. */
static void the_deflection_never_overshoots(void **state) {
    (void)state;
    const double steady = 0.005 * creep.length;
    double e = 0.0;
    for (int i = 0; i < 100; i++) {
        e = cz_creep_deflection(&creep, 1.0 / creep.stiffness, e, 0.005 * 20.0, 20.0, normal, 0.1);
        assert_true(e <= steady * (1.0 + 1e-12));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_spring_carries_its_load_and_no_tension),
        cmocka_unit_test(a_spring_that_carries_tension_has_no_lower_end),
        cmocka_unit_test(stops_add_their_stiffness_beyond_their_gaps),
        cmocka_unit_test(a_damper_is_soft_beyond_its_relief_valve),
        cmocka_unit_test(the_hertz_constant_agrees_with_the_published_one),
        cmocka_unit_test(a_lifted_wheel_has_no_contact_force),
        cmocka_unit_test(steady_creepage_gives_a_force_in_proportion),
        cmocka_unit_test(the_force_opposes_the_slip),
        cmocka_unit_test(large_slip_saturates_and_falls_to_sliding_friction),
        cmocka_unit_test(the_force_over_creepage_rises_peaks_and_falls),
        cmocka_unit_test(a_standing_wheel_keeps_its_deflection_and_a_rolling_one_loses_it),
        cmocka_unit_test(a_standing_wheel_slips_at_the_friction_limit),
        cmocka_unit_test(a_lifted_wheel_or_none_has_no_tangential_force),
        cmocka_unit_test(the_deflection_never_overshoots),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
