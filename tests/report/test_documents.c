/* The JSON documents and CSV files: keys, units, numbers, NaN, and invalid UTF-8. */
#include "support/check.h"

#include "report/csv.h"
#include "report/json_at.h"
#include "report/stand_in.h"

#include <locale.h>

#include <jansson.h>

/* Output of a writer as text; freed by the caller. */
typedef struct Text {
    char *text;
    size_t n;
    FILE *stream;
} Text;

static void text_begin(Text *text) {
    text->stream = open_memstream(&text->text, &text->n);
    assert_non_null(text->stream);
}

static char *text_end(Text *text) {
    fclose(text->stream);
    return text->text;
}

static char *summary_text(const StandIn *s) {
    Text text;
    text_begin(&text);
    CzError error = {0};
    CzReportOptions options = cz_report_options_default();
    options.n_job = 2;
    CzReport report = stand_in_run(s);
    report.options = &options;
    assert_int_equal(cz_report_write_json(&report, text.stream, &error), CZ_OK);
    return text_end(&text);
}

static json_t *summary_of(const StandIn *s) {
    char *text = summary_text(s);
    json_error_t error;
    json_t *json = json_loads(text, 0, &error);
    if (json == NULL)
        print_error("%d: %s\n%s\n", error.line, error.text, text);
    assert_non_null(json);
    free(text);
    return json;
}

static json_t *outcome_of(const StandIn *s) {
    Text text;
    text_begin(&text);
    CzError error = {0};
    const CzReport report = stand_in_search(s);
    assert_int_equal(cz_report_write_json(&report, text.stream, &error), CZ_OK);
    char *written = text_end(&text);
    json_t *json = json_loads(written, 0, NULL);
    assert_non_null(json);
    free(written);
    return json;
}

static void summary_has_every_key_that_scripts_rely_on(void **state) {
    (void)state;
    static const char *const paths[] = {"format",
                                        "version",
                                        "program.version",
                                        "program.sundials",
                                        "program.nlopt",
                                        "problem.title",
                                        "problem.file",
                                        "problem.hash",
                                        "status",
                                        "verdict",
                                        "run_info.wall_s",
                                        "run_info.setup_s",
                                        "run_info.isa",
                                        "run_info.jobs",
                                        "scenarios.0.name",
                                        "scenarios.0.run_info.wall_s",
                                        "scenarios.0.run_info.setup_s",
                                        "scenarios.0.run_info.isa",
                                        "scenarios.0.run_info.jobs",
                                        "scenarios.0.simulated_s",
                                        "scenarios.0.integrator",
                                        "scenarios.0.time_step_s",
                                        "scenarios.0.track",
                                        "scenarios.0.ended",
                                        "scenarios.0.energy.initial_kJ",
                                        "scenarios.0.energy.final_kinetic_kJ",
                                        "scenarios.0.energy.dissipated_kJ",
                                        "scenarios.0.energy.stored_kJ",
                                        "scenarios.0.energy.wheel_rail_kJ",
                                        "scenarios.0.energy.balance_error",
                                        "scenarios.0.momentum_error",
                                        "scenarios.0.rest_residual",
                                        "scenarios.0.interfaces.0.name",
                                        "scenarios.0.interfaces.0.peak_force_kN",
                                        "scenarios.0.interfaces.0.peak_time_ms",
                                        "scenarios.0.interfaces.0.shortening_mm",
                                        "scenarios.0.interfaces.0.energy_kJ",
                                        "scenarios.0.interfaces.0.energy_share",
                                        "scenarios.0.interfaces.0.bottomed_out",
                                        "scenarios.0.interfaces.0.elements.0.name",
                                        "scenarios.0.interfaces.0.elements.0.energy_kJ",
                                        "scenarios.0.interfaces.0.elements.0.stored_kJ",
                                        "scenarios.0.interfaces.0.elements.0.stroke_mm",
                                        "scenarios.0.interfaces.0.elements.0.stroke_used",
                                        "scenarios.0.interfaces.0.elements.0.peak_force_kN",
                                        "scenarios.0.vehicles.0.name",
                                        "scenarios.0.vehicles.0.final_speed_km_h",
                                        "scenarios.0.vehicles.0.peak_deceleration_g",
                                        "scenarios.0.vehicles.0.mean_deceleration_contact_g",
                                        "scenarios.0.vehicles.0.mean_deceleration_120ms_g",
                                        "scenarios.0.vehicles.0.max_wheel_lift_mm",
                                        "scenarios.0.vehicles.0.max_pitch_mrad",
                                        "scenarios.0.events.0.time_ms",
                                        "scenarios.0.events.0.what",
                                        "scenarios.0.events.0.where",
                                        "checks.0.name",
                                        "checks.0.scenario",
                                        "checks.0.where",
                                        "checks.0.limit",
                                        "checks.0.value",
                                        "checks.0.unit",
                                        "checks.0.margin",
                                        "checks.0.verdict",
                                        "checks.0.profile",
                                        "checks.0.clause",
                                        "checks.0.source",
                                        "checks.0.confidence"};
    StandIn s;
    stand_in_fill(&s);
    json_t *json = summary_of(&s);
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++)
        at(json, paths[i]);
    json_decref(json);
}

