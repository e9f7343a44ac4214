/* A corridor as a page that can be attached to an order, and as a figure. */
#ifndef CZ_REPORT_PAGE_CORRIDOR_H
#define CZ_REPORT_PAGE_CORRIDOR_H

#include "crushzone/report.h"
#include "report/markup.h"

/* Writes the page. Status: CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_page_write_corridor(const CzReport *report, FILE *stream, CzError *error);

/* Draws the corridor, with the failing curves just beyond its edges. */
void cz_corridor_draw(const CzCorridor *corridor, bool is_figure, CzMarkup *markup);

#endif
