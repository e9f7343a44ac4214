/* Figures of a run: which channels, under which names, against which limits. */
#include "report/charts.h"

#include "base/error.h"
#include "report/plot.h"
#include "report/figure.h"
#include "report/runs.h"
#include "report/units.h"
#include "simulate/filter.h"
#include "simulate/input_curve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { INPUT_POINTS = 600, MOST_LIFTS = 14 };
#define CFC 60.0

/* A plot while its curves are gathered. */
typedef struct Sheet {
    const CzPage *page;
    CzArena arena; /* names and derived curves */
    CzPlot plot;
    CzSeries *series;
    CzPlotLimit limit[4];
    CzPlotBand band[4];
    int room;    /* for series */
    bool failed; /* no memory for a derived curve */
} Sheet;

static bool begin(Sheet *sheet, const CzPage *page, int room, const char *x_label,
                  const char *y_label) {
    *sheet = (Sheet){.page = page, .room = room};
    sheet->plot.x_label = x_label;
    sheet->plot.y_label = y_label;
    sheet->series = cz_arena_allocate(&sheet->arena, (size_t)room + 1, sizeof *sheet->series);
    return sheet->series != NULL;
}

/* Adds a curve over time of the channel "<stem>_<name>_<unit>"; one that was not recorded is left
 * out. */
static CzSeries *add_channel(Sheet *sheet, const char *stem, const char *name, const char *unit) {
    char channel[64];
    snprintf(channel, sizeof channel, "%s%s%s_%s", stem, name[0] != '\0' ? "_" : "", name, unit);
    const double *y = cz_page_channel(sheet->page, "%s", channel);
    char *kept = cz_arena_copy_text(&sheet->arena, channel, strlen(channel));
    if (y == NULL || kept == NULL || sheet->plot.n_series == sheet->room)
        return NULL;
    CzSeries *series = &sheet->series[sheet->plot.n_series++];
    *series = (CzSeries){.name = name,
                         .y_channel = kept,
                         .n = sheet->page->n_sample,
                         .x = sheet->page->time,
                         .y = y};
    return series;
}

/* A car and its mirror image get one colour; the train ahead is dashed. */
static void mark_car(CzSeries *series, const CzModel *model, int car) {
    const bool ahead = car > model->colliding;
    series->colour = ahead ? car - model->colliding - 1 : model->colliding - car;
    series->dash = (ahead ? 1 : 0) + (series->colour >= CZ_PLOT_N_COLOUR ? 2 : 0);
}

static void mark_interface(CzSeries *series, const CzModel *model, int interface) {
    const bool ahead = interface > model->colliding;
    series->colour = abs(interface - model->colliding);
    series->dash = (ahead ? 1 : 0) + (series->colour >= CZ_PLOT_N_COLOUR ? 2 : 0);
}

static void add_limit(Sheet *sheet, double at, const char *name) {
    for (int i = 0; i < sheet->plot.n_limit; i++)
        if (sheet->limit[i].at == at)
            return;
    if (sheet->plot.n_limit < 4)
        sheet->limit[sheet->plot.n_limit++] = (CzPlotLimit){name, at};
}

