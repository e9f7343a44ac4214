/* What is compared between runs, for the terminal and for the page. */
#ifndef CZ_REPORT_COMPARE_H
#define CZ_REPORT_COMPARE_H

#include "report/figure.h"
#include "report/page.h"
#include "report/runs.h"

enum { CZ_MOST_COMPARED = 8, CZ_N_COMPARED_NUMBER = 7 };

/* The scenario of run[i] that is compared: for the first the one that was asked for, or that has
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

/* A number of every interface, or of every car. */
typedef struct CzComparedNumber {
    const char *name; /* with unit */
    const char *key;  /* in JSON */
    double in_key;    /* factor to the unit of the key */
    bool of_interface;
    double (*value)(const CzRunSummary *run, int index);
} CzComparedNumber;
extern const CzComparedNumber cz_compared_numbers[CZ_N_COMPARED_NUMBER];

int cz_compared_count(const CzRunSummary *run, const CzComparedNumber *number);
const char *cz_compared_name(const CzRunSummary *run, const CzComparedNumber *number, int index);
/* A number in run[i], by the name of its interface or car; NaN when that run has none. */
double cz_compared_value(const CzReportRun *run, int i, const CzComparedNumber *number,
                         const char *name);
/* Whether what is compared of run[i] went beyond the model's validity. */
bool cz_compared_is_beyond(const CzReportRun *run, int i);
/* The number as text, with the mark of such a run. */
const char *cz_compared_text(char text[CZ_FIGURE_ROOM], const CzReportRun *run, int i,
                             const CzComparedNumber *number, const char *name);
/* What the mark means when one of the runs has it; empty when none has. */
const char *cz_compared_caution(int n, const CzReportRun *run);

#endif
