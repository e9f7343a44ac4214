/* Parts of a corridor, and its steps. */
#ifndef CZ_OPTIMISE_CORRIDOR_H
#define CZ_OPTIMISE_CORRIDOR_H

#include "crushzone/corridor.h"
#include "evaluate/cases.h"
#include "evaluate/study.h"

/* Memory that a corridor owns besides its arrays, and what its steps share. */
typedef struct CzCorridorParts {
    CzArena arena; /* of draws and texts */
    CzCorridorOptions options;
    CzExecutor executor;
    CzStudy study;          /* for the workers of the executor, if any */
    CzEvaluator *evaluator; /* of the design as written */
    CzPlacedDevice device;
    int n_stage_of_piece[CZ_MAX_PIECES]; /* stage that a piece is of */
    CzStage piece[CZ_MAX_PIECES];        /* nominal */
    CzProblem *divided;                  /* the problem with the pieces as stages */
    CzCases with_scatter, bare;          /* draws of scatter, if any, then of the pieces */
    double *u; /* quasi-random curves, within 0..1 (n_random x n_factor) */
} CzCorridorParts;

/* Number of factors of a curve. */
static inline int cz_corridor_n_factor(const CzCorridor *corridor) {
    return corridor->n_piece + (corridor->peak_word != NULL);
}

static inline bool cz_corridor_is_stopped(const CzCorridor *corridor) {
    const volatile sig_atomic_t *stop = corridor->parts->options.stop;
    return stop != NULL && *stop != 0;
}

/* ---- before the first run (corridor_begin.c, corridor_device.c) ---- */

/* Finds the device, divides its stages, and reads the problem with the pieces as stages. */
CZ_MUST_CHECK CzStatus cz_corridor_divide(CzCorridor *corridor, CzError *error);
/* The draws of the pieces, whose values a curve has: per piece stroke, force and the force at its
 * end where it has one, then the peak. */
int cz_corridor_n_draw(const CzCorridor *corridor);
CZ_MUST_CHECK bool cz_corridor_list_draws(CzCorridor *corridor, CzDraw *draw);
void cz_corridor_set_values(const CzCorridor *corridor, const double *factor, double *value);
/* Fills the points of the lower, the nominal and the upper curve, and their energies. */
void cz_corridor_fill_points(CzCorridor *corridor);

/* All of these for a corridor with a problem and options. */
CZ_MUST_CHECK CzStatus cz_corridor_prepare(CzCorridor *corridor, CzError *error);

/* Lists scenarios, scatter and quasi-random curves. */
CZ_MUST_CHECK CzStatus cz_corridor_begin(CzCorridor *corridor, CzError *error);

/* ---- curves (corridor_curves.c) ---- */

/* Runs and judges n curves, all in samples or none and in full or none, in several threads; those
 * that an interruption left out are CZ_SAMPLE_NOT_RUN. Statuses: CZ_OK, CZ_STATUS_INTERRUPTED,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_corridor_run(CzCorridor *corridor, int n, CzTriedCurve *curve,
                                       CzError *error);
/* The same with at most CZ_CURVES_AT_ONCE curves in this thread. */
enum { CZ_CURVES_AT_ONCE = 4 };
CZ_MUST_CHECK CzStatus cz_corridor_run_in_thread(CzCorridor *corridor, int n, CzTriedCurve *curve,
                                                 CzError *error);

static inline bool cz_curve_passes(const CzTriedCurve *curve) {
    return curve->state == CZ_SAMPLE_DONE && cz_verdict_passes(curve->verdict);
}

/* ---- search (corridor_search.c, corridor_adversary.c) ---- */

/* Widths of the edges in steps of the resolution. */
typedef struct CzCorridorBox {
    int steps[2];
} CzCorridorBox;

/* Share of the nominal forces at an edge. */
static inline double cz_box_factor(const CzCorridor *corridor, const CzCorridorBox *box, int edge) {
    const double width = box->steps[edge] * corridor->resolution;
    return edge == 0 ? 1 - width : 1 + width;
}

/* Appends curves to those that were tried; those that were not run are left out. */
CZ_MUST_CHECK CzStatus cz_corridor_keep(CzCorridor *corridor, int n, const CzTriedCurve *curve,
                                        CzError *error);

/* Searches a failing curve from n curves on, side by side, and keeps what was tried. */
CZ_MUST_CHECK CzStatus cz_corridor_challenge(CzCorridor *corridor, const CzCorridorBox *box, int n,
                                             const CzTriedCurve *start, CzError *error);

/* ---- in workers (corridor_study.c) ---- */

/* Kinds of tasks, the first number of a request. */
typedef enum CzCorridorTask { CZ_CORRIDOR_CURVES, CZ_CORRIDOR_ADVERSARY } CzCorridorTask;

CzStudy cz_corridor_study(const CzCorridor *corridor);

/* Run a task behind its kind in a request, and append its results. */
CZ_MUST_CHECK CzStatus cz_corridor_answer_curves(CzCorridor *corridor, CzReading *request,
                                                 CzMemoryText *answer, CzError *error);
CZ_MUST_CHECK CzStatus cz_corridor_answer_adversary(CzCorridor *corridor, CzReading *request,
                                                    CzMemoryText *answer, CzError *error);

/* Finds the edges. Statuses: as of cz_corridor_run. */
CZ_MUST_CHECK CzStatus cz_corridor_search(CzCorridor *corridor, CzError *error);

#endif
