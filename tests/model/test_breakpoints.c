/* Curves as breakpoints: values at every point, energies, spare breakpoints and limits. */
#include "support/check.h"

#include "model/breakpoints.h"

static CzStage level(double stroke, double force) {
    return (CzStage){.given = true, .stroke = stroke, .force = force, .end_force = NAN};
}

/* Integral from 0 to x, exact for straight pieces between the sorted breakpoints. */
static double energy(const CzBreakpoints *breakpoints, double x) {
    double sum = breakpoints->start * x;
    for (int i = 0; i < breakpoints->n; i++) {
        const double past = fmax(x - breakpoints->at[i], 0.0);
        sum += 0.5 * breakpoints->slope_change[i] * past * past;
    }
    return sum;
}

static const CzTable no_table = {.given = false};

static void one_level_plateau_holds_its_force_and_then_bottoms_out(void **state) {
    (void)state;
    const CzStage stage = level(0.25, 6e5);
    CzBreakpoints breakpoints;
    cz_breakpoints_strength(&breakpoints, &stage, 1, &no_table, NAN, 0.01, 1e9);
    assert_int_equal(breakpoints.n, cz_breakpoints_in_strength(1, &no_table));
    assert_near(cz_breakpoints_value(&breakpoints, 0.0), 6e5, 0.0, 0.0);
    assert_near(cz_breakpoints_value(&breakpoints, 0.125), 6e5, 0.0, 0.0);
    assert_near(cz_breakpoints_value(&breakpoints, 0.25), 6e5, 0.0, 0.0);
    assert_near(cz_breakpoints_value(&breakpoints, 0.26), 6e5 + 1e7, ROUNDING_OF_A_SUM, 0.0);
    assert_near(breakpoints.usable, 0.25, 0.0, 0.0);
    assert_near(breakpoints.at[breakpoints.n - 1], 0.25, 0.0, 0.0);
}

static void plateaus_keep_their_energy_over_the_ramps(void **state) {
    (void)state;
    const CzStage stage[] = {level(0.1, 4e5), level(0.02, 9e5), level(0.3, 7e5)};
    CzBreakpoints breakpoints;
    cz_breakpoints_strength(&breakpoints, stage, 3, &no_table, NAN, 0.01, 1e9);
    assert_int_equal(breakpoints.n, cz_breakpoints_in_strength(3, &no_table));
    assert_near(energy(&breakpoints, 0.42), 0.1 * 4e5 + 0.02 * 9e5 + 0.3 * 7e5, ROUNDING_OF_A_SUM,
                0.0);
    assert_near(cz_breakpoints_value(&breakpoints, 0.1), 6.5e5, ROUNDING_OF_A_SUM, 0.0);
    assert_near(cz_breakpoints_value(&breakpoints, 0.1 - 1.001e-3), 4e5, ROUNDING_OF_A_SUM, 0.0);
    assert_near(cz_breakpoints_value(&breakpoints, 0.1 + 1.001e-3), 9e5, ROUNDING_OF_A_SUM, 0.0);
    assert_near(cz_breakpoints_value(&breakpoints, 0.42), 7e5, ROUNDING_OF_A_SUM, 0.0);
}

static void long_plateaus_have_ramps_of_five_millimetres(void **state) {
    (void)state;
    const CzStage stage[] = {level(1.0, 1e6), level(1.0, 2e6)};
    CzBreakpoints breakpoints;
    cz_breakpoints_strength(&breakpoints, stage, 2, &no_table, NAN, 0.01, 1e9);
    assert_near(cz_breakpoints_value(&breakpoints, 1.0 - 2.5e-3), 1e6, ROUNDING_OF_A_SUM, 0.0);
    assert_near(cz_breakpoints_value(&breakpoints, 1.0 + 2.5e-3), 2e6, ROUNDING_OF_A_SUM, 0.0);
    assert_near(cz_breakpoints_value(&breakpoints, 1.0 + 1.25e-3), 1.75e6, ROUNDING_OF_A_SUM, 0.0);
}

static void sloping_plateaus_start_and_end_at_their_forces(void **state) {
    (void)state;
    CzStage stage[] = {level(0.5, 4e5), level(0.5, 8e5)};
    stage[0].end_force = 6e5;
    CzBreakpoints breakpoints;
    cz_breakpoints_strength(&breakpoints, stage, 2, &no_table, NAN, 0.01, 1e9);
    assert_near(cz_breakpoints_value(&breakpoints, 0.0), 4e5, 0.0, 0.0);
    assert_near(cz_breakpoints_value(&breakpoints, 0.25), 5e5, ROUNDING_OF_A_SUM, 0.0);
    assert_near(cz_breakpoints_value(&breakpoints, 1.0), 8e5, ROUNDING_OF_A_SUM, 0.0);
    /* The ramp between the stages carries the slope of the first over half of its length. */
    const double slope = 4e5, ramp = 5e-3;
    assert_near(energy(&breakpoints, 1.0), 0.5 * 5e5 + 0.5 * 8e5, ROUNDING_OF_A_SUM,
                ramp * ramp / 8.0 * slope);
}

static void the_trigger_adds_a_triangle(void **state) {
    (void)state;
    const CzStage stage[] = {level(0.2, 5e5), level(0.2, 6e5)};
    CzBreakpoints plain, peaked;
    cz_breakpoints_strength(&plain, stage, 2, &no_table, NAN, 0.02, 1e9);
    cz_breakpoints_strength(&peaked, stage, 2, &no_table, 8e5, 0.02, 1e9);
    assert_near(cz_breakpoints_value(&peaked, 0.0), 8e5, 0.0, 0.0);
    assert_near(cz_breakpoints_value(&peaked, 0.01), 6.5e5, ROUNDING_OF_A_SUM, 0.0);
    assert_near(cz_breakpoints_value(&peaked, 0.02), 5e5, ROUNDING_OF_A_SUM, 0.0);
    assert_near(energy(&peaked, 0.4) - energy(&plain, 0.4), 3e5 * 0.02 / 2.0, ROUNDING_OF_A_SUM,
                0.0);
    assert_int_equal(peaked.n, plain.n);
}

