/* Figures of forces and energies. */
#include "report/sheet.h"

#include "report/runs.h"
#include "report/units.h"

#include <math.h>
#include <string.h>

/* Adds the limits of the checks of peak forces of interfaces. */
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

/* Adds the curves of the same interface in the other runs. */
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

void cz_draw_force_closure(CzSheet *sheet, int interface) {
    const CzPage *page = sheet->page;
    const CzInputCurve *input = &page->input[interface];
    sheet->plot.from_zero = true;
    if (input->n > 0 && sheet->room > 0)
        sheet->series[sheet->plot.n_series++] = (CzSeries){.name = "input, closed slowly",
                                                           .n = input->n,
                                                           .x = input->points,
                                                           .y = input->points + input->n,
                                                           .colour = CZ_PLOT_QUIET};
    add_other_loops(sheet, interface);
    CzSeries *series = cz_sheet_add(sheet, CZ_DRAWN_INTERFACE_FORCE, interface);
    if (series != NULL) {
        series->name = page->label != NULL ? page->label : "computed, with unloading";
        series->x = cz_page_values(page, CZ_DRAWN_INTERFACE_CLOSURE, interface);
        series->x_channel = cz_sheet_name(sheet, CZ_DRAWN_INTERFACE_CLOSURE, interface);
        cz_sheet_split_beyond(sheet, series);
    }
    cz_draw_force_limits(sheet);
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

void cz_draw_energy(CzSheet *sheet, int index) {
    (void)index;
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

void cz_draw_balance(CzSheet *sheet, int index) {
    (void)index;
    CzSeries *series = cz_sheet_add(sheet, CZ_DRAWN_BALANCE_ERROR, 0);
    if (series != NULL)
        series->name = "energy surplus";
}
