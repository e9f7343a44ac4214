/* Hand calculations of climbing: the force at which a coupler folds, and the wheel lift of a
 * pitching car. */
#include "physics/motion.h"

/* ---- a coupler is a strut ---- */

#define CLOSING_SPEED 0.01 /* slow against the bounce of the cars [m/s] */

/* Height of pivot B over pivot A. */
static double rise_of_pivots(const Motion *motion) {
    const double a = *position(motion, CZ_DOF(body.z), 0) +
                     *position(motion, CZ_DOF(body.pitch), 0) *
                         *parameter(motion, CZ_PARAMETER(coupler.pivot.x[0]), 0);
    const double b = *position(motion, CZ_DOF(body.z), 1) +
                     *position(motion, CZ_DOF(body.pitch), 1) *
                         *parameter(motion, CZ_PARAMETER(coupler.pivot.x[1]), 0);
    return *parameter(motion, CZ_PARAMETER(coupler.pivot.rise), 0) + b - a;
}

/* Pushes one car slowly towards the other, whose places along the track are given, while the tubes
 * hold a constant force; returns the largest rise of the pivots, or 0.1 m once it is that large. */
static double fold(const char *hinge, const char *length, double share_of_critical) {
    Motion properties = motion_open("tests/physics/cases/fold.yaml", WITH(hinge, length));
    const double critical =
        cz_model_interface_properties(properties.collision.model, 0).critical_force;
    motion_close(&properties);
    char tubes[96];
    snprintf(tubes, sizeof tubes, "parts.strut.tube.stages[0].force_N=%.0f",
             share_of_critical * critical);
    Motion motion = motion_open("tests/physics/cases/fold.yaml", WITH(hinge, length, tubes));
    motion_start(&motion);
    double largest = 0.0;
    for (int i = 1; i <= 40000 && largest < 0.1; i++) {
        motion_advance(&motion);
        *position(&motion, CZ_DOF(body.x), 0) = CLOSING_SPEED * i * motion.step;
        *velocity(&motion, CZ_DOF(body.x), 0) = CLOSING_SPEED;
        *position(&motion, CZ_DOF(body.x), 1) = 0.0;
        *velocity(&motion, CZ_DOF(body.x), 1) = 0.0;
        motion_evaluate(&motion);
        largest = fmax(largest, fabs(rise_of_pivots(&motion)));
    }
    motion_close(&motion);
    return largest;
}

/* For all hinges and lengths. At nine tenths of F_crit an offset of 1 mm grows tenfold, and up to
 * twice that because the load is sudden; a tenth above F_crit it grows without bound within four
 * seconds. */
static void a_coupler_folds_above_its_critical_force_and_not_below(void **state) {
    (void)state;
    static const char *const struts[][2] = {
        {"parts.strut.hinge.stiffness_kNm_rad=600", "parts.strut.length_m=1.4"},
        {"parts.strut.hinge.stiffness_kNm_rad=0", "parts.strut.length_m=1.4"},
        {"parts.strut.hinge.stiffness_kNm_rad=1000", "parts.strut.length_m=1.1"},
    };
    for (size_t i = 0; i < sizeof struts / sizeof struts[0]; i++) {
        const double below = fold(struts[i][0], struts[i][1], 0.9);
        const double above = fold(struts[i][0], struts[i][1], 1.1);
        if (getenv("CZ_TOL_SCALE") != NULL)
            print_message("%g m below, %g m above\n", below, above);
        assert_true(below < 2.0 * 10.0 * 1e-3);
        assert_true(above >= 0.1);
    }
}

/* ---- a train is a chain of struts ---- */

#define IMPERFECTION 1e-6 /* pitch of every car at the start [rad] */
#define RUNAWAY 1000.0    /* times that: far beyond any oscillation below F_crit [-] */
#define MIN_CLOSING 1e-3  /* of every interface, so that all tubes keep collapsing [m/s] */

/* The largest pitch of any car within `duration`, over the imperfection, while the tubes of all
 * interfaces push with one force. */
