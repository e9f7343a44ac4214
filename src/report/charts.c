/* The figures of a run and their curves. */
#include "report/charts.h"

#include "base/error.h"
#include "report/figure.h"
#include "report/sheet.h"
#include "text/curve_title.h"

#include <string.h>

const CzChartInfo *cz_chart_info(CzChart chart) {
    static const CzChartInfo charts[CZ_N_CHART] = {
#define AXES_DRAWING .is_of_curves = false
#define AXES_CURVES(x_axis, y_axis)                                                                \
    .is_of_curves = true, .x = CZ_DRAWN_##x_axis, .y = CZ_DRAWN_##y_axis
#define CZ_CHART(constant, name, title, number, axes, doc)                                         \
    {name, title, CZ_CHART_##number, AXES_##axes},
#include "crushzone/charts.def"
#undef CZ_CHART
    };
    return &charts[chart];
}

bool cz_chart_axes(CzChart chart, CzChartAxes *axes) {
    const CzChartInfo *info = cz_chart_info(chart);
    const CzUnit *x = cz_curve_unit_find(CZ_N_DIMENSION, cz_drawn_info(info->x)->unit);
    const CzUnit *y = cz_curve_unit_find(CZ_N_DIMENSION, cz_drawn_info(info->y)->unit);
    if (!info->is_of_curves || x == NULL || y == NULL)
        return false;
    *axes = (CzChartAxes){cz_dimension_text[x->dimension], x->si, cz_dimension_text[y->dimension],
                          y->si};
    return true;
}

int cz_chart_hardest_car(const CzRunSummary *run) {
    int found = 0;
    for (int i = 1; i < run->n_vehicle; i++)
        if (run->vehicle[i].mean_deceleration_120ms > run->vehicle[found].mean_deceleration_120ms)
            found = i;
    return found;
}

/* Curves of one kind, of all interfaces or cars. */
static void draw_all(CzSheet *sheet, CzDrawn drawn) {
    if (cz_drawn_info(drawn)->at == CZ_AT_INTERFACE)
        cz_draw_interfaces(sheet, drawn);
    else
        cz_draw_cars(sheet, drawn);
}

static void draw_forces(CzSheet *sheet, int index) {
    (void)index;
    cz_draw_interfaces(sheet, CZ_DRAWN_INTERFACE_FORCE);
    cz_draw_force_limits(sheet);
}

/* The function that adds the curves of a figure; NULL: the channel of the y axis, for all cars or
 * interfaces. */
static void (*const draws[CZ_N_CHART])(CzSheet *sheet, int index) = {
    [CZ_CHART_FORCE_CLOSURE] = cz_draw_force_closure,
    [CZ_CHART_ENERGY] = cz_draw_energy,
    [CZ_CHART_BALANCE] = cz_draw_balance,
    [CZ_CHART_FORCE] = draw_forces,
    [CZ_CHART_ACCELERATION] = cz_draw_accelerations,
    [CZ_CHART_CAR_ACCELERATION] = cz_draw_car_acceleration,
    [CZ_CHART_SHORTENING] = cz_draw_shortening,
    [CZ_CHART_WHEEL_LIFT] = cz_draw_lifts};

/* Whether a channel has values at any place. */
static bool has_any(const CzPage *page, CzDrawn drawn) {
    const CzChannelAt at = cz_drawn_info(drawn)->at;
    const int n = at == CZ_AT_RUN         ? 1
                  : at == CZ_AT_INTERFACE ? page->summary->n_interface
                                          : page->summary->n_vehicle;
    for (int place = 0; place < cz_first_place(at, n); place++)
        if (cz_page_values(page, drawn, place) != NULL)
            return true;
    return false;
}

int cz_chart_count(const CzPage *page, CzChart chart) {
    const CzChartInfo *info = cz_chart_info(chart);
    if (page->n_sample < 2)
        return 0;
    return info->count == CZ_CHART_PER_INTERFACE ? page->summary->n_interface
           : info->count == CZ_CHART_PER_CAR     ? page->summary->n_vehicle
           : info->is_of_curves                  ? has_any(page, info->y)
                                                 : 1;
}

void cz_chart_title(const CzPage *page, CzChart chart, int index, size_t room, char *title) {
    const CzChartInfo *info = cz_chart_info(chart);
    const char *of = info->count == CZ_CHART_PER_INTERFACE ? page->summary->interface[index].name
                     : info->count == CZ_CHART_PER_CAR     ? page->summary->vehicle[index].name
                                                           : NULL;
    snprintf(title, room, "%s%s%s", info->title, of != NULL ? ", " : "", of != NULL ? of : "");
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

/* Four figures of one collision in two rows. */
static void write_panels(const CzPage *page, int interface, CzMarkup *markup) {
    static const CzChart panels[] = {CZ_CHART_FORCE, CZ_CHART_VELOCITY, CZ_CHART_DISPLACEMENT,
                                     CZ_CHART_SHORTENING};
    const double slot = 340;
    char title[CZ_SENTENCE_ROOM], text[CZ_SENTENCE_ROOM + 8];
    cz_chart_title(page, CZ_CHART_PANELS, 0, sizeof title, title);
    cz_svg_open_tiles(markup, title, 4, slot);
    cz_markup_write(markup, " class='panels'>\n");
    for (int i = 0; i < 4; i++) {
        const int index = cz_chart_info(panels[i])->count == CZ_CHART_PER_INTERFACE ? interface : 0;
        cz_chart_title(page, panels[i], index, sizeof title, title);
        snprintf(text, sizeof text, "(%c) %s", "abcd"[i], title);
        cz_svg_open_tile(markup, i, slot, 8, text);
        cz_chart_write(page, panels[i], index, markup);
        cz_markup_write(markup, "</svg>");
    }
    cz_markup_write(markup, "</svg>\n");
}

/* Collects the curves of a figure, then draws it. */
static void write_curves(const CzPage *page, CzChart chart, int index, CzMarkup *markup) {
    const CzChartInfo *info = cz_chart_info(chart);
    CzSheet sheet;
    char title[CZ_SENTENCE_ROOM];
    cz_chart_title(page, chart, index, sizeof title, title);
    cz_sheet_begin(&sheet, page, title, info->x, info->y);
    if (draws[chart] != NULL)
        draws[chart](&sheet, index);
    else
        draw_all(&sheet, info->y);
    add_measured(&sheet, chart);
    cz_sheet_write(&sheet, markup);
}

void cz_chart_write(const CzPage *page, CzChart chart, int index, CzMarkup *markup) {
    if (cz_chart_info(chart)->is_of_curves)
        write_curves(page, chart, index, markup);
    else if (chart == CZ_CHART_ENERGY_SHARES)
        cz_chart_write_shares(page, markup);
    else if (chart == CZ_CHART_FRAMES)
        cz_chart_write_frames(page, index, markup);
    else
        write_panels(page, index, markup);
}
