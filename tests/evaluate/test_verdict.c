/* How checks combine to a verdict, tried on every combination. */
#include "support/check.h"

#include "crushzone/evaluate.h"

#include <string.h>

static const char *const words[] = {"pass", "provisional", "fail", "not checked"};

/* The rule, written independently. */
static CzVerdict expected(unsigned present, bool failed, bool climbed) {
    if ((present >> CZ_VERDICT_FAIL & 1) != 0 || climbed)
        return CZ_VERDICT_FAIL;
    if (failed || present == 0 || (present >> CZ_VERDICT_NOT_CHECKED & 1) != 0)
        return CZ_VERDICT_NOT_CHECKED;
    return (present >> CZ_VERDICT_PROVISIONAL & 1) != 0 ? CZ_VERDICT_PROVISIONAL : CZ_VERDICT_PASS;
}

static void every_combination_of_checks_follows_one_rule(void **state) {
    (void)state;
    for (unsigned present = 0; present < 16; present++)
        for (int failed = 0; failed < 2; failed++)
            for (int climbed = 0; climbed < 2; climbed++) {
                CzCheckResult check[4];
                CzEvaluation evaluation = {.status = failed ? CZ_STATUS_RUN_FAILED : CZ_OK,
                                           .beyond_validity = climbed != 0,
                                           .check = check};
                for (int verdict = 3; verdict >= 0; verdict--)
                    if ((present >> verdict & 1) != 0)
                        check[evaluation.n_check++] =
                            (CzCheckResult){.name = words[verdict], .verdict = (CzVerdict)verdict};
                assert_int_equal(cz_verdict_over(&evaluation, 0, NULL),
                                 expected(present, failed != 0, climbed != 0));
            }
}

static void checks_that_were_not_asked_for_do_not_count(void **state) {
    (void)state;
    CzCheckResult check[] = {{.name = "a", .verdict = CZ_VERDICT_FAIL},
                             {.name = "b", .verdict = CZ_VERDICT_PROVISIONAL},
                             {.name = "b", .verdict = CZ_VERDICT_PASS}};
    CzEvaluation evaluation = {.n_check = 3, .check = check};
    const char *const b[] = {"b"}, *const c[] = {"c"};
    assert_int_equal(cz_verdict_over(&evaluation, 0, NULL), CZ_VERDICT_FAIL);
    assert_int_equal(cz_verdict_over(&evaluation, 1, b), CZ_VERDICT_PROVISIONAL);
    assert_int_equal(cz_verdict_over(&evaluation, 1, c), CZ_VERDICT_NOT_CHECKED);
    evaluation.beyond_validity = true; /* an override is beyond the model whatever was selected */
    assert_int_equal(cz_verdict_over(&evaluation, 1, b), CZ_VERDICT_FAIL);
}

static void a_scenario_is_judged_by_its_own_checks(void **state) {
    (void)state;
    CzCheckResult check[] = {
        {.name = "a", .scenario = "one", .verdict = CZ_VERDICT_PASS},
        {.name = "a", .scenario = "two", .family = "both", .verdict = CZ_VERDICT_FAIL},
        {.name = "a", .scenario = "three", .family = "both", .verdict = CZ_VERDICT_PASS},
        {.name = "a", .scenario = "four", .verdict = CZ_VERDICT_NOT_CHECKED, .has_no_run = true},
        {.name = "a", .scenario = "five", .verdict = CZ_VERDICT_PASS, .beyond_validity = true}};
    const CzEvaluation evaluation = {.n_check = 5, .check = check, .beyond_validity = true};
    assert_int_equal(cz_verdict_in(&evaluation, "one"), CZ_VERDICT_PASS);
    assert_int_equal(cz_verdict_in(&evaluation, "two"), CZ_VERDICT_FAIL);
    assert_int_equal(cz_verdict_in(&evaluation, "both"), CZ_VERDICT_FAIL);
    assert_int_equal(cz_verdict_in(&evaluation, "three"), CZ_VERDICT_PASS);
    assert_int_equal(cz_verdict_in(&evaluation, "four"), CZ_VERDICT_NOT_CHECKED);
    assert_int_equal(cz_verdict_in(&evaluation, "five"), CZ_VERDICT_FAIL);
    assert_int_equal(cz_verdict_in(&evaluation, "six"), CZ_VERDICT_NOT_CHECKED);
}

static void a_pass_is_one_by_screening_while_requirements_are_not_covered(void **state) {
    (void)state;
    for (int verdict = 0; verdict < 4; verdict++)
        for (int n = 0; n < 3; n++) {
            const bool passes = verdict == CZ_VERDICT_PASS || verdict == CZ_VERDICT_PROVISIONAL;
            const char *text = cz_verdict_words((CzVerdict)verdict, n);
            assert_int_equal(cz_verdict_is_screening((CzVerdict)verdict, n), passes && n > 0);
            assert_int_equal(strstr(text, "(screening)") != NULL, passes && n > 0);
            assert_int_equal(strncmp(text, words[verdict], strlen(words[verdict])), 0);
        }
}

static void the_worst_check_is_the_one_that_decides(void **state) {
    (void)state;
    const CzCheckResult in_order[] = {
        {.verdict = CZ_VERDICT_FAIL, .value = 9, .margin = -3},
        {.verdict = CZ_VERDICT_FAIL, .value = 2, .margin = -1e-6},
        {.verdict = CZ_VERDICT_FAIL, .value = 1, .margin = NAN, .is_flag = true},
        {.verdict = CZ_VERDICT_NOT_CHECKED, .value = NAN, .margin = NAN},
        {.verdict = CZ_VERDICT_PROVISIONAL, .value = 1, .margin = 0},
        {.verdict = CZ_VERDICT_PASS, .value = 1, .margin = 0.5},
        {.verdict = CZ_VERDICT_PASS, .value = 0, .margin = NAN, .is_flag = true},
        {.verdict = CZ_VERDICT_PASS, .value = NAN, .margin = NAN}};
    enum { N = sizeof in_order / sizeof in_order[0] };
    for (int i = 0; i < N; i++)
        for (int k = 0; k < N; k++)
            assert_int_equal(cz_check_is_worse(&in_order[i], &in_order[k]), i < k);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_combination_of_checks_follows_one_rule),
        cmocka_unit_test(checks_that_were_not_asked_for_do_not_count),
        cmocka_unit_test(a_scenario_is_judged_by_its_own_checks),
        cmocka_unit_test(a_pass_is_one_by_screening_while_requirements_are_not_covered),
        cmocka_unit_test(the_worst_check_is_the_one_that_decides)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
