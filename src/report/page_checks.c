/* Verdict and checks, at the top of the page. */
#include "report/page.h"

#include "report/checks_table.h"
#include "report/figure.h"
#include "report/runs.h"
#include "report/units.h"
#include "report/verdict_words.h"

#include <math.h>
#include <string.h>

enum { MAX_LINKS = 12 }; /* to other reports that are shown without a click */

void cz_page_write_checks(CzMarkup *markup, const CzEvaluation *evaluation,
                          const CzEvaluation *before) {
    if (before != NULL && before->n_check != evaluation->n_check)
        before = NULL;
    if (evaluation->n_check == 0) {
        cz_markup_write(markup, "<p>No check was made.</p>");
        cz_not_checked_write(evaluation, markup);
        return;
    }
    int n_more = 0;
    for (int i = 0; i < evaluation->n_check; i++)
        n_more += !evaluation->check[i].has_no_run && !cz_checks_is_shown(evaluation, i);
    cz_checks_write_rows(markup, evaluation, before, false);
    cz_not_checked_write(evaluation, markup);
    if (n_more == 0)
        return;
    cz_markup_write(
        markup,
        "<details><summary>%d more checks, each with a better margin than the one of its name "
        "above</summary>",
        n_more);
    cz_checks_write_rows(markup, evaluation, before, true);
    cz_markup_write(markup, "</details>\n");
}

/* Links to the reports of the other scenarios, in their folders. */
static void write_others(CzPage *page) {
    const char *between = "";
    for (int i = 0; i < page->evaluation->n_run; i++) {
        const CzRunSummary *run = cz_kept_run(page->evaluation, i);
        char address[CZ_ADDRESS_SIZE];
        if (run == NULL || i == page->scenario)
            continue;
        cz_page_address(page, run->scenario, address);
        cz_markup_write(&page->markup, "%s<a href='%s'>%s</a>", between, address, run->scenario);
        between = ", ";
    }
}

/* The scenario of the figures, and links to the reports of the others; many links are folded. */
static void write_scenarios(CzPage *page) {
    CzMarkup *markup = &page->markup;
    const int n_other = cz_n_kept_run(page->evaluation) - 1;
    if (n_other < 1)
        return;
    cz_markup_write(markup,
                    "<p>The checks are those of all scenarios, the figures those of "
                    "<strong>%s</strong>%s.",
                    page->summary->scenario, page->is_top ? ", which has the smallest margin" : "");
    if (!page->is_top)
        cz_markup_write(markup, " <a href='../report.html'>Report of all scenarios</a>.");
    if (n_other <= MAX_LINKS) {
        cz_markup_write(markup, " Reports of the others: ");
        write_others(page);
        cz_markup_write(markup, ".");
    }
    cz_markup_write(markup, "</p>\n");
    if (n_other <= MAX_LINKS)
        return;
    cz_markup_write(markup, "<details><summary>Reports of the other %d</summary>", n_other);
    write_others(page);
    cz_markup_write(markup, "</details>\n");
}

/* Failure, override and accuracy of the run. */
static void write_caution(CzPage *page) {
    const CzRunSummary *run = page->summary;
    char number[CZ_FIGURE_SIZE], step[CZ_FIGURE_SIZE], balance[CZ_FIGURE_SIZE];
    CzMarkup *markup = &page->markup;
    if (run->status != CZ_OK)
        cz_markup_write(markup, "<p class='fail'>This run failed: %s</p>", run->failure);
    else if (run->ended == CZ_ENDED_INCOMPLETE)
        cz_markup_write(markup,
                        "<p class='fail'>This run is incomplete: the end criterion was not met "
                        "within simulation.longest_s, so it has no result: %s.</p>",
                        run->awaited);
    if (run->beyond_validity)
        cz_markup_write(markup,
                        "<p class='fail'>Override at %s ms: later results, shaded in the figures, "
                        "are beyond the model (" CZ_FIGURE_MARK_MEANS ").</p>",
                        cz_figure_fixed(number, 0, run->beyond_validity_time * CZ_MILLI_PER_UNIT));
    cz_markup_write(markup,
                    "<p>%s s simulated, %s, time step %s ms. Energy is balanced to %s of the "
                    "initial energy%s.</p>",
                    cz_figure_digits(number, 4, run->simulated), cz_ended_text(run->ended),
                    cz_figure_digits(step, 4, run->time_step * CZ_MILLI_PER_UNIT),
                    cz_figure_percent(balance, run->energy.balance_error),
                    cz_run_is_unbalanced(run) ? ", WHICH IS POOR: reduce the time step" : "");
    if (cz_run_misses_laws(run))
        cz_markup_write(markup,
                        "<p>The largest force error of a series chain is %s of the largest force "
                        "of the interface, WHICH IS POOR: reduce the time step.</p>",
                        cz_figure_percent(balance, run->law_error));
    cz_markup_write(markup, "\n");
}

/* "22 checks: 3 fail, 19 pass." */
static void write_count(CzMarkup *markup, const CzEvaluation *evaluation) {
    static const struct {
        CzVerdict verdict;
        const char *word;
    } order[] = {{CZ_VERDICT_FAIL, "fail"},
                 {CZ_VERDICT_NOT_CHECKED, "not checked"},
                 {CZ_VERDICT_PROVISIONAL, "provisional"},
                 {CZ_VERDICT_PASS, "pass"}};
    int n[4] = {0};
    for (int i = 0; i < evaluation->n_check; i++)
        n[evaluation->check[i].verdict]++;
    const char *between = ": ";
    cz_markup_write(markup, "<p>%d check%s", evaluation->n_check,
                    evaluation->n_check == 1 ? "" : "s");
    for (int i = 0; i < 4; i++) {
        if (n[order[i].verdict] == 0)
            continue;
        cz_markup_write(markup, "%s%d %s", between, n[order[i].verdict], order[i].word);
        between = ", ";
    }
    cz_markup_write(markup, ".</p>");
}

void cz_page_write_verdict(CzPage *page) {
    CzMarkup *markup = &page->markup;
    const CzEvaluation *evaluation = page->evaluation;
    char remark[CZ_SCREENING_SIZE];
    cz_markup_write(markup, "<header><h1>%s</h1><p class='banner %s'>%s%s</p>",
                    cz_problem_title(page->problem), cz_verdict_class(evaluation->verdict),
                    cz_verdict_title(evaluation->verdict),
                    cz_screening_remark(evaluation->verdict, evaluation->n_not_covered, remark));
    write_count(markup, evaluation);
    cz_page_write_document(markup, page->problem);
    cz_markup_write(markup, "</header>\n");
    cz_page_write_contents(page, false);
    cz_page_write_matrix(page);
    cz_markup_write(markup, "<section id='checks'>\n<h2>Checks</h2>\n");
    write_scenarios(page);
    write_caution(page);
    cz_page_write_checks(markup, evaluation, NULL);
    cz_markup_write(markup, "</section>\n");
}
