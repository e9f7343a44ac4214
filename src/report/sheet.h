/* A figure while its curves are gathered, and what is drawn into it. */
#ifndef CZ_REPORT_SHEET_H
#define CZ_REPORT_SHEET_H

#include "base/arena.h"
#include "report/page.h"
#include "report/plot.h"

/* A plot while its curves are gathered. */
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

/* The stretch of time in which a run is beyond the model's validity. */
CzPlotBand cz_band_beyond(const CzRunSummary *run, const double *time, int n_sample);
/* Draws the part of a curve beyond the model's validity dotted, by a name of its own; returns that
 * part, NULL where there is none. */
CzSeries *cz_sheet_split_beyond(CzSheet *sheet, CzSeries *series);

/* Starts a figure with room for all that a page may draw into one. The title is borrowed. */
void cz_sheet_begin(CzSheet *sheet, const CzPage *page, const char *title, CzDrawn x, CzDrawn y);

/* Adds a curve over time, named after its place; NULL when there is none. */
CzSeries *cz_sheet_add(CzSheet *sheet, CzDrawn drawn, int place);
/* Name of a curve for the cursor of the page, kept with the figure; NULL without memory. */
const char *cz_sheet_name(CzSheet *sheet, CzDrawn drawn, int place);

/* A car and its mirror image get one colour; the train ahead is dashed. */
void cz_sheet_mark_car(CzSeries *series, const CzModel *model, int car);
void cz_sheet_mark_interface(CzSeries *series, const CzModel *model, int interface);

void cz_sheet_add_limit(CzSheet *sheet, double at, const char *name);

/* Draws the figure and frees what it took; without memory the markup has failed. */
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

/* Wheelsets that lifts are drawn of at most. */
enum { CZ_MOST_LIFTS = 14 };

#endif
