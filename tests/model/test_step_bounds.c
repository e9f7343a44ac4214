/* Step bounds: the formula against the scheme itself, the elements that are named, the choice of
 * the step. */
#include "model/built_model.h"

#include "integrate/two_step.h"

/* Largest |x| of a damped oscillator w = 1 after many steps from x = 1, by the two-step scheme with
 * the force of the last state, as the kernel uses it. */
static double grown(double damping_ratio, double step) {
    double x = 1.0, v = 0.0, a = -1.0, last = 0.0, largest = 0.0;
    for (int i = 0; i < 4000; i++) {
        cz_two_step_advance(1, step, i == 0, &x, &v, &a, &last);
        a = -x - 2.0 * damping_ratio * v;
        largest = fmax(largest, fabs(x));
        if (largest > 1e6)
            break;
    }
    return largest;
}

static const CzStepBound *bound_of(const CzModel *model, const char *element) {
    for (int i = 0; i < cz_model_n_step_bound(model); i++)
        if (strcmp(cz_model_step_bound(model, i)->element, element) == 0)
            return cz_model_step_bound(model, i);
    fail_msg("there is no bound of '%s'", element);
    return NULL;
}

/* One rigid car against a wall through an elastic-plastic chain: stiffness and mass are known. The
 * damping ratio is set by the anti-climber's damper. */
static double bound_of_oscillator(double stiffness, double mass, double damping_ratio) {
    CzVehicle car = typed_rigid(mass);
    const CzVehicle wall = typed_wall();
    CzAntiClimber *anti_climber = &car.front.anti_climber;
    anti_climber->given = true;
    anti_climber->count = 1;
    anti_climber->gap = 0.0;
    anti_climber->n_stages = 1;
    anti_climber->stages[0] = (CzStage){true, 0.5, 1e6, NAN, CZ_ZONE_CRUSH};
    anti_climber->stiffness = stiffness;
    anti_climber->damping = 2.0 * damping_ratio * sqrt(stiffness * mass);
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &wall, 10.0);
    Built built = build_model(&problem);
    const double bound = bound_of(built.model, damping_ratio > 0.5 ? "anti-climber damper A1-B1"
                                                                   : "anti-climber A1-B1")
                             ->bound;
    free_model(&built);
    return bound * sqrt(stiffness / mass);
}

static void the_scheme_is_stable_below_the_bound_and_not_above(void **state) {
    (void)state;
    static const double ratios[] = {0.0, 0.1, 0.4, 0.7, 1.0, 2.0};
    for (size_t i = 0; i < sizeof ratios / sizeof ratios[0]; i++) {
        const double bound = bound_of_oscillator(1e9, 1000.0, ratios[i]);
        assert_true(grown(ratios[i], 0.99 * bound) < 50.0);
        assert_true(grown(ratios[i], 1.01 * bound) > 1e6);
    }
    assert_near(bound_of_oscillator(1e9, 1000.0, 0.0), 2.0, ROUNDING_OF_A_FORMULA, 0.0);
}

static void every_element_of_a_full_car_is_named_and_the_smallest_comes_first(void **state) {
    (void)state;
    static const char *const elements[] = {
        "wheel-rail contact A1",
        "creep A1",
        "brake A1",
        "primary suspension A1",
        "secondary suspension A1",
        "traction link A1",
        "axle guidance A1",
        "crush zone rear end A1",
        "crush zone front end A1",
        "rear end guidance A1",
        "front end guidance A1",
        "rear end hinge A1",
        "front end hinge A1",
        "anti-climber A1-B1",
        "anti-climber ribs A1-B1",
        "coupler buffer A1-B1",
        "swing stop A1-B1",
        "wheel-rail contact B1",
    };
    const CzVehicle car = typed_full();
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &car, 10.0);
    problem.input.simulation.track = CZ_TRACK_RIGID;
    Built built = build_model(&problem);
    for (size_t i = 0; i < sizeof elements / sizeof elements[0]; i++)
        assert_true(bound_of(built.model, elements[i])->bound > 0.0);
    for (int i = 1; i < cz_model_n_step_bound(built.model); i++)
        assert_true(cz_model_step_bound(built.model, i)->bound >=
                    cz_model_step_bound(built.model, i - 1)->bound);
    free_model(&built);
}

