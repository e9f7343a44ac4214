/* The table of checks: limit, value and margin of each. */
#include "report/checks_table.h"

#include "base/number.h"
#include "report/figure.h"
#include "report/runs.h"
#include "report/table.h"
#include "report/units.h"
#include "report/verdict_words.h"

#include <math.h>
#include <string.h>

static const char *spaced_unit(const CzCheckResult *check, char room[32]) {
    if (check->unit == NULL || check->unit[0] == '\0')
        return "";
    snprintf(room, 32, " %s", check->unit);
    for (char *c = room; *c != '\0'; c++) /* m_s of a channel is printed as m/s */
        *c = *c == '_' ? '/' : *c;
    return room;
}

/* The word for a number of a yes or no; NULL for others, and where several are counted. */
static const char *yes_or_no(const CzCheckResult *check, double number) {
    const bool counts = check->limit != 0 && check->limit != 1;
    return !check->is_flag || counts ? NULL : number == 0 ? "no" : number == 1 ? "yes" : NULL;
}

const char *cz_checks_limit(char text[CZ_CHECK_SIZE], const CzCheckResult *check) {
    char number[CZ_FIGURE_SIZE], unit[32];
    double read; /* a typed limit is printed unchanged, a computed one is rounded */
    if (!isfinite(check->limit))
        return "-";
    if (yes_or_no(check, check->limit) != NULL)
        return yes_or_no(check, check->limit);
    cz_figure_digits(number, 6, check->limit);
    if (cz_number_parse(number, &read) != NULL || read != check->limit)
        cz_figure_digits(number, 4, check->limit);
    snprintf(text, CZ_CHECK_SIZE, "%s%s%s", check->is_minimum ? "min " : "", number,
             spaced_unit(check, unit));
    return text;
}

const char *cz_checks_value(char text[CZ_CHECK_SIZE], const CzCheckResult *check) {
    char number[CZ_FIGURE_SIZE], unit[32];
    if (yes_or_no(check, check->value) != NULL) {
        snprintf(text, CZ_CHECK_SIZE, "%s%s", yes_or_no(check, check->value),
                 check->beyond_validity ? "*" : "");
        return text;
    }
    /* Two decimals leave a small share with one digit. */
    const bool is_small = spaced_unit(check, unit)[0] == '\0' && fabs(check->value) < 0.1;
    if (is_small)
        cz_figure_digits(number, 3, check->value);
    else
        cz_figure_plain(number, check->value);
    /* A value that violates its limit must not read as equal to it. */
    const bool breaks =
        check->is_minimum ? check->value < check->limit : check->value > check->limit;
    double read;
    for (int digits = 3; breaks && isfinite(check->value) && digits <= 17; digits++) {
        if (cz_number_parse(number, &read) == NULL && read != check->limit)
            break;
        cz_figure_digits(number, digits, check->value);
    }
    const bool is_known = isfinite(check->value);
    snprintf(text, CZ_CHECK_SIZE, "%s%s%s", number, is_known ? spaced_unit(check, unit) : "",
             is_known && check->beyond_validity ? "*" : "");
    return text;
}

bool cz_checks_does_not_apply(const CzCheckResult *check) {
    return isnan(check->value) && cz_verdict_passes(check->verdict);
}

/* Whether check i is the worst of its name, or with `of_family` of its name and family; the first
 * of equals. */
static bool is_worst_of_name(const CzEvaluation *evaluation, int i, bool of_family) {
    const CzCheckResult *check = evaluation->check;
    for (int k = 0; k < evaluation->n_check; k++) {
        if (k == i || check[k].has_no_run || strcmp(check[k].name, check[i].name) != 0)
            continue;
        const bool is_sister = check[i].family != NULL && check[k].family != NULL &&
                               strcmp(check[i].family, check[k].family) == 0;
        if (of_family && !is_sister)
            continue;
        if (cz_check_is_worse(&check[k], &check[i]) ||
            (k < i && !cz_check_is_worse(&check[i], &check[k])))
            return false;
    }
    return true;
}

const char *cz_checks_word(const CzCheckResult *check) {
    return cz_checks_does_not_apply(check) ? "n/a" : cz_verdict_word(check->verdict);
}

bool cz_checks_is_shown(const CzEvaluation *evaluation, int i) {
    const bool fails = evaluation->check[i].verdict == CZ_VERDICT_FAIL;
    return !evaluation->check[i].has_no_run && is_worst_of_name(evaluation, i, fails);
}

static const char *or_empty(const char *text) {
    return text != NULL ? text : "";
}

/* A margin to the right of the middle, a violation to the left. */
static const CzBar margin_bar = {"bar", "margin", 30, 31, "#d0021b", "#009e73"};

