/* The elastic track under one car: exact damped modes of a ring of rail on seats, and the static
 * flexibility of all waves without a mode.
 *
 * The rail under a car is closed to a ring of n_seat seats, so that no window has to be moved or
 * cut off when wheels roll on; the error of the ring is the deflection one turn away. Rail waves K
 * = 2 pi k / length couple only where they agree at the seats: k = j with n_seat - j, n_seat + j,
 * ... and with the sleeper and ballast wave j. So each j from 0 to n_seat / 2 is a block of its
 * own, in a cosine copy and a sine copy. In a block the pad force is one unknown f,
 *
 *   F(s) f = sum of h_k(s) load_k     F = sum c_k / (s^2 + w_k^2) + R + 1 / (k_p + s c_p) + B(s)
 *
 * with the bending branch of the waves of the block (h_k = p_k / (M_k (s^2 + w_k^2)), c_k = n_j
 * h_k), R the static flexibility of all other waves and branches at the seats, and B the deflection
 * of sleeper and ballast. The block's eigenvalues are the roots of F, found at once (Aberth) and
 * tested; the deflection at x under a force at y is the sum over them of g(x) g(y) / (s - lambda)
 * with
 *
 *   g(x) = sum_k sqrt(-n_j / F'(lambda)) h_k(lambda) (cosine or sine of K_k x)
 *
 * The damping is arbitrary. Eigenvalues beyond the cut are left out, and the static deflection of
 * these and of the other waves is a flexibility under the force itself, which varies with the place
 * between two seats.
 */
#ifndef CZ_MODEL_TRACK_H
#define CZ_MODEL_TRACK_H

#include "base/arena.h"
#include "crushzone/status.h"
#include "model/rail.h"

enum {
    CZ_TRACK_WIDTH = 8,     /* waves side by side in a register */
    CZ_TRACK_FLEX_TERMS = 4 /* of the flexibility's series between two seats */
};

/* Eight eigenvalues of neighbouring blocks j = 8 vector ... 8 vector + 7 of one copy; unused ones
 * have g = 0. A pair is stored once, with g sqrt(2) as large: deflection = real part of g y. */
typedef struct CzTrackGroup {
    int copy;                         /* 0 cosine, 1 sine */
    int vector;                       /* j / 8 */
    CzComplex lambda[CZ_TRACK_WIDTH]; /* [1/s] */
    CzComplex direct[CZ_TRACK_WIDTH]; /* g for the rail wave j [1/sqrt(kg s)] */
    CzComplex alias[CZ_TRACK_WIDTH];  /* g for the rail wave j - n_seat; 0 where it is cut off */
    CzComplex pad[CZ_TRACK_WIDTH];    /* force of a pad at the crest per state y */
} CzTrackGroup;

/* Constant once built, shared by all cars. */
typedef struct CzTrackModes {
    CzSeats seats;
    int n_seat;      /* of the ring: 16 q - 2, so that its n_seat / 2 + 1 blocks fill vectors */
    int n_vector;    /* vectors of blocks in a copy */
    int n_group;     /* in order of copy and vector */
    int first_alias; /* first vector that has any alias wave */
    double length;   /* of the ring [m] */
    double cut;      /* largest eigenvalue kept [1/s] */
    double span;     /* first to last wheel of the longest car [m] */
    int nodes;       /* per bay, where finite elements replace the modes */
    CzTrackGroup *group;
    int n_receptance; /* one for each axle spacing of the cars */
    struct CzReceptance *receptance;
} CzTrackModes;

/* Options of the modes. */
typedef struct CzTrackOptions {
    int n_rail;  /* 2 */
    int n_seat;  /* of the ring; 0 chooses it from the span */
    double span; /* first to last wheel of the longest car [m] */
    double cut;  /* [Hz] */
} CzTrackOptions;
CzTrackOptions cz_track_options_default(double span);

/* Modes of a track; the arena owns them. Statuses: CZ_OK, CZ_STATUS_INPUT when the roots do not
 * pass their test, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_track_build(const CzRoadbed *roadbed, const CzTrackOptions *options,
                                      CzArena *arena, CzTrackModes **modes, CzError *error);

/* A function of the place between two seats, a share xi of the spacing past the last one:
 * corner |sin(pi xi)| + sum of term[k] times the k-th power of cos(2 pi xi). The shear force of the
 * rail has a jump over a seat, so the static deflection has a breakpoint there. */
typedef struct CzTrackFlexibility {
    double corner;                    /* [m/N] */
    double term[CZ_TRACK_FLEX_TERMS]; /* [m/N] */
} CzTrackFlexibility;

/* Terms are `stride` numbers apart: in a row of lanes each lane has its own. */
static inline double cz_track_flexibility_of(double corner, const double *term, size_t stride,
                                             double cosine) {
    double value = 0.0;
    for (int k = CZ_TRACK_FLEX_TERMS - 1; k >= 0; --k)
        value = value * cosine + term[(size_t)k * stride];
    return value + corner * sqrt(0.5 * fabs(1.0 - cosine));
}

static inline double cz_track_flexibility_at(const CzTrackFlexibility *flexibility, double cosine) {
    return cz_track_flexibility_of(flexibility->corner, flexibility->term, 1, cosine);
}

/* Flexibility under each force in addition to the modes, so that a static force has the exact
 * static deflection of the ring; `step` as below. */
CzTrackFlexibility cz_track_flexibility(const CzTrackModes *modes, double step);

/* Mean and amplitude, over the place between two seats, of the sum of g(x)^2 times a response of
 * each mode: mean + swing cos(2 pi xi). In the two copies of a block the squared cosine and sine of
 * its waves add up to one; the blocks at the edges have one copy. */
typedef CzComplex CzTrackAnswer(CzComplex lambda, double step);
void cz_track_add_modes(const CzTrackModes *modes, CzTrackAnswer *answer, double step,
                        double sum[2]);

/* Modes in time steps: a force is constant from step / 2 before to step / 2 after its time, and the
 * modes are read before its first half acts. Per g and force:
 *
 *   (2 / lambda) sinh(lambda step / 2)   response to one force before a free step
 *   -exp(lambda step / 2) / lambda       deflection of a mode under a constant force
 *
 * With step = 0 the second is the response in continuous time. */
CzComplex cz_track_kick(CzComplex lambda, double step);
CzComplex cz_track_constant_answer(CzComplex lambda, double step);

#endif
