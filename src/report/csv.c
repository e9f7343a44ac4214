/* CSV tables, one function each, over a writer of fields. */
#include "report/csv.h"

#include "report/figure.h"
#include "report/units.h"

#include <math.h>
#include <string.h>

/* One table being written; a row ends with end_row. */
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

/* Whether a text goes on with a sign that makes a spreadsheet take a cell for a formula: = + - @,
 * and their fullwidth forms, which some take too. */
static bool begins_formula(const char *text) {
    static const char *const signs[] = {
        "=", "+", "-", "@", "\xef\xbc\x9d", "\xef\xbc\x8b", "\xef\xbc\x8d", "\xef\xbc\xa0"};
    for (size_t i = 0; i < sizeof signs / sizeof *signs; i++)
        if (strncmp(text, signs[i], strlen(signs[i])) == 0)
            return true;
    return false;
}

/* Where a program that parts fields by another sign than ours could begin a cell. */
static bool parts_fields(char sign) {
    return sign != '\0' && strchr(",;\t|\"\r\n", sign) != NULL;
}

/* Walks over a text as it is written: formulas get an apostrophe in front, quotes are doubled. With
 * `stream` NULL nothing is written; returns whether the text needs quotes around it. */
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

/* A text is a text wherever the file is opened, and no spreadsheet runs it. */
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

/* A number that was typed, or measures an error. */
static void put_exact(Table *table, double value) {
    char text[CZ_FIGURE_ROOM];
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

static void put_flag(Table *table, bool value) {
    put_text(table, value ? "yes" : "no");
}

static void end_row(Table *table) {
    fputs("\r\n", table->stream);
    table->in_row = false;
}

static void put_names(Table *table, int n, const char *const *name) {
    for (int i = 0; i < n; i++)
        put_text(table, name[i]);
    end_row(table);
}

void cz_csv_write_checks(const CzEvaluation *evaluation, const CzReportOptions *options,
                         FILE *stream) {
    static const char *const names[] = {"name",    "scenario",   "where",          "kind",
                                        "limit",   "value",      "unit",           "margin",
                                        "verdict", "why",        "profile",        "clause",
                                        "source",  "confidence", "beyond_validity"};
    enum { verdict = 8, n_column = sizeof names / sizeof *names };
    Table table = table_of(options, stream);
    put_names(&table, n_column, names);
    for (int i = 0; i < evaluation->n_check; i++) {
        const CzCheckResult *check = &evaluation->check[i];
        put_text(&table, check->name);
        put_text(&table, check->scenario);
        put_text(&table, check->where);
        put_text(&table, check->is_minimum ? "min" : "max");
        put_exact(&table, check->limit);
        put_exact(&table, check->value);
        put_text(&table, check->unit);
        put_exact(&table, check->margin);
        put_text(&table, cz_verdict_text(check->verdict));
        put_text(&table, check->why);
        put_text(&table, check->profile);
        put_text(&table, check->clause);
        put_text(&table, check->source);
        put_text(&table, check->confidence);
        put_flag(&table, check->beyond_validity);
        end_row(&table);
    }
    for (int i = 0; i < evaluation->n_not_covered; i++) {
        put_text(&table, evaluation->not_covered[i]);
        for (int column = 1; column < verdict; column++)
            put_text(&table, NULL);
        put_text(&table, "not covered");
        put_text(&table, "to be shown by other means");
        for (int column = verdict + 2; column < n_column; column++)
            put_text(&table, NULL);
        end_row(&table);
    }
}

/* One row per element, after one for the interface as a whole with an empty element. */
void cz_csv_write_interfaces(const CzRunSummary *run, const CzReportOptions *options,
                             FILE *stream) {
    static const char *const names[] = {"interface",    "element",       "peak_force_kN",
                                        "peak_time_ms", "shortening_mm", "stroke_mm",
                                        "stroke_used",  "energy_kJ",     "energy_share",
                                        "stored_kJ",    "bottomed_out",  "beyond_validity"};
    Table table = table_of(options, stream);
    put_names(&table, (int)(sizeof names / sizeof *names), names);
    for (int i = 0; i < run->n_interface; i++) {
        const CzInterfaceResult *interface = &run->interface[i];
        put_text(&table, interface->name);
        put_text(&table, NULL);
        put_number(&table, interface->peak_force / CZ_KILO);
        put_number(&table, cz_milliseconds(interface->peak_time));
        put_number(&table, interface->shortening * CZ_MILLI_PER_UNIT);
        put_text(&table, NULL);
        put_text(&table, NULL);
        put_number(&table, cz_run_total(run, interface->energy) / CZ_KILO);
        put_number(&table, cz_run_total(run, interface->energy_share));
        put_text(&table, NULL);
        put_flag(&table, interface->bottomed_out);
        put_flag(&table, run->beyond_validity);
        end_row(&table);
        for (int k = 0; k < interface->n_element; k++) {
            const CzElementResult *element = &interface->element[k];
            put_text(&table, interface->name);
            put_text(&table, element->name);
            put_number(&table, element->peak_force / CZ_KILO);
            put_text(&table, NULL);
            put_text(&table, NULL);
            put_number(&table, element->stroke * CZ_MILLI_PER_UNIT);
            put_number(&table, element->stroke_used);
            put_number(&table, cz_run_total(run, element->energy) / CZ_KILO);
            put_text(&table, NULL);
            put_number(&table, cz_run_total(run, element->stored) / CZ_KILO);
            put_flag(&table, element->bottomed_out);
            put_flag(&table, run->beyond_validity);
            end_row(&table);
        }
    }
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
        char name[CZ_CHANNEL_ROOM];
        put_text(&table, cz_channel_name(info, column.place, place, name));
    }
    put_text(&table, "beyond_validity");
    end_row(&table);
    for (int sample = 0; sample < cz_run_n_sample(run); sample++) {
        for (int i = 0; i < n_column; i++) {
            const CzColumn column = cz_run_column(run, i);
            put_number(&table, cz_run_channel(run, column.channel, column.place)[sample]);
        }
        put_number(&table, time[sample] > from ? 1 : 0);
        end_row(&table);
    }
}