/* Also where the trigger ends within the ramp to the next plateau. */
static void breakpoints_are_in_order_of_stroke(void **state) {
    (void)state;
    const CzStage stage[] = {level(0.012, 5e5), level(0.2, 4e5)};
    for (double length = 0.008; length < 0.02; length += 0.0005) {
        CzBreakpoints breakpoints;
        cz_breakpoints_strength(&breakpoints, stage, 2, &no_table, 8e5, length, 1e9);
        assert_near(cz_breakpoints_value(&breakpoints, 0.15), 4e5, ROUNDING_OF_A_SUM, 0.0);
        for (int k = 1; k < breakpoints.n; k++)
            assert_true(breakpoints.at[k] >= breakpoints.at[k - 1]);
    }
}

static void loading_stages_pass_through_their_end_forces(void **state) {
    (void)state;
    const CzStage stage[] = {level(0.02, 1.2e6), level(0.06, 1.0e6), level(0.32, 1.5e6),
                             level(0.20, 4.5e6)};
    CzBreakpoints breakpoints;
    cz_breakpoints_loading(&breakpoints, 0.0, stage, 4, &no_table, 1e9);
    assert_int_equal(breakpoints.n, cz_breakpoints_in_loading(4, &no_table));
    double stroke = 0.0, sum = 0.0, force = 0.0;
    assert_near(cz_breakpoints_value(&breakpoints, 0.0), 0.0, 0.0, 0.0);
    for (int i = 0; i < 4; i++) {
        stroke += stage[i].stroke;
        sum += (force + stage[i].force) / 2.0 * stage[i].stroke;
        force = stage[i].force;
        assert_near(cz_breakpoints_value(&breakpoints, stroke), force, ROUNDING_OF_A_SUM, 0.0);
        assert_near(energy(&breakpoints, stroke), sum, ROUNDING_OF_A_SUM, 0.0);
    }
    assert_near(cz_breakpoints_value(&breakpoints, 0.61), 4.5e6 + 1e7, ROUNDING_OF_A_SUM, 0.0);
}

static void a_buffer_starts_at_its_preload(void **state) {
    (void)state;
    const CzStage stage = level(0.05, 4e5);
    CzBreakpoints breakpoints;
    cz_breakpoints_loading(&breakpoints, 2e4, &stage, 1, &no_table, 1e9);
    assert_near(cz_breakpoints_value(&breakpoints, 0.0), 2e4, 0.0, 0.0);
    assert_near(cz_breakpoints_value(&breakpoints, 0.025), 2.1e5, ROUNDING_OF_A_SUM, 0.0);
    cz_breakpoints_scale(&breakpoints, 2.0);
    assert_near(cz_breakpoints_value(&breakpoints, 0.05), 8e5, ROUNDING_OF_A_SUM, 0.0);
    assert_near(breakpoints.usable, 0.05, 0.0, 0.0);
}

static void a_table_passes_through_every_point(void **state) {
    (void)state;
    CzTable table = {.given = true, .n_point = CZ_MAX_CURVE_POINTS};
    for (int i = 0; i < table.n_point; i++) {
        table.x[i] = 0.01 * i + 0.001 * (i % 3);
        table.y[i] = 5e5 + 1e5 * ((i * 7) % 5);
    }
    CzBreakpoints breakpoints;
    cz_breakpoints_strength(&breakpoints, NULL, 0, &table, 9e5, 0.005, 1e9);
    assert_int_equal(breakpoints.n, cz_breakpoints_in_strength(0, &table));
    assert_true(breakpoints.n <= CZ_MAX_BREAKPOINTS);
    assert_near(cz_breakpoints_value(&breakpoints, 0.0), 9e5, 0.0, 0.0);
    for (int i = 1; i < table.n_point; i++)
        assert_near(cz_breakpoints_value(&breakpoints, table.x[i]), table.y[i], ROUNDING_OF_A_SUM,
                    0.0);
    assert_near(breakpoints.usable, table.x[table.n_point - 1], 0.0, 0.0);
}

static void missing_members_never_yield(void **state) {
    (void)state;
    CzBreakpoints breakpoints;
    cz_breakpoints_rigid_member(&breakpoints);
    assert_near(cz_breakpoints_value(&breakpoints, 5.0), 1e30, 0.0, 0.0);
    cz_breakpoints_spring(&breakpoints, CZ_NEVER);
    assert_near(cz_breakpoints_value(&breakpoints, -1.0), 0.0, 0.0, 0.0);
    assert_near(cz_breakpoints_value(&breakpoints, 1.0), 1e30, 0.0, 0.0);
    assert_int_equal(breakpoints.n, 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_level_plateau_holds_its_force_and_then_bottoms_out),
        cmocka_unit_test(plateaus_keep_their_energy_over_the_ramps),
        cmocka_unit_test(long_plateaus_have_ramps_of_five_millimetres),
        cmocka_unit_test(sloping_plateaus_start_and_end_at_their_forces),
        cmocka_unit_test(the_trigger_adds_a_triangle),
        cmocka_unit_test(breakpoints_are_in_order_of_stroke),
        cmocka_unit_test(loading_stages_pass_through_their_end_forces),
        cmocka_unit_test(a_buffer_starts_at_its_preload),
        cmocka_unit_test(a_table_passes_through_every_point),
        cmocka_unit_test(missing_members_never_yield),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
