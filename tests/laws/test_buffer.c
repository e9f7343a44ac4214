/* Buffer: every branch of the static force, the energy of its loop, its damping, and its tangents.
 */
#include "support/check.h"

#include "drive.h"
#include "laws/buffer.h"

static const Backbone draft_gear = {2, {0, 0.05}, {2e4, 4e5}, 1e9};
static const CzBufferLaw coupled = {5e7, 0.35, 5e3, 0.0, 2e7, 0.002, 0.05};
static const double step = 1e-4;

static CzBufferResponse at(const CzBufferLaw *law, const Backbone *curve, double x, double rate,
                           double offset) {
    return cz_buffer(law, backbone_value(curve, x), backbone_slope(curve, x), x, 0.0, rate, offset,
                     step);
}

static double buffer_force(Element *element, double x) {
    const CzBufferResponse response =
        at(element->law, element->backbone, x, 0.0, element->memory[0]);
    element->memory[0] = response.offset;
    return response.force;
}

static void loading_follows_the_transition_and_then_the_curve(void **state) {
    (void)state;
    Element buffer = {.force = buffer_force, .law = &coupled, .backbone = &draft_gear};
    drive(&buffer, 0.0002, 1e-5);
    assert_near(buffer.f, 5e7 * 0.0002, ROUNDING_OF_A_SUM, 0.0);
    for (double x = 0.001; x < 0.05; x += 0.001) {
        drive(&buffer, x, 1e-5);
        assert_near(buffer.f, 2e4 + 7.6e6 * x, ROUNDING_OF_A_SUM, 0.0);
    }
}

static void unloading_follows_the_transition_and_then_the_lower_curve(void **state) {
    (void)state;
    Element buffer = {.force = buffer_force, .law = &coupled, .backbone = &draft_gear};
    drive(&buffer, 0.04, 1e-5);
    const double top = buffer.f;
    drive(&buffer, 0.0385, 1e-5);
    assert_near(buffer.f, top - 5e7 * 0.0015, ROUNDING_OF_A_SUM, 0.0);
    drive(&buffer, 0.02, 1e-5);
    assert_near(buffer.f, 0.35 * (2e4 + 7.6e6 * 0.02), ROUNDING_OF_A_SUM, 0.0);
    drive(&buffer, 0.0, 1e-5);
    assert_near(buffer.f, 0.0, 0.0, 0.0);
}

static void reloading_follows_the_transition(void **state) {
    (void)state;
    Element buffer = {.force = buffer_force, .law = &coupled, .backbone = &draft_gear};
    drive(&buffer, 0.04, 1e-5);
    drive(&buffer, 0.02, 1e-5);
    const double low = buffer.f;
    drive(&buffer, 0.021, 1e-5);
    assert_near(buffer.f, low + 5e7 * 0.001, ROUNDING_OF_A_SUM, 0.0);
    drive(&buffer, 0.03, 1e-5);
    assert_near(buffer.f, 2e4 + 7.6e6 * 0.03, ROUNDING_OF_A_SUM, 0.0);
}

/* A curve k x up to X, unloaded along its share: a whole loop dissipates k X^2 / 2 - (k X + s k x1)
 * (X - x1) / 2 - s k x1^2 / 2 with x1 = X (k_t - k) / (k_t - s k). */
static void a_whole_loop_dissipates_the_closed_form_energy(void **state) {
    (void)state;
    const Backbone linear = {2, {0, 0.10}, {0, 8e5}, 1e9};
    const CzBufferLaw law = {5e7, 0.35, 0.0, 0.0, 0.0, 0.0, 0.10};
    const double k = 8e6, top = 0.06, share = 0.35;
    const double x1 = top * (5e7 - k) / (5e7 - share * k);
    const double closed = 0.5 * k * top * top - 0.5 * (k * top + share * k * x1) * (top - x1) -
                          0.5 * share * k * x1 * x1;
    Element buffer = {.force = buffer_force, .law = &law, .backbone = &linear};
    const double taken = drive(&buffer, top, 1e-6) + drive(&buffer, 0.0, 1e-6);
    assert_near(taken, closed, 1e-6, 0.0);
}

