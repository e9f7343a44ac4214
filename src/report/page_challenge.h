/* A challenge as a page. */
#ifndef CZ_REPORT_PAGE_CHALLENGE_H
#define CZ_REPORT_PAGE_CHALLENGE_H

#include "crushzone/report.h"

/* Writes the page. Status: CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_page_write_challenge(const CzReport *report, FILE *stream,
                                               CzError *error);

#endif
