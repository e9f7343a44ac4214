/* The modal track in the kernel: from the wheels of a block to its rails and back. Part of kernel.c
 * only. */
#ifndef CZ_DYNAMICS_KERNEL_TRACK_H
#define CZ_DYNAMICS_KERNEL_TRACK_H

#include "base/complex.h"
#include "dynamics/kernel_lanes.h"
#include "dynamics/track_motion.h"

/* Places of the wheelsets of one car now. */
static void find_wheels(const CzBlock *d, size_t lane, double place[4]) {
    for (int axle = 0; axle < 4; ++axle)
        place[axle] = cz_wheel_place(d->parameter.bogie_x[lane], d->parameter.axle_x[lane], axle) +
                      d->position.wheelset[axle].x[lane];
}

static void put_rail(CzRailRows *rail, size_t lane, CzRailPoint point) {
    rail->z[lane] = point.z;
    rail->past[lane] = point.past;
    rail->slope[lane] = point.slope;
    rail->flexibility[lane] = point.flexibility;
    rail->flexibility_slope[lane] = point.flexibility_slope;
}

/* Reads the rails under one car. */
static void look_under(const CzTrackMotion *track, const CzTrackUnder *under, CzBlock *d,
                       size_t lane) {
    double place[4];
    CzComplex seat[4];
    find_wheels(d, lane, place);
    cz_track_shapes(track, place, under->shape, seat);
    for (int axle = 0; axle < 4; ++axle)
        put_rail(&d->rail[axle], lane,
                 cz_track_on_spring(&track->flexibility, track->per_spacing,
                                    cz_track_at(track, under, axle), seat[axle]));
}

/* Reads the rails under the wheels of a block at their present places. */
static void look_at_modes(const CzTrackMotion *track, CzBlock *d, int block) {
    for (size_t i = 0; i < CZ_LANE_BLOCK; ++i) {
        const CzTrackUnder *under = &track->under[(size_t)block * CZ_LANE_BLOCK + i];
        if (under->state != NULL)
            look_under(track, under, d, i);
    }
}

static void look_at_elements(CzElements *elements, CzBlock *d, int block) {
    for (size_t i = 0; i < CZ_LANE_BLOCK; ++i) {
        const size_t index = (size_t)block * CZ_LANE_BLOCK + i;
        double place[4];
        CzRailPoint point[4];
        if (!elements->under[index].is_laid)
            continue;
        find_wheels(d, i, place);
        cz_elements_look(elements, index, place, point);
        for (int axle = 0; axle < 4; ++axle)
            put_rail(&d->rail[axle], i, point[axle]);
    }
}

/* The modes move with the bogie, so they have no slope; the additional flexibility varies over a
 * bay. */
static void look_at_receptance(const CzReceptanceMotion *track, CzBlock *d, int block) {
    const CzReceptanceBlock *under = &track->block[block];
    for (int axle = 0; axle < 4; ++axle) {
        CzRailRows *rail = &d->rail[axle];
        const double *restrict bogie_x = d->parameter.bogie_x, *restrict axle_x =
                                                                   d->parameter.axle_x;
        const double *restrict x = d->position.wheelset[axle].x;
        const double *restrict z = under->z[axle], *restrict past = under->past[axle];
        _Alignas(64) CzRow seat_re, seat_im;
        CZ_LANES (i) {
            const double place = cz_wheel_place(bogie_x[i], axle_x[i], axle) + x[i];
            const CzComplex seat = cz_turned(place * track->per_spacing);
            seat_re[i] = seat.re;
            seat_im[i] = seat.im;
            rail->z[i] = z[i];
            rail->past[i] = past[i];
            rail->flexibility[i] = 0.0;
            rail->flexibility_slope[i] = 0.0;
        }
        for (int k = 0; k < under->n_part; ++k) {
            const CzTrackFlexibility *flexibility = &under->part[k].steps->flexibility;
            const double *restrict is_under = under->part[k].is_under;
            CZ_LANES (i) {
                const CzRailPoint point =
                    cz_track_on_spring(flexibility, track->per_spacing, (CzRailPoint){.z = 0.0},
                                       (CzComplex){seat_re[i], seat_im[i]});
                rail->flexibility[i] += is_under[i] * point.flexibility;
                rail->flexibility_slope[i] += is_under[i] * point.flexibility_slope;
            }
        }
    }
}

static void look_at_rails(const CzDynamics *dynamics, int block) {
    CzBlock *d = &dynamics->block[block];
    if (dynamics->track != NULL)
        look_at_modes(dynamics->track, d, block);
    if (dynamics->elements != NULL)
        look_at_elements(dynamics->elements, d, block);
    if (dynamics->receptance != NULL)
        look_at_receptance(dynamics->receptance, d, block);
}

static void transfer_work(CzBlock *d, size_t lane, double work) {
    d->work.track[lane] += work;
    d->work.wheel_normal[lane] -= work;
}

