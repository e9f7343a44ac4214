/* The CFC filter against the requirements of its standard. */
#include "support/check.h"

#include "simulate/filter.h"

enum { N = 4000 };
#define STEP 1e-3
#define PI 3.14159265358979323846

/* Amplitude of a filtered sine, from the middle of the samples. */
static double gain_of(double class_hz, double step, double frequency) {
    static double x[N], y[N];
    for (int i = 0; i < N; i++)
        x[i] = sin(2 * PI * frequency * step * i);
    assert_int_equal(cz_filter_cfc(class_hz, step, N, x, y), CZ_OK);
    double most = 0;
    for (int i = N / 4; i < 3 * N / 4; i++)
        most = fmax(most, fabs(y[i]));
    return most;
}

static double gain(double frequency) {
    return gain_of(60, STEP, frequency);
}

/* Samples of 0.1 ms miss the peak of 300 Hz by at most 1 - cos(0.03 pi), 0.4 %. */
static void the_classes_60_and_180_are_3_dB_down_at_100_and_300_Hz(void **state) {
    (void)state;
    const double down_3_dB = pow(10, -3.0 / 20);
    assert_near(gain_of(60, 1e-4, 100), down_3_dB, 0.005, 0);
    assert_near(gain_of(180, 1e-4, 300), down_3_dB, 0.005, 0);
    assert_near(gain_of(180, 1e-4, 1), 1, 1e-3, 0);
}

/* The published coefficients of CFC 60 at 0.1 ms have six digits. */
static void the_filter_has_the_published_coefficients(void **state) {
    (void)state;
    static double x[N], y[N], expected[N];
    const double a0 = 0.00145237, b1 = 1.88934, b2 = -0.895153;
    memset(x, 0, sizeof x);
    x[N / 2] = 1;
    assert_int_equal(cz_filter_cfc(60, 1e-4, N, x, y), CZ_OK);
    for (int pass = 0; pass < 2; pass++) {
        const double *in = pass == 0 ? x : expected;
        double out[N] = {0};
        for (int i = 2; i < N; i++) {
            const int at = pass == 0 ? i : N - 1 - i, on = pass == 0 ? -1 : 1;
            out[at] = a0 * (in[at] + 2 * in[at + on] + in[at + 2 * on]) + b1 * out[at + on] +
                      b2 * out[at + 2 * on];
        }
        memcpy(expected, out, sizeof out);
    }
    for (int i = 0; i < N; i++)
        assert_near(y[i], expected[i], 0, 2e-3 * expected[N / 2]);
}

/* Two passes of a second-order Butterworth filter by the bilinear transform: with the corner
 * w_d = 2 pi CFC 2.0775 warped as the transform does, |H|^2 is 1 / (1 + (w / w_d)^4) exactly. A
 * largest sample misses the peak of a sine of 100 Hz at 1 kHz by at most 1 - cos(pi / 10). */
static void the_gain_is_that_of_two_butterworth_passes(void **state) {
    (void)state;
    const double frequencies[] = {1, 10, 60, 100, 200};
    for (int i = 0; i < 5; i++) {
        const double corner = tan(PI * 60 * 2.0775 * STEP);
        const double ratio = tan(PI * frequencies[i] * STEP) / corner;
        const double expected = 1 / (1 + ratio * ratio * ratio * ratio);
        assert_near(gain(frequencies[i]), expected, 0.05, 1e-3);
    }
    assert_near(gain(100), 0.708, 0.05, 0); /* the class: 3 dB at 100 Hz */
}

static void the_filter_keeps_time_and_area(void **state) {
    (void)state;
    static double x[N], y[N];
    memset(x, 0, sizeof x);
    for (int i = 1990; i <= 2010; i++)
        x[i] = 5;
    assert_int_equal(cz_filter_cfc(60, STEP, N, x, y), CZ_OK);
    double before = 0, after = 0;
    for (int i = 0; i < N; i++) {
        before += x[i];
        after += y[i];
        assert_near(y[i], y[N - i < N ? N - i : 0], 0, 1e-9); /* symmetric about sample 2000 */
    }
    assert_near(after, before, 1e-9, 0);
}

static void a_constant_and_a_ramp_are_unchanged(void **state) {
    (void)state;
    static double x[N], y[N];
    for (int i = 0; i < N; i++)
        x[i] = 3;
    assert_int_equal(cz_filter_cfc(60, STEP, N, x, y), CZ_OK);
    for (int i = 0; i < N; i++)
        assert_near(y[i], 3, ROUNDING_OF_A_SUM, 0);
    for (int i = 0; i < N; i++)
        x[i] = 0.01 * i;
    assert_int_equal(cz_filter_cfc(60, STEP, N, x, y), CZ_OK);
    for (int i = 100; i < N - 100;
         i++) /* the two passes delay a ramp forwards and backwards equally */
        assert_near(y[i], x[i], 0, 1e-6);
}

static void short_records_and_sparse_samples_are_handled(void **state) {
    (void)state;
    double one = 7;
    assert_int_equal(cz_filter_cfc(60, STEP, 1, &one, &one), CZ_OK);
    assert_near(one, 7, ROUNDING_OF_A_SUM, 0);
    assert_int_equal(cz_filter_cfc(60, STEP, 0, NULL, NULL), CZ_OK);
    assert_true(cz_filter_fits(60, STEP));
    assert_false(cz_filter_fits(60, 2e-3));
    assert_false(cz_filter_fits(60, 0));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_classes_60_and_180_are_3_dB_down_at_100_and_300_Hz),
        cmocka_unit_test(the_filter_has_the_published_coefficients),
        cmocka_unit_test(the_gain_is_that_of_two_butterworth_passes),
        cmocka_unit_test(the_filter_keeps_time_and_area),
        cmocka_unit_test(a_constant_and_a_ramp_are_unchanged),
        cmocka_unit_test(short_records_and_sparse_samples_are_handled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
