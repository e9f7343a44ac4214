/* Laws with the parameters of one lane. */
#ifndef CZ_DYNAMICS_LAW_ROWS_H
#define CZ_DYNAMICS_LAW_ROWS_H

#include "laws/shear_off.h"
#include "laws/suspension.h"
#include "laws/vehicle_end.h"
#include "model/parameters.h"

static inline CzSuspensionLaw cz_suspension_at(const CzSuspensionRows *rows, const double *preload,
                                               size_t i) {
    return (CzSuspensionLaw){rows->stiffness[i],     preload[i],
                             rows->bump_gap[i],      rows->bump_stiffness[i],
                             rows->lift_gap[i],      rows->lift_stiffness[i],
                             rows->damping[i],       rows->blow_off_rate[i],
                             rows->damping_beyond[i]};
}

static inline CzVehicleEndLaw cz_crush_at(const CzCrushRows *rows, size_t i) {
    return (CzVehicleEndLaw){cz_larger(rows->unloading[i], 1.0), rows->share[i],
                             cz_larger(rows->second_unloading[i], 1.0), rows->tension[i]};
}

static inline CzShearOffLaw cz_shear_off_at(const CzShearOffRows *rows, size_t i) {
    return (CzShearOffLaw){rows->force[i], rows->residual[i], cz_larger(rows->softening[i], 1e-6),
                           rows->space[i], rows->bottom[i]};
}

#endif
