/* The report of a search: variables, active constraints, verification, course of the search. */
#include "report/page.h"

#include "base/error.h"
#include "evaluate/deciding_run.h"
#include "evaluate/evaluator.h"
#include "report/checks_table.h"
#include "report/charts.h"
#include "report/figure.h"
#include "report/options.h"
#include "report/outcome_table.h"
#include "report/overlay.h"
#include "report/page_deciding.h"
#include "report/plot.h"
#include "report/robust_table.h"
#include "report/runs.h"
#include "report/verdict_words.h"
#include "report/worth_table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MAX_PERCENT 100.0 /* larger margins and violations are drawn at this */

enum { MAX_CONSTRAINTS = 8 }; /* most constraints in the table of active ones */

static void write_banner(CzMarkup *markup, const CzReport *report) {
    const CzEvaluator *evaluator = report->evaluator;
    const CzOutcome *outcome = report->outcome;
    char before[CZ_FIGURE_SIZE], after[CZ_FIGURE_SIZE];
    const double start = outcome->start_evaluation.objective;
    const double best = outcome->best_evaluation.objective;
    const char *given = cz_evaluator_objective_unit(evaluator), *unit = given != NULL ? given : "";
    const CzVerdict verdict = outcome->best_evaluation.verdict;
    char remark[CZ_SCREENING_SIZE];
    const bool is_feasible = outcome->status == CZ_OUTCOME_FEASIBLE;
    const bool is_passed = is_feasible && verdict == CZ_VERDICT_PASS;
    const bool adds_verdict = is_feasible && !is_passed && !cz_evaluator_is_fit(evaluator);
    cz_markup_write(markup, "<header><h1>%s</h1><p class='banner %s'>%s%s%s</p>",
                    cz_problem_title(report->problem),
                    outcome->status == CZ_OUTCOME_INFEASIBLE ||
                            outcome->status == CZ_OUTCOME_UNVERIFIED
                        ? "fail"
                    : is_passed ? "pass"
                                : "careful",
                    cz_outcome_words(evaluator, outcome), adds_verdict ? ", " : "",
                    adds_verdict ? cz_verdict_title(verdict) : "");
    cz_markup_write(markup, "<p>%ld evaluation%s: %s.</p>", outcome->n_evaluation,
                    outcome->n_evaluation == 1 ? "" : "s", outcome->why_stopped);
    char use[CZ_SENTENCE_SIZE];
    cz_scenario_use_sentence(outcome, sizeof use, use);
    if (use[0] != '\0')
        cz_markup_write(markup, "<p>%s</p>", use);
    if (cz_evaluator_maximises_margin(evaluator)) /* its negative is minimised */
        cz_markup_write(markup, "<p>Smallest margin of all constraints: before %s, after %s.</p>",
                        cz_figure_margin(before, -start), cz_figure_margin(after, -best));
    else
        cz_markup_write(markup, "<p>Objective %s: before %s%s%s, after %s%s%s.</p>",
                        cz_evaluator_objective_name(evaluator), cz_figure_plain(before, start),
                        unit[0] != '\0' ? " " : "", unit, cz_figure_plain(after, best),
                        unit[0] != '\0' ? " " : "", unit);
    cz_markup_write(markup, "<p>Verdict of the checks of the best design: %s%s.</p>",
                    cz_verdict_text(verdict),
                    cz_screening_remark(verdict, outcome->best_evaluation.n_not_covered, remark));
    if (outcome->start_evaluation.beyond_validity || outcome->best_evaluation.beyond_validity)
        cz_markup_write(markup,
                        "<p class='fail'>The %s climbs: its numbers are beyond model validity "
                        "(" CZ_FIGURE_MARK_MEANS ").</p>",
                        outcome->best_evaluation.beyond_validity ? "best design"
                                                                 : "design before the search");
    cz_page_write_document(markup, report->problem);
    cz_markup_write(markup, "</header>\n");
}

/* ---- variables ---- */

static void write_variables(CzMarkup *markup, const CzReport *report) {
    CzReportTable table;
    cz_markup_write(markup, "<section id='variables'>\n<h2>Variables</h2>\n"
                            "<p>Between the bounds: ring: start, dot: best design.</p>");
    cz_outcome_begin_variables(&table, report, true);
    cz_table_write_page(&table, markup);
    cz_markup_write(markup, "</section>\n");
}

/* ---- the search ---- */

/* Curves over the evaluations, in one block of four times n_trial: their number, the objective of
 * each, the best so far (NaN before the first feasible one), the violation. NULL without memory. */
