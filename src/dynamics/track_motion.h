/* The motion of the modal track under one car: forces to modes, one step of the modes, modes to
 * rail waves, rail waves to wheels. Inline, so that the kernel of each instruction set has its own
 * copy; every loop is over eight neighbouring waves, and sums are taken over the eight in a fixed
 * order, so that all copies give the same bits.
 *
 * A mode has the deflection Re Y of its rail wave, and in free motion Y turns by E = exp(lambda h)
 * in a step. Its deflections z at half steps follow each other as
 *
 *   z(t + h/2) = 2 Re(E^(1/2)) z(t) - |E| z(t - h/2)
 *
 * so that two of them, now and half a step before, are the state of the mode; their sums over the
 * modes are the deflections of the rail at both times. The forces P of the wheels act as kicks of Y
 * at the time of the state: together with the two-step scheme of the vehicles, which is a kick and
 * a free flight too, a step gains and loses no energy. The modes are read before the kick.
 *
 * Cosine and sine copy of a wave have the same modes, so that they share their numbers. Two edges
 * differ: wave 0 has no sine, and the sine of wave n_seat / 2, with its nodes at the seats, is free
 * from them. That sine has the place of its alias, which is the same wave.
 */
#ifndef CZ_DYNAMICS_TRACK_MOTION_H
#define CZ_DYNAMICS_TRACK_MOTION_H

#include <stdbool.h>
#include <stddef.h>

#include "dynamics/rail_point.h"
#include "model/track.h"
#include "model/track_block.h"

typedef double CzTrackRow[CZ_TRACK_WIDTH];

/* Numbers of a row of modes, of eight neighbouring waves, for one step size. */
typedef struct CzTrackRows {
    _Alignas(64) CzTrackRow twice, square; /* 2 Re(E^(1/2)) and |E| */
    CzTrackRow kick, past_kick;            /* change of the state per force on the direct wave */
    CzTrackRow alias_kick, alias_past_kick;
    CzTrackRow alias, alias_past; /* deflection of the alias wave per state */
} CzTrackRows;

/* Parts of a block: a pad, sleeper, ballast block, and the rail's waves. */
enum { CZ_PAD_FORCE, CZ_PAD_STRETCH, CZ_SLEEPER, CZ_BALLAST, CZ_RAIL_WAVE };
enum { CZ_TRACK_PARTS = CZ_RAIL_WAVE + CZ_BLOCK_WAVES };

/* A row of modes in continuous time, by its complex amplitudes y: Y = g y for the direct wave. */
typedef struct CzTrackAmplitudes {
    _Alignas(64) CzTrackRow lambda_re, lambda_im;
    CzTrackRow direct_re, direct_im, alias_re, alias_im;         /* g of the waves */
    CzTrackRow rest_re, rest_im;                                 /* y per constant load */
    CzTrackRow to_now_re, to_now_im, to_past_re, to_past_im;     /* state per y: real part */
    CzTrackRow now_re, now_im, past_re, past_im;                 /* y half a step ago per state */
    CzTrackRow part_re[CZ_TRACK_PARTS], part_im[CZ_TRACK_PARTS]; /* parts at the crest per y */
} CzTrackAmplitudes;

/* Energy and loss of the parts of eight neighbouring blocks per square of what moves. */
typedef struct CzTrackWeights {
    _Alignas(64) CzTrackRow value[CZ_TRACK_PARTS], rate[CZ_TRACK_PARTS]; /* energy */
    CzTrackRow upper; /* between sleeper and ballast block */
    CzTrackRow pad_loss, upper_loss, ballast_loss;
} CzTrackWeights;

/* Rows of modes of one vector of waves: first ... end - 1. */
typedef struct CzTrackSpan {
    int first, end;
} CzTrackSpan;

/* Shapes of a vector of waves, or what belongs to them. Alias rows are 0 where none has an alias.
 */
enum { CZ_COSINE, CZ_SINE, CZ_ALIAS_COSINE, CZ_ALIAS_SINE, CZ_N_SHAPE };
typedef struct CzTrackShape {
    _Alignas(64) CzTrackRow of[CZ_N_SHAPE];
} CzTrackShape;

/* State of a row of modes, of its cosine and its sine copy: deflection of the direct wave now and
 * half a step ago, without forces since [m]. On a track for a step of 0, real and imaginary part
 * of y. */
typedef struct CzTrackState {
    _Alignas(64) CzTrackRow now[2], past[2];
} CzTrackState;

/* Amplitudes of a vector of waves, now and half a step ago [m]. */
typedef struct CzTrackWave {
    CzTrackShape now, past;
} CzTrackWave;