void cz_checks_time(const CzCheckResult *check, size_t room, char *text) {
    char from[CZ_FIGURE_SIZE], to[CZ_FIGURE_SIZE];
    text[0] = '\0';
    if (!isfinite(check->when[0]))
        return;
    cz_figure_fixed(from, 0, check->when[0] * CZ_MILLI_PER_UNIT);
    cz_figure_fixed(to, 0, check->when[1] * CZ_MILLI_PER_UNIT);
    const bool is_window = check->when[1] > check->when[0];
    snprintf(text, room, "%.20s%s%.20s", from, is_window ? " to " : "", is_window ? to : "");
}

/* Reason, clause and source of the limit. */
static void put_source(CzReportTable *table, const CzCheckResult *check) {
    const bool has_source = check->source != NULL && check->source[0] != '\0';
    const bool has_confidence = has_source && check->confidence != NULL;
    char text[3 * CZ_SENTENCE_SIZE];
    snprintf(text, sizeof text, "%s%s%s%s%s%s%s", or_empty(check->why),
             check->why != NULL && has_source ? "; " : "", or_empty(check->clause),
             check->clause != NULL && has_source ? ", " : "", or_empty(check->source),
             has_confidence ? ", confidence " : "", has_confidence ? check->confidence : "");
    cz_table_put_styled(table, text, CZ_STYLE_SMALL);
}

static void put_verdict(CzReportTable *table, const CzCheckResult *check) {
    cz_table_put_styled(table, cz_checks_word(check),
                        cz_checks_does_not_apply(check) ? CZ_STYLE_PLAIN
                                                        : cz_verdict_style(check->verdict));
}

/* `number` is that of the check on a page; 0 for none. */
static void put_check(CzReportTable *table, const CzCheckResult *check, const CzCheckResult *before,
                      int number) {
    char text[CZ_CHECK_SIZE] = "";
    cz_table_put(table, check->name);
    if (number > 0)
        cz_table_anchor(table, "check", number);
    put_verdict(table, check);
    cz_table_put(table, check->where);
    cz_table_put(table, check->scenario);
    cz_checks_time(check, sizeof text, text);
    cz_table_put(table, text);
    cz_table_put(table, cz_checks_limit(text, check));
    cz_table_put_styled(table, before != NULL ? cz_checks_value(text, before) : "",
                        before != NULL && before->verdict == CZ_VERDICT_FAIL ? CZ_STYLE_BAD
                                                                             : CZ_STYLE_PLAIN);
    cz_table_put(table, cz_checks_value(text, check));
    cz_table_put(table, cz_figure_margin(text, check->margin));
    put_verdict(table, check);
    cz_table_put_bar(table, &margin_bar, check->margin);
    cz_table_put(table, check->why);
    put_source(table, check);
}

/* ---- scenarios without a run ---- */

const char *cz_checks_scenario(const CzCheckResult *check) {
    return check->family != NULL ? check->family : check->scenario;
}

static bool is_of_scenario(const CzCheckResult *check, const CzCheckResult *other) {
    return strcmp(cz_checks_scenario(check), cz_checks_scenario(other)) == 0;
}

/* Number of checks that could not be made because this scenario has no run; 0 unless check i is the
 * first of them. */
static int n_without_run(const CzEvaluation *evaluation, int i) {
    const CzCheckResult *check = evaluation->check;
    int n = 0;
    for (int k = 0; k < evaluation->n_check; k++) {
        if (!check[k].has_no_run || !is_of_scenario(&check[k], &check[i]))
            continue;
        if (k < i)
            return 0;
        n++;
    }
    return check[i].has_no_run ? n : 0;
}

/* One line for all these checks of a scenario. */
static void put_scenarios_without_run(CzReportTable *table, const CzEvaluation *evaluation) {
    for (int i = 0; i < evaluation->n_check; i++) {
        const int n = n_without_run(evaluation, i);
        if (n == 0)
            continue;
        char name[48];
        snprintf(name, sizeof name, "%d check%s", n, n == 1 ? "" : "s");
        const CzCheckResult all = {.name = name,
                                   .scenario = cz_checks_scenario(&evaluation->check[i]),
                                   .verdict = CZ_VERDICT_NOT_CHECKED,
                                   .why = evaluation->check[i].why,
                                   .limit = NAN,
                                   .value = NAN,
                                   .margin = NAN,
                                   .when = {NAN, NAN}};
        put_check(table, &all, NULL, 0);
    }
}

