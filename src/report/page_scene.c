/* The animation, and still frames for readers without the script. */
#include "report/charts.h"
#include "report/figure.h"
#include "report/plot.h"
#include "report/scene.h"
#include "report/units.h"

#include <math.h>

enum { N_FRAME = 6, WIDTH = 960 };

/* Sample with the largest closure of an interface. */
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
    char time[CZ_FIGURE_SIZE], number[CZ_FIGURE_SIZE];
    const double from = page->summary->beyond_validity_time * CZ_MILLI_PER_UNIT; /* or NaN */
    snprintf(title, room, "%s ms, %s kN%s", cz_figure_fixed(time, 0, page->time[sample]),
             cz_figure_fixed(number, 0, force != NULL ? force[sample] : NAN),
             page->time[sample] > from ? " (beyond the model)" : "");
}

static void draw_frame(const CzPage *page, int interface, int sample, const char *title,
                       CzMarkup *markup) {
    cz_svg_open(markup, title, CZ_PLOT_WIDTH, CZ_SCENE_HEIGHT);
    cz_markup_write(markup, " class='frame'>");
    cz_scene_write(page, interface, sample, CZ_PLOT_WIDTH, false, markup);
    cz_markup_write(markup, "</svg>");
}

static void write_frame(CzPage *page, int interface, int sample) {
    CzMarkup *markup = &page->markup;
    char title[CZ_SENTENCE_SIZE];
    name_frame(page, interface, sample, sizeof title, title);
    cz_markup_write(markup, "<figure><figcaption>%s</figcaption>", title);
    draw_frame(page, interface, sample, title, markup);
    cz_markup_write(markup, "</figure>\n");
}

void cz_chart_write_frames(const CzPage *page, int interface, CzMarkup *markup) {
    cz_svg_open_tiles(markup, "The collision from the side", N_FRAME, CZ_SCENE_HEIGHT);
    cz_markup_write(markup, ">\n");
    for (int i = 0; i < N_FRAME; i++) {
        const int sample = sample_of(page, interface, i);
        char title[CZ_SENTENCE_SIZE];
        name_frame(page, interface, sample, sizeof title, title);
        cz_svg_open_tile(markup, i, CZ_SCENE_HEIGHT, 4, title);
        draw_frame(page, interface, sample, title, markup);
        cz_markup_write(markup, "</svg>\n");
    }
    cz_markup_write(markup, "</svg>\n");
}

static void write_choice(CzMarkup *markup, const char *value, bool is_selected) {
    cz_markup_write(markup, "<option value='%s'", value);
    if (is_selected)
        cz_markup_write(markup, " selected='selected'");
    cz_markup_write(markup, ">%s</option>", value);
}

/* Controls, hidden until the script shows them. */
static void write_controls(CzPage *page) {
    static const char *const speeds[] = {"0.02", "0.05", "0.1", "0.25", "1"};
    CzMarkup *markup = &page->markup;
    cz_markup_write(markup,
                    "<div class='controls'>"
                    "<button id='play' aria-label='play or pause' type='button'>Play</button>"
                    "<label>speed <select id='speed' aria-label='speed of the animation'>");
    for (int i = 0; i < 5; i++)
        write_choice(markup, speeds[i], i == 2);
    cz_markup_write(markup, "</select></label><label>look at "
                            "<select id='focus' aria-label='centred interface'>");
    for (int i = 0; i < page->summary->n_interface; i++)
        write_choice(markup, page->summary->interface[i].name, i == page->model->colliding);
    cz_markup_write(markup, "</select></label><input id='scrub' aria-label='time' type='range' "
                            "min='0' max='1' value='0'/><output id='now'></output></div>\n");
}

void cz_page_write_animation(CzPage *page) {
    CzMarkup *markup = &page->markup;
    const int interface = page->model->colliding;
    if (page->n_sample < 2)
        return;
    cz_markup_write(
        markup, "<section id='animation'>\n<h2>The collision from the side</h2>\n"
                "<p>Lengths are to scale; vertical displacement, wheel lift and pitch are enlarged "
                "ten times. Orange: crush zones of the car ends, red: anti-climbers, bars below: "
                "couplers.</p><div id='stage' class='script wide'>");
    write_controls(page);
    cz_svg_open(markup, "animation of the collision", WIDTH, CZ_SCENE_HEIGHT);
    cz_markup_write(markup, " class='animation' data-scale='%.1f' data-magnify='%.1f'>",
                    CZ_SCENE_SCALE, CZ_SCENE_MAGNIFY);
    cz_scene_write(page, interface, 0, WIDTH, true, markup);
    cz_markup_write(markup, "</svg></div>\n<div class='figures strip'>");
    for (int i = 0; i < N_FRAME; i++)
        write_frame(page, interface, sample_of(page, interface, i));
    cz_markup_write(markup, "</div></section>\n");
}
