/* CSV tables: a function for each, and a writer of fields. */
#include "report/csv.h"

#include "base/number.h"
#include "evaluate/not_covered.h"
#include "report/figure.h"
#include "report/options.h"
#include "report/results.h"
#include "report/sample_values.h"
#include "report/units.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A table being written; end_row ends a row. */
typedef struct Table {
    FILE *stream;
    char separator, decimal;
    bool in_row; /* the row has a field already */
} Table;

static Table table_of(const CzReportOptions *options, FILE *stream) {
    return (Table){
        .stream = stream, .separator = options->csv_separator, .decimal = options->csv_decimal};
}

static void begin_field(Table *table) {
    if (table->in_row)
        fputc(table->separator, table->stream);
    table->in_row = true;
}

/* Whether a text begins with a sign that makes a spreadsheet read a formula: = + - @, or the
 * fullwidth form of one. */
static bool begins_formula(const char *text) {
    static const char *const signs[] = {
        "=", "+", "-", "@", "\xef\xbc\x9d", "\xef\xbc\x8b", "\xef\xbc\x8d", "\xef\xbc\xa0"};
    for (size_t i = 0; i < sizeof signs / sizeof *signs; i++)
        if (strncmp(text, signs[i], strlen(signs[i])) == 0)
            return true;
    return false;
}

/* Whether a program that reads another separator could begin a new cell after this character. */
static bool parts_fields(char sign) {
    return sign != '\0' && strchr(",;\t|\"\r\n", sign) != NULL;
}

/* Writes a text with an apostrophe before formulas and with doubled quotes; with `stream` NULL it
 * writes nothing. Returns whether the text needs quotes. */
static bool walk_text(const Table *table, const char *text, FILE *stream) {
    bool needs_quotes = false, begins_cell = true;
    for (; *text != '\0'; text++) {
        const bool is_formula = begins_cell && begins_formula(text);
        const bool is_blank = *text == ' ' || ((unsigned char)*text < 0x20);
        needs_quotes |= is_formula || *text == table->separator || parts_fields(*text);
        begins_cell = parts_fields(*text) || (begins_cell && is_blank);
        if (stream != NULL && is_formula)
            fputc('\'', stream);
        if (stream != NULL && *text == '"')
            fputc('"', stream);
        if (stream != NULL)
            fputc(*text, stream);
    }
    return needs_quotes;
}

/* Writes a text that no spreadsheet reads as a formula. */
static void put_text(Table *table, const char *text) {
    begin_field(table);
    if (text == NULL)
        return;
    const bool is_quoted = walk_text(table, text, NULL);
    if (is_quoted)
        fputc('"', table->stream);
    (void)walk_text(table, text, table->stream);
    if (is_quoted)
        fputc('"', table->stream);
}

/* Writes a typed number, or one that is an error measure. */
static void put_exact(Table *table, double value) {
    char text[CZ_FIGURE_SIZE];
    begin_field(table);
    if (!isfinite(value))
        return;
    cz_figure_digits(text, 9, cz_figure_exact(value));
    char *point = strchr(text, '.');
    if (point != NULL)
        *point = table->decimal;
    fputs(text, table->stream);
}

static void put_number(Table *table, double value) {
    put_exact(table, cz_figure_quantity(value));
}

static void end_row(Table *table) {
    fputs("\r\n", table->stream);
    table->in_row = false;
}

static void put_keys(Table *table, int n, const CzResult *const *result) {
    for (int i = 0; i < n; i++)
        put_text(table, result[i]->key);
}

/* Writes a field of a record; an empty one for NULL. */
static void put_result(Table *table, const CzResult *result, CzResultContext *context,
                       const void *record) {
    switch (result != NULL ? result->form : CZ_FORM_UNWRITTEN) {
    case CZ_FORM_NUMBER:
    case CZ_FORM_WHOLE:
        (result->is_exact ? put_exact : put_number)(table,
                                                    cz_result_number(result, context, record));
        break;
    case CZ_FORM_FLAG:
        put_text(table, cz_result_flag(result, context, record) ? "yes" : "no");
        break;
    case CZ_FORM_TEXT:
    case CZ_FORM_VERDICT:
        put_text(table, cz_result_words(result, context, record));
        break;
    case CZ_FORM_UNWRITTEN:
    case CZ_FORM_RECORD:
        put_text(table, NULL);
    }
}

