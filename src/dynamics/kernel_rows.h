/* Access to rows, and the small passes that all others use. Part of kernel.c only. */
#ifndef CZ_DYNAMICS_KERNEL_ROWS_H
#define CZ_DYNAMICS_KERNEL_ROWS_H

#include <stddef.h>

#include "base/complex.h"
#include "dynamics/dynamics.h"
#include "laws/law.h"

/* Rows of the evaluation at hand; `d` is the CzBlock in scope. */
#define P(name) ((const double *)d->parameter[CZ_P_##name])
#define X(name) ((const double *)d->position[CZ_DOF_##name])
#define V(name) ((const double *)d->velocity[CZ_DOF_##name])
#define G(name) d->force[CZ_DOF_##name]
#define M(name) ((const double *)d->memory[CZ_M_##name])
#define NEXT(name) d->next_memory[CZ_M_##name]
#define S(name) d->scratch[CZ_S_##name]
#define C(name) ((const double *)d->constant[CZ_C_##name])
#define POWER(name) d->power[CZ_L_##name]

/* The same for a row counted on from a named one: side B after side A, front after rear, axle after
 * axle. */
#define P_AT(name, index) ((const double *)d->parameter[CZ_P_##name + (index)])
#define X_AT(name, index) ((const double *)d->position[CZ_DOF_##name + (index)])
#define V_AT(name, index) ((const double *)d->velocity[CZ_DOF_##name + (index)])
#define G_AT(name, index) d->force[CZ_DOF_##name + (index)]
#define M_AT(name, index) ((const double *)d->memory[CZ_M_##name + (index)])
#define NEXT_AT(name, index) d->next_memory[CZ_M_##name + (index)]
#define S_AT(name, index) d->scratch[CZ_S_##name + (index)]
#define C_AT(name, index) ((const double *)d->constant[CZ_C_##name + (index)])
#define POWER_AT(name, index) d->power[CZ_L_##name + (index)]

/* A loop over lanes whose iterations are independent. */
#define CZ_LANES(i, n) _Pragma("omp simd") for (size_t i = 0; i < (n); ++i)

/* A body that carries a contact: its rows. */
typedef struct {
    const double *x, *z, *pitch;  /* displacement */
    const double *vx, *vz, *turn; /* rates */
    const double *cosine, *sine;  /* of the pitch */
} Carrier;

static inline Carrier eight_rows(const CzRow *row) {
    return (Carrier){row[0], row[1], row[2], row[3], row[4], row[5], row[6], row[7]};
}

static inline Carrier own_rows(const CzBlock *d, int dof, int rotation) {
    const CzRow *x = &d->position[dof], *v = &d->velocity[dof], *turned = &d->scratch[rotation];
    return (Carrier){x[0], x[1], x[2], v[0], v[1], v[2], turned[0], turned[1]};
}

/* Side A of an interface is this car's body or front end, side B that of the car ahead: its body or
 * rear end. */
static inline Carrier body_carrier(const CzBlock *d, int side) {
    return side == 0 ? own_rows(d, CZ_DOF_BODY_X, CZ_S_BODY_COS)
                     : eight_rows(&d->scratch[CZ_S_BODY_AHEAD_X]);
}

static inline Carrier end_carrier(const CzBlock *d, int side) {
    return side == 0 ? own_rows(d, CZ_DOF_END_X_FRONT, CZ_S_END_COS_FRONT)
                     : eight_rows(&d->scratch[CZ_S_END_AHEAD_X]);
}

/* Cosine and sine of an angle: exact at any, so that strokes and rates stay each other's integrals
 * however far a body turns. */
static inline void rotate(const double *restrict pitch, double *restrict cosine,
                          double *restrict sine) {
    const size_t n = CZ_LANE_BLOCK;
    CZ_LANES (i, n) {
        const CzComplex turned = cz_turned(pitch[i] * (0.5 / CZ_PI));
        cosine[i] = turned.re;
        sine[i] = turned.im;
    }
}

/* Value and slope of a curve. */
static void evaluate_curve(const CzBlock *d, int id, const double *restrict x,
                           double *restrict value, double *restrict slope) {
    const CzBlockCurve *curve = &d->curve[id];
    const size_t n = CZ_LANE_BLOCK;
    CZ_LANES (i, n) {
        value[i] = curve->start[i];
        slope[i] = 0.0;
    }
    for (int kink = 0; kink < curve->n_kink; ++kink) {
        const double *restrict at = curve->kink[2 * kink];
        const double *restrict change = curve->kink[2 * kink + 1];
        CZ_LANES (i, n) {
            const double beyond = x[i] - at[i];
            const double counted = beyond >= 0.0 ? change[i] : 0.0;
            value[i] += counted * beyond;
            slope[i] += counted;
        }
    }
}

/* The same in one lane. */
static void curve_at(const CzBlock *d, int id, size_t lane, double x, double *value,
                     double *slope) {
    const CzBlockCurve *curve = &d->curve[id];
    *value = curve->start[lane];
    *slope = 0.0;
    for (int kink = 0; kink < curve->n_kink; ++kink) {
        const double beyond = x - curve->kink[2 * kink][lane];
        const double counted = beyond >= 0.0 ? curve->kink[2 * kink + 1][lane] : 0.0;
        *value += counted * beyond;
        *slope += counted;
    }
}

/* Adds to `count` in the lanes that pass the begin or the end of a falling part of a curve. */
static void count_turns(const CzBlock *d, int id, const double *restrict from,
                        const double *restrict to, double *restrict count) {
    const CzBlockCurve *curve = &d->curve[id];
    const size_t n = CZ_LANE_BLOCK;
    CzRow slope = {0.0};
    for (int kink = 0; curve->falls && kink < curve->n_kink; ++kink) {
        const double *restrict at = curve->kink[2 * kink];
        const double *restrict change = curve->kink[2 * kink + 1];
        CZ_LANES (i, n) {
            const double after = slope[i] + change[i];
            const double turns = cz_smaller(slope[i], after) < CZ_FALLING ? 1.0 : 0.0;
            const double reached = at[i] < to[i] ? turns : 0.0;
            count[i] += at[i] >= from[i] ? reached : 0.0;
            slope[i] = after;
        }
    }
}

/* Largest shortening within the stages of a crush zone: beyond the last one it stands on its stop.
 */
static void largest_of_stages(const CzBlock *d, int curve, const double *restrict largest,
                              double *restrict within) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict usable = d->curve[curve].usable;
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
