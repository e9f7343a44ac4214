/* Crush zone: every branch, the closed forms of its energies, and the collision of one mass against
 * a wall. */
#include "support/check.h"

#include "drive.h"
#include "laws/vehicle_end.h"

static const Backbone four_stages = {
    5, {0, 0.02, 0.08, 0.40, 0.60}, {0, 1.2e6, 1.0e6, 1.5e6, 4.5e6}, 1e9};
static const CzVehicleEndLaw two_stages = {1e8, 0.5, 3e7, 1e8};

static CzVehicleEndResponse end_at(double x, double largest) {
    return cz_vehicle_end(&two_stages, backbone_value(&four_stages, x),
                          backbone_value(&four_stages, largest), x, largest);
}

static double end_force(Element *element, double x) {
    const double reached = cz_smaller(x, 0.60);
    element->memory[0] = cz_larger(element->memory[0], reached);
    return end_at(x, element->memory[0]).force;
}

static Element new_end(void) {
    const Element element = {.force = end_force};
    return element;
}

static void loading_follows_the_backbone(void **state) {
    (void)state;
    for (double x = 0.0; x < 0.65; x += 0.001)
        assert_near(end_at(x, cz_smaller(x, 0.60)).force, backbone_value(&four_stages, x),
                    ROUNDING_OF_A_FORMULA, 0.0);
}

/* From 1.5 MN at 0.40 m: 0.75 MN after 7.5 mm, zero after another 25 mm. */
static void unloading_has_two_stages_and_then_tension(void **state) {
    (void)state;
    assert_near(end_at(0.396, 0.40).force, 1.1e6, 1e-12, 0.0);
    assert_near(end_at(0.3925, 0.40).force, 0.75e6, 1e-12, 0.0);
    assert_near(end_at(0.3825, 0.40).force, 0.45e6, 1e-12, 0.0);
    assert_near(end_at(0.40, 0.40).residual, 0.3675, 1e-12, 0.0);
    assert_near(end_at(0.3675, 0.40).force, 0.0, 0.0, 1e-6);
    assert_near(end_at(0.3665, 0.40).force, -1e5, 1e-9, 0.0);
    assert_near(end_at(0.396, 0.40).slope, 1e8, 0.0, 0.0);
    assert_near(end_at(0.3825, 0.40).slope, 3e7, 0.0, 0.0);
}

static void an_end_without_tension_opens_without_force(void **state) {
    (void)state;
    const CzVehicleEndLaw loose = {1e8, 0.5, 3e7, 0.0};
    for (double x = -0.1; x < 0.36; x += 0.01)
        assert_near(cz_vehicle_end(&loose, backbone_value(&four_stages, x), 1.5e6, x, 0.40).force,
                    0.0, 0.0, 0.0);
}

/* Strained by 10 mm of its elastic part, 60 MN/m, the path of the unloading stages lies below zero
 * at zero shortening: the backbone replaces it near zero, so that no slack remains. */
static void the_elastic_part_leaves_no_slack(void **state) {
    (void)state;
    assert_near(end_at(0.001, 0.01).force, 6e4, 1e-12, 0.0);
    assert_near(end_at(0.0, 0.01).force, 0.0, 0.0, 0.0);
    assert_near(end_at(0.0, 0.01).residual, 0.0, 0.0, 0.0);
    assert_near(end_at(-0.001, 0.01).force, -1e5, 1e-12, 0.0);
}

static void reloading_follows_the_unloading_path_and_then_the_backbone(void **state) {
    (void)state;
    Element end = new_end();
    drive(&end, 0.40, 1e-4);
    drive(&end, 0.38, 1e-4);
    const double back = drive(&end, 0.40, 1e-5);
    assert_near(end.f, 1.5e6, ROUNDING_OF_A_SUM, 0.0);
    Element again = new_end();
    drive(&again, 0.40, 1e-4);
    assert_near(-drive(&again, 0.38, 1e-5), back, ROUNDING_OF_A_SUM, 0.0);
    drive(&end, 0.45, 1e-4);
    assert_near(end.f, backbone_value(&four_stages, 0.45), ROUNDING_OF_A_SUM, 0.0);
}

/* (1 - r^2) Fm^2 / (2 Ku1) + (r Fm)^2 / (2 Ku2). */
static void unloading_returns_the_closed_form_energy(void **state) {
    (void)state;
    for (double largest = 0.10; largest <= 0.60; largest += 0.1) {
        Element end = new_end();
        drive(&end, largest, 1e-4);
        const double peak = end.f;
        const double closed =
            (1.0 - 0.25) * peak * peak / (2.0 * 1e8) + 0.25 * peak * peak / (2.0 * 3e7);
        assert_near(recoverable(&end, 1e-6), closed, 1e-6, 0.0);
        assert_near(cz_vehicle_end_stored(&two_stages, peak, peak), closed, 1e-14, 0.0);
    }
}

