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

/* Amplitudes at the crest of the parts of a block, per state of the modes of a group.
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

/* Track under one car. */
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
    CzTrackFlexibility flexibility;      /* under a wheel, in addition to the modes */
    size_t n_under;
    CzTrackUnder *under; /* (n_under) */
} CzTrackMotion;

#define CZ_WAVES(i) _Pragma("omp simd") for (int i = 0; i < CZ_TRACK_WIDTH; ++i)

/* Sum over a row, in pairs. */
static inline double cz_track_sum(const CzTrackRow row) {
    return ((row[0] + row[4]) + (row[2] + row[6])) + ((row[1] + row[5]) + (row[3] + row[7]));
}

/* Binary digits of 0 ... 7, as numbers, so that a whole row is selected in one register. A row
 * stored in narrower pieces would delay its next load. */
static const _Alignas(64) CzTrackRow cz_digit[3] = {
    {0, 1, 0, 1, 0, 1, 0, 1}, {0, 0, 1, 1, 0, 0, 1, 1}, {0, 0, 0, 0, 1, 1, 1, 1}};

/* Cosine and sine of a wheel's turn about the ring, 2 pi x over its length, and of its double,
 * four- and eightfold; of its turn in the bay, 2 pi x over the spacing. */
typedef struct {
    CzComplex ring[4], seat;
} CzTrackTurns;

/* Rail waves at a wheel: cosine and sine of K_k x for k = j and for the alias k = j - n_seat. */
static inline void cz_track_shape(const CzTrackMotion *track, const CzTrackTurns *turns,
                                  CzTrackRow *shape) {
    const CzComplex ring = turns->ring[0], square = turns->ring[1], fourth = turns->ring[2];
    const CzComplex eighth = turns->ring[3], seat = turns->seat;
    CZ_WAVES(i) { /* power i of the ring's turn: the product of those of its binary digits */
        const double c1 = cz_digit[0][i] > 0.0 ? ring.re : 1.0;
        const double s1 = cz_digit[0][i] > 0.0 ? ring.im : 0.0;
        const double c2 = cz_digit[1][i] > 0.0 ? square.re : 1.0;
        const double s2 = cz_digit[1][i] > 0.0 ? square.im : 0.0;
        const double c4 = cz_digit[2][i] > 0.0 ? fourth.re : 1.0;
        const double s4 = cz_digit[2][i] > 0.0 ? fourth.im : 0.0;
        const double c3 = c1 * c2 - s1 * s2, s3 = c1 * s2 + s1 * c2;
        shape[0][i] = c3 * c4 - s3 * s4;
        shape[1][i] = c3 * s4 + s3 * c4;
    }
    for (int v = 1; v < track->modes->n_vector; ++v) {
        const double *restrict c = shape[4 * v - 4], *restrict s = shape[4 * v - 3];
        double *restrict cosine = shape[4 * v], *restrict sine = shape[4 * v + 1];
        CZ_WAVES(i) {
            cosine[i] = c[i] * eighth.re - s[i] * eighth.im;
            sine[i] = c[i] * eighth.im + s[i] * eighth.re;
        }
    }
    for (int v = track->modes->first_alias; v < track->modes->n_vector; ++v) {
        const double *restrict cosine = shape[4 * v], *restrict sine = shape[4 * v + 1];
        double *restrict alias_cosine = shape[4 * v + 2], *restrict alias_sine = shape[4 * v + 3];
        CZ_WAVES(i) {
            alias_cosine[i] = cosine[i] * seat.re + sine[i] * seat.im;
            alias_sine[i] = sine[i] * seat.re - cosine[i] * seat.im;
        }
    }
}

/* Rail waves at the four wheels of a car, and their turns in the bay. The turns about ring and bay
 * are computed together: four of each fill a row. */
