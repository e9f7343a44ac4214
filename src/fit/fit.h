/* One fit from a trace to the values of a law: common data of the files of this folder. */
#ifndef CZ_FIT_FIT_H
#define CZ_FIT_FIT_H

#include "crushzone/fit.h"
#include "fit/staged.h"
#include "problem/keys.h"
#include "problem/trace.h"

enum {
    CZ_FIT_MAX_VALUES = 4 * CZ_MAX_STAGES + 16,
    CZ_MAX_CORNERS = 2 * CZ_MAX_STAGED_BREAKPOINTS + 12
};

/* Force over shortening as straight lines; x never falls. */
typedef struct CzLoading {
    int n;
    double x[CZ_MAX_CORNERS], f[CZ_MAX_CORNERS];
} CzLoading;

struct CzFit {
    CzArena arena;
    CzFitSummary summary;
    CzTrace trace;
    CzBranch curve; /* the loading over the whole shortening; with one more point when the first is
                       beyond 0 */
    double *path_x, *path_f; /* the same with the noise in its strokes */

    /* The law. Members that a kind does not have are absent: no stages, NaN. */
    CzStaged buffer;         /* lines */
    CzStaged member;         /* plateaus of tube or anti-climber, lines of an end */
    double stiffness;        /* elastic, in series with the members [N/m]; INFINITY: the strokes are
                                plastic */
    double shear_force;      /* [N] */
    double softening;        /* [m] */
    double retraction;       /* [m] */
    double residual;         /* force after the shear-off [N]; 0: none */
    double stop_force;       /* force at the end of the last stop [N]; NaN: no stop */
    double unloading;        /* of an end [N/m] */
    double share;            /* [-]; of an end, and of a buffer that returns energy */
    double second_unloading; /* [N/m] */

    CzLoading whole; /* over the stroke of the curve */

    CzFitValue value[CZ_FIT_MAX_VALUES]; /* (summary.n_value) */
    const CzFitValue *beyond; /* the first one outside the range of its key; NULL if none */
};

/* Reads a trace from a file or from points (read.c). */
CZ_MUST_CHECK CzStatus cz_fit_read_trace(CzFit *fit, const char *path, const CzFitOptions *options,
                                         CzError *error);
CZ_MUST_CHECK CzStatus cz_fit_take_points(CzFit *fit, int n_point, const double *stroke,
                                          const double *force, const CzFitOptions *options,
                                          CzError *error);

/* The kinds: from trace to law. */
CZ_MUST_CHECK CzStatus cz_fit_plastic(CzFit *fit, int n_stage, CzError *error);
CZ_MUST_CHECK CzStatus cz_fit_end(CzFit *fit, int n_stage, CzError *error);
CZ_MUST_CHECK CzStatus cz_fit_coupler(CzFit *fit, int n_stage, CzError *error);

#define CZ_FIT_ROUNDING 1e-13 /* relative error of a sum */

/* ---- for all kinds (match_energy.c) ---- */

/* Fails because no law of the kind fits the curve. */
CzStatus cz_fit_no_law(const CzFit *fit, CzError *error, const char *why);

/* The loading over the stroke without the elastic shortening of a stiffness. */
CZ_MUST_CHECK CzStatus cz_fit_branch(CzFit *fit, double stiffness, CzBranch *branch,
                                     CzError *error);

/* Rounds to five significant digits in a unit of this SI value. */
double cz_fit_round(double value, double unit);

/* Compliance of the elasticity in series with the members; 0 for plastic strokes [m/N]. */
static inline double cz_fit_compliance(const CzFit *fit) {
    return isfinite(fit->stiffness) ? 1.0 / fit->stiffness : 0.0;
}

/* Rounds strokes, forces, trigger and its length. */
void cz_fit_round_staged(CzStaged *staged);

/* Multiplies the force of a stage, or where `stage` is -1 all forces and the preload. */
void cz_fit_scale_forces(CzStaged *staged, int stage, double factor);

/* Raises forces that are below the previous one, because a buffer's force does not fall. */
void cz_fit_make_rising(CzStaged *staged);

/* Rounds a member of the law over its part of the branch, strokes first, and sets the force of its
 * longest stage, or all forces of a buffer, so that the law absorbs exactly summary.energy. Fails
 * when that force would differ too much from the curve. */
CZ_MUST_CHECK CzStatus cz_fit_match_energy(CzFit *fit, CzStaged *staged, const CzBranch *branch,
                                           CzError *error);

/* Adds a sentence to the summary: a remark for the user, or a reason why the law is doubtful. */
void cz_fit_add_note(CzFit *fit, const char *format, ...) __attribute__((format(printf, 2, 3)));
void cz_fit_doubt_that(CzFit *fit, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Key of the problem file: its default and its range [SI]. */
const CzKey *cz_fit_key(CzRecordId record, const char *stem);

/* ---- stop at the end of a curve (stop.c) ---- */

/* Densification: a final, steep rise of the force above all earlier forces. */
typedef struct CzStop {
    bool is_there;
    int onset;        /* last point of the loading before the rise; without a rise the last point */
    double stiffness; /* of the rise as a whole, elasticity included [N/m] */
} CzStop;

CzStop cz_fit_find_stop(const CzFit *fit);

/* The stiffness in series with the members, raised where the stop would be stiffer. */
double cz_fit_stiffness_for(CzFit *fit, const CzStop *stop, double stiffness);

/* Ends a member where its stop begins, so that the rise along the stop has the area and the last
 * force of the curve. The member's stages are those of its part of the curve before the onset,
 * whose length becomes that of the member. */
CZ_MUST_CHECK CzStatus cz_fit_place_stop(CzFit *fit, const CzStop *stop, CzStaged *staged,
                                         CzBranch *part, CzError *error);

/* ---- the law under a growing shortening (loading.c) ---- */

void cz_fit_load(const CzFit *fit, CzLoading *loading);
double cz_fit_law_energy(const CzFit *fit);

/* The same over the whole stroke of the curve: beyond its own stroke the law rises along its stop,
 * or has the residual force of a shear-off. */
void cz_fit_load_full_stroke(const CzFit *fit, CzLoading *loading);

/* Fills the differences of the summary. */
void cz_fit_compare(CzFit *fit);

/* Judges them (quality.c). */
void cz_fit_judge(CzFit *fit);

#endif
