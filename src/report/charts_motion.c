/* Figures of motion: speeds, accelerations, lifts. */
#include "report/sheet.h"

#include "report/units.h"

#include <math.h>
#include <stdio.h>

void cz_draw_cars(CzSheet *sheet, CzDrawn drawn) {
    const CzPage *page = sheet->page;
    for (int car = 0; car < page->summary->n_vehicle; car++) {
        CzSeries *series = cz_sheet_add(sheet, drawn, car);
        if (series != NULL)
            cz_sheet_mark_car(series, page->model, car);
    }
}

/* Closure of an interface, and strokes of its ends and anti-climbers; the first side is the front
 * of the rear car. */
void cz_draw_shortening(CzSheet *sheet, int interface) {
    const CzRunSummary *run = sheet->page->summary;
    static const struct {
        CzDrawn drawn;
        const char *name;
    } parts[2] = {{CZ_DRAWN_END_STROKE, "end"}, {CZ_DRAWN_ANTI_CLIMBER_STROKE, "anti-climber"}};
    CzSeries *closure = cz_sheet_add(sheet, CZ_DRAWN_INTERFACE_CLOSURE, interface);
    sheet->plot.y_label = "shortening [mm]";
    if (closure != NULL)
        closure->name = "closure of the interface";
    for (int side = 0; side < 2; side++)
        for (int i = 0; i < 2; i++) {
            const int car = interface + side;
            CzSeries *series = cz_sheet_add(sheet, parts[i].drawn, cz_end_place(car, side == 0));
            char *name = cz_arena_allocate(&sheet->arena, CZ_WHERE_ROOM, 1);
            if (series == NULL || name == NULL)
                continue;
            snprintf(name, CZ_WHERE_ROOM, "%s %s", parts[i].name, run->vehicle[car].name);
            series->name = name;
            series->colour = 1 + i;
            series->dash = side;
        }
    sheet->plot.from_zero = true;
}

void cz_draw_accelerations(CzSheet *sheet, int index) {
    (void)index;
    cz_draw_cars(sheet, CZ_DRAWN_FILTERED_ACCELERATION);
    if (sheet->plot.n_series > 0)
        return;
    cz_draw_cars(sheet, CZ_DRAWN_BODY_ACCELERATION);
    sheet->plot.y_label = "acceleration, not filtered: samples too far apart [g]";
}

void cz_draw_car_acceleration(CzSheet *sheet, int car) {
    const CzVehicleResult *vehicle = &sheet->page->summary->vehicle[car];
    CzSeries *raw = cz_sheet_add(sheet, CZ_DRAWN_BODY_ACCELERATION, car);
    if (raw == NULL)
        return;
    raw->name = "raw, as sampled";
    raw->colour = 5;
    CzSeries *smooth = cz_sheet_add(sheet, CZ_DRAWN_FILTERED_ACCELERATION, car);
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

/* Wheelsets in the order of their largest lift, highest first; only those that leave the rail. */
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

static CzSeries *add_lift(CzSheet *sheet, int vehicle, int axle) {
    CzSeries *series = cz_sheet_add(sheet, CZ_DRAWN_WHEEL_LIFT, cz_wheelset_place(vehicle, axle));
    char *name = cz_arena_allocate(&sheet->arena, CZ_WHERE_ROOM, 1);
    if (series == NULL || name == NULL)
        return NULL;
    snprintf(name, CZ_WHERE_ROOM, "%s_w%d", sheet->page->summary->vehicle[vehicle].name, axle + 1);
    series->name = name;
    return series;
}

void cz_draw_lifts(CzSheet *sheet, int index) {
    (void)index;
    const CzPage *page = sheet->page;
    int vehicle[CZ_MOST_LIFTS], axle[CZ_MOST_LIFTS];
    const int n = rank_lifts(page->summary, CZ_MOST_LIFTS, vehicle, axle);
    for (int i = 0; i < n; i++) {
        CzSeries *series = add_lift(sheet, vehicle[i], axle[i]);
        if (series == NULL)
            continue;
        series->colour = i;
        series->dash = i / CZ_PLOT_N_COLOUR + 2 * (i % 2);
    }
    for (int car = 0; n == 0 && car < page->summary->n_vehicle && sheet->plot.n_series == 0; car++)
        (void)add_lift(sheet, car, 0); /* no wheel lifts: draw one */
    if (isfinite(page->flange_height))
        cz_sheet_add_limit(sheet, page->flange_height * CZ_MILLI_PER_UNIT, "flange height");
    sheet->plot.from_zero = true;
}