static inline void cz_track_shapes(const CzTrackMotion *track, const double place[4],
                                   CzTrackRow *shape, CzComplex seat[4]) {
    CzTrackRow turns, re[4], im[4];
    for (int wheel = 0; wheel < 4; ++wheel) {
        turns[wheel] = place[wheel] * track->per_length;
        turns[4 + wheel] = place[wheel] * track->per_spacing;
    }
    CZ_WAVES(i) {
        const CzComplex turned = cz_turned(turns[i]);
        re[0][i] = turned.re;
        im[0][i] = turned.im;
    }
    for (int k = 1; k < 4; ++k)
        CZ_WAVES(i) {
            const CzComplex half = {re[k - 1][i], im[k - 1][i]};
            const CzComplex twice = cz_complex_product(half, half);
            re[k][i] = twice.re;
            im[k][i] = twice.im;
        }
    for (int wheel = 0; wheel < 4; ++wheel) {
        CzTrackTurns of = {.seat = {re[0][4 + wheel], im[0][4 + wheel]}};
        for (int k = 0; k < 4; ++k)
            of.ring[k] = (CzComplex){re[k][wheel], im[k][wheel]};
        cz_track_shape(track, &of, shape + 4 * wheel * track->modes->n_vector);
        seat[wheel] = of.seat;
    }
}

/* Load of the modes of one row of blocks on direct and alias waves, and their displacement now and
 * half a step ago. */
typedef struct {
    CzTrackRow load, alias_load;
    CzTrackRow direct, alias, direct_past, alias_past;
} CzTrackWaves;

/* Adds the displacement of one group of modes. */
static inline void cz_track_add_displacement(const CzTrackRows *rows, const double *restrict re,
                                             const double *restrict im, bool aliased,
                                             CzTrackWaves *waves) {
    CZ_WAVES(i) {
        waves->direct[i] += rows->now_re[i] * re[i] - rows->now_im[i] * im[i];
        waves->direct_past[i] += rows->past_re[i] * re[i] - rows->past_im[i] * im[i];
        if (aliased) {
            waves->alias[i] += rows->alias_now_re[i] * re[i] - rows->alias_now_im[i] * im[i];
            waves->alias_past[i] += rows->alias_past_re[i] * re[i] - rows->alias_past_im[i] * im[i];
        }
    }
}

