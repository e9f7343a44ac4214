/* Diagrams of curves: range, axes, curves, legend. */
#include "report/plot.h"

#include "report/figure.h"
#include "report/decimation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LEFT 56.0
#define RIGHT 12.0
#define TOP 8.0
#define USUAL_HEIGHT 210.0
#define BELOW_AXIS 42.0 /* numbers and label of the x axis */
#define LEGEND_ROW 17.0
#define SAMPLE_WIDTH 24.0 /* of a line in the legend, with its space */
#define FONT_SIZE 11.0
#define TOLERANCE 0.25 /* of decimation, in the units of the diagram */
#define FINER 10.0     /* paths are written in tenths of a unit, as whole numbers */

const char *cz_plot_colour(int colour) {
    static const char *const colours[CZ_PLOT_N_COLOUR] = {
        "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "currentColor"};
    return colour < 0 ? "#999999" : colours[colour % CZ_PLOT_N_COLOUR];
}

/* Dash patterns, in the units of the diagram and on the finer grid. */
static const char *const dashes[4][2] = {
    {NULL, NULL}, {"6 3", "60 30"}, {"1.5 2.5", "15 25"}, {"8 3 1.5 3", "80 30 15 30"}};

const char *cz_plot_dash(int dash) {
    return dashes[dash % 4][0];
}

double cz_text_width(const char *text) {
    double width = 0;
    for (; *text != '\0'; text++) {
        const unsigned char c = (unsigned char)*text;
        if (c >= 0x80 && c < 0xc0)
            continue; /* a further byte of a character */
        if (strchr("il.,:;'|!()[] ft", c) != NULL)
            width += 0.36;
        else
            width += strchr("mwMW%", c) != NULL ? 0.92 : 0.62;
    }
    return width;
}

void cz_svg_begin_document(CzMarkup *markup) {
    cz_markup_write(markup, "<?xml version='1.0' encoding='UTF-8'?>\n");
    markup->is_alone = true;
}

void cz_svg_open(CzMarkup *markup, const char *title, double width, double height) {
    cz_markup_write(markup,
                    "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 %.1f %.1f' role='img' "
                    "aria-label='%s' font-family='system-ui, sans-serif' font-size='%.1f' "
                    "fill='none' stroke-linejoin='round'",
                    width, height, title, FONT_SIZE);
    if (markup->is_alone)
        cz_markup_write(markup, " style='background:#fff'");
    markup->is_alone = false;
}

/* Between two tiles, and above each for its heading. */
enum { TILE_GAP = 16, TILE_HEADING = 22 };

void cz_svg_open_tiles(CzMarkup *markup, const char *title, int n, double height) {
    const int n_row = (n + 1) / 2;
    cz_svg_open(markup, title, 2 * CZ_PLOT_WIDTH + TILE_GAP, n_row * (TILE_HEADING + height));
}

void cz_svg_open_tile(CzMarkup *markup, int i, double height, double inset, const char *heading) {
    const double x = i % 2 * (CZ_PLOT_WIDTH + TILE_GAP), y = i / 2 * (TILE_HEADING + height);
    cz_svg_text(markup, x + inset, y + 15, "start", heading);
    cz_markup_write(markup, "<svg x='%.1f' y='%.1f' width='%d' height='%.1f'>", x, y + TILE_HEADING,
                    CZ_PLOT_WIDTH, height);
}

void cz_svg_text(CzMarkup *markup, double x, double y, const char *anchor, const char *text) {
    cz_markup_write(markup, "<text x='%.1f' y='%.1f'", x, y);
    if (strcmp(anchor, "start") != 0)
        cz_markup_write(markup, " text-anchor='%s'", anchor);
    cz_markup_write(markup, " fill='currentColor'>%s</text>", text);
}

/* Scale of the drawing. */
typedef struct Frame {
    double x_min, x_max, y_min, y_max; /* range of the axes */
    double width, height;              /* between the axes */
} Frame;

static double paper_x(const Frame *frame, double x) {
    return LEFT + (x - frame->x_min) / (frame->x_max - frame->x_min) * frame->width;
}

static double paper_y(const Frame *frame, double y) {
    return TOP + (frame->y_max - y) / (frame->y_max - frame->y_min) * frame->height;
}

double cz_plot_round_step(double range, int n) {
    static const double steps[] = {1, 2, 5, 10};
    const double wanted = range / n;
    double power = 1;
    while (power > wanted)
        power /= 10;
    while (power * 10 <= wanted)
        power *= 10;
    for (int i = 0; i < 4; i++)
        if (steps[i] * power >= wanted * 0.999)
            return steps[i] * power;
    return 10 * power;
}

static void widen(double value, double *smallest, double *largest) {
    if (!isfinite(value))
        return;
    *smallest = value < *smallest ? value : *smallest;
    *largest = value > *largest ? value : *largest;
}

/* Makes a range that is not empty and a little wider than the numbers. */
static void add_margin(double *smallest, double *largest, double share) {
    if (!(*smallest <= *largest))
        *smallest = 0, *largest = 1;
    const double size = fmax(fabs(*smallest), fabs(*largest));
    double range = *largest - *smallest;
    if (!(range > 1e-9 * size) || !(range > 1e-12)) {
        *largest += size > 0 ? 0.5 * size : 1;
        *smallest -= size > 0 && *smallest != 0 ? 0.5 * size : 0;
        range = *largest - *smallest;
    }
    *smallest -= *smallest == 0 ? 0 : share * range;
    *largest += *largest == 0 ? 0 : share * range;
}

/* Whether a series has marks for single points. */
static bool is_marked(const CzSeries *series) {
    return series->form >= CZ_SERIES_DOTS;
}

static Frame frame_of(const CzPlot *plot) {
    Frame frame = {INFINITY,
                   -INFINITY,
                   INFINITY,
                   -INFINITY,
                   CZ_PLOT_WIDTH - LEFT - RIGHT,
                   plot->height > 0 ? plot->height : USUAL_HEIGHT};
    for (int i = 0; i < plot->n_series; i++)
        for (int k = 0; k < plot->series[i].n; k++) {
            widen(plot->series[i].x[k], &frame.x_min, &frame.x_max);
            widen(plot->series[i].y[k], &frame.y_min, &frame.y_max);
        }
    for (int i = 0; i < plot->n_limit; i++)
        widen(plot->limit[i].at, &frame.y_min, &frame.y_max);
    if (plot->from_zero)
        widen(0, &frame.y_min, &frame.y_max);
    bool has_marks = false;
    for (int i = 0; i < plot->n_series; i++)
        has_marks |= is_marked(&plot->series[i]);
    add_margin(&frame.x_min, &frame.x_max, has_marks ? 0.05 : 0);
    add_margin(&frame.y_min, &frame.y_max, 0.05);
    return frame;
}

/* Opens the tag of a line; the caller ends it. */
static void open_line(CzMarkup *markup, double x1, double y1, double x2, double y2) {
    cz_markup_write(markup, "<line x1='%.1f' y1='%.1f' x2='%.1f' y2='%.1f'", x1, y1, x2, y2);
}

/* ---- axes ---- */

static void tick_text(char text[CZ_FIGURE_SIZE], double value, double step) {
    int decimals = 0;
    for (double unit = step; unit < 0.999 && decimals < 9; unit *= 10)
        decimals++;
    cz_figure_fixed(text, decimals, fabs(value) < 1e-6 * step ? 0 : value);
}

static void write_x_axis(const CzPlot *plot, const Frame *frame, CzMarkup *markup) {
    const double step = cz_plot_round_step(frame->x_max - frame->x_min, 7);
    const double bottom = TOP + frame->height;
    for (double i = ceil(frame->x_min / step - 1e-6); i * step <= frame->x_max + 1e-6 * step; i++) {
        char text[CZ_FIGURE_SIZE];
        const double x = paper_x(frame, i * step);
        open_line(markup, x, TOP, x, bottom);
        cz_markup_write(markup, " stroke='currentColor' stroke-opacity='.13'/>");
        tick_text(text, i * step, step);
        const double last = CZ_PLOT_WIDTH - 0.5 * FONT_SIZE * cz_text_width(text);
        cz_svg_text(markup, fmin(x, last), bottom + 17, "middle", text);
    }
    cz_svg_text(markup, LEFT + frame->width / 2, bottom + 33, "middle", plot->x_label);
}

static void write_y_axis(const CzPlot *plot, const Frame *frame, CzMarkup *markup) {
    const double fine = cz_plot_round_step(frame->y_max - frame->y_min, 6);
    const double step = plot->counts ? fmax(fine, 1) : fine;
    for (double i = ceil(frame->y_min / step - 1e-6); i * step <= frame->y_max + 1e-6 * step; i++) {
        char text[CZ_FIGURE_SIZE];
        const double y = paper_y(frame, i * step);
        open_line(markup, LEFT, y, LEFT + frame->width, y);
        cz_markup_write(markup, " stroke='currentColor' stroke-opacity='%s'/>",
                        i == 0 ? ".5" : ".13");
        tick_text(text, i * step, step);
        cz_svg_text(markup, LEFT - 5, y + 3.8, "end", text);
    }
    cz_markup_write(markup,
                    "<text transform='rotate(-90)' x='%.1f' y='12' text-anchor='middle' "
                    "fill='currentColor'>%s</text>",
                    -(TOP + frame->height / 2), plot->y_label);
}

/* ---- curves ---- */

static void write_move(FILE *stream, char command, long x, long y) {
    fprintf(stream, "%c%ld%s%ld", command, x, y < 0 ? "" : " ", y);
}

/* Writes the points between two gaps that decimation keeps, as steps on the finer grid. False
 * without memory. */
static bool write_piece(const Frame *frame, const CzSeries *series, int from, int to,
                        FILE *stream) {
    const int n = to - from;
    double *paper = malloc(2 * (size_t)n * sizeof *paper);
    bool *keep = malloc((size_t)n * sizeof *keep);
    bool fits = paper != NULL && keep != NULL;
    for (int i = 0; fits && i < n; i++) {
        paper[i] = paper_x(frame, series->x[from + i]);
        paper[n + i] = paper_y(frame, series->y[from + i]);
    }
    if (fits)
        fits = cz_decimate(n, paper, paper + n, TOLERANCE, CZ_PLOT_MAX_POINTS, keep) >= 0;
    long last_x = 0, last_y = 0;
    for (int i = 0; fits && i < n; i++) {
        if (!keep[i])
            continue;
        const long x = lround(FINER * paper[i]), y = lround(FINER * paper[n + i]);
        if (i == 0)
            write_move(stream, 'M', x, y);
        else
            write_move(stream, 'l', x - last_x, y - last_y);
        last_x = x;
        last_y = y;
    }
    if (fits && n == 1)
        fputs("h0", stream);
    free(paper);
    free(keep);
    return fits;
}

static bool is_point(const CzSeries *series, int i) {
    return isfinite(series->x[i]) && isfinite(series->y[i]);
}

static void write_curve(const Frame *frame, const CzSeries *series, CzMarkup *markup) {
    const char *dash = dashes[series->dash % 4][1];
    cz_markup_write(markup, "<path");
    if (series->y_channel != NULL) {
        cz_markup_write(markup, " data-y='%s'", series->y_channel);
        if (series->x_channel != NULL)
            cz_markup_write(markup, " data-x='%s'", series->x_channel);
        if (series->name != NULL)
            cz_markup_write(markup, " data-name='%s'", series->name);
    }
    cz_markup_write(markup, " stroke='%s'", cz_plot_colour(series->colour));
    if (series->colour < 0)
        cz_markup_write(markup, " stroke-width='30' stroke-opacity='.5'");
    if (series->form == CZ_SERIES_AREA)
        cz_markup_write(markup, " stroke-width='8' fill='%s' fill-opacity='.45'",
                        cz_plot_colour(series->colour));
    if (series->form == CZ_SERIES_POINTS)
        cz_markup_write(markup, " stroke-width='35' stroke-opacity='.6' stroke-linecap='round'");
    if (dash != NULL)
        cz_markup_write(markup, " stroke-dasharray='%s'", dash);
    cz_markup_write(markup, " d='");
    for (int from = 0; from < series->n;) {
        int to = from;
        while (to < series->n && is_point(series, to) &&
               (to == from || series->form != CZ_SERIES_POINTS))
            to++;
        if (to > from && !write_piece(frame, series, from, to, markup->stream))
            markup->failed = true;
        from = to + (to == series->n || !is_point(series, to));
    }
    if (series->name != NULL)
        cz_markup_write(markup, "'><title>%s</title></path>", series->name);
    else
        cz_markup_write(markup, "'/>");
}

static void write_mark(CzMarkup *markup, const CzSeries *series, double x, double y) {
    const char *colour = cz_plot_colour(series->colour);
    if (series->form == CZ_SERIES_CROSSES)
        cz_markup_write(markup, "<path d='M%.1f %.1fl7 7m0-7l-7 7' stroke='%s' stroke-width='2'/>",
                        x - 3.5, y - 3.5, colour);
    else
        cz_markup_write(markup,
                        "<circle cx='%.1f' cy='%.1f' r='4' stroke='%s' stroke-width='2' "
                        "fill='%s'/>",
                        x, y, colour, series->form == CZ_SERIES_DOTS ? colour : "none");
}

static void write_marks(const CzPlot *plot, const Frame *frame, CzMarkup *markup) {
    for (int i = 0; i < plot->n_series; i++) {
        const CzSeries *series = &plot->series[i];
        for (int k = 0; is_marked(series) && k < series->n; k++) {
            if (!is_point(series, k))
                continue;
            const double x = paper_x(frame, series->x[k]), y = paper_y(frame, series->y[k]);
            char text[16];
            write_mark(markup, series, x, y);
            if (series->number == NULL || series->number[k] == 0)
                continue;
            snprintf(text, sizeof text, "%d", series->number[k]);
            cz_svg_text(markup, x + 6, y - 5, "start", text);
        }
    }
}

static void write_bands(const CzPlot *plot, const Frame *frame, CzMarkup *markup) {
    for (int i = 0; i < plot->n_band; i++) {
        const double from = paper_x(frame, fmax(plot->band[i].from, frame->x_min));
        const double to = paper_x(frame, fmin(plot->band[i].to, frame->x_max));
        cz_markup_write(markup,
                        "<rect x='%.1f' y='%.1f' width='%.1f' height='%.1f' fill='%s' "
                        "fill-opacity='.16'/>",
                        from, TOP, fmax(to - from, 0.5), frame->height,
                        cz_plot_colour(plot->band[i].colour));
    }
}

static void write_limits(const CzPlot *plot, const Frame *frame, CzMarkup *markup) {
    for (int i = 0; i < plot->n_limit; i++) {
        const double y = paper_y(frame, plot->limit[i].at);
        open_line(markup, LEFT, y, LEFT + frame->width, y);
        cz_markup_write(markup, " class='limit' stroke='#d0021b' stroke-width='1.5' "
                                "stroke-dasharray='10 4'/>");
    }
}

static void write_curves(const CzPlot *plot, const Frame *frame, CzMarkup *markup) {
    cz_markup_write(markup, "<g transform='scale(.1)' stroke-width='14'>");
    for (int i = 0; i < plot->n_series; i++)
        if (!is_marked(&plot->series[i]))
            write_curve(frame, &plot->series[i], markup);
    cz_markup_write(markup, "</g>");
    write_marks(plot, frame, markup);
}

/* ---- legend ---- */

typedef struct Legend {
    CzMarkup *markup; /* NULL: only the height is computed */
    double x, y;      /* of the sample of the next entry, and of its text */
} Legend;

/* Writes the name of an entry and returns where its sample is. */
static double put_entry(Legend *legend, const char *name) {
    const double width = SAMPLE_WIDTH + FONT_SIZE * cz_text_width(name) + 12;
    if (legend->x > LEFT && legend->x + width > CZ_PLOT_WIDTH) {
        legend->x = LEFT;
        legend->y += LEGEND_ROW;
    }
    const double x = legend->x;
    legend->x += width;
    if (legend->markup != NULL)
        cz_svg_text(legend->markup, x + SAMPLE_WIDTH, legend->y, "start", name);
    return x;
}

static void put_line(Legend *legend, const char *name, const char *colour, const char *dash) {
    const double x = put_entry(legend, name);
    if (legend->markup == NULL)
        return;
    open_line(legend->markup, x, legend->y - 4, x + SAMPLE_WIDTH - 5, legend->y - 4);
    cz_markup_write(legend->markup, " stroke='%s' stroke-width='2'", colour);
    if (dash != NULL)
        cz_markup_write(legend->markup, " stroke-dasharray='%s'", dash);
    cz_markup_write(legend->markup, "/>");
}

static void put_mark(Legend *legend, const CzSeries *series) {
    const double x = put_entry(legend, series->name);
    if (legend->markup != NULL)
        write_mark(legend->markup, series, x + SAMPLE_WIDTH / 2 - 2, legend->y - 4);
}

static void put_limit(Legend *legend, const CzPlotLimit *limit) {
    char name[CZ_LABEL_SIZE + 8];
    snprintf(name, sizeof name, "limit: %s", limit->name);
    put_line(legend, name, "#d0021b", "10 4");
}

static void put_band(Legend *legend, const CzPlotBand *band) {
    const double x = put_entry(legend, band->name);
    if (legend->markup != NULL)
        cz_markup_write(legend->markup,
                        "<rect x='%.1f' y='%.1f' width='18' height='11' fill='%s' "
                        "fill-opacity='.3'/>",
                        x, legend->y - 10, cz_plot_colour(band->colour));
}

static bool is_named_before(const CzPlot *plot, int band) {
    for (int i = 0; i < band; i++)
        if (plot->band[i].name != NULL && strcmp(plot->band[i].name, plot->band[band].name) == 0)
            return true;
    return false;
}

/* Writes the legend from `top` on, or only computes its height. */
static double write_legend(const CzPlot *plot, double top, CzMarkup *markup) {
    Legend legend = {markup, LEFT, top + 12};
    for (int i = 0; i < plot->n_series; i++)
        if (plot->series[i].name != NULL && is_marked(&plot->series[i]))
            put_mark(&legend, &plot->series[i]);
        else if (plot->series[i].name != NULL)
            put_line(&legend, plot->series[i].name, cz_plot_colour(plot->series[i].colour),
                     cz_plot_dash(plot->series[i].dash));
    for (int i = 0; i < plot->n_limit; i++)
        put_limit(&legend, &plot->limit[i]);
    for (int i = 0; i < plot->n_band; i++)
        if (plot->band[i].name != NULL && !is_named_before(plot, i))
            put_band(&legend, &plot->band[i]);
    return legend.x > LEFT ? legend.y + 6 - top : 0;
}

void cz_plot_write(const CzPlot *plot, CzMarkup *markup) {
    const Frame frame = frame_of(plot);
    const double bottom = TOP + frame.height + BELOW_AXIS;
    char range[4][CZ_FIGURE_SIZE];
    cz_svg_open(markup, plot->title, CZ_PLOT_WIDTH, bottom + write_legend(plot, bottom, NULL));
    cz_markup_write(
        markup,
        " preserveAspectRatio='xMidYMin' class='%s' data-box='%d %d %d %d' "
        "data-range='%s %s %s %s'>\n",
        plot->is_still  ? "still"
        : plot->is_time ? "plot time"
                        : "plot",
        (int)LEFT, (int)TOP, (int)frame.width, (int)frame.height,
        cz_figure_digits(range[0], 12, frame.x_min), cz_figure_digits(range[1], 12, frame.x_max),
        cz_figure_digits(range[2], 12, frame.y_min), cz_figure_digits(range[3], 12, frame.y_max));
    write_bands(plot, &frame, markup);
    write_x_axis(plot, &frame, markup);
    write_y_axis(plot, &frame, markup);
    write_limits(plot, &frame, markup);
    cz_markup_write(markup, "\n");
    write_curves(plot, &frame, markup);
    cz_markup_write(markup, "\n");
    write_legend(plot, bottom, markup);
    cz_markup_write(markup, "</svg>\n");
}

void cz_plot_write_figure(const CzPlot *plot, CzMarkup *markup) {
    cz_markup_write(markup, "<figure><figcaption>%s</figcaption>", plot->title);
    cz_plot_write(plot, markup);
    cz_markup_write(markup, "</figure>\n");
}
