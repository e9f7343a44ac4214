/* Curves of known laws return these laws; other curves keep their energy exactly. */
#include "fit/curves.h"

/* The law absorbs the energy of the curve, to the rounding of sums of some thousand terms. */
static void energy_is_equal(const CzFit *fit, double energy) {
    assert_near(cz_fit_summary(fit)->energy, energy, 1e-12, 0.0);
    assert_near(cz_fit_summary(fit)->law_energy, energy, 1e-12, 0.0);
}

/* Values of a law are rounded to five digits. */
#define FIVE_DIGITS 5e-5

/* Four standard deviations of the mean of n values with an even noise of this share. */
static double of_mean(double share, int n) {
    return 4.0 * share / sqrt(3.0) / sqrt(n);
}

/* A force at the free end of a line through n such values is twice as uncertain as their mean. */
static double of_line_end(double share, int n) {
    return 2.0 * of_mean(share, n);
}

static Curve curve; /* large; each test starts it afresh */

static const CzStage two_plateaus[] = {{.stroke = 0.2, .force = 5e5, .end_force = NAN},
                                       {.stroke = 0.25, .force = 7e5, .end_force = NAN}};

/* A break is found at a point of the curve, so to half of the distance between two points; the same
 * share of the step of 200 kN changes the mean of a plateau. */
static void plateaus_and_their_trigger_are_recovered(void **state) {
    (void)state;
    curve.n = 0;
    load_plastic(&curve, two_plateaus, 2, 8e5, 0.015, 2.5e8);
    CzFit *fit = fit_of(&curve, CZ_FIT_ANTI_CLIMBER, -1);
    energy_is_equal(fit, work_of_loading(&curve));
    assert_true(isnan(value_of(fit, "stages[2].force_kN")));
    const double half = 0.5 * 450.0 / 2000;
    assert_near(value_of(fit, "stages[0].stroke_mm"), 200.0, FIVE_DIGITS, half);
    assert_near(value_of(fit, "stages[1].stroke_mm"), 250.0, FIVE_DIGITS, half);
    assert_near(value_of(fit, "stages[0].force_kN"), 500.0, FIVE_DIGITS, 200.0 * half / 200.0);
    assert_near(value_of(fit, "stages[1].force_kN"), 700.0, FIVE_DIGITS, 200.0 * half / 250.0);
    assert_near(value_of(fit, "trigger_kN"), 800.0, 1e-9, 0.0); /* a point of the curve */
    assert_near(value_of(fit, "trigger_length_mm"), 15.0, FIVE_DIGITS, half);
    assert_near(value_of(fit, "stiffness_MN_m"), 250.0, FIVE_DIGITS, 0.0);
    cz_fit_free(fit);
}

/* Between two plateaus the law rises over 5 mm, and noise moves the break within that; each plateau
 * has a thousand points, less a few. The mean square of an even noise is a third of its own square:
 * of 3 % of 500 to 700 kN 9 to 12 kN, and half or twice that with the stroke's noise at the steps.
 */
static void noise_moves_plateaus_a_little_and_costs_no_energy(void **state) {
    (void)state;
    curve.n = 0;
    load_plastic(&curve, two_plateaus, 2, 8e5, 0.015, 2.5e8);
    make_noisy(&curve, 0.03, 2e-4);
    const double energy = work_of_loading(&curve);
    CzFit *fit = fit_of(&curve, CZ_FIT_ANTI_CLIMBER, -1);
    energy_is_equal(fit, energy);
    assert_true(isnan(value_of(fit, "stages[2].force_kN")));
    const double half = 2.5;
    assert_near(value_of(fit, "stages[0].stroke_mm"), 200.0, 0.0, half);
    assert_near(value_of(fit, "stages[0].force_kN"), 500.0, of_mean(0.03, 800),
                200.0 * half / 200.0);
    assert_near(value_of(fit, "stages[1].force_kN"), 700.0, of_mean(0.03, 1000),
                200.0 * half / 250.0);
    assert_near(value_of(fit, "trigger_kN"), 800.0, 0.03, 0.0); /* one noisy point */
    assert_in_range((int)(cz_fit_summary(fit)->mean_square / 1e3), 5, 20);
    cz_fit_free(fit);
}

