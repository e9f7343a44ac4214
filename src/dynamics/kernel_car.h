/* What happens inside one car: crush zones, suspensions, traction links. Part of kernel.c only.
 *
 * Every force acts at one point on both bodies: arms are taken from that point to the present
 * centres of gravity.
 */
#ifndef CZ_DYNAMICS_KERNEL_CAR_H
#define CZ_DYNAMICS_KERNEL_CAR_H

#include "dynamics/kernel_rows.h"
#include <string.h>

#include "laws/buffer.h"
#include "laws/slider.h"
#include "laws/suspension.h"
#include "laws/vehicle_end.h"

/* Shortening of the crush zone of one end along the body's axis, its rate, and the same across the
 * axis: into END_STROKE, RATE, SLIP, SLIP_RATE; the point of action (on the end mass) from the body
 * and from the end mass. */
static void end_geometry(CzBlock *d, int end) {
    const size_t n = CZ_LANE_BLOCK;
    const double sign = end == 0 ? -1.0 : 1.0;
    const double *restrict at = P_AT(END_X_REAR, end), *restrict body_z =
                                                           P_AT(END_BODY_Z_REAR, end);
    const double *restrict mass_z = P_AT(END_MASS_Z_REAR, end);
    const double *restrict c = S(BODY_COS), *restrict s = S(BODY_SIN);
    const double *restrict ce = S_AT(END_COS_REAR, 2 * end), *restrict se =
                                                                 S_AT(END_SIN_REAR, 2 * end);
    const double *restrict xb = X(BODY_X), *restrict zb = X(BODY_Z);
    const double *restrict vxb = V(BODY_X), *restrict vzb = V(BODY_Z),
                           *restrict turn = V(BODY_PITCH);
    const double *restrict xe = X_AT(END_X_REAR, 3 * end), *restrict ze = X_AT(END_Z_REAR, 3 * end);
    const double *restrict vxe = V_AT(END_X_REAR, 3 * end), *restrict vze =
                                                                V_AT(END_Z_REAR, 3 * end);
    const double *restrict turn_e = V_AT(END_PITCH_REAR, 3 * end);
    double *restrict stroke = S_AT(END_STROKE_REAR, end), *restrict rate = S(RATE);
    double *restrict slip = S(SLIP), *restrict slip_rate = S(SLIP_RATE);
    double *restrict arm_x = S(ARM_X_A), *restrict arm_z = S(ARM_Z_A);
    double *restrict arm_x_e = S(ARM_X_B), *restrict arm_z_e = S(ARM_Z_B);
    CZ_LANES (i, n) {
        const double bx = at[i] * c[i] - body_z[i] * s[i], bz = at[i] * s[i] + body_z[i] * c[i];
        const double ex = -mass_z[i] * se[i], ez = mass_z[i] * ce[i];
        const double qx = (xe[i] + ex) - (xb[i] + (bx - at[i]));
        const double qz = (ze[i] + (ez - mass_z[i])) - (zb[i] + (bz - body_z[i]));
        const double px = bx + qx, pz = bz + qz;
        const double vx = (vxe[i] - ez * turn_e[i]) - (vxb[i] - pz * turn[i]);
        const double vz = (vze[i] + ex * turn_e[i]) - (vzb[i] + px * turn[i]);
        stroke[i] = -sign * (c[i] * qx + s[i] * qz);
        rate[i] = -sign * (c[i] * vx + s[i] * vz);
        slip[i] = c[i] * qz - s[i] * qx;
        slip_rate[i] = c[i] * vz - s[i] * vx;
        arm_x[i] = px;
        arm_z[i] = pz;
        arm_x_e[i] = ex;
        arm_z_e[i] = ez;
    }
}