/* Writes the fields of a record, of which some may have no result. */
static void put_results(Table *table, int n, const CzResult *const *result,
                        CzResultContext *context, const void *record) {
    for (int i = 0; i < n; i++)
        put_result(table, result[i], context, record);
}

void cz_csv_write_checks(const CzEvaluation *evaluation, const CzReportOptions *options,
                         FILE *stream) {
    static const CzResult *const columns[] = {
        CZ_RESULT_AT(CHECK, name),           CZ_RESULT_AT(CHECK, scenario),
        CZ_RESULT_AT(CHECK, where),          CZ_RESULT_AT(CHECK, kind),
        CZ_RESULT_AT(CHECK, limit),          CZ_RESULT_AT(CHECK, value),
        CZ_RESULT_AT(CHECK, unit),           CZ_RESULT_AT(CHECK, margin),
        CZ_RESULT_AT(CHECK, verdict),        CZ_RESULT_AT(CHECK, why),
        CZ_RESULT_AT(CHECK, profile),        CZ_RESULT_AT(CHECK, clause),
        CZ_RESULT_AT(CHECK, source),         CZ_RESULT_AT(CHECK, confidence),
        CZ_RESULT_AT(CHECK, beyond_validity)};
    enum { n_column = sizeof columns / sizeof *columns };
    CzResultContext context = {.evaluation = evaluation};
    Table table = table_of(options, stream);
    put_keys(&table, n_column, columns);
    end_row(&table);
    for (int i = 0; i < evaluation->n_check; i++) {
        put_results(&table, n_column, columns, &context, &evaluation->check[i]);
        end_row(&table);
    }
    for (int i = 0; i < evaluation->n_not_covered; i++) {
        for (int k = 0; k < n_column; k++)
            put_text(&table, columns[k] == CZ_RESULT_AT(CHECK, name) ? evaluation->not_covered[i]
                             : columns[k] == CZ_RESULT_AT(CHECK, verdict) ? "not covered"
                             : columns[k] == CZ_RESULT_AT(CHECK, why) ? "to be shown by other means"
                                                                      : NULL);
        end_row(&table);
    }
}

/* A row for each interface, with an empty element, then one for each of its elements. */
void cz_csv_write_interfaces(const CzRunSummary *run, const CzReportOptions *options,
                             FILE *stream) {
    enum { N_COLUMN = 10 }; /* NULL where an interface or an element has none */
    static const CzResult *const of_interface[N_COLUMN] = {
        CZ_RESULT_AT(INTERFACE, peak_force_kN),
        CZ_RESULT_AT(INTERFACE, peak_time_ms),
        CZ_RESULT_AT(INTERFACE, shortening_mm),
        NULL,
        NULL,
        CZ_RESULT_AT(INTERFACE, energy_kJ),
        CZ_RESULT_AT(INTERFACE, energy_share),
        NULL,
        CZ_RESULT_AT(INTERFACE, bottomed_out),
        CZ_RESULT_AT(INTERFACE, beyond_validity)};
    static const CzResult *const of_element[N_COLUMN] = {CZ_RESULT_AT(ELEMENT, peak_force_kN),
                                                         NULL,
                                                         NULL,
                                                         CZ_RESULT_AT(ELEMENT, stroke_mm),
                                                         CZ_RESULT_AT(ELEMENT, stroke_used),
                                                         CZ_RESULT_AT(ELEMENT, energy_kJ),
                                                         NULL,
                                                         CZ_RESULT_AT(ELEMENT, stored_kJ),
                                                         CZ_RESULT_AT(ELEMENT, bottomed_out),
                                                         CZ_RESULT_AT(ELEMENT, beyond_validity)};
    CzResultContext context = {.run = run};
    Table table = table_of(options, stream);
    put_text(&table, "interface");
    put_text(&table, "element");
    for (int k = 0; k < N_COLUMN; k++)
        put_text(&table, (of_interface[k] != NULL ? of_interface[k] : of_element[k])->key);
    end_row(&table);
    for (int i = 0; i < run->n_interface; i++) {
        const CzInterfaceResult *interface = &run->interface[i];
        put_text(&table, interface->name);
        put_text(&table, NULL);
        put_results(&table, N_COLUMN, of_interface, &context, interface);
        end_row(&table);
        for (int e = 0; e < interface->n_element; e++) {
            put_text(&table, interface->name);
            put_text(&table, interface->element[e].name);
            put_results(&table, N_COLUMN, of_element, &context, &interface->element[e]);
            end_row(&table);
        }
    }
}