static void summary_is_in_the_units_of_its_keys(void **state) {
    (void)state;
    StandIn s;
    stand_in_fill(&s);
    json_t *json = summary_of(&s);
    assert_text_at(json, "format", "crushzone.summary");
    assert_text_at(json, "status", "completed");
    assert_text_at(json, "verdict", "fail");
    assert_text_at(json, "problem.title", "Zwei Züge, 36 km/h");
    assert_text_at(json, "problem.file", "two \"trains\".yaml");
    assert_real_at(json, "scenarios.0.interfaces.0.peak_force_kN", 3483);
    assert_real_at(json, "scenarios.0.interfaces.0.peak_time_ms", 372);
    assert_real_at(json, "scenarios.0.interfaces.0.shortening_mm", 659);
    assert_real_at(json, "scenarios.0.interfaces.0.elements.0.stroke_mm", 250);
    assert_real_at(json, "scenarios.0.vehicles.0.final_speed_km_h", 18);
    assert_real_at(json, "scenarios.0.vehicles.0.max_wheel_lift_mm", 9.1);
    assert_text_at(json, "scenarios.0.events.2.what", "bottomed_out");
    assert_text_at(json, "scenarios.0.ended", "by rule");
    json_decref(json);
}

static void nan_and_infinity_are_null(void **state) {
    (void)state;
    StandIn s;
    stand_in_fill(&s);
    s.interface[0].peak_force = INFINITY;
    json_t *json = summary_of(&s);
    assert_null_at(json, "scenarios.0.interfaces.0.peak_force_kN");
    assert_null_at(json, "scenarios.0.vehicles.1.max_wheel_lift_mm");
    assert_null_at(json, "scenarios.0.vehicles.0.survival_shortening_mm");
    assert_null_at(json, "checks.2.value");
    assert_null_at(json, "run_info.wall_s");
    assert_null_at(json, "checks.0.profile");
    json_decref(json);
}

static void a_pass_against_an_unconfirmed_limit_is_provisional(void **state) {
    (void)state;
    StandIn s;
    stand_in_fill(&s);
    json_t *json = summary_of(&s);
    assert_text_at(json, "checks.1.verdict", "pass");
    assert_true(json_is_true(at(json, "checks.1.provisional")));
    assert_text_at(json, "checks.2.verdict", "not checked");
    assert_text_at(json, "checks.2.why", "no stops are declared");
    assert_true(json_is_false(at(json, "checks.3.provisional")));
    json_decref(json);
}