/* Limits of checks that judged the peak force of an interface. */
static void add_force_limits(Sheet *sheet) {
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

static CzStatus finish(Sheet *sheet, CzChart chart, int index, CzMarkup *markup, CzError *error) {
    char title[160];
    const bool fits = !sheet->arena.out_of_memory && !sheet->failed;
    cz_chart_title(sheet->page, chart, index, sizeof title, title);
    sheet->plot.title = title;
    sheet->plot.is_time = chart != CZ_CHART_FORCE_CLOSURE;
    sheet->plot.series = sheet->series;
    sheet->plot.limit = sheet->limit;
    sheet->plot.band = sheet->band;
    if (fits)
        cz_plot_write(&sheet->plot, markup);
    cz_arena_free(&sheet->arena);
    return fits && !markup->failed ? CZ_OK
                                   : cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for a figure");
}

/* ---- forces and energies ---- */

static double largest(const double *value, int n) {
    double most = 0;
    for (int i = 0; i < n; i++)
        most = value[i] > most ? value[i] : most;
    return most;
}

/* The same interface in the runs beside this one. */
static void add_other_loops(Sheet *sheet, const char *interface) {
    const CzPage *page = sheet->page;
    for (int i = 0; i < page->n_other; i++) {
        const CzRun *run = page->other[i].run;
        const double *closure = cz_run_channel_named(run, "d_%s_mm", interface);
        const double *force = cz_run_channel_named(run, "F_%s_kN", interface);
        if (closure == NULL || force == NULL || sheet->plot.n_series == sheet->room)
            continue;
        sheet->series[sheet->plot.n_series++] = (CzSeries){.name = page->other[i].label,
                                                           .n = cz_run_n_sample(run),
                                                           .x = closure,
                                                           .y = force,
                                                           .colour = i + 1,
                                                           .dash = i + 1};
    }
}

static CzStatus draw_force_closure(Sheet *sheet, int interface, CzError *error) {
    const CzPage *page = sheet->page;
    const char *name = page->summary->interface[interface].name;
    const double *closure = cz_page_channel(page, "d_%s_mm", name);
    const double *force = cz_page_channel(page, "F_%s_kN", name);
    if (closure == NULL || force == NULL)
        return CZ_OK;
    const double longest = largest(closure, page->n_sample);
    double *input = cz_arena_allocate(&sheet->arena, 2 * INPUT_POINTS, sizeof *input);
    char *x_channel = cz_arena_allocate(&sheet->arena, 64, 1);
    if (input == NULL || x_channel == NULL)
        return CZ_OK; /* told by finish */
    snprintf(x_channel, 64, "d_%s_mm", name);
    if (longest > 0) {
        CZ_TRY(cz_input_curve(page->model, interface, longest / CZ_MILLI_PER_UNIT, INPUT_POINTS,
                              input, input + INPUT_POINTS, error));
        const double highest = 1.5 * largest(force, page->n_sample);
        for (int i = 0; i < INPUT_POINTS; i++) {
            input[i] *= CZ_MILLI_PER_UNIT;
            input[INPUT_POINTS + i] = input[INPUT_POINTS + i] / CZ_KILO < highest
                                          ? input[INPUT_POINTS + i] / CZ_KILO
                                          : NAN;
        }
        sheet->series[sheet->plot.n_series++] = (CzSeries){.name = "input, closed slowly",
                                                           .n = INPUT_POINTS,
                                                           .x = input,
                                                           .y = input + INPUT_POINTS,
                                                           .colour = CZ_PLOT_QUIET};
    }
    add_other_loops(sheet, name);
    CzSeries *series = add_channel(sheet, "F", name, "kN");
    if (series != NULL) {
        series->name = page->label != NULL ? page->label : "computed, with unloading";
        series->x = closure;
        series->x_channel = x_channel;
    }
    add_force_limits(sheet);
    sheet->plot.from_zero = true;
    return CZ_OK;
}

static void draw_interfaces(Sheet *sheet, const char *stem, const char *unit) {
    const CzPage *page = sheet->page;
    for (int i = 0; i < page->summary->n_interface; i++) {
        CzSeries *series = add_channel(sheet, stem, page->summary->interface[i].name, unit);
        if (series != NULL)
            mark_interface(series, page->model, i);
    }
    sheet->plot.from_zero = true;
}

static void draw_energy(Sheet *sheet) {
    static const struct {
        const char *stem, *name;
    } parts[] = {{"E_kinetic", "kinetic"},
                 {"E_stored", "stored"},
                 {"E_wheel_rail", "wheel and rail"},
                 {"E_running_gear", "running gear"},
                 {"E_track", "track"}};
    const CzPage *page = sheet->page;
    double *sum = cz_arena_allocate(&sheet->arena, (size_t)page->n_sample, sizeof *sum);
    for (int i = 0; sum != NULL && i < page->summary->n_interface; i++) {
        const double *part = cz_page_channel(page, "E_%s_kJ", page->summary->interface[i].name);
        for (int k = 0; part != NULL && k < page->n_sample; k++)
            sum[k] += part[k];
    }
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        CzSeries *series = add_channel(sheet, parts[i].stem, "", "kJ");
        if (series == NULL)
            continue;
        series->name = parts[i].name;
        series->colour = (int)i;
        series->dash = i == 0 ? 0 : (int)i;
    }
    if (sum != NULL)
        sheet->series[sheet->plot.n_series++] = (CzSeries){.name = "interfaces, dissipated",
                                                           .n = page->n_sample,
                                                           .x = page->time,
                                                           .y = sum,
                                                           .colour = 6};
    sheet->plot.from_zero = true;
}

static void draw_balance(Sheet *sheet) {
    const CzPage *page = sheet->page;
    const double *off = cz_page_channel(page, "E_imbalance_kJ");
    const double initial = page->summary->energy.initial / CZ_KILO;
    double *share = cz_arena_allocate(&sheet->arena, (size_t)page->n_sample, sizeof *share);
    if (off == NULL || share == NULL || !(initial > 0))
        return;
    for (int i = 0; i < page->n_sample; i++)
        share[i] = 1e6 * off[i] / initial;
    sheet->series[sheet->plot.n_series++] =
        (CzSeries){.name = "energy too much", .n = page->n_sample, .x = page->time, .y = share};
}

/* ---- motion ---- */

