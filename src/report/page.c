/* The report of a run: its skeleton, and what its parts are made of. */
#include "report/page.h"

#include "base/error.h"
#include "problem/problem.h"
#include "report/assets.h"
#include "report/chart_curves.h"
#include "report/runs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const double *cz_page_values(const CzPage *page, CzDrawn drawn, int place) {
    return cz_drawn_values(page->run, &page->made, drawn, place);
}

int cz_page_deciding(const CzEvaluation *evaluation) {
    const CzCheckResult *worst = NULL;
    int found = -1;
    for (int i = 0; i < evaluation->n_run; i++) {
        const CzRunSummary *run = cz_kept_run(evaluation, i);
        if (run == NULL)
            continue;
        if (run->status != CZ_OK)
            return i;
        found = found < 0 ? i : found;
        for (int k = 0; k < evaluation->n_check; k++) {
            const CzCheckResult *check = &evaluation->check[k];
            if (check->scenario != NULL && strcmp(check->scenario, run->scenario) == 0 &&
                !isnan(check->value) && (worst == NULL || cz_check_is_worse(check, worst))) {
                worst = check;
                found = i;
            }
        }
    }
    return found;
}

/* The problem's scenario of that name; the runs of an evaluation may be fewer. */
static int scenario_named(const CzProblem *problem, const char *name) {
    for (int i = 0; i < cz_problem_n_scenario(problem); i++)
        if (strcmp(cz_problem_scenario_name(problem, i), name) == 0)
            return i;
    return 0;
}

