/* Result tables as CSV (RFC 4180: fields with a separator, quote or line end are quoted, lines end
 * in CR LF): UTF-8, the unit in every column's name, nine digits, an empty field for a number that
 * is not finite. */
#ifndef CZ_REPORT_CSV_H
#define CZ_REPORT_CSV_H

#include <stdio.h>

#include "crushzone/report.h"

void cz_csv_write_checks(const CzEvaluation *evaluation, const CzReportOptions *options,
                         FILE *stream);
void cz_csv_write_interfaces(const CzRunSummary *run, const CzReportOptions *options, FILE *stream);
void cz_csv_write_channels(const CzRun *run, const CzReportOptions *options, FILE *stream);

/* One row per point of a sweep or a front, per sample that was run, per evaluation of a search.
 * Draws and margins of samples have all digits, so that they can be read again. */
void cz_csv_write_samples(const CzReport *report, FILE *stream);
void cz_csv_write_challenge(const CzReport *report, FILE *stream);
void cz_csv_write_corridor(const CzReport *report, FILE *stream);
void cz_csv_write_sweep(const CzReport *report, FILE *stream);
void cz_csv_write_pareto(const CzReport *report, FILE *stream);
void cz_csv_write_history(const CzReport *report, FILE *stream);

#endif
