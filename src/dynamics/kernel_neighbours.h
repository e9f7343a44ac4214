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

/* A row of both blocks side by side. */
typedef double Pair[2 * CZ_LANE_BLOCK];

/* Copies n consecutive rows of both blocks. All are copied before the first is read, because a load
 * that spans two stores waits for both. */
static inline void lay(const void *low, const void *high, Pair *restrict pair, int n) {
    const CzRow *restrict lower = low, *restrict upper = high;
    for (int k = 0; k < n; ++k)
        CZ_LANES (i) {
            pair[k][i] = lower[k][i];
            pair[k][CZ_LANE_BLOCK + i] = upper[k][i];
        }
}

/* Reads the rows of a window. For cars on a curved track they would be rotated and shifted here. */
static inline void pick(const Window *w, const Pair *restrict pair, void *rows, int n) {
    const size_t offset = w->offset;
    CzRow *restrict row = rows;
    for (int k = 0; k < n; ++k)
        CZ_LANES (i) {
            row[k][i] = pair[k][offset + i];
        }
}

enum {
    ROWS_OF_PLANE = CZ_ROWS_IN(CzPlane),
    ROWS_OF_TURNED = CZ_ROWS_IN(CzTurned),
    ROWS_OF_MOTION = CZ_ROWS_IN(CzMotion),
    ROWS_PUSHED = CZ_ROWS_IN(CzPushed)
};

/* Copies a motion as the rows of a CzMotion. */
static inline void lay_motion(const Window *w, size_t plane, size_t turned, Pair *pair) {
    const char *low = (const char *)w->low, *high = (const char *)w->high;
    const size_t at = offsetof(CzBlock, position), moves = offsetof(CzBlock, velocity);
    lay(low + at + plane, high + at + plane, pair, ROWS_OF_PLANE);
    lay(low + moves + plane, high + moves + plane, pair + ROWS_OF_PLANE, ROWS_OF_PLANE);
    lay(low + turned, high + turned, pair + 2 * ROWS_OF_PLANE, ROWS_OF_TURNED);
}

/* Reads a row. */
static inline void lay_row(const Window *w, size_t at, Pair *pair) {
    lay((const char *)w->low + at, (const char *)w->high + at, pair, 1);
}

/* Reads the motion of the cars ahead along the track: all else of it remains as it is. */
static void look_ahead_along(const Window *ahead, CzSeen *seen) {
    Pair pair[4];
    lay_row(ahead, offsetof(CzBlock, position.body.x), pair);
    lay_row(ahead, offsetof(CzBlock, velocity.body.x), pair + 1);
    lay_row(ahead, offsetof(CzBlock, position.end[0].x), pair + 2);
    lay_row(ahead, offsetof(CzBlock, velocity.end[0].x), pair + 3);
    pick(ahead, (const Pair *)pair, seen->body.displacement.x, 1);
    pick(ahead, (const Pair *)pair + 1, seen->body.rate.x, 1);
    pick(ahead, (const Pair *)pair + 2, seen->end.displacement.x, 1);
    pick(ahead, (const Pair *)pair + 3, seen->end.rate.x, 1);
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
    Pair pair[2 * ROWS_OF_MOTION];
    lay_motion(&ahead, offsetof(CzState, body), offsetof(CzBlock, turned.body), pair);
    lay_motion(&ahead, offsetof(CzState, end[0]), offsetof(CzBlock, turned.end[0]),
               pair + ROWS_OF_MOTION);
    pick(&ahead, (const Pair *)pair, &d->ahead, 2 * ROWS_OF_MOTION);
}

/* Forces along the track of the interfaces behind cars that move along it only. */
static void take_over_along(const Window *behind, CzBlock *d) {
    Pair pair[3];
    lay_row(behind, offsetof(CzBlock, pushed.body.x), pair);
    lay_row(behind, offsetof(CzBlock, pushed.end.x), pair + 1);
    lay_row(behind, offsetof(CzBlock, pushed.section), pair + 2);
    pick(behind, (const Pair *)pair, d->from_behind.x, 1);
    pick(behind, (const Pair *)pair + 1, d->force.end[0].x, 1);
    pick(behind, (const Pair *)pair + 2, d->published.section[0], 1);
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
    Pair pair[ROWS_PUSHED];
    lay(&behind.low->pushed, &behind.high->pushed, pair, ROWS_PUSHED);
    pick(&behind, (const Pair *)pair, &d->from_behind, ROWS_OF_PLANE);
    pick(&behind, (const Pair *)pair + ROWS_OF_PLANE, &d->force.end[0], ROWS_OF_PLANE);
    pick(&behind, (const Pair *)pair + 2 * ROWS_OF_PLANE, d->published.section[0], 1);
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

_Static_assert(offsetof(CzSeen, end) == ROWS_OF_MOTION * sizeof(CzRow) &&
                   offsetof(CzMotion, turned) == 2 * ROWS_OF_PLANE * sizeof(CzRow) &&
                   offsetof(CzPushed, end) == ROWS_OF_PLANE * sizeof(CzRow),
               "messages are rows in this order");

#endif
