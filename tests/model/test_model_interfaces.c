/* Interfaces of a model: the position of the ends at t = 0, and the elements between them. */
#include "model/built_model.h"

static void the_nearest_pair_of_the_colliding_ends_touches(void **state) {
    (void)state;
    CzVehicle car = typed_full();
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &car, 10.0);
    Built built = build_model(&problem);
    assert_near(parameter(&built, 0, CZ_PARAMETER(coupler.pivot.distance)), 2.8,
                ROUNDING_OF_A_VALUE, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(coupler.length)), 2.8, ROUNDING_OF_A_VALUE, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.contact.distance)), 0.64,
                ROUNDING_OF_A_VALUE, 0.0);
    assert_near(cz_model_interface_properties(built.model, 0).anti_climber_gap, 0.64,
                ROUNDING_OF_A_VALUE, 0.0);
    free_model(&built);

    problem.vehicle[0].front.coupler.gap = 0.5; /* now the anti-climbers are nearer */
    problem.vehicle[1].rear.coupler.gap = 0.5;
    built = build_model(&problem);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.contact.distance)), 0.0, 0.0, 1e-15);
    assert_near(parameter(&built, 0, CZ_PARAMETER(coupler.pivot.distance)), 2.8 + 1.0 - 0.64, 1e-15,
                0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(coupler.length)), 2.8, 1e-15, 0.0);
    free_model(&built);

    const CzSuperstructure foremost = {
        .given = true, .gap = 0.1, .height = 2.0, .strength = 3e5, .stiffness = 5e7};
    problem.vehicle[0].front.superstructure = foremost;
    problem.vehicle[1].rear.superstructure = foremost;
    built = build_model(&problem);
    assert_near(parameter(&built, 0, CZ_PARAMETER(superstructure.contact.distance)), 0.0, 0.0,
                ROUNDING_OF_A_VALUE);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.contact.distance)), 0.64 - 0.2,
                ROUNDING_OF_A_FORMULA, 0.0);
    free_model(&built);
}

static void arms_reach_from_the_carriers_to_the_parts(void **state) {
    (void)state;
    CzVehicle car = typed_full();
    car.rear.coupler.anchor = CZ_ANCHOR_END;
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &car, 10.0);
    Built built = build_model(&problem);
    assert_near(parameter(&built, 0, CZ_PARAMETER(coupler.pivot.x[0])), 11.4 - 1.4,
                ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(coupler.pivot.z[0])), 0.7 - 1.6,
                ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(coupler.side[0].on_end)), 0.0, 0.0, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(coupler.pivot.x[1])), -(11.4 - 1.4 - 10.6),
                ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(coupler.pivot.z[1])), 0.7 - 1.2,
                ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(coupler.side[1].on_end)), 1.0, 0.0, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.contact.x[0])), 11.4 - 0.32 - 10.6,
                ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.contact.x[1])), -(11.4 - 0.32 - 10.6),
                ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.contact.z[0])), 0.95 - 1.2,
                ROUNDING_OF_A_FORMULA, 0.0);
    free_model(&built);
}

static void inner_couplers_are_coupled_face_to_face(void **state) {
    (void)state;
    CzVehicle car[2] = {typed_full(), typed_full()};
    car[0].front.coupler.gap = 0.1;
    struct CzProblem problem;
    typed_problem_init(&problem, 2, car, 1, car, 10.0);
    Built built = build_model(&problem);
    assert_near(parameter(&built, 0, CZ_PARAMETER(coupler.coupled)), 1.0, 0.0, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(coupler.pivot.distance)), 2.8,
                ROUNDING_OF_A_VALUE, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.contact.distance)), 0.64 - 0.1,
                ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(parameter(&built, 1, CZ_PARAMETER(coupler.coupled)), 0.0, 0.0, 0.0);
    assert_near(parameter(&built, 1, CZ_PARAMETER(coupler.exists)), 1.0, 0.0, 0.0);
    free_model(&built);

    problem.vehicle[0].front.coupler.given = false;
    built = build_model(&problem);
    assert_near(parameter(&built, 0, CZ_PARAMETER(coupler.coupled)), 0.0, 0.0, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.contact.distance)), 0.64,
                ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(cz_model_interface_properties(built.model, 0).strut_length, 1.4,
                ROUNDING_OF_A_FORMULA, 0.0);
    free_model(&built);
}