void cz_csv_write_history(const CzEvaluator *evaluator, const CzOutcome *outcome,
                          const CzReportOptions *options, FILE *stream) {
    const int n_variable = outcome->trial_x != NULL ? outcome->n_variable : 0;
    static const char *const names[] = {"evaluation", "phase", "objective", "violation",
                                        "feasible"};
    Table table = table_of(options, stream);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        put_text(&table, names[i]);
    for (int k = 0; k < n_variable; k++)
        put_text(&table, cz_evaluator_variable(evaluator, k)->name);
    end_row(&table);
    for (long i = 0; i < outcome->n_trial; i++) {
        const CzTrial *trial = &outcome->trial[i];
        put_number(&table, (double)(i + 1));
        put_text(&table, trial->phase);
        put_exact(&table, trial->objective);
        put_exact(&table, trial->violation);
        put_flag(&table, trial->feasible);
        for (int k = 0; k < n_variable; k++)
            put_exact(&table, outcome->trial_x[i * n_variable + k]);
        end_row(&table);
    }
}

void cz_csv_write_sweep(const CzSweep *sweep, const CzReportOptions *options, FILE *stream) {
    static const char *const names[] = {"state", "verdict",  "margin",         "check",
                                        "where", "scenario", "beyond_validity"};
    Table table = table_of(options, stream);
    for (int k = 0; k < sweep->n_axis; k++)
        put_text(&table, sweep->axis[k].path);
    for (int k = 0; k < sweep->n_metric; k++)
        put_text(&table, sweep->metric[k]);
    put_names(&table, (int)(sizeof names / sizeof *names), names);
    for (int i = 0; i < sweep->n_point; i++) {
        const CzSweepPoint *point = &sweep->point[i];
        for (int k = 0; k < sweep->n_axis; k++)
            put_exact(&table, point->value[k]);
        for (int k = 0; k < sweep->n_metric; k++)
            put_exact(&table, point->metric[k]);
        put_text(&table, cz_sweep_state_text(point->state));
        put_text(&table, point->state == CZ_SWEEP_DONE ? cz_verdict_text(point->verdict) : NULL);
        put_exact(&table, point->margin);
        put_text(&table, point->check);
        put_text(&table, point->where);
        put_text(&table, point->scenario);
        put_flag(&table, point->beyond_validity);
        end_row(&table);
    }
}
