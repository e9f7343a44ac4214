/* Vehicles at rest, solved from the laws, against the closed forms of the model. */
#include "physics/motion.h"

#include "dynamics/equilibrium.h"

static const char file[] = "problems/two-cars-25kmh.yaml";

static CzRest rest_in(const Collision *collision, int vehicle) {
    CzRest rest[16];
    CzError error = {0};
    assert_true(cz_model_n_vehicle(collision->model) <= 16);
    if (cz_rest_find(collision->model, rest, &error) != CZ_OK)
        fail_msg("%s", error.message);
    return rest[vehicle];
}

/* Loads and deflections are those of statics by hand for any start of the solver; Newton's
 * method ends at 1e-11 of the weight, which is 5 uN on 0.5 MN and 1e-11 of each deflection. */
static void check_closed_form(const char *const *set) {
    Collision collision = collision_model(file, set, 0);
    for (int vehicle = 0; vehicle < 2; vehicle++) {
        const CzRest rest = rest_in(&collision, vehicle);
        const CzVehicleProperties properties =
            cz_model_vehicle_properties(collision.model, vehicle);
        assert_near(rest.residual, 0.0, 0.0, 1e-10);
        for (int bogie = 0; bogie < 2; bogie++)
            assert_near(rest.secondary_deflection[bogie], properties.secondary_deflection[bogie],
                        1e-9, 0.0);
        for (int axle = 0; axle < 4; axle++) {
            assert_near(rest.axle_load[axle], properties.axle_load[axle], 1e-9, 0.0);
            assert_near(rest.primary_deflection[axle], properties.primary_deflection[axle], 1e-9,
                        0.0);
            assert_near(rest.rail_deflection[axle], 0.0, 0.0, 0.0);
        }
        const double sum =
            rest.axle_load[0] + rest.axle_load[1] + rest.axle_load[2] + rest.axle_load[3];
        assert_near(sum, properties.mass * 9.80665, 1e-10, 0.0);
    }
    collision_free(&collision);
}

static void a_car_at_rest_has_the_closed_form_deflections(void **state) {
    (void)state;
    check_closed_form(WITH("simulation.track=rigid"));
}

/* A heavy front end pitches the body and loads the front bogie. */
static void unequal_ends_share_the_load_by_their_levers(void **state) {
    (void)state;
    check_closed_form(WITH("simulation.track=rigid", "trains.A.vehicles.A1.front.mass_t=3"));
    Collision collision = collision_model(file, WITH("trains.A.vehicles.A1.front.mass_t=3"), 0);
    const CzRest rest = rest_in(&collision, 0);
    assert_true(rest.axle_load[3] > rest.axle_load[0]);
    assert_true(rest.body_pitch < 0.0);
    collision_free(&collision);
}

/* On the elastic track a wheelset is lowered by the indentation of the contact and the deflection
 * of the rail: the approach at rest of the kernel, which follows from another sum over the modes.
 * The loads stay the same.
 */
static void an_elastic_track_lowers_the_wheels(void **state) {
    (void)state;
    Motion motion = motion_open(file, WITH("simulation.track=modal"));
    const CzModel *model = motion.collision.model;
    const CzRest rest = rest_in(&motion.collision, 0);
    motion.dynamics = cz_dynamics_create(motion.lanes, &motion.arena);
    assert_true(
        cz_dynamics_lay_track(motion.dynamics, &model->track, CZ_TRACK_MODAL, 0.0, &motion.arena));
    for (int axle = 0; axle < 4; axle++) {
        const double approach = motion.dynamics->block[0].constant.wheel_rest[axle][0];
        assert_near(rest.axle_load[axle], cz_model_vehicle_properties(model, 0).axle_load[axle],
                    1e-9, 0.0);
        assert_true(rest.rail_deflection[axle] > 1e-4);
        assert_near(rest.rail_deflection[axle] + rest.indentation[axle], approach, 1e-9, 0.0);
    }
    assert_near(rest.residual, 0.0, 0.0, 1e-10);
    motion_close(&motion);
}

/* The equilibrium of the laws is the equilibrium of the kernel: no force moves a car at rest. */
static void the_kernel_moves_nothing_at_rest(void **state) {
    (void)state;
    const char *const tracks[] = {"simulation.track=rigid", "simulation.track=modal"};
    for (int t = 0; t < 2; t++) {
        Motion motion = motion_open(file, WITH(tracks[t]));
        for (int dof = 0; dof < CZ_N_DOF; dof++)
            for (int car = 0; car < 2; car++)
                *cz_lane_velocity(motion.lanes, dof, (size_t)car) = 0.0;
        motion_start(&motion);
        const double weight = cz_model_vehicle_properties(motion.collision.model, 0).mass * 9.80665;
        for (int dof = CZ_DOF(body.z); dof < CZ_N_DOF; dof++)
            assert_near(force(&motion, dof, 0), 0.0, 0.0, 1e-9 * weight);
        motion_close(&motion);
    }
}

static void rigid_cars_and_walls_have_no_rest(void **state) {
    (void)state;
    Collision collision = collision_model("tests/physics/cases/plateau.yaml", AS_WRITTEN, 0);
    const CzRest rest = rest_in(&collision, 0);
    assert_true(isnan(rest.residual) && isnan(rest.axle_load[2]) && isnan(rest.body_sag));
    collision_free(&collision);
}

/* A mass with three zeros too many: the message names the vehicle, the part without equilibrium,
 * the springs, and the place of the mass. */
static void a_car_without_an_equilibrium_is_named_with_its_springs(void **state) {
    (void)state;
    Collision collision =
        collision_model(file, WITH("simulation.track=modal", "parts.paper-car.mass_t=4990"), 0);
    CzRest rest[16];
    CzError error = {0};
    assert_int_equal(cz_rest_find(collision.model, rest, &error), CZ_STATUS_RUN_FAILED);
    assert_string_equal(error.file, "--set");
    assert_non_null(strstr(error.message, "A1: no static equilibrium: "));
    assert_non_null(strstr(error.message, "suspension"));
    assert_non_null(strstr(error.help, "860 kN/m per bogie"));
    assert_null(strstr(error.message, "KIN"));
    collision_free(&collision);
}

static void a_recorded_run_reports_its_residual(void **state) {
    (void)state;
    Collision full = collide(file, AS_WRITTEN, 0);
    assert_near(full.summary->rest_residual, 0.0, 0.0, ROUNDING_OF_A_SUM);
    collision_free(&full);
    Collision rigid = collide("tests/physics/cases/plateau.yaml", AS_WRITTEN, 0);
    assert_true(isnan(rigid.summary->rest_residual));
    collision_free(&rigid);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_car_at_rest_has_the_closed_form_deflections),
        cmocka_unit_test(unequal_ends_share_the_load_by_their_levers),
        cmocka_unit_test(an_elastic_track_lowers_the_wheels),
        cmocka_unit_test(the_kernel_moves_nothing_at_rest),
        cmocka_unit_test(rigid_cars_and_walls_have_no_rest),
        cmocka_unit_test(a_car_without_an_equilibrium_is_named_with_its_springs),
        cmocka_unit_test(a_recorded_run_reports_its_residual),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
