/* The usual strategy and every algorithm by name, on problems with a known optimum. */
#include "support/check.h"
#include "optimise/analytic.h"
#include "optimise/kkt.h"
#include "optimise/nlopt_adapter.h"
#include "optimise/strategy.h"

static CzSearch run_auto(const CzFunction *function, long evaluations, unsigned long seed) {
    CzOptimiseOptions options = (CzOptimiseOptions){.seed = 1};
    options.evaluations = evaluations;
    CzSearch search;
    CzError error = {0};
    cz_search_init(&search, function, &options);
    assert_int_equal(cz_strategy(&search, NULL, seed, &error), CZ_OK);
    return search;
}

/* Accuracy of the objective that the method guarantees: secants of a hundredth of the range and
 * constraints with a reserve of 1e-4 change the optimum by about as much. */
#define GUARANTEED 2e-3

/* Secants of a hundredth of ranges of 3 to 8 change a variable by about 0.06, and the gradient by
 * some hundredths of its size. */
static void check_optimum(const Analytic *analytic) {
    const CzFunction function = analytic_function(analytic);
    CzSearch search = run_auto(&function, 1500, 1);
    const CzRecord *best = &search.record[search.best];
    const double *x = cz_search_x(&search, search.best);
    double c[MAX_CONSTRAINTS] = {0};
    assert_near(best->objective, analytic->formula(x, c), 0, 0);
    for (int j = 0; j < analytic->n_constraint && !analytic->is_minimax; j++)
        assert_true(c[j] <= 0);
    assert_near(best->objective, analytic->best, GUARANTEED, 0);
    for (int i = 0; i < analytic->n_variable; i++)
        assert_near(x[i], analytic->optimum[i], 0, 0.06);
    if (!analytic->is_minimax)
        assert_near(kkt_residual(analytic, x, 1e-2), 0, 0, 0.05);
    cz_search_free(&search);
}

static void usual_strategy_reaches_the_optimum_of_hs22(void **state) {
    (void)state;
    check_optimum(&analytic_hs22);
}

static void usual_strategy_reaches_the_optimum_of_hs29(void **state) {
    (void)state;
    check_optimum(&analytic_hs29);
}

static void usual_strategy_reaches_the_optimum_of_hs43(void **state) {
    (void)state;
    check_optimum(&analytic_hs43);
}

static void usual_strategy_finds_the_least_largest_constraint(void **state) {
    (void)state;
    check_optimum(&analytic_planes);
}

/* Counts the batches of a search. */
typedef struct Counted {
    const CzFunction *function;
    int n_batch;
} Counted;

static CzStatus count_batch(void *data, int n, const double *x, double *objective,
                            double *constraint, double *detail, CzError *error) {
    Counted *counted = data;
    counted->n_batch++;
    return counted->function->evaluate(counted->function->data, n, x, objective, constraint, detail,
                                       error);
}

static CzSearch run_wide(const CzFunction *function, int width, int *n_batch) {
    Counted counted = {.function = function};
    CzFunction counting = *function;
    counting.evaluate = count_batch;
    counting.data = &counted;
    CzOptimiseOptions options = {.evaluations = 400, .width = width};
    CzSearch search;
    CzError error = {0};
    cz_search_init(&search, &counting, &options);
    assert_int_equal(cz_strategy(&search, NULL, 1, &error), CZ_OK);
    *n_batch = counted.n_batch;
    return search;
}

static void a_wide_search_asks_for_more_designs_at_once(void **state) {
    (void)state;
    const CzFunction function = analytic_function(&analytic_hs43);
    int n_usual, n_wide;
    CzSearch usual = run_wide(&function, CZ_USUAL_WIDTH, &n_usual);
    CzSearch wide = run_wide(&function, 64, &n_wide);
    print_message("%ld designs in %d batches, %ld in %d\n", usual.n_record, n_usual, wide.n_record,
                  n_wide);
    assert_true((double)wide.n_record / n_wide > 2.0 * (double)usual.n_record / n_usual);
    assert_near(wide.record[wide.best].objective, usual.record[usual.best].objective, GUARANTEED,
                0);
    cz_search_free(&usual);
    cz_search_free(&wide);
}

static void kkt_residual_distinguishes_an_optimum_from_another_point(void **state) {
    (void)state;
    const double of_differences = 44 * 2.2e-16 / 1e-6; /* rounding of the objective over 1e-6 */
    assert_near(kkt_residual(&analytic_hs43, analytic_hs43.optimum, 1e-6), 0, 0, of_differences);
    const double other[] = {0, 1, 1.9, -1};
    assert_true(kkt_residual(&analytic_hs43, other, 1e-6) > 0.1);
}