static void a_failed_run_is_never_called_completed(void **state) {
    (void)state;
    StandIn s;
    stand_in_fill(&s);
    s.evaluation.status = CZ_STATUS_RUN_FAILED;
    s.run[0].summary.status = CZ_STATUS_RUN_FAILED;
    snprintf(s.run[0].summary.failure, sizeof s.run[0].summary.failure, "car A1 at 3 ms");
    json_t *json = summary_of(&s);
    assert_text_at(json, "status", "failed");
    assert_text_at(json, "scenarios.0.status", "failed");
    assert_text_at(json, "scenarios.0.failure", "car A1 at 3 ms");
    json_decref(json);
}

static void runs_that_were_not_made_are_left_out(void **state) {
    (void)state;
    StandIn s;
    stand_in_fill(&s);
    s.evaluation.n_run = 2;
    s.runs[0] = NULL;
    json_t *json = summary_of(&s);
    assert_int_equal(json_array_size(at(json, "scenarios")), 1);
    assert_text_at(json, "scenarios.0.name", "18/low");
    json_decref(json);
}

static void reals_read_back_to_the_same_bits_with_the_fewest_digits(void **state) {
    (void)state;
    StandIn s;
    stand_in_fill(&s);
    const double values[] = {0.1, 1.0 / 3, 2.0 / 3 * 1e-300, 1.7976931348623157e308, 5e-324};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        s.check[0].value = values[i];
        json_t *json = summary_of(&s);
        const double read = json_real_value(at(json, "checks.0.value"));
        assert_memory_equal(&read, &values[i], sizeof read);
        json_decref(json);
    }
    char *text = summary_text(&s);
    assert_non_null(strstr(text, "\"limit\": 0.1,"));
    assert_non_null(strstr(text, "\"limit\": 1500.0,"));
    free(text);
}

static void invalid_utf_8_does_not_break_the_document(void **state) {
    (void)state;
    StandIn s;
    stand_in_fill(&s);
    stand_in_file = "caf\xe9 1.5e3 \\\".yaml";
    json_t *json = summary_of(&s);
    assert_text_at(json, "problem.file", "caf? 1.5e3 \\\".yaml");
    stand_in_file = "two \"trains\".yaml";
    json_decref(json);
}

static void same_results_give_the_same_bytes(void **state) {
    (void)state;
    StandIn s;
    stand_in_fill(&s);
    char *first = summary_text(&s), *second = summary_text(&s);
    assert_string_equal(first, second);
    free(first);
    free(second);
}

static void a_full_disk_is_an_output_error(void **state) {
    (void)state;
    StandIn s;
    stand_in_fill(&s);
    FILE *full = fopen("/dev/full", "w");
    if (full == NULL) {
        print_message("there is no /dev/full\n");
        skip();
    }
    CzError error = {0};
    const CzReport report = stand_in_run(&s);
    assert_int_equal(cz_report_write_json(&report, full, &error), CZ_STATUS_OUTPUT);
    assert_non_null(strstr(error.message, "cannot be written"));
    fclose(full);
}

static void outcome_has_every_key_that_scripts_rely_on(void **state) {
    (void)state;
    static const char *const paths[] = {"format",
                                        "version",
                                        "status",
                                        "why_stopped",
                                        "evaluations",
                                        "run_info.wall_s",
                                        "variables.0.name",
                                        "variables.0.unit",
                                        "variables.0.min",
                                        "variables.0.max",
                                        "variables.0.start",
                                        "variables.0.value",
                                        "variables.0.at_bound",
                                        "objective.name",
                                        "objective.unit",
                                        "objective.start",
                                        "objective.value",
                                        "constraints.0.name",
                                        "constraints.0.where",
                                        "constraints.0.limit",
                                        "constraints.0.start",
                                        "constraints.0.value",
                                        "constraints.0.margin",
                                        "verification.half_step_change",
                                        "verification.reference_change",
                                        "verification.full_track_change",
                                        "verification.verdict"};
    StandIn s;
    stand_in_fill(&s);
    s.start_check[0].value = 4000;
    json_t *json = outcome_of(&s);
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++)
        at(json, paths[i]);
    assert_text_at(json, "format", "crushzone.outcome");
    assert_text_at(json, "status", "feasible");
    assert_real_at(json, "constraints.0.start", 4000);
    assert_real_at(json, "constraints.0.value", 3483);
    assert_true(json_is_true(at(json, "constraints.0.violated")));
    assert_true(json_is_true(at(json, "variables.0.at_bound")));
    assert_text_at(json, "verification.verdict", "not checked");
    json_decref(json);
}

