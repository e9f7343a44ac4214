/* Figures of a sampling. */
#include "report/sample_figures.h"

#include "report/figure.h"
#include "report/plot.h"
#include "report/sample_values.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MIN_PERCENT -100.0 /* margins beyond these are drawn at them */
#define MAX_PERCENT 200.0

/* Margin as drawn [%]; NaN for none, the smallest one drawn for a run that failed. */
static double percent_of(const CzSampling *sampling, int sample, int check) {
    const double margin = cz_sample_margin(sampling, sample, check);
    return isnan(margin) ? NAN : fmin(fmax(100 * margin, MIN_PERCENT), MAX_PERCENT);
}

static void format_check(const CzSampledCheck *check, size_t room, char *text) {
    snprintf(text, room, "%s, %s", check->name, check->scenario);
}

/* ---- histogram ---- */

enum { MIN_BINS = 8, MAX_BINS = 72 };

typedef struct Histogram {
    double from, step; /* [%] */
    int n_bin, most;
    int count[MAX_BINS];
} Histogram;

static Histogram histogram_of(const CzSampling *sampling, int check) {
    Histogram histogram = {0};
    double least = INFINITY, most = -INFINITY;
    for (int k = 0; k < sampling->n_sample; k++) {
        least = fmin(least, percent_of(sampling, k, check)); /* fmin ignores NaN */
        most = fmax(most, percent_of(sampling, k, check));
    }
    if (!(least <= most))
        return histogram;
    const double n_bin = fmin(fmax(2 * sqrt(sampling->n_run), MIN_BINS), MAX_BINS / 3.0);
    histogram.step = cz_plot_round_step(fmax(most - least, 0.1), (int)n_bin);
    histogram.from = floor(least / histogram.step) * histogram.step;
    for (int k = 0; k < sampling->n_sample; k++) {
        const double place = (percent_of(sampling, k, check) - histogram.from) / histogram.step;
        if (isnan(place))
            continue;
        const int bin = (int)fmin(fmax(place, 0), MAX_BINS - 1);
        histogram.n_bin = bin + 1 > histogram.n_bin ? bin + 1 : histogram.n_bin;
        if (++histogram.count[bin] > histogram.most)
            histogram.most = histogram.count[bin];
    }
    return histogram;
}

/* A vertical line at a margin of the nominal design. */
static CzSeries mark(const char *name, double margin, double most, int colour, int dash,
                     double x[2], double y[2]) {
    x[0] = x[1] = fmin(fmax(100 * margin, MIN_PERCENT), MAX_PERCENT);
    y[0] = 0;
    y[1] = most;
    return (CzSeries){.name = name, .n = 2, .x = x, .y = y, .colour = colour, .dash = dash};
}

void cz_sample_draw_histogram(const CzSampling *sampling, int check, CzMarkup *markup) {
    const CzSampledCheck *sampled = &sampling->check[check];
    const Histogram histogram = histogram_of(sampling, check);
    double x[4 * MAX_BINS], y[4 * MAX_BINS], mark_x[2][2], mark_y[2][2];
    char title[CZ_SENTENCE_SIZE];
    int n = 0, n_series = 1;
    for (int bin = 0; bin < histogram.n_bin; bin++)
        for (int corner = 0; corner < 4; corner++, n++) {
            x[n] = histogram.from + histogram.step * (bin + corner / 2);
            y[n] = corner == 1 || corner == 2 ? histogram.count[bin] : 0;
        }
    CzSeries series[3] = {{.n = n, .x = x, .y = y, .form = CZ_SERIES_AREA}};
    const bool are_equal = fabs(sampled->nominal - sampled->bare) < 1e-9;
    if (!isnan(sampled->nominal) && !are_equal)
        series[n_series++] = mark("nominal, with reserves", sampled->nominal, histogram.most, 1, 1,
                                  mark_x[0], mark_y[0]);
    if (!isnan(sampled->bare))
        series[n_series++] = mark(are_equal ? "nominal design" : "nominal, as samples",
                                  sampled->bare, histogram.most, 2, 0, mark_x[1], mark_y[1]);
    const CzPlotBand band = {"FAIL", 2 * MIN_PERCENT, 0, 1};
    format_check(sampled, sizeof title, title);
    const CzPlot plot = {.title = title,
                         .x_label = "margin [%]",
                         .y_label = "samples",
                         .n_series = n_series,
                         .series = series,
                         .n_band = histogram.from < 0,
                         .band = &band,
                         .from_zero = true,
                         .counts = true,
                         .height = 150};
    cz_plot_write_figure(&plot, markup);
}

