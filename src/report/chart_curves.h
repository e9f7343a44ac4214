/* Measured curves that are laid over a figure: which columns of a file go where. */
#ifndef CZ_REPORT_CHART_CURVES_H
#define CZ_REPORT_CHART_CURVES_H

#include "crushzone/fit.h"
#include "crushzone/report.h"
#include "report/chart.h"

enum { CZ_MOST_CHART_CURVES = 12 };

/* One of them. */
typedef struct CzChartCurve {
    CzChart chart;  /* the figure, or the one of the four panels, that it belongs to */
    CzCurve *curve; /* in the units of that figure's axes */
    char label[CZ_LABEL_ROOM + 16]; /* in its legend */
} CzChartCurve;

/* Reads the measured curves of a figure: none without a file. In the panels the title of a column
 * selects its panel by its first letters, as of a channel: F_, v_, x_, d_. Statuses:
 * CZ_STATUS_INPUT, CZ_STATUS_NO_MEMORY; free them in any case. */
CZ_MUST_CHECK CzStatus cz_chart_curves_read(const CzChartOptions *options, CzChart chart, int *n,
                                            CzChartCurve measured[CZ_MOST_CHART_CURVES],
                                            CzError *error);
/* The time histories that a fit follows in the scenario of a run, each over the figure of its
 * channel; none of channels that no figure shows. Status: CZ_STATUS_NO_MEMORY; free them in any
 * case. */
CZ_MUST_CHECK CzStatus cz_chart_curves_of_fit(const CzProblem *problem, const CzRunSummary *run,
                                              int *n, CzChartCurve curve[CZ_MOST_CHART_CURVES],
                                              CzError *error);
void cz_chart_curves_free(int n, CzChartCurve *measured);

#endif
