/* Measured curves over a figure: the columns of a file, and the figure of each. */
#include "report/chart_curves.h"

#include "base/error.h"
#include "problem/keys.h"
#include "problem/problem.h"
#include "report/units.h"
#include "text/curve_mme.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A file being read. */
typedef struct Reading {
    const CzChartOptions *options;
    CzChart chart;
    int n_title; /* 0 where titles are not needed */
    char **title;
    bool by_unit; /* find the columns by the units of the axes */
    int n;
    CzChartCurve *measured; /* (CZ_MAX_CHART_CURVES) */
    CzError *error;
} Reading;

/* Finds the panel by the beginning of the title, which is that of the names of its channels. */
static CzStatus find_panel(const Reading *reading, const char *title, CzChart *chart) {
    static const CzChart panels[] = {CZ_CHART_FORCE, CZ_CHART_VELOCITY, CZ_CHART_DISPLACEMENT,
                                     CZ_CHART_SHORTENING};
    for (size_t i = 0; i < sizeof panels / sizeof *panels; i++) {
        const char *pattern = cz_drawn_info(cz_charts[panels[i]].y)->pattern;
        *chart = panels[i];
        if (strncmp(title, pattern, strcspn(pattern, "{")) == 0)
            return CZ_OK;
    }
    const CzStatus status =
        cz_fail(reading->error, CZ_STATUS_INPUT, "%.200s: column '%.60s' belongs to no panel",
                reading->options->measured, title);
    if (reading->error != NULL)
        snprintf(reading->error->help, sizeof reading->error->help,
                 "titles begin as those of channels.csv: F_ force, v_ speed, x_ displacement, d_ "
                 "shortening; --column TITLE,TITLE takes only some of the columns");
    return status;
}

/* A title without the unit at its end, since the axis may have another: v_A4 of v_A4_km/h, or of
 * "v_A4 [km/h]". */
static void name_curve(char *name, size_t room, const char *title, const char *quantity) {
    snprintf(name, room, "%s", title);
    name[strcspn(name, "[(")] = '\0';
    for (size_t n = strlen(name); n > 0 && name[n - 1] == ' '; n--)
        name[n - 1] = '\0';
    CzDimension dimension = 0;
    while (dimension < CZ_N_DIMENSION && strcmp(cz_dimension_text[dimension], quantity) != 0)
        dimension++;
    for (char *at = strchr(name, '_'); at != NULL && dimension < CZ_N_DIMENSION;
         at = strchr(at + 1, '_')) {
        char unit[16];
        snprintf(unit, sizeof unit, "%.15s", at + 1);
        for (char *c = unit; *c != '\0'; c++)
            *c = *c == '/' ? '_' : *c;
        if (cz_unit_find(dimension, unit) == NULL)
            continue;
        *at = '\0';
        return;
    }
}

/* Reads one column, a title or a number, and converts it to the units of its figure. */
static CzStatus read_column(Reading *reading, const char *column, const char *title) {
    const CzChartOptions *options = reading->options;
    CzChart chart = reading->chart;
    if (reading->n == CZ_MAX_CHART_CURVES)
        return cz_fail(reading->error, CZ_STATUS_INPUT,
                       "%.200s: more than %d measured curves are too many for a figure",
                       options->measured, (int)CZ_MAX_CHART_CURVES);
    if (chart == CZ_CHART_PANELS)
        CZ_TRY(find_panel(reading, title, &chart));
    CzChartAxes axes = {0};
    (void)cz_chart_axes(chart, &axes); /* the figure has axes */
    const CzCurveColumns columns = {.x_quantity = axes.x_quantity,
                                    .y_quantity = axes.y_quantity,
                                    .x = reading->by_unit ? NULL : "1",
                                    .y = reading->by_unit ? NULL : column,
                                    .separator = options->csv_separator,
                                    .decimal = options->csv_decimal};
    CzChartCurve *measured = &reading->measured[reading->n];
    CZ_TRY(cz_curve_read(options->measured, &columns, &measured->curve, reading->error));
    measured->chart = chart;
    name_curve(measured->label, sizeof measured->label, title, axes.y_quantity);
    for (int i = 0; i < measured->curve->n; i++) {
        measured->curve->x[i] /= axes.x_unit;
        measured->curve->y[i] /= axes.y_unit;
    }
    reading->n++;
    return CZ_OK;
}

