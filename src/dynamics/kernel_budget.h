/* Notes for a budget, taken between the passes of an evaluation. Part of kernel.c only.
 *
 * They read what the passes left and change nothing, so that a run is the same to the last bit
 * whether it is noted or not.
 */
#ifndef CZ_DYNAMICS_KERNEL_BUDGET_H
#define CZ_DYNAMICS_KERNEL_BUDGET_H

#include <string.h>

#include "dynamics/budget.h"
#include "dynamics/kernel_contact.h"
#include "laws/suspension.h"

/* After the couplers, while their directions and arms stand: strut and hinges, on the bodies alone.
 */
static void note_couplers(CzBlock *d) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict nx = S(NORMAL_X), *restrict nz = S(NORMAL_Z);
    const double *restrict inverse_length = S(INVERSE_LENGTH), *restrict tilts = P(TILTS);
    const double *restrict moment_a = S(SPRING_UP_A), *restrict moment_b = S(SPRING_UP_B);
    const double *restrict fx = S(CURVE_VALUE), *restrict fz = S(CURVE_SLOPE);
    for (int side = 0; side < 2; ++side) {
        const double sign = side == 0 ? -1.0 : 1.0;
        const double *restrict arm_x = side == 0 ? S(ARM_X_A) : S(ARM_X_B);
        const double *restrict arm_z = side == 0 ? S(ARM_Z_A) : S(ARM_Z_B);
        const double *restrict own = side == 0 ? moment_a : moment_b;
        const double *restrict on_end = P_AT(COUPLER_ON_END_A, side);
        double *restrict lift = d->budget->coupler_lift[side], *restrict moment =
                                                                   d->budget->coupler_moment[side];
        double *restrict hinge_lift = d->budget->hinge_lift[side], *restrict hinge_moment =
                                                                       d->budget
                                                                           ->hinge_moment[side];
        CZ_LANES (i, n) {
            const double transverse = tilts[i] * (moment_a[i] + moment_b[i]) * inverse_length[i];
            const double hx = transverse * nz[i], hz = -transverse * nx[i];
            const double on_body = 1.0 - on_end[i];
            const double all_lift = sign * fz[i];
            const double all_moment = sign * (arm_x[i] * fz[i] - arm_z[i] * fx[i]) + own[i];
            hinge_lift[i] = on_body * sign * hz;
            hinge_moment[i] = on_body * (sign * (arm_x[i] * hz - arm_z[i] * hx) + own[i]);
            lift[i] = on_body * all_lift - hinge_lift[i];
            moment[i] = on_body * all_moment - hinge_moment[i];
        }
    }
}

/* After the faces. */
static void note_faces(CzBlock *d) {
    CzBudgetRows *budget = d->budget;
    memcpy(budget->face_x, S(CURVE_VALUE), sizeof(CzRow));
    memcpy(budget->face_z, S(CURVE_SLOPE), sizeof(CzRow));
    memcpy(budget->face_arm_x[0], S(ARM_X_A), sizeof(CzRow));
    memcpy(budget->face_arm_z[0], S(ARM_Z_A), sizeof(CzRow));
    memcpy(budget->face_arm_x[1], S(ARM_X_B), sizeof(CzRow));
    memcpy(budget->face_arm_z[1], S(ARM_Z_B), sizeof(CzRow));
}

/* After the crush zone of one end. */
static void note_end(CzBlock *d, int end) {
    const size_t n = CZ_LANE_BLOCK;
    const double sign = end == 0 ? -1.0 : 1.0;
    const double *restrict c = S(BODY_COS), *restrict s = S(BODY_SIN);
    const double *restrict force = S_AT(END_REAR, end);
    const double *restrict across = S(CHAIN_FORCE), *restrict turning = S(CHAIN_LOWEST);
    const double *restrict arm_x = S(ARM_X_A), *restrict arm_z = S(ARM_Z_A);
    double *restrict lift = d->budget->end_lift[end], *restrict moment = d->budget->end_moment[end];
    double *restrict guide_lift = d->budget->guide_lift[end], *restrict guide_moment =
                                                                  d->budget->guide_moment[end];
    CZ_LANES (i, n) { /* on the end mass, so the body gets the opposite */
        const double fx = sign * force[i] * c[i], fz = sign * force[i] * s[i];
        const double ax = across[i] * s[i], az = -across[i] * c[i];
        lift[i] = -fz;
        moment[i] = -(arm_x[i] * fz - arm_z[i] * fx);
        guide_lift[i] = -az;
        guide_moment[i] = -(arm_x[i] * az - arm_z[i] * ax) + turning[i];
    }
}

/* After a bogie, with what the body had got before it. */
static void note_bogie(CzBlock *d, int bogie, const double *restrict lift_before,
                       const double *restrict moment_before) {
    const size_t n = CZ_LANE_BLOCK;
    const double sign = bogie == 0 ? -1.0 : 1.0;
    const double *restrict half = P(BOGIE_X), *restrict compression = S_AT(SECONDARY_REAR, bogie);
    const double *restrict xb = X(BODY_X), *restrict zb = X(BODY_Z);
    const double *restrict c = S(BODY_COS), *restrict s = S(BODY_SIN);
    const double *restrict xt = X_AT(BOGIE_X_REAR, 3 * bogie), *restrict zt =
                                                                   X_AT(BOGIE_Z_REAR, 3 * bogie);
    const double *restrict ct = S_AT(BOGIE_COS_REAR, 2 * bogie), *restrict st = S_AT(BOGIE_SIN_REAR,
                                                                                     2 * bogie);
    const double *restrict bump = P(SECONDARY_BUMP_GAP), *restrict bump_k =
                                                             P(SECONDARY_BUMP_STIFFNESS);
    const double *restrict lift = P(SECONDARY_LIFT_GAP), *restrict lift_k =
                                                             P(SECONDARY_LIFT_STIFFNESS);
    const double *restrict link_body = P(LINK_BODY_Z), *restrict link_bogie = P(LINK_BOGIE_Z);
    const double *restrict pull = S_AT(LINK_REAR, bogie);
    const double *restrict gz = G(BODY_Z), *restrict gm = G(BODY_PITCH);
    double *restrict link_moment = d->budget->link_moment;
    double *restrict suspension_lift = d->budget->suspension_lift, *restrict suspension_moment =
                                                                       d->budget->suspension_moment;
    double *restrict stop_lift = d->budget->stop_lift, *restrict stop_moment =
                                                           d->budget->stop_moment;
    CZ_LANES (i, n) {
        const CzSuspensionLaw law = {.bump_gap = bump[i],
                                     .bump_stiffness = bump_k[i],
                                     .lift_gap = lift[i],
                                     .lift_stiffness = lift_k[i]};
        const double dx = sign * half[i] + (xt[i] - xb[i]) - link_bogie[i] * st[i];
        const double dz = link_body[i] - link_bogie[i] + (zt[i] - zb[i]) + link_bogie[i] * ct[i];
        const double arm = c[i] * dx + s[i] * dz, height = c[i] * dz - s[i] * dx;
        const double stop = cz_suspension_stops(&law, compression[i]);
        const double of_link = height * pull[i];
        link_moment[i] += of_link;
        stop_lift[i] += c[i] * stop;
        stop_moment[i] += arm * stop;
        suspension_lift[i] += gz[i] - lift_before[i] - c[i] * stop;
        suspension_moment[i] += gm[i] - moment_before[i] - of_link - arm * stop;
    }
}

#endif
