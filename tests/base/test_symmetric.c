/* Symmetric matrices: known eigenvalues, and factors whose product is the matrix. */
#include "support/check.h"

#include "base/symmetric.h"

#define PI 3.14159265358979323846

enum { N = 12 };

/* Springs in a row between two walls: 2 on the diagonal, -1 beside it. */
static void fill_row_of_springs(double a[N][N]) {
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++)
            a[i][j] = i == j ? 2.0 : abs(i - j) == 1 ? -1.0 : 0.0;
}

static void a_row_of_springs_has_its_closed_form_eigenvalues(void **state) {
    (void)state;
    double a[N][N], vectors[N][N], found[N];
    fill_row_of_springs(a);
    cz_symmetric_diagonalise(N, &a[0][0], &vectors[0][0]);
    for (int i = 0; i < N; i++) {
        int place = i;
        for (; place > 0 && found[place - 1] > a[i][i]; place--)
            found[place] = found[place - 1];
        found[place] = a[i][i];
    }
    for (int k = 0; k < N; k++)
        assert_near(found[k], 2.0 - 2.0 * cos((k + 1) * PI / (N + 1)), ROUNDING_OF_A_FORMULA, 0.0);
}

static void vectors_are_of_length_one_and_belong_to_their_eigenvalues(void **state) {
    (void)state;
    double a[N][N], whole[N][N], vectors[N][N];
    fill_row_of_springs(a);
    fill_row_of_springs(whole);
    cz_symmetric_diagonalise(N, &a[0][0], &vectors[0][0]);
    for (int k = 0; k < N; k++) {
        double length = 0.0;
        for (int i = 0; i < N; i++) {
            double product = 0.0;
            for (int j = 0; j < N; j++)
                product += whole[i][j] * vectors[j][k];
            assert_near(product, a[k][k] * vectors[i][k], 0.0, ROUNDING_OF_A_FORMULA);
            length += vectors[i][k] * vectors[i][k];
        }
        assert_near(length, 1.0, ROUNDING_OF_A_FORMULA, 0.0);
    }
}

/* Equal blocks would mix in a method that uses eigenvalues only. */
static void unconnected_blocks_do_not_mix(void **state) {
    (void)state;
    double a[4][4] = {{2, 1, 0, 0}, {1, 3, 0, 0}, {0, 0, 2, 1}, {0, 0, 1, 3}}, vectors[4][4];
    cz_symmetric_diagonalise(4, &a[0][0], &vectors[0][0]);
    for (int i = 0; i < 2; i++)
        for (int j = 2; j < 4; j++)
            assert_true(vectors[i][j] == 0.0 && vectors[j][i] == 0.0);
}

static void the_factor_solves_forwards_and_backwards(void **state) {
    (void)state;
    double a[N][N], whole[N][N], b[2 * N];
    fill_row_of_springs(a);
    fill_row_of_springs(whole);
    for (int i = 0; i < N; i++)
        b[2 * i] = 1.0 + i * i;
    assert_true(cz_symmetric_factor(N, &a[0][0]));
    cz_lower_solve(N, &a[0][0], b, 2);
    cz_upper_solve(N, &a[0][0], b, 2);
    for (int i = 0; i < N; i++) {
        double product = 0.0;
        for (int j = 0; j < N; j++)
            product += whole[i][j] * b[2 * j];
        assert_near(product, 1.0 + i * i, ROUNDING_OF_A_SUM, 0.0);
    }
}

static void a_matrix_that_is_not_positive_definite_has_no_factor(void **state) {
    (void)state;
    double indefinite[2][2] = {{1, 2}, {2, 1}}, singular[2][2] = {{1, 1}, {1, 1}};
    assert_false(cz_symmetric_factor(2, &indefinite[0][0]));
    assert_false(cz_symmetric_factor(2, &singular[0][0]));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_row_of_springs_has_its_closed_form_eigenvalues),
        cmocka_unit_test(vectors_are_of_length_one_and_belong_to_their_eigenvalues),
        cmocka_unit_test(unconnected_blocks_do_not_mix),
        cmocka_unit_test(the_factor_solves_forwards_and_backwards),
        cmocka_unit_test(a_matrix_that_is_not_positive_definite_has_no_factor),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
