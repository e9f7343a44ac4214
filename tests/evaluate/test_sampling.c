/* Samples: known distributions, the same bytes for any threads and parts, failures by name. */
#include <stdbool.h>

#include "support/check.h"

#include "crushzone/sample.h"

/* Two rigid vehicles of 40 t, 25 km/h, and one plateau of 1 MN with an elastic stiffness k. The
 * plateau takes the energy E = mu v^2 / 2 less the elastic part of its last force:
 *
 *   crush = E / F - F / (2 k)
 */
static const char two_masses[] =
    "schema: 1\n"
    "title: two rigid vehicles and one plateau\n"
    "parts:\n"
    "  zone: {gap_mm: 0, stiffness_MN_m: 500, stages: [{stroke_mm: 2000, force_kN: 1000}]}\n"
    "trains:\n"
    "  - name: A\n"
    "    speed_km_h: 25\n"
    "    vehicles:\n"
    "      - {name: A1, model: rigid, mass_t: 40, front: {face_gap_m: 5, anti_climber: {use: "
    "zone}}}\n"
    "  - name: B\n"
    "    vehicles: [{name: B1, model: rigid, mass_t: 40, rear: {face_gap_m: 0}}]\n"
    "simulation: {longest_s: 6}\n"
    "checks:\n"
    "  design_rules: false\n"
    "  limits:\n"
    "    - {name: crush, metric: elements.anti-climber *.stroke_mm, max: 500, source: ours,\n"
    "       confidence: user}\n";

static const double limit = 0.5, stiffness = 500e6, nominal_force = 1e6;

/* Margin of the crush by the closed form at a factor on the force. */
static double margin_at(double factor) {
    const double speed = 25 / 3.6, energy = 20e3 * speed * speed / 2,
                 force = factor * nominal_force;
    return 1 - (energy / force - force / (2 * stiffness)) / limit;
}

/* The factor below which the crush exceeds the limit, by bisection. */
static double critical_factor(void) {
    double low = 0.5, high = 2;
    for (int i = 0; i < 60; i++)
        *(margin_at((low + high) / 2) < 0 ? &low : &high) = (low + high) / 2;
    return low;
}

/* Error of the simulation at its default step, as a share of the limit: measured 3e-5. */
#define ERROR_OF_STEP 1e-4

static CzStatus try_sample(const char *more, const CzSampleOptions *options, CzSampling **sampling,
                           CzError *error) {
    char text[4096];
    CzSampleOptions with = *options;
    const int n = snprintf(text, sizeof text, "%s%s", two_masses, more);
    with.text = text;
    with.n_text = (size_t)n;
    return cz_sample("", NULL, &with, sampling, error);
}

static CzSampling *sample(const char *more, const CzSampleOptions *options) {
    CzSampling *sampling = NULL;
    CzError error = {0};
    const CzStatus status = try_sample(more, options, &sampling, &error);
    if (status != CZ_OK)
        print_error("%s\n", error.message);
    assert_int_equal(status, CZ_OK);
    return sampling;
}

static const char force_scatter[] =
    "uncertainty:\n"
    "  parameters:\n"
    "    - {name: force, path: 'parts.zone.stages[0].force_kN', tolerance_percent: 10}\n";

/* ---- the closed form ---- */

static void each_sample_has_the_crush_of_its_force(void **state) {
    (void)state;
    CzSampleOptions options = cz_sample_options_default();
    options.n_sample = 60;
    CzSampling *sampling = sample(force_scatter, &options);
    assert_int_equal(sampling->n_run, 60);
    assert_int_equal(sampling->n_check, 1);
    for (int k = 0; k < 60; k++) {
        assert_int_equal(sampling->sample[k].state, CZ_SAMPLE_DONE);
        assert_near(sampling->margin[k], margin_at(sampling->value[k]), 0, ERROR_OF_STEP);
    }
    assert_near(sampling->check[0].nominal, margin_at(1), 0, ERROR_OF_STEP);
    assert_near(sampling->check[0].bare, margin_at(1), 0, ERROR_OF_STEP);
    cz_sampling_free(sampling);
}

/* The factor is 0.9 + 0.2 u, and each 200th of u has one sample, so a quantile and the share of
 * passing samples are met within one sample. */
