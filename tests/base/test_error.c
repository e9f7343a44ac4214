/* Statuses, and the sentence that describes a failure. */
#include "support/check.h"

#include "base/error.h"

static void every_status_has_a_text_and_an_exit_code(void **state) {
    (void)state;
    const CzStatus all[] = {
#define CZ_STATUS(constant, exit_code, text) constant,
#include "crushzone/statuses.def"
#undef CZ_STATUS
    };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        assert_true(strlen(cz_status_text(all[i])) > 0);
        assert_in_range(cz_status_exit_code(all[i]), 0, 143);
        assert_true((cz_status_exit_code(all[i]) == 0) == (all[i] == CZ_OK));
    }
}

static void a_failure_has_its_own_sentence_and_nothing_of_an_earlier_one(void **state) {
    (void)state;
    CzError error = {.line = 7, .column = 3};
    strcpy(error.file, "old.yaml");
    strcpy(error.help, "old hint");
    assert_int_equal(cz_fail(&error, CZ_STATUS_INPUT, "%s is %d", "mass", -4), CZ_STATUS_INPUT);
    assert_int_equal(error.status, CZ_STATUS_INPUT);
    assert_string_equal(error.message, "mass is -4");
    assert_string_equal(error.file, "");
    assert_string_equal(error.help, "");
    assert_int_equal(error.line, 0);
}

static void a_sentence_that_is_too_long_is_cut_and_stays_terminated(void **state) {
    (void)state;
    CzError error;
    assert_int_equal(cz_fail(&error, CZ_STATUS_INPUT, "%0999d", 1), CZ_STATUS_INPUT);
    assert_int_equal(strlen(error.message), sizeof error.message - 1);
}

static void an_error_pointer_may_be_null(void **state) {
    (void)state;
    assert_int_equal(cz_fail(NULL, CZ_STATUS_NO_MEMORY, "no memory"), CZ_STATUS_NO_MEMORY);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_status_has_a_text_and_an_exit_code),
        cmocka_unit_test(a_failure_has_its_own_sentence_and_nothing_of_an_earlier_one),
        cmocka_unit_test(a_sentence_that_is_too_long_is_cut_and_stays_terminated),
        cmocka_unit_test(an_error_pointer_may_be_null),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
