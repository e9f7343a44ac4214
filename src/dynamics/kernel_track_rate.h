/* The states of the tracks and their rates, for a solver of ordinary differential equations. Part
 * of kernel.c only. */
#ifndef CZ_DYNAMICS_KERNEL_TRACK_RATE_H
#define CZ_DYNAMICS_KERNEL_TRACK_RATE_H

#include "dynamics/kernel_track.h"
#include "dynamics/track.h"

/* Copies n rows of the states under the cars of a block; returns the end of the states. */
static const double *set_rows(const CzReceptanceBlock *under, int n, const double *state,
                              CzRow *rows) {
    if (under->n_under == CZ_LANE_BLOCK) {
        memcpy(rows, state, (size_t)n * sizeof *rows);
        return state + n * CZ_LANE_BLOCK;
    }
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < under->n_under; ++j)
            rows[k][under->lane[j]] = *state++;
    return state;
}

/* The same from the rows to the states. */
static double *get_row(const CzReceptanceBlock *under, const double *row, double *state) {
    if (under->n_under == CZ_LANE_BLOCK) {
        memcpy(state, row, sizeof(CzRow));
        return state + CZ_LANE_BLOCK;
    }
    for (int j = 0; j < under->n_under; ++j)
        *state++ = row[under->lane[j]];
    return state;
}

/* Adds a deflection in bounce and one in pitch of a bogie: those of its wheels. */
static void put_bogie(const CzRow of_motion[CZ_N_PAIR_MOTION], CzRow wheel[2]) {
    CZ_LANES (i) {
        wheel[0][i] = of_motion[CZ_PAIR_BOUNCE][i] + of_motion[CZ_PAIR_PITCH][i];
        wheel[1][i] = of_motion[CZ_PAIR_BOUNCE][i] - of_motion[CZ_PAIR_PITCH][i];
    }
}

/* Sets the states under a block and reads its deflections. */
static const double *set_receptance(CzReceptanceBlock *under, const double *state) {
    for (int bogie = 0; bogie < 2; ++bogie) {
        _Alignas(64) CzRow now[CZ_N_PAIR_MOTION] = {{0.0}};
        for (int motion = 0; motion < CZ_N_PAIR_MOTION; ++motion) {
            CzRow *y = under->state[bogie][motion];
            double *restrict sum = now[motion];
            state = set_rows(under, 2 * under->n[motion], state, y);
            for (int k = 0; k < under->n[motion]; ++k) {
                const CzPairStepRows *restrict m = &under->mode[motion][k];
                const double *restrict re = y[2 * k], *restrict im = y[2 * k + 1];
                CZ_LANES (i) {
                    sum[i] += m->now_re[i] * re[i] - m->now_im[i] * im[i];
                }
            }
        }
        put_bogie((const CzRow *)now, &under->z[2 * bogie]);
    }
    return state;
}

/* Rates of n modes under a force on each wheel; adds the rate of their deflection. */
static double *rate_pair(const CzReceptanceBlock *under, int bogie, int motion,
                         const double *restrict force, double *rate, double *restrict deflection) {
    for (int k = 0; k < under->n[motion]; ++k) {
        const CzPairStepRows *restrict m = &under->mode[motion][k];
        const double *restrict re = under->state[bogie][motion][2 * k];
        const double *restrict im = under->state[bogie][motion][2 * k + 1];
        _Alignas(64) CzRow rate_re, rate_im;
        CZ_LANES (i) {
            rate_re[i] =
                m->lambda_re[i] * re[i] - m->lambda_im[i] * im[i] + force[i] * m->now_re[i];
            rate_im[i] =
                m->lambda_re[i] * im[i] + m->lambda_im[i] * re[i] + force[i] * m->now_im[i];
            deflection[i] += m->now_re[i] * rate_re[i] - m->now_im[i] * rate_im[i];
        }
        rate = get_row(under, rate_re, rate);
        rate = get_row(under, rate_im, rate);
    }
    return rate;
}

static double *rate_receptance(const CzReceptanceBlock *under, CzBlock *d, double *rate) {
    _Alignas(64) CzRow power = {0.0};
    for (int bogie = 0; bogie < 2; ++bogie) {
        const double *restrict rear = d->published.wheel[2 * bogie].force;
        const double *restrict front = d->published.wheel[2 * bogie + 1].force;
        _Alignas(64) CzRow force[CZ_N_PAIR_MOTION], rising[CZ_N_PAIR_MOTION] = {{0.0}}, wheel[2];
        CZ_LANES (i) {
            force[CZ_PAIR_BOUNCE][i] = -0.5 * (rear[i] + front[i]);
            force[CZ_PAIR_PITCH][i] = -0.5 * (rear[i] - front[i]);
        }
        for (int motion = 0; motion < CZ_N_PAIR_MOTION; ++motion)
            rate = rate_pair(under, bogie, motion, force[motion], rate, rising[motion]);
        put_bogie((const CzRow *)rising, wheel);
        CZ_LANES (i) {
            power[i] += -rear[i] * wheel[0][i];
            power[i] += -front[i] * wheel[1][i];
        }
    }
    double *restrict taken = d->power->track, *restrict given = d->power->wheel_normal;
    CZ_LANES (i) {
        taken[i] += power[i];
        given[i] -= power[i];
    }
    return rate;
}

/* The same for the modal track, car by car. */
static double *rate_modes(CzTrackMotion *track, CzBlock *d, int block, double *rate) {
    for (size_t i = 0; i < CZ_LANE_BLOCK; ++i) {
        const size_t lane = (size_t)block * CZ_LANE_BLOCK + i;
        double force[4], rail_rate[4], power = 0.0;
        if (track->under[lane].state == NULL)
            continue;
        press_rails(d, i, force);
        cz_track_rate(track, lane, force, rate, rail_rate);
        for (int axle = 0; axle < 4; ++axle)
            power += force[axle] * rail_rate[axle];
        d->power->track[i] += power;
        d->power->wheel_normal[i] -= power;
        rate += cz_track_n_state(track->modes);
    }
    return rate;
}

static void set_tracks(CzDynamics *dynamics, const double *state) {
    CzTrackMotion *track = dynamics->track;
    for (int i = 0; dynamics->receptance != NULL && i < dynamics->n_block; ++i)
        state = set_receptance(&dynamics->receptance->block[i], state);
    for (size_t lane = 0; track != NULL && lane < track->n_under; ++lane)
        if (track->under[lane].state != NULL) {
            cz_track_set_state(track, lane, state);
            state += cz_track_n_state(track->modes);
        }
}

static void rate_tracks(CzDynamics *dynamics, double *rate) {
    for (int i = 0; i < dynamics->n_block; ++i) {
        CzBlock *d = &dynamics->block[i];
        if (dynamics->receptance != NULL)
            rate = rate_receptance(&dynamics->receptance->block[i], d, rate);
        if (dynamics->track != NULL)
            rate = rate_modes(dynamics->track, d, i, rate);
    }
}

#endif
