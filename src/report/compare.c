/* Comparison of runs: checks, interfaces and cars that differ; on a terminal. */
#include "crushzone/report.h"

#include "evaluate/deciding_run.h"
#include "report/checks_table.h"
#include "report/compare.h"
#include "report/compared_names.h"
#include "report/figure.h"
#include "report/tables.h"
#include "report/verdict_words.h"

#include <math.h>
#include <string.h>

int cz_compared_scenario(const CzReport *report, int i) {
    const CzReportRun *run = report->compared;
    const int own = run[i].scenario >= 0 ? run[i].scenario : cz_deciding_run(run[i].evaluation);
    if (i == 0)
        return own;
    const CzRunSummary *first = cz_compared_run(report, 0);
    const int same = first != NULL ? cz_find_kept_run(run[i].evaluation, first->scenario) : -1;
    return same >= 0 ? same : own;
}

const CzRunSummary *cz_compared_run(const CzReport *report, int i) {
    const CzEvaluation *evaluation = report->compared[i].evaluation;
    const int scenario = cz_compared_scenario(report, i);
    return scenario >= 0 && scenario < evaluation->n_run ? cz_kept_run(evaluation, scenario) : NULL;
}

const CzCheckResult *cz_compared_check(const CzReportRun *run, const CzCheckResult *check) {
    for (int i = 0; i < run->evaluation->n_check; i++) {
        const CzCheckResult *other = &run->evaluation->check[i];
        const bool same_scenario = other->scenario == check->scenario ||
                                   (other->scenario != NULL && check->scenario != NULL &&
                                    strcmp(other->scenario, check->scenario) == 0);
        if (same_scenario && strcmp(other->name, check->name) == 0)
            return other;
    }
    return NULL;
}

/* Whether values differ by more than a thousandth of the limit, or of the violation. A margin has
 * the scale of its quantity, so that two values next to zero do not differ by a large share. */
static bool differs_in_value(const CzCheckResult *check, const CzCheckResult *other) {
    const double share = 1e-3;
    if (check->limit != other->limit || isnan(check->margin) || isnan(other->margin))
        return fabs(other->value - check->value) >
               share * fmax(fabs(check->value), fabs(check->limit));
    return fabs(other->margin - check->margin) > share * fmax(fabs(check->margin), 1);
}

bool cz_compared_differs(const CzReport *report, const CzCheckResult *check) {
    for (int i = 1; i < report->n_compared; i++) {
        const CzCheckResult *other = cz_compared_check(&report->compared[i], check);
        if (other == NULL || other->verdict != check->verdict ||
            isnan(other->value) != isnan(check->value) || differs_in_value(check, other))
            return true;
    }
    return false;
}

/* ---- numbers of interfaces and cars ---- */

/* Results that are compared, up to NULL. */
static const CzResult *const of_interfaces[] = {
    CZ_RESULT_AT(INTERFACE, peak_force_kN), CZ_RESULT_AT(INTERFACE, shortening_mm),
    CZ_RESULT_AT(INTERFACE, stroke_used), CZ_RESULT_AT(INTERFACE, energy_kJ), NULL};
static const CzResult *const of_cars[] = {CZ_RESULT_AT(VEHICLE, mean_deceleration_120ms_g),
                                          CZ_RESULT_AT(VEHICLE, peak_deceleration_g),
                                          CZ_RESULT_AT(VEHICLE, max_wheel_lift_mm), NULL};

static int count_of(const CzRunSummary *run, bool of_interface) {
    return of_interface ? run->n_interface : run->n_vehicle;
}

static const char *name_of(const CzRunSummary *run, bool of_interface, int index) {
    return of_interface ? run->interface[index].name : run->vehicle[index].name;
}

double cz_compared_value(const CzReport *report, int i, const CzResult *result, const char *name) {
    const CzRunSummary *summary = cz_compared_run(report, i);
    const bool of_interface = result->record == CZ_RECORD_INTERFACE;
    CzResultContext context = {.run = summary};
    for (int k = 0; summary != NULL && k < count_of(summary, of_interface); k++)
        if (cz_compared_names_match(report->comparison, i, name_of(summary, of_interface, k), name))
            return cz_result_number(result, &context,
                                    of_interface ? (const void *)&summary->interface[k]
                                                 : (const void *)&summary->vehicle[k]);
    return NAN;
}

bool cz_compared_is_beyond(const CzReport *report, int i) {
    const CzRunSummary *summary = cz_compared_run(report, i);
    return summary != NULL && summary->beyond_validity;
}

const char *cz_compared_caution(const CzReport *report) {
    for (int i = 0; i < report->n_compared; i++)
        if (cz_compared_is_beyond(report, i))
            return CZ_FIGURE_CAUTION;
    return "";
}

/* ---- tables ---- */

static void begin(CzReportTable *table, const CzReport *report, const char *heads) {
    cz_table_begin(table, heads);
    for (int i = 0; i < report->n_compared; i++) {
        char head[CZ_SENTENCE_SIZE];
        snprintf(head, sizeof head, ">%s", report->compared[i].label);
        cz_table_head(table, head);
    }
}

