/* Which figures of a run there are (charts.def), and what each of them shows. */
#ifndef CZ_REPORT_CHART_H
#define CZ_REPORT_CHART_H

#include "report/drawn.h"

typedef enum CzChart {
#define CZ_CHART(constant, name, doc) CZ_CHART_##constant,
#include "crushzone/charts.def"
#undef CZ_CHART
    CZ_N_CHART
} CzChart;

/* How many of a kind a run has. */
typedef enum CzChartCount { CZ_CHART_ONE, CZ_CHART_PER_INTERFACE, CZ_CHART_PER_CAR } CzChartCount;

typedef struct CzChartInfo {
    const char *title;
    CzChartCount count;
    bool is_of_curves;
    CzDrawn x, y; /* what the axes of a figure of curves show */
} CzChartInfo;
const CzChartInfo *cz_chart_info(CzChart chart);
/* Name on the command line. */
const char *cz_chart_name(CzChart chart);

/* What the axes show, and how much of it in SI is one of their units. */
typedef struct CzChartAxes {
    const char *x_quantity;
    double x_unit;
    const char *y_quantity;
    double y_unit;
} CzChartAxes;

/* False for a figure that no curve can be laid over. */
bool cz_chart_axes(CzChart chart, CzChartAxes *axes);

#endif
