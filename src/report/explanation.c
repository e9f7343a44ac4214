/* Why it climbed, on a terminal and as the document `crushzone.explanation`. */
#include "crushzone/report.h"

#include "report/checks_table.h"
#include "report/documents.h"
#include "report/figure.h"
#include "report/grid.h"
#include "report/units.h"

#include <math.h>
#include <string.h>

enum { MOST_SHOWN = 12 }; /* levers on a terminal */

/* ---- terminal -------------------------------------------------------------------------------- */

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
    cz_grid_write_text(explanation->scenario, CZ_STYLE_PLAIN, colour, stream);
    fputs(": ", stream);
    if (explanation->climbed) {
        cz_grid_write_text("IT CLIMBED", CZ_STYLE_BAD, colour, stream);
        fprintf(stream, " at %s ms; what comes after is beyond the model.\n",
                cz_figure_fixed(time, 0, explanation->climb_time * CZ_MILLI_PER_UNIT));
    } else if (broken) {
        cz_grid_write_text("it nearly climbed: a limit is broken", CZ_STYLE_BAD, colour, stream);
        fputs(".\n", stream);
    } else if (explanation->verdict == CZ_VERDICT_NOT_CHECKED) {
        cz_grid_write_text("NOT CHECKED in full", CZ_STYLE_CAREFUL, colour, stream);
        fprintf(stream, ": %s.\n", worst->why != NULL ? worst->why : "a margin is not known");
    } else {
        cz_grid_write_text("it holds", CZ_STYLE_GOOD, colour, stream);
        fputs(".\n", stream);
    }
    cz_checks_format_value(worst, sizeof value, value);
    cz_checks_format_limit(worst, sizeof limit, limit);
    fputs("Smallest margin: ", stream);
    cz_grid_write_text(worst->name, CZ_STYLE_PLAIN, colour, stream);
    fprintf(stream, "%s%s, %s against %s, %s\n", worst->where[0] != '\0' ? " at " : "",
            worst->where, value, limit, cz_figure_margin(margin, worst->margin));
}

static bool write_signs(const CzExplanation *explanation, bool colour, FILE *stream) {
    bool is_whole = true;
    if (explanation->n_sign == 0)
        return true;
    CzGrid grid;
    cz_grid_begin(&grid, "lrl");
    cz_grid_put(&grid, "signs", CZ_STYLE_PLAIN);
    cz_grid_put(&grid, "ms", CZ_STYLE_PLAIN);
    cz_grid_put(&grid, "", CZ_STYLE_PLAIN);
    for (int i = 0; i < explanation->n_sign; i++) {
        const CzSign *sign = &explanation->sign[i];
        char time[CZ_FIGURE_ROOM];
        cz_grid_put(&grid, cz_cause_text(sign->cause), CZ_STYLE_PLAIN);
        cz_grid_put(&grid,
                    isnan(sign->time) ? ""
                                      : cz_figure_fixed(time, 0, sign->time * CZ_MILLI_PER_UNIT),
                    CZ_STYLE_PLAIN);
        cz_grid_put(&grid, sign->what, CZ_STYLE_PLAIN);
    }
    fputc('\n', stream);
    is_whole &= cz_grid_write(&grid, colour, stream);
    return is_whole;
}

