/* What is compared between runs, for the terminal and for the page. */
#ifndef CZ_REPORT_COMPARE_H
#define CZ_REPORT_COMPARE_H

#include "report/figure.h"
#include "report/page.h"
#include "report/results.h"
#include "report/runs.h"
#include "report/table.h"

enum { CZ_MOST_COMPARED = 8 };

/* The scenario of run[i] that is compared: for the first the one that was requested, or that has
 * the smallest margin; for the others the one of the same name, or else theirs with the smallest
 * margin. -1 when none ran. */
int cz_compared_scenario(const CzReportRun *run, int i);
/* Its summary; NULL when none was kept. */
const CzRunSummary *cz_compared_run(const CzReportRun *run, int i);

/* The check of the same name and scenario in another run; NULL when it has none. */
const CzCheckResult *cz_compared_check(const CzReportRun *run, const CzCheckResult *check);
/* Whether a check of the first run comes out otherwise in any other: by its verdict, or by more
 * than a thousandth of what is allowed or of what it is exceeded by. */
bool cz_compared_differs(int n, const CzReportRun *run, const CzCheckResult *check);

/* A result of the first run's places of a kind, interfaces or cars, that is compared; NULL beyond
 * the last. */
const CzResult *cz_compared_result(bool of_interface, int index);
int cz_compared_count(const CzRunSummary *run, bool of_interface);
const char *cz_compared_name(const CzRunSummary *run, bool of_interface, int index);
/* A number in run[i], by the name of its interface or car; NaN when that run has none. */
double cz_compared_value(const CzReportRun *run, int i, const CzResult *result, const char *name);
/* Whether what is compared of run[i] went beyond the model's validity. */
bool cz_compared_is_beyond(const CzReportRun *run, int i);
/* What the mark means when one of the runs has it; empty when none has. */
const char *cz_compared_caution(int n, const CzReportRun *run);

/* Tables: checks that differ, how many do not; numbers of interfaces or cars, without those that no
 * run knows when `known` is set. */
void cz_compared_begin_checks(CzReportTable *table, int n, const CzReportRun *run, int *n_same);
void cz_compared_begin_numbers(CzReportTable *table, int n, const CzReportRun *run,
                               bool of_interface, bool known);

#endif