/* Force of the crush zone along the axis, into END_REAR/FRONT; its damping is in CHAIN_FORCE. */
static void end_crush(CzBlock *d, int end) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict stroke = S_AT(END_STROKE_REAR, end), *restrict rate = S(RATE);
    const double *restrict before = M_AT(END_PEAK_REAR, end);
    double *restrict next = NEXT_AT(END_PEAK_REAR, end), *restrict largest = S(LARGEST);
    CZ_LANES (i, n) {
        next[i] = cz_larger(before[i], stroke[i]);
    }
    largest_of_stages(d, CZ_CURVE_END_REAR + end, next, largest);
    double *restrict curve = S(CURVE_VALUE), *restrict peak = d->end_peak[end],
                     *restrict slope = S(CURVE_SLOPE);
    if (memcmp(largest, d->end_peak_at[end], sizeof(CzRow)) != 0) {
        evaluate_curve(d, CZ_CURVE_END_REAR + end, largest, peak, slope);
        memcpy(d->end_peak_at[end], largest, sizeof(CzRow));
    }
    evaluate_curve(d, CZ_CURVE_END_REAR + end, stroke, curve, slope);
    const double *restrict unloading = P_AT(END_UNLOADING_REAR, end), *restrict share =
                                                                          P_AT(END_SHARE_REAR, end);
    const double *restrict second = P_AT(END_SECOND_UNLOADING_REAR, end);
    const double *restrict tension = P_AT(END_TENSION_REAR, end), *restrict damping =
                                                                      P_AT(END_DAMPING_REAR, end);
    const double *restrict compliance = C_AT(END_COMPLIANCE_REAR, end),
                           *restrict second_compliance = C_AT(END_SECOND_COMPLIANCE_REAR, end);
    double *restrict force = S_AT(END_REAR, end), *restrict damped = S(CHAIN_FORCE);
    double *restrict power = POWER_AT(END_REAR, end), *restrict lost =
                                                          POWER_AT(END_DAMPING_REAR, end);
    CZ_LANES (i, n) {
        const CzVehicleEndLaw law = {cz_larger(unloading[i], 1.0), share[i],
                                     cz_larger(second[i], 1.0), tension[i]};
        const CzVehicleEndResponse response = cz_vehicle_end_of(
            &law, compliance[i], second_compliance[i], curve[i], peak[i], stroke[i], largest[i]);
        damped[i] = damping[i] * rate[i] * cz_fade_in(stroke[i], CZ_FADE_LENGTH);
        force[i] = response.force + damped[i];
        power[i] = response.force * rate[i];
        lost[i] += damped[i] * rate[i];
    }
}

/* Guidance across the axis (into CHAIN_FORCE) and folding moment (into CHAIN_LOWEST) of one end. */
static void end_guidance(CzBlock *d, int end) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict slip = S(SLIP), *restrict slip_rate = S(SLIP_RATE);
    double *restrict kept = S_AT(END_ACROSS_REAR, end);
    const double *restrict k = P_AT(GUIDE_STIFFNESS_REAR, end), *restrict c =
                                                                    P_AT(GUIDE_DAMPING_REAR, end);
    const double *restrict fold = P_AT(FOLD_STIFFNESS_REAR, end), *restrict fold_c =
                                                                      P_AT(FOLD_DAMPING_REAR, end);
    const double *restrict capacity = P_AT(FOLD_MOMENT_REAR, end), *restrict folded =
                                                                       M_AT(FOLD_REAR, end);
    const double *restrict pitch = X(BODY_PITCH), *restrict turn = V(BODY_PITCH);
    const double *restrict pitch_e = X_AT(END_PITCH_REAR, 3 * end), *restrict turn_e = V_AT(
                                                                        END_PITCH_REAR, 3 * end);
    const double *restrict compliance = C_AT(FOLD_COMPLIANCE_REAR, end);
    double *restrict next = NEXT_AT(FOLD_REAR, end);
    double *restrict across = S(CHAIN_FORCE), *restrict moment = S(CHAIN_LOWEST);
    double *restrict guide = POWER_AT(GUIDE_REAR, end), *restrict guide_lost =
                                                            POWER_AT(GUIDE_DAMPING_REAR, end);
    double *restrict folding = POWER_AT(FOLD_REAR, end), *restrict folding_lost =
                                                             POWER_AT(FOLD_DAMPING_REAR, end);
    CZ_LANES (i, n) {
        const double spring = k[i] * slip[i], damper = c[i] * slip_rate[i];
        const CzSliderResponse hinge =
            cz_slider_of(fold[i], compliance[i], capacity[i], pitch_e[i] - pitch[i], folded[i]);
        const double opening = turn_e[i] - turn[i], resisting = fold_c[i] * opening;
        next[i] = hinge.offset;
        kept[i] = slip[i];
        across[i] = spring + damper;
        moment[i] = hinge.force + resisting;
        guide[i] += spring * slip_rate[i];
        guide_lost[i] += damper * slip_rate[i];
        folding[i] += hinge.force * opening;
        folding_lost[i] += resisting * opening;
    }
}

