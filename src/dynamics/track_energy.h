/* The energy of the modal track under one car. Inline, as track_motion.h. */
#ifndef CZ_DYNAMICS_TRACK_ENERGY_H
#define CZ_DYNAMICS_TRACK_ENERGY_H

#include <string.h>

#include "dynamics/track_motion.h"

static inline bool cz_track_is_aliased(const CzTrackMotion *track, int v) {
    return v >= track->first_alias;
}

/* Load of one copy of a row of modes: sum of g(x) P over the wheels, at the places of the shapes.
 */
static inline void cz_track_load_row(const CzTrackMotion *track, const CzTrackShape *load, int row,
                                     int copy, double *restrict re, double *restrict im) {
    const CzTrackAmplitudes *restrict of = &track->amplitudes[row];
    const double *restrict direct = load->of[copy], *restrict alias =
                                                        load->of[CZ_ALIAS_COSINE + copy];
    CZ_WAVES(i) {
        re[i] = direct[i] * of->direct_re[i] + alias[i] * of->alias_re[i];
        im[i] = direct[i] * of->direct_im[i] + alias[i] * of->alias_im[i];
    }
}

/* Amplitudes y half a step ago; now, on a track for a step of 0. */
static inline void cz_track_past_row(const CzTrackAmplitudes *restrict of,
                                     const CzTrackState *state, int copy, double *restrict re,
                                     double *restrict im) {
    const double *restrict now = state->now[copy], *restrict past = state->past[copy];
    CZ_WAVES(i) {
        re[i] = of->now_re[i] * now[i] + of->past_re[i] * past[i];
        im[i] = of->now_im[i] * now[i] + of->past_im[i] * past[i];
    }
}

/* Displacement and rate of each part of eight neighbouring blocks at its crest. */
typedef struct CzTrackParts {
    _Alignas(64) CzTrackRow value[CZ_TRACK_PARTS], rate[CZ_TRACK_PARTS];
} CzTrackParts;

/* Adds one copy of a row of modes half a step ago, at the end of the last force: its amplitudes
 * then, and their rates with that force still acting. */
static inline void cz_track_add_parts(const CzTrackMotion *track, const CzTrackUnder *under,
                                      const CzTrackShape *load, int row, int copy,
                                      CzTrackParts *parts) {
    const CzTrackAmplitudes *restrict of = &track->amplitudes[row];
    CzTrackRow y_re, y_im, rate_re, rate_im, load_re, load_im;
    cz_track_load_row(track, load, row, copy, load_re, load_im);
    cz_track_past_row(of, &under->state[row], copy, y_re, y_im);
    CZ_WAVES(i) {
        rate_re[i] = of->lambda_re[i] * y_re[i] - of->lambda_im[i] * y_im[i] + load_re[i];
        rate_im[i] = of->lambda_re[i] * y_im[i] + of->lambda_im[i] * y_re[i] + load_im[i];
    }
    for (int part = 0; part < CZ_TRACK_PARTS; ++part) {
        const double *restrict a_re = of->part_re[part], *restrict a_im = of->part_im[part];
        double *restrict value = parts->value[part], *restrict rate = parts->rate[part];
        CZ_WAVES(i) {
            value[i] += a_re[i] * y_re[i] - a_im[i] * y_im[i];
            rate[i] += a_re[i] * rate_re[i] - a_im[i] * rate_im[i];
        }
    }
}

/* Adds energy and loss of the parts of eight blocks. */
static inline void cz_track_add_energy(const CzTrackWeights *restrict weights,
                                       const CzTrackParts *restrict parts, double *restrict energy,
                                       double *restrict loss) {
    for (int part = 0; part < CZ_TRACK_PARTS; ++part) {
        const double *restrict value = parts->value[part], *restrict rate = parts->rate[part];
        CZ_WAVES(i) {
            energy[i] += weights->value[part][i] * value[i] * value[i] +
                         weights->rate[part][i] * rate[i] * rate[i];
        }
    }
    CZ_WAVES(i) {
        const double upper = parts->value[CZ_SLEEPER][i] - parts->value[CZ_BALLAST][i];
        const double upper_rate = parts->rate[CZ_SLEEPER][i] - parts->rate[CZ_BALLAST][i];
        const double pad = parts->rate[CZ_PAD_STRETCH][i], ballast = parts->rate[CZ_BALLAST][i];
        energy[i] += weights->upper[i] * upper * upper;
        loss[i] += weights->pad_loss[i] * pad * pad +
                   weights->upper_loss[i] * upper_rate * upper_rate +
                   weights->ballast_loss[i] * ballast * ballast;
    }
}

/* Half a step before the time that the state is at, when the last forces had just ended: energy
 * of the track under a car, kinetic and potential above the unloaded track [J], and the power that
 * pads, ballast and subgrade turn into heat [W]. */
static inline void cz_track_energy(const CzTrackMotion *track, const CzTrackUnder *under,
                                   double *energy, double *loss) {
    CzTrackRow energies = {0.0}, losses = {0.0};
    for (int v = 0; v < track->modes->n_vector; ++v) {
        CzTrackShape load = {0};
        cz_track_load(&under->shape[4 * v], under->force, cz_track_is_aliased(track, v), &load);
        for (int copy = 0; copy < 2; ++copy) {
            CzTrackParts parts = {0};
            for (int row = track->span[v].first; row < track->span[v].end; ++row)
                cz_track_add_parts(track, under, &load, row, copy, &parts);
            cz_track_add_energy(&track->weights[v], &parts, energies, losses);
        }
    }
    *energy = cz_track_sum(energies);
    *loss = cz_track_sum(losses);
}

#endif