static void wheel_and_rail_are_taken_at_four_times_the_static_load(void **state) {
    (void)state;
    const CzVehicle car = typed_full();
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &car, 10.0);
    problem.input.simulation.track = CZ_TRACK_RIGID;
    Built built = build_model(&problem);
    const double hertz = parameter(&built, 0, CZ_PARAMETER(wheel.hertz));
    const double load = 4.0 * cz_model_vehicle_properties(built.model, 0).axle_load[0];
    const double tangent = 1.5 * pow(hertz, 2.0 / 3.0) * pow(load, 1.0 / 3.0);
    const double square = (tangent + 2.4e6 + 2e7) / 1813.0, rate = 8e3 / 1813.0;
    assert_near(bound_of(built.model, "wheel-rail contact A1")->bound,
                2.0 / (sqrt(square + rate * rate) + rate), ROUNDING_OF_A_SUM, 0.0);
    free_model(&built);
}

/* On an elastic rail one bound of contact and rail replaces that of the contact; the step must
 * resolve the modes up to 1.5 kHz: 2 / (2 pi 1500 Hz). Contact and rail alone allow a longer step.
 */
static void a_wheel_on_an_elastic_rail_has_a_bound_of_its_own(void **state) {
    (void)state;
    const CzVehicle car = typed_full();
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &car, 10.0);
    problem.input.simulation.track = CZ_TRACK_MODAL;
    Built built = build_model(&problem);
    assert_near(bound_of(built.model, "wheel on elastic rail A1")->bound,
                2.0 / (2.0 * 3.14159265358979 * 1500.0), 1e-9, 0.0);
    assert_near(bound_of(built.model, "wheel on elastic rail B1")->bound,
                bound_of(built.model, "wheel on elastic rail A1")->bound, 0.0, 0.0);
    free_model(&built);
}

/* 2 c2 v, with v limited by the tube's 600 kN. */
static void hydraulic_damping_counts_up_to_the_tube_force(void **state) {
    (void)state;
    CzVehicle car = typed_full();
    car.front.coupler.anchor = car.rear.coupler.anchor = CZ_ANCHOR_END;
    car.front.coupler.buffer.quadratic_damping = 4e5;
    const double mobility = 2.0 * (1.0 / 1000.0 + (0.7 - 1.2) * (0.7 - 1.2) / 600.0);
    const double stiffness = 1.0 / (2.0 / 1e9 + 2.0 / 2e8);
    static const double speeds[] = {0.5, 10.0};
    for (int i = 0; i < 2; i++) {
        struct CzProblem problem;
        typed_problem_init(&problem, 1, &car, 1, &car, speeds[i]);
        Built built = build_model(&problem);
        const double force = fmin(4e5 * speeds[i] * speeds[i], 6e5);
        const double rate = (5e3 + 2.0 * sqrt(4e5 * force)) * mobility;
        assert_near(bound_of(built.model, "coupler buffer damper A1-B1")->bound,
                    2.0 / (sqrt(stiffness * mobility + rate * rate) + rate), 1e-12, 0.0);
        free_model(&built);
    }
}

static void the_step_is_half_the_smallest_bound_or_a_tenth_of_a_millisecond(void **state) {
    (void)state;
    CzVehicle car = typed_full();
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &car, 10.0);
    Built built = build_model(&problem);
    assert_near(cz_model_time_step(built.model), 1e-4, 0.0, 0.0);
    free_model(&built);

    problem.vehicle[0].bogie.link.damping = 5e7; /* m / c far below the rest */
    built = build_model(&problem);
    const CzStepBound *smallest = cz_model_step_bound(built.model, 0);
    assert_string_equal(smallest->element, "traction link damper A1");
    assert_true(smallest->bound < 1e-4);
    assert_near(cz_model_time_step(built.model), 0.5 * smallest->bound, 1e-15, 0.0);
    free_model(&built);

    problem.vehicle[0].bogie.link.damping = 5e4;
    problem.input.simulation.time_step = 2e-5;
    built = build_model(&problem);
    assert_near(cz_model_time_step(built.model), 2e-5, 0.0, 0.0);
    free_model(&built);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_scheme_is_stable_below_the_bound_and_not_above),
        cmocka_unit_test(every_element_of_a_full_car_is_named_and_the_smallest_comes_first),
        cmocka_unit_test(wheel_and_rail_are_taken_at_four_times_the_static_load),
        cmocka_unit_test(a_wheel_on_an_elastic_rail_has_a_bound_of_its_own),
        cmocka_unit_test(hydraulic_damping_counts_up_to_the_tube_force),
        cmocka_unit_test(the_step_is_half_the_smallest_bound_or_a_tenth_of_a_millisecond),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