/* ---- strongest draws ---- */

enum { MAX_ROWS = 10 };

/* The n strongest draws of a check, from the strongest on; returns their number. */
static int strongest_draws(const CzSampling *sampling, int check, int n, int *draw) {
    const double *correlation = sampling->check[check].correlation;
    int n_found = 0;
    for (int d = 0; d < sampling->n_draw; d++) {
        if (isnan(correlation[d]))
            continue;
        int at = n_found < n ? n_found++ : n;
        for (; at > 0 && fabs(correlation[draw[at - 1]]) < fabs(correlation[d]); at--)
            if (at < n)
                draw[at] = draw[at - 1];
        if (at < n)
            draw[at] = d;
    }
    return n_found;
}

#define ROW 35.0
#define MIDDLE (CZ_PLOT_WIDTH / 2.0)
#define HALF 190.0 /* length of a bar for a correlation of 1 */
#define HEAD 6.0
#define FONT_SIZE 11.0

/* Writes a name, its start cut where it is too wide. */
static void write_name(CzMarkup *markup, double x, double y, double width, const char *name) {
    char text[CZ_SENTENCE_SIZE];
    const char *from = name;
    snprintf(text, sizeof text, "%.1400s", name);
    while (*from != '\0' && FONT_SIZE * cz_text_width(text) > width) {
        do
            from++;
        while (((unsigned char)*from & 0xc0) == 0x80); /* a whole character */
        snprintf(text, sizeof text, "\xe2\x80\xa6%.1400s", from);
    }
    cz_svg_text(markup, x, y, "start", text);
}

static void write_bar(CzMarkup *markup, double correlation, double y) {
    char text[CZ_FIGURE_SIZE];
    const double length = HALF * fabs(correlation);
    const bool rises = correlation >= 0;
    cz_markup_write(markup,
                    "<rect x='%.1f' y='%.1f' width='%.1f' height='11' fill='%s' "
                    "fill-opacity='.8'/>",
                    rises ? MIDDLE : MIDDLE - length, y, fmax(length, 0.5),
                    cz_plot_colour(rises ? 2 : 1));
    cz_svg_text(markup, rises ? MIDDLE + length + 5 : MIDDLE - length - 5, y + 9.5,
                rises ? "start" : "end", cz_figure_fixed(text, 2, correlation));
}

static void write_scale(CzMarkup *markup, double bottom) {
    for (int i = -2; i <= 2; i++) {
        char text[CZ_FIGURE_SIZE];
        const double x = MIDDLE + HALF * i / 2;
        cz_markup_write(markup,
                        "<path d='M%ld %ldV%ld' stroke='currentColor' stroke-opacity='%s'/>",
                        lround(x), lround(HEAD), lround(bottom), i == 0 ? ".6" : ".15");
        cz_svg_text(markup, x, bottom + 15, "middle", cz_figure_digits(text, 2, i / 2.0));
    }
    cz_svg_text(markup, MIDDLE, bottom + 31, "middle",
                "rank correlation of the random number with the margin");
}

void cz_sample_draw_tornado(const CzSampling *sampling, int check, CzMarkup *markup) {
    char title[CZ_SENTENCE_SIZE];
    int draw[MAX_ROWS];
    const int n = strongest_draws(sampling, check, MAX_ROWS, draw);
    const double bottom = HEAD + ROW * n;
    format_check(&sampling->check[check], sizeof title, title);
    cz_markup_write(markup, "<figure><figcaption>%s</figcaption>", title);
    cz_svg_open(markup, title, CZ_PLOT_WIDTH, bottom + 38);
    cz_markup_write(markup, " preserveAspectRatio='xMidYMin'>");
    write_scale(markup, bottom);
    for (int i = 0; i < n; i++) {
        const double y = HEAD + ROW * i;
        write_name(markup, 4, y + 13, CZ_PLOT_WIDTH - 8, sampling->draw[draw[i]].name);
        write_bar(markup, sampling->check[check].correlation[draw[i]], y + 18);
    }
    cz_markup_write(markup, "</svg></figure>\n");
}

/* ---- scatter matrix ---- */

enum { MAX_DRAWS = 4, MAX_DOTS = 1000 }; /* of each cell */

#define MATRIX_LEFT 52.0
#define MATRIX_WIDTH 720.0
#define GAP 8.0