static void the_requested_number_of_plateaus_is_fitted(void **state) {
    (void)state;
    for (int n = 1; n <= 8; n++) {
        char path[40];
        curve.n = 0;
        load_plastic(&curve, two_plateaus, 2, NAN, 0.01, 2e8);
        make_noisy(&curve, 0.05, 0.0);
        CzFit *fit = fit_of(&curve, CZ_FIT_ANTI_CLIMBER, n);
        energy_is_equal(fit, work_of_loading(&curve));
        snprintf(path, sizeof path, "stages[%d].force_kN", n - 1);
        assert_true(value_of(fit, path) > 0.0);
        snprintf(path, sizeof path, "stages[%d].force_kN", n);
        assert_true(isnan(value_of(fit, path)));
        cz_fit_free(fit);
    }
}

/* More stages never leave a larger residual, because a stage can be cut in two, apart from rounding
 * to five digits.
 */
static void more_stages_give_a_smaller_residual(void **state) {
    (void)state;
    double before = INFINITY;
    for (int n = 1; n <= 6; n++) {
        curve.n = 0;
        for (int i = 0; i <= 500; i++)
            add_point(&curve, 0.5 * i / 500, 4e5 + 1e6 * (i / 500.0) * (i / 500.0));
        CzFit *fit = fit_of(&curve, CZ_FIT_ANTI_CLIMBER, n);
        energy_is_equal(fit, work_of_loading(&curve));
        const double left = cz_fit_summary(fit)->mean_square;
        assert_true(left < before);
        before = left;
        cz_fit_free(fit);
    }
    /* Six equal strokes of a curve of 1 MN x^2 rise by 1, 3, ... 11 parts of 36, and the residual
     * of a plateau is its rise over the root of 12; the best strokes leave less. */
    assert_true(before < 1e6 / 36.0 * sqrt((1 + 9 + 25 + 49 + 81 + 121) / 6.0 / 12.0));
}

/* The mean force is the least squares of one plateau, and also follows from the energy. */
static void one_plateau_is_the_mean_force(void **state) {
    (void)state;
    curve.n = 0;
    for (int i = 0; i <= 100; i++)
        add_point(&curve, 0.3 * i / 100, 5e5 + (i % 2 == 0 ? 2e4 : -2e4));
    CzFit *fit = fit_of(&curve, CZ_FIT_ANTI_CLIMBER, 1);
    assert_near(value_of(fit, "stages[0].force_kN"), 500.0, 1e-9, 0.0);
    assert_near(value_of(fit, "stages[0].stroke_mm"), 300.0, 1e-9, 0.0);
    assert_near(cz_fit_summary(fit)->largest_difference, 2e4, 1e-9, 0.0);
    cz_fit_free(fit);
}

/* ---- ends ---- */

static const CzStage end_stages[] = {{.stroke = 0.02, .force = 1.2e6},
                                     {.stroke = 0.06, .force = 1.0e6},
                                     {.stroke = 0.32, .force = 1.5e6},
                                     {.stroke = 0.2, .force = 4.5e6}};

/* From 4.5 MN along 100 MN/m to one half, then along 30 MN/m to zero. */
static void load_end(Curve *made) {
    made->n = 0;
    load_lines(made, 0.0, end_stages, 4, 1200);
    const double peak = 4.5e6, turn = 0.6 - 0.5 * peak / 1e8;
    for (int i = 1; i <= 100; i++) {
        const double force = peak * (1.0 - i / 100.0);
        add_point(made,
                  force > 0.5 * peak ? 0.6 - (peak - force) / 1e8
                                     : turn - (0.5 * peak - force) / 3e7,
                  force);
    }
}

/* All breaks are points of the curve: the tolerance is rounding. */
static void four_stages_and_two_unloading_stages_are_recovered(void **state) {
    (void)state;
    char path[40];
    load_end(&curve);
    CzFit *fit = fit_of(&curve, CZ_FIT_END, -1);
    energy_is_equal(fit, work_of_loading(&curve));
    for (int i = 0; i < 4; i++) {
        snprintf(path, sizeof path, "stages[%d].stroke_mm", i);
        assert_near(value_of(fit, path), 1e3 * end_stages[i].stroke, FIVE_DIGITS, 0.0);
        snprintf(path, sizeof path, "stages[%d].force_kN", i);
        assert_near(value_of(fit, path), 1e-3 * end_stages[i].force, FIVE_DIGITS, 0.0);
    }
    assert_near(value_of(fit, "unloading_stiffness_MN_m"), 100.0, FIVE_DIGITS, 0.0);
    assert_near(value_of(fit, "unloading_share"), 0.5, FIVE_DIGITS, 0.0);
    assert_near(value_of(fit, "second_unloading_stiffness_MN_m"), 30.0, FIVE_DIGITS, 0.0);
    assert_near(cz_fit_summary(fit)->law_returned, cz_fit_summary(fit)->returned, 3.0 * FIVE_DIGITS,
                0.0); /* of two stiffnesses and a share */
    cz_fit_free(fit);
}