/* Crush zone, guidance and folding of one end, put on end mass and body. */
static void vehicle_end(CzBlock *d, int end) {
    const size_t n = CZ_LANE_BLOCK;
    const double sign = end == 0 ? -1.0 : 1.0;
    end_geometry(d, end);
    end_crush(d, end);
    end_guidance(d, end);
    const double *restrict c = S(BODY_COS), *restrict s = S(BODY_SIN);
    const double *restrict force = S_AT(END_REAR, end);
    const double *restrict across = S(CHAIN_FORCE), *restrict moment = S(CHAIN_LOWEST);
    const double *restrict arm_x = S(ARM_X_A), *restrict arm_z = S(ARM_Z_A);
    const double *restrict arm_x_e = S(ARM_X_B), *restrict arm_z_e = S(ARM_Z_B);
    double *restrict gx = G(BODY_X), *restrict gz = G(BODY_Z), *restrict gm = G(BODY_PITCH);
    double *restrict ex = G_AT(END_X_REAR, 3 * end), *restrict ez = G_AT(END_Z_REAR, 3 * end);
    double *restrict em = G_AT(END_PITCH_REAR, 3 * end), *restrict section =
                                                             S_AT(SECTION_REAR, end);
    CZ_LANES (i, n) { /* on the end mass */
        const double fx = sign * force[i] * c[i] + across[i] * s[i];
        const double fz = sign * force[i] * s[i] - across[i] * c[i];
        ex[i] += fx;
        ez[i] += fz;
        em[i] += arm_x_e[i] * fz - arm_z_e[i] * fx - moment[i];
        gx[i] -= fx;
        gz[i] -= fz;
        gm[i] -= arm_x[i] * fz - arm_z[i] * fx - moment[i];
        section[i] += force[i];
    }
}

/* Secondary suspension and traction link of one bogie, in the frame of the body. Strokes and rates
 * are each other's integrals at any pitch, as those of the axles. */
