/* Comparison of runs, for the terminal and for the page. */
#ifndef CZ_REPORT_COMPARE_H
#define CZ_REPORT_COMPARE_H

#include "report/figure.h"
#include "report/page.h"
#include "report/results.h"
#include "report/runs.h"
#include "report/table.h"

/* The compared scenario of a run: of the first run the requested one, or the one with the smallest
 * margin; of the others the one of the same name, or else the one with the smallest margin. -1 when
 * none ran. */
int cz_compared_scenario(const CzReport *report, int i);
/* Summary of that scenario; NULL when none was kept. */
const CzRunSummary *cz_compared_run(const CzReport *report, int i);

/* The check of the same name and scenario in another run; NULL when it has none. */
const CzCheckResult *cz_compared_check(const CzReportRun *run, const CzCheckResult *check);
/* Whether a check of the first run differs in another run: by its verdict, or by more than a
 * thousandth of the limit or of the violation. */
bool cz_compared_differs(const CzReport *report, const CzCheckResult *check);

/* A number in a compared run, by the name of its interface or car; NaN when that run has none. */
double cz_compared_value(const CzReport *report, int i, const CzResult *result, const char *name);
/* Whether the compared scenario went beyond model validity. */
bool cz_compared_is_beyond(const CzReport *report, int i);
/* Explanation of the mark when a run has it; empty when none has. */
const char *cz_compared_caution(const CzReport *report);

/* Tables of a comparison: inputs that differ, with their changes and origins, at most `most` of
 * them; numbers that differ, in the order of the results. */
void cz_compared_begin_inputs(CzReportTable *table, const CzReport *report, int most);
void cz_compared_begin_differences(CzReportTable *table, const CzReport *report);

/* Tables: checks that differ, and the number of equal ones; results of interfaces or cars, with
 * `known` only those that exist in a run. */
void cz_compared_begin_checks(CzReportTable *table, const CzReport *report, int *n_same);
void cz_compared_begin_numbers(CzReportTable *table, const CzReport *report, bool of_interface,
                               bool known);

#endif
