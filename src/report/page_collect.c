/* The contents of a page, collected from results before it is written. */
#include "report/page.h"

#include "base/error.h"
#include "problem/problem.h"
#include "report/chart_curves.h"
#include "report/runs.h"
#include "report/units.h"
#include "simulate/input_curve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { INPUT_POINTS = 600 };
#define INPUT_SIZE 1.5 /* input curves end at this share of the largest force of the run */

/* The problem's scenario of that name; the runs of an evaluation may be fewer. */
static int scenario_named(const CzProblem *problem, const char *name) {
    for (int i = 0; i < cz_problem_n_scenario(problem); i++)
        if (strcmp(cz_problem_scenario_name(problem, i), name) == 0)
            return i;
    return 0;
}

static double largest(const double *value, int n) {
    double most = 0;
    for (int i = 0; i < n; i++)
        most = value[i] > most ? value[i] : most;
    return most;
}

/* The input curve of an interface up to the largest closure of the run. */
static CzStatus collect_input(const CzPage *page, int interface, CzInputCurve *input,
                              CzError *error) {
    const double *closure = cz_page_values(page, CZ_DRAWN_INTERFACE_CLOSURE, interface);
    const double *force = cz_page_values(page, CZ_DRAWN_INTERFACE_FORCE, interface);
    const double longest = closure != NULL ? largest(closure, page->n_sample) : 0;
    if (!(longest > 0) || force == NULL)
        return CZ_OK;
    double *x = malloc(2 * INPUT_POINTS * sizeof *x);
    *input = (CzInputCurve){.points = x};
    if (x == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the report");
    double *y = x + INPUT_POINTS;
    CZ_TRY(cz_input_curve(page->model, interface, longest / CZ_MILLI_PER_UNIT, INPUT_POINTS, x, y,
                          error));
    const double highest = INPUT_SIZE * largest(force, page->n_sample);
    for (int i = 0; i < INPUT_POINTS; i++) {
        x[i] *= CZ_MILLI_PER_UNIT;
        y[i] = y[i] / CZ_KILO < highest ? y[i] / CZ_KILO : NAN;
    }
    input->n = INPUT_POINTS;
    return CZ_OK;
}

static CzStatus collect_inputs(CzPage *page, CzError *error) {
    page->input = calloc((size_t)page->summary->n_interface + 1, sizeof *page->input);
    if (page->input == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the report");
    for (int i = 0; i < page->summary->n_interface; i++)
        CZ_TRY(collect_input(page, i, &page->input[i], error));
    return CZ_OK;
}

static CzStatus collect_model(CzPage *page, CzError *error) {
    int n_vehicle;
    page->vehicles = cz_problem_vehicles(page->problem, &n_vehicle);
    CZ_TRY(cz_model_build(page->problem, scenario_named(page->problem, page->summary->scenario),
                          &page->model, error));
    page->layout = calloc((size_t)page->model->n_car, sizeof *page->layout);
    if (page->layout == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the report");
    page->flange_height = INFINITY;
    for (int car = 0; car < page->model->n_car; car++)
        if (page->model->car[car].model == CZ_MODEL_FULL)
            page->flange_height =
                fmin(page->flange_height,
                     page->vehicles[page->model->car[car].vehicle].bogie.flange_height);
    return cz_model_layout(page->model, page->layout, error);
}

CzStatus cz_page_begin(CzPage *page, CzError *error) {
    page->run = page->evaluation->run[page->scenario];
    page->summary = cz_kept_run(page->evaluation, page->scenario);
    page->markup.stream = cz_memory_text_open(&page->text);
    if (page->markup.stream == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the report");
    page->time = cz_run_channel(page->run, CZ_CHANNEL_TIME, 0);
    page->n_sample = page->time != NULL ? cz_run_n_sample(page->run) : 0;
    CZ_TRY(cz_drawn_make(page->run, &page->made, error));
    CZ_TRY(collect_model(page, error));
    return collect_inputs(page, error);
}

CzStatus cz_page_collect_parts(CzPage *page, CzError *error) {
    page->fitted = calloc(CZ_MAX_CHART_CURVES, sizeof *page->fitted);
    if (page->fitted == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the report");
    page->measured = page->fitted;
    CZ_TRY(cz_chart_curves_of_fit(page->problem, page->summary, &page->n_measured, page->fitted,
                                  error));
    return cz_inputs_text_begin(&page->inputs, page->problem, error);
}

CzStatus cz_page_finish(CzPage *page, FILE *stream, CzError *error) {
    if (page->markup.failed || fflush(page->markup.stream) != 0 || page->text.failed ||
        page->text.text == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the report");
    fwrite(page->text.text, 1, page->text.n, stream);
    return CZ_OK;
}

void cz_page_free(CzPage *page) {
    for (int i = 0; page->input != NULL && i < page->summary->n_interface; i++)
        free(page->input[i].points);
    free(page->input);
    if (page->fitted != NULL)
        cz_chart_curves_free(page->n_measured, page->fitted);
    free(page->fitted);
    cz_inputs_text_free(&page->inputs);
    cz_drawn_free(&page->made);
    if (page->markup.stream != NULL)
        fclose(page->markup.stream);
    cz_memory_text_free(&page->text);
    free(page->layout);
    cz_model_free(page->model);
    *page = (CzPage){0};
}