static void the_crush_has_its_exact_distribution(void **state) {
    enum { N = 200 };
    (void)state;
    CzSampleOptions options = cz_sample_options_default();
    options.n_sample = N;
    CzSampling *sampling = sample(force_scatter, &options);
    for (int i = 0; i < CZ_N_SAMPLE_QUANTILE; i++) {
        const double u = cz_sample_quantile_share(i), width = 1.0 / N;
        const double quantile = sampling->check[0].margin.quantile[i];
        assert_true(quantile > margin_at(0.9 + 0.2 * (u - width)) - ERROR_OF_STEP);
        assert_true(quantile < margin_at(0.9 + 0.2 * (u + width)) + ERROR_OF_STEP);
    }
    const double passing = (1.1 - critical_factor()) / 0.2;
    assert_true(passing > 0.2 && passing < 0.8);
    assert_near(sampling->passing.share, passing, 0, 1.5 / N);
    assert_true(sampling->passing.low < passing && sampling->passing.high > passing);
    assert_int_equal(sampling->check[0].n_fail, N - sampling->passing.n_pass);
    assert_int_equal(sampling->judgement, CZ_VERDICT_FAIL);
    cz_sampling_free(sampling);
}

/* Root mean square error over seeds of the mean margin of 16 samples; the exact mean is the
 * integral by the midpoint rule. */
static double error_of_mean(const char *method) {
    enum { N = 16, N_SEED = 12, N_POINT = 10000 };
    char more[512];
    double exact = 0, squares = 0;
    for (int i = 0; i < N_POINT; i++)
        exact += margin_at(0.9 + 0.2 * (i + 0.5) / N_POINT) / N_POINT;
    snprintf(more, sizeof more, "%s  sampling: %s\n", force_scatter, method);
    for (int seed = 0; seed < N_SEED; seed++) {
        CzSampleOptions options = cz_sample_options_default();
        options.n_sample = N;
        options.seed = seed;
        CzSampling *sampling = sample(more, &options);
        double mean = 0;
        for (int k = 0; k < N; k++)
            mean += sampling->margin[k] / N;
        squares += (mean - exact) * (mean - exact) / N_SEED;
        cz_sampling_free(sampling);
    }
    return sqrt(squares);
}

/* Over one number the error of a Latin hypercube is that of random samples over 16, and of Sobol
 * points, whose shift is the same for all, over the square root of 12 less. */
static void even_samples_are_closer_to_the_mean_than_random_ones(void **state) {
    (void)state;
    const double random = error_of_mean("random");
    assert_true(error_of_mean("latin_hypercube") < 0.2 * random);
    assert_true(error_of_mean("sobol") < 0.3 * random);
}

static int find_draw(const CzSampling *sampling, const char *name) {
    for (int d = 0; d < sampling->n_draw; d++)
        if (strcmp(sampling->draw[d].name, name) == 0)
            return d;
    fail_msg("no draw '%s'", name);
    return -1;
}

/* A larger force shortens the crush; mass and speed lengthen it, the speed by its square. */
static void rank_correlations_have_the_right_signs(void **state) {
    (void)state;
    CzSampleOptions options = cz_sample_options_default();
    options.n_sample = 100;
    CzSampling *sampling =
        sample("uncertainty:\n"
               "  parameters:\n"
               "    - {name: force, path: 'parts.zone.stages[0].force_kN', tolerance_percent: 10}\n"
               "    - {name: mass, path: 'trains.*.vehicles.*.mass_t', tolerance_percent: 5}\n"
               "    - {name: speed, path: scenario.speed_km_h, min: 24.5, max: 25.5}\n"
               "    - {name: idle, path: 'parts.zone.stiffness_MN_m', "
               "tolerance_percent: 10}\n",
               &options);
    const double *correlation = sampling->check[0].correlation;
    assert_true(correlation[find_draw(sampling, "force")] > 0.7);
    assert_true(correlation[find_draw(sampling, "mass")] < -0.3);
    assert_true(correlation[find_draw(sampling, "speed")] < -0.2);
    /* almost without effect: within three deviations of 1 / sqrt(99) */
    assert_near(correlation[find_draw(sampling, "idle")], 0, 0, 0.3);
    assert_int_equal(sampling->check[0].strongest, find_draw(sampling, "force"));
    cz_sampling_free(sampling);
}

/* ---- the same bytes ---- */

