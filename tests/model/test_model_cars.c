/* Cars of a model: names, masses, loads at rest, running gear, wheels, brakes. */
#include "model/built_model.h"

#define GRAVITY 9.80665

static void cars_and_interfaces_have_names_along_the_track(void **state) {
    (void)state;
    const CzVehicle car[2] = {typed_rigid(40e3), typed_rigid(30e3)};
    struct CzProblem problem;
    typed_problem_init(&problem, 2, car, 2, car, 10.0);
    problem.vehicle[3].name = "wagon";
    Built built = build_model(&problem);
    static const char *const cars[] = {"A1", "A2", "B1", "wagon"};
    static const char *const interfaces[] = {"A1-A2", "A2-B1", "B1-wagon"};
    assert_int_equal(cz_model_n_vehicle(built.model), 4);
    assert_int_equal(cz_model_n_interface(built.model), 3);
    assert_int_equal(cz_model_colliding_interface(built.model), 1);
    for (int i = 0; i < 4; i++)
        assert_string_equal(cz_model_vehicle_name(built.model, i), cars[i]);
    for (int i = 0; i < 3; i++)
        assert_string_equal(cz_model_interface_name(built.model, i), interfaces[i]);
    free_model(&built);
}

static void a_scenario_picks_its_trains_and_speeds(void **state) {
    (void)state;
    const CzVehicle light = typed_rigid(30e3), heavy = typed_rigid(50e3);
    const char *const names[] = {"B", "A"};
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &light, 1, &heavy, 10.0);
    problem.input.n_scenarios = 1;
    problem.scenario[0].trains = (CzTexts){2, names};
    problem.scenario[0].speed = 7.0;
    problem.scenario[0].partner_speed = -2.0;
    Built built = build_model(&problem);
    assert_string_equal(cz_model_interface_name(built.model, 0), "B1-A1");
    assert_near(mass_of(&built, 0, CZ_DOF(body.x)), 50e3, 0.0, 0.0);
    assert_near(velocity_of(&built, 0, CZ_DOF(body.x)), 7.0, 0.0, 0.0);
    assert_near(velocity_of(&built, 1, CZ_DOF(body.x)), -2.0, 0.0, 0.0);
    free_model(&built);
}

static void a_rigid_car_has_one_coordinate(void **state) {
    (void)state;
    const CzVehicle car = typed_rigid(40e3), wall = typed_wall();
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &wall, 10.0);
    Built built = build_model(&problem);
    assert_near(parameter(&built, 0, CZ_PARAMETER(inverse.body.mass)), 1.0 / 40e3,
                ROUNDING_OF_A_VALUE, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(inverse.body.inertia_pitch)), 0.0, 0.0, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(slaved_ends[0])), 1.0, 0.0, 0.0);
    assert_near(parameter(&built, 1, CZ_PARAMETER(inverse.body.mass)), 0.0, 0.0, 0.0);
    assert_near(parameter(&built, 1, CZ_PARAMETER(slaved_ends[0])), 1.0, 0.0, 0.0);
    for (int dof = 0; dof < CZ_N_DOF; dof++) {
        assert_near(mass_of(&built, 0, dof), dof == CZ_DOF(body.x) ? 40e3 : 0.0, 0.0, 0.0);
        assert_near(mass_of(&built, 1, dof), 0.0, 0.0, 0.0);
    }
    assert_false(built.lanes->has.full_cars);
    free_model(&built);
}

static void all_masses_of_a_full_car_move_at_its_speed_and_add_up(void **state) {
    (void)state;
    const CzVehicle car = typed_full();
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &car, 10.0);
    Built built = build_model(&problem);
    double mass = 0.0, momentum = 0.0;
    for (int dof = 0; dof < CZ_N_DOF; dof++) {
        const bool along = cz_axis_of(dof) == CZ_AXIS_ALONG;
        mass += along ? mass_of(&built, 0, dof) : 0.0;
        momentum += along ? mass_of(&built, 0, dof) * velocity_of(&built, 0, dof) : 0.0;
    }
    assert_near(mass, car.mass, ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(momentum, car.mass * 10.0, ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(velocity_of(&built, 0, CZ_DOF(wheelset[2].spin)), 10.0 / 0.43, ROUNDING_OF_A_VALUE,
                0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(inverse.body.mass)), 1.0 / (32000.0 - 2000.0),
                ROUNDING_OF_A_FORMULA, 0.0);
    assert_true(built.lanes->has.full_cars);
    free_model(&built);
}

