/* The motion of the modal track under one car: forces to modes, one step of the modes, modes to
 * rail waves, rail waves to wheels. Inline, so that the kernel of each instruction set has its own
 * copy; every loop is over eight neighbouring waves, and sums are taken over the eight in a fixed
 * order, so that all copies give the same bits.
 *
 * A step is   y <- E (y + g h P)    E = exp(lambda h)
 *
 * with the forces P of the wheels as kicks: together with the two-step scheme of the vehicles,
 * which is a kick and a free flight too, it gains and loses no energy. The modes are read before
 * the kick.
 */
#ifndef CZ_DYNAMICS_TRACK_MOTION_H
#define CZ_DYNAMICS_TRACK_MOTION_H

#include <stdbool.h>
#include <stddef.h>

#include "dynamics/rail_point.h"
#include "model/track.h"
#include "model/track_block.h"

typedef double CzTrackRow[CZ_TRACK_WIDTH];

/* Numbers of a group of modes for one step size. */
typedef struct CzTrackRows {
    _Alignas(64) CzTrackRow flight_re, flight_im; /* exp(lambda h) */
    CzTrackRow kick_re, kick_im;                  /* state per force on the direct wave */
    CzTrackRow alias_kick_re, alias_kick_im;      /* on the alias wave */
    CzTrackRow now_re, now_im;                    /* displacement of the direct wave per state */
    CzTrackRow alias_now_re, alias_now_im;        /* of the alias wave */
    CzTrackRow past_re, past_im; /* the same half a step ago, without forces since */
    CzTrackRow alias_past_re, alias_past_im;
} CzTrackRows;

/* Parts of a block: a pad, sleeper, ballast block, and the rail's waves. */
enum { CZ_PAD_FORCE, CZ_PAD_STRETCH, CZ_SLEEPER, CZ_BALLAST, CZ_RAIL_WAVE };
enum { CZ_TRACK_PARTS = CZ_RAIL_WAVE + CZ_BLOCK_WAVES };

/* What the modes of a group are for the parts of their blocks, per state: amplitudes at the crest.
 */
typedef struct CzTrackAmplitudes {
    _Alignas(64) CzTrackRow lambda_re, lambda_im;
    CzTrackRow back_re, back_im; /* exp(-lambda h / 2): from the state to half a step ago */
    CzTrackRow part_re[CZ_TRACK_PARTS], part_im[CZ_TRACK_PARTS];
} CzTrackAmplitudes;

/* Groups of one copy and vector: first ... end - 1. */
typedef struct CzTrackSpan {
    int first, end;
} CzTrackSpan;

/* Under one car. */
typedef struct CzTrackUnder {
    CzTrackRow *state; /* real and imaginary parts in turn (2 n_group); NULL without wheels */
    CzTrackRow
        *wave; /* of the state: direct now and half a step ago, alias likewise (2 n_vector x 4) */
    CzTrackRow *shape; /* of the last look: cosine, sine, alias's (4 wheels x n_vector x 4) */
    double force[4];   /* of the last step, upwards on the rail [N] */
} CzTrackUnder;

typedef struct CzTrackMotion {
    const CzTrackModes *modes;      /* borrowed */
    double step;                    /* h [s] */
    double per_length, per_spacing; /* 1 / length of the ring, 1 / spacing [1/m] */
    const CzTrackRows *rows;        /* (n_group) */
    const CzTrackSpan *span;        /* (2 n_vector) */
    const CzTrackRow *wavenumber;   /* direct, alias [1/m] (2 n_vector) */
    const CzTrackBlock *block;      /* for the energy, as are the amplitudes (n_seat / 2 + 1) */
    const CzTrackAmplitudes *amplitudes; /* (n_group) */
    CzTrackFlexibility flexibility;      /* under a wheel, beside the modes */
    size_t n_under;
    CzTrackUnder *under; /* (n_under) */
} CzTrackMotion;

#define CZ_WAVES(i) _Pragma("omp simd") for (int i = 0; i < CZ_TRACK_WIDTH; ++i)

/* Sum over a row, in pairs. */
static inline double cz_track_sum(const CzTrackRow row) {
    return ((row[0] + row[4]) + (row[2] + row[6])) + ((row[1] + row[5]) + (row[3] + row[7]));
}

/* Rail waves at a wheel: cosine and sine of K_k x for k = j and for the alias k = j - n_seat.
 * `ring` and `seat` are cosine and sine of 2 pi x over the ring's length and over the spacing. */
