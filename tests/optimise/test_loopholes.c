/* Loopholes of the model, on the simulator itself: two rigid cars, five scenarios. */
#include "optimise/loopholes.h"

int main(void) {
    const struct CMUnitTest tests[] = {LOOPHOLES};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