/* Values of a column; `found` stores their place, and may be NULL. */
static const double *column_values(const CzRun *run, int i, const double **found) {
    if (found != NULL && found[i] != NULL)
        return found[i];
    const CzColumn column = cz_run_column(run, i);
    const double *values = cz_run_channel(run, column.channel, column.place);
    if (found != NULL)
        found[i] = values;
    return values;
}

void cz_csv_write_channels(const CzRun *run, const CzReportOptions *options, FILE *stream) {
    const CzRunSummary *summary = cz_run_summary(run);
    Table table = table_of(options, stream);
    const int n_column = cz_run_n_column(run);
    const double *time = cz_run_channel(run, CZ_CHANNEL_TIME, 0);
    const double from = summary->beyond_validity_time * CZ_MILLI_PER_UNIT; /* or NaN */
    for (int i = 0; i < n_column; i++) {
        const CzColumn column = cz_run_column(run, i);
        const CzChannelInfo *info = cz_channel_info(column.channel);
        const char *place = cz_run_place_name(summary, info->at, column.place);
        char name[CZ_CHANNEL_SIZE];
        put_text(&table, cz_channel_name(info, column.place, place, name));
    }
    put_text(&table, "beyond_validity");
    end_row(&table);
    const double **found = calloc((size_t)n_column, sizeof *found); /* looks up when refused */
    for (int sample = 0; sample < cz_run_n_sample(run); sample++) {
        for (int i = 0; i < n_column; i++)
            put_number(&table, column_values(run, i, found)[sample]);
        put_number(&table, time[sample] > from ? 1 : 0);
        end_row(&table);
    }
    free(found);
}

void cz_csv_write_history(const CzReport *report, FILE *stream) {
    const CzOutcome *outcome = report->outcome;
    static const CzResult *const columns[] = {
        CZ_RESULT_AT(TRIAL, evaluation), CZ_RESULT_AT(TRIAL, phase), CZ_RESULT_AT(TRIAL, objective),
        CZ_RESULT_AT(TRIAL, violation), CZ_RESULT_AT(TRIAL, feasible)};
    enum { n_column = sizeof columns / sizeof *columns };
    const int n_variable = outcome->trial_x != NULL ? outcome->n_variable : 0;
    CzResultContext context = {.report = report};
    Table table = table_of(cz_report_options_of(report), stream);
    put_keys(&table, n_column, columns);
    for (int k = 0; k < n_variable; k++)
        put_text(&table, cz_evaluator_variable(report->evaluator, k)->name);
    end_row(&table);
    for (long i = 0; i < outcome->n_trial; i++) {
        put_results(&table, n_column, columns, &context, &outcome->trial[i]);
        for (int k = 0; k < n_variable; k++)
            put_exact(&table, outcome->trial_x[i * n_variable + k]);
        end_row(&table);
    }
}

/* A verdict in full, where there are no columns for provisional and screening. */
static void put_verdict(Table *table, const CzProblem *problem, CzVerdict verdict) {
    int n_not_covered;
    cz_not_covered(problem, &n_not_covered);
    put_text(table, cz_verdict_words(verdict, n_not_covered));
}

void cz_csv_write_sweep(const CzReport *report, FILE *stream) {
    const CzSweep *sweep = report->sweep;
    static const CzResult *const columns[] = {
        CZ_RESULT_AT(POINT, state),           CZ_RESULT_AT(POINT, verdict),
        CZ_RESULT_AT(POINT, margin),          CZ_RESULT_AT(POINT, check),
        CZ_RESULT_AT(POINT, where),           CZ_RESULT_AT(POINT, scenario),
        CZ_RESULT_AT(POINT, beyond_validity), CZ_RESULT_AT(POINT, message)};
    enum { n_column = sizeof columns / sizeof *columns };
    CzResultContext context = {.report = report};
    Table table = table_of(cz_report_options_of(report), stream);
    for (int k = 0; k < sweep->n_axis; k++)
        put_text(&table, sweep->axis[k].path);
    for (int k = 0; k < sweep->n_metric; k++)
        put_text(&table, sweep->metric[k]);
    put_keys(&table, n_column, columns);
    end_row(&table);
    for (int i = 0; i < sweep->n_point; i++) {
        const CzSweepPoint *point = &sweep->point[i];
        const bool is_done = point->state == CZ_SWEEP_DONE;
        for (int k = 0; k < sweep->n_axis; k++)
            put_exact(&table, point->value[k]);
        for (int k = 0; k < sweep->n_metric; k++)
            put_exact(&table, point->metric[k]);
        for (int k = 0; k < n_column; k++)
            if (is_done && columns[k] == CZ_RESULT_AT(POINT, verdict))
                put_verdict(&table, sweep->problem, point->verdict);
            else
                put_result(&table, columns[k], &context, point);
        end_row(&table);
    }
}

