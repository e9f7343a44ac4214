/* A force-stroke curve from measured points: signs, zero, the part that counts, loading and
 * unloading.
 *
 * Compression is positive and a curve begins at stroke 0. A file in which both columns are negative
 * has the opposite sign, and one that begins without force at another stroke has another zero: both
 * are corrected and reported. Ambiguous files are refused.
 */
#ifndef CZ_PROBLEM_TRACE_H
#define CZ_PROBLEM_TRACE_H

#include "text/curve_file.h"

#define CZ_LARGEST_STROKE 10.0 /* that a curve may have, as a stage of the problem file [m] */
#define CZ_LARGEST_FORCE 1e8   /* [N] */

/* Definition of stroke 0. */
typedef enum {
    CZ_ZERO_BY_CURVE,   /* as in the file, or at the first point when that has no force */
    CZ_ZERO_AT_START,   /* at the first point */
    CZ_ZERO_AT_CONTACT, /* where the force begins */
    CZ_ZERO_AT_STROKE   /* at a stroke of the file */
} CzTraceZero;

/* Options for converting points to a curve. Begin with cz_trace_shape_default. */
typedef struct CzTraceShape {
    bool flips[2]; /* the sign of strokes, of forces */
    double scale;  /* of forces */
    CzTraceZero zero;
    double zero_at;  /* with CZ_ZERO_AT_STROKE; in the unit of the file, as the next two */
    double from, to; /* strokes that count; NaN: all */
    /* The option or key for it, for messages; NULL for a caller without options. */
    const char *flip_help, *zero_help;
} CzTraceShape;

CzTraceShape cz_trace_shape_default(void);

enum { CZ_TRACE_MAX_NOTES = 6 };

typedef struct CzTrace {
    int n;
    double *x, *f; /* stroke [m] and force [N] in the order of the test (n) */
    int *line;     /* line of each in the file, counted from 1 (n) */
    int n_loading; /* points up to the largest stroke, that one included */
    bool unloads;  /* the points after them are an unloading */
    int n_note;    /* corrections, as sentences without a full stop */
    char note[CZ_TRACE_MAX_NOTES][200];
} CzTrace;

/* Converts the trace's points to a curve in place; `unit` is the SI value of the file's unit of
 * strokes. False with a mistake at a line of the source. */
bool cz_trace_make(CzMistakes *mistakes, const CzSource *source, const CzTraceShape *shape,
                   double unit, CzTrace *trace);

/* Moves strokes that fall, by noise, as little as possible in the sense of least squares until they
 * do not; `raised` may be `x`. False without memory. */
bool cz_trace_raise(CzArena *arena, const double *x, int n, double *raised);

/* Work of forces f over strokes x from one point to another, in the order of the points [J]. */
double cz_work(const double *x, const double *f, int from, int to);

#endif
