/* Members that crush or yield: tubes, shear-off, sliders, stops. */
#include "support/check.h"

#include <stdbool.h>

#include "drive.h"
#include "laws/plastic_member.h"
#include "laws/shear_off.h"
#include "laws/slider.h"

enum { TUBE, SHEAR_OFF };

/* Difference between force and strength of a member that is driven in steps of 1 um: it follows
 * within a step, and a step of the spring before it is 200 N of some 600 kN. */
#define SETTLED 4e-4

/* A member behind a spring of 200 MN/m. */
typedef struct {
    int kind;
    double rate_factor, step;
    Backbone curve;
} Member;

static double chain_force(Element *element, double x) {
    const Member *member = element->law;
    const double stroke = element->memory[0], stiffness = 2e8;
    const bool tube = member->kind == TUBE;
    const CzShearOffResponse device =
        cz_shear_off(&(CzShearOffLaw){9e5, 0.0, 0.01, 0.06, 1e9}, stroke);
    const double strength = tube ? backbone_value(&member->curve, stroke) : device.strength;
    const double slope = tube ? backbone_slope(&member->curve, stroke) : device.slope;
    const double compliance =
        cz_plastic_compliance(strength, slope, member->rate_factor, member->step);
    const double trial = stiffness * (x - stroke);
    const double flowing =
        (trial + stiffness * compliance * strength) / (1.0 + stiffness * compliance);
    const double force = cz_positive_part(trial > strength ? flowing : trial);
    element->memory[0] += cz_plastic_crush(force, strength, compliance);
    return force;
}

static void below_its_strength_a_member_does_not_crush(void **state) {
    (void)state;
    const double compliance = cz_plastic_compliance(6e5, 0.0, 0.05, 1e-4);
    assert_near(cz_plastic_crush(-1e5, 6e5, compliance), 0.0, 0.0, 0.0);
    assert_near(cz_plastic_crush(6e5, 6e5, compliance), 0.0, 0.0, 0.0);
    assert_true(cz_plastic_crush(6e5 + 1.0, 6e5, compliance) > 0.0);
}

static void a_missing_member_never_crushes(void **state) {
    (void)state;
    assert_near(cz_plastic_crush(1e9, 1e30, cz_plastic_compliance(1e30, 0.0, 0.0, 1e-4)), 0.0, 0.0,
                0.0);
}

/* 0.6 MN over 0.25 m: 150 kJ, and 0.9 kJ back from the spring. */
static void a_plateau_absorbs_the_closed_form_energy(void **state) {
    (void)state;
    const Member tube = {TUBE, 0.0, 1e-4, {2, {0, 0.25}, {6e5, 6e5}, 1e9}};
    Element chain = {.force = chain_force, .law = &tube};
    double work = drive(&chain, 0.2530, 1e-6);
    assert_near(chain.memory[0], 0.25, 1e-5, 0.0);
    work += drive(&chain, 0.24, 1e-6);
    assert_near(chain.f, 0.0, 0.0, 0.0);
    assert_near(work, 6e5 * 0.25, 1e-4, 0.0);
}

static void a_trigger_peak_falls_over_its_length(void **state) {
    (void)state;
    const Member tube = {TUBE, 0.0, 1e-4, {3, {0, 0.01, 0.25}, {8e5, 6e5, 6e5}, 1e9}};
    Element chain = {.force = chain_force, .law = &tube};
    double peak = 0.0;
    for (double x = 0.0; x < 0.1; x += 1e-5) {
        drive(&chain, x, 1e-6);
        peak = cz_larger(peak, chain.f);
    }
    assert_near(peak, 8e5, ROUNDING_OF_A_SUM, 0.0);
    assert_near(chain.f, 6e5, SETTLED, 0.0);
}

static void beyond_its_stroke_a_tube_is_stiff(void **state) {
    (void)state;
    const Member tube = {TUBE, 0.0, 1e-4, {2, {0, 0.25}, {6e5, 6e5}, 1e9}};
    Element chain = {.force = chain_force, .law = &tube};
    drive(&chain, 0.26, 1e-6);
    /* Spring and stop in series: 0.6 MN at 0.253 m, then 1 / (1/200 + 1/1000) MN/mm. */
    assert_near(chain.f, 6e5 + (0.26 - 0.253) / (1.0 / 2e8 + 1.0 / 1e9), 2e-3, 0.0);
}