static void load_absorbers_and_mass_factor_go_into_the_body(void **state) {
    (void)state;
    CzVehicle car = typed_full();
    car.payload = 8000.0;
    car.front.anti_climber.mass_per_stroke = 120.0; /* 2 devices of 0.3 m */
    car.rear.coupler.tube.mass_per_stroke = 60.0;   /* 0.25 m */
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &car, 10.0);
    problem.input.n_scenarios = 1;
    problem.scenario[0].mass_factor = 1.1;
    problem.scenario[0].payload_share = 0.5;
    Built built = build_model(&problem);
    const double body = 30000.0 * 1.1 + 4000.0 + 120.0 * 2 * 0.3 + 60.0 * 0.25;
    assert_near(mass_of(&built, 0, CZ_DOF(body.x)), body, ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(mass_of(&built, 0, CZ_DOF(body.pitch)), car.pitch_inertia * 1.1,
                ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(cz_model_vehicle_properties(built.model, 0).mass, body + car.mass - 30000.0,
                ROUNDING_OF_A_FORMULA, 0.0);
    free_model(&built);
}

static void loads_at_rest_carry_the_weight_and_its_moment(void **state) {
    (void)state;
    CzVehicle car = typed_full();
    car.front.mass = 2500.0;
    car.front.distance = 10.0;
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &car, 10.0);
    Built built = build_model(&problem);
    const CzVehicleProperties properties = cz_model_vehicle_properties(built.model, 0);
    double sum = 0.0;
    for (int axle = 0; axle < 4; axle++)
        sum += properties.axle_load[axle];
    assert_near(sum, car.mass * GRAVITY, ROUNDING_OF_A_FORMULA, 0.0);
    const double moment = (2500.0 * 10.0 - 1000.0 * 10.6) * GRAVITY;
    const double front = parameter(&built, 0, CZ_PARAMETER(secondary_preload[1]));
    const double rear = parameter(&built, 0, CZ_PARAMETER(secondary_preload[0]));
    assert_near((front - rear) * 9.5, moment, ROUNDING_OF_A_SUM, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(primary_preload[3])),
                (front + 2615.0 * GRAVITY) / 2.0, ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(properties.secondary_deflection[1], front / 8.6e5, ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(properties.primary_deflection[0], (rear + 2615.0 * GRAVITY) / 2.0 / 2.4e6,
                ROUNDING_OF_A_FORMULA, 0.0);
    free_model(&built);
}

static void the_wheels_stand_on_the_rails_with_their_load(void **state) {
    (void)state;
    const CzVehicle car = typed_full();
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &car, 10.0);
    Built built = build_model(&problem);
    const double hertz = parameter(&built, 0, CZ_PARAMETER(wheel.hertz));
    /* K_H of one wheel of 0.43 m, worn: 1.140e11 N/m^1.5. */
    assert_near(hertz, 2.0 * pow(3.86e-8 * pow(0.43, -0.115), -1.5), 1e-13, 0.0);
    assert_near(hertz / 2.0, 1.140e11, 1e-3, 0.0);
    for (int axle = 0; axle < 4; axle++) {
        const double d = parameter(&built, 0, CZ_PARAMETER(wheel.indentation[axle]));
        const double load = cz_model_vehicle_properties(built.model, 0).axle_load[axle];
        assert_near(hertz * d * sqrt(d), load, 1e-14, 0.0);
    }
    free_model(&built);

    problem.vehicle[0].bogie.tread = CZ_TREAD_CONICAL;
    built = build_model(&problem);
    assert_near(parameter(&built, 0, CZ_PARAMETER(wheel.hertz)),
                2.0 * pow(4.57e-8 * pow(0.43, -0.149), -1.5), ROUNDING_OF_A_FORMULA, 0.0);
    free_model(&built);
}

static void brakes_act_on_the_axles_from_the_front(void **state) {
    (void)state;
    const CzVehicle car = typed_full();
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &car, 10.0);
    problem.input.n_scenarios = 1;
    problem.train[1].brake.ratio = 0.1;
    problem.train[1].brake.axle_share = 0.5;
    problem.train[0].brake.axle_share = 1.0;
    problem.scenario[0].brake_ratio = 0.2;
    Built built = build_model(&problem);
    const double load = cz_model_vehicle_properties(built.model, 0).axle_load[0];
    for (int axle = 0; axle < 4; axle++) {
        const CzParameter moment = CZ_PARAMETER(wheel.brake_moment[axle]);
        assert_near(parameter(&built, 0, moment), 0.2 * load * 0.43, ROUNDING_OF_A_FORMULA, 0.0);
        assert_near(parameter(&built, 1, moment), axle >= 2 ? 0.1 * load * 0.43 : 0.0,
                    ROUNDING_OF_A_FORMULA, 0.0);
    }
    free_model(&built);
}

