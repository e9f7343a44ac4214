/* Sweeps: each point equals the problem run alone, whatever other points there are. */
#include "support/check.h"

#include "crushzone/sweep.h"

static const char file[] = "problems/two-cars-25kmh.yaml";
static const char *const metric[] = {"interfaces.peak_force_kN", "vehicles.max_pitch_mrad"};
static const CzSweepAxis speed = {.path = "trains.A.speed_km_h", .from = 10, .to = 40, .n = 4};
static const CzSweepAxis height = {
    .path = "trains.B.height_offset_mm", .from = -40, .to = 40, .n = 3};

static CzSweepOptions options_of(const CzSweepAxis *axis, int n_axis) {
    CzSweepOptions options = cz_sweep_options_default();
    options.n_axis = n_axis;
    options.axis = axis;
    options.n_metric = 2;
    options.metric = metric;
    options.n_job = 2;
    return options;
}

static CzSweep *sweep_with(const CzSweepOptions *options) {
    CzSweep *sweep = NULL;
    CzError error = {0};
    const CzStatus status = cz_sweep(file, NULL, options, &sweep, &error);
    if (status != CZ_OK)
        print_error("%s\n", error.message);
    assert_int_equal(status, CZ_OK);
    return sweep;
}

/* Peak force of the file with one setting [N]. */
static double peak_force_with(const char *setting) {
    CzProblemOptions options = cz_problem_options_default();
    options.set = &setting;
    options.n_set = 1;
    CzProblem *problem = NULL;
    CzModel *model = NULL;
    CzRun *run = NULL;
    CzError error = {0};
    assert_int_equal(cz_problem_read(file, &options, &problem, &error), CZ_OK);
    assert_int_equal(cz_model_build(problem, 0, &model, &error), CZ_OK);
    assert_int_equal(cz_simulate(model, NULL, &run, &error), CZ_OK);
    const double force = cz_run_summary(run)->interface[0].peak_force;
    cz_run_free(run);
    cz_model_free(model);
    cz_problem_free(problem);
    return force;
}

static void a_point_is_the_problem_with_that_value(void **state) {
    (void)state;
    const CzSweepOptions options = options_of(&speed, 1);
    CzSweep *sweep = sweep_with(&options);
    assert_int_equal(sweep->n_point, 4);
    for (int i = 0; i < 4; i++) {
        char setting[64];
        snprintf(setting, sizeof setting, "trains.A.speed_km_h=%d", 10 + 10 * i);
        assert_int_equal(sweep->point[i].state, CZ_SWEEP_DONE);
        assert_near(sweep->point[i].value[0], 10 + 10 * i, 0, 0);
        assert_near(sweep->point[i].metric[0], peak_force_with(setting) / 1e3, 0, 0);
    }
    /* In this problem a higher speed has a smaller margin, so the last point is the worst. */
    assert_int_equal(sweep->worst, 3);
    assert_true(sweep->point[3].margin < sweep->point[0].margin);
    assert_int_equal(sweep->point[3].verdict, CZ_VERDICT_FAIL);
    assert_string_equal(sweep->point[3].scenario, "collision");
    cz_sweep_free(sweep);
}

/* The bogies of this file weigh 2300 kg, with two wheelsets of 1600 kg each. */
static void the_acceleration_of_a_link_is_its_force_over_the_bogie(void **state) {
    (void)state;
    static const char *const link[] = {"vehicles.link_force_kN", "vehicles.link_acceleration_g"};
    const CzSweepAxis fast = {.path = "trains.A.speed_km_h", .from = 25, .to = 40, .n = 2};
    CzSweepOptions options = options_of(&fast, 1);
    options.metric = link;
    CzSweep *sweep = sweep_with(&options);
    for (int i = 0; i < 2; i++) {
        assert_true(sweep->point[i].metric[0] > 200);
        assert_near(sweep->point[i].metric[1], sweep->point[i].metric[0] / (5.5 * 9.80665), 1e-12,
                    0);
    }
    cz_sweep_free(sweep);
}