/* Forces of the wheels of one car on its rails, upwards. */
static void press_rails(const CzBlock *d, size_t lane, double force[4]) {
    for (int axle = 0; axle < 4; ++axle)
        force[axle] = -d->published.wheel[axle].force[lane];
}

/* Advances the rails by one step under the forces of the last evaluation. */
static void advance_modes(const CzTrackMotion *track, CzBlock *d, int block) {
    for (size_t i = 0; i < CZ_LANE_BLOCK; ++i) {
        CzTrackUnder *under = &track->under[(size_t)block * CZ_LANE_BLOCK + i];
        if (under->state == NULL)
            continue;
        press_rails(d, i, under->force);
        transfer_work(d, i, cz_track_step(track, under, under->force));
    }
}

static void advance_elements(CzElements *elements, CzBlock *d, int block) {
    CzElementsUnder *under = elements->under + (size_t)block * CZ_LANE_BLOCK;
    if (elements->block[block].u == NULL)
        return;
    for (size_t i = 0; i < CZ_LANE_BLOCK; ++i)
        press_rails(d, i, under[i].force);
    cz_elements_step(elements, (size_t)block);
    for (size_t i = 0; i < CZ_LANE_BLOCK; ++i) {
        double work = 0.0;
        for (int axle = 0; axle < 4 && under[i].is_laid; ++axle)
            work += under[i].force[axle] *
                    (cz_elements_past(elements, (size_t)block * CZ_LANE_BLOCK + i, axle) -
                     d->rail[axle].past[i]);
        transfer_work(d, i, work);
    }
}

/* Advances n modes by one step under a force; adds their deflection. */
static void advance_pair(const CzPairStep *mode, int n, const double *restrict force, CzRow *state,
                         double *restrict now, double *restrict past) {
    for (int k = 0; k < n; ++k) {
        const CzPairStep m = mode[k];
        double *restrict re = state[2 * k], *restrict im = state[2 * k + 1];
        CZ_LANES (i) {
            const double kicked_re = re[i] + m.kick.re * force[i];
            const double kicked_im = im[i] + m.kick.im * force[i];
            re[i] = m.flight.re * kicked_re - m.flight.im * kicked_im;
            im[i] = m.flight.re * kicked_im + m.flight.im * kicked_re;
            now[i] += m.now.re * re[i] - m.now.im * im[i];
            past[i] += m.past.re * re[i] - m.past.im * im[i];
        }
    }
}

/* Advances a bogie's modes of all parts of a block by one step. */
static void advance_bogie(CzReceptanceBlock *under, int bogie, const double *restrict rear,
                          const double *restrict front) {
    _Alignas(64) CzRow now[CZ_N_PAIR_MOTION] = {{0.0}}, past[CZ_N_PAIR_MOTION] = {{0.0}};
    for (int k = 0; k < under->n_part; ++k) {
        const CzReceptancePart *part = &under->part[k];
        const int *n = part->steps->n;
        const double *restrict is_under = part->is_under;
        _Alignas(64) CzRow bounce, pitch;
        CZ_LANES (i) {
            bounce[i] = -0.5 * is_under[i] * (rear[i] + front[i]);
            pitch[i] = -0.5 * is_under[i] * (rear[i] - front[i]);
        }
        CzRow *state = part->state + 2 * bogie * (n[0] + n[1]);
        advance_pair(part->steps->mode[CZ_PAIR_BOUNCE], n[0], bounce, state, now[0], past[0]);
        advance_pair(part->steps->mode[CZ_PAIR_PITCH], n[1], pitch, state + 2 * n[0], now[1],
                     past[1]);
    }
    CZ_LANES (i) {
        under->z[2 * bogie][i] = now[0][i] + now[1][i];
        under->z[2 * bogie + 1][i] = now[0][i] - now[1][i];
        under->past[2 * bogie][i] = past[0][i] + past[1][i];
        under->past[2 * bogie + 1][i] = past[0][i] - past[1][i];
    }
}

static void advance_receptance(CzReceptanceMotion *track, CzBlock *d, int block) {
    CzReceptanceBlock *under = &track->block[block];
    double *restrict taken = d->work.track, *restrict given = d->work.wheel_normal;
    for (int bogie = 0; bogie < 2; ++bogie)
        advance_bogie(under, bogie, d->published.wheel[2 * bogie].force,
                      d->published.wheel[2 * bogie + 1].force);
    for (int axle = 0; axle < 4; ++axle) {
        const double *restrict force = d->published.wheel[axle].force;
        const double *restrict before = d->rail[axle].past, *restrict past = under->past[axle];
        CZ_LANES (i) {
            const double work = force[i] * (before[i] - past[i]);
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
    if (dynamics->receptance != NULL)
        advance_receptance(dynamics->receptance, d, block);
}

/* Whether the rails deflect. */
static bool is_elastic(const CzDynamics *dynamics) {
    return dynamics->track != NULL || dynamics->elements != NULL || dynamics->receptance != NULL;
}

#endif
