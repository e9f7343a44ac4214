/* The energy of the receptance track. Inline, as track_motion.h. */
#ifndef CZ_DYNAMICS_RECEPTANCE_ENERGY_H
#define CZ_DYNAMICS_RECEPTANCE_ENERGY_H

#include "dynamics/receptance.h"

/* Adds the energy that the modes of one motion of a bogie can return, half a step ago, in the lanes
 * on one track. */
static inline void cz_receptance_add_stored(const CzReceptanceBlock *block,
                                            const CzReceptanceSteps *steps, int bogie, int motion,
                                            CzRow energy) {
    const CzRow *state = block->state[bogie][motion];
    const double *storage = steps->receptance->motion[motion].storage;
    const int n = steps->n[motion];
    CzRow is_under, x[2 * CZ_MAX_PAIR_MODES];
    for (int i = 0; i < CZ_LANE_BLOCK; i++)
        is_under[i] = block->under[i] == steps ? 1.0 : 0.0;
    for (int k = 0; k < n; k++) {
        const CzComplex back = steps->mode[motion][k].back;
        for (int i = 0; i < CZ_LANE_BLOCK; i++) {
            const CzComplex now = {state[2 * k][i], state[2 * k + 1][i]};
            const CzComplex past = cz_complex_product(back, now);
            x[2 * k][i] = past.re;
            x[2 * k + 1][i] = past.im;
        }
    }
    for (int k = 0; k < 2 * n; k++) { /* the form is symmetric: half of it, twice */
        CzRow product;
        for (int i = 0; i < CZ_LANE_BLOCK; i++)
            product[i] = 0.5 * storage[2 * n * k + k] * x[k][i];
        for (int j = 0; j < k; j++)
            for (int i = 0; i < CZ_LANE_BLOCK; i++)
                product[i] += storage[2 * n * k + j] * x[j][i];
        for (int i = 0; i < CZ_LANE_BLOCK; i++)
            energy[i] += 4.0 * is_under[i] * x[k][i] * product[i]; /* of two wheels */
    }
}

/* Whether no lane before lane i is on the same track. */
static inline bool cz_receptance_is_first(const CzReceptanceBlock *block, int i) {
    for (int k = 0; k < i; k++)
        if (block->under[k] == block->under[i])
            return false;
    return true;
}

/* Energy that the track under each car of a block can return, half a step ago [J]. */
static inline void cz_receptance_energy(const CzReceptanceMotion *track, int block, CzRow energy) {
    const CzReceptanceBlock *under = &track->block[block];
    for (int i = 0; i < CZ_LANE_BLOCK; i++)
        energy[i] = 0.0;
    for (int i = 0; i < CZ_LANE_BLOCK; i++) {
        if (under->under[i] == NULL || !cz_receptance_is_first(under, i))
            continue;
        for (int bogie = 0; bogie < 2; bogie++)
            for (int motion = 0; motion < CZ_N_PAIR_MOTION; motion++)
                cz_receptance_add_stored(under, under->under[i], bogie, motion, energy);
    }
}

#endif