static void height_offsets_raise_the_parts_ahead(void **state) {
    (void)state;
    CzVehicle car[3] = {typed_full(), typed_full(), typed_full()};
    car[2].rear.anti_climber.height = 1.0;
    struct CzProblem problem;
    typed_problem_init(&problem, 2, car, 1, &car[2], 10.0);
    problem.train[0].height_offset = 0.01;
    problem.train[1].height_offset = 0.04;
    Built built = build_model(&problem);
    assert_near(parameter(&built, 1, CZ_PARAMETER(face.contact.rise)), 0.05 + 0.04 - 0.01,
                ROUNDING_OF_A_SUM, 0.0);
    assert_near(parameter(&built, 1, CZ_PARAMETER(coupler.pivot.rise)), 0.03, ROUNDING_OF_A_SUM,
                0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.contact.rise)), 0.0, 0.0, 0.0);
    /* A strut between unequal heights rests without force. */
    assert_near(parameter(&built, 1, CZ_PARAMETER(coupler.length)), hypot(2.8, 0.03),
                ROUNDING_OF_A_FORMULA, 0.0);
    free_model(&built);

    problem.input.n_scenarios = 1;
    problem.scenario[0].height_offset = -0.04;
    problem.scenario[0].perturbed_interface = "A1-A2";
    problem.scenario[0].perturbation = 0.02;
    built = build_model(&problem);
    assert_near(parameter(&built, 1, CZ_PARAMETER(coupler.pivot.rise)), -0.05, ROUNDING_OF_A_SUM,
                0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(coupler.pivot.rise)), 0.02, ROUNDING_OF_A_SUM,
                0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.contact.rise)), 0.02, ROUNDING_OF_A_SUM,
                0.0);
    free_model(&built);
}

/* A wall, seen from either side. */
static void check_wall_side(const Built *built, int side) {
    const CzParameter transition = side == 1 ? CZ_PARAMETER(coupler.side[1].buffer.transition)
                                             : CZ_PARAMETER(coupler.side[0].buffer.transition);
    const CzCurveId buffer = side == 1 ? CZ_CURVE(buffer[1]) : CZ_CURVE(buffer[0]);
    const CzCurveId tube = side == 1 ? CZ_CURVE(tube[1]) : CZ_CURVE(tube[0]);
    const CzCurveId face = side == 1 ? CZ_CURVE(face[1]) : CZ_CURVE(face[0]);
    assert_near(parameter(built, 0, CZ_PARAMETER(coupler.exists)), 1.0, 0.0, 0.0);
    assert_near(parameter(built, 0, CZ_PARAMETER(coupler.coupled)), 0.0, 0.0, 0.0);
    assert_near(parameter(built, 0, CZ_PARAMETER(coupler.pivot.distance)), 1.4,
                ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(parameter(built, 0, CZ_PARAMETER(coupler.length)), 1.4, ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(parameter(built, 0, CZ_PARAMETER(coupler.pivot.rise)), 0.0, 0.0, 0.0);
    assert_near(parameter(built, 0, CZ_PARAMETER(face.contact.distance)), 0.32,
                ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(parameter(built, 0, CZ_PARAMETER(face.contact.rise)), 0.0, 0.0, 0.0);
    assert_near(parameter(built, 0, CZ_PARAMETER(face.compliance)), 1.0 / 4e8, 1e-15, 0.0);
    assert_near(parameter(built, 0, CZ_PARAMETER(face.overlap)), 1e30, 0.0, 0.0);
    assert_near(parameter(built, 0, transition), 1e30, 0.0, 0.0);
    assert_near(curve_at(built->lanes, 0, buffer, 0.0), 0.0, 0.0, 0.0);
    assert_near(curve_at(built->lanes, 0, buffer, 1.0), 1e30, 1e-15, 0.0);
    assert_near(curve_at(built->lanes, 0, tube, 0.1), 1e30, 1e-15, 0.0);
    assert_near(curve_at(built->lanes, 0, face, 0.1), 1e30, 1e-15, 0.0);
}

static void a_wall_meets_coupler_and_anti_climber_at_their_heights(void **state) {
    (void)state;
    const CzVehicle car = typed_full(), wall = typed_wall();
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &wall, 10.0);
    Built built = build_model(&problem);
    check_wall_side(&built, 1);
    free_model(&built);

    typed_problem_init(&problem, 1, &wall, 1, &car, 0.0);
    problem.train[1].speed = -10.0;
    built = build_model(&problem);
    check_wall_side(&built, 0);
    free_model(&built);
}

static void a_coupler_without_a_counterpart_strikes_the_bare_end(void **state) {
    (void)state;
    const CzVehicle car = typed_full(), wagon = typed_rigid(80e3);
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &wagon, 10.0);
    Built built = build_model(&problem);
    assert_near(parameter(&built, 0, CZ_PARAMETER(coupler.exists)), 1.0, 0.0, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(coupler.coupled)), 0.0, 0.0, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(coupler.length)), 1.4, ROUNDING_OF_A_FORMULA,
                0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(coupler.pivot.rise)), 0.0, 0.0, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.contact.distance)),
                car.front.anti_climber.gap, ROUNDING_OF_A_VALUE, 0.0);
    free_model(&built);
}

