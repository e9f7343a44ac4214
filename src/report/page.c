/* The report of a run: head, contents, sections. */
#include "report/page.h"

#include "base/error.h"
#include "report/assets.h"

#include <math.h>

/* Nothing may be loaded or sent; script and style sheet are allowed by their hashes. */
static void write_policy(CzMarkup *markup) {
    cz_markup_open(markup, "meta");
    cz_markup_attribute(markup, "http-equiv", "Content-Security-Policy");
    cz_markup_format(markup, "content",
                     "default-src 'none'; script-src 'sha256-%s'; style-src 'sha256-%s'; img-src "
                     "data:; base-uri 'none'; form-action 'none'",
                     cz_report_js_sha256, cz_report_css_sha256);
    cz_markup_end(markup);
}

void cz_page_write_head(CzMarkup *markup, const char *title) {
    fputs("<!DOCTYPE html>\n", markup->stream);
    cz_markup_open(markup, "html");
    cz_markup_attribute(markup, "lang", "en");
    cz_markup_line(markup);
    cz_markup_open(markup, "head");
    cz_markup_open(markup, "meta");
    cz_markup_attribute(markup, "charset", "utf-8");
    cz_markup_end(markup);
    write_policy(markup);
    cz_markup_open(markup, "meta");
    cz_markup_attributes(markup, "name", "viewport", "content",
                         "width=device-width, initial-scale=1", NULL);
    cz_markup_end(markup);
    cz_markup_element(markup, "title", title);
    cz_markup_line(markup);
    cz_markup_open(markup, "style");
    cz_markup_raw(markup, cz_report_css);
    cz_markup_end(markup);
    cz_markup_end(markup);
    cz_markup_open(markup, "body");
    cz_markup_line(markup);
}

void cz_page_write_foot(CzMarkup *markup) {
    cz_markup_open(markup, "script");
    cz_markup_raw(markup, cz_report_js);
    cz_markup_end(markup);
    cz_markup_close(markup);
    cz_markup_end(markup);
}

static void write_link(CzMarkup *markup, const char *id, const char *name) {
    cz_markup_open(markup, "a");
    cz_markup_format(markup, "href", "#%s", id);
    cz_markup_text(markup, name);
    cz_markup_close(markup);
    cz_markup_text(markup, " ");
}

void cz_page_write_contents(CzPage *page, bool of_search) {
    enum { ALWAYS = 0, OF_FIGURES = 1, OF_FULL_CARS = 2, OF_BUDGET = 4, OF_SEARCH = 8 };
    static const struct {
        const char *id, *name;
        int where; /* which results it needs */
    } parts[] = {{"checks", "checks", ALWAYS},
                 {"variables", "variables", OF_SEARCH},
                 {"active", "active constraints", OF_SEARCH},
                 {"verification", "verification", OF_SEARCH},
                 {"values", "new values", OF_SEARCH},
                 {"trains", "trains", ALWAYS},
                 {"loops", "force over closure", OF_FIGURES},
                 {"energy", "energy", OF_FIGURES},
                 {"motion", "speed and acceleration", OF_FIGURES},
                 {"vertical", "wheels and pitch", OF_FIGURES | OF_FULL_CARS},
                 {"budget", "pitch: moments and impulses", OF_FULL_CARS | OF_BUDGET},
                 {"animation", "animation", OF_FIGURES},
                 {"events", "events", ALWAYS},
                 {"inputs", "inputs", ALWAYS}};
    int there = (page->n_sample > 1 ? OF_FIGURES : 0) | (of_search ? OF_SEARCH : 0) |
                (page->summary->budget != NULL ? OF_BUDGET : 0);
    for (int car = 0; car < page->model->n_car; car++)
        there |= page->model->car[car].model == CZ_MODEL_FULL ? OF_FULL_CARS : 0;
    CzMarkup *markup = &page->markup;
    cz_markup_open(markup, "nav");
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        if ((parts[i].where & ~there) == 0)
            write_link(markup, parts[i].id, parts[i].name);
    cz_markup_end(markup);
}

void cz_page_open_section(CzMarkup *markup, const char *id, const char *heading) {
    cz_markup_open(markup, "section");
    cz_markup_attribute(markup, "id", id);
    cz_markup_line(markup);
    cz_markup_element(markup, "h2", heading);
    cz_markup_line(markup);
}

void cz_page_write_parts(CzPage *page) {
    cz_page_write_trains(page);
    cz_page_write_figures(page);
    cz_page_write_budget(page);
    cz_page_write_animation(page);
    cz_page_write_events(page);
    cz_page_write_inputs(page);
    cz_page_write_data(page);
}

CzStatus cz_page_finish(CzPage *page, FILE *stream, CzError *error) {
    if (page->markup.failed || fflush(page->markup.stream) != 0 || page->text.failed ||
        page->text.text == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the report");
    fwrite(page->text.text, 1, page->text.n, stream);
    return CZ_OK;
}

static void write_run(CzPage *page, bool is_top) {
    char title[CZ_SENTENCE_ROOM];
    snprintf(title, sizeof title, "%s, %s", cz_problem_title(page->problem),
             page->summary->scenario);
    cz_page_write_head(&page->markup, title);
    cz_page_write_verdict(page, is_top);
    cz_page_write_parts(page);
    cz_page_write_foot(&page->markup);
}

CzStatus cz_page_write_run(const CzProblem *problem, const CzEvaluation *evaluation, int scenario,
                           bool is_top, const CzReportOptions *options, FILE *stream,
                           CzError *error) {
    CzPage page = {
        .problem = problem, .evaluation = evaluation, .options = options, .scenario = scenario};
    CzStatus status = cz_page_begin(&page, error);
    if (status == CZ_OK)
        status = cz_page_collect_parts(&page, error);
    if (status == CZ_OK) {
        write_run(&page, is_top);
        status = cz_page_finish(&page, stream, error);
    }
    cz_page_free(&page);
    return status;
}
