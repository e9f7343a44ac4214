/* The figure of a corridor: nominal curve, shaded corridor, failing curves just beyond it. */
#include "report/page_corridor.h"

#include "base/error.h"
#include "report/corridor_table.h"
#include "report/plot.h"

#include <math.h>
#include <string.h>

/* The force axis begins below the lowest curve, so that a narrow corridor can be seen. */
enum { MAX_POINTS = CZ_MAX_CORRIDOR_POINTS, MAX_FAILING = 2 };

/* Points of a curve as drawn. */
typedef struct Drawn {
    int n;
    double x[MAX_POINTS], y[MAX_POINTS]; /* [mm], [kN] */
} Drawn;

static Drawn curve_of(int n, const double *stroke, const double *force) {
    Drawn drawn = {.n = n};
    for (int i = 0; i < n; i++) {
        drawn.x[i] = 1e3 * stroke[i];
        drawn.y[i] = 1e-3 * force[i];
    }
    return drawn;
}

static Drawn failing_of(const CzCorridor *corridor, const CzTriedCurve *curve) {
    double stroke[CZ_MAX_CORRIDOR_POINTS], force[CZ_MAX_CORRIDOR_POINTS];
    const int n = cz_corridor_law(corridor, curve->factor, stroke, force);
    return curve_of(n, stroke, force);
}

/* The corridor as one closed line: the lower edge, and the upper one back. */
typedef struct Area {
    int n;
    double x[2 * MAX_POINTS], y[2 * MAX_POINTS];
} Area;

static Area area_of(const Drawn *lower, const Drawn *upper) {
    Area area = {.n = 0};
    for (int i = 0; i < lower->n; i++) {
        area.x[area.n] = lower->x[i];
        area.y[area.n++] = lower->y[i];
    }
    for (int i = upper->n - 1; i >= 0; i--) {
        area.x[area.n] = upper->x[i];
        area.y[area.n++] = upper->y[i];
    }
    return area;
}

void cz_corridor_draw(const CzCorridor *corridor, bool is_figure, CzMarkup *markup) {
    const Drawn lower = curve_of(corridor->n_point, corridor->stroke, corridor->lower);
    const Drawn nominal = curve_of(corridor->n_point, corridor->stroke, corridor->nominal);
    const Drawn upper = curve_of(corridor->n_point, corridor->stroke, corridor->upper);
    const Area area = area_of(&lower, &upper);
    Drawn failing[MAX_FAILING];
    CzSeries series[3 + MAX_FAILING];
    int n = 0;
    if (corridor->exists)
        series[n++] = (CzSeries){.name = "corridor",
                                 .n = area.n,
                                 .x = area.x,
                                 .y = area.y,
                                 .colour = 5,
                                 .form = CZ_SERIES_AREA};
    for (int edge = 0; corridor->exists && edge < 2; edge++) {
        if (corridor->edge[edge].failing < 0)
            continue;
        failing[edge] = failing_of(corridor, &corridor->curve[corridor->edge[edge].failing]);
        series[n++] = (CzSeries){.name = edge == 0 ? "fails, beyond the lower edge"
                                                   : "fails, beyond the upper edge",
                                 .n = failing[edge].n,
                                 .x = failing[edge].x,
                                 .y = failing[edge].y,
                                 .colour = 1,
                                 .dash = 1 + edge};
    }
    series[n++] =
        (CzSeries){.name = "nominal", .n = nominal.n, .x = nominal.x, .y = nominal.y, .colour = 0};
    const CzPlot plot = {.title = "Force of one device over its stroke",
                         .x_label = "stroke [mm]",
                         .y_label = "force [kN]",
                         .n_series = n,
                         .series = series,
                         .height = 280};
    if (is_figure)
        cz_plot_write_figure(&plot, markup);
    else
        cz_plot_write(&plot, markup);
}

CzStatus cz_report_write_corridor(const CzCorridor *corridor, FILE *stream, CzError *error) {
    CzMarkup markup = {.stream = stream};
    cz_svg_begin_document(&markup);
    cz_corridor_draw(corridor, false, &markup);
    return markup.failed ? cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for a figure") : CZ_OK;
}