/* Advances a group of modes by one step. */
static inline void cz_track_flight(const CzTrackRows *rows, const CzTrackWaves *waves, bool aliased,
                                   double *restrict re, double *restrict im) {
    CZ_WAVES(i) {
        double kicked_re = re[i] + rows->kick_re[i] * waves->load[i];
        double kicked_im = im[i] + rows->kick_im[i] * waves->load[i];
        if (aliased) {
            kicked_re += rows->alias_kick_re[i] * waves->alias_load[i];
            kicked_im += rows->alias_kick_im[i] * waves->alias_load[i];
        }
        re[i] = rows->flight_re[i] * kicked_re - rows->flight_im[i] * kicked_im;
        im[i] = rows->flight_re[i] * kicked_im + rows->flight_im[i] * kicked_re;
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
            if (aliased)
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

/* Adds the work of the load on a row of waves, which was constant for a step about its time: from
 * the deflection of the waves half a step before, stored there, to that half a step after. */
static inline void cz_track_add_work(const CzTrackMotion *track, const CzTrackUnder *under,
                                     int copy, int v, bool aliased, const CzTrackWaves *waves,
                                     double *restrict work) {
    const CzTrackRow *kept = under->wave + 4 * (copy * track->modes->n_vector + v);
    const double *restrict direct = kept[1], *restrict alias = kept[3];
    CZ_WAVES(i) {
        work[i] += waves->load[i] * (waves->direct_past[i] - direct[i]);
    }
    if (aliased)
        CZ_WAVES(i) {
            work[i] += waves->alias_load[i] * (waves->alias_past[i] - alias[i]);
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
                cz_track_add_displacement(&track->rows[k], under->state[2 * k],
                                          under->state[2 * k + 1], v >= track->modes->first_alias,
                                          &waves);
            cz_track_keep_waves(track, under, copy, v, &waves);
        }
}

/* Advances one row of waves by one step. */
__attribute__((always_inline)) static inline void
cz_track_step_row(const CzTrackMotion *track, CzTrackUnder *under, int copy, int v, bool aliased,
                  const double force[4], double *restrict work) {
    const CzTrackSpan span = track->span[copy * track->modes->n_vector + v];
    CzTrackWaves waves;
    cz_track_no_waves(&waves);
    cz_track_load(track, under, copy, v, force, aliased, &waves);
    for (int k = span.first; k < span.end; ++k) {
        double *restrict re = under->state[2 * k], *restrict im = under->state[2 * k + 1];
        cz_track_flight(&track->rows[k], &waves, aliased, re, im);
        cz_track_add_displacement(&track->rows[k], re, im, aliased, &waves);
    }
    cz_track_add_work(track, under, copy, v, aliased, &waves, work);
    cz_track_keep_waves(track, under, copy, v, &waves);
}

/* Advances by one step under the forces of the wheels on the rail, upwards [N], at the places of
 * the shapes. Returns their work [J]. */
static inline double cz_track_step(const CzTrackMotion *track, CzTrackUnder *under,
                                   const double force[4]) {
    CzTrackRow work = {0.0};
    for (int copy = 0; copy < 2; ++copy) {
        for (int v = 0; v < track->modes->first_alias; ++v)
            cz_track_step_row(track, under, copy, v, false, force, work);
        for (int v = track->modes->first_alias; v < track->modes->n_vector; ++v)
            cz_track_step_row(track, under, copy, v, true, force, work);
    }
    return cz_track_sum(work);
}

/* The modes at the place of a wheel: displacement upwards and slope now. */
static inline CzRailPoint cz_track_at(const CzTrackMotion *track, const CzTrackUnder *under,
                                      int wheel) {
    CzTrackRow z = {0.0}, slope = {0.0};
    const int n = track->modes->n_vector;
    for (int v = 0; v < n; ++v) {
        const CzTrackRow *shape = under->shape + 4 * (wheel * n + v);
        const CzTrackRow *by_cosine = under->wave + 4 * v, *by_sine = under->wave + 4 * (n + v);
        const double *restrict c = shape[0], *restrict s = shape[1];
        const double *restrict k = track->wavenumber[2 * v];
        CZ_WAVES(i) {
            z[i] += by_cosine[0][i] * c[i] + by_sine[0][i] * s[i];
            slope[i] += k[i] * (by_sine[0][i] * c[i] - by_cosine[0][i] * s[i]);
        }
        if (v < track->modes->first_alias)
            continue;
        const double *restrict ac = shape[2], *restrict as = shape[3];
        const double *restrict ak = track->wavenumber[2 * v + 1];
        CZ_WAVES(i) {
            z[i] += by_cosine[2][i] * ac[i] + by_sine[2][i] * as[i];
            slope[i] += ak[i] * (by_sine[2][i] * ac[i] - by_cosine[2][i] * as[i]);
        }
    }
    return (CzRailPoint){.z = cz_track_sum(z), .slope = cz_track_sum(slope)};
}

/* Adds the flexibility between a wheel and the modes, whose terms are `stride` numbers apart. */
static inline CzRailPoint cz_track_on_spring(double corner, const double *term, size_t stride,
                                             double per_spacing, CzRailPoint point,
                                             CzComplex seat) {
    double slope = 0.0, power = 1.0;
    for (int k = 1; k < CZ_TRACK_FLEX_TERMS; ++k) {
        slope += k * power * term[(size_t)k * stride];
        power *= seat.re;
    }
    /* d|sin(pi xi)| / d cos(2 pi xi) = -1 / (4 |sin(pi xi)|) */
    const double sine = sqrt(0.5 * fabs(1.0 - seat.re));
    slope -= 0.25 * corner / (sine + 1e-9);
    point.flexibility = cz_track_flexibility_of(corner, term, stride, seat.re);
    point.flexibility_slope = -2.0 * CZ_PI * per_spacing * seat.im * slope;
    return point;
}

#endif