static void outcome_has_the_changes_of_the_verified_optimum(void **state) {
    (void)state;
    StandIn s;
    stand_in_fill(&s);
    CzVerifiedValue value = {.name = "wheel lift", .scenario = "crash", .where = "A4"};
    CzVerification verification = {.verdict = CZ_VERDICT_FAIL,
                                   .largest_change = {0.004, NAN, 0.02, NAN},
                                   .n_value = 1,
                                   .value = &value,
                                   .worst = {0, -1, 0, -1, -1}};
    s.outcome.verification = &verification;
    json_t *json = outcome_of(&s);
    assert_real_at(json, "verification.half_step_change", 0.004);
    assert_real_at(json, "verification.reference_change", 0.02);
    assert_null_at(json, "verification.full_track_change");
    assert_text_at(json, "verification.verdict", "fail");
    assert_text_at(json, "verification.methods.reference.of", "wheel lift");
    assert_text_at(json, "verification.methods.reference.where", "A4");
    assert_text_at(json, "verification.methods.reference.scenario", "crash");
    assert_null_at(json, "verification.methods.full_track.of");
    json_decref(json);
}

static void mistakes_are_one_document_with_all_of_them(void **state) {
    (void)state;
    const CzError errors[2] = {{.status = CZ_STATUS_INPUT,
                                .file = "a.yaml",
                                .line = 7,
                                .column = 26,
                                .message = "one",
                                .help = "did you mean 'force_kN'?"},
                               {.status = CZ_STATUS_INPUT, .message = "two"}};
    const CzError *const mistake[2] = {&errors[0], &errors[1]};
    Text text;
    text_begin(&text);
    CzError error = {0};
    const CzReport report = {.kind = CZ_REPORT_MISTAKES, .mistake = mistake, .n_mistake = 2};
    assert_int_equal(cz_report_write_json(&report, text.stream, &error), CZ_OK);
    char *written = text_end(&text);
    json_t *json = json_loads(written, 0, NULL);
    assert_text_at(json, "error.file", "a.yaml");
    assert_int_equal(json_integer_value(at(json, "error.line")), 7);
    assert_int_equal(json_integer_value(at(json, "error.column")), 26);
    assert_text_at(json, "error.message", "one");
    assert_text_at(json, "error.help", "did you mean 'force_kN'?");
    assert_text_at(json, "errors.1.message", "two");
    assert_null_at(json, "errors.1.file");
    assert_null_at(json, "errors.1.line");
    json_decref(json);
    free(written);
}

static void csv_quotes_text_that_would_break_a_row(void **state) {
    (void)state;
    StandIn s;
    stand_in_fill(&s);
    const CzReportOptions options = cz_report_options_default();
    Text text;
    text_begin(&text);
    cz_csv_write_checks(&s.evaluation, &options, text.stream);
    char *written = text_end(&text);
    assert_non_null(strstr(written, "name,scenario,where,kind,limit,value,unit,margin,verdict"));
    assert_non_null(strstr(written, "interface force,36,A1-B1,max,1500,3483,kN,-1.322,fail"));
    assert_non_null(strstr(written, ",\"a \"\"quoted\"\", text\","));
    assert_non_null(strstr(written, "wheel lift,36,A1,max,21,,mm,,not checked,no stops"));
    assert_string_equal(written + strlen(written) - 2, "\r\n");
    free(written);
}