CzStatus cz_page_begin(CzPage *page, const CzProblem *problem, const CzEvaluation *evaluation,
                       int scenario, const CzReportOptions *options, FILE *stream, CzError *error) {
    *page = (CzPage){.stream = stream,
                     .problem = problem,
                     .evaluation = evaluation,
                     .options = options,
                     .scenario = scenario,
                     .run = evaluation->run[scenario],
                     .summary = cz_kept_run(evaluation, scenario)};
    page->markup.stream = cz_memory_text_open(&page->text);
    if (page->markup.stream == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the report");
    int n_vehicle;
    page->vehicles = cz_problem_vehicles(problem, &n_vehicle);
    page->n_sample = cz_run_n_sample(page->run);
    page->time = cz_page_values(page, CZ_DRAWN_TIME, 0);
    if (page->time == NULL)
        page->n_sample = 0;
    CZ_TRY(cz_drawn_make(page->run, &page->made, error));
    CZ_TRY(cz_model_build(problem, scenario_named(problem, page->summary->scenario), &page->model,
                          error));
    page->stand = calloc((size_t)page->model->n_car, sizeof *page->stand);
    if (page->stand == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the report");
    return cz_model_stand(page->model, page->stand, error);
}

void cz_page_free(CzPage *page) {
    cz_drawn_free(&page->made);
    if (page->markup.stream != NULL)
        fclose(page->markup.stream);
    cz_memory_text_free(&page->text);
    page->markup.stream = NULL;
    free(page->stand);
    cz_model_free(page->model);
    page->stand = NULL;
    page->model = NULL;
}

/* Nothing may be loaded or sent; the one script and the one style sheet are known by their bytes.
 */
static void write_policy(CzMarkup *markup) {
    cz_markup_open(markup, "meta");
    cz_markup_attribute(markup, "http-equiv", "Content-Security-Policy");
    cz_markup_format(markup, "content",
                     "default-src 'none'; script-src 'sha256-%s'; style-src 'sha256-%s'; img-src "
                     "data:; base-uri 'none'; form-action 'none'",
                     cz_report_js_sha256, cz_report_css_sha256);
    cz_markup_close(markup);
    cz_markup_line(markup);
}

void cz_page_write_head(CzMarkup *markup, const char *title) {
    fputs("<!DOCTYPE html>\n", markup->stream);
    cz_markup_open(markup, "html");
    cz_markup_attribute(markup, "lang", "en");
    cz_markup_line(markup);
    cz_markup_open(markup, "head");
    cz_markup_open(markup, "meta");
    cz_markup_attribute(markup, "charset", "utf-8");
    cz_markup_close(markup);
    cz_markup_line(markup);
    write_policy(markup);
    cz_markup_open(markup, "meta");
    cz_markup_attribute(markup, "name", "viewport");
    cz_markup_attribute(markup, "content", "width=device-width, initial-scale=1");
    cz_markup_close(markup);
    cz_markup_line(markup);
    cz_markup_element(markup, "title", title);
    cz_markup_line(markup);
    cz_markup_open(markup, "style");
    cz_markup_raw(markup, cz_report_css);
    cz_markup_close(markup);
    cz_markup_line(markup);
    cz_markup_close(markup);
    cz_markup_line(markup);
    cz_markup_open(markup, "body");
    cz_markup_line(markup);
}

void cz_page_write_foot(CzMarkup *markup) {
    cz_markup_open(markup, "script");
    cz_markup_raw(markup, cz_report_js);
    cz_markup_close(markup);
    cz_markup_line(markup);
    cz_markup_close(markup);
    cz_markup_close(markup);
    cz_markup_line(markup);
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
        int where; /* what has to be there */
    } parts[] = {{"checks", "checks", ALWAYS},
                 {"variables", "variables", OF_SEARCH},
                 {"active", "what holds it", OF_SEARCH},
                 {"verification", "computed again", OF_SEARCH},
                 {"values", "new values", OF_SEARCH},
                 {"trains", "trains", ALWAYS},
                 {"loops", "force over closure", OF_FIGURES},
                 {"energy", "energy", OF_FIGURES},
                 {"motion", "speed and acceleration", OF_FIGURES},
                 {"vertical", "wheels and pitch", OF_FIGURES | OF_FULL_CARS},
                 {"budget", "what turned the cars", OF_FULL_CARS | OF_BUDGET},
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
    cz_markup_close(markup);
    cz_markup_line(markup);
}

void cz_page_open_section(CzMarkup *markup, const char *id, const char *heading) {
    cz_markup_open(markup, "section");
    cz_markup_attribute(markup, "id", id);
    cz_markup_line(markup);
    cz_markup_element(markup, "h2", heading);
    cz_markup_line(markup);
}

void cz_page_close_section(CzMarkup *markup) {
    cz_markup_close(markup);
    cz_markup_line(markup);
}

/* The figures, with the histories of a fit over them. */
static CzStatus write_figures(CzPage *page, CzError *error) {
    CzChartCurve curve[CZ_MOST_CHART_CURVES];
    CzStatus status =
        cz_chart_curves_of_fit(page->problem, page->summary, &page->n_measured, curve, error);
    page->measured = curve;
    if (status == CZ_OK)
        status = cz_page_write_figures(page, error);
    cz_chart_curves_free(page->n_measured, curve);
    page->n_measured = 0;
    page->measured = NULL;
    return status;
}

CzStatus cz_page_write_parts(CzPage *page, CzError *error) {
    cz_page_write_trains(page);
    CZ_TRY(write_figures(page, error));
    cz_page_write_budget(page);
    cz_page_write_animation(page);
    cz_page_write_events(page);
    CZ_TRY(cz_page_write_inputs(page, error));
    cz_page_write_data(page);
    return CZ_OK;
}

CzStatus cz_page_finish(CzPage *page, CzError *error) {
    if (page->markup.failed || fflush(page->markup.stream) != 0 || page->text.failed ||
        page->text.text == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the report");
    fwrite(page->text.text, 1, page->text.n, page->stream);
    return CZ_OK;
}

CzStatus cz_page_write_run(const CzProblem *problem, const CzEvaluation *evaluation, int scenario,
                           bool is_top, const CzReportOptions *options, FILE *stream,
                           CzError *error) {
    CzPage page;
    CzStatus status = cz_page_begin(&page, problem, evaluation, scenario, options, stream, error);
    if (status == CZ_OK) {
        char title[CZ_SENTENCE_ROOM];
        snprintf(title, sizeof title, "%s, %s", cz_problem_title(problem), page.summary->scenario);
        cz_page_write_head(&page.markup, title);
        cz_page_write_verdict(&page, is_top);
        status = cz_page_write_parts(&page, error);
    }
    if (status == CZ_OK) {
        cz_page_write_foot(&page.markup);
        status = cz_page_finish(&page, error);
    }
    cz_page_free(&page);
    return status;
}
