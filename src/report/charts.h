/* The figures of a run, each by its name: for the report and alone, for papers. */
#ifndef CZ_REPORT_CHARTS_H
#define CZ_REPORT_CHARTS_H

#include "report/page.h"

typedef enum CzChart {
#define CZ_CHART(constant, name, doc) CZ_CHART_##constant,
#include "crushzone/charts.def"
#undef CZ_CHART
    CZ_N_CHART
} CzChart;

/* How many figures of a kind a run has: one per interface or car, or one, or none. */
int cz_chart_count(const CzPage *page, CzChart chart);
/* What one of them is about, such as "Force over closure, A4-B1". */
void cz_chart_title(const CzPage *page, CzChart chart, int index, size_t room, char *title);
/* Writes one of them as an element `svg`. Status: CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_chart_write(const CzPage *page, CzChart chart, int index,
                                      CzMarkup *markup, CzError *error);

/* What the axes of a figure show, and how much of it in SI is one of their units. */
typedef struct CzChartAxes {
    const char *x_quantity;
    double x_unit;
    const char *y_quantity;
    double y_unit;
} CzChartAxes;

/* NULL for a figure that no curve can be laid over. */
const CzChartAxes *cz_chart_axes(CzChart chart);

/* Six frames of the collision from the side (page_scene.c). */
void cz_chart_write_frames(const CzPage *page, int interface, CzMarkup *markup);

/* Energies of the interfaces as stacked bars (shares.c). */
void cz_chart_write_shares(const CzPage *page, CzMarkup *markup);

/* The car with the largest mean deceleration. */
int cz_chart_hardest_car(const CzRunSummary *run);

#endif
