/* Vehicle properties before a run: frequencies, and the coupler as a strut. */
#include "model/built_model.h"

#include "model/strut_chain.h"
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

/* A bogie's springs in series: the secondary suspension, and two primaries. */
static double bogie_spring(double secondary, double primary) {
    return 1.0 / (1.0 / secondary + 1.0 / (2.0 * primary));
}

static void assert_folds_as(const Built *built, int n_car, const CzChainCar *car,
                            const CzChainStrut *strut) {
    double force[3];
    CzArena scratch = {0};
    assert_int_equal(cz_strut_chain_fold(n_car, car, strut, &scratch, force), CZ_OK);
    cz_arena_free(&scratch);
    for (int i = 0; i < n_car - 1; i++)
        assert_near(cz_model_interface_properties(built->model, i).critical_force, force[i],
                    ROUNDING_OF_A_SUM, 0.0);
}

static void the_critical_forces_are_those_of_the_chain_of_both_trains(void **state) {
    (void)state;
    CzVehicle car[2] = {typed_full(), typed_full()}, soft = typed_full();
    soft.bogie.secondary.stiffness = 4e5;
    soft.bogie_spacing = 18.0;
    soft.rear.coupler.hinge.stiffness = 2e5;
    struct CzProblem problem;
    typed_problem_init(&problem, 2, car, 1, &soft, 10.0);
    Built built = build_model(&problem);
    const double hinge = car[0].front.coupler.hinge.stiffness, arm = 11.4 - 1.4;
    CzChainCar chain_car[] = {{bogie_spring(8.6e5, 2.4e6), 9.5},
                              {bogie_spring(8.6e5, 2.4e6), 9.5},
                              {bogie_spring(4e5, 2.4e6), 9.0}};
    CzChainStrut strut[] = {
        {2.8, true, {{.hinge = hinge, .body_arm = arm}, {.hinge = hinge, .body_arm = arm}}},
        {2.8, true, {{.hinge = hinge, .body_arm = arm}, {.hinge = 2e5, .body_arm = arm}}}};
    assert_folds_as(&built, 3, chain_car, strut);
    assert_near(cz_model_interface_properties(built.model, 1).strut_length, 2.8,
                ROUNDING_OF_A_VALUE, 0.0);
    free_model(&built);

    /* A pivot on an end mass, which rests on its guidance and its folding stiffness. */
    problem.vehicle[2].rear.coupler.anchor = CZ_ANCHOR_END;
    built = build_model(&problem);
    strut[1].pivot[1] = (CzChainPivot){
        .hinge = 2e5,
        .body_arm = 10.6,
        .end_arm = arm - 10.6,
        .end_guide = parameter(&built, 2, CZ_PARAMETER(end[0].guide_vertical.stiffness)),
        .end_fold = parameter(&built, 2, CZ_PARAMETER(end[0].fold_pitch.stiffness))};
    assert_folds_as(&built, 3, chain_car, strut);
    free_model(&built);

    /* A wall is smooth and fixed. */
    problem.vehicle[2] = typed_wall();
    built = build_model(&problem);
    chain_car[2].spring = 0.0;
    strut[1] = (CzChainStrut){.length = 2.4,
                              .pivot = {{.hinge = hinge, .body_arm = arm}, {.body_arm = 1.0}}};
    assert_folds_as(&built, 3, chain_car, strut);
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
    assert_near(cz_model_interface_properties(built.model, 0).tube_force, 7e5, ROUNDING_OF_A_SUM,
                0.0);
    free_model(&built);

    problem.vehicle[1].rear.coupler.shear_off.force = 6.5e5;
    built = build_model(&problem);
    assert_near(cz_model_interface_properties(built.model, 0).tube_force, 6.5e5, ROUNDING_OF_A_SUM,
                0.0);
    free_model(&built);

    problem.vehicle[0].front.coupler.tube.given = false;
    problem.vehicle[1].rear.coupler.tube.given = false;
    problem.vehicle[1].rear.coupler.second_tube.given = false;
    built = build_model(&problem);
    assert_true(isnan(cz_model_interface_properties(built.model, 0).tube_force));
    free_model(&built);
}

static void rigid_and_fixed_vehicles_have_no_properties(void **state) {
    (void)state;
    const CzVehicle car = typed_rigid(40e3), wall = typed_wall();
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &wall, 10.0);
    Built built = build_model(&problem);
    for (int i = 0; i < 2; i++) {
        const CzVehicleProperties properties = cz_model_vehicle_properties(built.model, i);
        assert_true(isnan(properties.mass) && isnan(properties.bounce_frequency));
        assert_true(isnan(properties.axle_load[3]) && isnan(properties.secondary_deflection[1]));
    }
    const CzInterfaceProperties properties = cz_model_interface_properties(built.model, 0);
    assert_true(isnan(properties.strut_length) && isnan(properties.critical_force));
    assert_true(isnan(properties.anti_climber_gap));
    assert_near(built.model->hold, 0.02, 0.0, 0.0);
    free_model(&built);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unequal_ends_keep_the_sum_of_the_squares),
        cmocka_unit_test(the_critical_forces_are_those_of_the_chain_of_both_trains),
        cmocka_unit_test(the_tube_force_is_that_of_the_weaker_coupler_before_it_shears),
        cmocka_unit_test(rigid_and_fixed_vehicles_have_no_properties),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
