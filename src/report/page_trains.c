/* The trains as a row of cars, with the results of the interfaces; tables of elements and cars. */
#include "report/page.h"

#include "report/elevation.h"
#include "report/figure.h"
#include "report/plot.h"
#include "report/results.h"
#include "report/units.h"

#include <math.h>
#include <string.h>

#define CAR_WIDTH 62.0
#define BETWEEN 62.0 /* room for the numbers of an interface */
#define MARGIN 8.0
#define CAR_TOP 20.0
#define CAR_HEIGHT 30.0
#define ROW_HEIGHT 146.0
#define MAX_IN_ROW 9  /* cars that are as wide as a page */
#define NOTHING 100.0 /* elements with less energy are left out of the table [J] */

static void write_car(const CzPage *page, int car, double x, double y, CzMarkup *markup) {
    const CzCar *description = &page->model->car[car];
    char number[CZ_FIGURE_SIZE], text[CZ_FIGURE_SIZE + 8];
    cz_markup_write(markup,
                    "<rect x='%.1f' y='%.1f' width='%.1f' height='%.1f' rx='4' fill='%s' "
                    "fill-opacity='.15' stroke='currentColor'/>",
                    x, y + CAR_TOP, CAR_WIDTH, CAR_HEIGHT,
                    cz_plot_colour(description->train == 0 ? 0 : 1));
    cz_svg_text(markup, x + CAR_WIDTH / 2, y + CAR_TOP + 13, "middle", description->name);
    const double mass = page->model->properties[car].mass;
    const double known = isfinite(mass) ? mass : page->vehicles[description->vehicle].mass;
    if (description->model == CZ_MODEL_FIXED)
        snprintf(text, sizeof text, "fixed");
    else
        snprintf(text, sizeof text, "%s t", cz_figure_plain(number, known / CZ_KILO));
    cz_svg_text(markup, x + CAR_WIDTH / 2, y + CAR_TOP + 25, "middle", text);
}

/* A column of numbers below the gap between two cars. */
static void write_interface(const CzPage *page, int index, double x, double y, CzMarkup *markup) {
    static const struct {
        const CzResult *result;
        const char *behind;
    } lines[] = {{CZ_RESULT_AT(INTERFACE, peak_force_kN), " kN"},
                 {CZ_RESULT_AT(INTERFACE, shortening_mm), " mm"},
                 {CZ_RESULT_AT(INTERFACE, stroke_used), " used"},
                 {CZ_RESULT_AT(INTERFACE, energy_kJ), " kJ"},
                 {CZ_RESULT_AT(INTERFACE, energy_share), ""}};
    enum { n_line = sizeof lines / sizeof *lines };
    const CzRunSummary *run = page->summary;
    const CzInterfaceResult *interface = &run->interface[index];
    CzResultContext context = {.run = run};
    const bool collides = index == page->model->colliding;
    cz_markup_write(markup, "<path d='M%d %dH%d' stroke='%s' stroke-width='%d'/>",
                    (int)(x - BETWEEN / 2), (int)(y + CAR_TOP + 22), (int)(x + BETWEEN / 2),
                    interface->bottomed_out ? "#d0021b" : "currentColor", collides ? 5 : 2);
    cz_svg_text(markup, x, y + CAR_TOP + 14, "middle", interface->name);
    for (int i = 0; i < n_line; i++) {
        char number[CZ_FIGURE_SIZE], text[CZ_FIGURE_SIZE + 8];
        const bool is_early = lines[i].result == CZ_RESULT_AT(INTERFACE, peak_force_kN) &&
                              interface->peak_time <= run->beyond_validity_time;
        const bool is_total = lines[i].result->is_total; /* blank and not marked */
        snprintf(text, sizeof text, "%s%s%s",
                 cz_result_text(number, lines[i].result, &context, interface), lines[i].behind,
                 run->beyond_validity && !is_early && !is_total ? "*" : "");
        cz_svg_text(markup, x, y + CAR_TOP + CAR_HEIGHT + 16 + 14 * i, "middle", text);
    }
    if (interface->bottomed_out)
        cz_markup_write(markup,
                        "<text x='%.1f' y='%.1f' text-anchor='middle' fill='#d0021b' "
                        "font-weight='bold'>bottomed</text>",
                        x, y + CAR_TOP + CAR_HEIGHT + 16 + 14 * n_line);
}

/* Draws the cars in rows of about the same length that fit a page; an interface between two rows is
 * at the end of the first. */