/* The last line has 400 points and a free end; where it meets the one before, its own noise counts
 * too, which is twice as large there. Unloading is 100 points. */
static void a_noisy_end_keeps_its_energies(void **state) {
    (void)state;
    load_end(&curve);
    make_noisy(&curve, 0.04, 5e-4);
    CzFit *fit = fit_of(&curve, CZ_FIT_END, -1);
    energy_is_equal(fit, work_of_loading(&curve));
    assert_near(value_of(fit, "stages[3].force_kN"), 4500.0, of_line_end(0.04, 400), 0.0);
    assert_near(value_of(fit, "stages[2].force_kN"), 1500.0, 2.0 * of_line_end(0.04, 400), 0.0);
    assert_near(cz_fit_summary(fit)->law_returned, cz_fit_summary(fit)->returned,
                of_mean(0.04, 100), 0.0);
    cz_fit_free(fit);
}

/* A peak that noise has cut off is not a first unloading stage, which would be hundreds of times as
 * stiff as the line and require a much shorter time step. The 0.1 mm by which the curve falls from
 * its peak add 150 J to the 5625 J of the line. */
static void a_straight_unloading_stays_one_line(void **state) {
    (void)state;
    curve.n = 0;
    const CzStage stages[] = {{.stroke = 0.02, .force = 1e6}, {.stroke = 0.3, .force = 1.5e6}};
    load_lines(&curve, 0.0, stages, 2, 320);
    curve.f[curve.n - 1] = 1.53e6;
    for (int i = 0; i <= 15; i++)
        add_point(&curve, 0.3199 - 5e-4 * i, 1.5e6 - 1e5 * i);
    CzFit *fit = fit_of(&curve, CZ_FIT_END, 2);
    assert_near(value_of(fit, "unloading_stiffness_MN_m"), 200.0 / (1.0 + 150.0 / 5625.0),
                2.0 * FIVE_DIGITS, 0.0);
    assert_near(value_of(fit, "second_unloading_stiffness_MN_m"),
                value_of(fit, "unloading_stiffness_MN_m"), 1e-9, 0.0);
    cz_fit_free(fit);
}

static void an_end_that_does_not_unload_gets_a_stiffness_that_the_law_allows(void **state) {
    (void)state;
    curve.n = 0;
    const CzStage steep[] = {{.stroke = 0.1, .force = 1e6}, {.stroke = 0.02, .force = 9e6}};
    load_lines(&curve, 0.0, steep, 2, 240);
    CzFit *fit = fit_of(&curve, CZ_FIT_END, 2);
    energy_is_equal(fit, work_of_loading(&curve));
    assert_true(value_of(fit, "unloading_stiffness_MN_m") >= 400.0); /* the second stage's rise */
    assert_true(cz_fit_summary(fit)->n_note >= 2);
    cz_fit_free(fit);
}

/* ---- couplers ---- */

/* Buffer to 400 kN in 50 mm, its stop, a tube of 600 kN x 250 mm from a trigger of 700 kN, its
 * stop, shear-off at 911 kN over 10 mm, free travel; all behind 200 MN/m. */
static void load_coupler(Curve *made) {
    const double stop = 1e9, elastic = 2e8;
    double u = 0.05 + 3e5 / stop;
    made->n = 0;
    for (int i = 0; i <= 200; i++)
        add_point(made, 0.05 * i / 200, 4e5 * i / 200);
    for (int i = 0; i <= 1000; i++)
        add_point(made, u + 0.25 * i / 1000, 6e5 + 1e5 * fmax(1.0 - 0.25 * i / 1000 / 0.01, 0.0));
    u += 0.25 + 3.11e5 / stop;
    for (int i = 0; i <= 50; i++)
        add_point(made, u + 0.01 * i / 50, 9.11e5 * (1.0 - i / 50.0));
    add_point(made, u + 0.16, 0.0);
    for (int i = 0; i < made->n; i++)
        made->x[i] += made->f[i] / elastic;
}