/* Track under one car. */
typedef struct CzTrackUnder {
    CzTrackState *state; /* (n_row); NULL without wheels */
    CzTrackWave *wave;   /* of the state (n_vector) */
    CzTrackShape *shape; /* of the last look (n_vector x 4 wheels) */
    double force[4];     /* of the last step, upwards on the rail [N] */
} CzTrackUnder;

typedef struct CzTrackMotion {
    const CzTrackModes *modes;      /* borrowed */
    double step;                    /* h [s] */
    double per_length, per_spacing; /* 1 / length of the ring, 1 / spacing [1/m] */
    int n_row;
    const CzTrackRows *rows;             /* (n_row) */
    const CzTrackAmplitudes *amplitudes; /* (n_row) */
    const CzTrackSpan *span;             /* (n_vector) */
    int first_alias;                     /* first vector with aliases or the free sine */
    const CzTrackRow *inner;             /* 0 for wave n_seat / 2, else 1 (n_vector) */
    const CzTrackRow *wavenumber;        /* direct, alias [1/m] (2 n_vector) */
    const CzTrackWeights *weights;       /* for the energy (n_vector) */
    CzTrackFlexibility flexibility;      /* under a wheel, in addition to the modes */
    size_t n_under;
    CzTrackUnder *under; /* (n_under) */
} CzTrackMotion;

#define CZ_WAVES(i) _Pragma("omp simd") for (int i = 0; i < CZ_TRACK_WIDTH; ++i)

/* Sum over a row, by halves. */
static inline double cz_track_sum(const CzTrackRow row) {
    double four[4], two[2];
    _Pragma("omp simd") for (int i = 0; i < 4; ++i) four[i] = row[i] + row[i + 4];
    _Pragma("omp simd") for (int i = 0; i < 2; ++i) two[i] = four[i] + four[i + 2];
    return two[0] + two[1];
}

/* Binary digits of 0 ... 7, as numbers, so that a whole row is selected in one register. A row
 * stored in narrower pieces would delay its next load. */
static const _Alignas(64) CzTrackRow cz_digit[3] = {
    {0, 1, 0, 1, 0, 1, 0, 1}, {0, 0, 1, 1, 0, 0, 1, 1}, {0, 0, 0, 0, 1, 1, 1, 1}};

/* ---- shapes of the waves at the wheels ---- */

/* Turns of the four wheels of eight cars about the ring, 2 pi x over its length, with the double,
 * four- and eightfold turns, and in the bay, 2 pi x over the spacing: cosines and sines. Eight cars
 * are turned together, because one takes as long. */
typedef struct {
    _Alignas(64) CzTrackRow ring_re[4][4], ring_im[4][4]; /* by wheel and power of two */
    CzTrackRow seat_re[4], seat_im[4];                    /* by wheel */
} CzTrackTurns;

static inline void cz_track_turn(const CzTrackMotion *track, const CzTrackRow place[4],
                                 CzTrackTurns *turns) {
    for (int wheel = 0; wheel < 4; ++wheel) {
        CzTrackRow *re = turns->ring_re[wheel], *im = turns->ring_im[wheel];
        CZ_WAVES(car) {
            const CzComplex once = cz_turned(place[wheel][car] * track->per_length);
            const CzComplex seat = cz_turned(place[wheel][car] * track->per_spacing);
            const CzComplex twice = cz_complex_product(once, once);
            const CzComplex four = cz_complex_product(twice, twice);
            const CzComplex eight = cz_complex_product(four, four);
            re[0][car] = once.re;
            im[0][car] = once.im;
            re[1][car] = twice.re;
            im[1][car] = twice.im;
            re[2][car] = four.re;
            im[2][car] = four.im;
            re[3][car] = eight.re;
            im[3][car] = eight.im;
            turns->seat_re[wheel][car] = seat.re;
            turns->seat_im[wheel][car] = seat.im;
        }
    }
}

/* Turn of a wheel of one car. */
static inline CzComplex cz_track_turn_of(const CzTrackTurns *turns, int car, int wheel, int power) {
    return (CzComplex){turns->ring_re[wheel][power][car], turns->ring_im[wheel][power][car]};
}