static void write_diagram(const CzPage *page, CzMarkup *markup) {
    const int n = page->model->n_car;
    const int n_row = (n + MAX_IN_ROW - 1) / MAX_IN_ROW, n_in_row = (n + n_row - 1) / n_row;
    const double pitch = CAR_WIDTH + BETWEEN;
    const double width = 2 * MARGIN + n_in_row * pitch - (n_row == 1 ? BETWEEN : 0);
    cz_svg_open(markup,
                "The trains, with peak force, closure, stroke used and energy of each interface",
                width, n_row * ROW_HEIGHT);
    cz_markup_write(markup, " class='row' width='%.0f'>", width);
    for (int car = 0; car < n; car++) {
        const double x = MARGIN + car % n_in_row * pitch, y = car / n_in_row * ROW_HEIGHT;
        write_car(page, car, x, y, markup);
        if (car < page->summary->n_interface)
            write_interface(page, car, x + CAR_WIDTH + BETWEEN / 2, y, markup);
    }
    cz_markup_write(markup, "</svg>");
}

/* ---- tables ---- */

static void write_elements(const CzPage *page, CzMarkup *markup) {
    static const CzResult *const columns[] = {
        CZ_RESULT_AT(ELEMENT, peak_force_kN), CZ_RESULT_AT(ELEMENT, stroke_mm),
        CZ_RESULT_AT(ELEMENT, stroke_used), CZ_RESULT_AT(ELEMENT, energy_kJ)};
    enum { n_column = sizeof columns / sizeof *columns };
    const CzRunSummary *run = page->summary;
    CzResultContext context = {.run = run};
    CzReportTable table;
    cz_table_begin(&table, "interface;element");
    cz_table_head_results(&table, n_column, columns);
    cz_table_head(&table, "");
    for (int i = 0; i < run->n_interface; i++) {
        const char *name = run->interface[i].name;
        for (int e = 0; e < run->interface[i].n_element; e++) {
            const CzElementResult *element = &run->interface[i].element[e];
            if (!(element->energy > NOTHING) && !element->bottomed_out)
                continue;
            cz_table_put(&table, name);
            cz_table_put(&table, element->name);
            cz_table_put_results(&table, n_column, columns, &context, element,
                                 run->beyond_validity);
            cz_table_put_styled(&table,
                                element->bottomed_out ? "bottomed out"
                                : element->sheared    ? "sheared off"
                                                      : "",
                                element->bottomed_out ? CZ_STYLE_BAD : CZ_STYLE_SMALL);
            name = "";
        }
    }
    cz_table_write_page(&table, markup);
}

static void write_vehicles(const CzPage *page, CzMarkup *markup) {
    static const CzResult *const columns[] = {CZ_RESULT_AT(VEHICLE, final_speed_km_h),
                                              CZ_RESULT_AT(VEHICLE, peak_deceleration_g),
                                              CZ_RESULT_AT(VEHICLE, mean_deceleration_contact_g),
                                              CZ_RESULT_AT(VEHICLE, mean_deceleration_120ms_g),
                                              CZ_RESULT_AT(VEHICLE, max_wheel_lift_mm),
                                              CZ_RESULT_AT(VEHICLE, max_pitch_mrad),
                                              CZ_RESULT_AT(VEHICLE, link_force_kN)};
    enum { n_column = sizeof columns / sizeof *columns };
    const CzRunSummary *run = page->summary;
    CzResultContext context = {.run = run};
    CzReportTable table;
    cz_table_begin(&table, "car");
    cz_table_head_results(&table, n_column, columns);
    for (int i = 0; i < run->n_vehicle; i++) {
        cz_table_put(&table, run->vehicle[i].name);
        cz_table_put_results(&table, n_column, columns, &context, &run->vehicle[i],
                             run->beyond_validity);
    }
    cz_table_write_page(&table, markup);
}

void cz_page_write_trains(CzPage *page) {
    CzMarkup *markup = &page->markup;
    cz_markup_write(markup,
                    "<section id='trains'>\n<h2>Trains</h2>\n"
                    "<p>Below each interface: peak force, largest closure, largest share of a "
                    "stroke used, energy dissipated, share of all that was dissipated. The first "
                    "table has the elements that dissipated more than 0.1 kJ.</p>"
                    "<div class='wide'>");
    write_diagram(page, markup);
    cz_markup_write(markup, "</div>\n<h3>The two ends that collide, at rest, to scale</h3>"
                            "<div class='wide'>");
    cz_elevation_write(page->model, page->layout, markup);
    cz_markup_write(markup, "</div>\n<div class='tables'>");
    write_elements(page, markup);
    write_vehicles(page, markup);
    cz_markup_write(markup, "</div></section>\n");
}
