/* The terminal tables: readable, and without hidden failures. */
#include "support/check.h"

#include "report/figure.h"
#include "report/stand_in.h"

/* A text that grows while it is written. */
typedef struct Text {
    char *text;
    size_t n;
    FILE *stream;
} Text;

static Text *text_begin(void) {
    Text *text = calloc(1, sizeof *text);
    text->stream = open_memstream(&text->text, &text->n);
    return text;
}

/* The written text; freed by the caller. */
static char *text_end(Text *text) {
    fclose(text->stream);
    char *written = text->text;
    free(text);
    return written;
}

static char *table_text(const StandIn *s, bool colour) {
    Text *text = text_begin();
    const CzReport report = stand_in_run(s);
    assert_int_equal(cz_report_write_table(&report, colour, text->stream, NULL), CZ_OK);
    return text_end(text);
}

static char *outcome_text(const StandIn *s) {
    Text *text = text_begin();
    const CzReport report = stand_in_search(s);
    assert_int_equal(cz_report_write_table(&report, false, text->stream, NULL), CZ_OK);
    return text_end(text);
}

static void assert_has(const char *text, const char *part) {
    if (strstr(text, part) == NULL)
        print_error("no '%s' in\n%s\n", part, text);
    assert_non_null(strstr(text, part));
}

static void assert_lacks(const char *text, const char *part) {
    if (strstr(text, part) != NULL)
        print_error("'%s' in\n%s\n", part, text);
    assert_null(strstr(text, part));
}

static void table_has_interfaces_checks_and_verdict(void **state) {
    (void)state;
    StandIn s;
    stand_in_fill(&s);
    char *text = table_text(&s, false);
    assert_has(text, "Zwei Züge, 36 km/h\n");
    assert_has(text,
               "36   36 km/h -> 0 km/h   0.62 s simulated, end criterion met   energy balance "
               "0.02 %\n");
    assert_has(text, "interface   peak kN   crush mm      used   energy kJ   share\n");
    assert_has(text, "A1-B1          3483        659   101 % !         689    17 %   coupler A1 "
                     "sheared off at 100 ms, coupler A1 BOTTOMED OUT at 372 ms\n");
    assert_has(text, "wheel lift: A1 wheelset 2 at 500 ms\n");
    assert_has(text, "interface force     A1-B1     1500 kN    3483 kN   -132 %   FAIL\n");
    assert_has(text, "mean deceleration   A1            5 g     2.31 g    +54 %   PROVISIONAL\n");
    assert_has(text, "NOT CHECKED   no stops are declared\n");
    assert_has(text, "min 30 mm          -        -   n/a");
    assert_has(text, "5 checks: 1 FAIL, 1 NOT CHECKED, 1 PROVISIONAL, 2 pass. Verdict: FAIL.\n");
    free(text);
}

static void without_colour_there_is_no_escape_code(void **state) {
    (void)state;
    StandIn s;
    stand_in_fill(&s);
    char *plain = table_text(&s, false), *painted = table_text(&s, true);
    assert_lacks(plain, "\033");
    assert_has(painted, "\033[1;31mFAIL\033[0m");
    assert_has(painted, "\033[1;31m101 % !\033[0m");
    free(plain);
    free(painted);
}

static void names_cannot_send_escape_codes(void **state) {
    (void)state;
    StandIn s;
    stand_in_fill(&s);
    s.check[0].name = "evil\033[2Jname";
    char *text = table_text(&s, false);
    assert_lacks(text, "\033");
    assert_has(text, "evil?[2Jname");
    free(text);
}

static void several_scenarios_show_the_worst_lines_and_every_failure(void **state) {
    (void)state;
    StandIn s;
    stand_in_fill(&s);
    s.evaluation.n_run = 2;
    s.check[1].name = s.check[3].name = "closing speed"; /* margins 0.538 and 0: the second stays */
    s.check[1].scenario = "18/low";
    s.check[2].name = "interface force"; /* not checked there, but failed elsewhere */
    char *text = table_text(&s, false);
    assert_has(text, "36   36 km/h -> 0 km/h");
    assert_has(text, "18/low   18 km/h -> 0 km/h");
    assert_lacks(text, "B1-B2"); /* neither the highest force nor bottomed out */
    assert_lacks(text, "2.31 g");
    assert_lacks(text, "no stops are declared");
    assert_has(text, "0.10 m/s");
    assert_has(text, "3483 kN");
    free(text);
}