/* What turned the body of the car that is worst off. */
static bool write_budget(const CzExplanation *explanation, bool colour, FILE *stream) {
    bool is_whole = true;
    const CzRunSummary *run = cz_run_summary(explanation->run);
    if (run->budget == NULL)
        return true;
    const CzVehicleBudget *budget = &run->budget[explanation->vehicle];
    int order[CZ_N_BUDGET];
    const int n = cz_budget_order(budget, order);
    char text[CZ_FIGURE_ROOM];
    if (n == 0)
        return true;
    fprintf(stream, "\nWhat turned the body of %s until its largest %s at %s ms, nose-up:\n",
            run->vehicle[explanation->vehicle].name, budget->of_lift ? "wheel lift" : "pitch",
            cz_figure_fixed(text, 0, budget->time * CZ_MILLI_PER_UNIT));
    CzGrid grid;
    cz_grid_begin(&grid, "lrrl");
    cz_grid_put(&grid, "source", CZ_STYLE_PLAIN);
    cz_grid_put(&grid, "moment kNms", CZ_STYLE_PLAIN);
    cz_grid_put(&grid, "lift kNs", CZ_STYLE_PLAIN);
    cz_grid_put(&grid, "", CZ_STYLE_PLAIN);
    for (int k = 0; k < n; k++) {
        const CzBudgetSource source = (CzBudgetSource)order[k];
        cz_grid_put(&grid, cz_budget_text(source), CZ_STYLE_PLAIN);
        cz_grid_put(&grid, cz_figure_fixed(text, 1, budget->moment[source] / CZ_KILO),
                    CZ_STYLE_PLAIN);
        cz_grid_put(&grid, cz_figure_fixed(text, 1, budget->lift[source] / CZ_KILO),
                    CZ_STYLE_PLAIN);
        cz_grid_put(&grid, cz_budget_counts(source) ? "" : "through the end", CZ_STYLE_PLAIN);
    }
    is_whole &= cz_grid_write(&grid, colour, stream);
    return is_whole;
}

static void put_lever(CzGrid *grid, const CzLever *lever) {
    char number[CZ_FIGURE_ROOM], text[CZ_FIGURE_ROOM + 16];
    const char *unit = unit_of(lever->key);
    cz_grid_put(grid, cz_cause_text(lever->cause), CZ_STYLE_PLAIN);
    cz_grid_put(grid, lever->name, CZ_STYLE_PLAIN);
    snprintf(text, sizeof text, "%s %s", cz_figure_digits(number, 4, lever->value), unit);
    cz_grid_put(grid, text, CZ_STYLE_PLAIN);
    snprintf(text, sizeof text, "%s %s", cz_figure_digits(number, 4, lever->needed), unit);
    cz_grid_put(grid, isnan(lever->needed) ? "-" : text,
                lever->turns ? CZ_STYLE_GOOD : CZ_STYLE_PLAIN);
    cz_grid_put(grid, cz_figure_margin(number, lever->change), CZ_STYLE_PLAIN);
    cz_grid_put(grid, cz_figure_margin(number, lever->margin), CZ_STYLE_PLAIN);
}

/* Those that turn the verdict, or those that do not. */
static bool write_levers(const CzExplanation *explanation, bool turning, bool colour,
                         FILE *stream) {
    bool is_whole = true;
    const bool broken = explanation->worst.margin < 0;
    static const char *const titles[2][2] = {
        {"No change of one of these alone breaks the margin; the worst of those tried:",
         "The smallest change of one value alone that breaks the margin:"},
        {"No change of one of these alone restores the margin; the best of those tried:",
         "The smallest change of one value alone that restores the margin:"}};
    static const char *const names[] = {"cause", "value", "now", "then", "change", "margin"};
    CzGrid grid;
    int n = 0;
    cz_grid_begin(&grid, "llrrrr");
    for (int i = 0; i < 6; i++)
        cz_grid_put(&grid, names[i], CZ_STYLE_PLAIN);
    for (int i = 0; i < explanation->n_lever && n < MOST_SHOWN; i++)
        if (explanation->lever[i].turns == turning && !isnan(explanation->lever[i].needed)) {
            put_lever(&grid, &explanation->lever[i]);
            n++;
        }
    if (n > 0)
        fprintf(stream, "\n%s\n", titles[broken][turning]);
    else
        grid.n_cell = 0;
    is_whole &= cz_grid_write(&grid, colour, stream);
    return is_whole;
}

