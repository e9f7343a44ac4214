/* Curves of all points of a sweep over one another: force over closure, force and speed over time.
 */
#include "report/sweep_curves.h"

#include "base/error.h"
#include "crushzone/report.h"
#include "report/charts.h"
#include "report/figure.h"

#include <string.h>

/* The figures of a sweep, by the names of those of a run. */
static const struct {
    const char *name, *title;
    CzChart chart;
} figures[] = {{"fd", "Force over closure of the colliding interface", CZ_CHART_FORCE_CLOSURE},
               {"force", "Force of the colliding interface", CZ_CHART_FORCE},
               {"velocity", "Speed of the car behind the colliding interface", CZ_CHART_VELOCITY}};
enum { N_FIGURE = sizeof figures / sizeof *figures, LABEL_SIZE = 160 };

/* The last two keys of a path, such as "A.speed_km_h". */
static const char *short_path(const char *path) {
    const char *last = strrchr(path, '.'), *at = last;
    while (at != NULL && at > path && at[-1] != '.')
        at--;
    return at != NULL ? at : path;
}

/* The values of a point, such as "A.speed_km_h 8", marked after an override. */
static const char *label_of(const CzSweep *sweep, const CzSweepCurve *curve,
                            char text[LABEL_SIZE]) {
    const CzSweepPoint *point = &sweep->point[curve->point];
    char number[CZ_FIGURE_SIZE];
    int n = 0;
    for (int k = 0; k < sweep->n_axis; k++)
        n +=
            snprintf(text + n, (size_t)(LABEL_SIZE - n), "%s%.40s %.20s", k > 0 ? ", " : "",
                     short_path(sweep->axis[k].path), cz_figure_digits(number, 6, point->value[k]));
    if (point->beyond_validity)
        snprintf(text + n, (size_t)(LABEL_SIZE - n), " (override)");
    return text;
}

static const double *values_of(const CzSweepCurve *curve, CzDrawn drawn) {
    return drawn == CZ_DRAWN_TIME                           ? curve->time
           : drawn == (CzDrawn)CZ_CHANNEL_BODY_SPEED        ? curve->speed
           : drawn == (CzDrawn)CZ_CHANNEL_INTERFACE_FORCE   ? curve->force
           : drawn == (CzDrawn)CZ_CHANNEL_INTERFACE_CLOSURE ? curve->closure
                                                            : NULL;
}

/* Title of a figure, with the paths of the values in its legend. */
static void make_title(const CzSweep *sweep, int figure, char title[CZ_SENTENCE_SIZE]) {
    snprintf(title, CZ_SENTENCE_SIZE, "%s, %.48s, by %.160s%s%.160s", figures[figure].title,
             sweep->curve_scenario, sweep->axis[0].path, sweep->n_axis > 1 ? " and " : "",
             sweep->n_axis > 1 ? sweep->axis[1].path : "");
}

static void write_figure(const CzSweep *sweep, int figure, bool is_alone, CzMarkup *markup) {
    const CzChartInfo *chart = &cz_charts[figures[figure].chart];
    CzSeries series[CZ_MAX_SWEPT_CURVES];
    char label[2][CZ_DRAWN_LABEL], name[CZ_MAX_SWEPT_CURVES][LABEL_SIZE];
    char title[CZ_SENTENCE_SIZE];
    int n = 0;
    for (int i = 0; i < sweep->n_curve; i++) {
        const CzSweepCurve *curve = &sweep->curve[i];
        const double *x = values_of(curve, chart->x), *y = values_of(curve, chart->y);
        if (x != NULL && y != NULL)
            series[n++] = (CzSeries){.name = label_of(sweep, curve, name[i]),
                                     .n = curve->n,
                                     .x = x,
                                     .y = y,
                                     .colour = i,
                                     .dash = i / CZ_PLOT_N_COLOUR};
    }
    make_title(sweep, figure, title);
    const CzPlot plot = {.title = title,
                         .x_label = cz_drawn_label(chart->x, label[0]),
                         .y_label = cz_drawn_label(chart->y, label[1]),
                         .n_series = n,
                         .series = series,
                         .from_zero = true};
    if (is_alone)
        cz_plot_write(&plot, markup);
    else
        cz_plot_write_figure(&plot, markup);
}

void cz_sweep_write_curves(const CzSweep *sweep, CzMarkup *markup) {
    if (sweep->n_curve == 0)
        return;
    cz_markup_write(markup, "<section id='curves'>\n<h2>Curves, scenario %s</h2>\n",
                    sweep->curve_scenario);
    if (sweep->n_curve < sweep->n_point)
        cz_markup_write(markup, "<p>%d of %d points.</p>\n", sweep->n_curve, sweep->n_point);
    cz_markup_write(markup, "<div class='figures'>");
    for (int i = 0; i < N_FIGURE; i++)
        write_figure(sweep, i, false, markup);
    cz_markup_write(markup, "</div></section>\n");
}

CzStatus cz_report_write_sweep_chart(const CzSweep *sweep, const char *what, FILE *stream,
                                     CzError *error) {
    CzMarkup markup = {.stream = stream};
    for (int i = 0; i < N_FIGURE; i++)
        if (strcmp(figures[i].name, what) == 0) {
            cz_svg_begin_document(&markup);
            write_figure(sweep, i, true, &markup);
            return markup.failed ? cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for a figure")
                                 : CZ_OK;
        }
    return cz_fail(error, CZ_STATUS_INPUT,
                   "there is no figure '%.100s' of several points" CZ_HELP
                   "with --vary there are fd, force and velocity",
                   what);
}
