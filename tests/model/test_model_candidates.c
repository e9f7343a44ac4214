/* Candidate designs in lanes: values that change, values that must not, and values that return bit
 * for bit. */
#include "model/built_model.h"

static struct CzProblem problem;

static void make_problem(void) {
    CzVehicle car[3] = {typed_full(), typed_full(), typed_full()};
    car[1].front.anti_climber.n_stages = 2;
    car[1].front.anti_climber.stages[1] = car[1].front.anti_climber.stages[0];
    typed_problem_init(&problem, 2, car, 1, &car[2], 10.0);
}

static CzLanes *filled(const CzModel *model, int n_design, const CzVehicle *const *design,
                       CzArena *arena) {
    CzLanes *lanes = cz_model_lanes(model, n_design, arena);
    assert_non_null(lanes);
    for (int i = 0; i < n_design; i++) {
        CzError error = {0};
        if (cz_model_fill(model, design[i], i, lanes, &error) != CZ_OK)
            fail_msg("%s", error.message);
    }
    return lanes;
}

/* All numbers of one design, compared lane by lane. */
static void assert_same_design(const CzLanes *a, int in_a, const CzLanes *b, int in_b) {
    for (int car = 0; car < a->n_car; car++) {
        const size_t la = (size_t)(car * a->n_design + in_a);
        const size_t lb = (size_t)(car * b->n_design + in_b);
        for (CzParameter p = 0; p < CZ_N_PARAMETER; p++)
            assert_true(*cz_lane_parameter(a, p, la) == *cz_lane_parameter(b, p, lb));
        for (int dof = 0; dof < CZ_N_DOF; dof++) {
            assert_true(*cz_lane_mass(a, dof, la) == *cz_lane_mass(b, dof, lb));
            assert_true(*cz_lane_velocity(a, dof, la) == *cz_lane_velocity(b, dof, lb));
        }
        for (int id = 0; id < CZ_N_CURVE; id++) {
            const CzCurveLanes *ca = &a->curve[id], *cb = &b->curve[id];
            assert_int_equal(ca->n_breakpoint, cb->n_breakpoint);
            assert_true(ca->start[la] == cb->start[lb]);
            assert_true(ca->usable[la] == cb->usable[lb]);
            for (size_t k = 0; k < (size_t)ca->n_breakpoint; k++) {
                assert_true(ca->at[k * a->stride + la] == cb->at[k * b->stride + lb]);
                assert_true(ca->slope_change[k * a->stride + la] ==
                            cb->slope_change[k * b->stride + lb]);
            }
        }
    }
}

static void a_design_does_not_depend_on_its_neighbours(void **state) {
    (void)state;
    make_problem();
    Built built = build_model(&problem);
    CzVehicle other[3], third[3];
    memcpy(other, problem.vehicle, sizeof other);
    memcpy(third, problem.vehicle, sizeof third);
    other[0].front.coupler.tube.stages[0].force = 9e5;
    third[1].front.anti_climber.stages[0].stroke = 0.5;
    const CzVehicle *const designs[] = {other, problem.vehicle, third, problem.vehicle, other};
    CzArena arena = {0};
    const CzLanes *many = filled(built.model, 5, designs, &arena);
    for (int i = 0; i < 5; i++) {
        const CzLanes *alone = filled(built.model, 1, &designs[i], &arena);
        assert_same_design(many, i, alone, 0);
    }
    cz_arena_free(&arena);
    free_model(&built);
}

static void filling_again_overwrites_the_last_candidate(void **state) {
    (void)state;
    make_problem();
    Built built = build_model(&problem);
    CzVehicle other[3];
    memcpy(other, problem.vehicle, sizeof other);
    other[1].front.coupler.tube.stages[0].force = 9e5;
    other[1].front.coupler.shear_off.force = 1.2e6;
    other[1].front.anti_climber.gap = 0.1;
    other[1].front.anti_climber.stages[0].stroke = 0.7;
    const CzVehicle *own = problem.vehicle;
    CzArena arena = {0};
    const CzLanes *fresh = filled(built.model, 1, &own, &arena);
    CzLanes *used = cz_model_lanes(built.model, 1, &arena);
    assert_int_equal(cz_model_fill(built.model, other, 0, used, NULL), CZ_OK);
    assert_true(*cz_lane_parameter(used, CZ_PARAMETER(coupler.side[0].shear.force), 1) == 1.2e6);
    other[0].front.coupler.tube.stages[0].stroke = -1.0; /* fails before all lanes are filled */
    assert_int_equal(cz_model_fill(built.model, other, 0, used, NULL), CZ_STATUS_INPUT);
    assert_int_equal(cz_model_fill(built.model, problem.vehicle, 0, used, NULL), CZ_OK);
    assert_same_design(used, 0, fresh, 0);
    cz_arena_free(&arena);
    free_model(&built);
}