/* Cosine and sine of K_k x at a wheel for the first eight waves k. */
static inline void cz_track_first_waves(const CzTrackTurns *turns, int car, int wheel,
                                        double *restrict cosine, double *restrict sine) {
    const CzComplex ring = cz_track_turn_of(turns, car, wheel, 0);
    const CzComplex square = cz_track_turn_of(turns, car, wheel, 1);
    const CzComplex fourth = cz_track_turn_of(turns, car, wheel, 2);
    CZ_WAVES(i) { /* power i of the ring's turn: the product of those of its binary digits */
        const double c1 = cz_digit[0][i] > 0.0 ? ring.re : 1.0;
        const double s1 = cz_digit[0][i] > 0.0 ? ring.im : 0.0;
        const double c2 = cz_digit[1][i] > 0.0 ? square.re : 1.0;
        const double s2 = cz_digit[1][i] > 0.0 ? square.im : 0.0;
        const double c4 = cz_digit[2][i] > 0.0 ? fourth.re : 1.0;
        const double s4 = cz_digit[2][i] > 0.0 ? fourth.im : 0.0;
        const double c3 = c1 * c2 - s1 * s2, s3 = c1 * s2 + s1 * c2;
        cosine[i] = c3 * c4 - s3 * s4;
        sine[i] = c3 * s4 + s3 * c4;
    }
}

/* ---- from the waves to the wheels ---- */

/* Deflection of the modes under a wheel and its change along the track. */
typedef struct {
    double z, slope;
} CzTrackDeflection;

/* A wheel in a look over the waves. */
typedef struct {
    _Alignas(64) CzTrackRow cosine, sine; /* of eight waves */
    CzTrackRow z, slope;                  /* sums */
    CzComplex eighth, seat;               /* turns */
} CzTrackWheel;

static inline void cz_track_start_wheel(const CzTrackTurns *turns, int car, int wheel,
                                        CzTrackWheel *at) {
    CZ_WAVES(i) {
        at->z[i] = at->slope[i] = 0.0;
    }
    at->eighth = cz_track_turn_of(turns, car, wheel, 3);
    at->seat = (CzComplex){turns->seat_re[wheel][car], turns->seat_im[wheel][car]};
    cz_track_first_waves(turns, car, wheel, at->cosine, at->sine);
}

/* To the next eight waves. */
__attribute__((always_inline)) static inline void cz_track_next_waves(CzTrackWheel *at) {
    CZ_WAVES(i) {
        const double c = at->cosine[i], s = at->sine[i];
        at->cosine[i] = c * at->eighth.re - s * at->eighth.im;
        at->sine[i] = c * at->eighth.im + s * at->eighth.re;
    }
}

/* Shapes of the waves k of a vector and of their aliases k - n_seat at a wheel; adds their
 * deflections. */
__attribute__((always_inline)) static inline void
cz_track_add_vector(const CzTrackMotion *track, int v, bool aliased,
                    const CzTrackShape *restrict wave, CzTrackShape *restrict shape,
                    CzTrackWheel *at) {
    const double *restrict own = track->wavenumber[2 * v];
    const double *restrict of_alias = track->wavenumber[2 * v + 1], *restrict inner =
                                                                        track->inner[v];
    CZ_WAVES(i) {
        const double cosine = at->cosine[i], sine = at->sine[i];
        const double by_cosine = wave->of[CZ_COSINE][i], by_sine = wave->of[CZ_SINE][i];
        double z = by_cosine * cosine + by_sine * sine;
        double slope = own[i] * (by_sine * cosine - by_cosine * sine);
        shape->of[CZ_COSINE][i] = cosine;
        shape->of[CZ_SINE][i] = aliased ? inner[i] * sine : sine;
        if (aliased) {
            const double c = cosine * at->seat.re + sine * at->seat.im;
            const double s = sine * at->seat.re - cosine * at->seat.im;
            const double by_c = wave->of[CZ_ALIAS_COSINE][i], by_s = wave->of[CZ_ALIAS_SINE][i];
            z += by_c * c + by_s * s;
            slope += of_alias[i] * (by_s * c - by_c * s);
            shape->of[CZ_ALIAS_COSINE][i] = inner[i] * c;
            shape->of[CZ_ALIAS_SINE][i] = s;
        }
        at->z[i] += z;
        at->slope[i] += slope;
    }
}

/* Moves a wheel of one of eight cars to a new place and reads the modes there. */
static inline CzTrackDeflection cz_track_move_wheel(const CzTrackMotion *track,
                                                    const CzTrackUnder *under,
                                                    const CzTrackTurns *turns, int car, int wheel) {
    const int n_vector = track->modes->n_vector, first_alias = track->first_alias;
    CzTrackWheel at;
    cz_track_start_wheel(turns, car, wheel, &at);
    int v = 0;
    if (first_alias > 0)
        do {
            cz_track_add_vector(track, v, false, &under->wave[v].now, &under->shape[4 * v + wheel],
                                &at);
            cz_track_next_waves(&at);
        } while (++v < first_alias);
    for (;;) {
        cz_track_add_vector(track, v, true, &under->wave[v].now, &under->shape[4 * v + wheel], &at);
        if (++v == n_vector)
            break;
        cz_track_next_waves(&at);
    }
    return (CzTrackDeflection){.z = cz_track_sum(at.z), .slope = cz_track_sum(at.slope)};
}