/* The struck point is at the height of what strikes it, on the end mass. */
static void parts_strike_a_bare_end_at_their_own_heights(void **state) {
    (void)state;
    CzVehicle car = typed_full(), bare = typed_full();
    bare.rear.coupler.given = bare.rear.anti_climber.given = false;
    bare.rear.face_height = 0.6;
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &bare, 10.0);
    problem.train[1].height_offset = 0.04;
    Built built = build_model(&problem);
    const CzEnd *end = &bare.rear;
    assert_near(parameter(&built, 0, CZ_PARAMETER(coupler.side[1].on_end)), 1.0, 0.0, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(coupler.pivot.z[1])),
                car.front.coupler.height - 0.04 - end->cg_height, ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(coupler.pivot.x[1])),
                -(11.4 - end->face_gap - end->distance), ROUNDING_OF_A_SUM, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(coupler.pivot.rise)), 0.0, 0.0, 0.0);
    const CzAntiClimber *device = &car.front.anti_climber;
    const double low =
        fmax(device->height - device->face_height / 2, end->crush_height - 0.3 + 0.04);
    const double high =
        fmin(device->height + device->face_height / 2, end->crush_height + 0.3 + 0.04);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.contact.z[0])),
                (low + high) / 2 - car.front.cg_height, ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.contact.z[1])),
                (low + high) / 2 - 0.04 - end->cg_height, ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.eccentricity)),
                device->height - end->crush_height - 0.04, ROUNDING_OF_A_FORMULA,
                ROUNDING_OF_A_VALUE);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.overlap)), (device->face_height + 0.6) / 2,
                ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.friction)), device->friction, 0.0, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.rib_capacity)), 0.0, 0.0, 0.0);
    free_model(&built);
}

/* An end structure from 0.75 to 0.95 m: a coupler at 0.72 m passes under it, an anti-climber at
 * 2.0 m over it; the bare end behind the anti-climber meets it. */
