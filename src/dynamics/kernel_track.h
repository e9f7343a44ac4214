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

/* Turns of the wheels of a block at their present places, and the flexibility there. */
static void turn_wheels(const CzTrackMotion *track, CzBlock *d, CzTrackTurns *turns) {
    _Alignas(64) CzRow place[4];
    for (int axle = 0; axle < 4; ++axle) {
        const double *restrict bogie_x = d->parameter.bogie_x, *restrict axle_x =
                                                                   d->parameter.axle_x;
        const double *restrict x = d->position.wheelset[axle].x;
        CZ_LANES (i) {
            place[axle][i] = cz_wheel_place(bogie_x[i], axle_x[i], axle) + x[i];
        }
    }
    cz_track_turn(track, (const CzRow *)place, turns);
    for (int axle = 0; axle < 4; ++axle) {
        CzRailRows *rail = &d->rail[axle];
        const double *restrict cosine = turns->seat_re[axle], *restrict sine = turns->seat_im[axle];
        CZ_LANES (i) {
            const CzRailPoint point = cz_track_on_spring(
                track->flexibility.corner, track->flexibility.term, 1, track->per_spacing,
                (CzRailPoint){.z = 0.0}, (CzComplex){cosine[i], sine[i]});
            rail->flexibility[i] = point.flexibility;
            rail->flexibility_slope[i] = point.flexibility_slope;
        }
    }
}

/* Reads the modes under the wheels of one car. */
static void look_at_car(const CzTrackMotion *track, const CzTrackUnder *under,
                        const CzTrackTurns *turns, CzBlock *d, int lane) {
    for (int axle = 0; axle < 4; ++axle) {
        const CzTrackDeflection look = cz_track_move_wheel(track, under, turns, lane, axle);
        d->rail[axle].z[lane] = look.z;
        d->rail[axle].slope[lane] = look.slope;
    }
}

