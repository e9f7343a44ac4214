/* Figures of a run: which there are, and what each is made of. */
#include "report/charts.h"

#include "base/error.h"
#include "report/figure.h"
#include "report/chart_curves.h"
#include "report/sheet.h"

#include <string.h>

/* Whether something is drawn at any of n places. */
static int has_any(const CzPage *page, CzDrawn drawn, int n_place) {
    for (int place = 0; place < n_place; place++)
        if (cz_page_values(page, drawn, place) != NULL)
            return 1;
    return 0;
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
    case CZ_CHART_SHORTENING:
        return page->summary->n_interface;
    case CZ_CHART_CAR_ACCELERATION:
        return page->summary->n_vehicle;
    case CZ_CHART_WHEEL_LIFT:
        return has_any(page, CZ_DRAWN_WHEEL_LIFT, 4 * page->summary->n_vehicle);
    case CZ_CHART_OVERLAP:
        return has_any(page, CZ_DRAWN_ANTI_CLIMBER_OVERLAP, page->summary->n_interface);
    case CZ_CHART_PITCH:
        return has_any(page, CZ_DRAWN_BODY_PITCH, page->summary->n_vehicle);
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
        [CZ_CHART_DISPLACEMENT] = "Displacement of the cars",
        [CZ_CHART_SHORTENING] = "Shortening",
        [CZ_CHART_FRAMES] = "The collision from the side",
        [CZ_CHART_PANELS] = "Force, speed, displacement and shortening",
        [CZ_CHART_WHEEL_LIFT] = "Lift of the wheelsets that rise most",
        [CZ_CHART_OVERLAP] = "Overlap of the anti-climbers",
        [CZ_CHART_PITCH] = "Pitch of the cars, nose up"};
    const bool of_interface = chart == CZ_CHART_FORCE_CLOSURE || chart == CZ_CHART_SHORTENING;
    const char *of = of_interface                         ? page->summary->interface[index].name
                     : chart == CZ_CHART_CAR_ACCELERATION ? page->summary->vehicle[index].name
                                                          : NULL;
    snprintf(title, room, "%s%s%s", titles[chart], of != NULL ? ", " : "", of != NULL ? of : "");
}

static CzStatus draw(CzSheet *sheet, CzChart chart, int index, CzError *error) {
    switch (chart) {
    case CZ_CHART_FORCE_CLOSURE:
        return cz_draw_force_closure(sheet, index, error);
    case CZ_CHART_ENERGY:
        cz_draw_energy(sheet);
        break;
    case CZ_CHART_BALANCE:
        cz_draw_balance(sheet);
        break;
    case CZ_CHART_FORCE:
        cz_draw_interfaces(sheet, CZ_DRAWN_INTERFACE_FORCE);
        cz_draw_force_limits(sheet);
        break;
    case CZ_CHART_VELOCITY:
        cz_draw_cars(sheet, CZ_DRAWN_BODY_SPEED);
        break;
    case CZ_CHART_ACCELERATION:
        cz_draw_accelerations(sheet);
        break;
    case CZ_CHART_CAR_ACCELERATION:
        cz_draw_car_acceleration(sheet, index);
        break;
    case CZ_CHART_DISPLACEMENT:
        cz_draw_cars(sheet, CZ_DRAWN_BODY_DISPLACEMENT);
        break;
    case CZ_CHART_SHORTENING:
        cz_draw_shortening(sheet, index);
        break;
    case CZ_CHART_WHEEL_LIFT:
        cz_draw_lifts(sheet);
        break;
    case CZ_CHART_OVERLAP:
        cz_draw_interfaces(sheet, CZ_DRAWN_ANTI_CLIMBER_OVERLAP);
        break;
    default:
        cz_draw_cars(sheet, CZ_DRAWN_BODY_PITCH);
    }
    return CZ_OK;
}

/* Measured curves over the computed ones. */
static void add_measured(CzSheet *sheet, CzChart chart) {
    const CzPage *page = sheet->page;
    int n = 0;
    for (int i = 0; i < page->n_measured; i++) {
        const CzChartCurve *measured = &page->measured[i];
        if (measured->chart != chart || sheet->plot.n_series == sheet->room)
            continue;
        sheet->series[sheet->plot.n_series++] = (CzSeries){.name = measured->label,
                                                           .n = measured->curve->n,
                                                           .x = measured->curve->x,
                                                           .y = measured->curve->y,
                                                           .colour = n < 4 ? 6 : 4,
                                                           .dash = 2 + n};
        n++;
    }
}

