/* The modal track in the kernel: from the wheels of a block to its rails and back. Part of kernel.c
 * only. */
#ifndef CZ_DYNAMICS_KERNEL_TRACK_H
#define CZ_DYNAMICS_KERNEL_TRACK_H

#include "dynamics/kernel_rows.h"
#include "dynamics/track_motion.h"

/* Where one axle stands on the ring and between two seats, and what it feels there beside the
 * modes.
 */
static void stand_on_rails(const CzTrackMotion *track, CzBlock *d, int axle, CzRow ring[2],
                           CzRow seat[2]) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict bogie = P(BOGIE_X), *restrict half = P(AXLE_X);
    const double *restrict way = X_AT(WHEEL_X_0, 3 * axle);
    double *restrict flexibility = S_AT(RAIL_FLEXIBILITY_0, axle), *restrict change = S_AT(
                                                                       RAIL_FLEXIBILITY_SLOPE_0,
                                                                       axle);
    CZ_LANES (i, n) {
        const double place = cz_wheel_place(bogie[i], half[i], axle) + way[i];
        const CzComplex on_ring = cz_turned(place * track->per_length);
        const CzComplex on_seat = cz_turned(place * track->per_spacing);
        const CzTrackSpring spring = cz_track_spring(track, on_seat);
        ring[0][i] = on_ring.re;
        ring[1][i] = on_ring.im;
        seat[0][i] = on_seat.re;
        seat[1][i] = on_seat.im;
        flexibility[i] = spring.flexibility;
        change[i] = spring.slope;
    }
}

/* The rails under the wheels of a block, where these are now. */
static void look_at_rails(const CzTrackMotion *track, CzBlock *d, int block) {
    for (int axle = 0; axle < 4; ++axle) {
        CzRow ring[2], seat[2];
        stand_on_rails(track, d, axle, ring, seat);
        for (int i = 0; i < CZ_LANE_BLOCK; ++i) {
            const CzTrackUnder *under = &track->under[block * CZ_LANE_BLOCK + i];
            if (under->state == NULL)
                continue;
            cz_track_shape(track, (CzComplex){ring[0][i], ring[1][i]},
                           (CzComplex){seat[0][i], seat[1][i]},
                           under->shape + 4 * axle * track->modes->n_vector);
            const CzTrackPoint point = cz_track_at(track, under, axle);
            S_AT(RAIL_Z_0, axle)[i] = point.z;
            S_AT(RAIL_PAST_0, axle)[i] = point.past;
            S_AT(RAIL_SLOPE_0, axle)[i] = point.slope;
        }
    }
}

/* One step of the rails under the forces of the last evaluation. These held for a step about its
 * time, and their work is what the rail gave way from half a step before to half a step after. */
static void advance_rails(const CzTrackMotion *track, CzBlock *d, int block) {
    for (int i = 0; i < CZ_LANE_BLOCK; ++i) {
        CzTrackUnder *under = &track->under[block * CZ_LANE_BLOCK + i];
        if (under->state == NULL)
            continue;
        for (int axle = 0; axle < 4; ++axle)
            under->force[axle] = -S_AT(WHEEL_FORCE_0, axle)[i];
        cz_track_step(track, under, under->force);
        double work = 0.0;
        for (int axle = 0; axle < 4; ++axle)
            work += under->force[axle] *
                    (cz_track_at(track, under, axle).past - S_AT(RAIL_PAST_0, axle)[i]);
        d->work[CZ_L_TRACK][i] += work;
        d->work[CZ_L_WHEEL_NORMAL][i] -= work;
    }
}

#endif