static void least_violated_design_is_kept_when_nothing_is_feasible(void **state) {
    (void)state;
    const CzFunction function = analytic_function(&analytic_torn);
    CzSearch search = run_auto(&function, 400, 1);
    const double secant = 0.01 * 10; /* of the range; the violation changes by a tenth of it */
    assert_near(search.record[search.best].violation, 0.2, 0, 0.1 * secant);
    assert_near(cz_search_x(&search, search.best)[0], 6, 0, secant);
    cz_search_free(&search);
}

static void failing_region_is_left_and_never_the_best(void **state) {
    (void)state;
    const CzFunction function = analytic_function(&analytic_failing);
    CzSearch search = run_auto(&function, 800, 1);
    long n_failed = 0;
    for (long i = 0; i < search.n_record; i++)
        n_failed += isnan(search.record[i].objective);
    assert_true(n_failed > 0);
    assert_near(search.record[search.best].objective, 1, GUARANTEED, 0);
    cz_search_free(&search);
}

static void failed_designs_have_finite_values_above_all_others(void **state) {
    (void)state;
    const CzFunction function = analytic_function(&analytic_failing);
    CzOptimiseOptions options = (CzOptimiseOptions){.seed = 1};
    options.evaluations = 10;
    CzSearch search;
    cz_search_init(&search, &function, &options);
    const double x[] = {0.5, 1, 2, 2, 3, 3};
    double f[3], c[6];
    assert_true(cz_search_evaluate(&search, "test", 3, x, f, c, NULL));
    assert_true(isfinite(f[1]) && isfinite(f[2]) && isfinite(c[2]) && isfinite(c[4]));
    assert_true(f[1] > f[0] && f[2] > f[1]); /* the ramp rises with the distance */
    assert_true(c[2] > c[0] && c[4] > c[2]);
    assert_int_equal(search.best, 0);
    cz_search_free(&search);
}

static void search_without_a_successful_design_ends_with_a_sentence(void **state) {
    (void)state;
    const CzFunction function = analytic_function(&analytic_always_failing);
    CzSearch search = run_auto(&function, 5000, 1);
    assert_int_equal(search.status, CZ_STATUS_RUN_FAILED);
    assert_true(search.n_record < 100);
    assert_non_null(strstr(search.why, "of the last 50 designs failed"));
    assert_int_equal(search.best, -1);
    cz_search_free(&search);
}

static void search_that_runs_into_failures_ends_with_the_best_and_a_sentence(void **state) {
    (void)state;
    Analytic tempting = analytic_failing;
    tempting.formula = tempting_failures;
    tempting.start[1] = 0.5;
    const CzFunction function = analytic_function(&tempting);
    CzOptimiseOptions options = {.evaluations = 3000};
    CzSearch search;
    CzError error = {0};
    cz_search_init(&search, &function, &options);
    assert_int_equal(cz_strategy(&search, "LN_NELDERMEAD", 1, &error), CZ_OK);
    assert_false(isnan(search.record[search.best].objective));
    if (search.is_paused)
        assert_non_null(strstr(search.why, "of the last 50 designs failed"));
    cz_search_free(&search);
}

static void limit_of_evaluations_is_kept(void **state) {
    (void)state;
    const CzFunction function = analytic_function(&analytic_hs43);
    const long limits[] = {1, 2, 7, 40, 333};
    for (size_t i = 0; i < sizeof limits / sizeof limits[0]; i++) {
        CzSearch search = run_auto(&function, limits[i], 1);
        assert_true(search.n_record <= limits[i] && search.n_record >= 1);
        cz_search_free(&search);
    }
}

static void same_seed_gives_the_same_history_and_another_seed_another(void **state) {
    (void)state;
    const CzFunction function = analytic_function(&analytic_hs43);
    CzSearch a = run_auto(&function, 300, 5), b = run_auto(&function, 300, 5);
    CzSearch other = run_auto(&function, 300, 6);
    assert_int_equal(a.n_record, b.n_record);
    const size_t size = (size_t)(a.n_record * 4) * sizeof(double);
    assert_memory_equal(a.x, b.x, size);
    /* the descent from the start has no random numbers */
    const long n_both = other.n_record < a.n_record ? other.n_record : a.n_record;
    assert_memory_not_equal(a.x, other.x, (size_t)(n_both * 4) * sizeof(double));
    cz_search_free(&a);
    cz_search_free(&b);
    cz_search_free(&other);
}

/* ---- stopping -------------------------------------------------------------------------------- */

typedef struct Stopper {
    volatile sig_atomic_t flag;
    long at;
} Stopper;

