/* Smooth response surfaces: the objective and every detail interpolated between all designs near a
 * base.
 *
 *   v_k(u) = sum over points p of w_kp |u - u_p|^3 + a_k + b_k . (u - base)      u scaled to 0..1
 *
 * A cubic radial basis with a plane bends least of all functions through the points and, with n + 1
 * points, is the plane through them. Details are interpolated on the scale of penalties, which are
 * logarithmic far above a limit.
 */
#ifndef CZ_OPTIMISE_RESPONSE_H
#define CZ_OPTIMISE_RESPONSE_H

#include "optimise/surface.h"

typedef struct CzResponse {
    CzArena arena;
    const CzSurface *surface;
    int n, most;      /* variables, largest number of points */
    int n_point;      /* designs that are interpolated */
    double *point;    /* scaled (n_point x n) */
    double *base;     /* scaled (n) */
    int n_value;      /* the objective and the details that may count */
    int *detail;      /* detail of each value, -1 for the objective (n_value) */
    double *weight;   /* of points, constant and slopes in each value (n_point + 1 + n) x n_value */
    double *matrix;   /* scratch */
    double *nearness; /* scratch: terms at a design, and their slopes (n + 1) x (n_point + 1 + n) */
    double *value;    /* scratch (n_value) */
    long *record;     /* of the points */
    double *distance; /* of the points from the base */
} CzResponse;

/* Memory for a response of a search; false when there is none. */
bool cz_response_create(CzResponse *response, const CzSurface *surface);
void cz_response_free(CzResponse *response);

/* Interpolates between the designs of the history within `reach` of a scaled base, or the n + 1
 * nearest ones where these are more. False when they do not suffice. */
bool cz_response_fit(CzResponse *response, const double *base, double reach);

/* Sets the planes of a surface to the values, and unless `values_only` to the slopes, of the
 * response at scaled u. */
void cz_response_linearise(const CzResponse *response, const double *u, bool values_only,
                           CzSurface *surface);

/* Moves from design x, in the variables' units, by boxes that grow and shrink, with at most
 * `evaluations` evaluations, until there is no improvement. The surface stays at the last base. */
void cz_response_descend(CzSurface *surface, const char *phase, const double *x, long evaluations);

#endif