static void csv_has_nine_digits_and_the_requested_separators(void **state) {
    (void)state;
    StandIn s;
    stand_in_fill(&s);
    CzReportOptions options = cz_report_options_default();
    Text text;
    text_begin(&text);
    cz_csv_write_channels(&s.run[0], &options, text.stream);
    char *written = text_end(&text);
    assert_string_equal(written, "t_ms,v_A1_m_s,beyond_validity\r\n0,10,0\r\n"
                                 "1,9.66666667,0\r\n2,,0\r\n");
    free(written);

    options.csv_separator = ';';
    options.csv_decimal = ',';
    text_begin(&text);
    cz_csv_write_channels(&s.run[0], &options, text.stream);
    written = text_end(&text);
    assert_string_equal(written, "t_ms;v_A1_m_s;beyond_validity\r\n0;10;0\r\n"
                                 "1;9,66666667;0\r\n2;;0\r\n");
    free(written);
}

static void csv_lists_interfaces_with_their_elements(void **state) {
    (void)state;
    StandIn s;
    stand_in_fill(&s);
    const CzReportOptions options = cz_report_options_default();
    Text text;
    text_begin(&text);
    cz_csv_write_interfaces(&s.run[0].summary, &options, text.stream);
    char *written = text_end(&text);
    assert_non_null(strstr(written, "\r\nA1-B1,,3483,372,659,,,689,0.167,,yes,no\r\n"));
    assert_non_null(strstr(written, "\r\nA1-B1,coupler A1,1412,,,250,1.01,343,,0,yes,no\r\n"));
    free(written);
}

static void a_decimal_comma_of_the_host_changes_nothing(void **state) {
    (void)state;
    static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8"};
    bool found = false;
    for (size_t i = 0; i < sizeof names / sizeof *names && !found; i++)
        found = setlocale(LC_NUMERIC, names[i]) != NULL;
    if (!found) {
        print_message("no locale with a decimal comma; package locales has them\n");
        skip();
    }
    StandIn s;
    stand_in_fill(&s);
    const CzReportOptions options = cz_report_options_default();
    Text text;
    text_begin(&text);
    cz_csv_write_channels(&s.run[0], &options, text.stream);
    const CzReport report = stand_in_run(&s);
    assert_int_equal(cz_report_write_table(&report, false, text.stream, NULL), CZ_OK);
    char *written = text_end(&text), *summary = summary_text(&s);
    setlocale(LC_NUMERIC, "C");
    char *expected = summary_text(&s);
    assert_non_null(strstr(written, "9.66666667"));
    assert_non_null(strstr(written, "2.31 g"));
    assert_string_equal(summary, expected);
    free(written);
    free(summary);
    free(expected);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(summary_has_every_key_that_scripts_rely_on),
        cmocka_unit_test(summary_is_in_the_units_of_its_keys),
        cmocka_unit_test(nan_and_infinity_are_null),
        cmocka_unit_test(a_pass_against_an_unconfirmed_limit_is_provisional),
        cmocka_unit_test(a_failed_run_is_never_called_completed),
        cmocka_unit_test(runs_that_were_not_made_are_left_out),
        cmocka_unit_test(reals_read_back_to_the_same_bits_with_the_fewest_digits),
        cmocka_unit_test(invalid_utf_8_does_not_break_the_document),
        cmocka_unit_test(same_results_give_the_same_bytes),
        cmocka_unit_test(a_full_disk_is_an_output_error),
        cmocka_unit_test(outcome_has_every_key_that_scripts_rely_on),
        cmocka_unit_test(outcome_has_the_changes_of_the_verified_optimum),
        cmocka_unit_test(mistakes_are_one_document_with_all_of_them),
        cmocka_unit_test(csv_quotes_text_that_would_break_a_row),
        cmocka_unit_test(csv_has_nine_digits_and_the_requested_separators),
        cmocka_unit_test(csv_lists_interfaces_with_their_elements),
        cmocka_unit_test(a_decimal_comma_of_the_host_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
