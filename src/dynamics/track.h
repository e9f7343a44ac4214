/* The moving part of the modal track: what each car has under it.
 *
 * Positions are those of the wheels along the track from the middle of the car at t = 0, where a
 * seat is; deflections are upwards and zero for the unloaded track.
 */
#ifndef CZ_DYNAMICS_TRACK_H
#define CZ_DYNAMICS_TRACK_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
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

/* Place of a wheelset from the middle of its car, counted from the rear: half the spacing of the
 * bogies and of the axles [m]. */
static inline double cz_wheel_place(double bogie, double axle, int index) {
    return (index / 2 == 0 ? -bogie : bogie) + (index % 2 == 0 ? -axle : axle);
}

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

/* Constants for a step of h seconds and n_under cars without state; NULL when there is no memory.
 * The arena owns them. */
CzTrackMotion *cz_track_motion_create(const CzTrackModes *modes, double step, size_t n_under,
                                      CzArena *arena);

/* Gives a car its track, at rest under the forces of its wheels [N] at their places [m]; false when
 * there is no memory. */
bool cz_track_lay(CzTrackMotion *track, size_t index, const double place[4], const double load[4],
                  CzArena *arena);

/* Deflection of the modes under each wheel at the places of the last look or step [m], and the
 * flexibility beside them [m/N]. */
void cz_track_look(const CzTrackMotion *track, size_t index, const double place[4],
                   double deflection[4], double flexibility[4]);

/* Half a step before the time that the state is at, when the last forces had just ended: energy
 * of the track under a car, kinetic and potential above the unloaded track [J], and the power that
 * pads, ballast and subgrade turn into heat [W]. */
double cz_track_energy(const CzTrackMotion *track, size_t index);
double cz_track_loss(const CzTrackMotion *track, size_t index);

/* ---- the same track for a solver of ordinary differential equations ----
 *
 * A track that is laid for a step of 0 is at rest until somebody sets its state, the real and
 * imaginary parts of its modes; its flexibility is that of continuous time. A solver that carries
 * these states beside the vehicles' co-ordinates does in its right-hand side
 *
 *   1. cz_track_set_state for each car,
 *   2. the kernel's evaluation, which finds the forces of the wheels,
 *   3. cz_dynamics_track_rate (dynamics.h) for each car: the rates of its states under those
 * forces, and the track's part of the powers.
 *
 * At t = 0 cz_track_get_state gives the state at rest. Under usual axle loads a state is of the
 * size of 0.01 to 1 sqrt(J s), and 1e-3 of that moves a wheel by about 1 um.
 */

/* Numbers of one car's state. */
size_t cz_track_n_state(const CzTrackModes *modes);
void cz_track_get_state(const CzTrackMotion *track, size_t index, double *state);
void cz_track_set_state(CzTrackMotion *track, size_t index, const double *state);

/* Rates of the state under forces at the places of the last look, upwards on the rail [N], and the
 * rate of the rail there [m/s]. */
void cz_track_rate(CzTrackMotion *track, size_t index, const double force[4], double *rate,
                   double rail_rate[4]);

#endif