static double growth(const char *const *set, double duration) {
    Motion motion = motion_open("tests/physics/cases/fold-train.yaml", set);
    const int n_car = motion.collision.model->n_car;
    *parameter(&motion, CZ_PARAMETER(coupler.coupled), motion.collision.model->colliding) = 1.0;
    motion_lay(&motion);
    for (int car = 0; car < n_car; car++)
        *position(&motion, CZ_DOF(body.pitch), car) = IMPERFECTION;
    motion.kernel->evaluate(motion.dynamics, motion.step);
    motion.kernel->commit(motion.dynamics, 0.0, 0.0);
    double largest = 0.0;
    for (int i = 1; i * motion.step <= duration; i++) {
        motion_advance(&motion);
        for (int car = 0; car < n_car; car++) {
            const double speed = -car * MIN_CLOSING;
            *position(&motion, CZ_DOF(body.x), car) = speed * i * motion.step;
            *velocity(&motion, CZ_DOF(body.x), car) = speed;
            largest = fmax(largest, fabs(*position(&motion, CZ_DOF(body.pitch), car)));
        }
        motion_evaluate(&motion);
    }
    motion_close(&motion);
    return largest / IMPERFECTION;
}

/* F_crit of twelve equal cars is 1025 kN; two of them alone fold at 1120 kN. There is no damping,
 * so a slow growth is visible. Below F_crit a free oscillation in pitch is at most 1 / sqrt(1 - F /
 * F_crit) = 6.4 times as large under the force. */
static void a_train_of_twelve_cars_folds_at_1040_kn_and_not_at_1000(void **state) {
    (void)state;
    const double below = growth(WITH("parts.strut.tube.stages[0].force_kN=1000"), 15.0);
    const double above = growth(WITH("parts.strut.tube.stages[0].force_kN=1040"), 6.0);
    if (getenv("CZ_TOL_SCALE") != NULL)
        print_message("pitch grows %g times below, %g times above\n", below, above);
    assert_true(below < 6.4);
    assert_true(above > RUNAWAY);
}

/* Half a percent on either side; the bound is 1 / sqrt(0.005) = 14 then. */
static void assert_folds_at_the_printed_force(const char *const *set) {
    Motion properties = motion_open("tests/physics/cases/fold-train.yaml", set);
    const double critical =
        cz_model_interface_properties(properties.collision.model, 3).critical_force;
    motion_close(&properties);
    double grown[2];
    for (int i = 0; i < 2; i++) {
        char tubes[96];
        const char *with[MAX_SET] = {tubes};
        for (int k = 0; k + 1 < MAX_SET; k++)
            with[k + 1] = set[k];
        snprintf(tubes, sizeof tubes, "parts.strut.tube.stages[0].force_N=%.0f",
                 (i == 0 ? 0.995 : 1.005) * critical);
        grown[i] = growth(with, 10.0);
    }
    if (getenv("CZ_TOL_SCALE") != NULL)
        print_message("%g kN: pitch grows %g times below, %g times above\n", 1e-3 * critical,
                      grown[0], grown[1]);
    assert_true(grown[0] < 1.0 / sqrt(0.005));
    assert_true(grown[1] > RUNAWAY);
}

static void the_printed_force_is_where_the_integration_folds(void **state) {
    (void)state;
    assert_folds_at_the_printed_force(AS_WRITTEN);
}

/* The end masses pitch and move vertically on springs of their own, which lowers F_crit by 7 %. */
static void the_printed_force_is_right_for_couplers_on_end_masses(void **state) {
    (void)state;
    assert_folds_at_the_printed_force(
        WITH("parts.end.coupler.anchor=end", "parts.end.mass_kg=500", "parts.end.vertical=free",
             "parts.end.vertical_stiffness_MN_m=20", "parts.end.pitch_stiffness_MNm_rad=10",
             "parts.end.pitch_damping_Nms_rad=0", "parts.end.hinge_moment_MNm=1000",
             "parts.end.stages[0].stroke_mm=5", "parts.end.unloading_stiffness_MN_m=1000"));
}

/* ---- stops lift wheels ---- */

/* Turns the body of the first car nose-up, slowly and about its centre, and returns the lift of the
 * front wheelset at the end. */
