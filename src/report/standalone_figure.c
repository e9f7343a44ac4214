/* A single page or figure, for callers of the library and for publications. */
#include "crushzone/report.h"

#include "base/error.h"
#include "base/suggest.h"
#include "evaluate/deciding_run.h"
#include "report/charts.h"
#include "report/elevation.h"
#include "report/figure.h"
#include "report/chart_curves.h"
#include "report/plot.h"
#include "report/runs.h"
#include "report/units.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

const char *cz_report_chart_name(int index) {
    return index >= 0 && index < CZ_N_CHART ? cz_charts[index].name : NULL;
}

/* Finds the scenario to draw; fails when its run was not kept. */
static CzStatus find_scenario(const CzEvaluation *evaluation, int requested, int *scenario,
                              CzError *error) {
    *scenario = requested >= 0 ? requested : cz_deciding_run(evaluation);
    const bool has_run = *scenario >= 0 && *scenario < evaluation->n_run &&
                         cz_kept_run(evaluation, *scenario) != NULL;
    return has_run ? CZ_OK : cz_fail(error, CZ_STATUS_INPUT, "no run was kept to draw");
}

CzStatus cz_report_write_page(const CzReport *report, FILE *stream, CzError *error) {
    const bool is_search = report->kind == CZ_REPORT_SEARCH;
    int scenario;
    if (report->kind == CZ_REPORT_COMPARISON)
        return cz_page_write_comparison(report, stream, error);
    CZ_TRY(find_scenario(is_search ? &report->outcome->best_evaluation : report->evaluation, -1,
                         &scenario, error));
    return is_search ? cz_page_write_outcome(report, stream, error)
                     : cz_page_write_run(report, scenario, true, stream, error);
}

static CzStatus find_chart(const char *what, CzChart *chart, CzError *error) {
    CzSuggestion nearest = {0};
    const int found = CZ_FIND_NAMED(what, CzChartInfo, cz_charts, CZ_N_CHART, &nearest);
    *chart = (CzChart)found;
    if (found >= 0)
        return CZ_OK;
    cz_fail(error, CZ_STATUS_INPUT,
            "there is no figure '%.100s'" CZ_HELP "'crushzone help figures' lists them", what);
    cz_suggest_help(&nearest, error);
    return CZ_STATUS_INPUT;
}

static const char *place_name(const CzPage *page, bool of_interface, int index) {
    return of_interface ? page->summary->interface[index].name : page->summary->vehicle[index].name;
}

/* Finds the interface or car of a figure. */
static CzStatus find_place(const CzPage *page, CzChart chart, const char *at, int *index,
                           CzError *error) {
    const bool of_several = chart == CZ_CHART_PANELS || chart == CZ_CHART_FRAMES;
    const bool of_interface =
        chart == CZ_CHART_FORCE_CLOSURE || chart == CZ_CHART_SHORTENING || of_several;
    const int n =
        of_several && page->n_sample > 1 ? page->summary->n_interface : cz_chart_count(page, chart);
    if (n == 0)
        return cz_fail(error, CZ_STATUS_INPUT, "this run has no data for the figure '%s'",
                       cz_charts[chart].name);
    *index = 0;
    if (!of_interface && chart != CZ_CHART_CAR_ACCELERATION)
        return CZ_OK;
    if (at == NULL) {
        *index = of_interface ? page->model->colliding : cz_chart_hardest_car(page->summary);
        return CZ_OK;
    }
    for (*index = 0; *index < n; ++*index)
        if (strcmp(place_name(page, of_interface, *index), at) == 0)
            return CZ_OK;
    const CzStatus status = cz_fail(error, CZ_STATUS_INPUT, "there is no %s '%.100s'",
                                    of_interface ? "interface" : "car", at);
    if (error != NULL)
        snprintf(error->help, sizeof error->help, "they are '%.60s' to '%.60s'",
                 place_name(page, of_interface, 0), place_name(page, of_interface, n - 1));
    return status;
}

CzChartOptions cz_chart_options_default(void) {
    return (CzChartOptions){.what = "fd", .csv_decimal = 0};
}

