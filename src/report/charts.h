/* The figures of a run, each by its name: for the report and alone, for papers. */
#ifndef CZ_REPORT_CHARTS_H
#define CZ_REPORT_CHARTS_H

#include "report/chart.h"
#include "report/page.h"

/* How many figures of a kind a run has: one per interface or car, or one, or none. */
int cz_chart_count(const CzPage *page, CzChart chart);
/* What one of them is about, such as "Force over closure, A4-B1". */
void cz_chart_title(const CzPage *page, CzChart chart, int index, size_t room, char *title);
/* Writes one of them as an element `svg`; without memory the markup has failed. */
void cz_chart_write(const CzPage *page, CzChart chart, int index, CzMarkup *markup);

/* The same on the page, under its title. */
void cz_page_write_figure(CzPage *page, CzChart chart, int index);

/* Six frames of the collision from the side (page_scene.c). */
void cz_chart_write_frames(const CzPage *page, int interface, CzMarkup *markup);

/* Energies of the interfaces as stacked bars (shares.c). */
void cz_chart_write_shares(const CzPage *page, CzMarkup *markup);

/* The car with the largest mean deceleration. */
int cz_chart_hardest_car(const CzRunSummary *run);

#endif
