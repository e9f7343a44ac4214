/* The modal track in the kernel: from the wheels of a block to its rails and back. Part of kernel.c
 * only. */
#ifndef CZ_DYNAMICS_KERNEL_TRACK_H
#define CZ_DYNAMICS_KERNEL_TRACK_H

#include "base/complex.h"
#include "dynamics/kernel_lanes.h"
#include "dynamics/track_motion.h"

/* The rails under the four wheelsets of one car, at their places now. Ring and bay are turned in
 * one go: four of each fill a register. */
static void look_under(const CzTrackMotion *track, const CzTrackUnder *under, CzBlock *d,
                       int lane) {
    double turns[8], cosine[8], sine[8];
    for (int axle = 0; axle < 4; ++axle) {
        const double place =
            cz_wheel_place(d->parameter.bogie_x[lane], d->parameter.axle_x[lane], axle) +
            d->position.wheelset[axle].x[lane];
        turns[axle] = place * track->per_length;
        turns[4 + axle] = place * track->per_spacing;
    }
    _Static_assert(CZ_LANE_BLOCK == 8, "two of each axle");
    CZ_LANES (i) {
        const CzComplex turned = cz_turned(turns[i]);
        cosine[i] = turned.re;
        sine[i] = turned.im;
    }
    for (int axle = 0; axle < 4; ++axle) {
        const CzComplex ring = {cosine[axle], sine[axle]};
        const CzComplex seat = {cosine[4 + axle], sine[4 + axle]};
        cz_track_shape(track, ring, seat, under->shape + 4 * axle * track->modes->n_vector);
        const CzTrackPoint point = cz_track_at(track, under, axle);
        const CzTrackSpring spring = cz_track_spring(track, seat);
        d->rail[axle].z[lane] = point.z;
        d->rail[axle].past[lane] = point.past;
        d->rail[axle].slope[lane] = point.slope;
        d->rail[axle].flexibility[lane] = spring.flexibility;
        d->rail[axle].flexibility_slope[lane] = spring.slope;
    }
}

/* The rails under the wheels of a block, where these are now. */
static void look_at_modes(const CzTrackMotion *track, CzBlock *d, int block) {
    for (int i = 0; i < CZ_LANE_BLOCK; ++i) {
        const CzTrackUnder *under = &track->under[block * CZ_LANE_BLOCK + i];
        if (under->state != NULL)
            look_under(track, under, d, i);
    }
}

static void look_at_elements(CzElements *elements, CzBlock *d, int block) {
    for (int i = 0; i < CZ_LANE_BLOCK; ++i) {
        const size_t index = (size_t)(block * CZ_LANE_BLOCK + i);
        if (!elements->under[index].is_laid)
            continue;
        double place[4];
        CzElementsPoint point[4];
        for (int axle = 0; axle < 4; ++axle)
            place[axle] = cz_wheel_place(d->parameter.bogie_x[i], d->parameter.axle_x[i], axle) +
                          d->position.wheelset[axle].x[i];
        cz_elements_look(elements, index, place, point);
        for (int axle = 0; axle < 4; ++axle) {
            d->rail[axle].z[i] = point[axle].z;
            d->rail[axle].past[i] = point[axle].past;
            d->rail[axle].slope[i] = point[axle].slope;
            d->rail[axle].flexibility[i] = point[axle].flexibility;
            d->rail[axle].flexibility_slope[i] = point[axle].flexibility_slope;
        }
    }
}

/* What runs along has no slope. */
static void look_at_co_running(const CzCoRunningStep *track, CzBlock *d) {
    for (int axle = 0; axle < 4; ++axle) {
        const double *restrict re = d->rail_mode[axle][0], *restrict im = d->rail_mode[axle][1];
        double *restrict z = d->rail[axle].z, *restrict past = d->rail[axle].past;
        double *restrict flexibility = d->rail[axle].flexibility;
        CZ_LANES (i) {
            z[i] = track->now.re * re[i] - track->now.im * im[i];
            past[i] = track->past.re * re[i] - track->past.im * im[i];
            flexibility[i] = track->flexibility;
        }
    }
}