CzStatus cz_report_write_explanation_table(const CzExplanation *explanation, bool colour,
                                           FILE *stream) {
    bool is_whole = true;
    write_head(explanation, colour, stream);
    is_whole &= write_signs(explanation, colour, stream);
    is_whole &= write_budget(explanation, colour, stream);
    is_whole &= write_levers(explanation, true, colour, stream);
    is_whole &= write_levers(explanation, false, colour, stream);
    if (explanation->has_cause)
        fprintf(stream, "\n%s: %s: %s.\n",
                explanation->worst.margin < 0 ? "First cause" : "First to give way",
                cz_cause_text(explanation->cause), cz_cause_doc(explanation->cause));
    return is_whole ? CZ_OK : CZ_STATUS_NO_MEMORY;
}

/* ---- document -------------------------------------------------------------------------------- */

static void put_json_lever(CzJson *json, const CzLever *lever) {
    cz_json_open_object(json, NULL);
    cz_json_text(json, "cause", cz_cause_text(lever->cause));
    cz_json_text(json, "name", lever->name);
    cz_json_text(json, "key", lever->key);
    cz_json_exact(json, "value", lever->value);
    cz_json_flag(json, "turns", lever->turns);
    cz_json_real(json, "needed", lever->needed);
    cz_json_real(json, "change", lever->change);
    cz_json_real(json, "not_yet", lever->not_yet);
    cz_json_exact(json, "margin", lever->margin);
    cz_json_close(json);
}

static void put_worst(CzJson *json, const CzCheckResult *worst) {
    cz_json_open_object(json, "worst");
    cz_json_text(json, "name", worst->name);
    cz_json_text(json, "where", worst->where);
    cz_json_text(json, "kind", worst->is_minimum ? "min" : "max");
    cz_json_exact(json, "limit", worst->limit);
    cz_json_exact(json, "value", worst->value);
    cz_json_text(json, "unit", worst->unit);
    cz_json_exact(json, "margin", worst->margin);
    cz_json_text(json, "why", worst->why);
    cz_json_flag(json, "beyond_validity", worst->beyond_validity);
    cz_json_close(json);
}

CzStatus cz_report_write_explanation(const CzProblem *problem, const CzExplanation *explanation,
                                     const CzReportOptions *options, FILE *stream, CzError *error) {
    const CzReportOptions absent = cz_report_options_default();
    if (options == NULL)
        options = &absent;
    CzJson *json = cz_json_create();
    cz_document_head(json, "crushzone.explanation", problem);
    cz_document_run_info(json, explanation->wall_s, options->setup_s, options->n_job);
    cz_json_text(json, "scenario", explanation->scenario);
    cz_document_verdict(json, explanation->verdict);
    cz_json_flag(json, "climbed", explanation->climbed);
    cz_json_real(json, "climb_time_ms", cz_milliseconds(explanation->climb_time));
    put_worst(json, &explanation->worst);
    cz_json_text(json, "first_cause",
                 explanation->has_cause ? cz_cause_text(explanation->cause) : NULL);
    cz_json_open_list(json, "signs");
    for (int i = 0; i < explanation->n_sign; i++) {
        const CzSign *sign = &explanation->sign[i];
        cz_json_open_object(json, NULL);
        cz_json_text(json, "cause", cz_cause_text(sign->cause));
        cz_json_text(json, "what", sign->what);
        cz_json_real(json, "time_ms", cz_milliseconds(sign->time));
        cz_json_close(json);
    }
    cz_json_close(json);
    const CzRunSummary *run = cz_run_summary(explanation->run);
    if (run->budget != NULL) {
        const CzVehicleBudget *budget = &run->budget[explanation->vehicle];
        int order[CZ_N_BUDGET];
        const int n = cz_budget_order(budget, order);
        cz_json_open_object(json, "budget");
        cz_json_text(json, "vehicle", run->vehicle[explanation->vehicle].name);
        cz_document_budget(json, budget, n, order);
        cz_json_close(json);
    }
    cz_json_open_list(json, "levers");
    for (int i = 0; i < explanation->n_lever; i++)
        put_json_lever(json, &explanation->lever[i]);
    cz_json_close(json);
    cz_json_whole(json, "runs", explanation->n_run);
    return cz_json_finish(json, stream, error);
}
