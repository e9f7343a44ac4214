/* The report of a search: variables, active constraints, verification, course of the search. */
#include "report/page.h"

#include "base/error.h"
#include "evaluate/evaluator.h"
#include "report/checks_table.h"
#include "report/charts.h"
#include "report/figure.h"
#include "report/options.h"
#include "report/outcome_table.h"
#include "report/overlay.h"
#include "report/plot.h"
#include "report/runs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MOST_PERCENT 100.0 /* larger margins and violations are drawn at this */

enum { MOST_CONSTRAINTS = 8 }; /* most constraints in the table of active ones */

static void write_banner(CzMarkup *markup, const CzEvaluator *evaluator, const CzProblem *problem,
                         const CzOutcome *outcome) {
    char before[CZ_FIGURE_ROOM], after[CZ_FIGURE_ROOM];
    const double start = outcome->start_evaluation.objective;
    const double best = outcome->best_evaluation.objective;
    const char *given = cz_evaluator_objective_unit(evaluator), *unit = given != NULL ? given : "";
    const CzVerdict verdict = outcome->best_evaluation.verdict;
    const bool is_passed = outcome->status == CZ_OUTCOME_FEASIBLE && verdict == CZ_VERDICT_PASS;
    cz_markup_write(markup, "<header><h1>%s</h1><p class='banner %s'>%s</p>",
                    cz_problem_title(problem),
                    outcome->status == CZ_OUTCOME_INFEASIBLE ? "fail"
                    : is_passed                              ? "pass"
                                                             : "careful",
                    cz_outcome_words(evaluator, outcome));
    cz_markup_write(markup, "<p>%ld evaluation%s: %s.</p>", outcome->n_evaluation,
                    outcome->n_evaluation == 1 ? "" : "s", outcome->why_stopped);
    if (cz_evaluator_maximises_margin(evaluator)) /* its negative is minimised */
        cz_markup_write(markup, "<p>Smallest margin of all constraints: before %s, after %s.</p>",
                        cz_figure_margin(before, -start), cz_figure_margin(after, -best));
    else
        cz_markup_write(markup, "<p>Objective %s: before %s%s%s, after %s%s%s.</p>",
                        cz_evaluator_objective_name(evaluator), cz_figure_plain(before, start),
                        unit[0] != '\0' ? " " : "", unit, cz_figure_plain(after, best),
                        unit[0] != '\0' ? " " : "", unit);
    cz_markup_write(markup, "<p>Verdict of the checks of the best design: %s.</p>",
                    cz_verdict_text(verdict));
    if (outcome->start_evaluation.beyond_validity || outcome->best_evaluation.beyond_validity)
        cz_markup_write(markup,
                        "<p class='fail'>The %s climbs: its numbers are beyond model validity "
                        "(" CZ_FIGURE_MARK_MEANS ").</p>",
                        outcome->best_evaluation.beyond_validity ? "best design"
                                                                 : "design before the search");
    cz_markup_write(markup, "</header>\n");
}

/* ---- variables ---- */

static void write_variables(CzMarkup *markup, const CzEvaluator *evaluator,
                            const CzOutcome *outcome) {
    CzReportTable table;
    cz_markup_write(markup, "<section id='variables'>\n<h2>Variables</h2>\n"
                            "<p>Between the bounds: ring: start, dot: best design.</p>");
    cz_outcome_begin_variables(&table, evaluator, outcome, true);
    cz_table_write_page(&table, markup);
    cz_markup_write(markup, "</section>\n");
}

/* ---- the search ---- */

/* Curves over the evaluations: each, and the best so far (NaN before the first feasible one). */
typedef struct Course {
    double *count, *objective, *best, *violation; /* (n) in one block that `count` owns */
    int n;
} Course;

static bool course_begin(Course *course, const CzEvaluator *evaluator, const CzOutcome *outcome) {
    const int n = (int)outcome->n_trial;
    const double sign = cz_evaluator_maximises_margin(evaluator) ? -100 : 1; /* margins in % */
    course->n = n;
    course->count = malloc(4 * ((size_t)n + 1) * sizeof *course->count);
    if (course->count == NULL)
        return false;
    course->objective = course->count + n;
    course->best = course->objective + n;
    course->violation = course->best + n;
    double best = NAN;
    for (int i = 0; i < n; i++) {
        const CzTrial *trial = &outcome->trial[i];
        const bool is_margin = sign < 0;
        const double plain = trial->objective * sign;
        const double value = is_margin && plain < -MOST_PERCENT ? -MOST_PERCENT : plain;
        course->count[i] = i + 1;
        course->objective[i] = value;
        if (trial->feasible && (isnan(best) || value * sign < best * sign))
            best = value;
        course->best[i] = best;
        const double percent = 100 * trial->violation;
        course->violation[i] = percent > MOST_PERCENT ? MOST_PERCENT : percent; /* NaN: a gap */
    }
    return true;
}

