/* Draws figures: the curves, limits and shaded times of each. */
#include "report/charts.h"

#include "base/arena.h"
#include "report/plot.h"
#include "report/units.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_LIFTS = 14 /* wheelsets in the figure of lifts */ };

/* A figure while its curves are collected. */
typedef struct Sheet {
    const CzPage *page;
    CzArena arena; /* names and derived curves */
    CzPlot plot;
    CzSeries *series;
    int room; /* for series; 0 without memory */
    CzPlotLimit limit[4];
    CzPlotBand band[4];
} Sheet;

/* ---- the sheet ---- */

/* A further curve; NULL where there is no room. */
static CzSeries *put(Sheet *sheet, CzSeries series) {
    if (sheet->plot.n_series == sheet->room)
        return NULL;
    CzSeries *added = &sheet->series[sheet->plot.n_series++];
    *added = series;
    return added;
}

/* Name of a curve for the cursor of the page, stored with the figure; NULL without memory, and for
 * a run that the cursor does not show. */
static const char *channel_name(Sheet *sheet, CzDrawn drawn, int place) {
    char name[CZ_CHANNEL_SIZE];
    if (sheet->page->is_beside)
        return NULL;
    cz_drawn_name(sheet->page->summary, drawn, place, name);
    return cz_arena_copy_text(&sheet->arena, name, strlen(name));
}

/* Adds a curve over time, named after its place; NULL when there is none. */
static CzSeries *add(Sheet *sheet, CzDrawn drawn, int place) {
    const CzPage *page = sheet->page;
    const double *y = cz_page_values(page, drawn, place);
    const char *name = cz_run_place_name(page->summary, cz_drawn_info(drawn)->at, place);
    return y == NULL ? NULL
                     : put(sheet, (CzSeries){.name = name,
                                             .y_channel = channel_name(sheet, drawn, place),
                                             .n = page->n_sample,
                                             .x = page->time,
                                             .y = y});
}

/* Names a curve "first second" after two texts. */
static void rename_curve(Sheet *sheet, CzSeries *series, const char *format, const char *first,
                         const char *second) {
    char name[CZ_WHERE_SIZE];
    if (series == NULL)
        return;
    snprintf(name, sizeof name, format, first, second);
    series->name = cz_arena_copy_text(&sheet->arena, name, strlen(name));
}

static void add_limit(Sheet *sheet, double at, const char *name) {
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

/* Splits off the part of a curve beyond model validity, dotted and with its own name. */
static void split_beyond(Sheet *sheet, CzSeries *series) {
    const CzPage *page = sheet->page;
    if (!page->summary->beyond_validity || sheet->plot.n_series == sheet->room)
        return;
    double *part = cz_arena_allocate(&sheet->arena, 2 * (size_t)series->n, sizeof *part);
    if (part == NULL)
        return; /* reported with the figure */
    const double from = page->summary->beyond_validity_time * CZ_MILLI_PER_UNIT;
    for (int i = 0; i < series->n; i++) {
        const bool late = page->time[i] > from;
        part[i] = late ? NAN : series->y[i];
        part[series->n + i] = late ? series->y[i] : NAN;
    }
    CzSeries *late = put(sheet, *series);
    late->name = "beyond the model";
    late->y = part + series->n;
    late->dash = 2;
    series->y = part;
}

/* ---- curves of one quantity ---- */

/* The curves of all interfaces or cars over time, or over another quantity. Those at the same
 * distance from the collision have the same colour; the front train is dashed. */
static void draw_all_over(Sheet *sheet, CzDrawn over, CzDrawn drawn) {
    const CzPage *page = sheet->page;
    const bool of_interface = cz_drawn_info(drawn)->at == CZ_AT_INTERFACE;
    const int n = of_interface ? page->summary->n_interface : page->summary->n_vehicle;
    for (int i = 0; i < n; i++) {
        CzSeries *series = add(sheet, drawn, i);
        const int before = page->model->colliding - i;
        if (series == NULL)
            continue;
        if (over != CZ_DRAWN_TIME) {
            series->x = cz_page_values(page, over, i);
            series->y_channel = NULL; /* the cursor of the page has no values of it */
        }
        series->colour = before >= 0 ? before : of_interface ? -before : -before - 1;
        series->dash = (before < 0 ? 1 : 0) + (series->colour >= CZ_PLOT_N_COLOUR ? 2 : 0);
    }
    sheet->plot.from_zero |= of_interface;
}

static void draw_all(Sheet *sheet, CzDrawn drawn) {
    draw_all_over(sheet, CZ_DRAWN_TIME, drawn);
}

/* Curves of figures that show several quantities of one place. */
static const struct {
    CzChart chart;
    CzDrawn drawn;
    const char *name;
    int colour, dash;
} parts[] = {{CZ_CHART_ENERGY, CZ_DRAWN_KINETIC_ENERGY, "kinetic", 0, 0},
             {CZ_CHART_ENERGY, CZ_DRAWN_STORED_ENERGY, "stored", 1, 1},
             {CZ_CHART_ENERGY, CZ_DRAWN_WHEEL_RAIL_ENERGY, "wheel and rail", 2, 2},
             {CZ_CHART_ENERGY, CZ_DRAWN_RUNNING_GEAR_ENERGY, "running gear", 3, 3},
             {CZ_CHART_ENERGY, CZ_DRAWN_TRACK_ENERGY, "track", 4, 4},
             {CZ_CHART_ENERGY, CZ_DRAWN_INTERFACES_ENERGY, "interfaces, dissipated", 6, 0},
             {CZ_CHART_BALANCE, CZ_DRAWN_BALANCE_ERROR, "energy surplus", 0, 0},
             {CZ_CHART_CAR_ACCELERATION, CZ_DRAWN_BODY_ACCELERATION, "raw, as sampled", 5, 0},
             {CZ_CHART_CAR_ACCELERATION, CZ_DRAWN_FILTERED_ACCELERATION, "CFC 60", 6, 0},
             {CZ_CHART_SHORTENING, CZ_DRAWN_INTERFACE_CLOSURE, "closure of the interface", 0, 0}};

static void draw_parts(Sheet *sheet, CzChart chart, int place) {
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        CzSeries *series = parts[i].chart == chart ? add(sheet, parts[i].drawn, place) : NULL;
        if (series == NULL)
            continue;
        series->name = parts[i].name;
        series->colour = parts[i].colour;
        series->dash = parts[i].dash;
    }
}

