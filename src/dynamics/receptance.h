/* The receptance track in steps: the fitted modes under the bogies of each block of cars, side by
 * side in lanes. A step is a kick and a free flight as in track_motion.h. */
#ifndef CZ_DYNAMICS_RECEPTANCE_H
#define CZ_DYNAMICS_RECEPTANCE_H

#include "base/arena.h"
#include "model/receptance.h"
#include "model/state.h"

/* A mode for one step size h. */
typedef struct CzPairStep {
    CzComplex flight; /* exp(lambda h) */
    CzComplex kick;   /* state per force */
    CzComplex now;    /* deflection per state */
    CzComplex past;   /* half a step ago */
    CzComplex rest;   /* state per constant force */
    CzComplex back;   /* state half a step ago per state */
} CzPairStep;

/* A track under bogies of one axle spacing. */
typedef struct CzReceptanceSteps {
    const CzTrackModes *modes;      /* borrowed, as is the next */
    const CzReceptance *receptance; /* fitted to the modes */
    int n[CZ_N_PAIR_MOTION];
    CzPairStep mode[CZ_N_PAIR_MOTION][CZ_MAX_PAIR_MODES];
    CzTrackFlexibility flexibility; /* under a wheel, in addition to the modes */
} CzReceptanceSteps;

/* The numbers of a mode in the lanes of a block whose tracks differ; 0 in lanes without it. */
typedef struct CzPairStepRows {
    _Alignas(64) CzRow flight_re, flight_im;
    CzRow kick_re, kick_im, now_re, now_im, past_re, past_im;
    CzRow lambda_re, lambda_im; /* for a solver of ordinary differential equations */
} CzPairStepRows;

typedef struct CzReceptanceBlock {
    const CzReceptanceSteps *under[CZ_LANE_BLOCK]; /* each car; NULL without wheels */
    const CzReceptanceSteps *same;          /* under all cars with wheels; NULL where they differ */
    int n_under, lane[CZ_LANE_BLOCK];       /* the lanes of cars with wheels (n_under) */
    int n[CZ_N_PAIR_MOTION];                /* most modes of a lane */
    CzPairStepRows *mode[CZ_N_PAIR_MOTION]; /* (n) */
    CzRow *state[2][CZ_N_PAIR_MOTION]; /* of the rear and the front bogie, real and imaginary parts
                                          in turn (2 n) */
    _Alignas(64) CzRow per_spacing;    /* of the seats [1/m] */
    CzRow corner, term[CZ_TRACK_FLEX_TERMS]; /* as CzTrackFlexibility */
    CzRow z[4];                              /* deflection of the modes under each wheelset, now */
    CzRow past[4];                           /* and half a step ago */
} CzReceptanceBlock;

typedef struct CzReceptanceMotion {
    int n_steps;
    const CzReceptanceSteps *steps; /* one for each receptance of each track (n_steps) */
    CzReceptanceBlock *block;       /* one for each of the dynamics' */
} CzReceptanceMotion;

/* Constants for steps of h seconds (0: continuous time) on n tracks, of which some may be the same,
 * and n_block blocks without cars; NULL when there is no memory. */
CzReceptanceMotion *cz_receptance_create(const CzTrackModes *const *modes, int n, double step,
                                         int n_block, CzArena *arena);

/* Lays one of the tracks under the car of a lane, whose axle spacing is one of those of the fitted
 * modes, at rest under the loads of its wheels [N]. */
void cz_receptance_lay(CzReceptanceMotion *track, size_t lane, const CzTrackModes *modes,
                       double axle_spacing, const double load[4]);

/* Copies what the track under the car of a lane has reached to a lane with the same track. */
void cz_receptance_move(CzReceptanceMotion *track, size_t lane, const CzReceptanceMotion *from,
                        size_t from_lane);

/* Deflection of the modes under each wheel now [m], and the additional flexibility at the wheels'
 * places [m/N]. */
void cz_receptance_deflection(const CzReceptanceMotion *track, size_t lane, const double place[4],
                              double deflection[4], double flexibility[4]);

/* For a solver that integrates the states (dynamics.h): numbers of the states under a block, and
 * the states. They are in the order of the rows, the cars of a row one after the other. */
size_t cz_receptance_n_state(const CzReceptanceBlock *block);
void cz_receptance_get_state(const CzReceptanceBlock *block, double *state);

#endif
