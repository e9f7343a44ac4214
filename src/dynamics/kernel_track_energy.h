/* The energy of the tracks under the cars of a block. Part of kernel.c only. */
#ifndef CZ_DYNAMICS_KERNEL_TRACK_ENERGY_H
#define CZ_DYNAMICS_KERNEL_TRACK_ENERGY_H

#include "dynamics/dynamics.h"
#include "dynamics/receptance_energy.h"
#include "dynamics/track_energy.h"

/* Energy under one car on a modal track or a track of elements. */
static double energy_under(const CzDynamics *dynamics, size_t lane) {
    double energy = 0.0, loss = 0.0;
    if (dynamics->track != NULL && dynamics->track->under[lane].state != NULL)
        cz_track_energy(dynamics->track, &dynamics->track->under[lane], &energy, &loss);
    else if (dynamics->elements != NULL && dynamics->elements->under[lane].is_laid)
        energy = cz_elements_energy(dynamics->elements, lane);
    return energy;
}

static void track_energy(const CzDynamics *dynamics, int block, CzRow energy) {
    if (dynamics->receptance != NULL)
        cz_receptance_energy(dynamics->receptance, block, energy);
    else
        for (size_t i = 0; i < CZ_LANE_BLOCK; ++i)
            energy[i] = energy_under(dynamics, (size_t)block * CZ_LANE_BLOCK + i);
}

#endif
