/* Verdict and checks, at the top of the page. */
#include "report/page.h"

#include "report/checks_table.h"
#include "report/figure.h"
#include "report/runs.h"
#include "report/units.h"

#include <math.h>
#include <string.h>

enum { MOST_LINKS = 12 }; /* to other reports that are shown without a click */

static const char *const verdict_title[] = {[CZ_VERDICT_PASS] = "PASS",
                                            [CZ_VERDICT_PROVISIONAL] = "PROVISIONAL PASS",
                                            [CZ_VERDICT_FAIL] = "FAIL",
                                            [CZ_VERDICT_NOT_CHECKED] = "NOT CHECKED"};

/* Trains without limits, and requirements of the profile that are not checked. */
static void write_not_covered(CzMarkup *markup, const CzEvaluation *evaluation) {
    for (int i = 0; i < evaluation->n_not_judged; i++) {
        cz_markup_say(markup, "p", "Not judged: %s, %s.", evaluation->not_judged[i].train,
                      evaluation->not_judged[i].why);
        cz_markup_line(markup);
    }
    if (evaluation->n_not_covered == 0)
        return;
    cz_markup_open(markup, "p");
    cz_markup_text(markup, "Not covered by this program, to be shown by other means: ");
    for (int i = 0; i < evaluation->n_not_covered; i++) {
        cz_markup_text(markup, i > 0 ? "; " : "");
        cz_markup_text(markup, evaluation->not_covered[i]);
    }
    cz_markup_text(markup, ".");
    cz_markup_end(markup);
}

void cz_page_write_checks(CzMarkup *markup, const CzEvaluation *evaluation,
                          const CzEvaluation *before) {
    if (before != NULL && before->n_check != evaluation->n_check)
        before = NULL;
    if (evaluation->n_check == 0) {
        cz_markup_element(markup, "p", "No checks: no check was made.");
        write_not_covered(markup, evaluation);
        return;
    }
    int n_more = 0;
    for (int i = 0; i < evaluation->n_check; i++)
        n_more += !cz_checks_is_shown(evaluation, i);
    cz_checks_write_rows(markup, evaluation, before, false);
    write_not_covered(markup, evaluation);
    if (n_more == 0)
        return;
    cz_markup_open(markup, "details");
    cz_markup_say(markup, "summary",
                  "%d more checks, each %swith a better margin than the one of its name above",
                  n_more,
                  cz_checks_n_omitted(evaluation) > 0 ? "of a scenario that was not run, or " : "");
    cz_checks_write_rows(markup, evaluation, before, true);
    cz_markup_end(markup);
}

void cz_page_folder_name(const char *scenario, char name[CZ_NAME_ROOM]) {
    snprintf(name, CZ_NAME_ROOM, "%s", scenario);
    for (char *c = name; *c != '\0'; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f || strchr("/\\:*?\"<>|", *c) != NULL)
            *c = '_';
    if (name[0] == '.')
        name[0] = '_';
}

/* A relative address; characters other than letters, digits and -._~ as %XX. */
static void write_address(CzMarkup *markup, const char *folder) {
    char text[512];
    size_t used = 0;
    for (const char *c = folder; *c != '\0' && used + 4 < sizeof text; c++) {
        const unsigned char byte = (unsigned char)*c;
        const bool plain = (byte >= '0' && byte <= '9') || (byte >= 'a' && byte <= 'z') ||
                           (byte >= 'A' && byte <= 'Z') || strchr("-._~", byte) != NULL;
        used += (size_t)snprintf(text + used, sizeof text - used, plain ? "%c" : "%%%02X", byte);
    }
    cz_markup_format(markup, "href", "%s/report.html", text);
}

/* Links to the reports of the other scenarios, in their folders. */
static void write_others(CzPage *page) {
    CzMarkup *markup = &page->markup;
    const char *between = "";
    for (int i = 0; i < page->evaluation->n_run; i++) {
        const CzRunSummary *run = cz_kept_run(page->evaluation, i);
        char folder[CZ_NAME_ROOM];
        if (run == NULL || i == page->scenario)
            continue;
        cz_page_folder_name(run->scenario, folder);
        cz_markup_text(markup, between);
        cz_markup_open(markup, "a");
        write_address(markup, folder);
        cz_markup_text(markup, run->scenario);
        cz_markup_close(markup);
        between = ", ";
    }
}