/* A criterion in twelve scenarios. */
static void a_narrow_terminal_wraps_cells_and_divides_the_matrix(void **state) {
    (void)state;
    enum { WIDTH = 60, N = 12 };
    StandIn s;
    stand_in_fill(&s);
    static const char *const names[N] = {"a", "b", "c", "d", "e", "f",
                                         "g", "h", "i", "j", "k", "l"};
    CzCheckResult check[N];
    for (int i = 0; i < N; i++) {
        check[i] = s.check[0];
        check[i].name = "a criterion with a long name of several words, Züge";
        check[i].scenario = names[i];
    }
    s.evaluation.check = check;
    s.evaluation.n_check = N;
    Text *text = text_begin();
    CzReport report = stand_in_run(&s);
    CzReportOptions options = cz_report_options_default();
    options.text_width = WIDTH;
    report.options = &options;
    assert_int_equal(cz_report_write_table(&report, false, text->stream, NULL), CZ_OK);
    char *written = text_end(text);
    assert_has(written, "       1      2      3\n");
    assert_has(written, "      10     11     12\n");
    const char *line = strstr(written, "\ncriterion");
    const char *sentence = strstr(written, "\nSmallest margins.");
    while (line != NULL && line < sentence) {
        const char *end = strchr(line + 1, '\n');
        assert_true(end - line - 1 <= WIDTH + 1); /* a letter has two bytes */
        line = end;
    }
    free(written);
}

static void checks_of_a_scenario_without_a_run_are_one_line(void **state) {
    (void)state;
    StandIn s;
    stand_in_fill(&s);
    for (int i = 1; i < 4; i++) {
        s.check[i].is_omitted = s.check[i].has_no_run = true;
        s.check[i].scenario = i < 3 ? "18/low" : "18/high";
        s.check[i].why = "this scenario was not run";
    }
    s.check[1].verdict = s.check[2].verdict = s.check[3].verdict = CZ_VERDICT_NOT_CHECKED;
    char *text = table_text(&s, false);
    assert_has(text, "\nNOT CHECKED: 2 checks of 18/low, this scenario was not run.\n");
    assert_has(text, "\nNOT CHECKED: 1 check of 18/high, this scenario was not run.\n");
    assert_lacks(text, "mean deceleration");
    assert_lacks(text, "no stops are declared");
    assert_has(text, "5 checks: 1 FAIL, 3 NOT CHECKED, 1 pass. Verdict: FAIL.\n");
    free(text);
}

static void a_rounded_value_does_not_hide_a_violated_limit(void **state) {
    (void)state;
    StandIn s;
    stand_in_fill(&s);
    s.check[0].value = 1500.0001;
    s.check[0].margin = -0.0001 / 1500;
    s.check[3].is_minimum = true;
    s.check[3].verdict = CZ_VERDICT_FAIL;
    s.check[3].value = 0.0999999;
    s.check[3].margin = -1e-6;
    char *text = table_text(&s, false);
    assert_has(text, "1500.0001 kN");
    assert_has(text, "0.0999999 m/s");
    assert_has(text, "-6.7e-06 %");
    free(text);
}

static void failed_and_incomplete_runs_are_named(void **state) {
    (void)state;
    StandIn s;
    stand_in_fill(&s);
    s.run[0].summary.status = CZ_STATUS_RUN_FAILED;
    snprintf(s.run[0].summary.failure, sizeof s.run[0].summary.failure, "car A1 at 3 ms");
    char *text = table_text(&s, false);
    assert_has(text, "RUN FAILED: car A1 at 3 ms\n");
    free(text);
    s.run[0].summary.status = CZ_OK;
    s.run[0].summary.ended = CZ_ENDED_INCOMPLETE;
    s.run[0].summary.beyond_validity = true;
    s.run[0].summary.beyond_validity_time = 0.4;
    text = table_text(&s, false);
    assert_has(text, "INCOMPLETE");
    assert_has(text, "From 400 ms on this run is beyond model validity. *: may be of later");
    assert_has(text, "3483 "); /* reached before */
    assert_has(text, "659*");
    free(text);
}

static void without_checks_nothing_is_judged(void **state) {
    (void)state;
    StandIn s;
    stand_in_fill(&s);
    s.evaluation.n_check = 0;
    char *text = table_text(&s, false);
    assert_has(text, "NO CHECKS");
    free(text);
}