const CzChartAxes *cz_chart_axes(CzChart chart) {
    static const CzChartAxes axes[CZ_N_CHART] = {
        [CZ_CHART_FORCE_CLOSURE] = {"length", 1e-3, "force", 1e3},
        [CZ_CHART_ENERGY] = {"time", 1e-3, "energy", 1e3},
        [CZ_CHART_FORCE] = {"time", 1e-3, "force", 1e3},
        [CZ_CHART_VELOCITY] = {"time", 1e-3, "speed", 1},
        [CZ_CHART_ACCELERATION] = {"time", 1e-3, "acceleration", 9.80665},
        [CZ_CHART_CAR_ACCELERATION] = {"time", 1e-3, "acceleration", 9.80665},
        [CZ_CHART_DISPLACEMENT] = {"time", 1e-3, "length", 1},
        [CZ_CHART_SHORTENING] = {"time", 1e-3, "length", 1e-3},
        [CZ_CHART_WHEEL_LIFT] = {"time", 1e-3, "length", 1e-3},
        [CZ_CHART_OVERLAP] = {"time", 1e-3, "length", 1e-3},
        [CZ_CHART_PITCH] = {"time", 1e-3, "angle", 1e-3}};
    return axes[chart].x_quantity != NULL ? &axes[chart] : NULL;
}

/* Four figures of one collision in two rows. */
static CzStatus write_panels(const CzPage *page, int interface, CzMarkup *markup, CzError *error) {
    static const CzChart charts[] = {CZ_CHART_FORCE, CZ_CHART_VELOCITY, CZ_CHART_DISPLACEMENT,
                                     CZ_CHART_SHORTENING};
    const double slot = 340;
    char title[CZ_SENTENCE_ROOM], text[CZ_SENTENCE_ROOM + 8];
    CzStatus status = CZ_OK;
    cz_chart_title(page, CZ_CHART_PANELS, 0, sizeof title, title);
    cz_svg_open_tiles(markup, title, 4, slot);
    cz_markup_attribute(markup, "class", "panels");
    cz_markup_line(markup);
    for (int i = 0; i < 4 && status == CZ_OK; i++) {
        const int index = charts[i] == CZ_CHART_SHORTENING ? interface : 0;
        cz_chart_title(page, charts[i], index, sizeof title, title);
        snprintf(text, sizeof text, "(%c) %s", "abcd"[i], title);
        cz_svg_open_tile(markup, i, slot, 8, text);
        status = cz_chart_write(page, charts[i], index, markup, error);
        cz_markup_close(markup);
    }
    cz_markup_close(markup);
    cz_markup_line(markup);
    return status;
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
        [CZ_CHART_DISPLACEMENT] = "displacement [m]",
        [CZ_CHART_SHORTENING] = "shortening [mm]",
        [CZ_CHART_WHEEL_LIFT] = "lift [mm]",
        [CZ_CHART_OVERLAP] = "overlap [mm]",
        [CZ_CHART_PITCH] = "pitch [mrad]"};
    if (chart == CZ_CHART_ENERGY_SHARES) {
        cz_chart_write_shares(page, markup);
        return CZ_OK;
    }
    if (chart == CZ_CHART_FRAMES) {
        cz_chart_write_frames(page, index, markup);
        return CZ_OK;
    }
    if (chart == CZ_CHART_PANELS)
        return write_panels(page, index, markup, error);
    CzSheet sheet;
    const char *x_label = chart == CZ_CHART_FORCE_CLOSURE ? "closure [mm]" : "time [ms]";
    if (!cz_sheet_begin(&sheet, page,
                        page->summary->n_vehicle + CZ_MOST_LIFTS + page->n_other + page->n_measured,
                        x_label, y_labels[chart]))
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for a figure");
    const CzStatus status = draw(&sheet, chart, index, error);
    if (status != CZ_OK) {
        cz_arena_free(&sheet.arena);
        return status;
    }
    add_measured(&sheet, chart);
    return cz_sheet_finish(&sheet, chart, index, markup, error);
}
