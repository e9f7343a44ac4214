/* Smooth response surfaces: exact at their designs and on planes, and the descent on them. */
#include "support/check.h"
#include "optimise/analytic.h"
#include "optimise/response.h"

static void create(CzSurface *surface, CzSearch *search, const CzFunction *function) {
    const CzOptimiseOptions options = {.evaluations = 200};
    cz_search_init(search, function, &options);
    assert_true(cz_surface_create(surface, search, 1));
}

static void destroy(CzSurface *surface, CzSearch *search) {
    cz_surface_free(surface);
    cz_search_free(search);
}

static void evaluate(CzSearch *search, const double *x) {
    double objective, c[4];
    assert_true(cz_search_evaluate(search, "test", 1, x, &objective, c, NULL));
}

static void
the_response_contains_every_design_and_its_slopes_are_those_of_its_values(void **state) {
    (void)state;
    const CzFunction function = analytic_function(&analytic_hs22);
    CzSearch search;
    CzSurface surface;
    CzResponse response;
    create(&surface, &search, &function);
    const double x[][2] = {{0, 0.1}, {1, 0.5}, {0.2, 1.5}, {1.5, 1.5}, {0.7, 0.9}};
    for (size_t i = 0; i < sizeof x / sizeof *x; i++)
        evaluate(&search, x[i]);
    const double base[] = {0.5, 0.5}, step = 1e-6;
    assert_true(cz_response_create(&response, &surface));
    assert_true(cz_response_fit(&response, base, 10));
    for (size_t i = 0; i < sizeof x / sizeof *x; i++) {
        double u[2], c[2];
        cz_search_scale(&search, x[i], u);
        const double f = hs22(x[i], c);
        cz_response_linearise(&response, u, true, &surface);
        assert_near(surface.f, f, 1e-6, 0); /* the weights' equations have tiny diagonals */
        for (int k = 0; k < 2; k++)
            assert_near(surface.c[k], c[k], 1e-6, 1e-6); /* likewise */
    }
    double u[] = {0.45, 0.55};
    cz_response_linearise(&response, u, false, &surface);
    const double f = surface.f, slope = surface.df[1];
    u[1] += step;
    cz_response_linearise(&response, u, true, &surface);
    assert_near((surface.f - f) / step, slope, 1e-3, 1e-3); /* rounding over the step */
    cz_response_free(&response);
    destroy(&surface, &search);
}

static void a_descent_follows_a_curved_constraint_to_the_optimum(void **state) {
    (void)state;
    const CzFunction function = analytic_function(&analytic_hs22);
    CzSearch search;
    CzSurface surface;
    create(&surface, &search, &function);
    cz_response_descend(&surface, "test", function.start, 60);
    assert_true(search.best >= 0);
    /* constraints are kept by a reserve of 1e-3 */
    assert_near(search.record[search.best].objective, analytic_hs22.best, 5e-3, 0);
    assert_true(search.record[search.best].violation <= 0);
    destroy(&surface, &search);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_response_contains_every_design_and_its_slopes_are_those_of_its_values),
        cmocka_unit_test(a_descent_follows_a_curved_constraint_to_the_optimum),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
