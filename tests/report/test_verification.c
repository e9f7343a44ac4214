/* Output of a verification: the document and the table. */
#include "report/json_at.h"
#include "report/stand_in.h"
#include "support/check.h"

#include <jansson.h>

#include "crushzone/report.h"

/* Two numbers: the second changes most, and a verdict flips. */
static CzVerification filled_verification(CzVerifiedValue *value) {
    value[0] = (CzVerifiedValue){.name = "stroke used",
                                 .scenario = "36",
                                 .where = "coupler A1",
                                 .unit = "",
                                 .production = 0.5,
                                 .value = {0.5, NAN, 0.501, NAN},
                                 .change = {0.0, NAN, 0.001, NAN}};
    value[1] = (CzVerifiedValue){.name = "interface force",
                                 .scenario = "36",
                                 .unit = "kN",
                                 .production = 1500,
                                 .value = {1503, NAN, 1490, NAN},
                                 .change = {0.002, NAN, 0.0067, NAN},
                                 .flips = {true, false, false, false}};
    return (CzVerification){.limit = 0.01,
                            .n_value = 2,
                            .value = value,
                            .methods = 1u << CZ_METHOD_HALF_STEP | 1u << CZ_METHOD_ERK |
                                       1u << CZ_METHOD_ADAMS,
                            .is_done = {true, false, true, false},
                            .largest_change = {0.002, NAN, 0.0067, NAN},
                            .worst = {1, -1, 1, -1},
                            .n_flip = {1, 0, 0, 0},
                            .verdict = CZ_VERDICT_FAIL};
}

static CzReport report_of(const CzVerification *verification) {
    return (CzReport){
        .kind = CZ_REPORT_VERIFICATION, .problem = stand_in_problem, .verification = verification};
}

static void a_verification_is_one_document(void **state) {
    (void)state;
    CzVerifiedValue value[2];
    const CzVerification verification = filled_verification(value);
    StandIn s;
    stand_in_fill(&s);
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    CzError error = {0};
    const CzReport report = report_of(&verification);
    assert_int_equal(cz_report_write_json(&report, stream, &error), CZ_OK);
    fclose(stream);
    json_t *json = json_loads(text, 0, NULL);
    assert_non_null(json);
    assert_text_at(json, "format", "crushzone.verification");
    assert_text_at(json, "verdict", "fail");
    assert_text_at(json, "methods.half_step.of", "interface force");
    assert_real_at(json, "methods.reference.largest_change", 0.0067);
    assert_null_at(json, "methods.adams.largest_change");
    assert_true(json_is_false(at(json, "methods.adams.done")));
    assert_real_at(json, "values.1.half_step.value", 1503);
    assert_true(json_is_true(at(json, "values.1.half_step.flips")));
    assert_null_at(json, "values.1.where");
    json_decref(json);
    free(text);
}

static void a_verification_is_a_table_with_the_largest_change_first(void **state) {
    (void)state;
    CzVerifiedValue value[2];
    const CzVerification verification = filled_verification(value);
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    const CzReport report = report_of(&verification);
    assert_int_equal(cz_report_write_table(&report, false, stream, NULL), CZ_OK);
    fclose(stream);
    assert_true(strstr(text, "interface force") < strstr(text, "stroke used"));
    assert_non_null(strstr(text, "CHANGED"));
    assert_non_null(strstr(text, "not done"));
    assert_null(strstr(text, "full_track")); /* a method that does not apply is not reported */
    assert_non_null(strstr(text, "Verification: FAIL (2 results, limit 1 %)"));
    free(text);
}

/* Of two numbers with too large a change one also scatters by more than the limit. */
static void scattering_values_are_counted(void **state) {
    (void)state;
    CzVerifiedValue value[2];
    CzVerification verification = filled_verification(value);
    verification.methods |= 1u << CZ_METHOD_SCATTER;
    verification.is_done[CZ_METHOD_SCATTER] = true;
    value[0].change[CZ_METHOD_HALF_STEP] = value[1].change[CZ_METHOD_HALF_STEP] = 0.02;
    value[1].change[CZ_METHOD_SCATTER] = 0.03;
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    const CzReport report = report_of(&verification);
    assert_int_equal(cz_report_write_table(&report, false, stream, NULL), CZ_OK);
    fclose(stream);
    assert_non_null(
        strstr(text, "2 of 2 results change by more than 1 %; the scatter of 1 of them"));
    free(text);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_verification_is_one_document),
        cmocka_unit_test(a_verification_is_a_table_with_the_largest_change_first),
        cmocka_unit_test(scattering_values_are_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
