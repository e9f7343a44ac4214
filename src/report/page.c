/* The report of a run: its sections in their order. */
#include "report/page.h"

#include "report/options.h"

void cz_page_write_parts(CzPage *page) {
    cz_page_write_trains(page);
    cz_page_write_figures(page);
    cz_page_write_budget(page);
    cz_page_write_animation(page);
    cz_page_write_events(page);
    cz_page_write_inputs(page);
    cz_page_write_data(page);
}

static void write_run(CzPage *page) {
    char title[CZ_SENTENCE_SIZE];
    snprintf(title, sizeof title, "%s, %s", cz_problem_title(page->problem),
             page->summary->scenario);
    cz_page_write_head(&page->markup, title);
    cz_page_write_verdict(page);
    cz_page_write_deciding(page);
    cz_page_write_parts(page);
    cz_page_write_foot(&page->markup);
}

CzStatus cz_page_write_run(const CzReport *report, int scenario, bool is_top, FILE *stream,
                           CzError *error) {
    CzPage page = {.problem = report->problem,
                   .evaluation = report->evaluation,
                   .options = cz_report_options_of(report),
                   .scenario = scenario,
                   .is_top = is_top};
    CzStatus status = cz_page_begin(&page, error);
    if (status == CZ_OK)
        status = cz_page_collect_parts(&page, error);
    if (status == CZ_OK)
        status = cz_page_collect_deciding(&page, error);
    if (status == CZ_OK) {
        write_run(&page);
        status = cz_page_finish(&page, stream, error);
    }
    cz_page_free_deciding(&page);
    cz_page_free(&page);
    return status;
}