/* ---- limits, shaded times and curves for comparison ---- */

/* Adds the limits of the checks of peak forces of interfaces. */
static void draw_force_limits(Sheet *sheet) {
    const CzPage *page = sheet->page;
    for (int i = 0; i < page->evaluation->n_check; i++) {
        const CzCheckResult *check = &page->evaluation->check[i];
        for (int k = 0; k < page->summary->n_interface; k++) {
            const CzInterfaceResult *interface = &page->summary->interface[k];
            const double peak = interface->peak_force / CZ_KILO;
            if (!check->is_minimum && check->unit != NULL && strcmp(check->unit, "kN") == 0 &&
                check->scenario != NULL && strcmp(check->scenario, page->summary->scenario) == 0 &&
                strcmp(check->where, interface->name) == 0 &&
                fabs(check->value - peak) <= 1e-9 * fabs(peak))
                add_limit(sheet, check->limit, check->name);
        }
    }
}

/* Adds the curves of the same interface in the other runs. */
static void draw_other_loops(Sheet *sheet, int interface) {
    const CzPage *page = sheet->page;
    for (int i = 0; i < page->n_other; i++) {
        const CzRun *run = page->other[i].run;
        const double *closure =
            cz_drawn_beside(page->summary, CZ_CHANNEL_INTERFACE_CLOSURE, interface, run);
        const double *force =
            cz_drawn_beside(page->summary, CZ_CHANNEL_INTERFACE_FORCE, interface, run);
        if (closure != NULL && force != NULL)
            (void)put(sheet, (CzSeries){.name = page->other[i].label,
                                        .n = cz_run_n_sample(run),
                                        .x = closure,
                                        .y = force,
                                        .colour = i + 1,
                                        .dash = i + 1});
    }
}

static void draw_force_closure(Sheet *sheet, int interface) {
    const CzPage *page = sheet->page;
    const CzInputCurve *input = &page->input[interface];
    if (input->n > 0)
        (void)put(sheet, (CzSeries){.name = "input, closed slowly",
                                    .n = input->n,
                                    .x = input->points,
                                    .y = input->points + input->n,
                                    .colour = CZ_PLOT_QUIET});
    draw_other_loops(sheet, interface);
    CzSeries *series = add(sheet, CZ_DRAWN_INTERFACE_FORCE, interface);
    if (series != NULL) {
        series->name = page->label != NULL ? page->label : "computed, with unloading";
        series->x = cz_page_values(page, CZ_DRAWN_INTERFACE_CLOSURE, interface);
        series->x_channel = channel_name(sheet, CZ_DRAWN_INTERFACE_CLOSURE, interface);
        split_beyond(sheet, series);
    }
    draw_force_limits(sheet);
}

static void draw_forces(Sheet *sheet, int index) {
    (void)index;
    draw_all(sheet, CZ_DRAWN_INTERFACE_FORCE);
    draw_force_limits(sheet);
}

/* Strokes of the ends of an interface and of their anti-climbers; the first side is the front of
 * the rear car. */