static void parts_pass_a_bare_end_that_they_do_not_overlap(void **state) {
    (void)state;
    CzVehicle car = typed_full(), bare = typed_full();
    bare.rear.coupler.given = bare.rear.anti_climber.given = false;
    bare.rear.crush_height = 0.85;
    bare.rear.face_height = 0.2;
    car.front.coupler.height = 0.72;
    car.front.anti_climber.height = 2.0;
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &bare, 10.0);
    Built built = build_model(&problem);
    assert_near(parameter(&built, 0, CZ_PARAMETER(coupler.exists)), 0.0, 0.0, 0.0);
    assert_near(curve_at(built.lanes, 0, CZ_CURVE(face[0]), 0.1), 1e30, 1e-15, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.contact.distance)), 0.0, 0.0, 1e-15);
    free_model(&built);

    problem.vehicle[1].rear.face_height = 0.3;
    problem.vehicle[1].rear.struck_by = CZ_STRUCK_BY_NO_COUPLERS;
    problem.vehicle[0].front.anti_climber.height = 0.95;
    built = build_model(&problem);
    assert_near(parameter(&built, 0, CZ_PARAMETER(coupler.exists)), 0.0, 0.0, 0.0);
    assert_true(curve_at(built.lanes, 0, CZ_CURVE(face[0]), 0.1) < 1e10);
    free_model(&built);
}

static void crush_zones_without_end_mass_lie_in_series_with_the_face(void **state) {
    (void)state;
    CzVehicle car = typed_rigid(40e3);
    const CzVehicle wall = typed_wall();
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &wall, 10.0);
    Built built = build_model(&problem);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.side[0].has_massless)), 0.0, 0.0, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.compliance)), 1e-9, 0.0, 0.0);
    assert_near(curve_at(built.lanes, 0, CZ_CURVE(massless[0]), 1.0), 1e30, ROUNDING_OF_A_VALUE,
                0.0);
    free_model(&built);

    CzEnd *end = &problem.vehicle[0].front;
    end->n_stages = 1;
    end->stages[0].stroke = 0.5;
    end->stages[0].force = 1e6;
    end->unloading_stiffness = 8e7;
    built = build_model(&problem);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.side[0].has_massless)), 1.0, 0.0, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.side[0].massless.unloading)), 8e7, 0.0, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.side[0].massless.second_unloading)), 8e7,
                0.0, 0.0);
    assert_near(curve_at(built.lanes, 0, CZ_CURVE(massless[0]), 0.25), 5e5, ROUNDING_OF_A_FORMULA,
                0.0);
    /* The face is so stiff then that the interface follows the given loading curve. */
    assert_true(parameter(&built, 0, CZ_PARAMETER(face.compliance)) < 1e-6 / 2e6);
    free_model(&built);
}

static void devices_side_by_side_multiply_forces_and_stiffness(void **state) {
    (void)state;
    CzVehicle car = typed_full();
    car.front.coupler.tube.count = 2;
    car.front.anti_climber.damping = 1e5;
    car.rear.anti_climber.damping = 3e5;
    car.front.anti_climber.speed_factor = 0.2;
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &car, 10.0);
    Built built = build_model(&problem);
    assert_near(curve_at(built.lanes, 0, CZ_CURVE(tube[0]), 0.1), 1.2e6, ROUNDING_OF_A_FORMULA,
                0.0);
    assert_near(curve_at(built.lanes, 0, CZ_CURVE(tube[1]), 0.1), 6e5, ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(coupler.compliance)), 1.0 / 4e8 + 1.0 / 2e8,
                ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(curve_at(built.lanes, 0, CZ_CURVE(face[0]), 0.1), 1e6, ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.compliance)), 2.0 / 4e8,
                ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.damping)), 2.0 * (1e5 * 3e5 / 4e5),
                ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.side[0].speed_factor)), 0.02,
                ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.side[1].speed_factor)), 0.0, 0.0, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.rib_capacity)), 4 * 2 * 32e3,
                ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.rib_pitch)), 0.05, ROUNDING_OF_A_FORMULA,
                0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.overlap)), 0.2, ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.stiffness_vertical)), 1e7,
                ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(coupler.side[0].shear.space)), 1.01,
                ROUNDING_OF_A_FORMULA, 0.0);
    free_model(&built);
}

static CzSideBuffers side_buffers(double gap) {
    CzSideBuffers set = default_CzSideBuffers();
    set.given = true;
    set.gap = gap;
    set.height = 1.05;
    set.friction = 0.2;
    set.buffer.given = true;
    set.buffer.n_stages = 1;
    set.buffer.stages[0].stroke = 0.105;
    set.buffer.stages[0].force = 590e3;
    return set;
}