static void a_search_shows_before_and_after_and_the_new_values(void **state) {
    (void)state;
    StandIn s;
    stand_in_fill(&s);
    s.constraint[0] = 0;
    s.check[0].value = 1432;
    s.check[0].verdict = CZ_VERDICT_PASS;
    s.outcome.best_evaluation.violation = 0;
    s.outcome.best_evaluation.objective = 1432;
    char *text = outcome_text(&s);
    assert_has(text, "FEASIBLE after 214 evaluations: the evaluations are used up\n");
    assert_has(text, "objective interfaces.peak_force_kN: 3483 -> 1432 kN\n");
    assert_has(text, "tube force    kN     500   900      700       900   at its bound\n");
    assert_has(text, "limit     before      after");
    assert_has(text, "3483 kN    1432 kN");
    assert_lacks(text, "violated");
    assert_has(text,
               "set:\n  \"trains.A.vehicles.A1.front.coupler.tube.stages[0].force_kN\": 900\n");
    free(text);
}

static void a_search_without_success_lists_what_is_violated(void **state) {
    (void)state;
    StandIn s;
    stand_in_fill(&s);
    s.outcome.status = CZ_OUTCOME_INFEASIBLE;
    char *text = outcome_text(&s);
    assert_has(text, "NO FEASIBLE DESIGN FOUND after 214 evaluations");
    assert_has(text, "violated, worst scenario   where   scenario     limit     value   margin   "
                     "scenarios\n");
    assert_has(text, "interface force, 36        A1-B1   36         1500 kN   3483 kN   -132 %   "
                     "        1\n");
    assert_lacks(text, "deceleration, 36");
    s.outcome.status = CZ_OUTCOME_INTERRUPTED;
    free(text);
    text = outcome_text(&s);
    assert_has(text, "INTERRUPTED");
    assert_has(text, "the best so far is NOT feasible");
    free(text);
}

/* A check that fails in many scenarios is one line: the worst, and in how many. */
static void a_violated_check_is_listed_once_in_its_worst_scenario(void **state) {
    (void)state;
    StandIn s;
    stand_in_fill(&s);
    s.outcome.status = CZ_OUTCOME_INFEASIBLE;
    s.check[1].name = s.check[2].name = s.check[0].name;
    s.constraint[1] = 1.5;
    s.constraint[2] = 1.5;
    char *text = outcome_text(&s);
    const char *violated = strstr(text, "violated, worst scenario");
    assert_non_null(violated);
    assert_has(violated, "deceleration, 36");
    assert_has(violated, "           3\n");
    assert_lacks(violated, "interface force, 36");
    assert_lacks(violated, "lift, 36");
    free(text);
}

static void numbers_are_short_and_not_rounded_to_a_limit(void **state) {
    (void)state;
    static const struct {
        double value;
        const char *plain, *percent, *margin;
    } rows[] = {{0, "0", "0 %", "+0 %"},
                {3483.4, "3483", "> 999 %", "> 999 %"},
                {-21.04, "-21.0", "< -999 %", "< -999 %"},
                {9.994, "9.99", "999 %", "+999 %"},
                {2.314, "2.31", "231 %", "+231 %"},
                {-0.132, "-0.13", "-13 %", "-13 %"},
                {0.0567, "0.06", "5.7 %", "+5.7 %"},
                {-0.0003, "-0.0003", "-0.03 %", "-0.03 %"},
                {-2e-9, "-2e-09", "-2e-07 %", "-2e-07 %"},
                {-4.4e-14, "0", "0 %", "+0 %"},
                {-0.0, "0", "0 %", "+0 %"}};
    char text[CZ_FIGURE_SIZE];
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        assert_string_equal(cz_figure_plain(text, rows[i].value), rows[i].plain);
        assert_string_equal(cz_figure_percent(text, rows[i].value), rows[i].percent);
        assert_string_equal(cz_figure_margin(text, rows[i].value), rows[i].margin);
    }
    assert_string_equal(cz_figure_percent(text, 0.167), "17 %");
    assert_string_equal(cz_figure_percent(text, 2e-4), "0.02 %");
    assert_string_equal(cz_figure_plain(text, NAN), "-");
    assert_string_equal(cz_figure_margin(text, NAN), "-");
    assert_string_equal(cz_figure_plain(text, 1e300), "1e+300");
    assert_string_equal(cz_figure_change(text, 1e4), "> 999 %");
    assert_string_equal(cz_figure_fixed(text, 1, -0.04), "0.0");
    assert_string_equal(cz_figure_digits(text, 3, -0.0), "0");
}