static void stop_at(const CzProgress *progress, void *data) {
    Stopper *stopper = data;
    if (progress->n_evaluation >= stopper->at)
        stopper->flag = 1;
}

static void interruption_ends_every_algorithm_and_keeps_the_best(void **state) {
    (void)state;
    const CzFunction function = analytic_function(&analytic_hs22);
    for (int i = -1; i < cz_n_algorithm(); i++) {
        Stopper stopper = {.flag = 0, .at = 30};
        CzOptimiseOptions options = (CzOptimiseOptions){.seed = 1};
        options.evaluations = 100000;
        options.stop = &stopper.flag;
        options.progress = stop_at;
        options.progress_data = &stopper;
        CzSearch search;
        CzError error = {0};
        cz_search_init(&search, &function, &options);
        const CzStatus status = i < 0 ? cz_strategy(&search, NULL, 1, &error)
                                      : cz_strategy(&search, cz_algorithm_name(i), 1, &error);
        assert_true(status == CZ_OK || status == CZ_STATUS_INPUT);
        if (status == CZ_OK && search.is_over)
            assert_int_equal(search.status, CZ_STATUS_INTERRUPTED);
        assert_true(search.n_record < 60);
        for (long k = 0; k < search.n_record; k++)
            assert_false(cz_search_is_better(&search, k, search.best));
        cz_search_free(&search);
    }
}

/* ---- algorithms by name ---------------------------------------------------------------------- */

static void every_algorithm_runs_by_name_within_its_limit(void **state) {
    (void)state;
    const CzFunction function = analytic_function(&analytic_hs22);
    assert_true(cz_n_algorithm() > 20);
    for (int i = 0; i < cz_n_algorithm(); i++) {
        CzOptimiseOptions options = (CzOptimiseOptions){.seed = 1};
        options.evaluations = 400;
        CzSearch search;
        CzError error = {0};
        cz_search_init(&search, &function, &options);
        const CzStatus status = cz_strategy(&search, cz_algorithm_name(i), 1, &error);
        if (status != CZ_OK)
            print_message("%s: %s\n", cz_algorithm_name(i), error.message);
        assert_int_equal(status, CZ_OK);
        assert_true(search.n_record > 1 && search.n_record <= 400);
        const CzRecord *best = &search.record[search.best];
        /* from a violation of 3.75 and an objective of 2.5 every algorithm reaches at least this */
        if (!(best->violation <= 0.05 && best->objective < 3))
            print_message("%s: objective %g, violation %g after %ld\n", cz_algorithm_name(i),
                          best->objective, best->violation, search.n_record);
        assert_true(best->violation <= 0.05 && best->objective < 3);
        cz_search_free(&search);
    }
}

static void algorithms_survive_failing_designs(void **state) {
    (void)state;
    const CzFunction function = analytic_function(&analytic_failing);
    for (int i = 0; i < cz_n_algorithm(); i++) {
        CzOptimiseOptions options = (CzOptimiseOptions){.seed = 1};
        options.evaluations = 200;
        CzSearch search;
        CzError error = {0};
        cz_search_init(&search, &function, &options);
        assert_int_equal(cz_strategy(&search, cz_algorithm_name(i), 1, &error), CZ_OK);
        assert_true(search.n_record <= 200);
        assert_false(isnan(search.record[search.best].objective));
        cz_search_free(&search);
    }
}

static void unknown_and_absent_algorithms_are_refused_with_a_sentence(void **state) {
    (void)state;
    CzError error = {0};
    assert_int_equal(cz_nlopt_check("LN_COBILA", &error), CZ_STATUS_INPUT);
    assert_string_equal(error.message, "there is no algorithm 'LN_COBILA'");
    assert_non_null(strstr(error.help, "LN_COBYLA"));
    for (int i = 0; i < cz_n_algorithm(); i++)
        assert_int_equal(cz_nlopt_check(cz_algorithm_name(i), &error), CZ_OK);
    assert_null(cz_algorithm_name(cz_n_algorithm()));
}

/* ---- catalogue increments
 * ------------------------------------------------------------------------- */

/* Best design of HS43 on increments of 0.25, of all of them. */
static double best_on_steps(void) {
    double best = INFINITY;
    for (int a = -12; a <= 16; a++)
        for (int b = -12; b <= 16; b++)
            for (int d = -12; d <= 16; d++)
                for (int e = -12; e <= 16; e++) {
                    const double x[] = {a * 0.25, b * 0.25, d * 0.25, e * 0.25};
                    double c[MAX_CONSTRAINTS];
                    const double f = hs43(x, c);
                    if (c[0] <= 0 && c[1] <= 0 && c[2] <= 0 && f < best)
                        best = f;
                }
    return best;
}

