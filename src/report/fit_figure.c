/* A fitted law and its measured curve. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/error.h"
#include "crushzone/report.h"
#include "report/figure.h"
#include "report/plot.h"
#include "report/units.h"

/* Strokes in mm and forces in kN, in one block; NULL without memory. */
static double *scaled(const CzFitLoading *loading) {
    const int n = loading->n;
    double *values = malloc(2 * (size_t)n * sizeof *values);
    for (int i = 0; values != NULL && i < n; i++) {
        values[i] = loading->stroke[i] * CZ_MILLI_PER_UNIT;
        values[n + i] = loading->force[i] / CZ_KILO;
    }
    return values;
}

static const char *verdict_text(CzFitVerdict verdict) {
    return verdict == CZ_FIT_GOOD ? "" : verdict == CZ_FIT_DOUBTFUL ? "doubtful: " : "REFUSED: ";
}

CzStatus cz_report_write_fit_figure(const CzFit *fit, FILE *stream, CzError *error) {
    const CzFitSummary *summary = cz_fit_summary(fit);
    const int n[] = {summary->curve.n, summary->law.n};
    char title[200], number[CZ_FIGURE_ROOM];
    double *values[] = {scaled(&summary->curve), scaled(&summary->law)};
    const bool has_memory = values[0] != NULL && values[1] != NULL;
    CzMarkup markup = {.stream = stream, .failed = !has_memory};
    if (has_memory) {
        const CzSeries series[] = {
            {.name = "measured", .n = n[0], .x = values[0], .y = values[0] + n[0], .colour = 0},
            {.name = "law",
             .n = n[1],
             .x = values[1],
             .y = values[1] + n[1],
             .colour = 1,
             .dash = 1}};
        snprintf(title, sizeof title, "%s%s as %s, root mean square %s %% of the mean force",
                 verdict_text(summary->verdict), summary->name, cz_fit_kind_word(summary->kind),
                 cz_figure_plain(number, 100.0 * summary->mean_square / summary->mean_force));
        const CzPlot plot = {.title = title,
                             .x_label = "stroke mm",
                             .y_label = "force kN",
                             .n_series = 2,
                             .series = series,
                             .from_zero = true,
                             .height = 260};
        cz_svg_begin_document(&markup);
        cz_plot_write(&plot, &markup);
    }
    free(values[0]);
    free(values[1]);
    return markup.failed ? cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for a figure") : CZ_OK;
}