CzStatus cz_report_write_chart(const CzReportRun *run, const CzChartOptions *chosen, FILE *stream,
                               CzError *error) {
    CzChart chart;
    CzChartCurve measured[CZ_MAX_CHART_CURVES];
    int scenario, index = 0, n_measured;
    CZ_TRY(find_chart(chosen->what, &chart, error));
    CZ_TRY(find_scenario(run->evaluation, run->scenario, &scenario, error));
    CzStatus status = cz_chart_curves_read(chosen, chart, &n_measured, measured, error);
    CzPage page = {.problem = run->problem,
                   .evaluation = run->evaluation,
                   .scenario = scenario,
                   .n_measured = n_measured,
                   .measured = measured};
    if (status == CZ_OK)
        status = cz_page_begin(&page, error);
    if (status == CZ_OK)
        status = find_place(&page, chart, chosen->at, &index, error);
    if (status == CZ_OK) {
        cz_svg_begin_document(&page.markup);
        cz_chart_write(&page, chart, index, &page.markup);
        status = cz_page_finish(&page, stream, error);
    }
    cz_page_free(&page);
    cz_chart_curves_free(n_measured, measured);
    return status;
}

CzStatus cz_report_write_elevation(const CzProblem *problem, int scenario, FILE *stream,
                                   CzError *error) {
    CzMarkup markup = {.stream = stream};
    CzModel *model = NULL;
    CzLayout *layout = NULL;
    CzStatus status = cz_model_build(problem, scenario, &model, error);
    if (status == CZ_OK) {
        layout = calloc((size_t)model->n_car, sizeof *layout);
        status = layout != NULL ? cz_model_layout(model, layout, error)
                                : cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for a figure");
    }
    if (status == CZ_OK) {
        cz_svg_begin_document(&markup);
        cz_elevation_write(model, layout, &markup);
    }
    free(layout);
    cz_model_free(model);
    return status;
}

/* ---- of a fit ---- */

/* Strokes in mm and forces in kN, in one block; NULL without memory. */
static double *scaled(const CzFitLoading *loading) {
    const int n = loading->n;
    double *values = malloc(2 * (size_t)n * sizeof *values);
    for (int i = 0; values != NULL && i < n; i++) {
        values[i] = loading->stroke[i] * CZ_MILLI_PER_UNIT;
        values[n + i] = loading->force[i] / CZ_KILO;
    }
    return values;
}

static const char *verdict_text(CzFitVerdict verdict) {
    return verdict == CZ_FIT_GOOD ? "" : verdict == CZ_FIT_DOUBTFUL ? "doubtful: " : "REFUSED: ";
}

CzStatus cz_report_write_fit_figure(const CzFit *fit, FILE *stream, CzError *error) {
    const CzFitSummary *summary = cz_fit_summary(fit);
    const int n[] = {summary->curve.n, summary->law.n};
    char title[200], number[CZ_FIGURE_SIZE];
    double *values[] = {scaled(&summary->curve), scaled(&summary->law)};
    const bool has_memory = values[0] != NULL && values[1] != NULL;
    CzMarkup markup = {.stream = stream, .failed = !has_memory};
    if (has_memory) {
        const CzSeries series[] = {
            {.name = "measured", .n = n[0], .x = values[0], .y = values[0] + n[0], .colour = 0},
            {.name = "law",
             .n = n[1],
             .x = values[1],
             .y = values[1] + n[1],
             .colour = 1,
             .dash = 1}};
        snprintf(title, sizeof title, "%s%s as %s, root mean square %s %% of the mean force",
                 verdict_text(summary->verdict), summary->name, cz_fit_kind_word(summary->kind),
                 cz_figure_plain(number, 100.0 * summary->mean_square / summary->mean_force));
        const CzPlot plot = {.title = title,
                             .x_label = "stroke mm",
                             .y_label = "force kN",
                             .n_series = 2,
                             .series = series,
                             .from_zero = true,
                             .height = 260};
        cz_svg_begin_document(&markup);
        cz_plot_write(&plot, &markup);
    }
    free(values[0]);
    free(values[1]);
    return markup.failed ? cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for a figure") : CZ_OK;
}
