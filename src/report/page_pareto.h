/* A front as a page and as a figure. */
#ifndef CZ_REPORT_PAGE_PARETO_H
#define CZ_REPORT_PAGE_PARETO_H

#include <stdio.h>

#include "crushzone/pareto.h"
#include "report/table.h"

/* Writes the page. Status: CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_page_write_pareto(const CzPareto *pareto, const CzProblem *problem,
                                            FILE *stream, CzError *error);

/* The table of all points. */
void cz_pareto_begin_points(CzReportTable *table, const CzPareto *pareto);

/* One line on the points: how many are on the front, and how many are not usable. */
void cz_pareto_describe(const CzPareto *pareto, size_t room, char *text);

/* Whether a point is on the front: verified, and no point is better. */
bool cz_pareto_is_on_front(const CzParetoPoint *point);

#endif