/* Reads the column of a number or a title. */
static CzStatus read_named(Reading *reading, const char *name) {
    char *end;
    const long number = strtol(name, &end, 10);
    const char *title = NULL;
    if (reading->n_title == 0) /* the file has one column of values */
        return read_column(reading, name, name);
    if (*end == '\0' && number >= 1 && number <= reading->n_title)
        title = reading->title[number - 1];
    for (int i = 0; i < reading->n_title && title == NULL; i++)
        title = strcmp(reading->title[i], name) == 0 ? name : NULL;
    if (title == NULL && cz_mme_is_test(reading->options->measured))
        title = name; /* the code of a channel */
    if (title != NULL)
        return read_column(reading, name, title);
    return cz_fail(reading->error, CZ_STATUS_INPUT,
                   "%.200s: there is no column '%.60s' among the %d of the file",
                   reading->options->measured, name, reading->n_title);
}

/* Reads the columns of a list with commas, unless the list is itself a title. */
static CzStatus read_list(Reading *reading, const char *list) {
    for (int i = 0; i < reading->n_title; i++)
        if (strcmp(reading->title[i], list) == 0)
            return read_named(reading, list);
    for (const char *at = list; at != NULL;) {
        char name[256];
        const char *end = strchr(at, ',');
        snprintf(name, sizeof name, "%.*s", end != NULL ? (int)(end - at) : 255, at);
        CZ_TRY(read_named(reading, name));
        at = end != NULL ? end + 1 : NULL;
    }
    return CZ_OK;
}

/* Reads the first two columns, or else those with the units of the axes: files of testing machines
 * often begin with the time. A mistake is reported for the first two. */
static CzStatus read_pair(Reading *reading) {
    CzError *error = reading->error;
    const CzStatus status = read_named(reading, "2");
    if (status != CZ_STATUS_INPUT || strcmp(reading->options->measured, "-") == 0)
        return status;
    reading->by_unit = true;
    reading->error = NULL;
    const CzStatus by_unit = read_named(reading, "2");
    reading->error = error;
    return by_unit == CZ_OK ? CZ_OK : status;
}

static CzStatus read_columns(Reading *reading) {
    const char *list = reading->options->column;
    if (list != NULL)
        return read_list(reading, list);
    if (reading->chart != CZ_CHART_PANELS)
        return read_pair(reading);
    if (reading->n_title < 2)
        return cz_fail(reading->error, CZ_STATUS_INPUT,
                       "%.200s: times are in the first column, but there is no second one",
                       reading->options->measured);
    for (int i = 1; i < reading->n_title; i++) {
        char number[16];
        snprintf(number, sizeof number, "%d", i + 1);
        CZ_TRY(read_column(reading, number, reading->title[i]));
    }
    return CZ_OK;
}

/* Labels a curve "measured" where it is the only one of its figure. */
static void name_single_ones(int n, CzChartCurve *measured) {
    for (int i = 0; i < n; i++) {
        int n_same = 0;
        for (int k = 0; k < n; k++)
            n_same += measured[k].chart == measured[i].chart;
        if (n_same == 1)
            snprintf(measured[i].label, sizeof measured[i].label, "measured");
    }
}

CzStatus cz_chart_curves_read(const CzChartOptions *options, CzChart chart, int *n,
                              CzChartCurve measured[CZ_MAX_CHART_CURVES], CzError *error) {
    *n = 0;
    if (options->measured == NULL)
        return CZ_OK;
    CzChartAxes axes;
    if (chart != CZ_CHART_PANELS && !cz_chart_axes(chart, &axes))
        return cz_fail(error, CZ_STATUS_INPUT, "no measured curve can be drawn over '%s'",
                       cz_charts[chart].name);
    Reading reading = {.options = options, .chart = chart, .measured = measured, .error = error};
    const bool has_list = options->column != NULL && strchr(options->column, ',') != NULL;
    const bool reads_twice = chart == CZ_CHART_PANELS || has_list;
    if (reads_twice && strcmp(options->measured, "-") == 0)
        return cz_fail(error, CZ_STATUS_INPUT,
                       "several columns are read from a file, not from standard input");
    CzStatus status = CZ_OK;
    if (reads_twice)
        status = cz_curve_titles(options->measured, options->csv_separator, &reading.n_title,
                                 &reading.title, error);
    if (status == CZ_OK)
        status = read_columns(&reading);
    free(reading.title);
    *n = reading.n;
    name_single_ones(reading.n, measured);
    return status;
}

