/* Figures of forces and energies. */
#include "report/sheet.h"

#include "base/error.h"
#include "report/runs.h"
#include "report/units.h"
#include "simulate/input_curve.h"

#include <math.h>
#include <string.h>

enum { INPUT_POINTS = 600 };

/* Limits of checks that judged the peak force of an interface. */
void cz_draw_force_limits(CzSheet *sheet) {
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
                cz_sheet_add_limit(sheet, check->limit, check->name);
        }
    }
}

static double largest(const double *value, int n) {
    double most = 0;
    for (int i = 0; i < n; i++)
        most = value[i] > most ? value[i] : most;
    return most;
}

/* The same interface in the runs beside this one. */
static void add_other_loops(CzSheet *sheet, int interface) {
    const CzPage *page = sheet->page;
    for (int i = 0; i < page->n_other; i++) {
        const CzRun *run = page->other[i].run;
        const double *closure =
            cz_drawn_beside(page->summary, CZ_CHANNEL_INTERFACE_CLOSURE, interface, run);
        const double *force =
            cz_drawn_beside(page->summary, CZ_CHANNEL_INTERFACE_FORCE, interface, run);
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

CzStatus cz_draw_force_closure(CzSheet *sheet, int interface, CzError *error) {
    const CzPage *page = sheet->page;
    const double *closure = cz_page_values(page, CZ_DRAWN_INTERFACE_CLOSURE, interface);
    const double *force = cz_page_values(page, CZ_DRAWN_INTERFACE_FORCE, interface);
    if (closure == NULL || force == NULL)
        return CZ_OK;
    const double longest = largest(closure, page->n_sample);
    double *input = cz_arena_allocate(&sheet->arena, 2 * INPUT_POINTS, sizeof *input);
    if (input == NULL)
        return CZ_OK; /* told by finish */
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
    add_other_loops(sheet, interface);
    CzSeries *series = cz_sheet_add(sheet, CZ_DRAWN_INTERFACE_FORCE, interface);
    if (series != NULL) {
        series->name = page->label != NULL ? page->label : "computed, with unloading";
        series->x = closure;
        series->x_channel = cz_sheet_name(sheet, CZ_DRAWN_INTERFACE_CLOSURE, interface);
        cz_sheet_split_beyond(sheet, series);
    }
    cz_draw_force_limits(sheet);
    sheet->plot.from_zero = true;
    return CZ_OK;
}

void cz_draw_interfaces(CzSheet *sheet, CzDrawn drawn) {
    const CzPage *page = sheet->page;
    for (int i = 0; i < page->summary->n_interface; i++) {
        CzSeries *series = cz_sheet_add(sheet, drawn, i);
        if (series != NULL)
            cz_sheet_mark_interface(series, page->model, i);
    }
    sheet->plot.from_zero = true;
}

void cz_draw_energy(CzSheet *sheet) {
    static const struct {
        CzDrawn drawn;
        const char *name;
    } parts[] = {{CZ_DRAWN_KINETIC_ENERGY, "kinetic"},
                 {CZ_DRAWN_STORED_ENERGY, "stored"},
                 {CZ_DRAWN_WHEEL_RAIL_ENERGY, "wheel and rail"},
                 {CZ_DRAWN_RUNNING_GEAR_ENERGY, "running gear"},
                 {CZ_DRAWN_TRACK_ENERGY, "track"},
                 {CZ_DRAWN_INTERFACES_ENERGY, "interfaces, dissipated"}};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        CzSeries *series = cz_sheet_add(sheet, parts[i].drawn, 0);
        if (series == NULL)
            continue;
        series->name = parts[i].name;
        const bool is_last = i + 1 == sizeof parts / sizeof *parts;
        series->colour = is_last ? 6 : (int)i;
        series->dash = i == 0 || is_last ? 0 : (int)i;
    }
    sheet->plot.from_zero = true;
}

void cz_draw_balance(CzSheet *sheet) {
    CzSeries *series = cz_sheet_add(sheet, CZ_DRAWN_BALANCE_ERROR, 0);
    if (series != NULL)
        series->name = "energy too much";
}