/* The error of a step over a breakpoint is at most the change of stiffness times the square of the
 * step. */
static void stored_energy_is_that_of_the_unloading_from_any_force(void **state) {
    (void)state;
    const double um = 1e-6;
    Element end = new_end();
    drive(&end, 0.45, 1e-4);
    const double peak = end.f;
    for (double x = 0.45; x > 0.40; x -= 0.003) {
        drive(&end, x, 1e-4);
        assert_near(cz_vehicle_end_stored(&two_stages, peak, end.f), recoverable(&end, um), 0.0,
                    (1e8 - 3e7) * um * um);
    }
}

static void the_backbone_absorbs_the_area_below_it(void **state) {
    (void)state;
    Element end = new_end();
    const double area = 0.5 * 1.2e6 * 0.02 + 1.1e6 * 0.06 + 1.25e6 * 0.32 + 3.0e6 * 0.20;
    assert_near(drive(&end, 0.60, 1e-5), area, ROUNDING_OF_A_SUM, 0.0);
}

/* Beyond the last stage the end is on its stop: 5 mm more store and return the same energy, and the
 * elastic energy of the crush zone itself does not change. */
static void bottoming_out_is_stiff_and_elastic(void **state) {
    (void)state;
    Element end = new_end();
    drive(&end, 0.60, 1e-4);
    const double before = recoverable(&end, 1e-6);
    const double taken = drive(&end, 0.605, 1e-6);
    assert_near(taken, 4.5e6 * 0.005 + 0.5 * 1e9 * 0.005 * 0.005, 1e-9, 0.0);
    assert_near(end.f, 9.5e6, 1e-9, 0.0);
    assert_near(recoverable(&end, 1e-6), before + taken, 1e-6, 0.0);
}

static void the_steepest_stage_stores_just_the_work_done_on_it(void **state) {
    (void)state;
    const double steepest = cz_vehicle_end_steepest(&two_stages);
    const double low = 1e6, high = 3e6;
    const double work = 0.5 * (low + high) * (high - low) / steepest;
    assert_near(cz_vehicle_end_stored(&two_stages, high, high) -
                    cz_vehicle_end_stored(&two_stages, low, low),
                work, ROUNDING_OF_A_SUM, 0.0);
}

/* One mass of 40 t at 25 km/h against a wall, integrated by an independent program:
 * x_max 0.573619 m, F_max 4104.289 kN, residual 0.484693 m, rebound 2.582225 m/s, 831.148 kJ. */
static void a_mass_against_a_wall_rebounds_as_computed_independently(void **state) {
    (void)state;
    Element end = new_end();
    const double mass = 40e3, step = 1e-6;
    double x = 0.0, v = 25.0 / 3.6, largest = 0.0, peak = 0.0, peak_time = 0.0;
    double acceleration = 0.0;
    for (int i = 1; i < 1000000; i++) {
        v += 0.5 * step * acceleration;
        x += step * v;
        const double force = end_force(&end, x);
        if (v < 0.0 && force <= 0.0)
            break;
        acceleration = -force / mass;
        v += 0.5 * step * acceleration;
        if (x > largest) {
            largest = x;
            peak_time = i * step;
        }
        peak = cz_larger(peak, force);
    }
    assert_near(largest, 0.573619, 1e-5, 0.0);
    assert_near(peak, 4104.289e3, 1e-5, 0.0);
    assert_near(peak_time, 0.128219, 1e-5, 2e-6);
    assert_near(v, -2.582225, 1e-5, 0.0);
    assert_near(end_at(x, end.memory[0]).residual, 0.484693, 1e-5, 0.0);
    const double speed = 25.0 / 3.6;
    assert_near(0.5 * mass * (speed * speed - v * v), 831.148e3, 1e-5, 0.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(loading_follows_the_backbone),
        cmocka_unit_test(unloading_has_two_stages_and_then_tension),
        cmocka_unit_test(an_end_without_tension_opens_without_force),
        cmocka_unit_test(the_elastic_part_leaves_no_slack),
        cmocka_unit_test(reloading_follows_the_unloading_path_and_then_the_backbone),
        cmocka_unit_test(unloading_returns_the_closed_form_energy),
        cmocka_unit_test(stored_energy_is_that_of_the_unloading_from_any_force),
        cmocka_unit_test(the_backbone_absorbs_the_area_below_it),
        cmocka_unit_test(bottoming_out_is_stiff_and_elastic),
        cmocka_unit_test(the_steepest_stage_stores_just_the_work_done_on_it),
        cmocka_unit_test(a_mass_against_a_wall_rebounds_as_computed_independently),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