static void look_at_rails(const CzDynamics *dynamics, int block) {
    CzBlock *d = &dynamics->block[block];
    if (dynamics->track != NULL)
        look_at_modes(dynamics->track, d, block);
    if (dynamics->elements != NULL)
        look_at_elements(dynamics->elements, d, block);
    if (dynamics->co_running != NULL)
        look_at_co_running(dynamics->co_running, d);
}

/* One step of the rails under the forces of the last evaluation. These held for a step about its
 * time, and their work is what the rail deflected from half a step before to half a step after. */
static void advance_modes(const CzTrackMotion *track, CzBlock *d, int block) {
    for (int i = 0; i < CZ_LANE_BLOCK; ++i) {
        CzTrackUnder *under = &track->under[block * CZ_LANE_BLOCK + i];
        if (under->state == NULL)
            continue;
        for (int axle = 0; axle < 4; ++axle)
            under->force[axle] = -d->published.wheel[axle].force[i];
        cz_track_step(track, under, under->force);
        double work = 0.0;
        for (int axle = 0; axle < 4; ++axle)
            work +=
                under->force[axle] * (cz_track_at(track, under, axle).past - d->rail[axle].past[i]);
        d->work.track[i] += work;
        d->work.wheel_normal[i] -= work;
    }
}

static void advance_elements(CzElements *elements, CzBlock *d, int block) {
    const size_t first = (size_t)(block * CZ_LANE_BLOCK);
    if (elements->block[block].u == NULL)
        return;
    for (int i = 0; i < CZ_LANE_BLOCK; ++i) {
        double force[4];
        for (int axle = 0; axle < 4; ++axle)
            force[axle] = -d->published.wheel[axle].force[i];
        cz_elements_press(elements, first + (size_t)i, force);
    }
    cz_elements_step(elements, (size_t)block);
    for (int i = 0; i < CZ_LANE_BLOCK; ++i) {
        const size_t lane = first + (size_t)i;
        double work = 0.0;
        if (!elements->under[lane].is_laid)
            continue;
        for (int axle = 0; axle < 4; ++axle)
            work += elements->under[lane].force[axle] *
                    (cz_elements_past(elements, lane, axle) - d->rail[axle].past[i]);
        d->work.track[i] += work;
        d->work.wheel_normal[i] -= work;
    }
}

static void advance_co_running(const CzCoRunningStep *track, CzBlock *d) {
    double *restrict taken = d->work.track, *restrict given = d->work.wheel_normal;
    for (int axle = 0; axle < 4; ++axle) {
        const double *restrict force = d->published.wheel[axle].force, *restrict past =
                                                                           d->rail[axle].past;
        double *restrict re = d->rail_mode[axle][0], *restrict im = d->rail_mode[axle][1];
        CZ_LANES (i) {
            const double kicked_re = re[i] - track->kick.re * force[i];
            const double kicked_im = im[i] - track->kick.im * force[i];
            const double next_re = track->flight.re * kicked_re - track->flight.im * kicked_im;
            const double next_im = track->flight.re * kicked_im + track->flight.im * kicked_re;
            const double now = track->past.re * next_re - track->past.im * next_im;
            const double work = force[i] * (past[i] - now);
            re[i] = next_re;
            im[i] = next_im;
            taken[i] += work;
            given[i] -= work;
        }
    }
}

static void advance_rails(const CzDynamics *dynamics, int block) {
    CzBlock *d = &dynamics->block[block];
    if (dynamics->track != NULL)
        advance_modes(dynamics->track, d, block);
    if (dynamics->elements != NULL)
        advance_elements(dynamics->elements, d, block);
    if (dynamics->co_running != NULL)
        advance_co_running(dynamics->co_running, d);
}

/* Whether the rails deflect. */
static bool is_elastic(const CzDynamics *dynamics) {
    return dynamics->track != NULL || dynamics->elements != NULL || dynamics->co_running != NULL;
}

#endif
