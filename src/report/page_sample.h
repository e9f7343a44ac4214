/* A sampling as a page. */
#ifndef CZ_REPORT_PAGE_SAMPLE_H
#define CZ_REPORT_PAGE_SAMPLE_H

#include "crushzone/report.h"

/* Writes the page. Status: CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_page_write_sample(const CzReport *report, FILE *stream, CzError *error);

#endif
