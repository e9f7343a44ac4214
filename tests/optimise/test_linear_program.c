/* Linear programs in a box: corners by hand, and random ones, whose solution no random step
 * improves, which is enough because they are convex. */
#include "support/check.h"
#include "optimise/linear_program.h"

enum { MAX_VARIABLES = 8, MAX_ROWS = 30 };

static double cost(const CzLinearProgram *program, const double *d) {
    double sum = 0;
    for (int j = 0; j < program->n; j++)
        sum += program->g[j] * d[j];
    for (int k = 0; k < program->m; k++) {
        double v = program->c[k];
        for (int j = 0; j < program->n; j++)
            v += program->a[k * program->n + j] * d[j];
        sum += program->w[k] * fmax(v, 0);
    }
    return sum;
}

/* Smallest of -x - y with x + 2 y <= 4 and 3 x + y <= 6: the corner (1.6, 1.2). */
static void corner_of_two_constraints_is_found(void **state) {
    (void)state;
    const double g[] = {-1, -1}, c[] = {-4, -6}, a[] = {1, 2, 3, 1}, w[] = {10, 10};
    const double lo[] = {0, 0}, hi[] = {9, 9};
    const CzLinearProgram program = {2, 2, g, c, a, w, lo, hi};
    double d[] = {0, 0};
    assert_true(cz_linear_program(&program, d));
    assert_near(d[0], 1.6, ROUNDING_OF_A_FORMULA, 0);
    assert_near(d[1], 1.2, ROUNDING_OF_A_FORMULA, 0);
}

/* x <= 1 and x >= 2 cannot both be kept: the one with the higher price is. */
static void dearer_of_two_conflicting_constraints_is_kept(void **state) {
    (void)state;
    const double g[] = {0}, c[] = {-1, 2}, a[] = {1, -1}, lo[] = {-5}, hi[] = {5};
    for (int dear = 0; dear < 2; dear++) {
        const double w[] = {dear == 0 ? 3 : 1, dear == 1 ? 3 : 1};
        const CzLinearProgram program = {1, 2, g, c, a, w, lo, hi};
        double d[] = {0};
        assert_true(cz_linear_program(&program, d));
        assert_near(d[0], dear == 0 ? 1 : 2, ROUNDING_OF_A_FORMULA, 0);
    }
}

static void without_constraints_the_solution_is_a_corner_of_the_box(void **state) {
    (void)state;
    const double g[] = {2, -3, 0}, lo[] = {-1, -1, -1}, hi[] = {1, 4, 1};
    const CzLinearProgram program = {.n = 3, .g = g, .lo = lo, .hi = hi};
    double d[] = {0, 0, 0.5};
    assert_true(cz_linear_program(&program, d));
    assert_near(d[0], -1, 0, 0);
    assert_near(d[1], 4, 0, 0);
    assert_near(d[2], 0.5, 0, 0); /* nothing asks for a change */
}

static uint64_t state_of_random;

static double random_number(double lo, double hi) {
    state_of_random = state_of_random * 6364136223846793005u + 1442695040888963407u;
    return lo + (hi - lo) * (double)(state_of_random >> 11) * 0x1p-53;
}

static void no_step_improves_the_solution_of_a_random_program(void **state) {
    (void)state;
    state_of_random = 1;
    for (int trial = 0; trial < 300; trial++) {
        double g[MAX_VARIABLES], lo[MAX_VARIABLES], hi[MAX_VARIABLES], d[MAX_VARIABLES],
            other[MAX_VARIABLES];
        double c[MAX_ROWS], a[MAX_ROWS * MAX_VARIABLES], w[MAX_ROWS];
        const int n = 1 + trial % MAX_VARIABLES, m = (int)random_number(0, MAX_ROWS);
        for (int j = 0; j < n; j++) {
            g[j] = random_number(-1, 1);
            lo[j] = random_number(-1, 0);
            hi[j] = random_number(0, 1);
            d[j] = 0;
        }
        for (int k = 0; k < m; k++) {
            c[k] = random_number(-1, 1);
            w[k] = random_number(0, 10);
            for (int j = 0; j < n; j++)
                a[k * n + j] = fmax(random_number(-1, 1), random_number(-2, 0.5));
        }
        const CzLinearProgram program = {n, m, g, c, a, w, lo, hi};
        assert_true(cz_linear_program(&program, d));
        const double least = cost(&program, d);
        for (int step = 0; step < 500; step++) {
            const double size = pow(10, random_number(-4, 0));
            for (int j = 0; j < n; j++)
                other[j] = fmin(fmax(d[j] + size * random_number(-1, 1), lo[j]), hi[j]);
            assert_true(cost(&program, other) >= least - 1e-9);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(corner_of_two_constraints_is_found),
        cmocka_unit_test(dearer_of_two_conflicting_constraints_is_kept),
        cmocka_unit_test(without_constraints_the_solution_is_a_corner_of_the_box),
        cmocka_unit_test(no_step_improves_the_solution_of_a_random_program),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
