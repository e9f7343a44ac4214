/* Version of the library and default options of results. */
#include "report/options.h"

#include <math.h>

static const CzReportOptions usual = {
    .csv_separator = ',', .csv_decimal = '.', .setup_s = NAN, .wall_s = NAN};

const char *cz_version(void) {
    return CZ_VERSION;
}

CzReportOptions cz_report_options_default(void) {
    return usual;
}

const CzReportOptions *cz_report_options_of(const CzReport *report) {
    return report->options != NULL ? report->options : &usual;
}