/* The scenario of the figures, and links to the reports of the others; many links are folded. */
static void write_scenarios(CzPage *page, bool is_top) {
    CzMarkup *markup = &page->markup;
    if (cz_n_kept_run(page->evaluation) < 2)
        return;
    cz_markup_open(markup, "p");
    cz_markup_text(markup, "The checks are those of all scenarios, the figures those of ");
    cz_markup_element(markup, "strong", page->summary->scenario);
    const int n_other = cz_n_kept_run(page->evaluation) - 1;
    if (is_top)
        cz_markup_text(markup, ", which has the smallest margin");
    cz_markup_text(markup, ".");
    if (is_top && n_other <= MOST_LINKS) {
        cz_markup_text(markup, " Reports of the others: ");
        write_others(page);
        cz_markup_text(markup, ".");
    }
    cz_markup_end(markup);
    if (!is_top || n_other <= MOST_LINKS)
        return;
    cz_markup_open(markup, "details");
    cz_markup_say(markup, "summary", "Reports of the other %d", n_other);
    write_others(page);
    cz_markup_end(markup);
}

/* Failure, override and accuracy of the run. */
static void write_caution(CzPage *page) {
    const CzRunSummary *run = page->summary;
    char text[512], number[CZ_FIGURE_ROOM], balance[CZ_FIGURE_ROOM];
    CzMarkup *markup = &page->markup;
    if (run->status != CZ_OK) {
        snprintf(text, sizeof text, "This run failed: %s", run->failure);
        cz_markup_classed(markup, "p", "fail", text);
    } else if (run->ended == CZ_ENDED_INCOMPLETE) {
        snprintf(text, sizeof text,
                 "This run is incomplete: the end criterion was not met within "
                 "simulation.longest_s, so it gives no result: %s.",
                 run->awaited);
        cz_markup_classed(markup, "p", "fail", text);
    }
    if (run->beyond_validity) {
        snprintf(text, sizeof text,
                 "Override at %s ms: later results, shaded in the figures, are beyond the "
                 "model (" CZ_FIGURE_MARK_MEANS ").",
                 cz_figure_fixed(number, 0, run->beyond_validity_time * CZ_MILLI_PER_UNIT));
        cz_markup_classed(markup, "p", "fail", text);
    }
    cz_markup_say(
        markup, "p",
        "%s s simulated, %s, time step %s ms. Energy is balanced to %s of the initial "
        "energy%s.",
        cz_figure_digits(number, 4, run->simulated), cz_ended_text(run->ended),
        cz_figure_digits((char[CZ_FIGURE_ROOM]){0}, 4, run->time_step * CZ_MILLI_PER_UNIT),
        cz_figure_percent(balance, run->energy.balance_error),
        cz_run_is_unbalanced(run) ? ", WHICH IS POOR: reduce the time step" : "");
    if (cz_run_misses_laws(run))
        cz_markup_say(markup, "p",
                      "The largest force error of a series chain is %s of the largest force of "
                      "the interface, WHICH IS POOR: reduce the time step.",
                      cz_figure_percent(balance, run->law_error));
    cz_markup_line(markup);
}

/* "22 checks: 3 fail, 19 pass." */
static void write_count(int n_check, const int n[4], size_t room, char *text) {
    static const struct {
        CzVerdict verdict;
        const char *word;
    } order[] = {{CZ_VERDICT_FAIL, "fail"},
                 {CZ_VERDICT_NOT_CHECKED, "not checked"},
                 {CZ_VERDICT_PROVISIONAL, "provisional"},
                 {CZ_VERDICT_PASS, "pass"}};
    size_t used = (size_t)snprintf(text, room, "%d check%s", n_check, n_check == 1 ? "" : "s");
    const char *between = ": ";
    for (int i = 0; i < 4; i++) {
        if (n[order[i].verdict] == 0)
            continue;
        used += (size_t)snprintf(text + used, room - used, "%s%d %s", between, n[order[i].verdict],
                                 order[i].word);
        between = ", ";
    }
    snprintf(text + used, room - used, ".");
}

void cz_page_write_verdict(CzPage *page, bool is_top) {
    CzMarkup *markup = &page->markup;
    const CzEvaluation *evaluation = page->evaluation;
    int n[4] = {0};
    for (int i = 0; i < evaluation->n_check; i++)
        n[evaluation->check[i].verdict]++;
    cz_markup_open(markup, "header");
    cz_markup_element(markup, "h1", cz_problem_title(page->problem));
    cz_markup_classed(markup, "p",
                      evaluation->n_check == 0                 ? "banner careful"
                      : evaluation->verdict == CZ_VERDICT_FAIL ? "banner fail"
                      : evaluation->verdict == CZ_VERDICT_PASS ? "banner pass"
                                                               : "banner careful",
                      verdict_title[evaluation->verdict]);
    char text[256];
    write_count(evaluation->n_check, n, sizeof text, text);
    cz_markup_element(markup, "p", text);
    cz_markup_end(markup);
    cz_page_write_contents(page, false);
    cz_page_open_section(markup, "checks", "Checks");
    write_scenarios(page, is_top);
    write_caution(page);
    cz_page_write_checks(markup, evaluation, NULL);
    cz_markup_end(markup);
}
