/* Measured curves over a figure: the columns of a file, and the figure of each. */
#ifndef CZ_REPORT_CHART_CURVES_H
#define CZ_REPORT_CHART_CURVES_H

#include "crushzone/report.h"
#include "report/charts.h"

/* Reads the measured curves of a figure; none without a file. In the figure of four panels the
 * beginning of a column's title chooses the panel, as in names of channels: F_, v_, x_, d_.
 * Statuses: CZ_STATUS_INPUT, CZ_STATUS_NO_MEMORY; free the curves in any case. */
CZ_MUST_CHECK CzStatus cz_chart_curves_read(const CzChartOptions *options, CzChart chart, int *n,
                                            CzChartCurve measured[CZ_MAX_CHART_CURVES],
                                            CzError *error);
/* The measured time histories of a fit in the scenario of a run, each for the figure of its
 * channel; none for channels without a figure. Status: CZ_STATUS_NO_MEMORY; free the curves in any
 * case. */
CZ_MUST_CHECK CzStatus cz_chart_curves_of_fit(const CzProblem *problem, const CzRunSummary *run,
                                              int *n, CzChartCurve curve[CZ_MAX_CHART_CURVES],
                                              CzError *error);
void cz_chart_curves_free(int n, CzChartCurve *measured);

#endif
