/* A figure while its curves are collected. */
#ifndef CZ_REPORT_SHEET_H
#define CZ_REPORT_SHEET_H

#include "base/arena.h"
#include "report/page.h"
#include "report/plot.h"

/* A plot while its curves are collected. */
typedef struct CzSheet {
    const CzPage *page;
    CzArena arena; /* names and derived curves */
    CzPlot plot;
    char label[2][CZ_DRAWN_LABEL]; /* of the axes */
    CzSeries *series;
    CzPlotLimit limit[4];
    CzPlotBand band[4];
    int room; /* for series; 0 without memory */
} CzSheet;

/* The time of a run beyond model validity. */
CzPlotBand cz_band_beyond(const CzRunSummary *run, const double *time, int n_sample);
/* Splits off the part of a curve beyond model validity, dotted and with its own name; returns that
 * part, NULL where there is none. */
CzSeries *cz_sheet_split_beyond(CzSheet *sheet, CzSeries *series);

/* Begins a figure with room for all curves of a page. The title is borrowed. */
void cz_sheet_begin(CzSheet *sheet, const CzPage *page, const char *title, CzDrawn x, CzDrawn y);

/* Adds a curve over time, named after its place; NULL when there is none. */
CzSeries *cz_sheet_add(CzSheet *sheet, CzDrawn drawn, int place);
/* Name of a curve for the cursor of the page, kept with the figure; NULL without memory. */
const char *cz_sheet_name(CzSheet *sheet, CzDrawn drawn, int place);

/* Cars at the same distance from the collision have the same colour; the front train is dashed. */
void cz_sheet_mark_car(CzSeries *series, const CzModel *model, int car);
void cz_sheet_mark_interface(CzSeries *series, const CzModel *model, int interface);

void cz_sheet_add_limit(CzSheet *sheet, double at, const char *name);

/* Writes the figure and frees it; without memory the markup has failed. */
void cz_sheet_write(CzSheet *sheet, CzMarkup *markup);

/* charts_force.c */
void cz_draw_force_limits(CzSheet *sheet);
void cz_draw_force_closure(CzSheet *sheet, int interface);
void cz_draw_interfaces(CzSheet *sheet, CzDrawn drawn);
void cz_draw_energy(CzSheet *sheet, int index);
void cz_draw_balance(CzSheet *sheet, int index);

/* charts_motion.c */
void cz_draw_cars(CzSheet *sheet, CzDrawn drawn);
void cz_draw_shortening(CzSheet *sheet, int interface);
void cz_draw_accelerations(CzSheet *sheet, int index);
void cz_draw_car_acceleration(CzSheet *sheet, int car);
void cz_draw_lifts(CzSheet *sheet, int index);

/* Most wheelsets in the figure of lifts. */
enum { CZ_MOST_LIFTS = 14 };

#endif
