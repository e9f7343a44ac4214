/* Why it climbed, on a terminal. */
#include "crushzone/report.h"

#include "report/checks_table.h"
#include "report/figure.h"
#include "report/table.h"
#include "report/units.h"

#include <math.h>
#include <string.h>

enum { MOST_SHOWN = 12 }; /* candidates on a terminal */

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

static void write_head(const CzExplanation *explanation, bool colour, FILE *stream) {
    const CzCheckResult *worst = &explanation->worst;
    char time[CZ_FIGURE_ROOM], margin[CZ_FIGURE_ROOM], value[64], limit[64];
    const bool broken = worst->margin < 0;
    cz_text_write(explanation->scenario, CZ_STYLE_PLAIN, colour, stream);
    fputs(": ", stream);
    if (explanation->climbed) {
        cz_text_write("OVERRIDE", CZ_STYLE_BAD, colour, stream);
        fprintf(stream, " at %s ms; later results are beyond the model.\n",
                cz_figure_fixed(time, 0, explanation->climb_time * CZ_MILLI_PER_UNIT));
    } else if (broken) {
        cz_text_write("close to override: a limit is violated", CZ_STYLE_BAD, colour, stream);
        fputs(".\n", stream);
    } else if (explanation->verdict == CZ_VERDICT_NOT_CHECKED) {
        cz_text_write("NOT CHECKED in full", CZ_STYLE_CAREFUL, colour, stream);
        fprintf(stream, ": %s.\n", worst->why != NULL ? worst->why : "a margin is unknown");
    } else {
        cz_text_write("no override", CZ_STYLE_GOOD, colour, stream);
        fputs(".\n", stream);
    }
    cz_checks_format_value(worst, sizeof value, value);
    cz_checks_format_limit(worst, sizeof limit, limit);
    fputs("Smallest margin: ", stream);
    cz_text_write(worst->name, CZ_STYLE_PLAIN, colour, stream);
    fprintf(stream, "%s%s, %s against %s, %s\n", worst->where[0] != '\0' ? " at " : "",
            worst->where, value, limit, cz_figure_margin(margin, worst->margin));
}

static bool write_indicators(const CzExplanation *explanation, bool colour, FILE *stream) {
    static const char *const heads[] = {"indicators", ">ms", ""};
    if (explanation->n_indicator == 0)
        return true;
    CzReportTable table;
    cz_table_begin(&table, sizeof heads / sizeof *heads, heads);
    for (int i = 0; i < explanation->n_indicator; i++) {
        const CzIndicator *indicator = &explanation->indicator[i];
        char time[CZ_FIGURE_ROOM];
        cz_table_put(&table, cz_cause_text(indicator->cause), CZ_STYLE_PLAIN);
        cz_table_put(&table,
                     isnan(indicator->time)
                         ? ""
                         : cz_figure_fixed(time, 0, indicator->time * CZ_MILLI_PER_UNIT),
                     CZ_STYLE_PLAIN);
        cz_table_put(&table, indicator->what, CZ_STYLE_PLAIN);
    }
    fputc('\n', stream);
    return cz_table_write_text(&table, colour, stream);
}