/* A crush rate of 2 m/s with 0.05 s/m raises 0.6 MN to 0.66 MN, at any step. */
static void the_rate_factor_raises_the_plastic_force(void **state) {
    (void)state;
    for (double step = 1e-6; step < 1e-3; step *= 10.0) {
        const double compliance = cz_plastic_compliance(6e5, 0.0, 0.05, step);
        assert_near(cz_plastic_crush(6.6e5, 6e5, compliance) / step, 2.0, 5e-3, 0.0);
    }
}

static void rates_do_not_act_on_elastic_unloading(void **state) {
    (void)state;
    const Member tube = {TUBE, 0.1, 1e-5, {2, {0, 0.25}, {6e5, 6e5}, 1e9}};
    Element chain = {.force = chain_force, .law = &tube};
    drive(&chain, 0.1, 1e-5);
    drive(&chain, 0.0999, 1e-7);
    const double force = chain.f, stroke = chain.memory[0];
    drive(&chain, 0.0995, 1e-5);
    assert_near(chain.memory[0], stroke, 0.0, 0.0);
    assert_near(chain.f, force - 2e8 * 0.0004, ROUNDING_OF_A_SUM, 0.0);
}

/* F_s times half the softening length, beside the spring's own energy. */
static void shearing_off_absorbs_half_force_times_softening_length(void **state) {
    (void)state;
    const Member device = {.kind = SHEAR_OFF, .step = 1e-4};
    Element chain = {.force = chain_force, .law = &device};
    const double work = drive(&chain, 0.05, 1e-7);
    assert_near(work, 9e5 * 0.01 / 2.0, 1e-3, 0.0);
    assert_near(chain.f, 0.0, 0.0, 1.0);
}

/* The trapezium of the fall, then the friction over the rest of the travel. */
static void a_residual_force_absorbs_energy_over_the_retraction_space(void **state) {
    (void)state;
    const CzShearOffLaw law = {9e5, 1.5e5, 0.01, 0.06, 1e9};
    double work = 0.0;
    const int n = 6000;
    for (int i = 0; i < n; i++)
        work += 0.06 / n * cz_shear_off(&law, 0.06 * (i + 0.5) / n).strength;
    assert_near(work, 0.01 * (9e5 + 1.5e5) / 2.0 + 0.05 * 1.5e5, 1e-9, 0.0);
    assert_near(cz_shear_off(&law, 0.061).strength, 1.5e5 + 1e6, 1e-9, 0.0);
    const CzShearOffLaw whole = {9e5, 0.0, 0.01, 0.06, 1e9};
    assert_near(cz_shear_off(&whole, 0.03).strength, 0.0, 0.0, 0.0);
}

static void shear_off_is_undamaged_then_damaged_then_broken(void **state) {
    (void)state;
    const double places[][3] = {/* travel, strength, damage */
                                {0.0, 9e5, 0.0},
                                {0.0025, 6.75e5, 0.25},
                                {0.01, 0.0, 1.0},
                                {0.06, 0.0, 1.0},
                                {0.061, 1e6, 1.0}};
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        const CzShearOffResponse response =
            cz_shear_off(&(CzShearOffLaw){9e5, 0.0, 0.01, 0.06, 1e9}, places[i][0]);
        assert_near(response.strength, places[i][1], ROUNDING_OF_A_SUM, 0.0);
        assert_near(response.damage, places[i][2], ROUNDING_OF_A_SUM, 0.0);
        assert_near(response.slope, places[i][0] > 0.06 ? 1e9 : 0.0, 0.0, 0.0);
    }
}

static void a_sheared_coupler_without_space_is_a_second_load_path(void **state) {
    (void)state;
    const Member device = {.kind = SHEAR_OFF, .step = 1e-4};
    Element chain = {.force = chain_force, .law = &device};
    drive(&chain, 0.066, 1e-6);
    assert_near(chain.f, 0.006 / (1.0 / 2e8 + 1.0 / 1e9), SETTLED, 0.0);
}