static void optimum_is_on_the_catalogue_increments(void **state) {
    (void)state;
    Analytic stepped = analytic_hs43;
    for (int i = 0; i < 4; i++)
        stepped.step[i] = 0.25;
    const CzFunction function = analytic_function(&stepped);
    CzSearch search = run_auto(&function, 1000, 1);
    assert_true(search.best_on_grid >= 0);
    const double *x = cz_search_x(&search, search.best_on_grid);
    for (int i = 0; i < 4; i++)
        assert_near(x[i] / 0.25, round(x[i] / 0.25), 0, 0);
    const CzRecord *best = &search.record[search.best_on_grid];
    assert_true(best->violation <= 0);
    assert_near(best->objective, best_on_steps(), ROUNDING_OF_A_FORMULA, 0);
    cz_search_free(&search);
}

/* A search too short for slopes still tries increments near its best design; the start, which is on
 * the increments, does not count. */
static void few_evaluations_still_reach_the_increments(void **state) {
    (void)state;
    Analytic stepped = analytic_hs43;
    for (int i = 0; i < 4; i++)
        stepped.step[i] = 0.25;
    const CzFunction function = analytic_function(&stepped);
    for (long most = 8; most <= 24; most += 4) {
        CzSearch search = run_auto(&function, most, 1);
        assert_true(search.is_snapped);
        assert_true(search.n_record <= most);
        assert_true(search.best_on_grid > 0);
        cz_search_free(&search);
    }
}

static void rounding_stays_within_the_bounds(void **state) {
    (void)state;
    Analytic stepped = analytic_hs22;
    stepped.min[0] = 0.07;
    stepped.max[0] = 0.93;
    stepped.step[0] = 0.1;
    const CzFunction function = analytic_function(&stepped);
    CzOptimiseOptions options = (CzOptimiseOptions){.seed = 1};
    CzSearch search;
    cz_search_init(&search, &function, &options);
    const double x[][2] = {{0.07, 0.123}, {0.93, 0.123}, {0.44, 0.123}};
    const double expected[] = {0.1, 0.9, 0.4};
    for (int i = 0; i < 3; i++) {
        double rounded[2];
        cz_search_round(&search, x[i], rounded);
        assert_near(rounded[0], expected[i], 0, ROUNDING_OF_A_VALUE);
        assert_near(rounded[1], 0.123, 0, 0);
    }
    cz_search_free(&search);
}

static void sample_fills_the_box_evenly(void **state) {
    (void)state;
    enum { N = 1000, CELLS = 10 };
    for (int axis = 0; axis < 3; axis++) {
        int count[CELLS] = {0};
        for (int k = 0; k < N; k++) {
            double u[3];
            cz_sample_point(7, k, 3, u);
            assert_true(u[axis] >= 0 && u[axis] < 1);
            count[(int)(u[axis] * CELLS)]++;
        }
        for (int cell = 0; cell < CELLS; cell++)
            assert_near(count[cell], N / CELLS, 0, 5); /* random points would leave +-10 and more */
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kkt_residual_distinguishes_an_optimum_from_another_point),
        cmocka_unit_test(usual_strategy_reaches_the_optimum_of_hs22),
        cmocka_unit_test(usual_strategy_reaches_the_optimum_of_hs29),
        cmocka_unit_test(usual_strategy_reaches_the_optimum_of_hs43),
        cmocka_unit_test(usual_strategy_finds_the_least_largest_constraint),
        cmocka_unit_test(a_wide_search_asks_for_more_designs_at_once),
        cmocka_unit_test(least_violated_design_is_kept_when_nothing_is_feasible),
        cmocka_unit_test(failing_region_is_left_and_never_the_best),
        cmocka_unit_test(failed_designs_have_finite_values_above_all_others),
        cmocka_unit_test(search_without_a_successful_design_ends_with_a_sentence),
        cmocka_unit_test(search_that_runs_into_failures_ends_with_the_best_and_a_sentence),
        cmocka_unit_test(limit_of_evaluations_is_kept),
        cmocka_unit_test(same_seed_gives_the_same_history_and_another_seed_another),
        cmocka_unit_test(interruption_ends_every_algorithm_and_keeps_the_best),
        cmocka_unit_test(every_algorithm_runs_by_name_within_its_limit),
        cmocka_unit_test(algorithms_survive_failing_designs),
        cmocka_unit_test(unknown_and_absent_algorithms_are_refused_with_a_sentence),
        cmocka_unit_test(optimum_is_on_the_catalogue_increments),
        cmocka_unit_test(few_evaluations_still_reach_the_increments),
        cmocka_unit_test(rounding_stays_within_the_bounds),
        cmocka_unit_test(sample_fills_the_box_evenly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
