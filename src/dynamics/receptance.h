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

/* Track under bogies of one axle spacing. */
typedef struct CzReceptanceSteps {
    const CzReceptance *receptance; /* borrowed */
    int n[CZ_N_PAIR_MOTION];
    CzPairStep mode[CZ_N_PAIR_MOTION][CZ_MOST_PAIR_MODES];
    CzTrackFlexibility flexibility; /* under a wheel, in addition to the modes */
} CzReceptanceSteps;

/* Track under the cars of a block that have bogies of one axle spacing; all other lanes stay at
 * zero. */
typedef struct CzReceptancePart {
    const CzReceptanceSteps *steps;
    CzRow *state; /* real and imaginary parts in turn: bounce and pitch of the rear bogie, then of
                     the front one */
    _Alignas(64) CzRow is_under; /* 1 where it is under a car, else 0 */
} CzReceptancePart;

typedef struct CzReceptanceBlock {
    int n_part;
    CzReceptancePart *part;
    _Alignas(64) CzRow z[4]; /* deflection of the modes under each wheelset, now */
    CzRow past[4];           /* and half a step ago */
} CzReceptanceBlock;

typedef struct CzReceptanceMotion {
    double per_spacing; /* of the seats [1/m] */
    int n_steps;
    const CzReceptanceSteps *steps;
    CzReceptanceBlock *block; /* one for each of the dynamics' */
} CzReceptanceMotion;

/* Constants for steps of h seconds (0: continuous time) and n_block blocks without cars; NULL when
 * there is no memory. */
CzReceptanceMotion *cz_receptance_create(const CzTrackModes *modes, double step, int n_block,
                                         CzArena *arena);

/* Lays the track under the car of a lane, whose axle spacing is one of those of the fitted modes,
 * at rest under the loads of its wheels [N]; false when there is no memory. */
bool cz_receptance_lay(CzReceptanceMotion *track, size_t lane, double axle_spacing,
                       const double load[4], CzArena *arena);

/* Deflection of the modes under each wheel now [m], and the additional flexibility at the wheels'
 * places [m/N]. */
void cz_receptance_look(const CzReceptanceMotion *track, size_t lane, const double place[4],
                        double deflection[4], double flexibility[4]);

/* Energy that the track under each car of a block can return, half a step ago [J]. */
void cz_receptance_energy(const CzReceptanceMotion *track, int block, CzRow energy);

/* For a solver that integrates the states, as in track.h: the number of states under a car, 0
 * without wheels, the states themselves, and their rates under forces upwards on the rail [N], with
 * the rate of the rail under each wheel [m/s]. */
size_t cz_receptance_n_state(const CzReceptanceMotion *track, size_t lane);
void cz_receptance_get_state(const CzReceptanceMotion *track, size_t lane, double *state);
void cz_receptance_set_state(CzReceptanceMotion *track, size_t lane, const double *state);
void cz_receptance_rate(const CzReceptanceMotion *track, size_t lane, const double force[4],
                        double *rate, double rail_rate[4]);

#endif
