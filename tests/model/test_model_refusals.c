/* Problems without a model: every refusal with its sentence and its place. */
#include "model/built_model.h"

/* Vehicles: 1, 2 full (train A), 3 full (train B); the stand-in reader gives the vehicle's number
 * as line. */
static struct CzProblem problem;

static void make_problem(void) {
    const CzVehicle car[3] = {typed_full(), typed_full(), typed_full()};
    typed_problem_init(&problem, 2, car, 1, &car[2], 10.0);
}

static void expect_refusal(const char *sentence, int line) {
    CzModel *model = NULL;
    CzError error = {0};
    assert_int_equal(cz_model_build(&problem, 0, &model, &error), CZ_STATUS_INPUT);
    assert_null(model);
    assert_int_equal(error.status, CZ_STATUS_INPUT);
    if (strstr(error.message, sentence) == NULL)
        fail_msg("'%s' is not in '%s'", sentence, error.message);
    assert_int_equal(error.line, line);
    /* The error pointer may be NULL. */
    assert_int_equal(cz_model_build(&problem, 0, &model, NULL), CZ_STATUS_INPUT);
}

static CzVehicle *second(void) {
    make_problem();
    return &problem.vehicle[1];
}

static void the_body_must_have_a_mass_left(void **state) {
    (void)state;
    second()->mass = 14000.0;
    expect_refusal("car A2: mass 14000 kg leaves no mass for the body", 2);
    second()->mass = -1.0;
    expect_refusal("car A2: mass is -1; it must be positive", 2);
    second()->mass = NAN;
    expect_refusal("it must be positive", 2);
    second()->front.mass = 0.0;
    expect_refusal("mass of the front end is 0", 2);
}

static void a_full_car_needs_length_ends_and_bogies_under_it(void **state) {
    (void)state;
    second()->length = NAN;
    expect_refusal("car A2: length is nan", 2);
    second()->front.given = false;
    expect_refusal("a full vehicle needs both ends; its front is missing", 2);
    second()->rear.given = false;
    expect_refusal("its rear is missing", 2);
    second()->bogie_spacing = 0.0;
    expect_refusal("bogie spacing is 0", 2);
    CzVehicle *car = second();
    car->front.mass = 15000.0;
    car->front.distance = 30.0;
    expect_refusal("the rear bogie carries no load at rest", 2);
}

static void stages_must_be_possible(void **state) {
    (void)state;
    second()->front.coupler.tube.stages[0].stroke = -0.003;
    expect_refusal("car A2, front coupler tube: stage 1 has a stroke of -3 mm", 2);
    second()->front.coupler.tube.stages[0].force = NAN;
    expect_refusal("stage 1 has a force of nan kN", 2);
    second()->front.anti_climber.stages[0].end_force = -1e3;
    expect_refusal("front anti-climber: stage 1 ends at -1 kN", 2);
    second()->front.coupler.tube.trigger = -1e3;
    expect_refusal("trigger of -1 kN", 2);
    second()->front.anti_climber.trigger = -1e3;
    expect_refusal("trigger of -1 kN", 2);
    make_problem();
    problem.vehicle[2].rear.coupler.tube.n_stages = 0;
    expect_refusal("car B1, rear coupler tube: give either stages or a curve, not none", 3);
}

static void buffers_must_not_create_energy(void **state) {
    (void)state;
    second()->front.coupler.buffer.stages[0].force = 1e4; /* below the preload */
    expect_refusal("car A2, front coupler buffer: stage 1 ends at 10 kN, after 20 kN", 2);
    second()->front.coupler.buffer.n_stages = 0;
    expect_refusal("has no stages", 2);
    second()->front.coupler.buffer.stages[0].stroke = 0.004;
    expect_refusal("faster than the transition stiffness of 50 MN/m", 2);
}

static void ends_must_not_return_more_energy_than_they_absorb(void **state) {
    (void)state;
    second()->front.stages[3].stroke = 0.01; /* 300 MN/m */
    expect_refusal("car A2, front end: stage 4 rises by 300 MN/m", 2);
}

static CzTable table(int n, double first_x, double first_y) {
    CzTable made = {.given = true, .n_point = n};
    for (int i = 0; i < n; i++) {
        made.x[i] = first_x + 0.1 * i;
        made.y[i] = first_y + 1e5 * i;
    }
    return made;
}

static void curves_must_be_possible(void **state) {
    (void)state;
    CzTube *tube = &second()->front.coupler.tube;
    tube->curve = table(3, 0.0, 5e5);
    expect_refusal("give either stages or a curve, not both", 2);
    tube->n_stages = 0;
    tube->curve.x[2] = 0.05;
    expect_refusal("the strokes must increase; point 3 does not", 2);
    tube->curve = table(3, 0.0, 5e5);
    tube->curve.y[1] = -2e3;
    expect_refusal("point 2 has a force of -2 kN", 2);
    tube->curve = table(1, 0.0, 5e5);
    expect_refusal("at least two points", 2);
    tube->curve = table(3, 0.0, 5e5);
    tube->curve.basis = CZ_BASIS_DYNAMIC;
    tube->rate_factor = 0.01;
    expect_refusal("a dynamic curve already contains the rate effect", 2);
    CzEnd *end = &second()->front;
    end->n_stages = 0;
    end->curve = table(3, 0.0, 1e3);
    expect_refusal("must start at stroke 0 with force 0", 2);
}