static void draw_strokes(Sheet *sheet, int interface) {
    sheet->plot.y_label = "shortening [mm]";
    for (int side = 0; side < 2; side++)
        for (int i = 0; i < 2; i++) {
            const int car = interface + side;
            CzSeries *series =
                add(sheet, i == 0 ? CZ_DRAWN_END_STROKE : CZ_DRAWN_ANTI_CLIMBER_STROKE,
                    cz_end_place(car, side == 0));
            if (series == NULL)
                continue;
            rename_curve(sheet, series, "%s %s", i == 0 ? "end" : "anti-climber",
                         sheet->page->summary->vehicle[car].name);
            series->colour = 1 + i;
            series->dash = side;
        }
}

static void draw_accelerations(Sheet *sheet, int index) {
    (void)index;
    draw_all(sheet, CZ_DRAWN_FILTERED_ACCELERATION);
    if (sheet->plot.n_series > 0)
        return;
    draw_all(sheet, CZ_DRAWN_BODY_ACCELERATION);
    sheet->plot.y_label = "acceleration, not filtered: samples too far apart [g]";
}

static void draw_impacts(Sheet *sheet, int index) {
    (void)index;
    draw_all_over(sheet, CZ_DRAWN_FREE_FLIGHT, CZ_DRAWN_OCCUPANT_SPEED);
}

/* Shades the windows of the mean decelerations of a car. */
static void draw_windows(Sheet *sheet, int car) {
    const CzVehicleResult *vehicle = &sheet->page->summary->vehicle[car];
    const struct {
        const char *name;
        const double *window;
    } windows[] = {{"worst 120 ms", vehicle->window_120ms}, {"contact", vehicle->contact_window}};
    for (int i = 0; i < 2 && sheet->plot.n_series > 0; i++)
        if (windows[i].window[1] > windows[i].window[0])
            sheet->band[sheet->plot.n_band++] =
                (CzPlotBand){windows[i].name, 1e3 * windows[i].window[0],
                             1e3 * windows[i].window[1], i == 0 ? 1 : 2};
}

static double lift_of(const CzRunSummary *run, int wheelset) {
    return run->vehicle[wheelset / 4].wheel_lift[wheelset % 4];
}

/* Wheelsets, four a vehicle, in the order of their largest lift, highest first; only those that
 * leave the rail. */
static int rank_lifts(const CzRunSummary *run, int wheelset[MAX_LIFTS]) {
    int n = 0;
    for (int i = 0; i < 4 * run->n_vehicle; i++) {
        const double lift = lift_of(run, i);
        if (!(lift > 1e-5))
            continue;
        int at = n;
        while (at > 0 && lift_of(run, wheelset[at - 1]) < lift)
            at--;
        if (at == MAX_LIFTS)
            continue;
        n += n < MAX_LIFTS;
        memmove(&wheelset[at + 1], &wheelset[at], (size_t)(n - 1 - at) * sizeof *wheelset);
        wheelset[at] = i;
    }
    return n;
}

static CzSeries *add_lift(Sheet *sheet, int wheelset) {
    static const char *const axles[] = {"w1", "w2", "w3", "w4"};
    const int car = wheelset / 4, axle = wheelset % 4;
    CzSeries *series = add(sheet, CZ_DRAWN_WHEEL_LIFT, cz_wheelset_place(car, axle));
    rename_curve(sheet, series, "%s_%s", sheet->page->summary->vehicle[car].name, axles[axle]);
    return series;
}

static void draw_lifts(Sheet *sheet, int index) {
    (void)index;
    const CzPage *page = sheet->page;
    int wheelset[MAX_LIFTS];
    const int n = rank_lifts(page->summary, wheelset);
    for (int i = 0; i < n; i++) {
        CzSeries *series = add_lift(sheet, wheelset[i]);
        if (series == NULL)
            continue;
        series->colour = i;
        series->dash = i / CZ_PLOT_N_COLOUR + 2 * (i % 2);
    }
    for (int car = 0; n == 0 && car < page->summary->n_vehicle && sheet->plot.n_series == 0; car++)
        (void)add_lift(sheet, 4 * car); /* no wheel lifts: draw one */
    if (isfinite(page->flange_height))
        add_limit(sheet, page->flange_height * CZ_MILLI_PER_UNIT, "flange height");
}

/* Measured curves over the computed ones. */
static void draw_measured(Sheet *sheet, CzChart chart) {
    const CzPage *page = sheet->page;
    for (int i = 0, n = 0; i < page->n_measured; i++) {
        const CzChartCurve *measured = &page->measured[i];
        if (measured->chart == chart && put(sheet, (CzSeries){.name = measured->label,
                                                              .n = measured->curve->n,
                                                              .x = measured->curve->x,
                                                              .y = measured->curve->y,
                                                              .colour = n < 4 ? 6 : 4,
                                                              .dash = 2 + n}) != NULL)
            n++;
    }
}

