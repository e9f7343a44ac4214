/* Quantiles, Wilson's interval, rank correlations. */
#include "support/check.h"

#include "statistics/quantile.h"
#include "statistics/rank.h"
#include "statistics/share.h"

/* R: quantile(c(1, 2, 4, 8, 16), c(.05, .25, .5, .9, 1)). */
static void quantiles_are_those_of_definition_7(void **state) {
    double value[] = {8, 1, 16, 4, 2};
    (void)state;
    cz_sort_numbers(5, value);
    assert_near(cz_quantile_of(5, value, 0.05), 1.2, ROUNDING_OF_A_VALUE, 0);
    assert_near(cz_quantile_of(5, value, 0.25), 2, ROUNDING_OF_A_VALUE, 0);
    assert_near(cz_quantile_of(5, value, 0.5), 4, ROUNDING_OF_A_VALUE, 0);
    assert_near(cz_quantile_of(5, value, 0.9), 12.8, ROUNDING_OF_A_VALUE, 0);
    assert_near(cz_quantile_of(5, value, 1), 16, ROUNDING_OF_A_VALUE, 0);
    assert_near(cz_quantile_of(1, value, 0.3), 1, ROUNDING_OF_A_VALUE, 0);
    assert_true(isnan(cz_quantile_of(0, value, 0.3)));
}

static void a_quantile_that_needs_a_failed_run_is_infinite(void **state) {
    const double value[] = {-INFINITY, -INFINITY, 3, 4, 5};
    (void)state;
    assert_true(cz_quantile_of(5, value, 0.05) == -INFINITY);
    assert_true(cz_quantile_of(5, value, 0.25) == -INFINITY);
    assert_true(cz_quantile_of(5, value, 0.3) == -INFINITY);
    assert_near(cz_quantile_of(5, value, 0.5), 3, ROUNDING_OF_A_VALUE, 0);
}

static void mean_and_deviation_are_those_of_a_sample(void **state) {
    const double value[] = {2, 4, 4, 4, 5, 5, 7, 9};
    (void)state;
    assert_near(cz_mean_of(8, value), 5, ROUNDING_OF_A_VALUE, 0);
    assert_near(cz_deviation_of(8, value), sqrt(32.0 / 7), ROUNDING_OF_A_FORMULA, 0);
    assert_true(isnan(cz_mean_of(0, value)));
    assert_true(isnan(cz_deviation_of(1, value)));
}

/* R. G. Newcombe, Statistics in Medicine 17 (1998), table I, score method without correction. */
static void wilsons_interval_gives_its_published_numbers(void **state) {
    static const struct {
        int k, n;
        double low, high;
    } published[] = {{81, 263, 0.2553, 0.3662},
                     {15, 148, 0.0624, 0.1605},
                     {0, 20, 0, 0.1611},
                     {1, 29, 0.0061, 0.1718}};
    (void)state;
    for (size_t i = 0; i < sizeof published / sizeof *published; i++) {
        double low, high;
        cz_share_interval(published[i].k, published[i].n, &low, &high);
        /* published with four decimals */
        assert_near(low, published[i].low, 0, 5e-5);
        assert_near(high, published[i].high, 0, 5e-5);
        double mirrored_low, mirrored_high;
        cz_share_interval(published[i].n - published[i].k, published[i].n, &mirrored_low,
                          &mirrored_high);
        assert_near(mirrored_low, 1 - high, 0, ROUNDING_OF_A_FORMULA);
        assert_near(mirrored_high, 1 - low, 0, ROUNDING_OF_A_FORMULA);
    }
}

static void without_a_sample_the_share_is_anything(void **state) {
    double low, high;
    (void)state;
    cz_share_interval(0, 0, &low, &high);
    assert_near(low, 0, 0, 0);
    assert_near(high, 1, 0, 0);
}

static void equal_values_share_the_mean_of_their_ranks(void **state) {
    const double value[] = {7, 3, 7, -INFINITY, 7, 3};
    const double expected[] = {5, 2.5, 5, 1, 5, 2.5};
    double rank[6];
    (void)state;
    assert_true(cz_rank(6, value, rank));
    for (int i = 0; i < 6; i++)
        assert_near(rank[i], expected[i], 0, 0);
}

static double correlation(int n, const double *x, const double *y) {
    double x_rank[16], y_rank[16];
    assert_true(cz_rank(n, x, x_rank) && cz_rank(n, y, y_rank));
    return cz_rank_correlation(n, x_rank, y_rank);
}

static void rank_correlation_is_that_of_spearman(void **state) {
    /* Ten children's IQ and hours of television a week: -29/165, without equal values. */
    const double iq[] = {86, 97, 99, 100, 101, 103, 106, 110, 112, 113};
    const double hours[] = {2, 20, 28, 27, 50, 29, 7, 17, 6, 12};
    /* With equal values: ranks 1, 2.5, 2.5, 4 and 1, 3, 2, 4 give 4.5 / sqrt(4.5 * 5). */
    const double tied[] = {0, 1, 1, 2}, other[] = {1, 5, 3, 9};
    const double constant[] = {4, 4, 4, 4};
    const double curved[] = {0.1, 1, 10, 1000};
    (void)state;
    assert_near(correlation(10, iq, hours), -29.0 / 165, ROUNDING_OF_A_FORMULA, 0);
    assert_near(correlation(4, tied, other), 4.5 / sqrt(22.5), ROUNDING_OF_A_FORMULA, 0);
    assert_near(correlation(4, curved, (double[]){1, 2, 3, 4}), 1, ROUNDING_OF_A_FORMULA, 0);
    assert_near(correlation(4, curved, (double[]){4, 3, 2, 1}), -1, ROUNDING_OF_A_FORMULA, 0);
    assert_true(isnan(correlation(4, constant, other)));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quantiles_are_those_of_definition_7),
        cmocka_unit_test(a_quantile_that_needs_a_failed_run_is_infinite),
        cmocka_unit_test(mean_and_deviation_are_those_of_a_sample),
        cmocka_unit_test(wilsons_interval_gives_its_published_numbers),
        cmocka_unit_test(without_a_sample_the_share_is_anything),
        cmocka_unit_test(equal_values_share_the_mean_of_their_ranks),
        cmocka_unit_test(rank_correlation_is_that_of_spearman)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