/* The columns of a page or of a terminal, in the order of put_check. */
static void begin(CzReportTable *table, bool on_page, bool several, bool with_before) {
    const char *const heads[] = {"check",
                                 on_page ? "verdict" : NULL,
                                 "where",
                                 several ? "scenario" : NULL,
                                 on_page ? ">when ms" : NULL,
                                 ">limit",
                                 with_before ? ">before" : NULL,
                                 with_before ? ">after" : ">value",
                                 ">margin",
                                 on_page ? NULL : "",
                                 on_page ? "" : NULL,
                                 on_page ? NULL : "",
                                 on_page ? "remark and source" : NULL};
    cz_table_begin(table, NULL);
    for (size_t k = 0; k < sizeof heads / sizeof *heads; k++)
        cz_table_head(table, heads[k]);
}

void cz_checks_write_rows(CzMarkup *markup, const CzEvaluation *evaluation,
                          const CzEvaluation *before, bool rest) {
    CzReportTable table;
    begin(&table, true, true, before != NULL);
    table.class_name = "checks cards";
    for (int pass = 0; pass < 2; pass++) /* failures first */
        for (int i = 0; i < evaluation->n_check; i++) {
            const bool fails = evaluation->check[i].verdict == CZ_VERDICT_FAIL;
            if (!evaluation->check[i].has_no_run && cz_checks_is_shown(evaluation, i) != rest &&
                fails == (pass == 0))
                put_check(&table, &evaluation->check[i], before != NULL ? &before->check[i] : NULL,
                          i + 1);
        }
    if (!rest)
        put_scenarios_without_run(&table, evaluation);
    cz_table_write_page(&table, markup);
}

static void write_verdict(CzTerminal *terminal, CzVerdict verdict) {
    cz_terminal_print(terminal, cz_verdict_style(verdict), "%s", cz_verdict_word(verdict));
}

/* The last line of a table: "22 checks: 3 FAIL, 19 pass. Verdict: FAIL." */
static void write_count(const CzEvaluation *evaluation, CzTerminal *terminal) {
    char remark[CZ_SCREENING_SIZE];
    int n[4] = {0};
    for (int i = 0; i < evaluation->n_check; i++)
        n[evaluation->check[i].verdict]++;
    static const CzVerdict order[] = {CZ_VERDICT_FAIL, CZ_VERDICT_NOT_CHECKED,
                                      CZ_VERDICT_PROVISIONAL, CZ_VERDICT_PASS};
    const char *between = ": ";
    fprintf(terminal->stream, "%d check%s", evaluation->n_check,
            evaluation->n_check == 1 ? "" : "s");
    for (int i = 0; i < 4; i++) {
        if (n[order[i]] == 0)
            continue;
        fprintf(terminal->stream, "%s%d ", between, n[order[i]]);
        write_verdict(terminal, order[i]);
        between = ", ";
    }
    fputs(". Verdict: ", terminal->stream);
    write_verdict(terminal, evaluation->verdict);
    fprintf(terminal->stream, "%s.\n",
            cz_screening_remark(evaluation->verdict, evaluation->n_not_covered, remark));
}

static void print_scenarios_without_run(const CzEvaluation *evaluation, CzTerminal *terminal) {
    for (int i = 0; i < evaluation->n_check; i++) {
        const int n = n_without_run(evaluation, i);
        if (n == 0)
            continue;
        write_verdict(terminal, CZ_VERDICT_NOT_CHECKED);
        cz_terminal_print(terminal, CZ_STYLE_PLAIN, ": %d check%s of %s, %s.\n", n,
                          n == 1 ? "" : "s", cz_checks_scenario(&evaluation->check[i]),
                          evaluation->check[i].why);
    }
}

void cz_checks_write_table(const CzEvaluation *evaluation, const CzEvaluation *before,
                           CzTerminal *terminal) {
    if (evaluation->n_check == 0) {
        cz_not_checked_print(evaluation, terminal);
        fputs("NO CHECKS. Add `checks:` to the problem file.\n", terminal->stream);
        return;
    }
    const bool several = cz_n_kept_run(evaluation) > 1;
    const bool with_before = before != NULL && before->n_check == evaluation->n_check;
    CzReportTable table;
    begin(&table, false, several, with_before);
    for (int i = 0; i < evaluation->n_check; i++) {
        const CzCheckResult *check = &evaluation->check[i];
        if (!check->has_no_run && (!several || cz_checks_is_shown(evaluation, i)))
            put_check(&table, check, with_before ? &before->check[i] : NULL, 0);
    }
    cz_table_write_text(&table, terminal);
    print_scenarios_without_run(evaluation, terminal);
    cz_not_checked_print(evaluation, terminal);
    write_count(evaluation, terminal);
}