/* The verdict of each run, with the remark behind a pass by screening. */
static void put_verdicts(CzReportTable *table, const CzReport *report) {
    cz_table_put(table, "verdict of all checks");
    cz_table_put(table, "");
    for (int i = 0; i < report->n_compared; i++) {
        const CzEvaluation *evaluation = report->compared[i].evaluation;
        const CzVerdict verdict = evaluation->verdict;
        char text[CZ_LABEL_SIZE];
        snprintf(text, sizeof text, "%s%s", cz_verdict_word(verdict),
                 cz_verdict_is_screening(verdict, evaluation->n_not_covered) ? " (screening)" : "");
        cz_table_put_styled(table, text, cz_verdict_style(verdict));
    }
}

void cz_compared_begin_checks(CzReportTable *table, const CzReport *report, int *n_same) {
    const CzEvaluation *first = report->compared[0].evaluation;
    *n_same = 0;
    begin(table, report, "check;>limit");
    put_verdicts(table, report);
    for (int k = 0; k < first->n_check; k++) {
        const CzCheckResult *check = &first->check[k];
        char text[CZ_CHECK_SIZE + 24], value[CZ_CHECK_SIZE];
        if (!cz_compared_differs(report, check)) {
            ++*n_same;
            continue;
        }
        cz_table_put_format(table, "%s, %s", check->name,
                            check->scenario != NULL ? check->scenario : "");
        cz_table_put(table, cz_checks_limit(value, check));
        for (int i = 0; i < report->n_compared; i++) {
            const CzCheckResult *other = cz_compared_check(&report->compared[i], check);
            if (other == NULL) {
                cz_table_put(table, "-");
                continue;
            }
            snprintf(text, sizeof text, "%s %s", cz_checks_value(value, other),
                     cz_checks_word(other));
            cz_table_put_styled(table, text,
                                other->verdict == CZ_VERDICT_FAIL ? CZ_STYLE_BAD : CZ_STYLE_PLAIN);
        }
    }
}

/* Whether a run has the result; single masses, for example, have no wheel lift. */
static bool is_known(const CzReport *report, const CzResult *result, const char *name) {
    for (int i = 0; i < report->n_compared; i++)
        if (isfinite(cz_compared_value(report, i, result, name)))
            return true;
    return false;
}

/* The change of a number from the first run to another one: "+12.3 (+5.4 %)"; empty for none. */
static void put_difference(CzReportTable *table, double from, double to) {
    char size[CZ_FIGURE_SIZE], share[CZ_FIGURE_SIZE];
    if (isnan(from) || isnan(to) || from == to) {
        cz_table_put(table, from == to ? "0" : "");
        return;
    }
    cz_figure_plain(size, fabs(to - from));
    if (from == 0)
        cz_table_put_format(table, "%c%s", to > from ? '+' : '-', size);
    else
        cz_table_put_format(table, "%c%s (%s)", to > from ? '+' : '-', size,
                            cz_figure_margin(share, (to - from) / fabs(from)));
}

/* Heads of the changes of all runs but the first. */
static void add_changes(CzReportTable *table, const CzReport *report) {
    for (int i = 1; i < report->n_compared; i++) {
        char head[CZ_SENTENCE_SIZE];
        if (report->n_compared == 2)
            snprintf(head, sizeof head, ">change");
        else
            snprintf(head, sizeof head, ">change, %s", report->compared[i].label);
        cz_table_head(table, head);
    }
}

/* Shares are printed as plain numbers, whose digits show small differences. */
static void put_numbers(CzReportTable *table, const CzReport *report, const CzResult *result,
                        const char *name) {
    const double factor = result->format == CZ_FORMAT_PERCENT ? 100 : 1;
    char text[CZ_FIGURE_SIZE];
    cz_table_put(table, name);
    cz_table_put(table, result->title);
    for (int i = 0; i < report->n_compared; i++) {
        cz_figure_plain(text, factor * cz_compared_value(report, i, result, name));
        cz_table_put(table, cz_figure_mark(text, cz_compared_is_beyond(report, i)));
    }
    for (int i = 1; i < report->n_compared; i++)
        put_difference(table, factor * cz_compared_value(report, 0, result, name),
                       factor * cz_compared_value(report, i, result, name));
}

void cz_compared_begin_numbers(CzReportTable *table, const CzReport *report, bool of_interface,
                               bool known) {
    const CzRunSummary *first = cz_compared_run(report, 0);
    const CzResult *const *result = of_interface ? of_interfaces : of_cars;
    begin(table, report, of_interface ? "interface;" : "car;");
    add_changes(table, report);
    for (; *result != NULL; result++)
        for (int i = 0; i < count_of(first, of_interface); i++) {
            const char *name = name_of(first, of_interface, i);
            if (!known || is_known(report, *result, name))
                put_numbers(table, report, *result, name);
        }
}

/* ---- differences ---- */

/* The value of a run, in the unit of the difference. */
static void put_input(CzReportTable *table, const CzInputDifference *input, int run) {
    char text[CZ_FIGURE_SIZE];
    if (input->value[run] == NULL)
        cz_table_put(table, "-");
    else if (isnan(input->number[run]))
        cz_table_put(table, input->value[run]);
    else
        cz_table_put_format(table, "%s%s%s", cz_figure_digits(text, 8, input->number[run]),
                            input->unit[0] != '\0' ? " " : "", input->unit);
}