static void assert_same(const CzSampling *a, const CzSampling *b) {
    const size_t n = (size_t)a->n_sample;
    assert_int_equal(a->n_run, b->n_run);
    assert_memory_equal(a->value, b->value, n * (size_t)a->n_draw * sizeof(double));
    assert_memory_equal(a->margin, b->margin, n * (size_t)a->n_check * sizeof(double));
    assert_memory_equal(a->verdict, b->verdict, n * (size_t)a->n_check * sizeof(CzVerdict));
    assert_memory_equal(&a->passing, &b->passing, sizeof a->passing);
    assert_memory_equal(a->check[0].correlation, b->check[0].correlation,
                        (size_t)a->n_draw * sizeof(double));
}

static const char three_numbers[] =
    "uncertainty:\n"
    "  parameters:\n"
    "    - {path: 'parts.zone.stages[0].force_kN', tolerance_percent: 10, distribution: normal}\n"
    "    - {path: scenario.speed_km_h, min: 20, max: 28, distribution: triangular}\n"
    "    - {path: 'trains.*.vehicles.*.mass_t', tolerance_percent: 5, group: each,\n"
    "       distribution: lognormal}\n";

static void threads_change_no_bit(void **state) {
    (void)state;
    CzSampleOptions options = cz_sample_options_default();
    options.n_sample = 21;
    options.n_job = 1;
    CzSampling *alone = sample(three_numbers, &options);
    options.n_job = 3;
    CzSampling *shared = sample(three_numbers, &options);
    assert_int_equal(alone->n_draw, 4);
    assert_same(alone, shared);
    cz_sampling_free(alone);
    cz_sampling_free(shared);
}

/* Takes the samples of other samplings. */
static CzStatus take(CzSampling *sampling, void *data, CzError *error) {
    CzSampling **part = data;
    const size_t n_check = (size_t)sampling->n_check;
    (void)error;
    for (; *part != NULL; part++)
        for (int k = (*part)->begin; k < (*part)->end; k++) {
            const size_t row = (size_t)k * n_check;
            sampling->sample[k] = (*part)->sample[k];
            memcpy(sampling->margin + row, (*part)->margin + row, n_check * sizeof(double));
            memcpy(sampling->verdict + row, (*part)->verdict + row, n_check * sizeof(CzVerdict));
        }
    return CZ_OK;
}

static void parts_change_no_bit(void **state) {
    (void)state;
    CzSampling *part[4] = {NULL};
    CzSampleOptions options = cz_sample_options_default();
    options.n_sample = 20;
    CzSampling *whole = sample(three_numbers, &options);
    options.n_shard = 3;
    int n_run = 0;
    for (int i = 0; i < 3; i++) {
        options.shard = i + 1;
        part[i] = sample(three_numbers, &options);
        assert_int_equal(part[i]->begin, n_run);
        assert_int_equal(part[i]->sample[part[i]->begin].state, CZ_SAMPLE_DONE);
        assert_int_equal(part[i]->n_run, part[i]->end - part[i]->begin);
        n_run += part[i]->n_run;
    }
    assert_int_equal(n_run, 20);
    options.shard = options.n_shard = 1;
    options.recall = take;
    options.recall_data = part;
    CzSampling *joined = sample(three_numbers, &options);
    assert_same(whole, joined);
    for (int i = 0; i < 3; i++)
        cz_sampling_free(part[i]);
    cz_sampling_free(whole);
    cz_sampling_free(joined);
}

static void a_missing_part_is_not_checked(void **state) {
    (void)state;
    CzSampleOptions options = cz_sample_options_default();
    options.n_sample = 10;
    options.shard = 2;
    options.n_shard = 2;
    CzSampling *part =
        sample("uncertainty:\n  parameters:\n    - {path: 'parts.zone.stages[0].force_kN', min: "
               "1050, max: 1060}\n",
               &options);
    assert_int_equal(part->passing.n_pass, 5);
    assert_int_equal(part->sample[0].state, CZ_SAMPLE_NOT_RUN);
    assert_int_equal(part->judgement, CZ_VERDICT_NOT_CHECKED);
    cz_sampling_free(part);
    options.shard = 3;
    CzError error = {0};
    assert_int_equal(try_sample(force_scatter, &options, &part, &error), CZ_STATUS_INPUT);
    assert_null(part);
}

/* ---- failures ---- */