static void bogie_to_body(CzBlock *d, int bogie) {
    const size_t n = CZ_LANE_BLOCK;
    const double sign = bogie == 0 ? -1.0 : 1.0;
    const double *restrict half = P(BOGIE_X), *restrict s = S(BODY_SIN), *restrict c = S(BODY_COS);
    const double *restrict xb = X(BODY_X), *restrict zb = X(BODY_Z);
    const double *restrict vxb = V(BODY_X), *restrict vzb = V(BODY_Z),
                           *restrict turn = V(BODY_PITCH);
    const double *restrict xt = X_AT(BOGIE_X_REAR, 3 * bogie), *restrict zt =
                                                                   X_AT(BOGIE_Z_REAR, 3 * bogie);
    const double *restrict ct = S_AT(BOGIE_COS_REAR, 2 * bogie), *restrict st = S_AT(BOGIE_SIN_REAR,
                                                                                     2 * bogie);
    const double *restrict vxt = V_AT(BOGIE_X_REAR, 3 * bogie), *restrict vzt =
                                                                    V_AT(BOGIE_Z_REAR, 3 * bogie);
    const double *restrict turn_t = V_AT(BOGIE_PITCH_REAR, 3 * bogie);
    const double *restrict k = P(SECONDARY_STIFFNESS), *restrict preload =
                                                           P_AT(SECONDARY_PRELOAD_REAR, bogie);
    const double *restrict bump = P(SECONDARY_BUMP_GAP), *restrict bump_k =
                                                             P(SECONDARY_BUMP_STIFFNESS);
    const double *restrict lift = P(SECONDARY_LIFT_GAP), *restrict lift_k =
                                                             P(SECONDARY_LIFT_STIFFNESS);
    const double *restrict damping = P(SECONDARY_DAMPING), *restrict blow_off =
                                                               P(SECONDARY_BLOW_OFF_RATE);
    const double *restrict beyond = P(SECONDARY_DAMPING_BEYOND);
    const double *restrict link_body = P(LINK_BODY_Z), *restrict link_bogie = P(LINK_BOGIE_Z);
    const double *restrict link_k = P(LINK_STIFFNESS), *restrict link_c = P(LINK_DAMPING);
    double *restrict gxb = G(BODY_X), *restrict gzb = G(BODY_Z), *restrict gmb = G(BODY_PITCH);
    double *restrict gxt = G_AT(BOGIE_X_REAR, 3 * bogie), *restrict gzt =
                                                              G_AT(BOGIE_Z_REAR, 3 * bogie);
    double *restrict gmt = G_AT(BOGIE_PITCH_REAR, 3 * bogie);
    double *restrict kept = S_AT(LINK_REAR, bogie), *restrict way = S_AT(LINK_TRAVEL_REAR, bogie);
    double *restrict compressed = S_AT(SECONDARY_REAR, bogie);
    double *restrict spring_power = POWER(SECONDARY), *restrict damper_power =
                                                          POWER(SECONDARY_DAMPING);
    double *restrict link_power = POWER(LINK), *restrict link_lost = POWER(LINK_DAMPING);
    CZ_LANES (i, n) {
        /* The pin of the link on the bogie as the body sees it: spring and link act there. */
        const CzSuspensionLaw law = {k[i],      preload[i], bump[i],     bump_k[i], lift[i],
                                     lift_k[i], damping[i], blow_off[i], beyond[i]};
        const double pin_x = -link_bogie[i] * st[i], pin_z = link_bogie[i] * ct[i];
        const double dx = sign * half[i] + (xt[i] - xb[i]) + pin_x;
        const double dz = link_body[i] - link_bogie[i] + (zt[i] - zb[i]) + pin_z;
        const double vx = vxt[i] - vxb[i] - pin_z * turn_t[i];
        const double vz = vzt[i] - vzb[i] + pin_x * turn_t[i];
        const double arm = c[i] * dx + s[i] * dz, height = c[i] * dz - s[i] * dx;
        const double compression = height - link_body[i];
        const double rate = c[i] * vz - s[i] * vx - turn[i] * arm;
        const double spring = cz_suspension_spring(&law, compression);
        const double damper = cz_suspension_damper(&law, rate);
        const double lifted = spring + damper;
        const double stretch = sign * half[i] - arm;
        const double stretching = -(c[i] * vx + s[i] * vz + turn[i] * height);
        const double held = link_k[i] * stretch, resisted = link_c[i] * stretching;
        const double pull = held + resisted; /* forward on the bogie */

        const double fx = c[i] * pull + s[i] * lifted, fz = s[i] * pull - c[i] * lifted;
        gxb[i] -= fx;
        gzb[i] -= fz;
        gxt[i] += fx;
        gzt[i] += fz;
        gmb[i] += arm * lifted + height * pull;
        gmt[i] += pin_x * fz - pin_z * fx;
        compressed[i] = compression;
        kept[i] = pull;
        way[i] = stretch;
        spring_power[i] += spring * rate;
        damper_power[i] += damper * rate;
        link_power[i] += held * stretching;
        link_lost[i] += resisted * stretching;
    }
}

/* Primary suspension and axle guidance of one axle, counted from the rear of the car, in the frame
 * of the bogie: one whose wheels are off the rail may turn by any angle. Strokes and rates are each
 * other's integrals at any, so that the springs give back no more than they took. */