/* ---- a step ---- */

/* Load of the wheels on a vector of waves. */
__attribute__((always_inline)) static inline void cz_track_load(const CzTrackShape shape[4],
                                                                const double force[4], bool aliased,
                                                                CzTrackShape *load) {
    for (int k = 0; k < (aliased ? CZ_N_SHAPE : CZ_ALIAS_COSINE); ++k) {
        const double *restrict a = shape[0].of[k], *restrict b = shape[1].of[k];
        const double *restrict c = shape[2].of[k], *restrict d = shape[3].of[k];
        CZ_WAVES(i) {
            load->of[k][i] =
                (force[0] * a[i] + force[1] * b[i]) + (force[2] * c[i] + force[3] * d[i]);
        }
    }
}

/* Advances one copy of a row of modes by one step and adds its deflections. */
__attribute__((always_inline)) static inline void
cz_track_advance(const CzTrackRows *restrict rows, int copy, bool aliased, const CzTrackShape *load,
                 CzTrackState *restrict state, CzTrackWave *sum) {
    const int alias = CZ_ALIAS_COSINE + copy;
    double *restrict now = state->now[copy], *restrict past = state->past[copy];
    CZ_WAVES(i) {
        double kicked = now[i] + rows->kick[i] * load->of[copy][i];
        double past_kicked = past[i] + rows->past_kick[i] * load->of[copy][i];
        if (aliased) {
            kicked += rows->alias_kick[i] * load->of[alias][i];
            past_kicked += rows->alias_past_kick[i] * load->of[alias][i];
        }
        const double half = rows->twice[i] * kicked - rows->square[i] * past_kicked;
        const double next = rows->twice[i] * half - rows->square[i] * kicked;
        past[i] = half;
        now[i] = next;
        sum->past.of[copy][i] += half;
        sum->now.of[copy][i] += next;
        if (aliased) {
            sum->past.of[alias][i] += rows->alias[i] * half + rows->alias_past[i] * kicked;
            sum->now.of[alias][i] += rows->alias[i] * next + rows->alias_past[i] * half;
        }
    }
}

/* Advances the modes of a vector of waves by one step and adds the work of their load, which was
 * constant for a step about its time: from the deflection half a step before to that half a step
 * after. */
__attribute__((always_inline)) static inline void
cz_track_step_row(const CzTrackMotion *track, const CzTrackUnder *under, int v, bool aliased,
                  const double force[4], double *restrict work) {
    const int n = aliased ? CZ_N_SHAPE : CZ_ALIAS_COSINE;
    const int end = track->span[v].end;
    CzTrackShape load;
    CzTrackWave sum;
    cz_track_load(&under->shape[4 * v], force, aliased, &load);
    for (int k = 0; k < n; ++k)
        CZ_WAVES(i) {
            sum.now.of[k][i] = sum.past.of[k][i] = 0.0;
        }
    int row = track->span[v].first;
    if (row == end)
        return;
    do {
        cz_track_advance(&track->rows[row], 0, aliased, &load, &under->state[row], &sum);
        cz_track_advance(&track->rows[row], 1, aliased, &load, &under->state[row], &sum);
    } while (++row < end);
    for (int k = 0; k < n; ++k) {
        double *restrict now = under->wave[v].now.of[k], *restrict past = under->wave[v].past.of[k];
        const double *restrict inner = track->inner[v];
        const bool has_edge = aliased && k == CZ_SINE;
        CZ_WAVES(i) {
            work[i] += load.of[k][i] * (sum.past.of[k][i] - past[i]);
            past[i] = sum.past.of[k][i];
            now[i] = has_edge ? inner[i] * sum.now.of[k][i] : sum.now.of[k][i];
        }
    }
}

/* Advances by one step under the forces of the wheels on the rail, upwards [N], at the places of
 * the last look. Returns their work [J]. */
static inline double cz_track_step(const CzTrackMotion *track, const CzTrackUnder *under,
                                   const double force[4]) {
    CzTrackRow work = {0.0};
    for (int v = 0; v < track->first_alias; ++v)
        cz_track_step_row(track, under, v, false, force, work);
    for (int v = track->first_alias; v < track->modes->n_vector; ++v)
        cz_track_step_row(track, under, v, true, force, work);
    return cz_track_sum(work);
}

/* ---- the flexibility beside the modes ---- */

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
