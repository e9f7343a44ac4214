/* A curve as it was read: points in the order of the test, cut into loading and unloading. */
#ifndef CZ_FIT_TRACE_H
#define CZ_FIT_TRACE_H

#include "crushzone/fit.h"
#include "fit/branch.h"

typedef struct CzTrace {
    int n;
    double *x, *f;    /* stroke [m] and force [N] in order (n) */
    int *line;        /* where each stands; counted from 1 (n) */
    int n_loading;    /* points up to the largest stroke, that one included */
    bool is_of_force; /* force over stroke, as a law is fitted to */
    bool unloads;     /* the points from there on are an unloading */
} CzTrace;

/* Reads a file. */
CZ_MUST_CHECK CzStatus cz_trace_read(CzArena *arena, const char *path, const CzFitOptions *options,
                                     CzTrace *trace, CzError *error);

/* Reads two columns of any quantities; x may go to and fro. */
CZ_MUST_CHECK CzStatus cz_trace_read_columns(CzArena *arena, const char *path,
                                             const CzCurveColumns *columns, CzTrace *trace,
                                             CzError *error);

/* Checks the points and finds the largest stroke. `name` stands in the error. */
CZ_MUST_CHECK CzStatus cz_trace_check(CzTrace *trace, const char *name, CzError *error);

/* Work on the device from one point to another, in the order of the points [J]. */
double cz_trace_work(const CzTrace *trace, int from, int to);

#endif