static void pulling_is_free_within_the_slack_and_then_elastic(void **state) {
    (void)state;
    assert_near(at(&coupled, &draft_gear, -0.001, 0, 0).force, 0.0, 0.0, 0.0);
    assert_near(at(&coupled, &draft_gear, -0.002, 0, 0).force, 0.0, 0.0, 0.0);
    assert_near(at(&coupled, &draft_gear, -0.005, 0, 0).force, -2e7 * 0.003, ROUNDING_OF_A_SUM,
                0.0);
    Element buffer = {.force = buffer_force, .law = &coupled, .backbone = &draft_gear};
    const double stretched = drive(&buffer, -0.01, 1e-6);
    assert_near(drive(&buffer, 0.0, 1e-6), -stretched, ROUNDING_OF_A_SUM, 0.0);
}

/* 2 mm into the stop of 1000 MN/m: 0.4 MN + 2 MN; the stop returns all of its energy. */
static void bottoming_out_is_stiff_and_without_hysteresis(void **state) {
    (void)state;
    Element buffer = {.force = buffer_force, .law = &coupled, .backbone = &draft_gear};
    drive(&buffer, 0.05, 1e-5);
    const double taken = drive(&buffer, 0.052, 1e-6);
    assert_near(buffer.f, 2.4e6, 1e-9, 0.0);
    assert_near(taken, 0.4e6 * 0.002 + 0.5 * 1e9 * 0.002 * 0.002, 1e-9, 0.0);
    const double back = -drive(&buffer, 0.05, 1e-6);
    assert_near(back, taken - 0.5 * 5e7 * 0.002 * 0.002, 1e-6, 0.0);
}

/* Over a small step, the compliance is that of the static force alone when nothing damps. */
static void the_compliances_are_the_tangents_of_the_force(void **state) {
    (void)state;
    const CzBufferLaw law = {5e7, 0.35, 0.0, 0.0, 2e7, 0.002, 0.05};
    const double small = 1e-8;
    const double places[][2] = {/* stroke and offset: on each curve, and between them */
                                {0.02, 0.02 - 0.172e6 / 5e7 - 1e-6},
                                {0.02, 0.02 - 0.0602e6 / 5e7 + 1e-6},
                                {0.02, 0.02 - 0.1e6 / 5e7},
                                {0.051, 0.051 - 0.4e6 / 5e7 - 1e-6},
                                {-0.01, 0.0}};
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        const double x = places[i][0];
        const CzBufferResponse here = at(&law, &draft_gear, x, 0, places[i][1]);
        const double up = at(&law, &draft_gear, x + small, 0, here.offset).force - here.force;
        const double down = here.force - at(&law, &draft_gear, x - small, 0, here.offset).force;
        assert_near(here.loading * up, small, 1e-5, 0.0);
        assert_near(here.unloading * down, small, 1e-5, 0.0);
    }
}

/* Force of a step at a rate v: static + tangent v h + (c1 + c2 v) v, the latter fading in. */
static void damping_adds_its_force_to_the_step(void **state) {
    (void)state;
    const CzBufferLaw law = {5e7, 0.35, 5e3, 3e4, 2e7, 0.0, 0.05};
    const double v = 2.0, x = 0.02;
    const double offset = x - (2e4 + 7.6e6 * x) / 5e7 - 1e-6;
    const CzBufferResponse fast = at(&law, &draft_gear, x, v, offset);
    assert_near(v * step / fast.loading, 7.6e6 * v * step + (5e3 + 3e4 * v) * v, 1e-12, 0.0);
    assert_near(v * step / fast.unloading, 5e7 * v * step + 5e3 * v, 1e-12, 0.0);
    const CzBufferResponse backwards = at(&law, &draft_gear, x, -v, offset);
    assert_near(v * step / backwards.loading, 7.6e6 * v * step + 5e3 * v, 1e-12, 0.0);
    const CzBufferResponse shallow = at(&law, &draft_gear, 0.005, v, 0.005 - 0.058e6 / 5e7 - 1e-6);
    assert_near(v * step / shallow.loading, 7.6e6 * v * step + 0.5 * (5e3 + 3e4 * v) * v, 1e-12,
                0.0);
}

/* The force is one smooth function of a stroke that has moved within the step, with damping and its
 * fading in over the first 10 mm. */
