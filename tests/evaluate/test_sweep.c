/* Sweeps: each point equals the problem run alone, whatever other points there are. */
#include "support/check.h"

#include "crushzone/sweep.h"

static const char file[] = "problems/two-cars-25kmh.yaml";
static const char *const metric[] = {"interfaces.peak_force_kN", "vehicles.max_pitch_mrad"};
static const CzSweepAxis speed = {"trains.A.speed_km_h", 10, 40, 4};
static const CzSweepAxis height = {"trains.B.height_offset_mm", -40, 40, 3};

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
    const CzSweepAxis fast = {"trains.A.speed_km_h", 25, 40, 2};
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
    const CzSweepAxis axis = {"trains.A.speed_km_h", -40, 10, 2};
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
    const CzSweepAxis axis = {"simulation.longest_s", 0.05, 6, 2};
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
    const CzSweepAxis axis = {"trains.C.speed_km_h", 10, 40, 4};
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
    static const char *const wrong[] = {"a=1:2",   "a=1:2:1",   "=1:2:3",   "1:2:3",
                                        "a=x:2:3", "a=1:2:501", "a=1:2:3:4"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        assert_int_equal(cz_sweep_axis_parse(wrong[i], &axis, &error), CZ_STATUS_INPUT);
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
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