static inline void cz_track_shape(const CzTrackMotion *track, CzComplex ring, CzComplex seat,
                                  CzTrackRow *shape) {
    const CzComplex square = cz_complex_product(ring, ring);
    const CzComplex fourth = cz_complex_product(square, square);
    const CzComplex eighth = cz_complex_product(fourth, fourth);
    for (int v = 0; v < track->modes->n_vector; ++v) {
        double *restrict cosine = shape[4 * v], *restrict sine = shape[4 * v + 1];
        if (v == 0) {
            /* Power i of the ring's turn is the product of those of its binary digits. */
            CZ_WAVES(i) {
                const double c1 = i & 1 ? ring.re : 1.0, s1 = i & 1 ? ring.im : 0.0;
                const double c2 = i & 2 ? square.re : 1.0, s2 = i & 2 ? square.im : 0.0;
                const double c4 = i & 4 ? fourth.re : 1.0, s4 = i & 4 ? fourth.im : 0.0;
                const double c3 = c1 * c2 - s1 * s2, s3 = c1 * s2 + s1 * c2;
                cosine[i] = c3 * c4 - s3 * s4;
                sine[i] = c3 * s4 + s3 * c4;
            }
        } else {
            const double *restrict c = shape[4 * v - 4], *restrict s = shape[4 * v - 3];
            CZ_WAVES(i) {
                cosine[i] = c[i] * eighth.re - s[i] * eighth.im;
                sine[i] = c[i] * eighth.im + s[i] * eighth.re;
            }
        }
        if (v < track->modes->first_alias)
            continue;
        double *restrict alias_cosine = shape[4 * v + 2], *restrict alias_sine = shape[4 * v + 3];
        CZ_WAVES(i) {
            alias_cosine[i] = cosine[i] * seat.re + sine[i] * seat.im;
            alias_sine[i] = sine[i] * seat.re - cosine[i] * seat.im;
        }
    }
}

/* What the modes of one row of blocks get and give: load on direct and alias waves, and their
 * displacement now and half a step ago. */
typedef struct {
    CzTrackRow load, alias_load;
    CzTrackRow direct, alias, direct_past, alias_past;
} CzTrackWaves;

/* Adds what one group of modes gives. */
static inline void cz_track_give(const CzTrackRows *rows, const double *restrict re,
                                 const double *restrict im, bool aliased, CzTrackWaves *waves) {
    CZ_WAVES(i) {
        waves->direct[i] += rows->now_re[i] * re[i] - rows->now_im[i] * im[i];
        waves->direct_past[i] += rows->past_re[i] * re[i] - rows->past_im[i] * im[i];
    }
    if (aliased)
        CZ_WAVES(i) {
            waves->alias[i] += rows->alias_now_re[i] * re[i] - rows->alias_now_im[i] * im[i];
            waves->alias_past[i] += rows->alias_past_re[i] * re[i] - rows->alias_past_im[i] * im[i];
        }
}

/* One step of a group of modes. */
static inline void cz_track_flight(const CzTrackRows *rows, const CzTrackWaves *waves, bool aliased,
                                   double *restrict re, double *restrict im) {
    CzTrackRow kicked_re, kicked_im;
    CZ_WAVES(i) {
        kicked_re[i] = re[i] + rows->kick_re[i] * waves->load[i];
        kicked_im[i] = im[i] + rows->kick_im[i] * waves->load[i];
    }
    if (aliased)
        CZ_WAVES(i) {
            kicked_re[i] += rows->alias_kick_re[i] * waves->alias_load[i];
            kicked_im[i] += rows->alias_kick_im[i] * waves->alias_load[i];
        }
    CZ_WAVES(i) {
        re[i] = rows->flight_re[i] * kicked_re[i] - rows->flight_im[i] * kicked_im[i];
        im[i] = rows->flight_re[i] * kicked_im[i] + rows->flight_im[i] * kicked_re[i];
    }
}

/* Load of the wheels on one row of waves: copy 0 by the cosines, 1 by the sines. */
static inline void cz_track_load(const CzTrackMotion *track, const CzTrackUnder *under, int copy,
                                 int v, const double force[4], bool aliased, CzTrackWaves *waves) {
    CZ_WAVES(i) {
        waves->load[i] = 0.0;
        waves->alias_load[i] = 0.0;
    }
    for (int wheel = 0; wheel < 4; ++wheel) {
        const CzTrackRow *shape = under->shape + 4 * (wheel * track->modes->n_vector + v);
        const double *restrict direct = shape[copy], *restrict alias = shape[2 + copy];
        const double p = force[wheel];
        CZ_WAVES(i) {
            waves->load[i] += p * direct[i];
        }
        if (aliased)
            CZ_WAVES(i) {
                waves->alias_load[i] += p * alias[i];
            }
    }
}

static inline void cz_track_no_waves(CzTrackWaves *waves) {
    CZ_WAVES(i) {
        waves->direct[i] = waves->direct_past[i] = 0.0;
        waves->alias[i] = waves->alias_past[i] = 0.0;
    }
}