/* ---- of a fit ---- */

/* The figure over time that shows the quantity of a channel; CZ_N_CHART for none. */
static CzChart chart_of(CzChannel channel) {
    static const CzChart charts[] = {CZ_CHART_FORCE, CZ_CHART_VELOCITY, CZ_CHART_ENERGY,
                                     CZ_CHART_OVERLAP, CZ_CHART_PITCH};
    const char *quantity = cz_channel_info(channel)->title;
    for (size_t i = 0; i < sizeof charts / sizeof *charts; i++)
        if (strcmp(cz_drawn_info(cz_charts[charts[i]].y)->title, quantity) == 0)
            return charts[i];
    return CZ_N_CHART;
}

/* The figure of a match's channel in a run; CZ_N_CHART for none. */
static CzChart chart_of_match(const CzMatch *match, int n_vehicle, const char *const *vehicle) {
    CzColumn column;
    if (match->file == NULL || match->channel == NULL ||
        !cz_column_find(match->channel, n_vehicle, vehicle, &column, NULL))
        return CZ_N_CHART;
    return chart_of(column.channel);
}

/* A copy of a history with times in ms; NULL without memory. */
static CzCurve *copy_history(const CzMeasured *history) {
    CzCurve *curve = calloc(1, sizeof *curve);
    const size_t n = (size_t)history->n_point;
    if (curve == NULL)
        return NULL;
    curve->n = history->n_point;
    curve->x = malloc(n * sizeof *curve->x);
    curve->y = malloc(n * sizeof *curve->y);
    if (curve->x == NULL || curve->y == NULL) {
        cz_curve_free(curve);
        return NULL;
    }
    for (size_t i = 0; i < n; i++) {
        curve->x[i] = history->time[i] * CZ_MILLI_PER_UNIT;
        curve->y[i] = history->value[i];
    }
    return curve;
}

CzStatus cz_chart_curves_of_fit(const CzProblem *problem, const CzRunSummary *run, int *n,
                                CzChartCurve curve[CZ_MAX_CHART_CURVES], CzError *error) {
    const CzOptimise *optimise = &cz_problem_input(problem)->optimise;
    const char **vehicle = malloc((size_t)run->n_vehicle * sizeof *vehicle);
    CzStatus status = vehicle != NULL ? CZ_OK : CZ_STATUS_NO_MEMORY;
    *n = 0;
    for (int i = 0; vehicle != NULL && i < run->n_vehicle; i++)
        vehicle[i] = run->vehicle[i].name;
    for (int i = 0; status == CZ_OK && i < optimise->n_match && *n < CZ_MAX_CHART_CURVES; i++) {
        const CzMatch *match = &optimise->match[i];
        const bool is_here = match->scenario == NULL || strcmp(match->scenario, run->scenario) == 0;
        const CzChart chart = chart_of_match(match, run->n_vehicle, vehicle);
        if (!is_here || chart == CZ_N_CHART)
            continue;
        CzChartCurve *made = &curve[(*n)++];
        *made =
            (CzChartCurve){.chart = chart, .curve = copy_history(cz_problem_measured(problem, i))};
        snprintf(made->label, sizeof made->label, "measured, %s", match->name);
        status = made->curve != NULL ? CZ_OK : CZ_STATUS_NO_MEMORY;
    }
    free(vehicle);
    return status == CZ_OK ? CZ_OK : cz_fail(error, status, "no memory for a measured curve");
}

void cz_chart_curves_free(int n, CzChartCurve *measured) {
    for (int i = 0; i < n; i++)
        cz_curve_free(measured[i].curve);
}
