/* A sweep as a page. */
#ifndef CZ_REPORT_PAGE_SWEEP_H
#define CZ_REPORT_PAGE_SWEEP_H

#include <stdio.h>

#include "crushzone/sweep.h"

/* Writes the page. Status: CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_page_write_sweep(const CzSweep *sweep, FILE *stream, CzError *error);

#endif
