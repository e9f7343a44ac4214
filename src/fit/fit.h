/* What the files of this folder share: one fit on its way from a trace to the values of a law. */
#ifndef CZ_FIT_FIT_H
#define CZ_FIT_FIT_H

#include "crushzone/fit.h"
#include "fit/staged.h"
#include "problem/trace.h"

enum {
    CZ_FIT_MOST_VALUES = 4 * CZ_MAX_STAGES + 16,
    CZ_FIT_MOST_NOTES = 8,
    CZ_FIT_DIGITS = 5 /* significant ones of what is written, but for the force that settles the
                         energy */
};

typedef struct CzFitValue {
    char path[64];
    double value; /* in the unit of the path */
} CzFitValue;

struct CzFit {
    CzArena arena;
    CzFitSummary summary;
    CzTrace trace;
    CzBranch curve; /* the loading over the whole shortening; one point before it when the first
                       lies beyond 0 */
    double *path_x, *path_f; /* the same before noise in its strokes was taken out */

    /* The law. Members that a kind lacks are absent: no stages, NaN. */
    CzStaged buffer;         /* lines */
    CzStaged member;         /* plateaus of tube or anti-climber, lines of an end */
    double stiffness;        /* elastic, in series with the members [N/m]; INFINITY: the strokes are
                                plastic */
    double shear_force;      /* [N] */
    double softening;        /* [m] */
    double retraction;       /* [m] */
    double unloading;        /* of an end [N/m] */
    double share;            /* [-]; of an end, and of a buffer that gives back */
    double second_unloading; /* [N/m] */

    CzFitValue value[CZ_FIT_MOST_VALUES];
    int n_value;
    char note[CZ_FIT_MOST_NOTES][200];
    int n_note;
};

/* From a file, or from points, to a trace (read.c). */
CZ_MUST_CHECK CzStatus cz_fit_read_trace(CzFit *fit, const char *path, const CzFitOptions *options,
                                         CzError *error);
CZ_MUST_CHECK CzStatus cz_fit_take_points(CzFit *fit, int n_point, const double *stroke,
                                          const double *force, const CzFitOptions *options,
                                          CzError *error);

/* The kinds: from trace to law. */
CZ_MUST_CHECK CzStatus cz_fit_plastic(CzFit *fit, int n_stage, CzError *error);
CZ_MUST_CHECK CzStatus cz_fit_end(CzFit *fit, int n_stage, CzError *error);
CZ_MUST_CHECK CzStatus cz_fit_coupler(CzFit *fit, int n_stage, CzError *error);

/* ---- what they share ---- */

/* The loading with the elastic shortening of a stiffness taken off. */
CZ_MUST_CHECK CzStatus cz_fit_branch(CzFit *fit, double stiffness, CzBranch *branch,
                                     CzError *error);

/* Rounds to CZ_FIT_DIGITS significant digits in a unit of this SI value. */
double cz_fit_round(double value, double unit);

/* Work on the device up to a point of the loading [J]. */
double cz_fit_work(const CzFit *fit, int point);

/* Rounds strokes, forces, trigger and its length. */
void cz_fit_round_staged(CzStaged *staged);

/* Raises forces that are below the one before: a buffer's force does not fall. */
void cz_fit_let_rise(CzStaged *staged);

/* Rounds a member of the law over its part of the branch, strokes first, and settles the force of
 * its longest stage, or all forces of a buffer, so that the law takes exactly summary.energy. Fails
 * when that force would be no longer like the curve. */
CZ_MUST_CHECK CzStatus cz_fit_settle(CzFit *fit, CzStaged *staged, const CzBranch *branch,
                                     CzError *error);

void cz_fit_note_down(CzFit *fit, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Key of the problem file: its default and its range [SI]. */
const CzKey *cz_fit_key(CzRecordId record, const char *stem);

/* ---- the law under a growing shortening (loading.c) ---- */

enum { CZ_MOST_CORNERS = 2 * CZ_MOST_BENDS + 8 };

/* Force over shortening as straight lines; x never falls. */
typedef struct CzLoading {
    int n;
    double x[CZ_MOST_CORNERS], f[CZ_MOST_CORNERS];
} CzLoading;

void cz_fit_load(const CzFit *fit, CzLoading *loading);
double cz_fit_law_energy(const CzFit *fit);

/* Fills the differences of the summary. */
void cz_fit_compare(CzFit *fit);

#endif