static double lift_at(Motion *motion, double pitch) {
    motion_start(motion);
    const int n = 40000;
    for (int i = 1; i <= n; i++) {
        const double share = fmin(1.0, 1.25 * i / n);
        motion_advance(motion);
        *position(motion, CZ_DOF(body.x), 0) = *velocity(motion, CZ_DOF(body.x), 0) = 0.0;
        *position(motion, CZ_DOF(body.z), 0) = *velocity(motion, CZ_DOF(body.z), 0) = 0.0;
        *position(motion, CZ_DOF(body.pitch), 0) = share * pitch;
        *velocity(motion, CZ_DOF(body.pitch), 0) =
            share < 1.0 ? 1.25 * pitch / (n * motion->step) : 0.0;
        motion_evaluate(motion);
    }
    return *position(motion, CZ_DOF(wheelset[3].z), 0) -
           *parameter(motion, CZ_PARAMETER(wheel.indentation[3]), 0);
}

/* Stretch of a suspension that hangs in its lift stop with a weight below it: the stop carries the
 * weight and the remaining force of the spring. */
static double hanging(double weight, double preload, double spring, double stop, double gap) {
    return (weight + preload + stop * gap) / (stop + spring);
}

/* By hand: l_c times pitch, less both gaps and the deflection of the stops; small angles neglect
 * terms of the second order, of points at most 1.6 m below the centre of rotation.
 */
static void a_pitching_car_lifts_its_wheels_by_its_stops(void **state) {
    (void)state;
    static const double pitches[] = {0.010, 0.012, 0.015};
    for (size_t i = 0; i < sizeof pitches / sizeof pitches[0]; i++) {
        Motion motion = motion_open("tests/physics/cases/standing.yaml", AS_WRITTEN);
        const double lift = lift_at(&motion, pitches[i]);
        const double wheelset = 9.80665 * mass(&motion, CZ_DOF(wheelset[0].z), 0);
        const double bogie = 9.80665 * mass(&motion, CZ_DOF(bogie[0].z), 0);
        const double secondary = hanging(
            bogie + 2.0 * wheelset, *parameter(&motion, CZ_PARAMETER(secondary_preload[1]), 0),
            *parameter(&motion, CZ_PARAMETER(secondary.stiffness), 0),
            *parameter(&motion, CZ_PARAMETER(secondary.lift_stiffness), 0), 0.030);
        const double primary =
            hanging(wheelset, *parameter(&motion, CZ_PARAMETER(primary_preload[3]), 0),
                    *parameter(&motion, CZ_PARAMETER(primary.stiffness), 0),
                    *parameter(&motion, CZ_PARAMETER(primary.lift_stiffness), 0), 0.025);
        const double travel = 7.85 * pitches[i];
        if (getenv("CZ_TOL_SCALE") != NULL)
            print_message("%g mm at %g mrad: l_c pitch %g mm, less gaps %g mm\n", 1e3 * lift,
                          1e3 * pitches[i], 1e3 * travel, 1e3 * (travel - 0.055));
        assert_near(lift, travel - secondary - primary, 0.0, 1.6 * pitches[i] * pitches[i]);
        assert_true(lift < travel - 0.055); /* elastic stops lift less than rigid ones */
        motion_close(&motion);
    }
}

static void open_gaps_lift_no_wheel(void **state) {
    (void)state;
    Motion motion = motion_open("tests/physics/cases/standing.yaml", AS_WRITTEN);
    assert_true(lift_at(&motion, 0.006) <= 0.0);
    motion_close(&motion);
}

/* Without lift stops the bogie stays on the rail: the spring just releases. */
static void without_stops_wheels_stay_on_the_rail(void **state) {
    (void)state;
    Motion motion = motion_open("tests/physics/cases/standing.yaml", AS_WRITTEN);
    *parameter(&motion, CZ_PARAMETER(secondary.lift_gap), 0) = 1e30;
    assert_true(lift_at(&motion, 0.015) <= 0.0);
    motion_close(&motion);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_coupler_folds_above_its_critical_force_and_not_below),
        cmocka_unit_test(a_train_of_twelve_cars_folds_at_1040_kn_and_not_at_1000),
        cmocka_unit_test(the_printed_force_is_where_the_integration_folds),
        cmocka_unit_test(the_printed_force_is_right_for_couplers_on_end_masses),
        cmocka_unit_test(a_pitching_car_lifts_its_wheels_by_its_stops),
        cmocka_unit_test(open_gaps_lift_no_wheel),
        cmocka_unit_test(without_stops_wheels_stay_on_the_rail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
