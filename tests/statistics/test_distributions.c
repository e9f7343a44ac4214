/* Logarithm, exponential, and the inverse distribution functions. */
#include "support/check.h"

#include "statistics/distribution.h"
#include "statistics/elementary.h"

enum { N = 20000 };

static void logarithm_and_exponential_agree_with_the_mathematics_library(void **state) {
    (void)state;
    for (int i = 1; i < N; i++) {
        const double x = i * 0.0007, y = (i - N / 2) * 0.06;
        /* near 1 the logarithm is a small difference: half a digit of 1 is allowed */
        assert_near(cz_logarithm(x), log(x), ROUNDING_OF_A_VALUE, 1.2e-16);
        assert_near(cz_exponential(y), exp(y), ROUNDING_OF_A_VALUE, 0);
    }
    assert_near(cz_logarithm(1), 0, 0, 0);
    assert_near(cz_exponential(0), 1, 0, 0);
    assert_near(cz_logarithm(1e-300), log(1e-300), ROUNDING_OF_A_VALUE, 0);
    assert_near(cz_logarithm(1e300), log(1e300), ROUNDING_OF_A_VALUE, 0);
}

/* The bits, which are the same with every compiler and mathematics library. */
static void values_have_the_recorded_bits(void **state) {
    static const double recorded[] = {
        0x1.7bac142e34cf3p+6, 0x1.762463000f856p+6, 0x1.67fce67f0bcd3p-1, 0x1.84368eb40dbcp+6,
        0x1.807eb1990b698p+6, 0x1.a16971672f5dap-1, 0x1.898085aa7a3afp+6, 0x1.879f6e4990f22p+6,
        0x1.c979c0f7366fp-1,  0x1.8de8820130246p+6, 0x1.8d6aa495c24f2p+6, 0x1.edc6098384991p-1,
        0x1.92177dfecfdbap+6, 0x1.92955b6a3db0ep+6, 0x1.097318fbfab99p+0, 0x1.967f7a5585c51p+6,
        0x1.986091b66f0dep+6, 0x1.1e82eeb7e6ac7p+0, 0x1.9bc9714bf244p+6,  0x1.9f814e66f4968p+6,
        0x1.3a02dcd69dec9p+0, 0x1.a453ebd1cb30dp+6, 0x1.a9db9cfff07aap+6, 0x1.6c19e3f72ff18p+0};
    (void)state;
    for (int i = 0; i < 8; i++) {
        const double u = (i + 0.5) / 8;
        assert_true(cz_normal_value(u, 90, 110) == recorded[3 * i]);
        assert_true(cz_triangular_value(u, 90, 110) == recorded[3 * i + 1]);
        assert_true(cz_lognormal_value(u, 0.5, 2) == recorded[3 * i + 2]);
    }
}

/* The share of a normal distribution below z that is cut at 3 deviations. */
static double share_below(double z) {
    return (erf(z / sqrt(2)) / erf(3 / sqrt(2)) + 1) / 2;
}

static void the_truncated_normal_variable_inverts_its_distribution(void **state) {
    (void)state;
    for (int i = 0; i < N; i++) {
        const double u = (i + 0.5) / N;
        assert_near(share_below(cz_truncated_normal(u)), u, 0, ROUNDING_OF_A_FORMULA);
    }
    assert_near(cz_truncated_normal(1e-17), -3, ROUNDING_OF_A_FORMULA, 0);
    assert_near(cz_truncated_normal(1 - 1e-16), 3, ROUNDING_OF_A_FORMULA, 0);
}

typedef double Distribution(double u, double low, double high);

/* Mean and deviation over evenly spaced shares, which is the midpoint rule. */
static void moments_of(Distribution *value, double low, double high, double *mean,
                       double *deviation) {
    double sum = 0, squares = 0;
    for (int i = 0; i < N; i++)
        sum += value((i + 0.5) / N, low, high) / N;
    for (int i = 0; i < N; i++) {
        const double difference = value((i + 0.5) / N, low, high) - sum;
        squares += difference * difference / N;
    }
    *mean = sum;
    *deviation = sqrt(squares);
}

/* The midpoint rule of 20000 points is exact within 1e-4 of the range. */
static void distributions_have_their_mean_and_deviation(void **state) {
    const double pi = 3.14159265358979;
    /* variance of a normal distribution cut at 3: 1 - 6 density(3) / share within */
    const double cut = sqrt(1 - 6 * exp(-4.5) / sqrt(2 * pi) / erf(3 / sqrt(2)));
    double mean, deviation;
    (void)state;
    moments_of(cz_uniform_value, 90, 110, &mean, &deviation);
    assert_near(mean, 100, 0, 2e-3);
    assert_near(deviation, 10 / sqrt(3), 0, 2e-3);
    moments_of(cz_normal_value, 90, 110, &mean, &deviation);
    assert_near(mean, 100, 0, 2e-3);
    assert_near(deviation, 10.0 / 3 * cut, 0, 2e-3);
    moments_of(cz_triangular_value, 90, 110, &mean, &deviation);
    assert_near(mean, 100, 0, 2e-3);
    assert_near(deviation, 10 / sqrt(6), 0, 2e-3);
}

static void a_lognormal_value_has_a_normal_logarithm(void **state) {
    (void)state;
    for (int i = 0; i < N; i++) {
        const double u = (i + 0.5) / N;
        const double z = log(cz_lognormal_value(u, 0.5, 2)) / (log(2) / 3);
        assert_near(share_below(z), u, 0, ROUNDING_OF_A_FORMULA);
    }
}

static void values_stay_within_their_range(void **state) {
    static Distribution *const all[] = {cz_uniform_value, cz_normal_value, cz_triangular_value,
                                        cz_lognormal_value};
    (void)state;
    for (int k = 0; k < 4; k++) {
        double before = 0.1;
        for (int i = 0; i < N; i++) {
            const double value = all[k]((i + 0.5) / N, 0.1, 0.35);
            assert_true(value >= before && value <= 0.35);
            before = value;
        }
        assert_true(all[k](0x1p-53, 0.1, 0.35) >= 0.1);
        assert_true(all[k](1 - 0x1p-53, 0.1, 0.35) <= 0.35);
        assert_true(all[k](0.5, 3, 3) == 3);
    }
}

static void items_of_a_list_are_equally_likely(void **state) {
    int count[7] = {0};
    (void)state;
    for (int i = 0; i < 7000; i++)
        count[cz_discrete_index((i + 0.5) / 7000, 7)]++;
    for (int k = 0; k < 7; k++)
        assert_int_equal(count[k], 1000);
    assert_int_equal(cz_discrete_index(1 - 0x1p-53, 7), 6);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(logarithm_and_exponential_agree_with_the_mathematics_library),
        cmocka_unit_test(values_have_the_recorded_bits),
        cmocka_unit_test(the_truncated_normal_variable_inverts_its_distribution),
        cmocka_unit_test(distributions_have_their_mean_and_deviation),
        cmocka_unit_test(a_lognormal_value_has_a_normal_logarithm),
        cmocka_unit_test(values_stay_within_their_range),
        cmocka_unit_test(items_of_a_list_are_equally_likely)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
