/* Measured curves of known laws: made from the model's own breakpoints, with noise.
 */
#ifndef CZ_TESTS_FIT_CURVES_H
#define CZ_TESTS_FIT_CURVES_H

#include "support/check.h"

#include "crushzone/fit.h"
#include "model/breakpoints.h"
#include "problem/strokes.h"

enum { MAX_POINTS = 4000 };

typedef struct Curve {
    int n;
    double x[MAX_POINTS], f[MAX_POINTS];
} Curve;

static inline void add_point(Curve *curve, double x, double f) {
    assert_true(curve->n < MAX_POINTS);
    curve->x[curve->n] = x;
    curve->f[curve->n++] = f;
}

/* Repeatable numbers from -1 to 1. */
static inline double noise(unsigned *seed) {
    *seed = *seed * 1664525U + 1013904223U;
    return (double)(*seed >> 8) / 8388607.5 - 1.0;
}

/* The strength of a tube over its plastic stroke, behind the elastic shortening. */
static inline void load_plastic(Curve *curve, const CzStage *stage, int n_stage, double trigger,
                                double length, double stiffness) {
    static const CzTable none;
    CzBreakpoints breakpoints;
    cz_breakpoints_strength(&breakpoints, stage, n_stage, &none, trigger, length, 1e9);
    const double stroke = cz_total_stroke(stage, n_stage, &none);
    enum { RISE = 20, FLOW = 2000 };
    for (int i = 0; i < RISE; i++) {
        const double force = cz_breakpoints_value(&breakpoints, 0.0) * i / RISE;
        add_point(curve, force / stiffness, force);
    }
    for (int i = 0; i <= FLOW; i++) {
        const double s = stroke * i / FLOW, force = cz_breakpoints_value(&breakpoints, s);
        add_point(curve, s + force / stiffness, force);
    }
}

static inline void load_lines(Curve *curve, double first, const CzStage *stage, int n_stage,
                              int n_point) {
    static const CzTable none;
    CzBreakpoints breakpoints;
    cz_breakpoints_loading(&breakpoints, first, stage, n_stage, &none, 1e9);
    const double stroke = cz_total_stroke(stage, n_stage, &none);
    for (int i = 0; i <= n_point; i++)
        add_point(curve, stroke * i / n_point,
                  cz_breakpoints_value(&breakpoints, stroke * i / n_point));
}

static inline void make_noisy(Curve *curve, double of_force, double of_stroke) {
    unsigned seed = 7;
    for (int i = 0; i < curve->n; i++) {
        curve->f[i] *= 1.0 + of_force * noise(&seed);
        curve->x[i] = fmax(curve->x[i] + of_stroke * noise(&seed), 0.0);
    }
}

/* Work in the order of the points, up to the one with the largest stroke. */
static inline double work_of_loading(const Curve *curve) {
    double work = 0.0;
    int top = 0;
    for (int i = 0; i < curve->n; i++)
        top = curve->x[i] > curve->x[top] ? i : top;
    for (int i = 1; i <= top; i++)
        work += 0.5 * (curve->f[i] + curve->f[i - 1]) * (curve->x[i] - curve->x[i - 1]);
    return work;
}

static inline CzFit *fit_of(const Curve *curve, CzFitKind kind, int n_stage) {
    CzFitOptions options = cz_fit_options_default();
    CzFit *fit = NULL;
    CzError error = {0};
    options.kind = kind;
    options.n_stage = n_stage;
    const CzStatus status = cz_fit_points(curve->n, curve->x, curve->f, &options, &fit, &error);
    if (status != CZ_OK)
        print_error("point %d: %s\n", error.line, error.message);
    assert_int_equal(status, CZ_OK);
    return fit;
}

/* A value of the law; NaN when it has none of this path. */
static inline double value_of(const CzFit *fit, const char *path) {
    const CzFitSummary *summary = cz_fit_summary(fit);
    for (int i = 0; i < summary->n_value; i++)
        if (strcmp(summary->value[i].path, path) == 0)
            return summary->value[i].value;
    return NAN;
}

#endif