static void threads_change_no_bit(void **state) {
    (void)state;
    const CzSweepAxis axis[] = {speed, height};
    CzSweepOptions options = options_of(axis, 2);
    options.n_job = 1;
    CzSweep *alone = sweep_with(&options);
    options.n_job = 3;
    CzSweep *shared = sweep_with(&options);
    assert_int_equal(alone->n_point, 12);
    for (int i = 0; i < 12; i++) {
        assert_near(alone->point[i].value[0], 10 + 10 * (i / 3), 0, 0);
        assert_near(alone->point[i].value[1], -40 + 40 * (i % 3), 0, 0);
        assert_near(alone->point[i].metric[1], shared->point[i].metric[1], 0, 0);
        assert_near(alone->point[i].margin, shared->point[i].margin, 0, 0);
    }
    cz_sweep_free(alone);
    cz_sweep_free(shared);
}

static void only_the_checks_asked_for_judge(void **state) {
    (void)state;
    static const char *const check[] = {"override"};
    CzSweepOptions options = options_of(&speed, 1);
    options.n_check = 1;
    options.check = check;
    CzSweep *sweep = sweep_with(&options);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(sweep->point[i].verdict, CZ_VERDICT_PASS);
        assert_string_equal(sweep->point[i].check, "override");
    }
    cz_sweep_free(sweep);
    static const char *const unknown[] = {"climbing"};
    options.check = unknown;
    CzError error = {0};
    assert_int_equal(cz_sweep(file, NULL, &options, &sweep, &error), CZ_STATUS_INPUT);
    assert_string_equal(error.message, "the problem has no check 'climbing'");
    assert_null(sweep);
}

/* Train B comes at 25 km/h: below -25 km/h the trains never meet, which the reader refuses. */
static void values_that_the_reader_refuses_are_invalid_points(void **state) {
    (void)state;
    const CzSweepAxis axis = {.path = "trains.A.speed_km_h", .from = -40, .to = 10, .n = 2};
    const CzSweepOptions options = options_of(&axis, 1);
    CzSweep *sweep = sweep_with(&options);
    assert_int_equal(sweep->point[0].state, CZ_SWEEP_INVALID);
    assert_true(sweep->point[0].message[0] != '\0');
    assert_true(isnan(sweep->point[0].metric[0]) && isnan(sweep->point[0].margin));
    assert_int_equal(sweep->point[1].state, CZ_SWEEP_DONE);
    assert_int_equal(sweep->worst, 1);
    cz_sweep_free(sweep);
}

static void a_run_that_is_cut_short_gives_no_point(void **state) {
    (void)state;
    const CzSweepAxis axis = {.path = "simulation.longest_s", .from = 0.05, .to = 6, .n = 2};
    const CzSweepOptions options = options_of(&axis, 1);
    CzSweep *sweep = sweep_with(&options);
    assert_int_equal(sweep->point[0].state, CZ_SWEEP_RUN_FAILED);
    assert_non_null(strstr(sweep->point[0].message, "did not meet its end criterion"));
    assert_int_equal(sweep->point[1].state, CZ_SWEEP_DONE);
    assert_int_equal(sweep->worst, 0);
    cz_sweep_free(sweep);
}

static void a_problem_that_is_invalid_at_every_point_is_refused(void **state) {
    (void)state;
    CzSweep *sweep = NULL;
    CzError error = {0};
    const CzSweepAxis axis = {.path = "trains.C.speed_km_h", .from = 10, .to = 40, .n = 4};
    CzSweepOptions options = options_of(&axis, 1);
    assert_int_equal(cz_sweep(file, NULL, &options, &sweep, &error), CZ_STATUS_INPUT);
    static const char *const wrong[] = {"vehicles.lift", "vehicles.max_pitch_mrad"};
    options = options_of(&speed, 1);
    options.metric = wrong;
    assert_int_equal(cz_sweep(file, NULL, &options, &sweep, &error), CZ_STATUS_INPUT);
    options = options_of(&speed, 3);
    assert_int_equal(cz_sweep(file, NULL, &options, &sweep, &error), CZ_STATUS_INPUT);
    assert_null(sweep);
}

static void an_interrupted_sweep_has_points_that_were_not_run(void **state) {
    (void)state;
    const volatile sig_atomic_t stop = 1;
    CzSweepOptions options = options_of(&speed, 1);
    options.stop = &stop;
    CzSweep *sweep = sweep_with(&options);
    assert_true(sweep->is_interrupted);
    assert_int_equal(sweep->point[0].state, CZ_SWEEP_NOT_RUN);
    assert_int_equal(sweep->worst, -1);
    cz_sweep_free(sweep);
}

