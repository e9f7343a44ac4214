/* The law of a suspension in one lane. */
#ifndef CZ_DYNAMICS_SUSPENSION_ROWS_H
#define CZ_DYNAMICS_SUSPENSION_ROWS_H

#include "laws/suspension.h"
#include "model/parameters.h"

static inline CzSuspensionLaw cz_suspension_at(const CzSuspensionRows *rows, const double *preload,
                                               size_t i) {
    return (CzSuspensionLaw){rows->stiffness[i],     preload[i],
                             rows->bump_gap[i],      rows->bump_stiffness[i],
                             rows->lift_gap[i],      rows->lift_stiffness[i],
                             rows->damping[i],       rows->blow_off_rate[i],
                             rows->damping_beyond[i]};
}

#endif