/* With 0.05 s no run meets its end criterion. */
static void a_failed_run_is_a_failed_sample_with_its_reason(void **state) {
    (void)state;
    CzSampleOptions options = cz_sample_options_default();
    options.n_sample = 12;
    CzSampling *sampling = sample(
        "uncertainty:\n  parameters:\n    - {path: simulation.longest_s, values: [0.05, 6]}\n",
        &options);
    int n_failed = 0;
    for (int k = 0; k < 12; k++) {
        const CzSample *kept = &sampling->sample[k];
        const bool is_short = sampling->value[k] < 1;
        n_failed += is_short;
        assert_int_equal(kept->state, is_short ? CZ_SAMPLE_RUN_FAILED : CZ_SAMPLE_DONE);
        assert_true((isinf(sampling->margin[k]) != 0) == is_short);
        if (is_short)
            assert_non_null(strstr(kept->message, "collision: the run of this scenario did not "));
    }
    assert_int_equal(n_failed, 6);
    assert_int_equal(sampling->n_failed, 6);
    assert_int_equal(sampling->check[0].n_fail, 6);
    assert_true(isinf(sampling->check[0].margin.quantile[0]));
    assert_true(isfinite(sampling->check[0].margin.quantile[2]));
    assert_int_equal(sampling->judgement, CZ_VERDICT_FAIL);
    cz_sampling_free(sampling);
}

static void values_that_the_reader_refuses_are_failed_samples(void **state) {
    (void)state;
    CzSampleOptions options = cz_sample_options_default();
    options.n_sample = 8;
    CzSampling *sampling = sample("uncertainty:\n  parameters:\n"
                                  "    - {path: 'parts.zone.stages[0].stroke_mm', "
                                  "values: [-100, 1500]}\n",
                                  &options);
    for (int k = 0; k < 8; k++) {
        const bool is_wrong = sampling->value[k] < 0;
        assert_int_equal(sampling->sample[k].state, is_wrong ? CZ_SAMPLE_INVALID : CZ_SAMPLE_DONE);
        if (is_wrong)
            assert_non_null(strstr(sampling->sample[k].message, "stroke"));
    }
    assert_int_equal(sampling->n_failed, 4);
    assert_int_equal(sampling->passing.n, 8);
    cz_sampling_free(sampling);
}

static void an_interrupted_sampling_has_samples_that_were_not_run(void **state) {
    (void)state;
    const volatile sig_atomic_t stop = 1;
    CzSampleOptions options = cz_sample_options_default();
    options.stop = &stop;
    CzSampling *sampling = sample(force_scatter, &options);
    assert_true(sampling->is_interrupted);
    assert_int_equal(sampling->n_run, 0);
    assert_int_equal(sampling->judgement, CZ_VERDICT_NOT_CHECKED);
    cz_sampling_free(sampling);
}

/* ---- what is sampled, and how it is judged ---- */

static void a_problem_without_uncertain_numbers_is_refused(void **state) {
    (void)state;
    CzSampling *sampling = NULL;
    CzError error = {0};
    const CzSampleOptions options = cz_sample_options_default();
    assert_int_equal(try_sample("", &options, &sampling, &error), CZ_STATUS_INPUT);
    assert_string_equal(error.message, "the problem has no uncertain numbers");
    assert_int_equal(try_sample("uncertainty: {samples: 5}\n", &options, &sampling, &error),
                     CZ_STATUS_INPUT);
}

static void more_numbers_than_sobol_has_dimensions_are_refused(void **state) {
    char more[20000] = "uncertainty:\n  sampling: sobol\n  parameters:\n";
    (void)state;
    for (int i = 0; i < 257; i++)
        strcat(more, "  - {path: scenario.speed_km_h, min: 24, max: 26}\n");
    char text[24000];
    CzSampleOptions options = cz_sample_options_default();
    options.n_text = (size_t)snprintf(text, sizeof text, "%s%s", two_masses, more);
    options.text = text;
    CzSampling *sampling = NULL;
    CzError error = {0};
    assert_int_equal(cz_sample("", NULL, &options, &sampling, &error), CZ_STATUS_INPUT);
    assert_non_null(strstr(error.message, "at most 256 dimensions"));
    assert_non_null(strstr(error.help, "latin_hypercube"));
}