/* The axes of a matrix: the margin, then draws. */
typedef struct Matrix {
    const CzSampling *sampling;
    int check, n; /* n axes */
    int draw[MAX_DRAWS];
    double low[MAX_DRAWS + 1], high[MAX_DRAWS + 1];
    double cell; /* width and height */
} Matrix;

static double value_on(const Matrix *matrix, int axis, int sample) {
    return axis == 0 ? percent_of(matrix->sampling, sample, matrix->check)
                     : cz_sample_value(matrix->sampling, sample, matrix->draw[axis - 1]);
}

static void find_ranges(Matrix *matrix) {
    for (int axis = 0; axis < matrix->n; axis++) {
        double low = INFINITY, high = -INFINITY;
        for (int k = 0; k < matrix->sampling->n_sample; k++)
            if (matrix->sampling->sample[k].state != CZ_SAMPLE_NOT_RUN) {
                low = fmin(low, value_on(matrix, axis, k));
                high = fmax(high, value_on(matrix, axis, k));
            }
        if (!(low < high))
            low -= 0.5, high += 0.5;
        matrix->low[axis] = low;
        matrix->high[axis] = high;
    }
}

static double cell_x(const Matrix *matrix, int column) {
    return MATRIX_LEFT + column * (matrix->cell + GAP);
}

static double cell_y(const Matrix *matrix, int row) {
    return HEAD + row * (matrix->cell + GAP);
}

/* Dots of the samples that pass or fail the check, in one cell. */
static void write_dots(CzMarkup *markup, const Matrix *matrix, int row, int column, bool fails) {
    const double x0 = cell_x(matrix, column), y0 = cell_y(matrix, row), inside = matrix->cell - 8;
    cz_markup_write(markup,
                    "<path stroke='%s' stroke-width='%s' stroke-opacity='.65' "
                    "stroke-linecap='round' d='",
                    cz_plot_colour(fails ? 1 : 0), fails ? "4" : "3");
    for (int k = 0, n = 0; k < matrix->sampling->n_sample && n < MAX_DOTS; k++) {
        const double across = value_on(matrix, column, k), up = value_on(matrix, row, k);
        if (matrix->sampling->sample[k].state == CZ_SAMPLE_NOT_RUN || isnan(across) || isnan(up))
            continue;
        n++;
        if ((percent_of(matrix->sampling, k, matrix->check) < 0) != fails)
            continue;
        const double share_x =
            (across - matrix->low[column]) / (matrix->high[column] - matrix->low[column]);
        const double share_y = (up - matrix->low[row]) / (matrix->high[row] - matrix->low[row]);
        cz_markup_write(markup, "M%.1f %.1fh0", x0 + 4 + share_x * inside,
                        y0 + 4 + (1 - share_y) * inside);
    }
    cz_markup_write(markup, "'/>");
}

/* Smallest and largest number of an axis, at the left of a row or below a column. */
static void write_range(CzMarkup *markup, const Matrix *matrix, int axis, bool at_left) {
    char low[CZ_FIGURE_SIZE], high[CZ_FIGURE_SIZE];
    const double x = cell_x(matrix, axis), y = cell_y(matrix, axis);
    cz_figure_digits(low, 3, matrix->low[axis]);
    cz_figure_digits(high, 3, matrix->high[axis]);
    if (at_left) {
        cz_svg_text(markup, MATRIX_LEFT - 5, y + matrix->cell - 2, "end", low);
        cz_svg_text(markup, MATRIX_LEFT - 5, y + 10, "end", high);
        return;
    }
    const double below = cell_y(matrix, matrix->n - 1) + matrix->cell + 14;
    cz_svg_text(markup, x, below, "start", low);
    cz_svg_text(markup, x + matrix->cell, below, "end", high);
}

/* Zero of the margin, in the cells that have it. */
static void write_zero(CzMarkup *markup, const Matrix *matrix, int row) {
    const double share = -matrix->low[0] / (matrix->high[0] - matrix->low[0]);
    if (share <= 0 || share >= 1)
        return;
    const double x = cell_x(matrix, 0) + 4 + share * (matrix->cell - 8);
    cz_markup_write(markup, "<path d='M%.1f %.1fv%.1f' stroke='#d0021b' stroke-dasharray='6 3'/>",
                    x, cell_y(matrix, row), matrix->cell);
}

