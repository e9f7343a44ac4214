/* The animation, and frames where no script runs. */
#include "report/charts.h"
#include "report/figure.h"
#include "report/plot.h"
#include "report/scene.h"
#include "report/units.h"

#include <math.h>

enum { N_FRAME = 6, WIDTH = 960 };

/* Sample at which an interface is closed most. */
static int most_closed(const CzPage *page, int interface) {
    const double *closure = cz_page_values(page, CZ_DRAWN_INTERFACE_CLOSURE, interface);
    int found = page->n_sample - 1;
    for (int i = 0; closure != NULL && i < page->n_sample; i++)
        if (closure[i] > closure[found])
            found = i;
    return found;
}

/* Sample of one of the frames, which are evenly spread. */
static int sample_of(const CzPage *page, int interface, int frame) {
    return (int)((long)most_closed(page, interface) * frame / (N_FRAME - 1));
}

/* Time and force, as the title of a frame. */
static void name_frame(const CzPage *page, int interface, int sample, size_t room, char *title) {
    const double *force = cz_page_values(page, CZ_DRAWN_INTERFACE_FORCE, interface);
    char time[CZ_FIGURE_ROOM], number[CZ_FIGURE_ROOM];
    const double from = page->summary->beyond_validity_time * CZ_MILLI_PER_UNIT; /* or NaN */
    snprintf(title, room, "%s ms, %s kN%s", cz_figure_fixed(time, 0, page->time[sample]),
             cz_figure_fixed(number, 0, force != NULL ? force[sample] : NAN),
             page->time[sample] > from ? " (beyond the model)" : "");
}

static void draw_frame(const CzPage *page, int interface, int sample, const char *title,
                       CzMarkup *markup) {
    cz_svg_open(markup, title, CZ_PLOT_WIDTH, CZ_SCENE_HEIGHT);
    cz_markup_attribute(markup, "class", "frame");
    cz_scene_write(page, interface, sample, CZ_PLOT_WIDTH, false, markup);
    cz_markup_close(markup);
}

static void write_frame(CzPage *page, int interface, int sample) {
    CzMarkup *markup = &page->markup;
    char title[CZ_SENTENCE_ROOM];
    name_frame(page, interface, sample, sizeof title, title);
    cz_markup_open(markup, "figure");
    cz_markup_element(markup, "figcaption", title);
    draw_frame(page, interface, sample, title, markup);
    cz_markup_end(markup);
}

void cz_chart_write_frames(const CzPage *page, int interface, CzMarkup *markup) {
    cz_svg_open_tiles(markup, "The collision from the side", N_FRAME, CZ_SCENE_HEIGHT);
    cz_markup_line(markup);
    for (int i = 0; i < N_FRAME; i++) {
        const int sample = sample_of(page, interface, i);
        char title[CZ_SENTENCE_ROOM];
        name_frame(page, interface, sample, sizeof title, title);
        cz_svg_open_tile(markup, i, CZ_SCENE_HEIGHT, 4, title);
        draw_frame(page, interface, sample, title, markup);
        cz_markup_end(markup);
    }
    cz_markup_end(markup);
}

static void write_control(CzMarkup *markup, const char *element, const char *id,
                          const char *label) {
    cz_markup_open(markup, element);
    cz_markup_attributes(markup, "id", id, "aria-label", label, NULL);
}

/* Controls, hidden until the script shows them. */
static void write_controls(CzPage *page) {
    static const char *const speeds[] = {"0.02", "0.05", "0.1", "0.25", "1"};
    CzMarkup *markup = &page->markup;
    cz_markup_open_class(markup, "div", "controls");
    write_control(markup, "button", "play", "play or pause");
    cz_markup_attribute(markup, "type", "button");
    cz_markup_text(markup, "Play");
    cz_markup_close(markup);
    cz_markup_open(markup, "label");
    cz_markup_text(markup, "speed ");
    write_control(markup, "select", "speed", "speed of the animation");
    for (int i = 0; i < 5; i++) {
        cz_markup_open(markup, "option");
        cz_markup_attribute(markup, "value", speeds[i]);
        if (i == 2)
            cz_markup_attribute(markup, "selected", "selected");
        cz_markup_text(markup, speeds[i]);
        cz_markup_close(markup);
    }
    cz_markup_close(markup);
    cz_markup_close(markup);
    cz_markup_open(markup, "label");
    cz_markup_text(markup, "look at ");
    write_control(markup, "select", "focus", "centred interface");
    for (int i = 0; i < page->summary->n_interface; i++) {
        cz_markup_open(markup, "option");
        cz_markup_attribute(markup, "value", page->summary->interface[i].name);
        if (i == page->model->colliding)
            cz_markup_attribute(markup, "selected", "selected");
        cz_markup_text(markup, page->summary->interface[i].name);
        cz_markup_close(markup);
    }
    cz_markup_close(markup);
    cz_markup_close(markup);
    write_control(markup, "input", "scrub", "time");
    cz_markup_attributes(markup, "type", "range", "min", "0", "max", "1", "value", "0", NULL);
    cz_markup_close(markup);
    cz_markup_open(markup, "output");
    cz_markup_attribute(markup, "id", "now");
    cz_markup_text(markup, "");
    cz_markup_close(markup);
    cz_markup_end(markup);
}

void cz_page_write_animation(CzPage *page) {
    CzMarkup *markup = &page->markup;
    const int interface = page->model->colliding;
    if (page->n_sample < 2)
        return;
    cz_page_open_section(markup, "animation", "The collision from the side");
    cz_markup_element(markup, "p",
                      "Lengths are to scale; vertical movement, wheel lift and pitch are drawn ten "
                      "times as large. Orange: crush zones of the car ends, red: anti-climbers, "
                      "bars below: couplers.");
    cz_markup_open(markup, "div");
    cz_markup_attributes(markup, "id", "stage", "class", "script wide", NULL);
    write_controls(page);
    cz_svg_open(markup, "animation of the collision", WIDTH, CZ_SCENE_HEIGHT);
    cz_markup_attribute(markup, "class", "animation");
    cz_markup_numbers(markup, 1, "data-scale data-magnify",
                      (const double[]){CZ_SCENE_SCALE, CZ_SCENE_MAGNIFY});
    cz_scene_write(page, interface, 0, WIDTH, true, markup);
    cz_markup_close(markup);
    cz_markup_end(markup);
    cz_markup_open_class(markup, "div", "figures strip");
    for (int i = 0; i < N_FRAME; i++)
        write_frame(page, interface, sample_of(page, interface, i));
    cz_markup_close(markup);
    cz_markup_end(markup);
}
