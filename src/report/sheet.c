/* A figure while its curves are collected. */
#include "report/sheet.h"

#include "report/units.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void cz_sheet_begin(CzSheet *sheet, const CzPage *page, const char *title, CzDrawn x, CzDrawn y) {
    const int room = page->summary->n_vehicle + CZ_MOST_LIFTS + page->n_other + page->n_measured;
    *sheet = (CzSheet){.page = page};
    sheet->plot = (CzPlot){.title = title,
                           .x_label = cz_drawn_label(x, sheet->label[0]),
                           .y_label = cz_drawn_label(y, sheet->label[1]),
                           .is_time = x == CZ_DRAWN_TIME};
    sheet->series = cz_arena_allocate(&sheet->arena, (size_t)room, sizeof *sheet->series);
    sheet->room = sheet->series != NULL ? room : 0;
}

const char *cz_sheet_name(CzSheet *sheet, CzDrawn drawn, int place) {
    char name[CZ_CHANNEL_ROOM];
    cz_drawn_name(sheet->page->summary, drawn, place, name);
    return cz_arena_copy_text(&sheet->arena, name, strlen(name));
}

CzSeries *cz_sheet_add(CzSheet *sheet, CzDrawn drawn, int place) {
    const CzPage *page = sheet->page;
    const double *y = cz_page_values(page, drawn, place);
    if (y == NULL || sheet->plot.n_series == sheet->room)
        return NULL;
    CzSeries *series = &sheet->series[sheet->plot.n_series++];
    *series = (CzSeries){.name = cz_run_place_name(page->summary, cz_drawn_info(drawn)->at, place),
                         .y_channel = cz_sheet_name(sheet, drawn, place),
                         .n = page->n_sample,
                         .x = page->time,
                         .y = y};
    return series;
}

/* `colour` counts from the colliding interface outwards. */
static void mark(CzSeries *series, int colour, bool ahead) {
    series->colour = colour;
    series->dash = (ahead ? 1 : 0) + (colour >= CZ_PLOT_N_COLOUR ? 2 : 0);
}

void cz_sheet_mark_car(CzSeries *series, const CzModel *model, int car) {
    const bool ahead = car > model->colliding;
    mark(series, ahead ? car - model->colliding - 1 : model->colliding - car, ahead);
}

void cz_sheet_mark_interface(CzSeries *series, const CzModel *model, int interface) {
    mark(series, abs(interface - model->colliding), interface > model->colliding);
}

void cz_sheet_add_limit(CzSheet *sheet, double at, const char *name) {
    for (int i = 0; i < sheet->plot.n_limit; i++)
        if (sheet->limit[i].at == at)
            return;
    if (sheet->plot.n_limit < 4)
        sheet->limit[sheet->plot.n_limit++] = (CzPlotLimit){name, at};
}

CzPlotBand cz_band_beyond(const CzRunSummary *run, const double *time, int n_sample) {
    return (CzPlotBand){"beyond the model", run->beyond_validity_time * CZ_MILLI_PER_UNIT,
                        time[n_sample - 1], 5};
}

/* Shades the time beyond model validity. */
static void mark_beyond(CzSheet *sheet) {
    const CzPage *page = sheet->page;
    const int room = sizeof sheet->band / sizeof sheet->band[0];
    if (page->summary->beyond_validity && sheet->plot.n_band < room)
        sheet->band[sheet->plot.n_band++] =
            cz_band_beyond(page->summary, page->time, page->n_sample);
}

CzSeries *cz_sheet_split_beyond(CzSheet *sheet, CzSeries *series) {
    const CzPage *page = sheet->page;
    if (!page->summary->beyond_validity || sheet->plot.n_series == sheet->room)
        return NULL;
    double *part = cz_arena_allocate(&sheet->arena, 2 * (size_t)series->n, sizeof *part);
    if (part == NULL)
        return NULL; /* cz_sheet_write reports it */
    const double from = page->summary->beyond_validity_time * CZ_MILLI_PER_UNIT;
    for (int i = 0; i < series->n; i++) {
        const bool late = page->time[i] > from;
        part[i] = late ? NAN : series->y[i];
        part[series->n + i] = late ? series->y[i] : NAN;
    }
    CzSeries *late = &sheet->series[sheet->plot.n_series++];
    *late = *series;
    late->name = "beyond the model";
    late->y = part + series->n;
    late->dash = 2;
    series->y = part;
    return late;
}

void cz_sheet_write(CzSheet *sheet, CzMarkup *markup) {
    if (sheet->plot.is_time && sheet->page->n_sample > 0)
        mark_beyond(sheet);
    sheet->plot.series = sheet->series;
    sheet->plot.limit = sheet->limit;
    sheet->plot.band = sheet->band;
    if (sheet->arena.out_of_memory)
        markup->failed = true;
    else
        cz_plot_write(&sheet->plot, markup);
    cz_arena_free(&sheet->arena);
}
