/* Options for writing results. */
#ifndef CZ_REPORT_OPTIONS_H
#define CZ_REPORT_OPTIONS_H

#include "crushzone/report.h"

/* Options of a report, or the default ones. */
const CzReportOptions *cz_report_options_of(const CzReport *report);

#endif
