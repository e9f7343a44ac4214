/* Version of the library and default options of results. */
#include "crushzone/report.h"

#include <math.h>

const char *cz_version(void) {
    return CZ_VERSION;
}

CzReportOptions cz_report_options_default(void) {
    return (CzReportOptions){
        .csv_separator = ',', .csv_decimal = '.', .setup_s = NAN, .wall_s = NAN};
}
