/* Trains at rest stay at rest, rolling trains keep rolling, and an invalid run fails. */
#include "physics/motion.h"

/* ---- rest and rolling ---- */

enum { N_CAR = 3 };

/* Three cars in contact, at equal speed, rolling without slip. */
static Motion all_on(const char *track, double speed, const char *brake_a, const char *brake_b) {
    Motion motion = motion_open("tests/physics/cases/standing.yaml", WITH(track, brake_a, brake_b));
    for (int car = 0; car < N_CAR; car++)
        for (int dof = 0; dof < CZ_N_DOF; dof++) {
            const CzAxis axis = cz_axis_of(dof);
            const bool spin = dof >= CZ_DOF(wheelset[0]) && axis == CZ_AXIS_TURN;
            const double radius = *parameter(&motion, CZ_PARAMETER(wheel.radius), car);
            *cz_lane_velocity(motion.lanes, dof, (size_t)car) = axis == CZ_AXIS_ALONG ? speed
                                                                : spin ? speed / radius
                                                                       : 0.0;
        }
    motion_start(&motion);
    return motion;
}

static Motion all_at(double speed, const char *brake_a, const char *brake_b) {
    return all_on("simulation.track=rigid", speed, brake_a, brake_b);
}

static void go(Motion *motion, double duration) {
    const long n = lround(duration / motion->step);
    for (long i = 0; i < n; i++) {
        motion_advance(motion);
        motion_evaluate(motion);
    }
}

static void trains_that_touch_at_rest_stay_at_rest(void **state) {
    (void)state;
    Motion motion = all_at(0.0, "trains.A.brake.ratio=0", "trains.B.brake.ratio=0.1");
    for (int i = 0; i < 20; i++) {
        go(&motion, 0.05);
        for (int car = 0; car < N_CAR; car++)
            for (int dof = 0; dof < CZ_N_DOF; dof++) {
                assert_near(*position(&motion, dof, car), 0.0, 0.0, ROUNDING_OF_A_SUM);
                assert_near(*velocity(&motion, dof, car), 0.0, 0.0, ROUNDING_OF_A_SUM);
            }
    }
    motion_close(&motion);
}

static void rolling_trains_roll_on(void **state) {
    (void)state;
    Motion motion = all_at(10.0, "trains.A.brake.ratio=0", "trains.B.brake.ratio=0");
    go(&motion, 2.0);
    for (int car = 0; car < N_CAR; car++) {
        const double radius = *parameter(&motion, CZ_PARAMETER(wheel.radius), car);
        assert_near(*position(&motion, CZ_DOF(body.x), car), 20.0, ROUNDING_OF_A_SUM, 0.0);
        assert_near(*velocity(&motion, CZ_DOF(body.x), car), 10.0, ROUNDING_OF_A_SUM, 0.0);
        assert_near(*velocity(&motion, CZ_DOF(body.pitch), car), 0.0, 0.0, ROUNDING_OF_A_SUM);
        for (int axle = 0; axle < 4; axle++)
            assert_near(*velocity(&motion, CZ_DOF(wheelset[axle].spin), car) * radius, 10.0,
                        ROUNDING_OF_A_SUM, 0.0);
    }
    motion_close(&motion);
}

/* Work of one kind of element on all cars [J]. */
static double work_of(const Motion *motion, int row) {
    double work = 0.0;
    for (int car = 0; car < N_CAR; car++)
        work += work_at(motion, row, car);
    return work;
}

/* Wheels that roll over sleepers work on pads and ballast, and the model keeps them at their speed:
 * the track dissipates the work of the moving load, and no car slows down, except for the creep
 * under a load that varies by a part in a thousand. Without that term all of it would be missing
 * from the energy balance. Work is summed over steps of a hundredth of a bay's passage, to second
 * order: a part in a thousand. */
static void the_moving_load_does_the_work_on_elastic_rails(void **state) {
    (void)state;
    static const char *const tracks[] = {"simulation.track=modal", "simulation.track=fe"};
    for (int i = 0; i < 2; i++) {
        Motion motion = all_on(tracks[i], 30.0, "trains.A.brake.ratio=0", "trains.B.brake.ratio=0");
        const double before = motion_kinetic_energy(&motion);
        go(&motion, 1.0);
        for (int car = 0; car < N_CAR; car++)
            assert_near(*velocity(&motion, CZ_DOF(body.x), car), 30.0, 1e-8, 0.0);
        double sum = 0.0;
        for (int row = 0; row < CZ_N_LEDGER; row++)
            sum += work_of(&motion, row);
        const double paid = -work_of(&motion, CZ_LEDGER(moving_load));
        assert_true(paid > 100.0); /* [J] */
        /* The flexibility under a wheel that the modes leave out is added to that of the contact.
         */
        const double taken =
            work_of(&motion, CZ_LEDGER(track)) + work_of(&motion, CZ_LEDGER(wheel_normal));
        assert_near(taken, paid, 2e-3, 0.0);
        assert_near(sum, before - motion_kinetic_energy(&motion), 0.0, 1e-3 * paid);
        motion_close(&motion);
    }
}