/* Reads the rails under the wheels of a block at their present places. */
static void look_at_modes(const CzTrackMotion *track, CzBlock *d, int block) {
    CzTrackTurns turns;
    turn_wheels(track, d, &turns);
    for (int i = 0; i < CZ_LANE_BLOCK; ++i) {
        const CzTrackUnder *under = &track->under[block * CZ_LANE_BLOCK + i];
        if (under->state != NULL)
            look_at_car(track, under, &turns, d, i);
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
        cz_elements_deflection(elements, index, place, point);
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
        const double *restrict per_spacing = under->per_spacing, *restrict corner = under->corner;
        const double *restrict term = under->term[0];
        CZ_LANES (i) {
            const double place = cz_wheel_place(bogie_x[i], axle_x[i], axle) + x[i];
            const CzRailPoint point =
                cz_track_on_spring(corner[i], term + i, CZ_LANE_BLOCK, per_spacing[i],
                                   (CzRailPoint){.z = 0.0}, cz_turned(place * per_spacing[i]));
            rail->z[i] = z[i];
            rail->past[i] = past[i];
            rail->flexibility[i] = point.flexibility;
            rail->flexibility_slope[i] = point.flexibility_slope;
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

/* Advances the modes under one car by one step under the forces of the last evaluation. */
static void advance_car(const CzTrackMotion *track, CzTrackUnder *under, CzBlock *d, size_t lane) {
    press_rails(d, lane, under->force);
    transfer_work(d, lane, cz_track_step(track, under, under->force));
}

/* The same for all cars of a block. */
static void advance_modes(const CzTrackMotion *track, CzBlock *d, int block) {
    for (size_t i = 0; i < CZ_LANE_BLOCK; ++i) {
        CzTrackUnder *under = &track->under[(size_t)block * CZ_LANE_BLOCK + i];
        if (under->state != NULL)
            advance_car(track, under, d, i);
    }
}

/* Advances them and reads them at the present places of the wheels, car by car, because the modes
 * under all cars exceed the first cache. */
static void move_modes(const CzTrackMotion *track, CzBlock *d, int block) {
    CzTrackTurns turns;
    turn_wheels(track, d, &turns);
    for (int i = 0; i < CZ_LANE_BLOCK; ++i) {
        CzTrackUnder *under = &track->under[block * CZ_LANE_BLOCK + i];
        if (under->state == NULL)
            continue;
        advance_car(track, under, d, (size_t)i);
        look_at_car(track, under, &turns, d, i);
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

/* Advances the state y of a mode in one lane by one step under a force; adds its deflection. */
static inline void advance_mode(CzComplex flight, CzComplex kick, CzComplex now, CzComplex past,
                                double force, double *re, double *im, double *sum_now,
                                double *sum_past) {
    const double kicked_re = *re + kick.re * force;
    const double kicked_im = *im + kick.im * force;
    *re = flight.re * kicked_re - flight.im * kicked_im;
    *im = flight.re * kicked_im + flight.im * kicked_re;
    *sum_now += now.re * *re - now.im * *im;
    *sum_past += past.re * *re - past.im * *im;
}

/* The same for n modes in all lanes, which are on the same track; returns the sums of their
 * deflections. Sums in rows of a function's own stay in registers. */
static void advance_same(const CzPairStep *mode, int n, const double *restrict force, CzRow *state,
                         double *restrict now, double *restrict past) {
    _Alignas(64) CzRow sum_now = {0.0}, sum_past = {0.0};
    for (int k = 0; k < n; ++k) {
        const CzPairStep m = mode[k];
        double *restrict re = state[2 * k], *restrict im = state[2 * k + 1];
        CZ_LANES (i) {
            advance_mode(m.flight, m.kick, m.now, m.past, force[i], &re[i], &im[i], &sum_now[i],
                         &sum_past[i]);
        }
    }
    CZ_LANES (i) {
        now[i] = sum_now[i];
        past[i] = sum_past[i];
    }
}

/* The same where the lanes are on several tracks. */
static void advance_mixed(const CzPairStepRows *mode, int n, const double *restrict force,
                          CzRow *state, double *restrict now, double *restrict past) {
    _Alignas(64) CzRow sum_now = {0.0}, sum_past = {0.0};
    for (int k = 0; k < n; ++k) {
        const CzPairStepRows *restrict m = &mode[k];
        double *restrict re = state[2 * k], *restrict im = state[2 * k + 1];
        CZ_LANES (i) {
            advance_mode((CzComplex){m->flight_re[i], m->flight_im[i]},
                         (CzComplex){m->kick_re[i], m->kick_im[i]},
                         (CzComplex){m->now_re[i], m->now_im[i]},
                         (CzComplex){m->past_re[i], m->past_im[i]}, force[i], &re[i], &im[i],
                         &sum_now[i], &sum_past[i]);
        }
    }
    CZ_LANES (i) {
        now[i] = sum_now[i];
        past[i] = sum_past[i];
    }
}

/* Advances the modes under the bogies of a block by one step. */
static void advance_bogie(CzReceptanceBlock *under, int bogie, const double *restrict rear,
                          const double *restrict front) {
    _Alignas(64) CzRow now[CZ_N_PAIR_MOTION], past[CZ_N_PAIR_MOTION];
    _Alignas(64) CzRow force[CZ_N_PAIR_MOTION];
    CZ_LANES (i) {
        force[CZ_PAIR_BOUNCE][i] = -0.5 * (rear[i] + front[i]);
        force[CZ_PAIR_PITCH][i] = -0.5 * (rear[i] - front[i]);
    }
    for (int motion = 0; motion < CZ_N_PAIR_MOTION; ++motion) {
        CzRow *state = under->state[bogie][motion];
        if (under->same != NULL)
            advance_same(under->same->mode[motion], under->n[motion], force[motion], state,
                         now[motion], past[motion]);
        else
            advance_mixed(under->mode[motion], under->n[motion], force[motion], state, now[motion],
                          past[motion]);
    }
    CZ_LANES (i) {
        under->z[2 * bogie][i] = now[CZ_PAIR_BOUNCE][i] + now[CZ_PAIR_PITCH][i];
        under->z[2 * bogie + 1][i] = now[CZ_PAIR_BOUNCE][i] - now[CZ_PAIR_PITCH][i];
        under->past[2 * bogie][i] = past[CZ_PAIR_BOUNCE][i] + past[CZ_PAIR_PITCH][i];
        under->past[2 * bogie + 1][i] = past[CZ_PAIR_BOUNCE][i] - past[CZ_PAIR_PITCH][i];
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

/* Advances the rails and reads them under the wheels, which have been advanced. */
static void move_rails(const CzDynamics *dynamics, int block) {
    if (dynamics->track != NULL) {
        move_modes(dynamics->track, &dynamics->block[block], block);
        return;
    }
    advance_rails(dynamics, block);
    look_at_rails(dynamics, block);
}

/* Whether the rails deflect. */
static bool is_elastic(const CzDynamics *dynamics) {
    return dynamics->track != NULL || dynamics->elements != NULL || dynamics->receptance != NULL;
}

#endif
