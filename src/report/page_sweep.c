/* A sweep as a page: margin and metrics over one value, or a map of verdicts over two. */
#include "report/page_sweep.h"

#include "base/error.h"
#include "report/figure.h"
#include "report/page.h"
#include "report/plot.h"
#include "report/sweep_curves.h"
#include "report/verdict_words.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MAX_PERCENT 100.0 /* margins below its negative are drawn at it */
#define MAP_LEFT 80.0
#define MAP_TOP 10.0
#define MAP_BELOW 70.0 /* numbers, label and legend */

/* ---- curves over one value ---- */

/* Bands around the points that fail, to halfway between neighbouring points. Returns their number;
 * `bands` has room for n_point. */
static int failing_bands(const CzSweep *sweep, CzPlotBand *bands) {
    int n = 0;
    for (int i = 0; i < sweep->n_point; i++) {
        const CzSweepPoint *point = &sweep->point[i];
        const bool fails = point->state == CZ_SWEEP_RUN_FAILED ||
                           (point->state == CZ_SWEEP_DONE && point->verdict == CZ_VERDICT_FAIL);
        if (!fails)
            continue;
        const double before = i > 0 ? sweep->point[i - 1].value[0] : point->value[0];
        const double after = i + 1 < sweep->n_point ? point[1].value[0] : point->value[0];
        const double ends[] = {(before + point->value[0]) / 2, (after + point->value[0]) / 2};
        bands[n++] = (CzPlotBand){"FAIL", fmin(ends[0], ends[1]), fmax(ends[0], ends[1]), 1};
    }
    return n;
}

static void write_curve(CzMarkup *markup, const CzSweep *sweep, const char *title,
                        const char *y_label, bool has_limit, const double *x, const double *y,
                        int n_band, const CzPlotBand *band) {
    const CzSeries series = {
        .name = "each point the worst place and scenario", .n = sweep->n_point, .x = x, .y = y};
    const CzPlotLimit limit = {"no margin left", 0};
    const CzPlot plot = {.title = title,
                         .x_label = sweep->axis[0].path,
                         .y_label = y_label,
                         .n_series = 1,
                         .series = &series,
                         .n_limit = has_limit,
                         .limit = &limit,
                         .n_band = n_band,
                         .band = band,
                         .from_zero = true};
    cz_plot_write_figure(&plot, markup);
}

static CzStatus write_curves(CzMarkup *markup, const CzSweep *sweep, CzError *error) {
    const size_t n = (size_t)sweep->n_point;
    double *x = malloc(2 * (n + 1) * sizeof *x);
    CzPlotBand *band = malloc((n + 1) * sizeof *band);
    const bool fits = x != NULL && band != NULL;
    if (fits) {
        double *y = x + n;
        const int n_band = failing_bands(sweep, band);
        for (size_t i = 0; i < n; i++) {
            x[i] = sweep->point[i].value[0];
            const double percent = 100 * sweep->point[i].margin;
            y[i] = percent < -MAX_PERCENT ? -MAX_PERCENT : percent; /* NaN stays a gap */
        }
        write_curve(markup, sweep, "Smallest margin of all checks (below -100 % drawn at -100 %)",
                    "margin [%]", true, x, y, n_band, band);
        for (int k = 0; k < sweep->n_metric; k++) {
            bool is_known = false;
            for (size_t i = 0; i < n; i++) {
                y[i] = sweep->point[i].metric[k];
                is_known |= isfinite(y[i]) != 0;
            }
            char title[CZ_SENTENCE_SIZE];
            snprintf(title, sizeof title, "%c%s", toupper((unsigned char)*sweep->metric_doc[k]),
                     sweep->metric_doc[k] + 1);
            if (is_known) /* unknown metrics are in the table only */
                write_curve(markup, sweep, title, sweep->metric[k], false, x, y, n_band, band);
        }
    }
    free(x);
    free(band);
    return fits ? CZ_OK : cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the report");
}

/* ---- the map ---- */

static void write_cell(CzMarkup *markup, const CzSweepPoint *point, double x, double y,
                       double width, double height) {
    const CzPointStyle look = cz_point_style(point);
    cz_markup_write(markup,
                    "<rect x='%.1f' y='%.1f' width='%.1f' height='%.1f' fill='%s' "
                    "fill-opacity='.75' stroke='currentColor' stroke-width='.4'/>",
                    x, y, width, height, look.colour);
    if (width >= 8 && height >= 10)
        cz_svg_text(markup, x + width / 2, y + height / 2 + 4, "middle",
                    look.sign[0] != ' ' ? look.sign : "");
}