static void draw_cars(Sheet *sheet, const char *stem, const char *unit) {
    const CzPage *page = sheet->page;
    for (int car = 0; car < page->summary->n_vehicle; car++) {
        CzSeries *series = add_channel(sheet, stem, page->summary->vehicle[car].name, unit);
        if (series != NULL)
            mark_car(series, page->model, car);
    }
}

/* Samples of a channel through the filter; NULL when they are too far apart, or no memory. */
static const double *filtered(Sheet *sheet, const double *raw) {
    const CzPage *page = sheet->page;
    const double step = page->n_sample > 1 ? (page->time[1] - page->time[0]) * 1e-3 : 0;
    double *smooth = cz_arena_allocate(&sheet->arena, (size_t)page->n_sample, sizeof *smooth);
    if (smooth == NULL || !cz_filter_fits(CFC, step))
        return NULL;
    if (cz_filter_cfc(CFC, step, page->n_sample, raw, smooth) != CZ_OK)
        sheet->failed = true;
    return smooth;
}

static void draw_accelerations(Sheet *sheet) {
    draw_cars(sheet, "a", "g");
    for (int i = 0; i < sheet->plot.n_series; i++) {
        const double *smooth = filtered(sheet, sheet->series[i].y);
        sheet->series[i].y = smooth != NULL ? smooth : sheet->series[i].y;
        sheet->series[i].y_channel = smooth != NULL ? NULL : sheet->series[i].y_channel;
    }
    if (sheet->plot.n_series > 0 && sheet->series[0].y_channel != NULL)
        sheet->plot.y_label = "acceleration, not filtered: samples too far apart [g]";
}