static void assert_as_the_library_writes(int digits, double value) {
    char text[CZ_FIGURE_SIZE], expected[CZ_FIGURE_SIZE];
    snprintf(expected, sizeof expected, "%.*g", digits, value);
    assert_string_equal(cz_figure_digits(text, digits, value), expected);
}

/* 200,000 numbers of all sizes, and those that lie between two texts, next to them, and next to
 * powers of ten, have the digits that %.*g gives them. */
static void digits_are_those_of_the_library(void **state) {
    (void)state;
    uint64_t random = 1;
    for (int i = 0; i < 200000; i++) {
        random = random * 6364136223846793005u + 1442695040888963407u;
        const double share = (double)(random >> 11) / 9007199254740992.0;
        const double size = pow(10.0, 22.0 * share - 7.0);
        const double tie = (floor(1e6 * share) + 0.5) / pow(10.0, i % 9);
        const double power = pow(10.0, i % 18 - 6);
        const int digits = 1 + i % 13;
        assert_as_the_library_writes(digits, i % 2 ? size : -size);
        assert_as_the_library_writes(digits, tie);
        assert_as_the_library_writes(digits, nextafter(tie, 0.0));
        assert_as_the_library_writes(digits, nextafter(tie, 1e300));
        assert_as_the_library_writes(digits, nextafter(power, i % 2 ? 0.0 : 1e300));
        assert_as_the_library_writes(digits, power);
    }
    assert_as_the_library_writes(9, 999999999.4);
    assert_as_the_library_writes(9, 999999999.6);
    assert_as_the_library_writes(3, 1e-4);
    assert_as_the_library_writes(3, 9.999e-5);
}

/* More than six columns. */
static void a_sweep_shows_the_largest_number_of_metrics(void **state) {
    (void)state;
    CzSweepPoint point = {.value = {36}, .margin = 0.1, .scenario = "collision"};
    CzSweep sweep = {.n_axis = 1,
                     .axis = {{.path = "trains.A.speed_km_h"}},
                     .n_metric = CZ_MAX_SWEPT_METRICS,
                     .n_point = 1,
                     .n_shard = 1,
                     .end = 1,
                     .point = &point};
    for (int k = 0; k < CZ_MAX_SWEPT_METRICS; k++) {
        snprintf(sweep.metric[k], sizeof sweep.metric[k], "metric %d", k + 1);
        sweep.metric_unit[k] = "kN";
        point.metric[k] = 100 + k;
    }
    Text *text = text_begin();
    const CzReport report = {.kind = CZ_REPORT_SWEEP, .sweep = &sweep};
    assert_int_equal(cz_report_write_table(&report, false, text->stream, NULL), CZ_OK);
    char *written = text_end(text);
    assert_has(written, "metric 8   smallest margin   where   scenario\n");
    assert_has(written, "107 kN                             collision\n");
    free(written);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(table_has_interfaces_checks_and_verdict),
        cmocka_unit_test(without_colour_there_is_no_escape_code),
        cmocka_unit_test(names_cannot_send_escape_codes),
        cmocka_unit_test(several_scenarios_show_the_worst_lines_and_every_failure),
        cmocka_unit_test(a_narrow_terminal_wraps_cells_and_divides_the_matrix),
        cmocka_unit_test(checks_of_a_scenario_without_a_run_are_one_line),
        cmocka_unit_test(a_rounded_value_does_not_hide_a_violated_limit),
        cmocka_unit_test(failed_and_incomplete_runs_are_named),
        cmocka_unit_test(without_checks_nothing_is_judged),
        cmocka_unit_test(a_search_shows_before_and_after_and_the_new_values),
        cmocka_unit_test(a_search_without_success_lists_what_is_violated),
        cmocka_unit_test(a_violated_check_is_listed_once_in_its_worst_scenario),
        cmocka_unit_test(digits_are_those_of_the_library),
        cmocka_unit_test(a_sweep_shows_the_largest_number_of_metrics),
        cmocka_unit_test(numbers_are_short_and_not_rounded_to_a_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