#define STOP 0.3                   /* between buffer and tube [mm] */
#define HALF_OF_FRONT_POINTS 0.125 /* points of buffer and tube are 0.25 mm apart [mm] */
#define HALF_OF_REAR_POINTS 0.1    /* those behind 0.2 mm [mm] */

/* The stop is shared out between buffer and tube: strokes grow by as much at most, and forces
 * change in proportion. A break is found to half of the distance between two points. */
static void a_coupler_is_fitted_by_buffer_tube_and_shear_off(void **state) {
    (void)state;
    load_coupler(&curve);
    CzFit *fit = fit_of(&curve, CZ_FIT_COUPLER, -1);
    energy_is_equal(fit, work_of_loading(&curve));
    assert_near(value_of(fit, "buffer.stages[0].stroke_mm"), 50.0, 0.0,
                STOP + HALF_OF_FRONT_POINTS);
    assert_near(value_of(fit, "buffer.stages[0].force_kN"), 400.0, STOP / 50.0, 0.0);
    assert_near(value_of(fit, "tube.stages[0].stroke_mm"), 250.0, 0.0, STOP + HALF_OF_FRONT_POINTS);
    assert_near(value_of(fit, "tube.stages[0].force_kN"), 600.0, STOP / 250.0 + FIVE_DIGITS, 0.0);
    assert_near(value_of(fit, "tube.trigger_kN"), 700.0, ROUNDING_OF_A_SUM, 0.0);
    assert_near(value_of(fit, "shear_off.force_kN"), 911.0, ROUNDING_OF_A_SUM, 0.0);
    assert_near(value_of(fit, "shear_off.softening_length_mm"), 10.0, 0.0, HALF_OF_REAR_POINTS);
    assert_near(value_of(fit, "shear_off.retraction_space_mm"), 150.0, 0.0, HALF_OF_REAR_POINTS);
    assert_true(isnan(value_of(fit, "tube.stages[1].force_kN")));
    cz_fit_free(fit);
}

/* The steps between the members are ten times the noise, so strokes change by two points, the stop
 * and the noise of 0.1 mm; the tube has 1000 points, the peak of the shear-off one. */
static void a_noisy_coupler_has_the_same_members(void **state) {
    (void)state;
    load_coupler(&curve);
    make_noisy(&curve, 0.03, 1e-4);
    CzFit *fit = fit_of(&curve, CZ_FIT_COUPLER, -1);
    assert_near(cz_fit_summary(fit)->law_energy, cz_fit_summary(fit)->energy, 1e-12, 0.0);
    assert_near(value_of(fit, "buffer.stages[0].stroke_mm"), 50.0, 0.0, STOP + 0.5 + 0.1);
    assert_near(value_of(fit, "tube.stages[0].stroke_mm"), 250.0, 0.0, STOP + 0.5 + 0.1);
    assert_near(value_of(fit, "tube.stages[0].force_kN"), 600.0,
                of_mean(0.03, 1000) + (STOP + 0.5 + 0.1) / 250.0, 0.0);
    assert_near(value_of(fit, "shear_off.force_kN"), 911.0, 0.03, 0.0);
    cz_fit_free(fit);
}

/* 600 kN in 80 mm with a preload, unloading along 0.35 of it: nothing is plastic. */
static void a_coupler_that_returns_completely_is_a_buffer_alone(void **state) {
    (void)state;
    curve.n = 0;
    const CzStage stage[] = {{.stroke = 0.08, .force = 6e5}};
    load_lines(&curve, 5e4, stage, 1, 160);
    const int n_loading = curve.n;
    for (int i = n_loading - 1; i >= 0; i--)
        add_point(&curve, curve.x[i], 0.35 * curve.f[i]);
    CzFit *fit = fit_of(&curve, CZ_FIT_COUPLER, -1);
    energy_is_equal(fit, 0.08 * 0.5 * (5e4 + 6e5));
    assert_near(value_of(fit, "buffer.preload_kN"), 50.0, FIVE_DIGITS, 0.0);
    assert_near(value_of(fit, "buffer.stages[0].force_kN"), 600.0, FIVE_DIGITS, 0.0);
    assert_near(value_of(fit, "buffer.unloading_share"), 0.35, FIVE_DIGITS, 0.0);
    assert_true(isnan(value_of(fit, "tube.stages[0].force_kN")));
    cz_fit_free(fit);
}

