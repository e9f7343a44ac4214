/* The trains as a row, with what happened between the cars. */
#include "report/page.h"

#include "report/elevation.h"
#include "report/figure.h"
#include "report/plot.h"
#include "report/units.h"

#include <math.h>
#include <string.h>

#define CAR_WIDTH 62.0
#define BETWEEN 62.0 /* room for the numbers of an interface */
#define MARGIN 8.0
#define CAR_TOP 20.0
#define CAR_HEIGHT 30.0
#define ROW_HEIGHT 146.0
#define MOST_IN_ROW 9 /* cars that are as wide as a page */
#define NOTHING 100.0 /* energy of an element that does not count as one that worked [J] */

static double largest_use(const CzInterfaceResult *interface) {
    double used = 0;
    for (int i = 0; i < interface->n_element; i++)
        used = fmax(used, interface->element[i].stroke_used);
    return used;
}

static void write_car(const CzPage *page, int car, double x, double y, CzMarkup *markup) {
    const CzCar *description = &page->model->car[car];
    char number[CZ_FIGURE_ROOM], text[CZ_FIGURE_ROOM + 8];
    cz_markup_open(markup, "rect");
    cz_markup_number(markup, "x", 1, x);
    cz_markup_number(markup, "y", 1, y + CAR_TOP);
    cz_markup_number(markup, "width", 1, CAR_WIDTH);
    cz_markup_number(markup, "height", 1, CAR_HEIGHT);
    cz_markup_attribute(markup, "rx", "4");
    cz_markup_attribute(markup, "fill", cz_plot_colour(description->train == 0 ? 0 : 1));
    cz_markup_attribute(markup, "fill-opacity", ".15");
    cz_markup_attribute(markup, "stroke", "currentColor");
    cz_markup_close(markup);
    cz_svg_text(markup, x + CAR_WIDTH / 2, y + CAR_TOP + 13, "middle", description->name);
    const double mass = page->model->facts[car].mass;
    const double known = isfinite(mass) ? mass : page->vehicles[description->vehicle].mass;
    if (description->model == CZ_MODEL_FIXED)
        snprintf(text, sizeof text, "fixed");
    else
        snprintf(text, sizeof text, "%s t", cz_figure_plain(number, known / CZ_KILO));
    cz_svg_text(markup, x + CAR_WIDTH / 2, y + CAR_TOP + 25, "middle", text);
}

/* A column of numbers below the gap between two cars. */
static void write_interface(const CzPage *page, int index, double x, double y, CzMarkup *markup) {
    const CzInterfaceResult *interface = &page->summary->interface[index];
    char number[CZ_FIGURE_ROOM], text[5][CZ_FIGURE_ROOM + 16];
    const CzRunSummary *run = page->summary;
    const char *mark = run->beyond_validity ? "*" : "";
    snprintf(text[0], sizeof *text, "%s kN%s",
             cz_figure_fixed(number, 0, interface->peak_force / CZ_KILO),
             interface->peak_time <= run->beyond_validity_time ? "" : mark);
    snprintf(text[1], sizeof *text, "%s mm%s",
             cz_figure_fixed(number, 0, interface->shortening * CZ_MILLI_PER_UNIT), mark);
    snprintf(text[2], sizeof *text, "%s used%s", cz_figure_percent(number, largest_use(interface)),
             mark);
    snprintf(text[3], sizeof *text, "%s kJ",
             cz_figure_plain(number, cz_run_total(run, interface->energy) / CZ_KILO));
    snprintf(text[4], sizeof *text, "%s",
             cz_figure_percent(number, cz_run_total(run, interface->energy_share)));
    const bool collides = index == page->model->colliding;
    cz_markup_open(markup, "path");
    cz_markup_format(markup, "d", "M%d %dH%d", (int)(x - BETWEEN / 2), (int)(y + CAR_TOP + 22),
                     (int)(x + BETWEEN / 2));
    cz_markup_attribute(markup, "stroke", interface->bottomed_out ? "#d0021b" : "currentColor");
    cz_markup_attribute(markup, "stroke-width", collides ? "5" : "2");
    cz_markup_close(markup);
    cz_svg_text(markup, x, y + CAR_TOP + 14, "middle", interface->name);
    for (int i = 0; i < 5; i++)
        cz_svg_text(markup, x, y + CAR_TOP + CAR_HEIGHT + 16 + 14 * i, "middle", text[i]);
    if (interface->bottomed_out) {
        cz_markup_open(markup, "text");
        cz_markup_number(markup, "x", 1, x);
        cz_markup_number(markup, "y", 1, y + CAR_TOP + CAR_HEIGHT + 16 + 14 * 5);
        cz_markup_attribute(markup, "text-anchor", "middle");
        cz_markup_attribute(markup, "fill", "#d0021b");
        cz_markup_attribute(markup, "font-weight", "bold");
        cz_markup_text(markup, "bottomed");
        cz_markup_close(markup);
    }
}

/* Cars in as many rows as a page needs, of about the same length; what lies between two rows stands
 * at the end of the first. */
static void write_diagram(const CzPage *page, CzMarkup *markup) {
    const int n = page->model->n_car;
    const int n_row = (n + MOST_IN_ROW - 1) / MOST_IN_ROW, n_in_row = (n + n_row - 1) / n_row;
    const double pitch = CAR_WIDTH + BETWEEN;
    const double width = 2 * MARGIN + n_in_row * pitch - (n_row == 1 ? BETWEEN : 0);
    cz_svg_open(markup,
                "The trains, with peak force, closure, stroke used and energy of each interface",
                width, n_row * ROW_HEIGHT);
    cz_markup_attribute(markup, "class", "row");
    cz_markup_number(markup, "width", 0, width);
    for (int car = 0; car < n; car++) {
        const double x = MARGIN + car % n_in_row * pitch, y = car / n_in_row * ROW_HEIGHT;
        write_car(page, car, x, y, markup);
        if (car < page->summary->n_interface)
            write_interface(page, car, x + CAR_WIDTH + BETWEEN / 2, y, markup);
    }
    cz_markup_close(markup);
}