/* ---- samples ---- */

/* Writes a number with all its digits. */
static void put_full(Table *table, double value) {
    char text[CZ_NUMBER_TEXT];
    begin_field(table);
    if (!isfinite(value))
        return;
    cz_number_print(text, value);
    char *point = strchr(text, '.');
    if (point != NULL)
        *point = table->decimal;
    fputs(text, table->stream);
}

/* A margin; a word where a run failed. */
static void put_size(Table *table, double margin) {
    if (isinf(margin))
        put_text(table, "failed");
    else
        put_full(table, margin);
}

/* A check in one sample: its margin, or a word. */
static void put_margin(Table *table, bool is_flag, double margin, CzVerdict verdict) {
    if (is_flag)
        put_text(table, verdict == CZ_VERDICT_NOT_CHECKED ? NULL
                        : cz_verdict_passes(verdict)      ? "pass"
                                                          : "fail");
    else
        put_size(table, margin);
}

static void put_check_head(Table *table, const char *check, const char *scenario) {
    char name[2 * CZ_LABEL_SIZE + CZ_NAME_SIZE];
    snprintf(name, sizeof name, "%s, %s", check, scenario);
    put_text(table, name);
}

static void put_sample(Table *table, const CzSampling *sampling, int k) {
    const CzSample *sample = &sampling->sample[k];
    const CzSampledCheck *check = sample->check >= 0 ? &sampling->check[sample->check] : NULL;
    put_exact(table, k + 1);
    put_text(table, cz_sample_state_text(sample->state));
    put_verdict(table, sampling->problem, sample->verdict);
    put_text(table, sample->beyond_validity ? "yes" : "no");
    put_size(table, sample->margin);
    put_text(table, check != NULL ? check->name : NULL);
    put_text(table, check != NULL ? check->scenario : NULL);
    for (int d = 0; d < sampling->n_draw; d++)
        put_full(table, cz_sample_value(sampling, k, d));
    for (int c = 0; c < sampling->n_check; c++)
        put_margin(table, sampling->check[c].is_flag, cz_sample_margin(sampling, k, c),
                   cz_sample_verdict(sampling, k, c));
    put_text(table, sample->message);
    end_row(table);
}

void cz_csv_write_samples(const CzReport *report, FILE *stream) {
    static const char *const heads[] = {"sample", "state", "verdict", "beyond_validity",
                                        "margin", "check", "scenario"};
    const CzSampling *sampling = report->sampling;
    Table table = table_of(cz_report_options_of(report), stream);
    for (size_t i = 0; i < sizeof heads / sizeof *heads; i++)
        put_text(&table, heads[i]);
    for (int d = 0; d < sampling->n_draw; d++)
        put_text(&table, sampling->draw[d].name);
    for (int c = 0; c < sampling->n_check; c++)
        put_check_head(&table, sampling->check[c].name, sampling->check[c].scenario);
    put_text(&table, "message");
    end_row(&table);
    for (int k = 0; k < sampling->n_sample; k++)
        if (sampling->sample[k].state != CZ_SAMPLE_NOT_RUN)
            put_sample(&table, sampling, k);
}

