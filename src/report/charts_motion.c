/* Figures of motion: speeds, accelerations, lifts. */
#include "report/sheet.h"

#include "report/units.h"

#include <math.h>
#include <stdio.h>

void cz_draw_cars(CzSheet *sheet, const char *stem, const char *unit) {
    const CzPage *page = sheet->page;
    for (int car = 0; car < page->summary->n_vehicle; car++) {
        CzSeries *series =
            cz_sheet_add_channel(sheet, stem, page->summary->vehicle[car].name, unit);
        if (series != NULL)
            cz_sheet_mark_car(series, page->model, car);
    }
}

/* Closure of an interface, and what gives way at it: side A is the front of the car behind. */
void cz_draw_shortening(CzSheet *sheet, int interface) {
    const CzRunSummary *run = sheet->page->summary;
    static const char *const stems[2][2] = {{"d_end_front", "d_anti-climber_front"},
                                            {"d_end_rear", "d_anti-climber_rear"}};
    static const char *const names[2] = {"end", "anti-climber"};
    CzSeries *closure = cz_sheet_add_channel(sheet, "d", run->interface[interface].name, "mm");
    if (closure != NULL)
        closure->name = "closure of the interface";
    for (int side = 0; side < 2; side++)
        for (int i = 0; i < 2; i++) {
            const char *car = run->vehicle[interface + side].name;
            CzSeries *series = cz_sheet_add_channel(sheet, stems[side][i], car, "mm");
            char *name = cz_arena_allocate(&sheet->arena, CZ_WHERE_ROOM, 1);
            if (series == NULL || name == NULL)
                continue;
            snprintf(name, CZ_WHERE_ROOM, "%s %s", names[i], car);
            series->name = name;
            series->colour = 1 + i;
            series->dash = side;
        }
    sheet->plot.from_zero = true;
}

void cz_draw_accelerations(CzSheet *sheet) {
    cz_draw_cars(sheet, "c", "g");
    if (sheet->plot.n_series > 0)
        return;
    cz_draw_cars(sheet, "a", "g");
    sheet->plot.y_label = "acceleration, not filtered: samples too far apart [g]";
}

void cz_draw_car_acceleration(CzSheet *sheet, int car) {
    const CzVehicleResult *vehicle = &sheet->page->summary->vehicle[car];
    CzSeries *raw = cz_sheet_add_channel(sheet, "a", vehicle->name, "g");
    if (raw == NULL)
        return;
    raw->name = "raw, as sampled";
    raw->colour = 5;
    CzSeries *smooth = cz_sheet_add_channel(sheet, "c", vehicle->name, "g");
    if (smooth != NULL) {
        smooth->name = "CFC 60";
        smooth->colour = 6;
    }
    const struct {
        const char *name;
        const double *window;
    } windows[] = {{"worst 120 ms", vehicle->window_120ms}, {"contact", vehicle->contact_window}};
    for (int i = 0; i < 2; i++)
        if (windows[i].window[1] > windows[i].window[0])
            sheet->band[sheet->plot.n_band++] =
                (CzPlotBand){windows[i].name, 1e3 * windows[i].window[0],
                             1e3 * windows[i].window[1], i == 0 ? 1 : 2};
}

/* Wheelsets by their largest lift, highest first; only those that leave the rail. */
static int rank_lifts(const CzRunSummary *run, int room, int vehicle[], int axle[]) {
    int n = 0;
    for (int i = 0; i < run->n_vehicle; i++)
        for (int k = 0; k < 4; k++) {
            const double lift = run->vehicle[i].wheel_lift[k];
            if (!(lift > 1e-5))
                continue;
            int at = n < room ? n : room;
            while (at > 0 && run->vehicle[vehicle[at - 1]].wheel_lift[axle[at - 1]] < lift)
                at--;
            if (at >= room)
                continue;
            n = n < room ? n + 1 : room;
            for (int m = n - 1; m > at; m--) {
                vehicle[m] = vehicle[m - 1];
                axle[m] = axle[m - 1];
            }
            vehicle[at] = i;
            axle[at] = k;
        }
    return n;
}

void cz_draw_lifts(CzSheet *sheet) {
    const CzPage *page = sheet->page;
    int vehicle[CZ_MOST_LIFTS], axle[CZ_MOST_LIFTS];
    const int n = rank_lifts(page->summary, CZ_MOST_LIFTS, vehicle, axle);
    double flange = INFINITY;
    for (int car = 0; car < page->model->n_car; car++)
        if (page->model->car[car].model == CZ_MODEL_FULL)
            flange =
                fmin(flange, page->vehicles[page->model->car[car].vehicle].bogie.flange_height);
    for (int i = 0; i < n; i++) {
        char *name = cz_arena_allocate(&sheet->arena, CZ_WHERE_ROOM, 1);
        if (name == NULL)
            return;
        snprintf(name, CZ_WHERE_ROOM, "%s_w%d", page->summary->vehicle[vehicle[i]].name,
                 axle[i] + 1);
        CzSeries *series = cz_sheet_add_channel(sheet, "z", name, "mm");
        if (series == NULL)
            continue;
        series->colour = i;
        series->dash = i / CZ_PLOT_N_COLOUR + 2 * (i % 2);
    }
    if (n == 0) { /* all wheels stay down: one of them shows it */
        for (int car = 0; car < page->summary->n_vehicle && sheet->plot.n_series == 0; car++) {
            char *name = cz_arena_allocate(&sheet->arena, CZ_WHERE_ROOM, 1);
            if (name == NULL)
                return;
            snprintf(name, CZ_WHERE_ROOM, "%s_w1", page->summary->vehicle[car].name);
            cz_sheet_add_channel(sheet, "z", name, "mm");
        }
    }
    if (isfinite(flange))
        cz_sheet_add_limit(sheet, flange * CZ_MILLI_PER_UNIT, "flange height");
    sheet->plot.from_zero = true;
}