/* What turned the body of the car that is worst off. */
static bool write_budget(const CzExplanation *explanation, bool colour, FILE *stream) {
    static const char *const heads[] = {"source", ">moment kNms", ">lift kNs", ""};
    const CzRunSummary *run = cz_run_summary(explanation->run);
    if (run->budget == NULL)
        return true;
    const CzVehicleBudget *budget = &run->budget[explanation->vehicle];
    int order[CZ_N_BUDGET];
    const int n = cz_budget_order(budget, order);
    char text[CZ_FIGURE_ROOM];
    if (n == 0)
        return true;
    fprintf(stream, "\nPitch impulses on the body of %s until its largest %s at %s ms, nose-up:\n",
            run->vehicle[explanation->vehicle].name, budget->of_lift ? "wheel lift" : "pitch",
            cz_figure_fixed(text, 0, budget->time * CZ_MILLI_PER_UNIT));
    CzReportTable table;
    cz_table_begin(&table, sizeof heads / sizeof *heads, heads);
    for (int k = 0; k < n; k++) {
        const CzBudgetSource source = (CzBudgetSource)order[k];
        cz_table_put(&table, cz_budget_text(source), CZ_STYLE_PLAIN);
        cz_table_put(&table, cz_figure_fixed(text, 1, budget->moment[source] / CZ_KILO),
                     CZ_STYLE_PLAIN);
        cz_table_put(&table, cz_figure_fixed(text, 1, budget->lift[source] / CZ_KILO),
                     CZ_STYLE_PLAIN);
        cz_table_put(&table, cz_budget_counts(source) ? "" : "through the end", CZ_STYLE_PLAIN);
    }
    return cz_table_write_text(&table, colour, stream);
}

static void put_candidate(CzReportTable *table, const CzCandidateChange *candidate) {
    char number[CZ_FIGURE_ROOM], text[CZ_FIGURE_ROOM + 16];
    const char *unit = unit_of(candidate->key);
    cz_table_put(table, cz_cause_text(candidate->cause), CZ_STYLE_PLAIN);
    cz_table_put(table, candidate->name, CZ_STYLE_PLAIN);
    snprintf(text, sizeof text, "%s %s", cz_figure_digits(number, 4, candidate->value), unit);
    cz_table_put(table, text, CZ_STYLE_PLAIN);
    snprintf(text, sizeof text, "%s %s", cz_figure_digits(number, 4, candidate->needed), unit);
    cz_table_put(table, isnan(candidate->needed) ? "-" : text,
                 candidate->turns ? CZ_STYLE_GOOD : CZ_STYLE_PLAIN);
    cz_table_put(table, cz_figure_margin(number, candidate->change), CZ_STYLE_PLAIN);
    cz_table_put(table, cz_figure_margin(number, candidate->margin), CZ_STYLE_PLAIN);
}

/* Those that turn the verdict, or those that do not. */
static bool write_candidates(const CzExplanation *explanation, bool turning, bool colour,
                             FILE *stream) {
    const bool broken = explanation->worst.margin < 0;
    static const char *const titles[2][2] = {
        {"No single change of these values violates the limit; the worst of those tried:",
         "Smallest single change that violates the limit:"},
        {"No single change of these values satisfies the limit; the best of those tried:",
         "Smallest single change that satisfies the limit:"}};
    static const char *const heads[] = {"cause", "value", ">now", ">then", ">change", ">margin"};
    CzReportTable table;
    int n = 0;
    cz_table_begin(&table, sizeof heads / sizeof *heads, heads);
    for (int i = 0; i < explanation->n_candidate && n < MOST_SHOWN; i++)
        if (explanation->candidate[i].turns == turning &&
            !isnan(explanation->candidate[i].needed)) {
            put_candidate(&table, &explanation->candidate[i]);
            n++;
        }
    if (n == 0) {
        cz_table_free(&table);
        return true;
    }
    fprintf(stream, "\n%s\n", titles[broken][turning]);
    return cz_table_write_text(&table, colour, stream);
}

CzStatus cz_report_write_explanation_table(const CzExplanation *explanation, bool colour,
                                           FILE *stream) {
    bool is_whole = true;
    write_head(explanation, colour, stream);
    is_whole &= write_indicators(explanation, colour, stream);
    is_whole &= write_budget(explanation, colour, stream);
    is_whole &= write_candidates(explanation, true, colour, stream);
    is_whole &= write_candidates(explanation, false, colour, stream);
    if (explanation->has_cause)
        fprintf(stream, "\n%s: %s: %s.\n",
                explanation->worst.margin < 0 ? "First cause" : "First to fail",
                cz_cause_text(explanation->cause), cz_cause_doc(explanation->cause));
    return is_whole ? CZ_OK : CZ_STATUS_NO_MEMORY;
}
