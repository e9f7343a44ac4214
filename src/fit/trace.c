/* What a curve must be like, and where its unloading begins. */
#include "fit/trace.h"

#include <math.h>
#include <stdio.h>

#include "base/error.h"
#include "base/number.h"

#define STROKE_NOISE 0.01   /* of the largest stroke that it may go back while loading (ours) */
#define FORCE_NOISE 0.02    /* of the largest force that may be below zero (ours) */
#define UNLOADED 0.8        /* an unloading ends below this share of the force (ours) */
#define LARGEST_STROKE 10.0 /* of a stage in the problem file [m] */
#define LARGEST_FORCE 1e8   /* [N] */

static CzStatus refuse(const CzTrace *trace, int i, const char *name, CzError *error) {
    if (error != NULL) {
        snprintf(error->file, sizeof error->file, "%s", name);
        error->line = trace->line[i];
        error->column = 1;
    }
    return CZ_STATUS_INPUT;
}

static CzStatus check_point(const CzTrace *trace, int i, const char *name, CzError *error) {
    char number[CZ_NUMBER_TEXT];
    const double x = trace->x[i], f = trace->f[i];
    const char *wrong = NULL;
    if (!isfinite(x) || !isfinite(f)) {
        cz_fail(error, CZ_STATUS_INPUT, "a point is not finite");
        return refuse(trace, i, name, error);
    }
    if (x < 0.0)
        wrong = "below zero; a curve begins at 0 and compression counts positive";
    else if (x > LARGEST_STROKE)
        wrong = "more than any stage may have; is the unit right?";
    if (wrong != NULL) {
        cz_fail(error, CZ_STATUS_INPUT, "a stroke of %s mm is %s",
                cz_number_print_short(number, 1e3 * x), wrong);
        return refuse(trace, i, name, error);
    }
    if (f > LARGEST_FORCE) {
        cz_fail(error, CZ_STATUS_INPUT,
                "a force of %s kN is more than any stage may have; is the unit right?",
                cz_number_print_short(number, 1e-3 * f));
        return refuse(trace, i, name, error);
    }
    return CZ_OK;
}

/* Forces a little below zero are the noise of a sensor and become zero. */
static CzStatus check_forces(CzTrace *trace, const char *name, CzError *error) {
    char number[CZ_NUMBER_TEXT];
    double peak = 0.0;
    for (int i = 0; i < trace->n; i++)
        peak = fmax(peak, trace->f[i]);
    for (int i = 0; i < trace->n; i++) {
        if (trace->f[i] < -FORCE_NOISE * peak || (peak == 0.0 && trace->f[i] < 0.0)) {
            cz_fail(error, CZ_STATUS_INPUT,
                    "a force of %s kN is below zero; compression counts "
                    "positive",
                    cz_number_print_short(number, 1e-3 * trace->f[i]));
            return refuse(trace, i, name, error);
        }
        trace->f[i] = fmax(trace->f[i], 0.0);
    }
    if (peak > 0.0)
        return CZ_OK;
    cz_fail(error, CZ_STATUS_INPUT, "no point of the curve has a force");
    return refuse(trace, 0, name, error);
}

/* Strokes may go back by noise, else only once, behind the largest. */
static CzStatus check_order(const CzTrace *trace, const char *name, CzError *error) {
    char from[CZ_NUMBER_TEXT], to[CZ_NUMBER_TEXT];
    const double largest = trace->x[trace->n_loading - 1];
    const double noise = STROKE_NOISE * largest;
    double furthest = trace->x[0];
    for (int i = 1; i < trace->n; i++) {
        const bool is_loading = i < trace->n_loading;
        const double back = is_loading ? furthest - trace->x[i] : trace->x[i] - furthest;
        if (back > noise) {
            cz_fail(error, CZ_STATUS_INPUT, "the stroke goes %s from %s to %s mm %s the largest",
                    is_loading ? "back" : "on", cz_number_print_short(from, 1e3 * furthest),
                    cz_number_print_short(to, 1e3 * trace->x[i]),
                    is_loading ? "before" : "again behind");
            if (error != NULL)
                snprintf(error->help, sizeof error->help,
                         "a curve loads once, in the order of the strokes, and unloads at most "
                         "once; leave out cycles between");
            return refuse(trace, i, name, error);
        }
        furthest = is_loading ? fmax(furthest, trace->x[i]) : fmin(furthest, trace->x[i]);
    }
    return CZ_OK;
}

double cz_trace_work(const CzTrace *trace, int from, int to) {
    double work = 0.0;
    for (int i = from + 1; i <= to; i++)
        work += 0.5 * (trace->f[i] + trace->f[i - 1]) * (trace->x[i] - trace->x[i - 1]);
    return work;
}

static CzStatus check_ends(CzTrace *trace, const char *name, CzError *error) {
    char number[CZ_NUMBER_TEXT];
    const int top = trace->n_loading - 1;
    if (trace->x[0] > STROKE_NOISE * trace->x[top]) {
        cz_fail(error, CZ_STATUS_INPUT, "the curve begins at a stroke of %s mm",
                cz_number_print_short(number, 1e3 * trace->x[0]));
        if (error != NULL)
            snprintf(error->help, sizeof error->help,
                     "a curve begins at 0: subtract a gap, or add the points before, and keep "
                     "the order of the strokes");
        return refuse(trace, 0, name, error);
    }
    if (top == 0 || !(cz_trace_work(trace, 0, top) > 0.0)) {
        cz_fail(error, CZ_STATUS_INPUT, "the curve takes no energy while its stroke grows");
        return refuse(trace, top, name, error);
    }
    const int last = trace->n - 1;
    trace->unloads =
        trace->x[top] - trace->x[last] > 0.0 && trace->f[last] < UNLOADED * trace->f[top];
    if (!trace->unloads || -cz_trace_work(trace, top, last) <= cz_trace_work(trace, 0, top))
        return CZ_OK;
    cz_fail(error, CZ_STATUS_INPUT, "the unloading gives back more energy than the loading took");
    return refuse(trace, top, name, error);
}

CzStatus cz_trace_check(CzTrace *trace, const char *name, CzError *error) {
    for (int i = 0; i < trace->n; i++)
        CZ_TRY(check_point(trace, i, name, error));
    CZ_TRY(check_forces(trace, name, error));

    /* Of points at the largest stroke the one with the largest force ends the loading. */
    int top = 0;
    for (int i = 1; i < trace->n; i++)
        if (trace->x[i] > trace->x[top] ||
            (trace->x[i] == trace->x[top] && trace->f[i] > trace->f[top]))
            top = i;
    trace->n_loading = top + 1;
    CZ_TRY(check_order(trace, name, error));
    return check_ends(trace, name, error);
}