static void a_slider_sticks_yields_and_sticks_again(void **state) {
    (void)state;
    CzSliderResponse held = cz_slider(2e7, 4e5, 0.01, 0.0);
    assert_near(held.force, 2e5, ROUNDING_OF_A_SUM, 0.0);
    assert_near(held.offset, 0.0, 0.0, ROUNDING_OF_A_VALUE);
    held = cz_slider(2e7, 4e5, 0.03, held.offset);
    assert_near(held.force, 4e5, ROUNDING_OF_A_SUM, 0.0);
    assert_near(held.offset, 0.01, ROUNDING_OF_A_SUM, 0.0);
    held = cz_slider(2e7, 4e5, 0.02, held.offset);
    assert_near(held.force, 2e5, ROUNDING_OF_A_SUM, 0.0);
    held = cz_slider(2e7, 4e5, -0.05, held.offset);
    assert_near(held.force, -4e5, ROUNDING_OF_A_SUM, 0.0);
    assert_near(held.offset, -0.03, ROUNDING_OF_A_SUM, 0.0);
}

static void a_shrinking_capacity_only_dissipates(void **state) {
    (void)state;
    CzSliderResponse held = cz_slider(2e7, 4e5, 0.02, 0.0);
    double stored = held.force * held.force / (2.0 * 2e7);
    for (double capacity = 4e5; capacity >= 0.0; capacity -= 1e4) {
        held = cz_slider(2e7, capacity, 0.02, held.offset);
        const double left = held.force * held.force / (2.0 * 2e7);
        assert_true(left <= stored);
        assert_near(held.force, capacity, ROUNDING_OF_A_SUM, 0.0);
        stored = left;
    }
}

static void a_slider_without_stiffness_carries_nothing(void **state) {
    (void)state;
    const CzSliderResponse response = cz_slider(0.0, 4e5, 0.02, 0.0);
    assert_near(response.force, 0.0, 0.0, 0.0);
    assert_true(isfinite(response.offset));
}

static void a_stop_is_free_within_its_range_and_the_same_on_both_sides(void **state) {
    (void)state;
    assert_near(cz_stop(1e7, 0.1, 0.1), 0.0, 0.0, 0.0);
    assert_near(cz_stop(1e7, 0.1, -0.05), 0.0, 0.0, 0.0);
    assert_near(cz_stop(1e7, 0.1, 0.12), 2e5, ROUNDING_OF_A_SUM, 0.0);
    assert_near(cz_stop(1e7, 0.1, -0.12), -2e5, ROUNDING_OF_A_SUM, 0.0);
    assert_near(cz_stop(1e7, 1e30, 5.0), 0.0, 0.0, 0.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(below_its_strength_a_member_does_not_crush),
        cmocka_unit_test(a_missing_member_never_crushes),
        cmocka_unit_test(a_plateau_absorbs_the_closed_form_energy),
        cmocka_unit_test(a_trigger_peak_falls_over_its_length),
        cmocka_unit_test(beyond_its_stroke_a_tube_is_stiff),
        cmocka_unit_test(the_rate_factor_raises_the_plastic_force),
        cmocka_unit_test(rates_do_not_act_on_elastic_unloading),
        cmocka_unit_test(a_residual_force_absorbs_energy_over_the_retraction_space),
        cmocka_unit_test(shearing_off_absorbs_half_force_times_softening_length),
        cmocka_unit_test(shear_off_is_undamaged_then_damaged_then_broken),
        cmocka_unit_test(a_sheared_coupler_without_space_is_a_second_load_path),
        cmocka_unit_test(a_slider_sticks_yields_and_sticks_again),
        cmocka_unit_test(a_shrinking_capacity_only_dissipates),
        cmocka_unit_test(a_slider_without_stiffness_carries_nothing),
        cmocka_unit_test(a_stop_is_free_within_its_range_and_the_same_on_both_sides),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