static inline void cz_track_keep_waves(const CzTrackMotion *track, CzTrackUnder *under, int copy,
                                       int v, const CzTrackWaves *waves) {
    CzTrackRow *kept = under->wave + 4 * (copy * track->modes->n_vector + v);
    CZ_WAVES(i) {
        kept[0][i] = waves->direct[i];
        kept[1][i] = waves->direct_past[i];
        kept[2][i] = waves->alias[i];
        kept[3][i] = waves->alias_past[i];
    }
}

/* The rail waves of the present state. */
static inline void cz_track_read(const CzTrackMotion *track, CzTrackUnder *under) {
    for (int copy = 0; copy < 2; ++copy)
        for (int v = 0; v < track->modes->n_vector; ++v) {
            const CzTrackSpan span = track->span[copy * track->modes->n_vector + v];
            CzTrackWaves waves;
            cz_track_no_waves(&waves);
            for (int k = span.first; k < span.end; ++k)
                cz_track_give(&track->rows[k], under->state[2 * k], under->state[2 * k + 1],
                              v >= track->modes->first_alias, &waves);
            cz_track_keep_waves(track, under, copy, v, &waves);
        }
}

/* One step under the forces of the wheels on the rail, upwards [N], where the shapes were taken. */
static inline void cz_track_step(const CzTrackMotion *track, CzTrackUnder *under,
                                 const double force[4]) {
    for (int copy = 0; copy < 2; ++copy)
        for (int v = 0; v < track->modes->n_vector; ++v) {
            const CzTrackSpan span = track->span[copy * track->modes->n_vector + v];
            const bool aliased = v >= track->modes->first_alias;
            CzTrackWaves waves;
            cz_track_no_waves(&waves);
            cz_track_load(track, under, copy, v, force, aliased, &waves);
            for (int k = span.first; k < span.end; ++k) {
                double *restrict re = under->state[2 * k], *restrict im = under->state[2 * k + 1];
                cz_track_flight(&track->rows[k], &waves, aliased, re, im);
                cz_track_give(&track->rows[k], re, im, aliased, &waves);
            }
            cz_track_keep_waves(track, under, copy, v, &waves);
        }
}

/* The modes at the place of a wheel: displacement upwards now and half a step ago, slope now. */
static inline CzRailPoint cz_track_at(const CzTrackMotion *track, const CzTrackUnder *under,
                                      int wheel) {
    CzTrackRow z = {0.0}, past = {0.0}, slope = {0.0};
    const int n = track->modes->n_vector;
    for (int v = 0; v < n; ++v) {
        const CzTrackRow *shape = under->shape + 4 * (wheel * n + v);
        const CzTrackRow *by_cosine = under->wave + 4 * v, *by_sine = under->wave + 4 * (n + v);
        const double *restrict c = shape[0], *restrict s = shape[1];
        const double *restrict k = track->wavenumber[2 * v];
        CZ_WAVES(i) {
            z[i] += by_cosine[0][i] * c[i] + by_sine[0][i] * s[i];
            past[i] += by_cosine[1][i] * c[i] + by_sine[1][i] * s[i];
            slope[i] += k[i] * (by_sine[0][i] * c[i] - by_cosine[0][i] * s[i]);
        }
        if (v < track->modes->first_alias)
            continue;
        const double *restrict ac = shape[2], *restrict as = shape[3];
        const double *restrict ak = track->wavenumber[2 * v + 1];
        CZ_WAVES(i) {
            z[i] += by_cosine[2][i] * ac[i] + by_sine[2][i] * as[i];
            past[i] += by_cosine[3][i] * ac[i] + by_sine[3][i] * as[i];
            slope[i] += ak[i] * (by_sine[2][i] * ac[i] - by_cosine[2][i] * as[i]);
        }
    }
    return (CzRailPoint){
        .z = cz_track_sum(z), .past = cz_track_sum(past), .slope = cz_track_sum(slope)};
}

/* Adds what lies between a wheel and the modes. */
static inline CzRailPoint cz_track_on_spring(const CzTrackFlexibility *flexibility,
                                             double per_spacing, CzRailPoint point,
                                             CzComplex seat) {
    const double *term = flexibility->term;
    double slope = 0.0, power = 1.0;
    for (int k = 1; k < CZ_TRACK_FLEX_TERMS; ++k) {
        slope += k * power * term[k];
        power *= seat.re;
    }
    /* d|sin(pi xi)| / d cos(2 pi xi) = -1 / (4 |sin(pi xi)|) */
    const double sine = sqrt(0.5 * fabs(1.0 - seat.re));
    slope -= 0.25 * flexibility->corner / (sine + 1e-9);
    point.flexibility = cz_track_flexibility_at(flexibility, seat.re);
    point.flexibility_slope = -2.0 * CZ_PI * per_spacing * seat.im * slope;
    return point;
}

#endif
