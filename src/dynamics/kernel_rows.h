/* Access to rows, and the small passes that all others use. Part of kernel.c only. */
#ifndef CZ_DYNAMICS_KERNEL_ROWS_H
#define CZ_DYNAMICS_KERNEL_ROWS_H

#include <stddef.h>

#include "dynamics/dynamics.h"
#include "laws/law.h"

/* Rows of the evaluation at hand; `d` is the CzDynamics in scope. */
#define P(name) ((const double *)cz_row(d->lanes->parameter, d->stride, CZ_P_##name))
#define X(name) ((const double *)cz_row(d->position, d->stride, CZ_DOF_##name))
#define V(name) ((const double *)cz_row(d->velocity, d->stride, CZ_DOF_##name))
#define G(name) cz_row(d->force, d->stride, CZ_DOF_##name)
#define M(name) ((const double *)cz_row(d->memory, d->stride, CZ_M_##name))
#define NEXT(name) cz_row(d->next_memory, d->stride, CZ_M_##name)
#define S(name) cz_row(d->scratch, d->stride, CZ_S_##name)
#define C(name) ((const double *)cz_row(d->constant, d->stride, CZ_C_##name))
#define POWER(name) cz_row(d->power, d->stride, CZ_L_##name)

/* The same for a row counted on from a named one: side B after side A, front after rear, axle after
 * axle. */
#define P_AT(name, index)                                                                          \
    ((const double *)cz_row(d->lanes->parameter, d->stride, CZ_P_##name + (index)))
#define X_AT(name, index) ((const double *)cz_row(d->position, d->stride, CZ_DOF_##name + (index)))
#define V_AT(name, index) ((const double *)cz_row(d->velocity, d->stride, CZ_DOF_##name + (index)))
#define G_AT(name, index) cz_row(d->force, d->stride, CZ_DOF_##name + (index))
#define M_AT(name, index) ((const double *)cz_row(d->memory, d->stride, CZ_M_##name + (index)))
#define NEXT_AT(name, index) cz_row(d->next_memory, d->stride, CZ_M_##name + (index))
#define S_AT(name, index) cz_row(d->scratch, d->stride, CZ_S_##name + (index))
#define C_AT(name, index) ((const double *)cz_row(d->constant, d->stride, CZ_C_##name + (index)))
#define POWER_AT(name, index) cz_row(d->power, d->stride, CZ_L_##name + (index))

/* A loop over lanes whose iterations are independent. */
#define CZ_LANES(i, n) _Pragma("omp simd") for (size_t i = 0; i < (n); ++i)

/* A body that carries a contact: its rows, moved on by one car for side B. */
typedef struct {
    const double *x, *z, *pitch;  /* displacement */
    const double *vx, *vz, *turn; /* rates */
    const double *cosine, *sine;  /* of the pitch */
} Carrier;

/* Cosine and sine by series: exact derivatives of each other to pitch^4, and no library call in the
 * loop. */
static inline void rotate(size_t n, const double *restrict pitch, double *restrict cosine,
                          double *restrict sine) {
    CZ_LANES (i, n) {
        const double square = pitch[i] * pitch[i];
        cosine[i] = 1.0 - square * (0.5 - square * (1.0 / 24.0));
        sine[i] = pitch[i] * (1.0 - square * (1.0 / 6.0));
    }
}

/* Value and slope of a curve. */
static void evaluate_curve(const CzDynamics *d, int id, const double *restrict x,
                           double *restrict value, double *restrict slope) {
    const CzCurveLanes *curve = &d->lanes->curve[id];
    const size_t n = CZ_LANE_BLOCK;
    CZ_LANES (i, n) {
        value[i] = curve->start[i];
        slope[i] = 0.0;
    }
    for (int kink = 0; kink < curve->n_kink; ++kink) {
        const double *restrict at = cz_row(curve->at, d->stride, kink);
        const double *restrict change = cz_row(curve->slope_change, d->stride, kink);
        CZ_LANES (i, n) {
            const double beyond = x[i] - at[i];
            const double counted = beyond >= 0.0 ? change[i] : 0.0;
            value[i] += counted * beyond;
            slope[i] += counted;
        }
    }
}

/* Largest shortening within the stages of a crush zone: beyond the last one it stands on its stop.
 */
static void largest_of_stages(const CzDynamics *d, int curve, const double *restrict largest,
                              double *restrict within) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict usable = d->lanes->curve[curve].usable;
    CZ_LANES (i, n) {
        within[i] = cz_smaller(largest[i], usable[i]);
    }
}

/* Adds factor * row to target, lane by lane. */
static inline void add(size_t n, double *restrict target, const double *restrict factor,
                       const double *restrict row) {
    CZ_LANES (i, n) {
        target[i] += factor[i] * row[i];
    }
}

#endif