static void overload_cases_are_not_sampled_unless_named(void **state) {
    (void)state;
    char more[1024];
    static const char scenarios[] = "scenarios:\n"
                                    "  - {name: slow, speed_km_h: 20}\n"
                                    "  - {name: fast, speed_km_h: 25}\n"
                                    "  - {name: overload, speed_km_h: 27.5, mass_factor: 1.1}\n";
    CzSampleOptions options = cz_sample_options_default();
    options.n_sample = 3;
    snprintf(more, sizeof more, "%s%s", scenarios, force_scatter);
    CzSampling *sampling = sample(more, &options);
    assert_int_equal(sampling->n_check, 2);
    assert_string_equal(sampling->check[0].scenario, "slow");
    assert_string_equal(sampling->check[1].scenario, "fast");
    cz_sampling_free(sampling);
    snprintf(more, sizeof more, "%s%s  scenarios: [fast]\n", scenarios, force_scatter);
    sampling = sample(more, &options);
    assert_int_equal(sampling->n_check, 1);
    assert_string_equal(sampling->check[0].scenario, "fast");
    cz_sampling_free(sampling);
}

static void the_file_says_which_statistic_is_required(void **state) {
    (void)state;
    char more[512];
    CzSampleOptions options = cz_sample_options_default();
    options.n_sample = 101;
    snprintf(more, sizeof more, "%s  judged_by: worst\n", force_scatter);
    CzSampling *worst = sample(more, &options);
    snprintf(more, sizeof more, "%s  judged_by: quantile\n  quantile: 0.5\n", force_scatter);
    CzSampling *quantile = sample(more, &options);
    snprintf(more, sizeof more, "%s  judged_by: mean_minus\n  deviations: 1\n", force_scatter);
    CzSampling *mean = sample(more, &options);
    const CzSampledCheck *check = worst->check;
    assert_near(check->required, check->margin.least, 0, 0);
    assert_near(quantile->check->required, check->margin.quantile[1], 0, 0);
    double sum = 0, squares = 0;
    for (int k = 0; k < 101; k++)
        sum += worst->margin[k] / 101;
    for (int k = 0; k < 101; k++)
        squares += (worst->margin[k] - sum) * (worst->margin[k] - sum) / 100;
    assert_near(mean->check->required, sum - sqrt(squares), ROUNDING_OF_A_SUM, 0);
    /* the median passes, the smallest margin fails */
    assert_int_equal(worst->judgement, CZ_VERDICT_FAIL);
    assert_int_equal(quantile->judgement, CZ_VERDICT_PASS);
    cz_sampling_free(worst);
    cz_sampling_free(quantile);
    cz_sampling_free(mean);
}

static void the_share_converges_to_that_of_all_samples(void **state) {
    (void)state;
    CzSampleOptions options = cz_sample_options_default();
    options.n_sample = 20;
    CzSampling *sampling = sample(force_scatter, &options);
    static const int n[] = {1, 2, 4, 8, 16, 20};
    assert_int_equal(sampling->n_convergence, 6);
    for (int i = 0; i < 6; i++)
        assert_int_equal(sampling->convergence[i].n, n[i]);
    assert_memory_equal(&sampling->convergence[5], &sampling->passing, sizeof sampling->passing);
    assert_true(sampling->convergence[0].high - sampling->convergence[0].low >
                sampling->passing.high - sampling->passing.low);
    cz_sampling_free(sampling);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_sample_has_the_crush_of_its_force),
        cmocka_unit_test(the_crush_has_its_exact_distribution),
        cmocka_unit_test(even_samples_are_closer_to_the_mean_than_random_ones),
        cmocka_unit_test(rank_correlations_have_the_right_signs),
        cmocka_unit_test(threads_change_no_bit),
        cmocka_unit_test(parts_change_no_bit),
        cmocka_unit_test(a_missing_part_is_not_checked),
        cmocka_unit_test(a_failed_run_is_a_failed_sample_with_its_reason),
        cmocka_unit_test(values_that_the_reader_refuses_are_failed_samples),
        cmocka_unit_test(an_interrupted_sampling_has_samples_that_were_not_run),
        cmocka_unit_test(a_problem_without_uncertain_numbers_is_refused),
        cmocka_unit_test(more_numbers_than_sobol_has_dimensions_are_refused),
        cmocka_unit_test(overload_cases_are_not_sampled_unless_named),
        cmocka_unit_test(the_file_says_which_statistic_is_required),
        cmocka_unit_test(the_share_converges_to_that_of_all_samples)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
