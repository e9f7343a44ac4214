/* Exchange between the lanes of a car and those of the car ahead, which may be in another block.
 * Part of kernel.c only.
 *
 * Before the interfaces every block reads the motion of the cars ahead; after them every block adds
 * the forces of the interfaces behind its cars. No block writes into another one.
 */
#ifndef CZ_DYNAMICS_KERNEL_NEIGHBOURS_H
#define CZ_DYNAMICS_KERNEL_NEIGHBOURS_H

#include "dynamics/kernel_lanes.h"

/* CZ_LANE_BLOCK neighbouring lanes, which may span two blocks. */
typedef struct {
    const CzBlock *low, *high;
    size_t offset; /* of the first lane in `low` */
} Window;

static const CzBlock *block_or_zeros(const CzDynamics *dynamics, int index) {
    return &dynamics->block[index >= 0 && index < dynamics->n_block ? index : dynamics->n_block];
}

/* The lanes at a distance of `shift` from those of a block; zeros where there are none. */
static Window window(const CzDynamics *dynamics, int index, int shift) {
    const int offset = (shift % CZ_LANE_BLOCK + CZ_LANE_BLOCK) % CZ_LANE_BLOCK;
    const int low = index + (shift - offset) / CZ_LANE_BLOCK;
    return (Window){block_or_zeros(dynamics, low), block_or_zeros(dynamics, low + 1),
                    (size_t)offset};
}

/* Reads n consecutive rows of a window, which begin `at` bytes from the beginning of a block. For
 * cars on a curved track they would be rotated and shifted here. */
static inline void pick(const Window *w, size_t at, void *rows, int n) {
    const CzRow *restrict low = (const void *)((const char *)w->low + at);
    const CzRow *restrict high = (const void *)((const char *)w->high + at);
    const size_t offset = w->offset, n_low = CZ_LANE_BLOCK - offset;
    CzRow *restrict row = rows;
    for (int k = 0; k < n; ++k)
        CZ_LANES (i) {
            row[k][i] = i < n_low ? low[k][i + offset] : high[k][i - n_low];
        }
}

enum { ROWS_OF_PLANE = CZ_ROWS_IN(CzPlane), ROWS_OF_TURNED = CZ_ROWS_IN(CzTurned) };

/* Reads the motion of a body, its places in a state and among the turned bodies. */
static inline void pick_motion(const Window *w, size_t plane, size_t turned, CzMotion *motion) {
    pick(w, offsetof(CzBlock, position) + plane, &motion->displacement, ROWS_OF_PLANE);
    pick(w, offsetof(CzBlock, velocity) + plane, &motion->rate, ROWS_OF_PLANE);
    pick(w, turned, &motion->turned, ROWS_OF_TURNED);
}

/* Reads the motion of the cars ahead along the track: all else of it remains as it is. */
static void look_ahead_along(const Window *ahead, CzSeen *seen) {
    pick(ahead, offsetof(CzBlock, position.body.x), seen->body.displacement.x, 1);
    pick(ahead, offsetof(CzBlock, velocity.body.x), seen->body.rate.x, 1);
    pick(ahead, offsetof(CzBlock, position.end[0].x), seen->end.displacement.x, 1);
    pick(ahead, offsetof(CzBlock, velocity.end[0].x), seen->end.rate.x, 1);
}

/* Reads position and velocity of the body and the rear end of the car ahead. */
static void look_ahead(const CzDynamics *dynamics, int index) {
    CzBlock *d = &dynamics->block[index];
    const Window ahead = window(dynamics, index, dynamics->lanes->n_design);
    if (!dynamics->lanes->has.full_cars && d->has_looked) {
        look_ahead_along(&ahead, &d->ahead);
        return;
    }
    d->has_looked = 1;
    pick_motion(&ahead, offsetof(CzState, body), offsetof(CzBlock, turned.body), &d->ahead.body);
    pick_motion(&ahead, offsetof(CzState, end[0]), offsetof(CzBlock, turned.end[0]), &d->ahead.end);
}

/* Forces along the track of the interfaces behind cars that move along it only. */
static void take_over_along(const Window *behind, CzBlock *d) {
    pick(behind, offsetof(CzBlock, pushed.body.x), d->from_behind.x, 1);
    pick(behind, offsetof(CzBlock, pushed.end.x), d->force.end[0].x, 1);
    pick(behind, offsetof(CzBlock, pushed.section), d->published.section[0], 1);
}

/* Forces of the interfaces behind the cars: the sums of rear ends and their sections start with
 * them. */
static void take_over(const CzDynamics *dynamics, int index) {
    CzBlock *d = &dynamics->block[index];
    const Window behind = window(dynamics, index, -dynamics->lanes->n_design);
    if (!dynamics->lanes->has.full_cars) {
        take_over_along(&behind, d);
        return;
    }
    pick(&behind, offsetof(CzBlock, pushed.body), &d->from_behind, ROWS_OF_PLANE);
    pick(&behind, offsetof(CzBlock, pushed.end), &d->force.end[0], ROWS_OF_PLANE);
    pick(&behind, offsetof(CzBlock, pushed.section), d->published.section[0], 1);
}

/* Adds them to the bodies after all other forces, so that the sum does not depend on the grouping
 * of lanes. */
static void push_bodies(CzPlane *restrict body, const CzPlane *restrict pushed) {
    CZ_LANES (i) {
        body->x[i] += pushed->x[i];
        body->z[i] += pushed->z[i];
        body->pitch[i] += pushed->pitch[i];
    }
}

#endif
