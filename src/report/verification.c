/* A verification on a terminal: the results that change most. */
#include "crushzone/report.h"

#include "report/figure.h"
#include "report/outcome_table.h"
#include "report/tables.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_ROWS = 12 }; /* the rest changes less and is in the JSON document */

static double largest_of(const CzVerifiedValue *value) {
    double largest = 0.0;
    for (int method = 0; method < CZ_N_VERIFY_METHOD; method++) {
        largest = fmax(largest, value->change[method]);
        largest = value->flips[method] ? INFINITY : largest;
    }
    return largest;
}

/* Changed verdicts first, then by the largest change, then in the order of the list. */
static int by_change(const void *a, const void *b) {
    const CzVerifiedValue *const *p = a, *const *q = b;
    const double first = largest_of(*p), second = largest_of(*q);
    if (first != second)
        return first > second ? -1 : 1;
    return *p < *q ? -1 : *p > *q;
}

static void put_row(CzReportTable *table, const CzVerification *verification,
                    const CzVerifiedValue *value) {
    char text[CZ_FIGURE_SIZE];
    const char *unit = value->unit != NULL ? value->unit : "";
    cz_table_put(table, value->name);
    cz_table_put(table, value->where);
    cz_table_put(table, value->scenario);
    cz_figure_plain(text, value->production);
    cz_table_put_format(table, "%s%s%s", cz_figure_mark(text, value->beyond_validity),
                        unit[0] != '\0' ? " " : "", unit);
    for (int method = 0; method < CZ_N_VERIFY_METHOD; method++) {
        if ((verification->methods & (1u << method)) == 0)
            continue;
        const bool bad = value->flips[method] || value->change[method] > verification->limit;
        cz_table_put_styled(
            table, value->flips[method] ? "CHANGED" : cz_figure_change(text, value->change[method]),
            bad ? CZ_STYLE_BAD : CZ_STYLE_PLAIN);
    }
}

static void write_values(const CzVerification *verification, CzTerminal *terminal) {
    const size_t n = (size_t)verification->n_value;
    const CzVerifiedValue **value = calloc(n + 1, sizeof *value);
    terminal->failed |= value == NULL;
    if (value == NULL)
        return;
    for (size_t i = 0; i < n; i++)
        value[i] = &verification->value[i];
    qsort(value, n, sizeof *value, by_change);
    CzReportTable table;
    cz_table_begin(&table, "largest changes;where;scenario;>production");
    for (int method = 0; method < CZ_N_VERIFY_METHOD; method++) {
        char head[64];
        snprintf(head, sizeof head, ">%s", cz_verify_method_text((CzVerifyMethod)method));
        if ((verification->methods & (1u << method)) != 0)
            cz_table_head(&table, head);
    }
    for (size_t i = 0; i < n && i < MAX_ROWS; i++)
        put_row(&table, verification, value[i]);
    cz_table_write_text(&table, terminal);
    free(value);
}

void cz_verified_begin_methods(CzReportTable *table, const CzVerification *verification,
                               bool on_page) {
    char text[CZ_FIGURE_SIZE];
    cz_table_begin(table, "method;>largest change");
    cz_table_head(table, on_page ? "check" : NULL);
    cz_table_head(table, on_page ? "scenario" : NULL);
    cz_table_head(table, ">changed verdicts");
    for (int method = 0; method < CZ_N_VERIFY_METHOD; method++) {
        if ((verification->methods & (1u << method)) == 0)
            continue;
        const double change = verification->largest_change[method];
        const bool is_done = verification->is_done[method];
        const bool flips = verification->n_flip[method] > 0;
        const bool bad = !is_done || !(change <= verification->limit) || flips;
        const int worst = is_done ? verification->worst[method] : -1;
        const CzVerifiedValue *value = worst >= 0 ? &verification->value[worst] : NULL;
        cz_table_put(table, cz_verify_method_text((CzVerifyMethod)method));
        cz_table_put_styled(table, is_done ? cz_figure_change(text, change) : "not done",
                            bad ? CZ_STYLE_BAD : CZ_STYLE_PLAIN);
        cz_table_put(table, value != NULL ? value->name : "");
        cz_table_put(table, value != NULL ? value->scenario : "");
        snprintf(text, sizeof text, "%d", verification->n_flip[method]);
        cz_table_put_styled(table, text, flips ? CZ_STYLE_BAD : CZ_STYLE_PLAIN);
    }
}

static bool changes_too_much(const CzVerification *verification, const CzVerifiedValue *value) {
    for (int method = 0; method < CZ_N_VERIFY_METHOD; method++)
        if (value->change[method] > verification->limit)
            return true;
    return false;
}

/* Number of results that change too much, and of those with a scatter above the limit, for which no
 * method is more accurate. */
static void write_scatter(const CzVerification *verification, FILE *stream) {
    int n = 0, n_scatter = 0;
    for (int i = 0; i < verification->n_value; i++) {
        const CzVerifiedValue *value = &verification->value[i];
        n += changes_too_much(verification, value);
        n_scatter += value->change[CZ_METHOD_SCATTER] > verification->limit;
    }
    char text[CZ_FIGURE_SIZE];
    if (n > 0 && verification->is_done[CZ_METHOD_SCATTER])
        fprintf(stream,
                "%d of %d results change by more than %s; the scatter of %d of them is larger.\n",
                n, verification->n_value, cz_figure_change(text, verification->limit), n_scatter);
}

void cz_verification_write_table(const CzReport *report, CzTerminal *terminal) {
    const CzVerification *verification = report->verification;
    CzReportTable methods;
    char text[CZ_FIGURE_SIZE];
    cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s\n\n", cz_problem_title(report->problem));
    if (verification->n_value > 0) {
        write_values(verification, terminal);
        fputc('\n', terminal->stream);
        cz_verified_begin_methods(&methods, verification, false);
        cz_table_write_text(&methods, terminal);
        fputc('\n', terminal->stream);
    }
    if (verification->failure[0] != '\0')
        cz_terminal_print(terminal, CZ_STYLE_BAD, "%s\n", verification->failure);
    write_scatter(verification, terminal->stream);
    const bool passes = verification->verdict == CZ_VERDICT_PASS;
    fputs("Verification: ", terminal->stream);
    cz_terminal_print(terminal, passes ? CZ_STYLE_GOOD : CZ_STYLE_BAD, passes ? "pass" : "FAIL");
    fprintf(terminal->stream, " (%d results, limit %s)\n", verification->n_value,
            cz_figure_change(text, verification->limit));
}
