/* Loops over lanes, and the small passes that all others use. Part of kernel.c only. */
#ifndef CZ_DYNAMICS_KERNEL_LANES_H
#define CZ_DYNAMICS_KERNEL_LANES_H

#include <string.h>

#include "dynamics/dynamics.h"
#include "laws/law.h"

/* A loop over the lanes of a block, whose iterations are independent. */
#define CZ_LANES(i) _Pragma("omp simd") for (size_t i = 0; i < CZ_LANE_BLOCK; ++i)

/* The same, with the largest value of all lanes in `most`: 1 where one lane has a property and the
 * others 0. */
#define CZ_PRAGMA(text) _Pragma(#text)
#define CZ_LANES_MAX(i, most)                                                                      \
    CZ_PRAGMA(omp simd reduction(max : most))                                                      \
    for (size_t i = 0; i < CZ_LANE_BLOCK; ++i)

/* A row of zeros, where there is nothing to add. */
static const _Alignas(64) CzRow zeros = {0.0};

/* A curve at the strokes of all lanes. */
typedef struct {
    _Alignas(64) CzRow value;
    CzRow slope;
} CurveAt;

/* Sets n rows that follow each other to zero. */
static inline void clear_rows(void *rows, size_t size) {
    const size_t n = size / sizeof(double);
    double *restrict value = rows;
    _Pragma("omp simd") for (size_t i = 0; i < n; ++i) value[i] = 0.0;
}

/* Value and slope of a curve. Sums in rows of a function's own stay in registers. */
static void evaluate_curve(const CzBlockCurve *curve, const double *restrict x,
                           CurveAt *restrict at) {
    CurveAt sum;
    CZ_LANES (i) {
        sum.value[i] = curve->start[i];
        sum.slope[i] = 0.0;
    }
    for (int k = 0; k < curve->n_breakpoint; ++k) {
        const double *restrict place = curve->breakpoint[k].at;
        const double *restrict slope_change = curve->breakpoint[k].change;
        CZ_LANES (i) {
            const double beyond = x[i] - place[i], change = slope_change[i];
            const double counted = beyond >= 0.0 ? change : 0.0;
            sum.value[i] += counted * beyond;
            sum.slope[i] += counted;
        }
    }
    CZ_LANES (i) {
        at->value[i] = sum.value[i];
        at->slope[i] = sum.slope[i];
    }
}

/* The same in one lane. */
static void curve_at(const CzBlockCurve *curve, size_t lane, double x, double *value,
                     double *slope) {
    *value = curve->start[lane];
    *slope = 0.0;
    for (int k = 0; k < curve->n_breakpoint; ++k) {
        const double beyond = x - curve->breakpoint[k].at[lane];
        const double counted = beyond >= 0.0 ? curve->breakpoint[k].change[lane] : 0.0;
        *value += counted * beyond;
        *slope += counted;
    }
}

/* Adds to `count` in the lanes that pass the beginning or the end of a falling part of a curve. */
static void count_turns(const CzBlockCurve *curve, const double *restrict from,
                        const double *restrict to, double *restrict count) {
    _Alignas(64) CzRow slope = {0.0};
    for (int k = 0; curve->falls && k < curve->n_breakpoint; ++k) {
        const double *restrict at = curve->breakpoint[k].at;
        const double *restrict change = curve->breakpoint[k].change;
        CZ_LANES (i) {
            const double after = slope[i] + change[i];
            const double turns = cz_smaller(slope[i], after) < CZ_FALLING ? 1.0 : 0.0;
            const double reached = at[i] < to[i] ? turns : 0.0;
            count[i] += at[i] >= from[i] ? reached : 0.0;
            slope[i] = after;
        }
    }
}

/* Largest shortening within the stages of a crush zone: beyond the last one it is on its stop.
 */
static void largest_of_stages(const CzBlockCurve *curve, const double *restrict largest,
                              double *restrict within) {
    CZ_LANES (i) {
        within[i] = cz_smaller(largest[i], curve->usable[i]);
    }
}

/* Adds factor * row to target, lane by lane. */
static inline void add(double *restrict target, const double *restrict factor,
                       const double *restrict row) {
    CZ_LANES (i) {
        target[i] += factor[i] * row[i];
    }
}

#endif