static void a_longer_anti_climber_lengthens_its_end_of_the_car(void **state) {
    (void)state;
    make_problem();
    Built built = build_model(&problem);
    CzVehicle other[3];
    memcpy(other, problem.vehicle, sizeof other);
    other[1].front.anti_climber.stages[0].stroke += 0.15; /* 0.2 m at an efficiency of 0.75 */
    CzArena arena = {0};
    const CzVehicle *design = other;
    const CzLanes *lanes = filled(built.model, 1, &design, &arena);
    const Built candidate = {.model = built.model, .lanes = (CzLanes *)lanes};
    assert_near(parameter(&candidate, 1, CZ_PARAMETER(coupler.pivot.x[0])),
                parameter(&built, 1, CZ_PARAMETER(coupler.pivot.x[0])) + 0.2, 1e-14, 0.0);
    assert_near(parameter(&candidate, 1, CZ_PARAMETER(face.contact.x[0])),
                parameter(&built, 1, CZ_PARAMETER(face.contact.x[0])) + 0.2, ROUNDING_OF_A_FORMULA,
                0.0);
    /* The other end and the gaps stay. */
    assert_near(parameter(&candidate, 0, CZ_PARAMETER(coupler.pivot.x[1])),
                parameter(&built, 0, CZ_PARAMETER(coupler.pivot.x[1])), 0.0, 0.0);
    assert_near(parameter(&candidate, 1, CZ_PARAMETER(face.contact.distance)),
                parameter(&built, 1, CZ_PARAMETER(face.contact.distance)), 0.0, 0.0);
    cz_arena_free(&arena);
    free_model(&built);
}

static void a_trigger_given_later_still_fits(void **state) {
    (void)state;
    make_problem();
    Built built = build_model(&problem);
    CzVehicle other[3];
    memcpy(other, problem.vehicle, sizeof other);
    other[1].front.coupler.tube.trigger = 8e5;
    other[1].front.coupler.tube.stages[0].end_force = 7e5;
    CzArena arena = {0};
    const CzVehicle *design = other;
    const CzLanes *lanes = filled(built.model, 1, &design, &arena);
    assert_near(curve_at(lanes, 1, CZ_CURVE(tube[0]), 0.0), 8e5, ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(curve_at(lanes, 1, CZ_CURVE(tube[0]), 0.25), 7e5, ROUNDING_OF_A_SUM, 0.0);
    cz_arena_free(&arena);
    free_model(&built);
}

static void the_last_breakpoint_is_the_end_of_the_stroke(void **state) {
    (void)state;
    make_problem();
    Built built = build_model(&problem);
    for (int id = 0; id < CZ_N_CURVE; id++) {
        const CzCurveLanes *curve = &built.lanes->curve[id];
        for (size_t lane = 0; lane < (size_t)built.lanes->n_car; lane++)
            if (curve->n_breakpoint > 0 && curve->usable[lane] < 1e30)
                assert_true(
                    curve->at[(size_t)(curve->n_breakpoint - 1) * built.lanes->stride + lane] ==
                    curve->usable[lane]);
    }
    free_model(&built);
}

/* For any number of stages of the other lanes: a lane with fewer stages has spare breakpoints. */
static void breakpoints_of_a_lane_are_in_order_of_stroke(void **state) {
    (void)state;
    make_problem();
    Built built = build_model(&problem);
    for (int id = 0; id < CZ_N_CURVE; id++) {
        const CzCurveLanes *curve = &built.lanes->curve[id];
        for (size_t lane = 0; lane < (size_t)built.lanes->n_car; lane++)
            for (int k = 1; k < curve->n_breakpoint; k++) {
                const double *at = curve->at + (size_t)k * built.lanes->stride + lane;
                assert_true(at[0] >= *(at - built.lanes->stride));
            }
    }
    free_model(&built);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_design_does_not_depend_on_its_neighbours),
        cmocka_unit_test(filling_again_overwrites_the_last_candidate),
        cmocka_unit_test(a_longer_anti_climber_lengthens_its_end_of_the_car),
        cmocka_unit_test(a_trigger_given_later_still_fits),
        cmocka_unit_test(the_last_breakpoint_is_the_end_of_the_stroke),
        cmocka_unit_test(breakpoints_of_a_lane_are_in_order_of_stroke),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