/* ---- tables ---- */

/* A number of the run, marked when it may be of the time beyond the model's validity. */
static void put_number(CzMarkup *markup, const CzRunSummary *run, char text[CZ_FIGURE_ROOM]) {
    cz_markup_classed(markup, "td", "number", cz_figure_mark(text, run->beyond_validity));
}

static void put_plain(CzMarkup *markup, const CzRunSummary *run, double value) {
    char number[CZ_FIGURE_ROOM];
    cz_figure_plain(number, value);
    put_number(markup, run, number);
}

static void write_element(CzMarkup *markup, const CzRunSummary *run, const char *interface,
                          const CzElementResult *element) {
    char number[CZ_FIGURE_ROOM];
    cz_markup_open(markup, "tr");
    cz_markup_element(markup, "td", interface);
    cz_markup_element(markup, "td", element->name);
    put_plain(markup, run, element->peak_force / CZ_KILO);
    put_plain(markup, run, element->stroke * CZ_MILLI_PER_UNIT);
    cz_figure_percent(number, element->stroke_used);
    put_number(markup, run, number);
    put_plain(markup, run, cz_run_total(run, element->energy) / CZ_KILO);
    cz_markup_classed(markup, "td", element->bottomed_out ? "fail" : "small",
                      element->bottomed_out ? "bottomed out"
                      : element->sheared    ? "sheared off"
                                            : "");
    cz_markup_close(markup);
    cz_markup_line(markup);
}

static void write_elements(const CzPage *page, CzMarkup *markup) {
    static const char *const names[] = {"interface",    "element", ">peak kN", ">stroke mm",
                                        ">stroke used", ">kJ",     ""};
    cz_page_open_table(markup, NULL, sizeof names / sizeof *names, names);
    for (int i = 0; i < page->summary->n_interface; i++) {
        const CzInterfaceResult *interface = &page->summary->interface[i];
        bool is_first = true;
        for (int k = 0; k < interface->n_element; k++) {
            if (!(interface->element[k].energy > NOTHING) && !interface->element[k].bottomed_out)
                continue;
            write_element(markup, page->summary, is_first ? interface->name : "",
                          &interface->element[k]);
            is_first = false;
        }
    }
    cz_page_close_table(markup);
}

static void write_vehicle(CzMarkup *markup, const CzRunSummary *run,
                          const CzVehicleResult *vehicle) {
    double lift = NAN;
    for (int i = 0; i < 4; i++)
        lift = fmax(lift, vehicle->wheel_lift[i]);
    cz_markup_open(markup, "tr");
    cz_markup_element(markup, "td", vehicle->name);
    put_plain(markup, run, vehicle->final_speed * CZ_KM_H_PER_M_S);
    put_plain(markup, run, vehicle->peak_deceleration / CZ_GRAVITY);
    put_plain(markup, run, vehicle->mean_deceleration_contact / CZ_GRAVITY);
    put_plain(markup, run, vehicle->mean_deceleration_120ms / CZ_GRAVITY);
    put_plain(markup, run, lift * CZ_MILLI_PER_UNIT);
    put_plain(markup, run, vehicle->max_pitch * CZ_MILLI_PER_UNIT);
    put_plain(markup, run, vehicle->link_force / CZ_KILO);
    cz_markup_close(markup);
    cz_markup_line(markup);
}

static void write_vehicles(const CzPage *page, CzMarkup *markup) {
    static const char *const names[] = {"car",
                                        ">final km/h",
                                        ">peak g",
                                        ">mean g, contact",
                                        ">mean g, 120 ms",
                                        ">wheel lift mm",
                                        ">pitch mrad",
                                        ">traction link kN"};
    cz_page_open_table(markup, NULL, sizeof names / sizeof *names, names);
    for (int i = 0; i < page->summary->n_vehicle; i++)
        write_vehicle(markup, page->summary, &page->summary->vehicle[i]);
    cz_page_close_table(markup);
}

void cz_page_write_trains(CzPage *page) {
    CzMarkup *markup = &page->markup;
    cz_page_open_section(markup, "trains", "Trains");
    cz_markup_element(markup, "p",
                      "Below each interface: peak force, largest closure, largest share of a "
                      "stroke used, energy dissipated, share of all that was dissipated. The first "
                      "table has the elements that "
                      "dissipated more than 0.1 kJ.");
    cz_markup_open(markup, "div");
    cz_markup_attribute(markup, "class", "wide");
    write_diagram(page, markup);
    cz_markup_close(markup);
    cz_markup_line(markup);
    cz_markup_element(markup, "h3", "The two ends that collide, at rest, to scale");
    cz_markup_open(markup, "div");
    cz_markup_attribute(markup, "class", "wide");
    cz_elevation_write(page->model, page->stand, markup);
    cz_markup_close(markup);
    cz_markup_line(markup);
    cz_markup_open(markup, "div");
    cz_markup_attribute(markup, "class", "tables");
    write_elements(page, markup);
    write_vehicles(page, markup);
    cz_markup_close(markup);
    cz_page_close_section(markup);
}