static void draw_car_acceleration(Sheet *sheet, int car) {
    const CzVehicleResult *vehicle = &sheet->page->summary->vehicle[car];
    CzSeries *raw = add_channel(sheet, "a", vehicle->name, "g");
    if (raw == NULL)
        return;
    raw->name = "raw, as sampled";
    raw->colour = 5;
    const double *smooth = filtered(sheet, raw->y);
    if (smooth != NULL) {
        CzSeries *series = &sheet->series[sheet->plot.n_series++];
        *series = *raw;
        series->name = "CFC 60";
        series->y_channel = NULL;
        series->y = smooth;
        series->colour = 6;
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

static void draw_lifts(Sheet *sheet) {
    const CzPage *page = sheet->page;
    int vehicle[MOST_LIFTS], axle[MOST_LIFTS];
    const int n = rank_lifts(page->summary, MOST_LIFTS, vehicle, axle);
    double flange = INFINITY;
    for (int car = 0; car < page->model->n_car; car++)
        if (page->model->car[car].model == CZ_MODEL_FULL)
            flange =
                fmin(flange, page->vehicles[page->model->car[car].vehicle].bogie.flange_height);
    for (int i = 0; i < n; i++) {
        char *name = cz_arena_allocate(&sheet->arena, 40, 1);
        if (name == NULL)
            return;
        snprintf(name, 40, "%s_w%d", page->summary->vehicle[vehicle[i]].name, axle[i] + 1);
        CzSeries *series = add_channel(sheet, "z", name, "mm");
        if (series == NULL)
            continue;
        series->colour = i;
        series->dash = i / CZ_PLOT_N_COLOUR + 2 * (i % 2);
    }
    if (n == 0) { /* all wheels stay down: one of them shows it */
        for (int car = 0; car < page->summary->n_vehicle && sheet->plot.n_series == 0; car++) {
            char *name = cz_arena_allocate(&sheet->arena, 40, 1);
            if (name == NULL)
                return;
            snprintf(name, 40, "%s_w1", page->summary->vehicle[car].name);
            add_channel(sheet, "z", name, "mm");
        }
    }
    if (isfinite(flange))
        add_limit(sheet, flange * CZ_MILLI_PER_UNIT, "flange height");
    sheet->plot.from_zero = true;
}

/* ---- the list ---- */

static bool has_any(const CzPage *page, const char *format_of_car, bool of_interfaces) {
    const int n = of_interfaces ? page->summary->n_interface : page->summary->n_vehicle;
    for (int i = 0; i < n; i++) {
        const char *name =
            of_interfaces ? page->summary->interface[i].name : page->summary->vehicle[i].name;
        char channel[96];
        const char *cut = strchr(format_of_car, '*');
        snprintf(channel, sizeof channel, "%.*s%s%s", (int)(cut - format_of_car), format_of_car,
                 name, cut + 1);
        if (cz_page_channel(page, "%s", channel) != NULL)
            return true;
    }
    return false;
}

int cz_chart_hardest_car(const CzRunSummary *run) {
    int found = 0;
    for (int i = 1; i < run->n_vehicle; i++)
        if (run->vehicle[i].mean_deceleration_120ms > run->vehicle[found].mean_deceleration_120ms)
            found = i;
    return found;
}

int cz_chart_count(const CzPage *page, CzChart chart) {
    if (page->n_sample < 2)
        return 0;
    switch (chart) {
    case CZ_CHART_FORCE_CLOSURE:
        return page->summary->n_interface;
    case CZ_CHART_CAR_ACCELERATION:
        return page->summary->n_vehicle;
    case CZ_CHART_WHEEL_LIFT:
        return has_any(page, "z_*_w1_mm", false);
    case CZ_CHART_OVERLAP:
        return has_any(page, "overlap_*_mm", true);
    case CZ_CHART_PITCH:
        return has_any(page, "pitch_*_mrad", false);
    default:
        return 1;
    }
}

void cz_chart_title(const CzPage *page, CzChart chart, int index, size_t room, char *title) {
    static const char *const titles[CZ_N_CHART] = {
        [CZ_CHART_FORCE_CLOSURE] = "Force over closure",
        [CZ_CHART_ENERGY_SHARES] = "Dissipated energy by interface and element",
        [CZ_CHART_ENERGY] = "Energy over time",
        [CZ_CHART_BALANCE] = "Error of the energy balance",
        [CZ_CHART_FORCE] = "Force of the interfaces",
        [CZ_CHART_VELOCITY] = "Speed of the cars",
        [CZ_CHART_ACCELERATION] = "Acceleration of the cars, CFC 60",
        [CZ_CHART_CAR_ACCELERATION] = "Acceleration",
        [CZ_CHART_WHEEL_LIFT] = "Lift of the wheelsets that rise most",
        [CZ_CHART_OVERLAP] = "Overlap of the anti-climbers",
        [CZ_CHART_PITCH] = "Pitch of the cars, nose up"};
    const char *of = chart == CZ_CHART_FORCE_CLOSURE      ? page->summary->interface[index].name
                     : chart == CZ_CHART_CAR_ACCELERATION ? page->summary->vehicle[index].name
                                                          : NULL;
    snprintf(title, room, "%s%s%s", titles[chart], of != NULL ? ", " : "", of != NULL ? of : "");
}

static CzStatus draw(Sheet *sheet, CzChart chart, int index, CzError *error) {
    switch (chart) {
    case CZ_CHART_FORCE_CLOSURE:
        return draw_force_closure(sheet, index, error);
    case CZ_CHART_ENERGY:
        draw_energy(sheet);
        break;
    case CZ_CHART_BALANCE:
        draw_balance(sheet);
        break;
    case CZ_CHART_FORCE:
        draw_interfaces(sheet, "F", "kN");
        add_force_limits(sheet);
        break;
    case CZ_CHART_VELOCITY:
        draw_cars(sheet, "v", "m_s");
        break;
    case CZ_CHART_ACCELERATION:
        draw_accelerations(sheet);
        break;
    case CZ_CHART_CAR_ACCELERATION:
        draw_car_acceleration(sheet, index);
        break;
    case CZ_CHART_WHEEL_LIFT:
        draw_lifts(sheet);
        break;
    case CZ_CHART_OVERLAP:
        draw_interfaces(sheet, "overlap", "mm");
        break;
    default:
        draw_cars(sheet, "pitch", "mrad");
    }
    return CZ_OK;
}

CzStatus cz_chart_write(const CzPage *page, CzChart chart, int index, CzMarkup *markup,
                        CzError *error) {
    static const char *const y_labels[CZ_N_CHART] = {
        [CZ_CHART_FORCE_CLOSURE] = "force [kN]",
        [CZ_CHART_ENERGY] = "energy [kJ]",
        [CZ_CHART_BALANCE] = "of the initial energy [ppm]",
        [CZ_CHART_FORCE] = "force [kN]",
        [CZ_CHART_VELOCITY] = "speed [m/s]",
        [CZ_CHART_ACCELERATION] = "acceleration [g]",
        [CZ_CHART_CAR_ACCELERATION] = "acceleration [g]",
        [CZ_CHART_WHEEL_LIFT] = "lift [mm]",
        [CZ_CHART_OVERLAP] = "overlap [mm]",
        [CZ_CHART_PITCH] = "pitch [mrad]"};
    if (chart == CZ_CHART_ENERGY_SHARES) {
        cz_chart_write_shares(page, markup);
        return CZ_OK;
    }
    Sheet sheet;
    const char *x_label = chart == CZ_CHART_FORCE_CLOSURE ? "closure [mm]" : "time [ms]";
    if (!begin(&sheet, page, page->summary->n_vehicle + MOST_LIFTS + page->n_other, x_label,
               y_labels[chart]))
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for a figure");
    const CzStatus status = draw(&sheet, chart, index, error);
    if (status != CZ_OK) {
        cz_arena_free(&sheet.arena);
        return status;
    }
    return finish(&sheet, chart, index, markup, error);
}
