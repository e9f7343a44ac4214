/* Dependence of results on the time step. The energy balance of all shipped problems, some forty
 * runs, is checked by the verification page alone (tests/verification). */
#include "physics/steps.h"

static void an_elastic_collision_converges_with_the_square_of_the_step(void **state) {
    (void)state;
    assert_rows_of(rows_of_elastic_order);
}

static void an_elastic_collision_exchanges_the_speeds(void **state) {
    (void)state;
    assert_rows_of(rows_of_elastic_exchange);
}

static void shipped_problems_converge_with_the_step(void **state) {
    (void)state;
    assert_rows_of(rows_of_step_convergence);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_elastic_collision_converges_with_the_square_of_the_step),
        cmocka_unit_test(an_elastic_collision_exchanges_the_speeds),
        cmocka_unit_test(shipped_problems_converge_with_the_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