/* ---- curves as tests give them ---- */

/* Jumps of the force at one stroke, and repeated points, absorb no energy. The law rises along its
 * stiffness where the curve jumps, and its plateaus compensate the energy. */
static void duplicate_strokes_are_jumps(void **state) {
    (void)state;
    curve.n = 0;
    const double points[][2] = {{0, 0},     {0, 5e5},   {0.2, 5e5}, {0.2, 5e5},
                                {0.2, 8e5}, {0.3, 8e5}, {0.3, 8e5}};
    for (size_t i = 0; i < sizeof points / sizeof *points; i++)
        add_point(&curve, points[i][0], points[i][1]);
    CzFit *fit = fit_of(&curve, CZ_FIT_ANTI_CLIMBER, 2);
    energy_is_equal(fit, 0.2 * 5e5 + 0.1 * 8e5);
    const double usual_stiffness = 200e6; /* the curve shows none */
    const double share = 0.5 * 8e5 * 8e5 / usual_stiffness / (0.2 * 5e5 + 0.1 * 8e5);
    assert_near(value_of(fit, "stages[0].force_kN"), 500.0, share, 0.0);
    assert_near(value_of(fit, "stages[1].force_kN"), 800.0, share, 0.0);
    cz_fit_free(fit);
}

static void expect_refusal(const double points[][2], int n, int line, const char *sentence) {
    CzFit *fit = NULL;
    CzError error = {0};
    curve.n = 0;
    for (int i = 0; i < n; i++)
        add_point(&curve, points[i][0], points[i][1]);
    assert_int_equal(cz_fit_points(n, curve.x, curve.f, NULL, &fit, &error), CZ_STATUS_INPUT);
    assert_null(fit);
    assert_int_equal(error.line, line);
    if (strstr(error.message, sentence) == NULL)
        print_error("%s\n", error.message);
    assert_non_null(strstr(error.message, sentence));
}

#define REFUSED(line, sentence, ...)                                                               \
    do {                                                                                           \
        const double points[][2] = __VA_ARGS__;                                                    \
        expect_refusal(points, (int)(sizeof points / sizeof *points), line, sentence);             \
    } while (0)

/* A rise of 1 mm to 90 MN requires a transition stiffness that the reader refuses. */
static void a_law_beyond_the_ranges_of_a_problem_file_is_refused(void **state) {
    (void)state;
    CzFit *fit = NULL;
    CzError error = {0};
    CzFitOptions options = cz_fit_options_default();
    curve.n = 0;
    add_point(&curve, 0.0, 0.0);
    add_point(&curve, 0.001, 9e7);
    options.kind = CZ_FIT_COUPLER;
    options.n_stage = 0;
    assert_int_equal(cz_fit_points(curve.n, curve.x, curve.f, &options, &fit, &error),
                     CZ_STATUS_VIOLATED);
    assert_null(fit);
    assert_non_null(strstr(error.message, "buffer.transition_stiffness_MN_m would be"));
}

static void a_buffer_never_falls(void **state) {
    (void)state;
    curve.n = 0;
    for (int i = 0; i <= 40; i++)
        add_point(&curve, 0.08 * i / 40, 3e5 + 2e5 * ((i * 7) % 5 < 2) - 3e3 * i);
    CzFit *fit = fit_of(&curve, CZ_FIT_COUPLER, 0);
    energy_is_equal(fit, work_of_loading(&curve));
    double before = value_of(fit, "buffer.preload_kN");
    for (int i = 0; i < 3; i++) {
        char path[40];
        snprintf(path, sizeof path, "buffer.stages[%d].force_kN", i);
        const double now = value_of(fit, path);
        assert_false(now < before);
        before = isnan(now) ? before : now;
    }
    cz_fit_free(fit);
}