static void axes_are_read_from_text(void **state) {
    (void)state;
    CzSweepAxis axis;
    CzError error = {0};
    assert_int_equal(cz_sweep_axis_parse("a.b_kN=-1.5:1e2:5", &axis, &error), CZ_OK);
    assert_string_equal(axis.path, "a.b_kN");
    assert_near(axis.from, -1.5, 0, 0);
    assert_near(axis.to, 100, 0, 0);
    assert_int_equal(axis.n, 5);
    assert_near(cz_sweep_axis_value(&axis, 4), 100, 0, 0);
    static const char *const wrong[] = {"a=1:2",     "a=1:2:1",   "=1:2:3",   "1:2:3", "a=x:2:3",
                                        "a=1:2:501", "a=1:2:3:4", "a=1",      "a=1,",  "a=1,,2",
                                        "a=1,x",     "a=1,2,1",   "a=1,2:3:4"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        assert_int_equal(cz_sweep_axis_parse(wrong[i], &axis, &error), CZ_STATUS_INPUT);
    assert_int_equal(cz_sweep_axis_parse("a.b_kN=25,8,-1.5e1", &axis, &error), CZ_OK);
    assert_int_equal(axis.n, 3);
    assert_near(cz_sweep_axis_value(&axis, 0), -15, 0, 0);
    assert_near(cz_sweep_axis_value(&axis, 1), 8, 0, 0);
    assert_near(cz_sweep_axis_value(&axis, 2), 25, 0, 0);
}

static void a_list_has_the_points_of_its_values(void **state) {
    (void)state;
    CzSweepAxis axis[2];
    CzError error = {0};
    assert_int_equal(cz_sweep_axis_parse("trains.A.speed_km_h=20,10", &axis[0], &error), CZ_OK);
    assert_int_equal(cz_sweep_axis_parse("trains.B.height_offset_mm=0,30", &axis[1], &error),
                     CZ_OK);
    const CzSweepOptions options = options_of(axis, 2);
    CzSweep *sweep = sweep_with(&options);
    assert_int_equal(sweep->n_point, 4);
    assert_near(sweep->point[0].value[0], 10, 0, 0);
    assert_near(sweep->point[1].value[1], 30, 0, 0);
    assert_near(sweep->point[2].metric[0], peak_force_with("trains.A.speed_km_h=20") / 1e3, 0, 0);
    cz_sweep_free(sweep);
}

static void curves_are_those_of_the_points(void **state) {
    (void)state;
    CzSweepOptions options = options_of(&speed, 1);
    options.curves = true;
    CzSweep *sweep = sweep_with(&options);
    assert_int_equal(sweep->n_curve, 4);
    assert_string_equal(sweep->curve_scenario, "collision");
    for (int i = 0; i < 4; i++) {
        const CzSweepCurve *curve = &sweep->curve[i];
        double peak = 0;
        for (int k = 0; k < curve->n; k++)
            peak = fmax(peak, curve->force[k]);
        assert_int_equal(curve->point, i);
        assert_near(curve->speed[0], sweep->point[i].value[0] / 3.6, ROUNDING_OF_A_FORMULA, 0);
        /* Samples are 1 ms apart; the only interface has the peak force of the point. */
        assert_near(peak, sweep->point[i].metric[0], 0.2, 0);
        assert_near(curve->closure[0], 0, 0, 1e-9); /* the first contact, in mm */
    }
    cz_sweep_free(sweep);
}

static void of_many_points_some_have_curves(void **state) {
    (void)state;
    const CzSweepAxis axis = {.path = "trains.A.speed_km_h", .from = 10, .to = 24, .n = 15};
    CzSweepOptions options = options_of(&axis, 1);
    options.curves = true;
    CzSweep *sweep = sweep_with(&options);
    assert_int_equal(sweep->n_curve, CZ_MAX_SWEPT_CURVES);
    assert_int_equal(sweep->curve[0].point, 0);
    assert_int_equal(sweep->curve[CZ_MAX_SWEPT_CURVES - 1].point, 14);
    for (int i = 1; i < sweep->n_curve; i++)
        assert_true(sweep->curve[i].point > sweep->curve[i - 1].point);
    cz_sweep_free(sweep);
}

/* Two trains with a third beside them, and scenarios that set values themselves. */
static const char scenarios[] =
    "extends: two-cars-25kmh.yaml\n"
    "trains:\n"
    "  - {name: C, speed_km_h: -20, brake: {ratio: 0, axle_share: 0}, vehicles: [{name: C1, use: "
    "paper-car, reversed: true}]}\n"
    "scenarios:\n"
    "  - {name: as-written}\n"
    "  - {name: own-speed, speed_km_h: 12}\n"
    "  - {name: like-it, like: own-speed}\n"
    "  - {name: like-it-but, like: own-speed, speed_km_h: 14}\n"
    "  - {name: partner, partner_speed_km_h: -12, height_offset_mm: 10, friction: 0.2}\n"
    "  - {name: other, trains: [A, C]}\n"
    "  - {name: changed, changes: [{path: trains.B.vehicles.B1.mass_t, value: 40}]}\n"
    "  - {name: scaled, changes: [{path: trains.B.vehicles.B1.mass_t, factor: 1.1}]}\n";

/* The scenarios that a sweep of a path does not reach, such as "own-speed:speed_km_h ". */
static void finds_unreached(const char *path, double from, double to, const char *expected) {
    CzSweepAxis axis = {.from = from, .to = to, .n = 2};
    CzProblemOptions problem_options = cz_problem_options_default();
    CzSweepOptions options = options_of(&axis, 1);
    CzSweep *sweep = NULL;
    CzError error = {0};
    char text[8192] = "", found[512] = "";
    snprintf(axis.path, sizeof axis.path, "%s", path);
    snprintf(text, sizeof text, "%s", scenarios);
    options.text = text;
    options.n_text = strlen(text);
    problem_options.share_folder = "problems";
    const CzStatus status = cz_sweep(file, &problem_options, &options, &sweep, &error);
    if (status != CZ_OK)
        print_error("%s\n", error.message);
    assert_int_equal(status, CZ_OK);
    for (int i = 0; i < sweep->n_unreached; i++) {
        const size_t n = strlen(found);
        snprintf(found + n, sizeof found - n, "%s:%s ", sweep->unreached[i].scenario,
                 sweep->unreached[i].by);
    }
    assert_string_equal(found, expected);
    cz_sweep_free(sweep);
}

static void a_scenario_that_sets_the_value_itself_is_named(void **state) {
    (void)state;
    finds_unreached("trains.A.speed_km_h", 10, 20,
                    "own-speed:speed_km_h like-it:speed_km_h like-it-but:speed_km_h ");
    finds_unreached("scenarios.own-speed.speed_km_h", 10, 20, "like-it-but:speed_km_h ");
    finds_unreached("trains.B.speed_km_h", -10, -20, "partner:partner_speed_km_h other:trains ");
    finds_unreached("trains.B.height_offset_mm", 0, 20, "partner:height_offset_mm other:trains ");
    finds_unreached("simulation.adhesion.friction", 0.1, 0.3, "partner:friction ");
    finds_unreached("trains.B.vehicles.B1.mass_t", 30, 34, "other:trains changed:changes ");
    finds_unreached("parts.anti-climber.gap_mm", 310, 320, "");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_point_is_the_problem_with_that_value),
        cmocka_unit_test(the_acceleration_of_a_link_is_its_force_over_the_bogie),
        cmocka_unit_test(threads_change_no_bit),
        cmocka_unit_test(only_the_checks_asked_for_judge),
        cmocka_unit_test(values_that_the_reader_refuses_are_invalid_points),
        cmocka_unit_test(a_run_that_is_cut_short_gives_no_point),
        cmocka_unit_test(a_problem_that_is_invalid_at_every_point_is_refused),
        cmocka_unit_test(an_interrupted_sweep_has_points_that_were_not_run),
        cmocka_unit_test(axes_are_read_from_text),
        cmocka_unit_test(a_list_has_the_points_of_its_values),
        cmocka_unit_test(curves_are_those_of_the_points),
        cmocka_unit_test(of_many_points_some_have_curves),
        cmocka_unit_test(a_scenario_that_sets_the_value_itself_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