/* Origins of a value: that of the first run that has it, and of the next one where it differs. */
static void put_origin(CzReportTable *table, const CzInputDifference *input, int n_run) {
    const char *first = "", *other = "";
    for (int i = 0; i < n_run; i++)
        if (first[0] == '\0')
            first = input->origin[i];
        else if (other[0] == '\0' && strcmp(input->origin[i], first) != 0)
            other = input->origin[i];
    cz_table_put_format(table, "%s%s%s", first, other[0] != '\0' ? "; " : "", other);
}

void cz_compared_begin_inputs(CzReportTable *table, const CzReport *report, int most) {
    const CzComparison *comparison = report->comparison;
    begin(table, report, "input;>places");
    add_changes(table, report);
    cz_table_head(table, "written in");
    for (int k = 0; k < comparison->n_input && k < most; k++) {
        const CzInputDifference *input = &comparison->input[k];
        char text[CZ_FIGURE_SIZE];
        snprintf(text, sizeof text, "%d", input->n_place);
        cz_table_put(table, input->path);
        cz_table_put(table, input->n_place > 1 ? text : "");
        for (int i = 0; i < report->n_compared; i++)
            put_input(table, input, i);
        for (int i = 1; i < report->n_compared; i++)
            put_difference(table, input->number[0], input->number[i]);
        put_origin(table, input, report->n_compared);
    }
}

void cz_compared_begin_differences(CzReportTable *table, const CzReport *report) {
    const CzComparison *comparison = report->comparison;
    begin(table, report, "result;");
    add_changes(table, report);
    for (int k = 0; k < comparison->n_number; k++) {
        const CzNumberDifference *number = &comparison->number[k];
        cz_table_put(table, number->path);
        cz_table_put(table, number->unit);
        for (int i = 0; i < report->n_compared; i++) {
            char text[CZ_FIGURE_SIZE];
            cz_figure_plain(text, number->value[i]);
            cz_table_put(table, cz_figure_mark(text, cz_compared_is_beyond(report, i)));
        }
        for (int i = 1; i < report->n_compared; i++)
            put_difference(table, number->value[0], number->value[i]);
    }
}

/* ---- on the terminal ---- */

/* Inputs that differ. */
static void write_inputs(const CzReport *report, CzTerminal *terminal) {
    enum { MAX_INPUTS = 40 };
    const CzComparison *comparison = report->comparison;
    CzReportTable table;
    if (comparison == NULL)
        return;
    if (comparison->n_input == 0) {
        fprintf(terminal->stream, "The inputs are equal: %d values.\n\n", comparison->n_same_input);
        return;
    }
    cz_compared_begin_inputs(&table, report, MAX_INPUTS);
    cz_table_write_text(&table, terminal);
    if (comparison->n_input > MAX_INPUTS)
        fprintf(terminal->stream, "and %d more, which the page and --json list.\n",
                comparison->n_input - MAX_INPUTS);
    fprintf(terminal->stream, "%d input%s, %d values are the same.\n\n", comparison->n_input,
            comparison->n_input == 1 ? " differs" : "s differ", comparison->n_same_input);
}

/* Trains and vehicles of other names. */
static void write_names(const CzReport *report, CzTerminal *terminal) {
    char text[CZ_SENTENCE_SIZE];
    bool any = false;
    for (int i = 1; i < report->n_compared; i++)
        if (cz_compared_names_sentence(report, i, sizeof text, text)) {
            cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s.\n", text);
            any = true;
        }
    if (any)
        fputc('\n', terminal->stream);
}

void cz_comparison_write_table(const CzReport *report, CzTerminal *terminal) {
    CzReportTable table;
    int n_same;
    if (report->n_compared < 1 || cz_compared_run(report, 0) == NULL)
        return;
    write_names(report, terminal);
    write_inputs(report, terminal);
    fprintf(terminal->stream, "scenario %s\n\n", cz_compared_run(report, 0)->scenario);
    cz_compared_begin_checks(&table, report, &n_same);
    cz_table_write_text(&table, terminal);
    fprintf(terminal->stream, "%d check%s the same.\n", n_same, n_same == 1 ? " is" : "s are");
    cz_screening_print(report->compared[0].problem, terminal);
    fputc('\n', terminal->stream);
    cz_compared_begin_numbers(&table, report, true, false);
    cz_table_write_text(&table, terminal);
    fputc('\n', terminal->stream);
    cz_compared_begin_numbers(&table, report, false, false);
    cz_table_write_text(&table, terminal);
    if (report->comparison != NULL)
        fprintf(terminal->stream,
                "\n%d numbers of the scenario differ, %d are the same; the page and --json list "
                "every one that differs.\n",
                report->comparison->n_number, report->comparison->n_same_number);
    if (cz_compared_caution(report)[0] != '\0')
        cz_terminal_print(terminal, CZ_STYLE_BAD, "%s\n", cz_compared_caution(report));
}
