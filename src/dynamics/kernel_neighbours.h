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

/* A row of both blocks side by side. */
typedef double Pair[2 * CZ_LANE_BLOCK];

static inline void lay(const double *restrict low, const double *restrict high,
                       double *restrict pair) {
    const size_t n = CZ_LANE_BLOCK;
    CZ_LANES (i, n) {
        pair[i] = low[i];
        pair[n + i] = high[i];
    }
}

/* The row that is seen through a window. All rows are laid before the first is picked: a load
 * across two stores waits for both. */
static inline void pick(const Window *w, const double *restrict pair, double *restrict row) {
    const size_t n = CZ_LANE_BLOCK, offset = w->offset;
    CZ_LANES (i, n) {
        row[i] = pair[offset + i];
    }
}

/* Lays position, velocity and rotation of a body or an end. */
static void lay_motion(const Window *w, int dof, int rotation, Pair *pair) {
    for (int k = 0; k < 3; ++k) {
        lay(w->low->position[dof + k], w->high->position[dof + k], pair[k]);
        lay(w->low->velocity[dof + k], w->high->velocity[dof + k], pair[3 + k]);
    }
    for (int k = 0; k < 2; ++k)
        lay(w->low->scratch[rotation + k], w->high->scratch[rotation + k], pair[6 + k]);
}

/* Where the body and the rear end of the car ahead are, and how they move. */
static void look_ahead(const CzDynamics *dynamics, int index) {
    CzBlock *d = &dynamics->block[index];
    const Window ahead = window(dynamics, index, dynamics->lanes->n_design);
    Pair pair[16];
    lay_motion(&ahead, CZ_DOF_BODY_X, CZ_S_BODY_COS, pair);
    lay_motion(&ahead, CZ_DOF_END_X_REAR, CZ_S_END_COS_REAR, pair + 8);
    for (int k = 0; k < 8; ++k) {
        pick(&ahead, pair[k], S_AT(BODY_AHEAD_X, k));
        pick(&ahead, pair[8 + k], S_AT(END_AHEAD_X, k));
    }
}

/* What the interfaces behind the cars push: rear ends and their sections start from it. */
static void take_over(const CzDynamics *dynamics, int index) {
    CzBlock *d = &dynamics->block[index];
    const Window behind = window(dynamics, index, -dynamics->lanes->n_design);
    Pair pair[7];
    for (int k = 0; k < 7; ++k)
        lay(behind.low->scratch[CZ_S_PUSHED_X + k], behind.high->scratch[CZ_S_PUSHED_X + k],
            pair[k]);
    for (int k = 0; k < 3; ++k) {
        pick(&behind, pair[k], S_AT(FROM_BEHIND_X, k));
        pick(&behind, pair[3 + k], G_AT(END_X_REAR, k));
    }
    pick(&behind, pair[6], S(SECTION_REAR));
}

/* Bodies get it on top of everything else, so that the sum does not depend on how lanes are
 * grouped. */
static void push_bodies(CzBlock *d) {
    const size_t n = CZ_LANE_BLOCK;
    for (int k = 0; k < 3; ++k) {
        double *restrict body = G_AT(BODY_X, k);
        const double *restrict pushed = S_AT(FROM_BEHIND_X, k);
        CZ_LANES (i, n) {
            body[i] += pushed[i];
        }
    }
}

#endif