static void write_cell(CzMarkup *markup, const Matrix *matrix, int row, int column) {
    const double x = cell_x(matrix, column), y = cell_y(matrix, row);
    cz_markup_write(markup,
                    "<rect x='%.1f' y='%.1f' width='%.1f' height='%.1f' stroke='currentColor' "
                    "stroke-opacity='.35'/>",
                    x, y, matrix->cell, matrix->cell);
    if (row == column) {
        char text[24] = "margin";
        if (row > 0)
            snprintf(text, sizeof text, "%d", row);
        cz_markup_write(markup,
                        "<text x='%.1f' y='%.1f' text-anchor='middle' font-size='15' "
                        "font-weight='bold' fill='currentColor'>%s</text>",
                        x + matrix->cell / 2, y + matrix->cell / 2 + 5, text);
        return;
    }
    if (column == 0)
        write_zero(markup, matrix, row);
    write_dots(markup, matrix, row, column, false);
    write_dots(markup, matrix, row, column, true);
}

/* What the numbers on the diagonal mean. */
static void write_key(CzMarkup *markup, const Matrix *matrix, double top) {
    char text[CZ_SENTENCE_SIZE];
    format_check(&matrix->sampling->check[matrix->check], sizeof text, text);
    char line[CZ_SENTENCE_SIZE + 40];
    snprintf(line, sizeof line, "margin [%%]: %s; orange dots fail it", text);
    write_name(markup, MATRIX_LEFT, top, MATRIX_WIDTH - MATRIX_LEFT, line);
    for (int axis = 1; axis < matrix->n; axis++) {
        const CzDraw *draw = &matrix->sampling->draw[matrix->draw[axis - 1]];
        snprintf(line, sizeof line, "%d: %.400s%s%s%s", axis, draw->name,
                 draw->effect == CZ_DRAW_FACTOR ? ", factor"
                 : draw->unit[0] != '\0'        ? " ["
                                                : "",
                 draw->effect == CZ_DRAW_FACTOR ? "" : draw->unit,
                 draw->effect != CZ_DRAW_FACTOR && draw->unit[0] != '\0' ? "]" : "");
        write_name(markup, MATRIX_LEFT, top + 16 * axis, MATRIX_WIDTH - MATRIX_LEFT, line);
    }
}

void cz_sample_draw_matrix(const CzSampling *sampling, int check, CzMarkup *markup) {
    Matrix matrix = {.sampling = sampling, .check = check};
    matrix.n = 1 + strongest_draws(sampling, check, MAX_DRAWS, matrix.draw);
    matrix.cell = fmin((MATRIX_WIDTH - MATRIX_LEFT - 10) / matrix.n - GAP, 170);
    find_ranges(&matrix);
    const double below = cell_y(&matrix, matrix.n) + 28;
    cz_svg_open(markup, "Margin of the worst check and its strongest random numbers, in pairs",
                MATRIX_WIDTH, below + 16 * (matrix.n - 1) + 8);
    cz_markup_write(markup, " class='elevation'>");
    for (int row = 0; row < matrix.n; row++) {
        for (int column = 0; column <= row; column++)
            write_cell(markup, &matrix, row, column);
        if (row > 0)
            write_range(markup, &matrix, row, true);
        if (row < matrix.n - 1)
            write_range(markup, &matrix, row, false);
    }
    write_key(markup, &matrix, below);
    cz_markup_write(markup, "</svg>\n");
}

/* ---- convergence ---- */

enum { MAX_SHARES = 32 };

void cz_sample_draw_convergence(const CzSampling *sampling, CzMarkup *markup) {
    double x[MAX_SHARES], y[3][MAX_SHARES];
    int n = 0;
    for (int i = 0; i < sampling->n_convergence && n < MAX_SHARES; i++, n++) {
        const CzSampledShare *share = &sampling->convergence[i];
        x[n] = share->n;
        y[0][n] = 100 * share->share;
        y[1][n] = 100 * share->low;
        y[2][n] = 100 * share->high;
    }
    const CzSeries series[] = {
        {.name = "samples that pass", .n = n, .x = x, .y = y[0]},
        {.name = "95 % interval", .n = n, .x = x, .y = y[1], .colour = 5, .dash = 1},
        {.n = n, .x = x, .y = y[2], .colour = 5, .dash = 1}};
    const CzPlot plot = {.title = "Share of passing samples among the first 1, 2, 4, ...",
                         .x_label = "samples",
                         .y_label = "share [%]",
                         .n_series = 3,
                         .series = series,
                         .from_zero = true,
                         .height = 150};
    cz_plot_write_figure(&plot, markup);
}