/* ---- the figure ---- */

/* Parts and additions of figures; those with neither show the quantity of their y axis. */
static const struct {
    void (*draw)(Sheet *sheet, int index);
    bool from_zero;
} kinds[CZ_N_CHART] = {[CZ_CHART_FORCE_CLOSURE] = {draw_force_closure, true},
                       [CZ_CHART_ENERGY] = {NULL, true},
                       [CZ_CHART_FORCE] = {draw_forces, true},
                       [CZ_CHART_ACCELERATION] = {draw_accelerations, false},
                       [CZ_CHART_CAR_ACCELERATION] = {draw_windows, false},
                       [CZ_CHART_SECONDARY_IMPACT] = {draw_impacts, true},
                       [CZ_CHART_SHORTENING] = {draw_strokes, true},
                       [CZ_CHART_WHEEL_LIFT] = {draw_lifts, true}};

static void collect(Sheet *sheet, CzChart chart, int index) {
    sheet->plot.from_zero = kinds[chart].from_zero;
    draw_parts(sheet, chart, index);
    if (kinds[chart].draw != NULL)
        kinds[chart].draw(sheet, index);
    else if (chart != CZ_CHART_ENERGY && chart != CZ_CHART_BALANCE)
        draw_all(sheet, cz_charts[chart].y);
    draw_measured(sheet, chart);
    if (sheet->plot.is_time && sheet->page->summary->beyond_validity && sheet->page->n_sample > 0)
        sheet->band[sheet->plot.n_band++] =
            cz_band_beyond(sheet->page->summary, sheet->page->time, sheet->page->n_sample);
}

/* Collects the curves of a figure, then draws it. */
static void write_curves(const CzPage *page, CzChart chart, int index, CzMarkup *markup) {
    const CzChartInfo *info = &cz_charts[chart];
    const int room = page->summary->n_vehicle + MAX_LIFTS + page->n_other + page->n_measured;
    char title[CZ_SENTENCE_SIZE], label[2][CZ_DRAWN_LABEL];
    cz_chart_title(page, chart, index, sizeof title, title);
    Sheet sheet = {.page = page,
                   .plot = {.title = title,
                            .x_label = cz_drawn_label(info->x, label[0]),
                            .y_label = cz_drawn_label(info->y, label[1]),
                            .is_time = info->x == CZ_DRAWN_TIME,
                            .is_still = page->is_beside}};
    sheet.series = cz_arena_allocate(&sheet.arena, (size_t)room, sizeof *sheet.series);
    sheet.room = sheet.series != NULL ? room : 0;
    collect(&sheet, chart, index);
    sheet.plot.series = sheet.series;
    sheet.plot.limit = sheet.limit;
    sheet.plot.band = sheet.band;
    if (sheet.arena.out_of_memory)
        markup->failed = true;
    else
        cz_plot_write(&sheet.plot, markup);
    cz_arena_free(&sheet.arena);
}

/* ---- all figures ---- */

/* Four figures of one collision in two rows. */
static void write_panels(const CzPage *page, int interface, CzMarkup *markup) {
    static const CzChart panels[] = {CZ_CHART_FORCE, CZ_CHART_VELOCITY, CZ_CHART_DISPLACEMENT,
                                     CZ_CHART_SHORTENING};
    const double slot = 340;
    char title[CZ_SENTENCE_SIZE], text[CZ_SENTENCE_SIZE + 8];
    cz_chart_title(page, CZ_CHART_PANELS, 0, sizeof title, title);
    cz_svg_open_tiles(markup, title, 4, slot);
    cz_markup_write(markup, " class='panels'>\n");
    for (int i = 0; i < 4; i++) {
        const int index = cz_charts[panels[i]].count == CZ_CHART_PER_INTERFACE ? interface : 0;
        cz_chart_title(page, panels[i], index, sizeof title, title);
        snprintf(text, sizeof text, "(%c) %s", "abcd"[i], title);
        cz_svg_open_tile(markup, i, slot, 8, text);
        cz_chart_write(page, panels[i], index, markup);
        cz_markup_write(markup, "</svg>");
    }
    cz_markup_write(markup, "</svg>\n");
}

void cz_chart_write(const CzPage *page, CzChart chart, int index, CzMarkup *markup) {
    if (cz_charts[chart].is_of_curves)
        write_curves(page, chart, index, markup);
    else if (chart == CZ_CHART_ENERGY_SHARES)
        cz_chart_write_shares(page, markup);
    else if (chart == CZ_CHART_FRAMES)
        cz_chart_write_frames(page, index, markup);
    else
        write_panels(page, index, markup);
}