static double *make_course(const CzReport *report) {
    const long n = report->outcome->n_trial;
    const bool is_margin = cz_evaluator_maximises_margin(report->evaluator);
    const double sign = is_margin ? -100 : 1; /* margins in % */
    double *course = malloc(4 * (size_t)n * sizeof *course), best = NAN;
    for (long i = 0; course != NULL && i < n; i++) {
        const CzTrial *trial = &report->outcome->trial[i];
        const double plain = trial->objective * sign, percent = 100 * trial->violation;
        const double value = is_margin && plain < -MAX_PERCENT ? -MAX_PERCENT : plain;
        if (trial->feasible && (isnan(best) || value * sign < best * sign))
            best = value;
        course[i] = (double)i + 1;
        course[n + i] = value;
        course[2 * n + i] = best;
        course[3 * n + i] = percent > MAX_PERCENT ? MAX_PERCENT : percent; /* NaN: a gap */
    }
    return course;
}

static CzStatus write_search(CzMarkup *markup, const CzReport *report, CzError *error) {
    const int n = (int)report->outcome->n_trial;
    const bool is_margin = cz_evaluator_maximises_margin(report->evaluator);
    const char *unit = cz_evaluator_objective_unit(report->evaluator);
    char label[CZ_PATH_SIZE + 24] = "smallest margin [%]";
    if (n < 2)
        return CZ_OK;
    double *x = make_course(report);
    if (x == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the report");
    if (!is_margin)
        snprintf(label, sizeof label, "%s [%.20s]", cz_evaluator_objective_name(report->evaluator),
                 unit != NULL && unit[0] != '\0' ? unit : "-");
    const CzSeries series[] = {
        {.name = "each evaluation", .n = n, .x = x, .y = x + n, .colour = CZ_PLOT_QUIET},
        {.name = "best feasible so far", .n = n, .x = x, .y = x + 2 * n, .colour = 2},
        {.name = "worst violation of each evaluation",
         .n = n,
         .x = x,
         .y = x + 3 * n,
         .colour = 1}};
    const CzPlot plots[] = {
        {.title = is_margin
                      ? "Objective over the evaluations (margins below -100 % drawn at -100 %)"
                      : "Objective over the evaluations",
         .x_label = "evaluation",
         .y_label = label,
         .n_series = 2,
         .series = series},
        {.title = "Violation over the evaluations, 0 is feasible (above 100 % drawn at 100 %)",
         .x_label = "evaluation",
         .y_label = "violation [%]",
         .n_series = 1,
         .series = &series[2],
         .from_zero = true}};
    cz_markup_write(markup, "<section id='search'>\n<h2>The search</h2>\n<div class='figures'>");
    cz_plot_write_figure(&plots[0], markup);
    cz_plot_write_figure(&plots[1], markup);
    cz_markup_write(markup, "</div></section>\n");
    free(x);
    return CZ_OK;
}

/* ---- active constraints ---- */

/* The worth of limits, or those that conflict, and the smallest relaxation of one. */
static void write_worth(CzMarkup *markup, const CzReport *report) {
    char text[CZ_SENTENCE_SIZE];
    CzReportTable table;
    if (cz_worth_is_known(report->outcome)) {
        cz_worth_sentence(report, sizeof text, text);
        cz_markup_write(markup, "<p>%s</p>\n", text);
        if (report->outcome->n_multiplier > 0) {
            cz_worth_begin_table(&table, report);
            cz_table_write_page(&table, markup);
        }
    }
    if (cz_margins_are_capped(report->outcome)) {
        cz_margins_begin_table(&table, report);
        cz_table_write_page(&table, markup);
    }
    cz_relaxation_sentence(report, sizeof text, text);
    if (text[0] != '\0')
        cz_markup_write(markup, "<p>%s</p>\n", text);
}

static void write_active(CzMarkup *markup, const CzReport *report) {
    const CzEvaluation *best = &report->outcome->best_evaluation;
    CzReportTable table;
    cz_markup_write(markup,
                    "<section id='active'>\n<h2>Active constraints of the best design</h2>\n"
                    "<p>The most critical constraints; a negative margin is violated.</p>");
    cz_table_begin(&table, "constraint;" CZ_CONSTRAINT_HEADS);
    table.class_name = "cards";
    int listed[MAX_CONSTRAINTS];
    for (int n = 0; n < MAX_CONSTRAINTS; n++) {
        listed[n] = cz_page_next_constraint(best, n, listed);
        if (listed[n] < 0)
            break;
        const bool is_flag =
            best->constraint_check != NULL && best->constraint_check[listed[n]].is_flag;
        cz_outcome_put_constraint(&table, report->evaluator, best, listed[n],
                                  is_flag ? NAN : -best->constraint[listed[n]]);
    }
    cz_table_write_page(&table, markup);
    write_worth(markup, report);
    cz_markup_write(markup, "</section>\n");
}

static CzStatus write_values(CzMarkup *markup, const CzReport *report, CzError *error) {
    CzMemoryText memory = {0};
    FILE *stream = cz_memory_text_open(&memory);
    bool fits = stream != NULL && cz_overlay_write_values(report, false, stream, NULL) == CZ_OK;
    if (stream != NULL)
        fits &= fclose(stream) == 0 && !memory.failed && memory.text != NULL;
    if (fits)
        cz_markup_write(markup,
                        "<section id='values'>\n<h2>New values, to paste</h2>\n"
                        "<pre>%s</pre></section>\n",
                        memory.text);
    cz_memory_text_free(&memory);
    return fits ? CZ_OK : cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the best values");
}

/* ---- verification ---- */

static void write_verification(CzMarkup *markup, const CzReport *report) {
    const CzOutcome *outcome = report->outcome;
    const CzVerification *verification = outcome->verification;
    char limit[CZ_FIGURE_SIZE], text[CZ_SENTENCE_SIZE];
    cz_markup_write(markup, "<section id='verification'>\n"
                            "<h2>Verification of the best design</h2>\n");
    if (verification == NULL) {
        cz_markup_write(markup, "<p>Not done: the best design violates a constraint, or "
                                "verification was switched off.</p></section>\n");
        return;
    }
    const bool passes = verification->verdict == CZ_VERDICT_PASS;
    cz_markup_write(markup,
                    "<p class='%s'>%s: no result may change by more than %s, and no verdict may "
                    "change.%s%s</p>",
                    passes ? "pass" : "fail", passes ? "Passed" : "NOT passed",
                    cz_figure_percent(limit, verification->limit),
                    verification->failure[0] != '\0' ? " " : "", verification->failure);
    CzReportTable table;
    cz_verified_begin_methods(&table, verification, true);
    cz_table_write_page(&table, markup);
    for (int i = 0; i < outcome->n_rejected; i++) {
        cz_rejected_sentence(report, &outcome->rejected[i], sizeof text, text);
        cz_markup_write(markup, "<p>%s.</p>", text);
    }
    cz_markup_write(markup, "</section>\n");
}

/* ---- the page ---- */

static CzStatus write_page(CzPage *page, const CzReport *report, CzError *error) {
    const CzOutcome *outcome = report->outcome;
    CzMarkup *markup = &page->markup;
    char title[CZ_SENTENCE_SIZE];
    snprintf(title, sizeof title, "%s, optimised", cz_problem_title(page->problem));
    cz_page_write_head(markup, title);
    write_banner(markup, report);
    cz_page_write_contents(page, true);
    cz_page_write_matrix(page);
    cz_markup_write(markup, "<section id='checks'>\n<h2>Checks before and after</h2>\n");
    cz_page_write_checks(markup, &outcome->best_evaluation, &outcome->start_evaluation);
    cz_markup_write(markup, "</section>\n");
    write_variables(markup, report);
    if (report->robust != NULL)
        cz_robust_write_page(report->robust, markup);
    write_active(markup, report);
    cz_page_write_sensitivities(markup, report);
    write_verification(markup, report);
    CZ_TRY(write_search(markup, report, error));
    CZ_TRY(cz_page_write_designs(markup, report, error));
    CZ_TRY(write_values(markup, report, error));
    cz_markup_write(
        markup,
        "<h2>The best design</h2><p>The figures below are those of scenario %s of the best "
        "design%s</p>",
        page->summary->scenario,
        page->n_other > 0 ? "; force over closure and energy also show the design before." : ".");
    cz_page_write_deciding(page);
    cz_page_write_parts(page);
    cz_page_write_foot(markup);
    return CZ_OK;
}

CzStatus cz_page_write_outcome(const CzReport *report, FILE *stream, CzError *error) {
    const CzOutcome *outcome = report->outcome;
    const CzEvaluation *evaluation = &outcome->best_evaluation;
    const CzEvaluation *start = &outcome->start_evaluation;
    const int scenario = cz_deciding_run(evaluation);
    const bool has_start =
        start->run != NULL && scenario < start->n_run && start->run[scenario] != NULL;
    const CzPageOther before = {"before", has_start ? start->run[scenario] : NULL};
    CzPage page = {.problem = report->problem,
                   .evaluation = evaluation,
                   .options = cz_report_options_of(report),
                   .scenario = scenario,
                   .is_top = true,
                   .label = has_start ? "after, with unloading" : NULL,
                   .n_other = has_start,
                   .other = &before};
    CzStatus status = cz_page_begin(&page, error);
    if (status == CZ_OK)
        status = cz_page_collect_parts(&page, error);
    if (status == CZ_OK)
        status = cz_page_collect_deciding(&page, error);
    if (status == CZ_OK)
        status = write_page(&page, report, error);
    if (status == CZ_OK)
        status = cz_page_finish(&page, stream, error);
    cz_page_free_deciding(&page);
    cz_page_free(&page);
    return status;
}
