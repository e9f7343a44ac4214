/* The figures of a run, for the report and as single files. */
#ifndef CZ_REPORT_CHARTS_H
#define CZ_REPORT_CHARTS_H

#include "crushzone/fit.h"
#include "report/drawn.h"
#include "report/page.h"
#include "report/plot.h"

typedef enum CzChart {
#define CZ_CHART(constant, ...) CZ_CHART_##constant,
#include "crushzone/charts.def"
#undef CZ_CHART
    CZ_N_CHART
} CzChart;

/* Number of figures of a kind in a run. */
typedef enum CzChartCount { CZ_CHART_ONE, CZ_CHART_PER_INTERFACE, CZ_CHART_PER_CAR } CzChartCount;

typedef struct CzChartInfo {
    const char *name; /* on the command line */
    const char *title;
    CzChartCount count;
    bool is_of_curves;
    CzDrawn x, y; /* what the axes of a figure of curves show */
} CzChartInfo;
extern const CzChartInfo cz_charts[CZ_N_CHART];

/* Quantities of the axes, and their units in SI. */
typedef struct CzChartAxes {
    const char *x_quantity;
    double x_unit;
    const char *y_quantity;
    double y_unit;
} CzChartAxes;

/* False for a figure without measured curves. */
bool cz_chart_axes(CzChart chart, CzChartAxes *axes);

enum { CZ_MAX_CHART_CURVES = 12 };

/* A measured curve. */
typedef struct CzChartCurve {
    CzChart chart;  /* the figure, or the one of the four panels, that it belongs to */
    CzCurve *curve; /* in the units of that figure's axes */
    char label[CZ_LABEL_SIZE + 16]; /* in the legend */
} CzChartCurve;

/* Number of figures of a kind: one per interface or car, one, or none. */
int cz_chart_count(const CzPage *page, CzChart chart);
/* Title of a figure, such as "Force over closure, A4-B1". */
void cz_chart_title(const CzPage *page, CzChart chart, int index, size_t room, char *title);
/* Writes a figure as an element `svg`; without memory the markup has failed. */
void cz_chart_write(const CzPage *page, CzChart chart, int index, CzMarkup *markup);

/* The same on the page, under its title. */
void cz_page_write_figure(CzPage *page, CzChart chart, int index);

/* The time of a run beyond model validity, shaded. */
CzPlotBand cz_band_beyond(const CzRunSummary *run, const double *time, int n_sample);

/* Six frames of the collision from the side (page_scene.c). */
void cz_chart_write_frames(const CzPage *page, int interface, CzMarkup *markup);

/* Energies of the interfaces as stacked bars (energy_distribution.c). */
void cz_chart_write_shares(const CzPage *page, CzMarkup *markup);

/* The car with the largest mean deceleration. */
int cz_chart_hardest_car(const CzRunSummary *run);

#endif