static void an_invalid_curve_is_refused_with_its_point(void **state) {
    (void)state;
    REFUSED(2, "not finite", {{0, 0}, {0.1, NAN}});
    REFUSED(2, "not finite", {{0, 0}, {INFINITY, 1}});
    REFUSED(2, "a stroke of -5 mm is negative", {{0, 0}, {-0.005, 0}, {0.1, 1}});
    REFUSED(2, "check the unit", {{0, 0}, {100, 1e5}});
    REFUSED(2, "check the unit", {{0, 0}, {0.1, 1e9}});
    REFUSED(2, "a force of -90 kN is negative", {{0, 0}, {0.1, -9e4}, {0.2, 1e5}});
    REFUSED(1, "no point of the curve has a force", {{0, 0}, {0.1, 0}});
    REFUSED(3, "goes back from 200 to 100 mm before the largest",
            {{0, 0}, {0.2, 1e5}, {0.1, 1e5}, {0.3, 1e5}});
    REFUSED(4, "goes on from 100 to 200 mm again behind the largest",
            {{0, 0}, {0.3, 1e5}, {0.1, 1e4}, {0.2, 1e5}});
    REFUSED(1, "begins at a stroke of 100 mm with a force of 50 kN", {{0.1, 5e4}, {0.3, 1e5}});
    REFUSED(1, "the points are in the reverse order", {{0.3, 1e5}, {0.1, 5e4}, {0, 0}});
    REFUSED(1, "the forces are negative, down to -100 kN", {{0, 0}, {0.1, -5e4}, {0.3, -1e5}});
    REFUSED(2, "returns more energy", {{0, 0}, {0.2, 1e5}, {0, 7e4}});
    CzFit *fit = NULL;
    CzError error = {0};
    const double one[] = {0.0};
    assert_int_equal(cz_fit_points(1, one, one, NULL, &fit, &error), CZ_STATUS_INPUT);
    assert_non_null(strstr(error.message, "needs at least two points"));
    CzFitOptions options = cz_fit_options_default();
    options.n_stage = 9;
    assert_int_equal(cz_fit_points(1, one, one, &options, &fit, &error), CZ_STATUS_INPUT);
    assert_non_null(strstr(error.message, "9 stages; a law of kind anti-climber has 1 to 8"));
}

/* Curves of any size and few points are fitted with equal energy. */
static void small_and_large_curves_are_fitted_equally_well(void **state) {
    (void)state;
    for (int power = -2; power <= 0; power++) {
        const double scale = pow(10.0, power);
        curve.n = 0;
        add_point(&curve, 0.0, 0.0);
        add_point(&curve, 0.02 * scale, 6e6 * scale * scale);
        add_point(&curve, 0.5 * scale, 7e6 * scale * scale);
        for (int kind = 0; kind < CZ_N_FIT; kind++) {
            CzFit *fit = fit_of(&curve, (CzFitKind)kind, -1);
            energy_is_equal(fit, work_of_loading(&curve));
            cz_fit_free(fit);
        }
    }
    cz_fit_free(NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plateaus_and_their_trigger_are_recovered),
        cmocka_unit_test(noise_moves_plateaus_a_little_and_costs_no_energy),
        cmocka_unit_test(the_requested_number_of_plateaus_is_fitted),
        cmocka_unit_test(more_stages_give_a_smaller_residual),
        cmocka_unit_test(one_plateau_is_the_mean_force),
        cmocka_unit_test(four_stages_and_two_unloading_stages_are_recovered),
        cmocka_unit_test(a_noisy_end_keeps_its_energies),
        cmocka_unit_test(a_straight_unloading_stays_one_line),
        cmocka_unit_test(an_end_that_does_not_unload_gets_a_stiffness_that_the_law_allows),
        cmocka_unit_test(a_coupler_is_fitted_by_buffer_tube_and_shear_off),
        cmocka_unit_test(a_noisy_coupler_has_the_same_members),
        cmocka_unit_test(a_coupler_that_returns_completely_is_a_buffer_alone),
        cmocka_unit_test(duplicate_strokes_are_jumps),
        cmocka_unit_test(a_law_beyond_the_ranges_of_a_problem_file_is_refused),
        cmocka_unit_test(a_buffer_never_falls),
        cmocka_unit_test(an_invalid_curve_is_refused_with_its_point),
        cmocka_unit_test(small_and_large_curves_are_fitted_equally_well),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