static void a_scenarios_friction_keeps_the_ratio_of_sliding_friction(void **state) {
    (void)state;
    const CzVehicle car = typed_full();
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &car, 10.0);
    problem.input.simulation.adhesion.sliding_friction = 0.15;
    problem.input.n_scenarios = 1;
    Built built = build_model(&problem);
    assert_near(parameter(&built, 0, CZ_PARAMETER(wheel.friction_peak)), 0.3, 0.0, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(wheel.friction_sliding)), 0.15,
                ROUNDING_OF_A_VALUE, 0.0);
    const double load = cz_model_vehicle_properties(built.model, 0).axle_load[0];
    assert_near(parameter(&built, 0, CZ_PARAMETER(wheel.creep_stiffness)),
                0.3 * load / (0.01 * 0.006), ROUNDING_OF_A_FORMULA, 0.0);
    free_model(&built);

    problem.scenario[0].friction = 0.1;
    built = build_model(&problem);
    assert_near(parameter(&built, 0, CZ_PARAMETER(wheel.friction_peak)), 0.1, 0.0, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(wheel.friction_sliding)), 0.05,
                ROUNDING_OF_A_VALUE, 0.0);
    free_model(&built);
}

static void springs_that_carry_tension_never_go_slack(void **state) {
    (void)state;
    CzVehicle car = typed_full();
    car.bogie.secondary.carries_tension = true;
    car.bogie.primary.lift_gap = NAN;
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &car, 10.0);
    Built built = build_model(&problem);
    assert_near(parameter(&built, 0, CZ_PARAMETER(secondary_preload[0])), 1e30, 0.0, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(primary.lift_gap)), 1e30, 0.0, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(secondary.blow_off_rate)), 2e4 / 4e4,
                ROUNDING_OF_A_VALUE, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(primary.blow_off_rate)), 1e30, 0.0, 0.0);
    assert_false(built.model->car[0].has_stops);
    assert_near(parameter(&built, 1, CZ_PARAMETER(primary.stiffness)), 2.4e6, 0.0, 0.0);
    free_model(&built);
}

static void locked_ends_are_stiff_and_free_ones_as_given(void **state) {
    (void)state;
    CzVehicle car = typed_full();
    car.front.vertical = CZ_GUIDANCE_FREE;
    car.rear.pitch = CZ_GUIDANCE_LOCKED;
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &car, 10.0);
    Built built = build_model(&problem);
    assert_near(parameter(&built, 0, CZ_PARAMETER(end[1].guide_vertical.stiffness)), 1e8, 0.0, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(end[0].guide_vertical.stiffness)),
                1000.0 * 600.0 * 600.0, 0.0, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(end[1].fold_pitch.stiffness)), 1e8, 0.0, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(end[1].fold_pitch.moment)), 2e6, 0.0, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(end[0].fold_pitch.stiffness)),
                600.0 * 600.0 * 600.0, 0.0, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(end[0].fold_pitch.moment)), 1e30, 0.0, 0.0);
    free_model(&built);
}

static void crush_zones_follow_their_stages(void **state) {
    (void)state;
    CzVehicle car = typed_full();
    car.rear.n_stages = 0; /* no crush zone: stiff */
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &car, 10.0);
    Built built = build_model(&problem);
    assert_near(curve_at(built.lanes, 0, CZ_CURVE(end[1]), 0.02), 1.2e6, 1e-12, 0.0);
    assert_near(curve_at(built.lanes, 0, CZ_CURVE(end[1]), 0.08), 1.0e6, 1e-12, 0.0);
    assert_near(curve_at(built.lanes, 0, CZ_CURVE(end[1]), 0.40), 1.5e6, 1e-12, 0.0);
    assert_near(curve_at(built.lanes, 0, CZ_CURVE(end[1]), 0.60), 4.5e6, ROUNDING_OF_A_SUM, 0.0);
    assert_near(built.lanes->curve[CZ_CURVE(end[1])].usable[0], 0.60, ROUNDING_OF_A_VALUE, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(end[1].crush.tension)), 1.2e6 / 0.02,
                ROUNDING_OF_A_SUM, 0.0);
    assert_near(curve_at(built.lanes, 0, CZ_CURVE(end[0]), 0.001), 1e6, ROUNDING_OF_A_SUM, 0.0);
    free_model(&built);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cars_and_interfaces_have_names_along_the_track),
        cmocka_unit_test(a_scenario_picks_its_trains_and_speeds),
        cmocka_unit_test(a_rigid_car_has_one_coordinate),
        cmocka_unit_test(all_masses_of_a_full_car_move_at_its_speed_and_add_up),
        cmocka_unit_test(load_absorbers_and_mass_factor_go_into_the_body),
        cmocka_unit_test(loads_at_rest_carry_the_weight_and_its_moment),
        cmocka_unit_test(the_wheels_stand_on_the_rails_with_their_load),
        cmocka_unit_test(brakes_act_on_the_axles_from_the_front),
        cmocka_unit_test(a_scenarios_friction_keeps_the_ratio_of_sliding_friction),
        cmocka_unit_test(springs_that_carry_tension_never_go_slack),
        cmocka_unit_test(locked_ends_are_stiff_and_free_ones_as_given),
        cmocka_unit_test(crush_zones_follow_their_stages),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