static void axle_to_bogie(CzBlock *d, int axle) {
    const size_t n = CZ_LANE_BLOCK;
    const int bogie = axle / 2;
    const double sign = axle % 2 == 0 ? -1.0 : 1.0;
    const double *restrict half = P(AXLE_X), *restrict axle_z = P(AXLE_Z);
    const double *restrict xt = X_AT(BOGIE_X_REAR, 3 * bogie), *restrict zt =
                                                                   X_AT(BOGIE_Z_REAR, 3 * bogie);
    const double *restrict c = S_AT(BOGIE_COS_REAR, 2 * bogie), *restrict s =
                                                                    S_AT(BOGIE_SIN_REAR, 2 * bogie);
    const double *restrict vxt = V_AT(BOGIE_X_REAR, 3 * bogie), *restrict vzt =
                                                                    V_AT(BOGIE_Z_REAR, 3 * bogie);
    const double *restrict turn = V_AT(BOGIE_PITCH_REAR, 3 * bogie);
    const double *restrict xw = X_AT(WHEEL_X_0, 3 * axle), *restrict zw = X_AT(WHEEL_Z_0, 3 * axle);
    const double *restrict vxw = V_AT(WHEEL_X_0, 3 * axle), *restrict vzw =
                                                                V_AT(WHEEL_Z_0, 3 * axle);
    const double *restrict k = P(PRIMARY_STIFFNESS), *restrict preload =
                                                         P_AT(PRIMARY_PRELOAD_0, axle);
    const double *restrict bump = P(PRIMARY_BUMP_GAP), *restrict bump_k = P(PRIMARY_BUMP_STIFFNESS);
    const double *restrict lift = P(PRIMARY_LIFT_GAP), *restrict lift_k = P(PRIMARY_LIFT_STIFFNESS);
    const double *restrict damping = P(PRIMARY_DAMPING), *restrict blow_off =
                                                             P(PRIMARY_BLOW_OFF_RATE);
    const double *restrict beyond = P(PRIMARY_DAMPING_BEYOND);
    const double *restrict guide_k = P(AXLE_GUIDANCE_STIFFNESS), *restrict guide_c =
                                                                     P(AXLE_GUIDANCE_DAMPING);
    double *restrict gxt = G_AT(BOGIE_X_REAR, 3 * bogie), *restrict gzt =
                                                              G_AT(BOGIE_Z_REAR, 3 * bogie);
    double *restrict gmt = G_AT(BOGIE_PITCH_REAR, 3 * bogie);
    double *restrict gxw = G_AT(WHEEL_X_0, 3 * axle), *restrict gzw = G_AT(WHEEL_Z_0, 3 * axle);
    double *restrict spring_power = POWER(PRIMARY), *restrict damper_power = POWER(PRIMARY_DAMPING);
    double *restrict compressed = S_AT(PRIMARY_0, axle), *restrict stretched =
                                                             S_AT(AXLE_GUIDANCE_0, axle);
    double *restrict guide_power = POWER(AXLE_GUIDANCE), *restrict guide_lost =
                                                             POWER(AXLE_GUIDANCE_DAMPING);
    CZ_LANES (i, n) {
        /* The axle as the bogie sees it. */
        const CzSuspensionLaw law = {k[i],      preload[i], bump[i],     bump_k[i], lift[i],
                                     lift_k[i], damping[i], blow_off[i], beyond[i]};
        const double dx = sign * half[i] + (xw[i] - xt[i]), dz = axle_z[i] + (zw[i] - zt[i]);
        const double vx = vxw[i] - vxt[i], vz = vzw[i] - vzt[i];
        const double axle_x = c[i] * dx + s[i] * dz, height = c[i] * dz - s[i] * dx;
        const double compression = height - axle_z[i];
        const double rate = c[i] * vz - s[i] * vx - turn[i] * axle_x;
        const double spring = cz_suspension_spring(&law, compression);
        const double damper = cz_suspension_damper(&law, rate);
        const double lifted = spring + damper;
        const double stretch = sign * half[i] - axle_x;
        const double stretching = -(c[i] * vx + s[i] * vz + turn[i] * height);
        const double held = guide_k[i] * stretch, resisted = guide_c[i] * stretching;
        const double pull = held + resisted; /* forward on the wheelset */

        const double fx = c[i] * pull + s[i] * lifted, fz = s[i] * pull - c[i] * lifted;
        gxt[i] -= fx;
        gzt[i] -= fz;
        gxw[i] += fx;
        gzw[i] += fz;
        gmt[i] += axle_x * lifted + height * pull;
        compressed[i] = compression;
        stretched[i] = stretch;
        spring_power[i] += spring * rate;
        damper_power[i] += damper * rate;
        guide_power[i] += held * stretching;
        guide_lost[i] += resisted * stretching;
    }
}

#endif