void cz_csv_write_pareto(const CzReport *report, FILE *stream) {
    const CzPareto *pareto = report->pareto;
    static const CzResult *const columns[] = {
        CZ_RESULT_AT(FRONT_POINT, bound),        CZ_RESULT_AT(FRONT_POINT, state),
        CZ_RESULT_AT(FRONT_POINT, dominated_by), CZ_RESULT_AT(FRONT_POINT, verdict),
        CZ_RESULT_AT(FRONT_POINT, violation),    CZ_RESULT_AT(FRONT_POINT, evaluations),
        CZ_RESULT_AT(FRONT_POINT, why)};
    enum { n_column = sizeof columns / sizeof *columns };
    CzResultContext context = {.report = report};
    Table table = table_of(cz_report_options_of(report), stream);
    for (int k = 0; k < 2; k++)
        put_text(&table, pareto->objective[k].name);
    put_keys(&table, n_column, columns);
    for (int k = 0; k < pareto->n_variable; k++)
        put_text(&table, cz_evaluator_variable(pareto->evaluator, k)->name);
    end_row(&table);
    for (int i = 0; i < pareto->n_point; i++) {
        const CzParetoPoint *point = &pareto->point[i];
        for (int k = 0; k < 2; k++)
            put_exact(&table, point->value[k]);
        for (int k = 0; k < n_column; k++)
            if (point->x != NULL && columns[k] == CZ_RESULT_AT(FRONT_POINT, verdict))
                put_verdict(&table, report->problem, point->verdict);
            else if (columns[k] == CZ_RESULT_AT(FRONT_POINT, dominated_by) &&
                     point->dominated_by < 0)
                put_text(&table, NULL);
            else
                put_result(&table, columns[k], &context, point);
        for (int k = 0; k < pareto->n_variable; k++)
            put_exact(&table, point->x != NULL ? point->x[k] : NAN);
        end_row(&table);
    }
}

/* ---- challenge ---- */

static void put_challenge_point(Table *table, const CzChallenge *challenge, int k) {
    const CzChallengePoint *point = &challenge->point[k];
    const long row = (long)k * challenge->n_check;
    const CzChallengedCheck *check = point->check >= 0 ? &challenge->check[point->check] : NULL;
    put_exact(table, k + 1);
    put_text(table, point->phase);
    put_text(table, cz_sample_state_text(point->state));
    put_verdict(table, challenge->problem, point->verdict);
    put_size(table, point->margin);
    put_text(table, check != NULL ? check->name : NULL);
    put_text(table, check != NULL ? check->scenario : NULL);
    for (int d = 0; d < challenge->n_draw; d++)
        put_full(table, cz_challenge_value(challenge, k, d));
    for (int c = 0; c < challenge->n_check; c++)
        put_margin(table, challenge->check[c].is_flag, challenge->margin[row + c],
                   challenge->verdict[row + c]);
    put_text(table, point->message);
    end_row(table);
}

void cz_csv_write_challenge(const CzReport *report, FILE *stream) {
    static const char *const heads[] = {"point",  "phase", "state",   "verdict",
                                        "margin", "check", "scenario"};
    const CzChallenge *challenge = report->challenge;
    Table table = table_of(cz_report_options_of(report), stream);
    for (size_t i = 0; i < sizeof heads / sizeof *heads; i++)
        put_text(&table, heads[i]);
    for (int d = 0; d < challenge->n_draw; d++)
        put_text(&table, challenge->draw[d].name);
    for (int c = 0; c < challenge->n_check; c++)
        put_check_head(&table, challenge->check[c].name, challenge->check[c].scenario);
    put_text(&table, "message");
    end_row(&table);
    for (int k = 0; k < challenge->n_point; k++)
        put_challenge_point(&table, challenge, k);
}

/* ---- corridors ---- */

void cz_csv_write_corridor(const CzReport *report, FILE *stream) {
    static const CzResult *const columns[] = {
        CZ_RESULT_AT(CORRIDOR_POINT, stroke_mm), CZ_RESULT_AT(CORRIDOR_POINT, lower_kN),
        CZ_RESULT_AT(CORRIDOR_POINT, nominal_kN), CZ_RESULT_AT(CORRIDOR_POINT, upper_kN)};
    enum { n_column = sizeof columns / sizeof *columns };
    CzResultContext context = {.report = report};
    Table table = table_of(cz_report_options_of(report), stream);
    put_keys(&table, n_column, columns);
    end_row(&table);
    for (int i = 0; i < report->corridor->n_point; i++) {
        put_results(&table, n_column, columns, &context, &report->corridor->stroke[i]);
        end_row(&table);
    }
}