static void side_buffers_push_in_pairs(void **state) {
    (void)state;
    CzVehicle car = typed_full(), wagon = typed_rigid(80e3);
    car.front.coupler.given = false;
    car.front.side_buffers = side_buffers(0.05);
    wagon.rear.side_buffers = side_buffers(0.0);
    wagon.rear.side_buffers.friction = NAN;
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &wagon, 10.0);
    Built built = build_model(&problem);
    assert_true(built.lanes->has.side_buffers);
    assert_false(built.lanes->has.couplers);
    assert_near(parameter(&built, 0, CZ_PARAMETER(side_buffers.exists)), 1.0, 0.0, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(side_buffers.contact.distance)), 0.0, 0.0,
                ROUNDING_OF_A_VALUE);
    assert_near(parameter(&built, 0, CZ_PARAMETER(face.contact.distance)), 0.32 - 0.05,
                ROUNDING_OF_A_FORMULA, 0.0);
    const CzEnd *end = &car.front; /* whose mass carries the buffers */
    assert_near(parameter(&built, 0, CZ_PARAMETER(side_buffers.contact.x[0])),
                11.35 - end->distance, ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(side_buffers.contact.z[0])),
                1.05 - end->cg_height, ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(parameter(&built, 0, CZ_PARAMETER(side_buffers.friction)), 0.0, 0.0, 0.0);
    assert_near(curve_at(built.lanes, 0, CZ_CURVE(side_buffer[0]), 0.105), 1.18e6,
                ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(curve_at(built.lanes, 0, CZ_CURVE(side_tube[0]), 0.1), 1e30, ROUNDING_OF_A_FORMULA,
                0.0);
    free_model(&built);
}

static void the_interface_behind_the_last_car_is_neutral(void **state) {
    (void)state;
    const CzVehicle car = typed_full();
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &car, 10.0);
    Built built = build_model(&problem);
    for (size_t lane = 1; lane < built.lanes->stride; lane++) {
        const int last = (int)lane;
        assert_near(parameter(&built, last, CZ_PARAMETER(coupler.exists)), 0.0, 0.0, 0.0);
        assert_near(parameter(&built, last, CZ_PARAMETER(face.contact.distance)), 1e30, 0.0, 0.0);
        assert_near(parameter(&built, last, CZ_PARAMETER(coupler.length)), 1.0, 0.0, 0.0);
        for (int id = CZ_CURVE(buffer[0]); id < CZ_N_CURVE; id++)
            assert_near(curve_at(built.lanes, lane, (CzCurveId)id, 1.0), 1e30, ROUNDING_OF_A_VALUE,
                        0.0);
        if (last > 1)
            assert_near(parameter(&built, last, CZ_PARAMETER(inverse.body.mass)), 0.0, 0.0, 0.0);
    }
    assert_true(built.lanes->stride % CZ_LANE_BLOCK == 0);
    assert_true(built.lanes->stride >= built.lanes->n_lane + 1);
    free_model(&built);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_nearest_pair_of_the_colliding_ends_touches),
        cmocka_unit_test(arms_reach_from_the_carriers_to_the_parts),
        cmocka_unit_test(inner_couplers_are_coupled_face_to_face),
        cmocka_unit_test(height_offsets_raise_the_parts_ahead),
        cmocka_unit_test(a_wall_meets_coupler_and_anti_climber_at_their_heights),
        cmocka_unit_test(a_coupler_without_a_counterpart_strikes_the_bare_end),
        cmocka_unit_test(parts_strike_a_bare_end_at_their_own_heights),
        cmocka_unit_test(parts_pass_a_bare_end_that_they_do_not_overlap),
        cmocka_unit_test(crush_zones_without_end_mass_lie_in_series_with_the_face),
        cmocka_unit_test(devices_side_by_side_multiply_forces_and_stiffness),
        cmocka_unit_test(side_buffers_push_in_pairs),
        cmocka_unit_test(the_interface_behind_the_last_car_is_neutral),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
