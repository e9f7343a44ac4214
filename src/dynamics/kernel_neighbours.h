/* What passes between the lanes of a car and those of the car ahead, which may lie in other blocks.
 * Part of kernel.c only.
 *
 * Before the interfaces every block reads where the car ahead is; after them every block takes over
 * what the interfaces behind its cars push. Nobody writes into another block.
 */
#ifndef CZ_DYNAMICS_KERNEL_NEIGHBOURS_H
#define CZ_DYNAMICS_KERNEL_NEIGHBOURS_H

#include "dynamics/kernel_rows.h"

/* CZ_LANE_BLOCK lanes that lie across two blocks. */
typedef struct {
    const CzBlock *low, *high;
    size_t offset; /* of the first lane in `low` */
} Window;

static const CzBlock *block_or_zeros(const CzDynamics *dynamics, int index) {
    return &dynamics->block[index >= 0 && index < dynamics->n_block ? index : dynamics->n_block];
}

/* The lanes `shift` on from those of a block; zeros where there are none. */
static Window window(const CzDynamics *dynamics, int index, int shift) {
    const int offset = (shift % CZ_LANE_BLOCK + CZ_LANE_BLOCK) % CZ_LANE_BLOCK;
    const int low = index + (shift - offset) / CZ_LANE_BLOCK;
    return (Window){block_or_zeros(dynamics, low), block_or_zeros(dynamics, low + 1),
                    (size_t)offset};
}

/* A row seen through a window, out of that of its two blocks. */
static inline void look(size_t offset, const double *restrict low, const double *restrict high,
                        double *restrict row) {
    const size_t n = CZ_LANE_BLOCK;
    double both[2 * CZ_LANE_BLOCK];
    CZ_LANES (i, n) {
        both[i] = low[i];
        both[n + i] = high[i];
    }
    CZ_LANES (i, n) {
        row[i] = both[offset + i];
    }
}

/* Position, velocity and rotation of the body or the rear end of the car ahead, from row `to` on.
 */
static void look_at(CzBlock *d, const Window *w, int dof, int rotation, int to) {
    for (int k = 0; k < 3; ++k) {
        look(w->offset, w->low->position[dof + k], w->high->position[dof + k], d->scratch[to + k]);
        look(w->offset, w->low->velocity[dof + k], w->high->velocity[dof + k],
             d->scratch[to + 3 + k]);
    }
    for (int k = 0; k < 2; ++k)
        look(w->offset, w->low->scratch[rotation + k], w->high->scratch[rotation + k],
             d->scratch[to + 6 + k]);
}

static void look_ahead(const CzDynamics *dynamics, int index) {
    CzBlock *d = &dynamics->block[index];
    const Window ahead = window(dynamics, index, dynamics->lanes->n_design);
    look_at(d, &ahead, CZ_DOF_BODY_X, CZ_S_BODY_COS, CZ_S_BODY_AHEAD_X);
    look_at(d, &ahead, CZ_DOF_END_X_REAR, CZ_S_END_COS_REAR, CZ_S_END_AHEAD_X);
}

/* What the interface behind a lane's car keeps in a row. */
static inline void look_behind(const Window *w, int from, double *row) {
    look(w->offset, w->low->scratch[from], w->high->scratch[from], row);
}

/* Rear ends start from what the interfaces behind them push. */
static void take_over_ends(const CzDynamics *dynamics, int index) {
    CzBlock *d = &dynamics->block[index];
    const Window behind = window(dynamics, index, -dynamics->lanes->n_design);
    for (int k = 0; k < 3; ++k)
        look_behind(&behind, CZ_S_PUSHED_END_X + k, G_AT(END_X_REAR, k));
    look_behind(&behind, CZ_S_PUSHED_SECTION, S(SECTION_REAR));
}

/* Bodies get what the interfaces behind them push on top of everything else, so that the sum does
 * not depend on how lanes are grouped. */
static void take_over_bodies(const CzDynamics *dynamics, int index) {
    const size_t n = CZ_LANE_BLOCK;
    CzBlock *d = &dynamics->block[index];
    const Window behind = window(dynamics, index, -dynamics->lanes->n_design);
    for (int k = 0; k < 3; ++k) {
        double *restrict body = G_AT(BODY_X, k);
        CzRow pushed;
        look_behind(&behind, CZ_S_PUSHED_X + k, pushed);
        CZ_LANES (i, n) {
            body[i] += pushed[i];
        }
    }
}

#endif
