/* Which figures show what decides each criterion: its scenario, its figure, its place. */
#include "report/page_deciding.h"

#include "base/error.h"
#include "base/suggest.h"
#include "evaluate/metric.h"
#include "report/matrix.h"
#include "report/runs.h"

#include <stdlib.h>
#include <string.h>

/* ---- the figure of a metric ---- */

static const struct {
    const char *metric;
    CzChart chart;
} figures[] = {
#define CZ_FIGURE_OF(metric, chart) {metric, CZ_CHART_##chart},
#include "report/deciding_figures.def"
};

static const CzMetricKind *kind_of(const CzCheckResult *check) {
    CzSuggestion nearest = {0};
    const int found = check->metric != NULL
                          ? CZ_FIND_NAMED(check->metric, CzMetricKind, cz_metric_kind(0),
                                          cz_n_metric_kind(), &nearest)
                          : -1;
    return found >= 0 ? cz_metric_kind(found) : NULL;
}

static CzChart chart_of(const CzMetricKind *kind) {
    for (size_t i = 0; i < sizeof figures / sizeof *figures; i++)
        if (strcmp(figures[i].metric, kind->name) == 0)
            return figures[i].chart;
    return kind->level == CZ_LEVEL_RUN          ? CZ_CHART_ENERGY
           : strcmp(kind->unit->text, "g") == 0 ? CZ_CHART_CAR_ACCELERATION
                                                : CZ_CHART_FORCE_CLOSURE;
}

/* ---- the place ---- */

/* The interface of a place, ahead of a vehicle. */
static int interface_of(const CzRunSummary *run, const char *where) {
    const CzWhere found = cz_where_find(run, where);
    return found.interface[found.interface[1] >= 0];
}

/* Finds the figure of a check on the page of its scenario; false where there is none. */
static bool find_figure(const CzPage *page, const CzCheckResult *check, CzDecidingFigure *figure) {
    const CzMetricKind *kind = kind_of(check);
    if (kind == NULL || cz_level_is_of_design(kind->level))
        return false;
    *figure = (CzDecidingFigure){.page = page, .chart = chart_of(kind)};
    const CzChartCount count = cz_charts[figure->chart].count;
    if (count == CZ_CHART_PER_INTERFACE)
        figure->index = interface_of(page->summary, check->where);
    else if (count == CZ_CHART_PER_CAR)
        figure->index = cz_where_vehicle(page->summary, check->where);
    return figure->index >= 0 && figure->index < cz_chart_count(page, figure->chart);
}

/* ---- collecting ---- */

/* The page of a scenario, begun when it is needed first. */
static CzStatus page_of(CzPage *page, int scenario, const CzPage **found, CzError *error) {
    CzDeciding *deciding = page->deciding;
    *found = page;
    if (scenario == page->scenario)
        return CZ_OK;
    for (int i = 0; i < deciding->n_page; i++)
        if (deciding->page[i].scenario == scenario) {
            *found = &deciding->page[i];
            return CZ_OK;
        }
    CzPage *beside = &deciding->page[deciding->n_page++];
    *beside = (CzPage){.problem = page->problem,
                       .evaluation = page->evaluation,
                       .options = page->options,
                       .scenario = scenario,
                       .is_beside = true};
    *found = beside;
    return cz_page_begin(beside, error);
}

static int add_figure(CzDeciding *deciding, const CzDecidingFigure *figure) {
    for (int i = 0; i < deciding->n_figure; i++) {
        const CzDecidingFigure *other = &deciding->figure[i];
        if (other->page == figure->page && other->chart == figure->chart &&
            other->index == figure->index)
            return i;
    }
    deciding->figure[deciding->n_figure] = *figure;
    return deciding->n_figure++;
}

static CzStatus allocate(CzPage *page, CzError *error) {
    const size_t n_row = (size_t)page->matrix->n_row;
    CzDeciding *deciding = page->deciding = calloc(1, sizeof *deciding);
    if (deciding == NULL)
        return cz_no_memory(error, "the report");
    deciding->page = calloc((size_t)page->evaluation->n_run + 1, sizeof *deciding->page);
    deciding->figure = calloc(n_row + 1, sizeof *deciding->figure);
    deciding->of_row = calloc(n_row + 1, sizeof *deciding->of_row);
    return deciding->page == NULL || deciding->figure == NULL || deciding->of_row == NULL
               ? cz_no_memory(error, "the report")
               : CZ_OK;
}

CzStatus cz_page_collect_deciding(CzPage *page, CzError *error) {
    CzMatrix *matrix = page->matrix = calloc(1, sizeof *matrix);
    if (matrix == NULL || !cz_matrix_build(matrix, page->evaluation))
        return cz_no_memory(error, "the report");
    if (!page->is_top || cz_matrix_n_scenario(matrix) < 2)
        return CZ_OK;
    CZ_TRY(allocate(page, error));
    for (int row = 0; row < matrix->n_row; row++) {
        const int column = cz_matrix_deciding(matrix, row);
        const CzCheckResult *check = column >= 0 ? cz_matrix_check(matrix, row, column) : NULL;
        const int run = check != NULL ? cz_find_kept_run(page->evaluation, check->scenario) : -1;
        const CzPage *of = NULL;
        CzDecidingFigure figure;
        page->deciding->of_row[row] = -1;
        if (run < 0)
            continue;
        CZ_TRY(page_of(page, run, &of, error));
        if (find_figure(of, check, &figure))
            page->deciding->of_row[row] = add_figure(page->deciding, &figure);
    }
    return CZ_OK;
}

void cz_page_free_deciding(CzPage *page) {
    CzDeciding *deciding = page->deciding;
    if (page->matrix != NULL)
        cz_matrix_free(page->matrix);
    free(page->matrix);
    page->matrix = NULL;
    for (int i = 0; deciding != NULL && i < deciding->n_page; i++)
        cz_page_free(&deciding->page[i]);
    if (deciding != NULL) {
        free(deciding->page);
        free(deciding->figure);
        free(deciding->of_row);
    }
    free(deciding);
    page->deciding = NULL;
}
