/* Linear response surfaces: the objective and every detail as planes around a base design.
 *
 *   c_k(u) = c_k(base) + slope_k . (u - base)        u scaled to 0..1
 *
 * Slopes begin as secants of n designs side by side and are corrected by every further design
 * (Broyden's rank-one update). The search moves on the planes inside a box that grows and shrinks
 * with their success: local derivatives of a chaotic response do not predict larger steps.
 */
#ifndef CZ_OPTIMISE_SURFACE_H
#define CZ_OPTIMISE_SURFACE_H

#include <math.h>

#include "base/arena.h"
#include "optimise/search.h"

typedef struct CzSurface {
    CzArena arena;
    CzSearch *search;
    int n, m;       /* variables, details */
    long record;    /* of the base, -1 while there is none */
    double *u;      /* base, scaled (n) */
    double f, *c;   /* objective and details of the base (m) */
    bool *is_known; /* of a detail: not for one of a scenario that was left out, which is taken from
                       the planes before (m) */
    double *df, *dc;       /* slopes (n), (m x n) */
    double *usual_reserve; /* distance of details below 0 in a descent (m) */
    bool is_fresh;         /* no design has corrected the slopes since the secants */
    double penalty;        /* of the base in a descent: sum of its violations */
    int n_outside;         /* steps in a row that left it violated as before */
    int n_held;            /* details that are held; they no longer count in the largest one */
    bool *is_held;         /* (m) */
    bool *is_frozen;       /* variables that would lower held margins; they stay as they are (n) */
    double *frozen_at;     /* scaled (n) */
    double scale;          /* of the objective */
    double weight;         /* price of violations in its units */
    double *x, *many_f, *many_c, *many_d; /* scratch for `most` designs */
    int most;
} CzSurface;

/* Memory for surfaces of a search and for batches of `most` designs; false when there is none. */
bool cz_surface_create(CzSurface *surface, CzSearch *search, int most);
void cz_surface_free(CzSurface *surface);

/* Sets scaled design u as base: it is evaluated, with n further ones for the slopes. False when the
 * search ended. */
bool cz_surface_begin(CzSurface *surface, const char *phase, const double *u, double secant);

/* Evaluates n_point scaled designs (at most `most`), corrects the slopes by each, and moves the
 * base to the best of them when it is better. False when the search ended. *moved_to is the index
 * of the new base among them, or -1. */
bool cz_surface_try(CzSurface *surface, const char *phase, int n_point, const double *u,
                    int *moved_to);

/* The same with the designs of surface->x, in the variables' units, so that values on a catalogue
 * increment stay on it to the last bit. */
bool cz_surface_try_exact(CzSurface *surface, const char *phase, int n_point, int *moved_to);

/* Whether a detail counts in the largest one. */
static inline bool cz_surface_counts(const CzSurface *surface, int detail) {
    return !surface->is_held[detail] &&
           cz_detail_kind(surface->search->function, detail) != CZ_DETAIL_ACTIVATION;
}

/* The largest detail so far, with detail k of this value where it counts. */
static inline double cz_surface_counted(double largest, const CzSurface *surface, int k, double c) {
    return cz_surface_counts(surface, k) ? fmax(largest, c) : largest;
}

/* Sum of the compressed violations of a record, as planes and responses have them; infinite where
 * its run failed. */
double cz_surface_penalty(const CzSurface *surface, long record);

/* Largest difference of a variable between two scaled designs. */
static inline double cz_largest_difference(const double *a, const double *b, int n) {
    double largest = 0;
    for (int i = 0; i < n; i++)
        largest = fmax(largest, fabs(a[i] - b[i]));
    return largest;
}

/* Planes at scaled u: returns the objective and adds up the violations as the search ranks them. */
double cz_surface_predict(const CzSurface *surface, const double *u, double *penalty);

/* Evaluates the first design of surface->x; its details are then the first of surface->many_d. The
 * planes stay as they are. */
bool cz_surface_probe(CzSurface *surface, const char *phase);

/* What a descent lowers, on the planes: the objective and the price of violations, where detail k
 * is to be below 0 by reserve[k] (m); NULL: by 0. */
double cz_surface_merit_at(const CzSurface *surface, const double *u, const double *reserve);

/* Best scaled design on the planes in the scaled box lo..hi, by a linear program. Detail k is
 * to be below 0 by reserve[k] (m). False when it cannot be found. */
bool cz_surface_best_in(const CzSurface *surface, const double *lo, const double *hi,
                        const double *reserve, double *u);

/* The same within `radius` of the base and within the bounds. */
bool cz_surface_best(const CzSurface *surface, double radius, double *u);

/* Moves from design x, in the variables' units, by boxes that grow and shrink, with at most
 * `evaluations` evaluations, until there is no improvement; then, as long as that helps, again with
 * new secants: without `with_refresh` only where no smallest margin is maximised and a constraint
 * is violated. The surface stays at the last base. */
void cz_surface_descend(CzSurface *surface, const char *phase, const double *x, long evaluations,
                        bool with_refresh);

#endif
