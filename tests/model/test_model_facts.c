/* Facts before a run: frequencies, and the coupler as a strut. */
#include "model/built_model.h"

#include "model/vertical_modes.h"

static CzVerticalModes modes_of(const CzVehicle *vehicle) {
    CzStatics statics = {.body_inertia = vehicle->pitch_inertia};
    statics.body_mass = vehicle->mass - 2.0 * vehicle->bogie.mass -
                        4.0 * vehicle->bogie.wheelset_mass - vehicle->front.mass -
                        vehicle->rear.mass;
    return cz_vertical_modes(vehicle, &statics);
}

/* The trace of M^-1 K is the sum of the squared frequencies, whatever couples bounce and pitch. */
static void unequal_ends_keep_the_sum_of_the_squares(void **state) {
    (void)state;
    CzVehicle car = typed_full();
    car.front.mass = 3000.0;
    const CzVerticalModes modes = modes_of(&car);
    const double ends = car.front.mass + car.rear.mass;
    const double body = car.mass - 2.0 * 2615.0 - 4.0 * 1813.0 - ends;
    const double moment = (car.front.mass - car.rear.mass) * 10.6, mass = body + ends;
    const double inertia = car.pitch_inertia + 1200.0 + ends * 10.6 * 10.6 - moment * moment / mass;
    const double centre = moment / mass;
    const double arms = (9.5 - centre) * (9.5 - centre) + (9.5 + centre) * (9.5 + centre);
    const double trace = 2.0 * 8.6e5 / mass + 8.6e5 * arms / inertia +
                         2.0 * (8.6e5 + 4.8e6) / 2615.0 + 2.0 * 4.8e6 * 1.28 * 1.28 / 1476.0;
    double sum = 0.0;
    for (int mode = 0; mode < CZ_N_VERTICAL_MODE; mode++)
        sum += pow(2.0 * 3.14159265358979323846 * modes.frequency[mode], 2.0);
    assert_near(sum, trace, 1e-12, 0.0);
}

/* Stiffness of the pivot against a vertical force: unit force on a body on two springs, solved as
 * two equations for heave and pitch. */
static double pivot_stiffness(double spring, double half_spacing, double arm) {
    const double heave = 1.0 / (2.0 * spring);
    const double pitch = arm / (2.0 * spring * half_spacing * half_spacing);
    return 1.0 / (heave + arm * pitch);
}

static void the_critical_force_of_the_strut_is_that_of_the_weaker_side(void **state) {
    (void)state;
    CzVehicle car = typed_full(), soft = typed_full();
    soft.bogie.secondary.stiffness = 4e5;
    soft.rear.coupler.hinge.stiffness = 2e5;
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &soft, 10.0);
    Built built = build_model(&problem);
    const double spring = 1.0 / (1.0 / 4e5 + 1.0 / 4.8e6);
    const double length = 2.8, arm = 11.4 - 1.4;
    const double expected = pivot_stiffness(spring, 9.5, arm) * length / 2.0 + 2.0 * 2e5 / length;
    const CzInterfaceFacts facts = cz_model_interface_facts(built.model, 0);
    assert_near(facts.critical_force, expected, 1e-13, 0.0);
    assert_near(facts.strut_length, length, 1e-15, 0.0);
    free_model(&built);

    /* A pivot on the end mass is as far from the body's centre of gravity. */
    problem.vehicle[1].rear.coupler.anchor = CZ_ANCHOR_END;
    built = build_model(&problem);
    assert_near(cz_model_interface_facts(built.model, 0).critical_force, expected, 1e-13, 0.0);
    free_model(&built);
}

static void the_tube_force_is_that_of_the_weaker_coupler_before_it_shears(void **state) {
    (void)state;
    CzVehicle strong = typed_full(), weak = typed_full();
    strong.front.coupler.tube.trigger = 9e5;
    weak.rear.coupler.second_tube = weak.rear.coupler.tube;
    weak.rear.coupler.second_tube.stages[0].force = 7e5;
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &strong, 1, &weak, 10.0);
    Built built = build_model(&problem);
    assert_near(cz_model_interface_facts(built.model, 0).tube_force, 7e5, 1e-12, 0.0);
    free_model(&built);

    problem.vehicle[1].rear.coupler.shear_off.force = 6.5e5;
    built = build_model(&problem);
    assert_near(cz_model_interface_facts(built.model, 0).tube_force, 6.5e5, 1e-12, 0.0);
    free_model(&built);

    problem.vehicle[0].front.coupler.tube.given = false;
    problem.vehicle[1].rear.coupler.tube.given = false;
    problem.vehicle[1].rear.coupler.second_tube.given = false;
    built = build_model(&problem);
    assert_true(isnan(cz_model_interface_facts(built.model, 0).tube_force));
    free_model(&built);
}

static void rigid_and_fixed_vehicles_have_no_facts(void **state) {
    (void)state;
    const CzVehicle car = typed_rigid(40e3), wall = typed_wall();
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &wall, 10.0);
    Built built = build_model(&problem);
    for (int i = 0; i < 2; i++) {
        const CzVehicleFacts facts = cz_model_vehicle_facts(built.model, i);
        assert_true(isnan(facts.mass) && isnan(facts.bounce_frequency));
        assert_true(isnan(facts.axle_load[3]) && isnan(facts.secondary_deflection[1]));
    }
    const CzInterfaceFacts facts = cz_model_interface_facts(built.model, 0);
    assert_true(isnan(facts.strut_length) && isnan(facts.critical_force));
    assert_true(isnan(facts.anti_climber_gap));
    assert_near(built.model->hold, 0.02, 0.0, 0.0);
    free_model(&built);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unequal_ends_keep_the_sum_of_the_squares),
        cmocka_unit_test(the_critical_force_of_the_strut_is_that_of_the_weaker_side),
        cmocka_unit_test(the_tube_force_is_that_of_the_weaker_coupler_before_it_shears),
        cmocka_unit_test(rigid_and_fixed_vehicles_have_no_facts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