static CzStatus write_search(CzMarkup *markup, const CzEvaluator *evaluator,
                             const CzOutcome *outcome, CzError *error) {
    Course course;
    char label[CZ_PATH_ROOM + 24];
    if (outcome->n_trial < 2)
        return CZ_OK;
    if (!course_begin(&course, evaluator, outcome))
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the report");
    const char *unit = cz_evaluator_objective_unit(evaluator);
    if (cz_evaluator_maximises_margin(evaluator))
        snprintf(label, sizeof label, "smallest margin [%%]");
    else
        snprintf(label, sizeof label, "%s [%.20s]", cz_evaluator_objective_name(evaluator),
                 unit != NULL && unit[0] != '\0' ? unit : "-");
    const CzSeries objective[] = {{.name = "each evaluation",
                                   .n = course.n,
                                   .x = course.count,
                                   .y = course.objective,
                                   .colour = CZ_PLOT_QUIET},
                                  {.name = "best feasible so far",
                                   .n = course.n,
                                   .x = course.count,
                                   .y = course.best,
                                   .colour = 2}};
    const CzSeries violation = {.name = "worst violation of each evaluation",
                                .n = course.n,
                                .x = course.count,
                                .y = course.violation,
                                .colour = 1};
    const CzPlot plots[] = {
        {.title = cz_evaluator_maximises_margin(evaluator)
                      ? "Objective over the evaluations (margins below -100 % drawn at -100 %)"
                      : "Objective over the evaluations",
         .x_label = "evaluation",
         .y_label = label,
         .n_series = 2,
         .series = objective},
        {.title = "Violation over the evaluations, 0 is feasible (above 100 % drawn at 100 %)",
         .x_label = "evaluation",
         .y_label = "violation [%]",
         .n_series = 1,
         .series = &violation,
         .from_zero = true}};
    cz_markup_write(markup, "<section id='search'>\n<h2>The search</h2>\n<div class='figures'>");
    cz_plot_write_figure(&plots[0], markup);
    cz_plot_write_figure(&plots[1], markup);
    cz_markup_write(markup, "</div></section>\n");
    free(course.count);
    return CZ_OK;
}

/* ---- active constraints ---- */

static void write_active(CzMarkup *markup, const CzEvaluator *evaluator, const CzOutcome *outcome) {
    const CzEvaluation *best = &outcome->best_evaluation;
    CzReportTable table;
    cz_markup_write(markup,
                    "<section id='active'>\n<h2>Active constraints of the best design</h2>\n"
                    "<p>The most critical constraints; a negative margin is violated.</p>");
    cz_table_begin(&table, "constraint;" CZ_CONSTRAINT_HEADS);
    int told[MOST_CONSTRAINTS];
    for (int n = 0; n < MOST_CONSTRAINTS; n++) {
        told[n] = cz_page_next_constraint(best, n, told);
        if (told[n] < 0)
            break;
        const bool is_flag =
            best->constraint_check != NULL && best->constraint_check[told[n]].is_flag;
        cz_outcome_put_constraint(&table, evaluator, best, told[n],
                                  is_flag ? NAN : -best->constraint[told[n]]);
    }
    cz_table_write_page(&table, markup);
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

static void write_verification(CzMarkup *markup, const CzVerification *verification) {
    char limit[CZ_FIGURE_ROOM];
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
    cz_markup_write(markup, "</section>\n");
}

/* ---- the page ---- */

static CzStatus write_page(CzPage *page, const CzReport *report, CzError *error) {
    const CzEvaluator *evaluator = report->evaluator;
    const CzOutcome *outcome = report->outcome;
    CzMarkup *markup = &page->markup;
    char title[CZ_SENTENCE_ROOM];
    snprintf(title, sizeof title, "%s, optimised", cz_problem_title(page->problem));
    cz_page_write_head(markup, title);
    write_banner(markup, evaluator, page->problem, outcome);
    cz_page_write_contents(page, true);
    cz_markup_write(markup, "<section id='checks'>\n<h2>Checks before and after</h2>\n");
    cz_page_write_checks(markup, &outcome->best_evaluation, &outcome->start_evaluation);
    cz_markup_write(markup, "</section>\n");
    write_variables(markup, evaluator, outcome);
    write_active(markup, evaluator, outcome);
    cz_page_write_sensitivities(markup, evaluator, outcome);
    write_verification(markup, outcome->verification);
    CZ_TRY(write_search(markup, evaluator, outcome, error));
    CZ_TRY(cz_page_write_designs(markup, evaluator, outcome, error));
    CZ_TRY(write_values(markup, report, error));
    cz_markup_write(
        markup,
        "<h2>The best design</h2><p>The figures below are those of scenario %s of the best "
        "design%s</p>",
        page->summary->scenario,
        page->n_other > 0 ? "; force over closure and energy also show the design before." : ".");
    cz_page_write_parts(page);
    cz_page_write_foot(markup);
    return CZ_OK;
}

CzStatus cz_page_write_outcome(const CzReport *report, FILE *stream, CzError *error) {
    const CzOutcome *outcome = report->outcome;
    const CzEvaluation *evaluation = &outcome->best_evaluation;
    const CzEvaluation *start = &outcome->start_evaluation;
    const int scenario = cz_page_deciding(evaluation);
    const bool has_start =
        start->run != NULL && scenario < start->n_run && start->run[scenario] != NULL;
    const CzPageOther before = {"before", has_start ? start->run[scenario] : NULL};
    CzPage page = {.problem = report->problem,
                   .evaluation = evaluation,
                   .options = cz_report_options_of(report),
                   .scenario = scenario,
                   .label = has_start ? "after, with unloading" : NULL,
                   .n_other = has_start,
                   .other = &before};
    CzStatus status = cz_page_begin(&page, error);
    if (status == CZ_OK)
        status = cz_page_collect_parts(&page, error);
    if (status == CZ_OK)
        status = write_page(&page, report, error);
    if (status == CZ_OK)
        status = cz_page_finish(&page, stream, error);
    cz_page_free(&page);
    return status;
}
