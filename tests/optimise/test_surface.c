/* Response surfaces: exact on planes, corrected by new designs, and the descent on them. */
#include "support/check.h"
#include "optimise/analytic.h"
#include "optimise/surface.h"

/* Everything is linear: objective 1 + 2 x - y, one constraint x + y - 4. */
static double linear(const double *x, double *c) {
    c[0] = x[0] + x[1] - 4;
    return 1 + 2 * x[0] - x[1];
}

static const Analytic analytic_linear = {"linear", 2,      1,     {0, 0}, {4, 8}, {1, 1},
                                         {0},      linear, false, {0, 4}, -3};

static void create(CzSurface *surface, CzSearch *search, const CzFunction *function, int most) {
    const CzOptimiseOptions options = {.evaluations = 1000};
    cz_search_init(search, function, &options);
    assert_true(cz_surface_create(surface, search, most));
}

static void destroy(CzSurface *surface, CzSearch *search) {
    cz_surface_free(surface);
    cz_search_free(search);
}

static void planes_are_exact_where_everything_is_linear(void **state) {
    (void)state;
    const CzFunction function = analytic_function(&analytic_linear);
    CzSearch search;
    CzSurface surface;
    create(&surface, &search, &function, 2);
    const double base[] = {0.25, 0.99}, other[] = {0.9, 0.1};
    assert_true(cz_surface_begin(&surface, "test", base, 0.02));
    assert_int_equal(search.n_record, 3);
    double penalty, c[1];
    const double x[] = {3.6, 0.8};
    assert_near(cz_surface_predict(&surface, other, &penalty), linear(x, c), ROUNDING_OF_A_SUM, 0);
    assert_near(penalty, cz_search_compressed(c[0]), ROUNDING_OF_A_SUM, 0);
    destroy(&surface, &search);
}

static void corrections_make_a_plane_pass_through_the_new_design(void **state) {
    (void)state;
    const CzFunction function = analytic_function(&analytic_hs22);
    CzSearch search;
    CzSurface surface;
    create(&surface, &search, &function, 2);
    const double base[] = {0.5, 0.5}, other[] = {0.6, 0.4};
    assert_true(cz_surface_begin(&surface, "test", base, 0.01));
    const double before = surface.f;
    int moved_to;
    assert_true(cz_surface_try(&surface, "test", 1, other, &moved_to));
    double penalty, c[2];
    const double x[] = {1.8, 1.2}, x_base[] = {1.5, 1.5};
    /* wherever the base is now, both designs lie on the planes */
    assert_near(cz_surface_predict(&surface, other, &penalty), hs22(x, c), 1e-9, 0);
    assert_near(cz_surface_predict(&surface, base, &penalty), before, 1e-9, 0);
    assert_near(before, hs22(x_base, c), 1e-12, 0);
    destroy(&surface, &search);
}

static void steps_below_the_noise_correct_nothing(void **state) {
    (void)state;
    const CzFunction function = analytic_function(&analytic_hs22);
    CzSearch search;
    CzSurface surface;
    create(&surface, &search, &function, 2);
    const double base[] = {0.5, 0.5}, other[] = {0.501, 0.5};
    assert_true(cz_surface_begin(&surface, "test", base, 0.01));
    const double slope = surface.df[0];
    int moved_to;
    assert_true(cz_surface_try(&surface, "test", 1, other, &moved_to));
    assert_near(surface.df[0], slope, 0, 0);
    assert_true(surface.is_fresh);
    destroy(&surface, &search);
}

static void best_design_on_the_planes_is_the_corner_of_a_linear_program(void **state) {
    (void)state;
    const CzFunction function = analytic_function(&analytic_linear);
    CzSearch search;
    CzSurface surface;
    create(&surface, &search, &function, 2);
    const double base[] = {0.25, 0.125};
    double u[2];
    assert_true(cz_surface_begin(&surface, "test", base, 0.02));
    const long n_record = search.n_record;
    assert_true(cz_surface_best(&surface, 1.0, u));
    assert_near(4 * u[0], 0, 0, 1e-3); /* x at its bound, y at the constraint less the reserve */
    assert_near(8 * u[1], 4, 1e-3, 0);
    assert_true(cz_surface_best(&surface, 0.1, u));
    assert_near(u[0], 0.15, 0, 1e-3); /* the box around the base is active */
    assert_near(u[1], 0.225, 0, 1e-3);
    assert_int_equal(search.n_record, n_record); /* planes cost no evaluation */
    destroy(&surface, &search);
}

static void descent_keeps_its_budget_and_ends_at_the_optimum(void **state) {
    (void)state;
    const Analytic *const problems[] = {&analytic_hs22, &analytic_planes};
    for (size_t i = 0; i < sizeof problems / sizeof problems[0]; i++) {
        const CzFunction function = analytic_function(problems[i]);
        CzSearch search;
        CzSurface surface;
        double u[MAX_VARIABLES];
        create(&surface, &search, &function, 4);
        cz_search_scale(&search, function.start, u);
        cz_surface_descend(&surface, "test", u, 150, true);
        assert_true(search.n_record <= 150);
        /* planes alone follow a curved constraint slowly: a few per cent is their accuracy */
        assert_near(search.record[search.best].objective, problems[i]->best, 0.05, 0);
        destroy(&surface, &search);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planes_are_exact_where_everything_is_linear),
        cmocka_unit_test(corrections_make_a_plane_pass_through_the_new_design),
        cmocka_unit_test(steps_below_the_noise_correct_nothing),
        cmocka_unit_test(best_design_on_the_planes_is_the_corner_of_a_linear_program),
        cmocka_unit_test(descent_keeps_its_budget_and_ends_at_the_optimum),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