/* Whether a row or column is numbered, so that numbers do not overlap. */
static bool is_numbered(int index, double size, double needed) {
    const int every = size >= needed ? 1 : (int)ceil(needed / size);
    return index % every == 0;
}

static void write_map(CzMarkup *markup, const CzSweep *sweep) {
    const int n_row = sweep->axis[0].n, n_column = sweep->axis[1].n;
    const double width = (CZ_PLOT_WIDTH - MAP_LEFT - 8) / n_column;
    const double height = fmax(6, fmin(24, 360.0 / n_row));
    const double bottom = MAP_TOP + height * n_row;
    cz_markup_write(markup, "<figure><figcaption>Verdicts</figcaption>");
    cz_svg_open(markup, "Map of verdicts", CZ_PLOT_WIDTH, bottom + MAP_BELOW);
    cz_markup_write(markup, ">");
    for (int row = 0; row < n_row; row++) {
        char text[CZ_FIGURE_SIZE];
        const double y = bottom - height * (row + 1); /* upwards, as in any diagram */
        if (is_numbered(row, height, 13))
            cz_svg_text(markup, MAP_LEFT - 5, y + height / 2 + 4, "end",
                        cz_figure_digits(text, 5, cz_sweep_axis_value(&sweep->axis[0], row)));
        for (int column = 0; column < n_column; column++)
            write_cell(markup, &sweep->point[row * n_column + column], MAP_LEFT + width * column, y,
                       width, height);
    }
    for (int column = 0; column < n_column; column++) {
        char text[CZ_FIGURE_SIZE];
        if (is_numbered(column, width, 38))
            cz_svg_text(markup, MAP_LEFT + width * (column + 0.5), bottom + 14, "middle",
                        cz_figure_digits(text, 5, cz_sweep_axis_value(&sweep->axis[1], column)));
    }
    cz_svg_text(markup, MAP_LEFT, bottom + 32, "start", sweep->axis[1].path);
    char up[CZ_SENTENCE_SIZE];
    snprintf(up, sizeof up, "upwards: %s", sweep->axis[0].path);
    cz_svg_text(markup, MAP_LEFT, bottom + 47, "start", up);
    cz_svg_text(markup, MAP_LEFT, bottom + 64, "start", CZ_MAP_SIGNS);
    cz_markup_write(markup, "</svg></figure>\n");
}

CzStatus cz_page_write_sweep(const CzSweep *sweep, FILE *stream, CzError *error) {
    CzMarkup markup = {.stream = stream};
    CzReportTable table;
    char title[CZ_SENTENCE_SIZE];
    snprintf(title, sizeof title, "%s, swept", cz_problem_title(sweep->problem));
    cz_page_write_head(&markup, title);
    cz_markup_write(&markup, "<h1>%s</h1>", title);
    cz_page_write_document(&markup, sweep->problem);
    if (sweep->is_interrupted)
        cz_markup_write(&markup,
                        "<p class='fail'>The sweep was interrupted: points or their curves are "
                        "missing.</p>");
    for (int i = 0; i < sweep->n_unreached;) {
        i += cz_sweep_unreached_sentence(sweep, i, title);
        cz_markup_write(&markup, "<p><strong>Warning</strong>: %s.</p>", title);
    }
    if (cz_sweep_is_beyond(sweep))
        cz_markup_write(&markup, "<p class='fail'>" CZ_SWEEP_BEYOND "</p>");
    cz_screening_write(sweep->problem, &markup);
    cz_markup_write(&markup, "<section id='figures'>\n<h2>%s</h2>\n<div class='figures'>",
                    sweep->n_axis == 1 ? "Over the value" : "Map");
    if (sweep->n_axis == 1)
        CZ_TRY(write_curves(&markup, sweep, error));
    else
        write_map(&markup, sweep);
    cz_markup_write(&markup, "</div></section>\n");
    cz_sweep_write_curves(sweep, &markup);
    cz_markup_write(&markup, "<section id='points'>\n<h2>Points</h2>\n");
    if (sweep->n_axis > 1)
        cz_markup_write(&markup, "<details><summary>Every point of the map</summary>");
    cz_sweep_begin_points(&table, sweep, true);
    table.class_name = "points cards";
    cz_table_write_page(&table, &markup);
    cz_markup_write(&markup, sweep->n_axis > 1 ? "</details></section>\n" : "</section>\n");
    cz_page_write_foot(&markup);
    return markup.failed ? cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the report") : CZ_OK;
}
