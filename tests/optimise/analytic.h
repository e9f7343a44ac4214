/* Problems with a known optimum, which replace the train in tests of the optimiser.
 *
 * Numbers as in W. Hock and K. Schittkowski, Test Examples for Nonlinear Programming Codes (1981).
 */
#ifndef CZ_TESTS_ANALYTIC_H
#define CZ_TESTS_ANALYTIC_H

#include "optimise/search.h"

enum { MAX_VARIABLES = 6, MAX_CONSTRAINTS = 4 };

/* One design: fills the constraints (at most 0 when kept) and returns the objective. */
typedef double (*AnalyticFormula)(const double *x, double *constraint);

typedef struct Analytic {
    const char *name;
    int n_variable, n_constraint;
    double min[MAX_VARIABLES], max[MAX_VARIABLES], start[MAX_VARIABLES], step[MAX_VARIABLES];
    AnalyticFormula formula;
    bool is_minimax;
    double optimum[MAX_VARIABLES], best; /* known */
} Analytic;

/* HS22: two constraints, both active at (1, 1). */
static inline double hs22(const double *x, double *c) {
    c[0] = x[0] + x[1] - 2;
    c[1] = x[0] * x[0] - x[1];
    return (x[0] - 2) * (x[0] - 2) + (x[1] - 1) * (x[1] - 1);
}

/* HS29, in the octant of one of its four optima. */
static inline double hs29(const double *x, double *c) {
    c[0] = (x[0] * x[0] + 2 * x[1] * x[1] + 4 * x[2] * x[2]) / 48 - 1;
    return -x[0] * x[1] * x[2];
}

/* HS43, Rosen and Suzuki. */
static inline double hs43(const double *x, double *c) {
    const double a = x[0], b = x[1], d = x[2], e = x[3];
    c[0] = (a * a + b * b + d * d + e * e + a - b + d - e - 8) / 8;
    c[1] = (a * a + 2 * b * b + d * d + 2 * e * e - a - e - 10) / 10;
    c[2] = (2 * a * a + b * b + d * d + 2 * a - b - e - 5) / 5;
    return a * a + b * b + 2 * d * d + e * e - 5 * a - 5 * b - 21 * d + 7 * e;
}

/* The largest of three planes over a triangle is least where they meet, at (1, 2) with -0.5. */
static inline double three_planes(const double *x, double *c) {
    const double u = x[0] - 1, v = x[1] - 2;
    c[0] = u + v - 0.5;
    c[1] = -u + 0.5 * v - 0.5;
    c[2] = -v - 0.5;
    return fmax(c[0], fmax(c[1], c[2]));
}

/* No x is above 6 and below 4, and the second constraint has the smaller weight: the least penalty
 * is at 6.
 */
static inline double torn(const double *x, double *c) {
    c[0] = 6 - x[0];
    c[1] = (x[0] - 4) / 10;
    return x[1];
}

/* HS22 where everything above the line x0 + x1 = 2.5 fails. */
static inline double failing(const double *x, double *c) {
    const double value = hs22(x, c);
    return x[0] + x[1] > 2.5 ? NAN : value;
}

/* The objective falls towards a border beyond which everything fails. */
static inline double tempting_failures(const double *x, double *c) {
    c[0] = c[1] = -1;
    return x[0] + x[1] > 1.6 ? NAN : -x[0] - x[1];
}

static inline double always_failing(const double *x, double *c) {
    (void)x;
    c[0] = NAN;
    return NAN;
}

static const Analytic analytic_hs22 = {"HS22", 2,    2,     {0, 0}, {3, 3}, {2.5, 2.5},
                                       {0},    hs22, false, {1, 1}, 1};
static const Analytic analytic_hs29 = {"HS29",
                                       3,
                                       1,
                                       {0.1, 0.1, 0.1},
                                       {8, 5, 4},
                                       {1, 1, 1},
                                       {0},
                                       hs29,
                                       false,
                                       {4, 2.8284271247461903, 2},
                                       -22.627416997969522};
static const Analytic analytic_hs43 = {
    "HS43", 4,    3,     {-3, -3, -3, -3}, {4, 4, 4, 4}, {0, 0, 0, 0},
    {0},    hs43, false, {0, 1, 2, -1},    -44};
static const Analytic analytic_planes = {
    "three planes", 2, 3, {-5, -5}, {7, 7}, {6, -4}, {0}, three_planes, true, {1, 2}, -0.5};
static const Analytic analytic_torn = {"torn", 2,    2,     {0, 0}, {10, 1}, {9, 0.5},
                                       {0},    torn, false, {6, 0}, 0};
static const Analytic analytic_failing = {"failing", 2,       2,     {0, 0}, {3, 3}, {0.5, 1.5},
                                          {0},       failing, false, {1, 1}, 1};
static const Analytic analytic_always_failing = {
    "always failing", 2, 1, {0, 0}, {3, 3}, {1, 1}, {0}, always_failing, false, {0}, 0};

static inline CzStatus analytic_evaluate(void *data, int n_point, const double *x,
                                         double *objective, double *constraint, double *detail,
                                         CzError *error) {
    const Analytic *analytic = data;
    (void)detail;
    (void)error;
    for (int i = 0; i < n_point; i++)
        objective[i] = analytic->formula(x + i * analytic->n_variable,
                                         constraint + i * analytic->n_constraint);
    return CZ_OK;
}

static inline CzFunction analytic_function(const Analytic *analytic) {
    return (CzFunction){.n_variable = analytic->n_variable,
                        .n_constraint = analytic->n_constraint,
                        .min = analytic->min,
                        .max = analytic->max,
                        .start = analytic->start,
                        .step = analytic->step,
                        .is_minimax = analytic->is_minimax,
                        .evaluate = analytic_evaluate,
                        .data = (void *)analytic};
}

#endif