static void trains_and_scenarios_must_be_there(void **state) {
    (void)state;
    const char *const strangers[] = {"A", "C"}, *const twice[] = {"A", "A"};
    make_problem();
    problem.input.n_trains = 1;
    expect_refusal("a collision needs two trains; the file has 1", 0);
    make_problem();
    problem.input.n_scenarios = 1;
    problem.scenario[0].trains = (CzTexts){2, strangers};
    expect_refusal("names train 'C', which is not in the file", 0);
    problem.scenario[0].trains = (CzTexts){2, twice};
    expect_refusal("must name two different trains", 0);
    problem.scenario[0].trains = (CzTexts){1, twice};
    expect_refusal("must name two different trains", 0);
    problem.scenario[0].trains = (CzTexts){0, NULL};
    problem.scenario[0].perturbed_interface = "A2-B1";
    expect_refusal("perturbs 'A2-B1', which is not an inner interface", 0);
    make_problem();
    problem.train[1].n_vehicles = 0;
    expect_refusal("train 'B' has no vehicles", 0);
    make_problem();
    CzModel *model = NULL;
    CzError error = {0};
    assert_int_equal(cz_model_build(&problem, 7, &model, &error), CZ_STATUS_INPUT);
    assert_non_null(strstr(error.message, "no scenario number 7"));
}

static void walls_do_not_move_and_do_not_meet(void **state) {
    (void)state;
    const CzVehicle wall = typed_wall();
    make_problem();
    problem.vehicle[2] = wall;
    problem.train[1].speed = -1.0;
    expect_refusal("car B1 is fixed, but its train moves at -1 m/s", 0);
    make_problem();
    problem.vehicle[1] = problem.vehicle[2] = wall;
    problem.train[0].speed = 0.0;
    expect_refusal("interface A2-B1 is between two fixed vehicles", 0);
}

static void parts_must_not_overlap_where_couplers_touch(void **state) {
    (void)state;
    make_problem();
    problem.vehicle[0].front.coupler.gap = 0.7;
    expect_refusal("other parts of interface A1-A2 overlap by 60 mm when its couplers touch", 1);
    make_problem();
    problem.vehicle[0].front.coupler.gap = 0.5;
    const CzSuperstructure foremost = {
        .given = true, .gap = 0.1, .height = 2.0, .strength = 3e5, .stiffness = 5e7};
    problem.vehicle[0].front.superstructure = problem.vehicle[1].rear.superstructure = foremost;
    expect_refusal("other parts of interface A1-A2 overlap by 300 mm when its couplers touch", 1);
}

static void a_time_step_above_a_bound_names_the_element(void **state) {
    (void)state;
    make_problem();
    problem.input.simulation.time_step = 5e-3;
    expect_refusal(
        "the time step of 5 ms is too long: the largest stable step of wheel on elastic ", 0);
}

static void a_candidate_with_more_stages_is_refused(void **state) {
    (void)state;
    make_problem();
    Built built = build_model(&problem);
    CzVehicle other[3];
    memcpy(other, problem.vehicle, sizeof other);
    CzAntiClimber *anti_climber = &other[1].front.anti_climber;
    anti_climber->n_stages = 2;
    anti_climber->stages[1] = anti_climber->stages[0];
    CzError error = {0};
    assert_int_equal(cz_model_fill(built.model, other, 0, built.lanes, &error), CZ_STATUS_INPUT);
    assert_non_null(strstr(error.message, "has more stages than in the problem file"));
    /* The place is that of the same field in the problem's own vehicles. */
    assert_int_equal(error.line, 2);
    free_model(&built);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_body_must_have_a_mass_left),
        cmocka_unit_test(a_full_car_needs_length_ends_and_bogies_under_it),
        cmocka_unit_test(stages_must_be_possible),
        cmocka_unit_test(buffers_must_not_create_energy),
        cmocka_unit_test(ends_must_not_return_more_energy_than_they_absorb),
        cmocka_unit_test(curves_must_be_possible),
        cmocka_unit_test(trains_and_scenarios_must_be_there),
        cmocka_unit_test(walls_do_not_move_and_do_not_meet),
        cmocka_unit_test(parts_must_not_overlap_where_couplers_touch),
        cmocka_unit_test(a_time_step_above_a_bound_names_the_element),
        cmocka_unit_test(a_candidate_with_more_stages_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