/* A brake of a tenth of the axle load on every axle slows a car by 0.1 g, reduced by the inertia of
 * its wheelsets: 4 I / r^2 beside the mass. */
static void braked_trains_slow_down_by_their_brake_ratio(void **state) {
    (void)state;
    Motion motion = all_at(10.0, "trains.A.brake.ratio=0.1", "trains.A.brake.axle_share=1");
    const double turning = 4.0 * 100.0 / (0.42 * 0.42), total = 38e3;
    const double deceleration = 0.1 * 9.80665 * total / (total + turning);
    double mean[2] = {0.0};
    go(&motion, 0.5);
    for (int car = 0; car < N_CAR; car++)
        mean[0] += *velocity(&motion, CZ_DOF(body.x), car) / N_CAR;
    go(&motion, 2.0);
    for (int car = 0; car < N_CAR; car++)
        mean[1] += *velocity(&motion, CZ_DOF(body.x), car) / N_CAR;
    assert_near((mean[0] - mean[1]) / 2.0, deceleration, 1e-2, 0.0);
    motion_close(&motion);
}

/* At walking pace the push exceeds the brake force for a moment; the train moves a little and
 * stays. */
static void a_standing_braked_train_holds_against_a_light_touch(void **state) {
    (void)state;
    Collision touched = collide("tests/physics/cases/standing.yaml",
                                WITH("trains.A.speed_m_s=0.05", "simulation.duration_s=3"), 0);
    assert_completed(&touched);
    const double *x = channel(&touched, CZ_CHANNEL_BODY_DISPLACEMENT, "B1");
    assert_true(fabs(last_value(&touched, x)) < 0.01);
    assert_near(last_value(&touched, channel(&touched, CZ_CHANNEL_BODY_SPEED, "B1")), 0.0, 0.0,
                0.01);
    collision_free(&touched);
}

/* ---- runs that cannot be right ---- */

static void assert_failed(const Collision *collision) {
    const CzRunSummary *summary = collision->summary;
    print_message("%s\n", summary->failure);
    assert_int_equal(summary->status, CZ_STATUS_RUN_FAILED);
    assert_int_equal(summary->ended, CZ_ENDED_INCOMPLETE);
    assert_non_null(strstr(summary->failure, " ms"));
    assert_true(strstr(summary->failure, "A1") != NULL || strstr(summary->failure, "A2") != NULL ||
                strstr(summary->failure, "B1") != NULL);
    assert_true(isnan(summary->interface[0].peak_force));
    assert_true(isnan(summary->energy.dissipated));
}

/* The model refuses such steps; a caller of the library may still require one. */
static void an_absurd_time_step_ends_as_failed(void **state) {
    (void)state;
    static const double steps[] = {0.6e-3, 1e-3, 5e-3, 0.1};
    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++) {
        Collision failed = collision_model("tests/physics/cases/standing.yaml",
                                           WITH("trains.A.speed_m_s=10",
                                                "parts.bogie.guidance_stiffness_MN_m=9999",
                                                "simulation.duration_s=2"),
                                           0);
        CzSimulateOptions options = cz_simulate_options_default();
        options.time_step = steps[i];
        CzError error = {0};
        assert_int_equal(cz_simulate(failed.model, &options, &failed.run, &error), CZ_OK);
        failed.summary = cz_run_summary(failed.run);
        assert_failed(&failed);
        collision_free(&failed);
    }
}

static void a_run_that_is_cut_is_incomplete(void **state) {
    (void)state;
    Collision cut =
        collide("tests/physics/cases/plateau.yaml", WITH("simulation.longest_s=0.05"), 0);
    assert_int_equal(cut.summary->status, CZ_OK);
    assert_int_equal(cut.summary->ended, CZ_ENDED_INCOMPLETE);
    /* The end criterion is checked every 32 steps; the plateau begins within a step. */
    const double step = cut.summary->time_step, deceleration = 75.0;
    assert_near(cut.summary->simulated, 0.05, 0.0, 32.0 * step);
    assert_near(cut.summary->closing_speed, 10.0 - deceleration * cut.summary->simulated, 0.0,
                0.5 * step * deceleration);
    collision_free(&cut);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(trains_that_touch_at_rest_stay_at_rest),
        cmocka_unit_test(rolling_trains_roll_on),
        cmocka_unit_test(the_moving_load_does_the_work_on_elastic_rails),
        cmocka_unit_test(braked_trains_slow_down_by_their_brake_ratio),
        cmocka_unit_test(a_standing_braked_train_holds_against_a_light_touch),
        cmocka_unit_test(an_absurd_time_step_ends_as_failed),
        cmocka_unit_test(a_run_that_is_cut_is_incomplete),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
