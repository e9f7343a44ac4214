/* Explained checks and the cause of an override, on a terminal. */
#include "crushzone/report.h"

#include "report/checks_table.h"
#include "report/explained_checks.h"
#include "report/figure.h"
#include "report/tables.h"
#include "report/units.h"

#include <math.h>
#include <string.h>

enum { MAX_SHOWN = 12 }; /* candidates on a terminal */

static const char *unit_of(const char *key) {
    const char *const suffix[] = {"_mm", "_kN", "_mrad", "_kNm", "_kNm_rad", "_MNm_rad", "_MN_m"};
    const char *const unit[] = {"mm", "kN", "mrad", "kNm", "kNm/rad", "MNm/rad", "MN/m"};
    for (int i = (int)(sizeof suffix / sizeof *suffix) - 1; i >= 0; i--) {
        const size_t n = strlen(suffix[i]), length = strlen(key);
        if (length > n && strcmp(key + length - n, suffix[i]) == 0)
            return unit[i];
    }
    return "";
}

static void write_head(const CzExplanation *explanation, CzTerminal *terminal) {
    const CzCheckResult *worst = &explanation->worst;
    char number[CZ_FIGURE_SIZE], value[CZ_CHECK_SIZE], limit[CZ_CHECK_SIZE];
    cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s: ", explanation->scenario);
    if (explanation->climbed) {
        cz_terminal_print(terminal, CZ_STYLE_BAD, "OVERRIDE");
        cz_figure_fixed(number, 0, explanation->climb_time * CZ_MILLI_PER_UNIT);
        cz_terminal_print(terminal, CZ_STYLE_PLAIN, " at %s ms; later results are beyond the model",
                          number);
    } else if (worst->margin < 0) {
        cz_terminal_print(terminal, CZ_STYLE_BAD, "close to override: a limit is violated");
    } else if (explanation->verdict == CZ_VERDICT_NOT_CHECKED) {
        cz_terminal_print(terminal, CZ_STYLE_CAREFUL, "NOT CHECKED in full");
        cz_terminal_print(terminal, CZ_STYLE_PLAIN, ": %s",
                          worst->why != NULL ? worst->why : "a margin is unknown");
    } else {
        cz_terminal_print(terminal, CZ_STYLE_GOOD, "no override");
    }
    fputs(".\n", terminal->stream);
    cz_terminal_print(terminal, CZ_STYLE_PLAIN, "Smallest margin: %s%s%s, %s against %s, %s\n",
                      worst->name, worst->where[0] != '\0' ? " at " : "", worst->where,
                      cz_checks_value(value, worst), cz_checks_limit(limit, worst),
                      cz_figure_margin(number, worst->margin));
}

static void write_indicators(const CzExplanation *explanation, CzTerminal *terminal) {
    if (explanation->n_indicator == 0)
        return;
    CzReportTable table;
    cz_table_begin(&table, "indicators;>ms;");
    for (int i = 0; i < explanation->n_indicator; i++) {
        const CzIndicator *indicator = &explanation->indicator[i];
        char time[CZ_FIGURE_SIZE];
        cz_figure_fixed(time, 0, indicator->time * CZ_MILLI_PER_UNIT);
        cz_table_put(&table, cz_cause_text(indicator->cause));
        cz_table_put(&table, isnan(indicator->time) ? "" : time);
        cz_table_put(&table, indicator->what);
    }
    fputc('\n', terminal->stream);
    cz_table_write_text(&table, terminal);
}

/* Impulses that pitched the body of the car with the smallest margin. */
static void write_budget(const CzExplanation *explanation, CzTerminal *terminal) {
    const CzRunSummary *run = cz_run_summary(explanation->run);
    if (run->budget == NULL)
        return;
    const CzVehicleBudget *budget = &run->budget[explanation->vehicle];
    int order[CZ_N_BUDGET];
    const int n = cz_budget_order(budget, order);
    char text[CZ_FIGURE_SIZE];
    if (n == 0)
        return;
    fprintf(terminal->stream,
            "\nPitch impulses on the body of %s until its largest %s at %s ms, nose-up:\n",
            run->vehicle[explanation->vehicle].name, budget->of_lift ? "wheel lift" : "pitch",
            cz_figure_fixed(text, 0, budget->time * CZ_MILLI_PER_UNIT));
    CzReportTable table;
    cz_table_begin(&table, "source;>moment kNms;>lift kNs;");
    for (int k = 0; k < n; k++) {
        const CzBudgetSource source = (CzBudgetSource)order[k];
        cz_table_put(&table, cz_budget_text(source));
        cz_table_put(&table, cz_figure_fixed(text, 1, budget->moment[source] / CZ_KILO));
        cz_table_put(&table, cz_figure_fixed(text, 1, budget->lift[source] / CZ_KILO));
        cz_table_put(&table, cz_budget_counts(source) ? "" : "through the end");
    }
    cz_table_write_text(&table, terminal);
}

static void put_candidate(CzReportTable *table, const CzCandidateChange *candidate) {
    char number[CZ_FIGURE_SIZE], text[CZ_FIGURE_SIZE + 16];
    const char *unit = unit_of(candidate->key);
    cz_table_put(table, cz_cause_text(candidate->cause));
    cz_table_put(table, candidate->name);
    cz_table_put_format(table, "%s %s", cz_figure_digits(number, 4, candidate->value), unit);
    snprintf(text, sizeof text, "%s %s", cz_figure_digits(number, 4, candidate->needed), unit);
    cz_table_put_styled(table, isnan(candidate->needed) ? "-" : text,
                        candidate->turns ? CZ_STYLE_GOOD : CZ_STYLE_PLAIN);
    cz_table_put(table, cz_figure_margin(number, candidate->change));
    cz_table_put(table, cz_figure_margin(number, candidate->margin));
}

/* Writes the candidates that change the verdict, or those that do not. */
static void write_candidates(const CzExplanation *explanation, bool turning, CzTerminal *terminal) {
    const bool broken = explanation->worst.margin < 0;
    static const char *const titles[2][2] = {
        {"No single change of these values violates the limit; the worst of those tried:",
         "Smallest single change that violates the limit:"},
        {"No single change of these values satisfies the limit; the best of those tried:",
         "Smallest single change that satisfies the limit:"}};
    CzReportTable table;
    int n = 0;
    cz_table_begin(&table, "cause;value;>now;>then;>change;>margin");
    for (int i = 0; i < explanation->n_candidate && n < MAX_SHOWN; i++)
        if (explanation->candidate[i].turns == turning &&
            !isnan(explanation->candidate[i].needed)) {
            put_candidate(&table, &explanation->candidate[i]);
            n++;
        }
    if (n == 0) {
        cz_table_free(&table);
        return;
    }
    fprintf(terminal->stream, "\n%s\n", titles[broken][turning]);
    cz_table_write_text(&table, terminal);
}

void cz_explanation_write_table(const CzReport *report, CzTerminal *terminal) {
    const CzExplanation *explanation = report->explanation;
    cz_explained_checks_write(explanation, terminal);
    if (!explanation->has_climbing)
        return;
    fputs(explanation->n_check > 0 ? "\nOverride\n" : "", terminal->stream);
    write_head(explanation, terminal);
    write_indicators(explanation, terminal);
    write_budget(explanation, terminal);
    write_candidates(explanation, true, terminal);
    write_candidates(explanation, false, terminal);
    if (explanation->has_cause)
        fprintf(terminal->stream, "\n%s: %s: %s.\n",
                explanation->worst.margin < 0 ? "First cause" : "First to fail",
                cz_cause_text(explanation->cause), cz_cause_doc(explanation->cause));
}