static void a_stroke_that_moved_has_one_tangent(void **state) {
    (void)state;
    const CzBufferLaw law = {5e7, 0.35, 5e3, 3e4, 2e7, 0.002, 0.05};
    const double strokes[] = {0.004, 0.02}, v = 2.0, small = 1e-8;
    for (size_t i = 0; i < sizeof strokes / sizeof strokes[0]; i++) {
        const double x = strokes[i], curve = 2e4 + 7.6e6 * x, offset = x - curve / 5e7;
        CzBufferResponse r[3];
        for (int k = 0; k < 3; k++) {
            const double moved = 2e-4 + (k - 1) * small, to = x + moved;
            r[k] = cz_buffer(&law, 2e4 + 7.6e6 * to, 7.6e6, to, moved, v, offset, step);
        }
        assert_near(r[1].loading * (r[2].force - r[1].force), small, 1e-4, 0.0);
        assert_near(r[1].unloading * (r[1].force - r[0].force), small, 1e-4, 0.0);
    }
}

/* A chain has one solution only where no force falls while its stroke grows, also across zero,
 * slack and stop. */
static void the_force_of_a_step_never_falls_with_its_stroke(void **state) {
    (void)state;
    const CzBufferLaw law = {5e7, 0.35, 5e3, 3e4, 2e7, 0.002, 0.05};
    const double committed[] = {-0.006, -0.001, 0.0, 0.0005, 0.004, 0.012, 0.0502};
    const double rates[] = {-3.0, 0.0, 3.0};
    for (size_t i = 0; i < sizeof committed / sizeof committed[0]; i++)
        for (size_t k = 0; k < sizeof rates / sizeof rates[0]; k++) {
            const double from = committed[i];
            const double offset = at(&law, &draft_gear, from, rates[k], 0.0).offset;
            double last = -INFINITY;
            for (double x = from - 0.015; x < from + 0.015; x += 1e-5) {
                const double force =
                    cz_buffer(&law, backbone_value(&draft_gear, x), backbone_slope(&draft_gear, x),
                              x, x - from, rates[k], offset, step)
                        .force;
                assert_true(force >= last - 1e-6);
                last = force;
            }
        }
}

/* A damper that acts during the return from tension would push, and crush a tube behind it in an
 * open interface: the force begins at zero stroke. */
static void a_drawn_gear_does_not_push_before_it_has_returned(void **state) {
    (void)state;
    const CzBufferLaw law = {5e7, 0.35, 5e4, 8e4, 2e7, 0.002, 0.05};
    for (double x = -0.03; x < 0.0; x += 1e-4) {
        const CzBufferResponse response =
            cz_buffer(&law, backbone_value(&draft_gear, x), backbone_slope(&draft_gear, x), x,
                      10.0 * step, 10.0, 0.0, step);
        assert_true(response.force <= 0.0);
    }
    const double just = 1e-9;
    const CzBufferResponse back =
        cz_buffer(&law, backbone_value(&draft_gear, just), backbone_slope(&draft_gear, just), just,
                  10.0 * step, 10.0, 0.0, step);
    /* the transition, and 8.5e6 N of damping faded in over 1e-9 of 10 mm */
    assert_near(back.force, 5e7 * just + 8.5e6 * just / CZ_FADE_LENGTH, 1e-9, 0.0);
}

/* Inside the slack a chain must have one solution too. */
static void within_the_slack_the_smallest_stiffness_remains(void **state) {
    (void)state;
    const CzBufferLaw law = {5e7, 0.35, 0.0, 0.0, 2e7, 0.002, 0.05};
    const CzBufferResponse response = at(&law, &draft_gear, -0.001, 0, 0);
    assert_near(1.0 / response.loading, CZ_SMALLEST_STIFFNESS, 1e-12, 0.0);
    assert_near(1.0 / response.unloading, CZ_SMALLEST_STIFFNESS, 1e-12, 0.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(loading_follows_the_transition_and_then_the_curve),
        cmocka_unit_test(unloading_follows_the_transition_and_then_the_lower_curve),
        cmocka_unit_test(reloading_follows_the_transition),
        cmocka_unit_test(a_whole_loop_dissipates_the_closed_form_energy),
        cmocka_unit_test(pulling_is_free_within_the_slack_and_then_elastic),
        cmocka_unit_test(bottoming_out_is_stiff_and_without_hysteresis),
        cmocka_unit_test(the_compliances_are_the_tangents_of_the_force),
        cmocka_unit_test(damping_adds_its_force_to_the_step),
        cmocka_unit_test(a_stroke_that_moved_has_one_tangent),
        cmocka_unit_test(the_force_of_a_step_never_falls_with_its_stroke),
        cmocka_unit_test(a_drawn_gear_does_not_push_before_it_has_returned),
        cmocka_unit_test(within_the_slack_the_smallest_stiffness_remains),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
