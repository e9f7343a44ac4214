/* Couplers: a massless strut between two pivots, whose length is a series chain of buffers, tubes
 * and shear-offs, and whose ends turn against hinges. Part of kernel.c only.
 *
 *   closure = free length - |r_B - r_A|,   force along the current line,   theta its angle;
 *   where neither car can tilt, or one is a wall, closure and force are those along the track;
 *   where it has sheared off, those along the mean normal of the cars
 *   hinge i:  M_i = engaged * (slider(theta - beta_i) + swing stop),  reacted by transverse forces
 * (M_A + M_B) / length
 */
#ifndef CZ_DYNAMICS_KERNEL_COUPLER_H
#define CZ_DYNAMICS_KERNEL_COUPLER_H

#include "dynamics/kernel_coupler_chain.h"
#include "dynamics/kernel_contact.h"
#include "laws/slider.h"
#include "model/kinks.h"

#define ENGAGING_CLOSURE                                                                           \
    0.005 /* closure over which faces that are not coupled take up hinge moments [m] (ours) */

/* Chooses one row of the carrier: the end mass's where the pivot is fixed to it, else the body's.
 */
static inline void choose(const double *restrict on_end, const double *restrict end,
                          const double *restrict body, double *restrict chosen) {
    const size_t n = CZ_LANE_BLOCK;
    CZ_LANES (i, n) {
        chosen[i] = on_end[i] > 0.5 ? end[i] : body[i];
    }
}

/* Rows of the coupler's carrier: side A is this car's front, side B the rear of the car ahead. */
static Carrier coupler_carrier(CzBlock *d, int side) {
    const double *on_end = P_AT(COUPLER_ON_END_A, side);
    const Carrier end = end_carrier(d, side), body = body_carrier(d, side);
    CzRow *row = &d->scratch[side == 0 ? CZ_S_CARRIER_A : CZ_S_CARRIER_B];
    choose(on_end, end.x, body.x, row[0]);
    choose(on_end, end.z, body.z, row[1]);
    choose(on_end, end.pitch, body.pitch, row[2]);
    choose(on_end, end.vx, body.vx, row[3]);
    choose(on_end, end.vz, body.vz, row[4]);
    choose(on_end, end.turn, body.turn, row[5]);
    choose(on_end, end.cosine, body.cosine, row[6]);
    choose(on_end, end.sine, body.sine, row[7]);
    return eight_rows(row);
}

/* Line between the pivots: closure, rate, direction, angle's rate (in SLIP_RATE), length, arms. It
 * lies along the track, whatever the closure, where nothing tilts. */
static void coupler_geometry(CzBlock *d, const Carrier *a, const Carrier *b) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict x_a = P(PIVOT_X_A), *restrict z_a = P(PIVOT_Z_A);
    const double *restrict x_b = P(PIVOT_X_B), *restrict z_b = P(PIVOT_Z_B);
    const double *restrict distance = P(PIVOT_DISTANCE), *restrict rise = P(PIVOT_RISE);
    const double *restrict free_length = P(COUPLER_LENGTH);
    const double *restrict tilts = P(TILTS);
    const Carrier ca = *a, cb = *b;
    double *restrict closure = S(CLOSURE), *restrict rate = S(RATE), *restrict turn = S(SLIP_RATE);
    double *restrict direction_x = S(NORMAL_X), *restrict direction_z = S(NORMAL_Z),
                     *restrict inverse_length = S(INVERSE_LENGTH);
    double *restrict arm_x_a = S(ARM_X_A), *restrict arm_z_a = S(ARM_Z_A);
    double *restrict arm_x_b = S(ARM_X_B), *restrict arm_z_b = S(ARM_Z_B);
    CZ_LANES (i, n) {
        const double ax = x_a[i] * ca.cosine[i] - z_a[i] * ca.sine[i];
        const double az = x_a[i] * ca.sine[i] + z_a[i] * ca.cosine[i];
        const double bx = x_b[i] * cb.cosine[i] - z_b[i] * cb.sine[i];
        const double bz = x_b[i] * cb.sine[i] + z_b[i] * cb.cosine[i];
        const double dx = distance[i] + (cb.x[i] - ca.x[i]) + (bx - x_b[i]) - (ax - x_a[i]);
        const double dz =
            tilts[i] * (rise[i] + (cb.z[i] - ca.z[i]) + (bz - z_b[i]) - (az - z_a[i]));
        const double vx = (cb.vx[i] - bz * cb.turn[i]) - (ca.vx[i] - az * ca.turn[i]);
        const double vz = tilts[i] * ((cb.vz[i] + bx * cb.turn[i]) - (ca.vz[i] + ax * ca.turn[i]));
        const double apart = sqrt(dx * dx + dz * dz);
        const double strut = dx < 0.0 ? -apart : apart; /* the run fails where pivots pass */
        const double l = tilts[i] > 0.0 ? strut : dx;
        const double inverse = 1.0 / (tilts[i] > 0.0 ? strut : 1.0);
        const double nx = tilts[i] > 0.0 ? dx * inverse : 1.0, nz = dz * inverse;
        closure[i] = free_length[i] - l;
        rate[i] = -(nx * vx + nz * vz);
        turn[i] = (nx * vz - nz * vx) * inverse;
        direction_x[i] = nx;
        direction_z[i] = nz;
        inverse_length[i] = inverse;
        arm_x_a[i] = ax;
        arm_z_a[i] = az;
        arm_x_b[i] = bx;
        arm_z_b[i] = bz;
    }
}

/* Where a coupler has sheared off its line no longer turns about two pivots: from there on it
 * pushes like a face, midway between them and along the mean normal of the cars, which holds where
 * the pivots pass each other too. */
static void released_geometry(CzBlock *d, const Carrier *a, const Carrier *b) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict travel_a = M(SHEAR_A), *restrict travel_b = M(SHEAR_B);
    const double *restrict softening_a = P(SHEAR_SOFTENING_A), *restrict softening_b =
                                                                   P(SHEAR_SOFTENING_B);
    const double *restrict tilts = P(TILTS), *restrict rise = P(PIVOT_RISE);
    const double *restrict x_a = P(PIVOT_X_A), *restrict x_b = P(PIVOT_X_B);
    const double *restrict z_a = P(PIVOT_Z_A), *restrict z_b = P(PIVOT_Z_B);
    const double *restrict distance = P(PIVOT_DISTANCE), *restrict along = P(COUPLER_ALONG);
    const Carrier ca = *a, cb = *b;
    double *restrict closure = S(CLOSURE), *restrict rate = S(RATE), *restrict turn = S(SLIP_RATE);
    double *restrict direction_x = S(NORMAL_X), *restrict direction_z = S(NORMAL_Z),
                     *restrict inverse_length = S(INVERSE_LENGTH);
    double *restrict arm_x_a = S(ARM_X_A), *restrict arm_z_a = S(ARM_Z_A);
    double *restrict arm_x_b = S(ARM_X_B), *restrict arm_z_b = S(ARM_Z_B);
    CZ_LANES (i, n) {
        const double gone_a = travel_a[i] >= softening_a[i] ? tilts[i] : 0.0;
        const double gone = travel_b[i] >= softening_b[i] ? tilts[i] : gone_a;
        const double ax = arm_x_a[i], az = arm_z_a[i], bx = arm_x_b[i], bz = arm_z_b[i];
        const double dx = distance[i] + (cb.x[i] - ca.x[i]) + (bx - x_b[i]) - (ax - x_a[i]);
        const double dz = rise[i] + (cb.z[i] - ca.z[i]) + (bz - z_b[i]) - (az - z_a[i]);
        const double tilt = 0.5 * (ca.pitch[i] + cb.pitch[i]);
        const double nx = 1.0 / sqrt(1.0 + tilt * tilt), nz = tilt * nx;
        const double pax = ax + 0.5 * dx, paz = az + 0.5 * dz;
        const double pbx = bx - 0.5 * dx, pbz = bz - 0.5 * dz;
        const double vx = (ca.vx[i] - paz * ca.turn[i]) - (cb.vx[i] - pbz * cb.turn[i]);
        const double vz = (ca.vz[i] + pax * ca.turn[i]) - (cb.vz[i] + pbx * cb.turn[i]);
        closure[i] = gone > 0.0 ? along[i] - (nx * dx + nz * dz) : closure[i];
        rate[i] = gone > 0.0 ? nx * vx + nz * vz : rate[i];
        turn[i] = gone > 0.0 ? 0.0 : turn[i];
        direction_x[i] = gone > 0.0 ? nx : direction_x[i];
        direction_z[i] = gone > 0.0 ? nz : direction_z[i];
        inverse_length[i] = gone > 0.0 ? 1.0 : inverse_length[i];
        arm_x_a[i] = gone > 0.0 ? pax : ax;
        arm_z_a[i] = gone > 0.0 ? paz : az;
        arm_x_b[i] = gone > 0.0 ? pbx : bx;
        arm_z_b[i] = gone > 0.0 ? pbz : bz;
    }
}

static int some_are_released(const CzBlock *d) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict travel_a = M(SHEAR_A), *restrict travel_b = M(SHEAR_B);
    double n_released = 0.0;
    _Pragma("omp simd reduction(+ : n_released)") for (size_t i = 0; i < n; ++i) {
        n_released += travel_a[i] + travel_b[i] > 0.0 ? 1.0 : 0.0;
    }
    return n_released > 0.0;
}

/* Whether the evaluation at hand leaves the memory of the couplers as it was. */
static int couplers_remember(const CzBlock *d) {
    const int first = CZ_M_COUPLER_FORCE, last = CZ_M_TUBE_ENERGY_B;
    return memcmp(d->memory[first], d->next_memory[first],
                  (size_t)(last - first + 1) * sizeof(CzRow)) == 0;
}

/* How much the faces of a coupler hold each other against swinging, 0 to 1: fully where they are
 * coupled and whole, not at all where they are apart or sheared off. */
static void coupler_engagement(CzBlock *d) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict exists = P(COUPLER), *restrict coupled = P(COUPLED);
    const double *restrict closure = S(CLOSURE), *restrict damage = S(DAMAGE);
    double *restrict engaged = S(ENGAGED);
    CZ_LANES (i, n) {
        const double mated = cz_fade_in(cz_positive_part(closure[i]), ENGAGING_CLOSURE);
        engaged[i] = exists[i] * (coupled[i] > 0.5 ? 1.0 : mated) * (1.0 - damage[i]);
    }
}

/* Moment of the hinge of one side on its carrier, into SPRING_UP of the side; its power is added
 * up. */
static void hinge_moment(CzBlock *d, int side, const Carrier *carrier) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict stiffness = P_AT(HINGE_STIFFNESS_A, side), *restrict capacity = P_AT(
                                                                          HINGE_MOMENT_A, side);
    const double *restrict range = P_AT(SWING_STOP_A, side), *restrict stop =
                                                                 P_AT(SWING_STIFFNESS_A, side);
    const double *restrict compliance = C_AT(HINGE_COMPLIANCE_A, side);
    const double *restrict engaged = S(ENGAGED), *restrict rest = C(HINGE_REST),
                           *restrict nz = S(NORMAL_Z);
    const double *restrict line_turn = S(SLIP_RATE), *restrict yielded = M_AT(HINGE_A, side);
    const double *restrict pitch = carrier->pitch, *restrict turn = carrier->turn;
    double *restrict next = NEXT_AT(HINGE_A, side), *restrict moment = S_AT(SPRING_UP_A, side);
    double *restrict power = POWER_AT(HINGE_A, side), *restrict kept = S_AT(SWING_A, side);
    CZ_LANES (i, n) {
        const double angle = nz[i] * (1.0 + nz[i] * nz[i] * (1.0 / 6.0));
        const double swing = angle - rest[i] - pitch[i];
        const CzSliderResponse hinge =
            cz_slider_of(stiffness[i], compliance[i], capacity[i], swing, yielded[i]);
        next[i] = engaged[i] >= 1.0 ? hinge.offset : yielded[i];
        kept[i] = engaged[i] * swing;
        moment[i] = engaged[i] * (hinge.force + cz_stop(stop[i], range[i], swing));
        power[i] += moment[i] * (line_turn[i] - turn[i]);
    }
}

/* Adds the share of a row that goes to the end mass or to the body. */
static inline void share(size_t n, const double *restrict on_end, const double *restrict row,
                         double sign, double *restrict end, double *restrict body) {
    CZ_LANES (i, n) {
        const double to_end = on_end[i] * row[i];
        end[i] += sign * to_end;
        body[i] += sign * (row[i] - to_end);
    }
}

/* Puts strut force and hinge moments on the carriers, and the largest strut force of the step into
 * the sections behind them. */
static void coupler_forces(CzBlock *d) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict force = S(CHAIN_FORCE), *restrict inverse_length = S(INVERSE_LENGTH),
                           *restrict rate = S(RATE);
    const double *restrict nx = S(NORMAL_X), *restrict nz = S(NORMAL_Z);
    const double *restrict moment_a = S(SPRING_UP_A), *restrict moment_b = S(SPRING_UP_B);
    double *restrict fx = S(CURVE_VALUE), *restrict fz = S(CURVE_SLOPE),
                     *restrict total = S(INTERFACE_FORCE);
    const double *restrict tilts = P(TILTS);
    const double *restrict top = S(COUPLER_TOP), *restrict more = S(RELEASE_MORE);
    double *restrict kept = S(COUPLER_FORCE), *restrict power = POWER(COUPLER);
    double *restrict push = S(COUPLER_PUSH), *restrict drop = S(STEP_DROP);
    CZ_LANES (i, n) { /* on side B */
        const double transverse = tilts[i] * (moment_a[i] + moment_b[i]) * inverse_length[i];
        const double pushing = force[i] + more[i];
        const double at_end = force[i] * nx[i] + transverse * nz[i];
        fx[i] = pushing * nx[i] + transverse * nz[i];
        fz[i] = pushing * nz[i] - transverse * nx[i];
        const double lost = top[i] > 0.0 ? cz_positive_part(top[i] - force[i]) * nx[i] : 0.0;
        drop[i] += lost;
        push[i] = at_end + lost;
        total[i] += at_end;
        kept[i] = force[i];
        power[i] += pushing * rate[i];
    }
    double *turning = S(LARGEST);
    for (int side = 0; side < 2; ++side) {
        const double sign = side == 0 ? -1.0 : 1.0;
        const double *restrict arm_x = side == 0 ? S(ARM_X_A) : S(ARM_X_B);
        const double *restrict arm_z = side == 0 ? S(ARM_Z_A) : S(ARM_Z_B);
        const double *restrict moment = side == 0 ? moment_a : moment_b;
        const double *restrict on_end = P_AT(COUPLER_ON_END_A, side);
        double *restrict moments = turning;
        CZ_LANES (i, n) {
            moments[i] = sign * (arm_x[i] * fz[i] - arm_z[i] * fx[i]) + moment[i];
        }
        const CarrierForce end = end_force(d, side), body = body_force(d, side);
        double *section = side == 0 ? S(SECTION_FRONT) : S(PUSHED_SECTION);
        share(n, on_end, fx, sign, end.x, body.x);
        share(n, on_end, fz, sign, end.z, body.z);
        share(n, on_end, moments, 1.0, end.pitch, body.pitch);
        share(n, on_end, push, 1.0, S(UNUSED), section);
    }
}

/* Row of the chosen carrier of a coupler's pivot. */
#define CHOSEN(on_end, end, body) ((on_end) > 0.5 ? (end) : (body))

/* Whether the last evaluation changed nothing and no coupler has come within reach since. The
 * pivots' distance along the track is never more than that along the coupler. */
static int couplers_are_apart(const CzBlock *d) {
    const size_t n = CZ_LANE_BLOCK;
    if (!d->couplers_rest)
        return 0;
    const Carrier ea = end_carrier(d, 0), ba = body_carrier(d, 0);
    const Carrier eb = end_carrier(d, 1), bb = body_carrier(d, 1);
    const double *restrict on_a = P(COUPLER_ON_END_A), *restrict on_b = P(COUPLER_ON_END_B);
    const double *restrict x_a = P(PIVOT_X_A), *restrict z_a = P(PIVOT_Z_A);
    const double *restrict x_b = P(PIVOT_X_B), *restrict z_b = P(PIVOT_Z_B);
    const double *restrict distance = P(PIVOT_DISTANCE), *restrict free_length = P(COUPLER_LENGTH);
    const double *restrict reach = d->coupler_reach;
    double n_near = 0.0;
    _Pragma("omp simd reduction(+ : n_near)") for (size_t i = 0; i < n; ++i) {
        const double ax = x_a[i] * CHOSEN(on_a[i], ea.cosine[i], ba.cosine[i]) -
                          z_a[i] * CHOSEN(on_a[i], ea.sine[i], ba.sine[i]);
        const double bx = x_b[i] * CHOSEN(on_b[i], eb.cosine[i], bb.cosine[i]) -
                          z_b[i] * CHOSEN(on_b[i], eb.sine[i], bb.sine[i]);
        const double way = CHOSEN(on_b[i], eb.x[i], bb.x[i]) - CHOSEN(on_a[i], ea.x[i], ba.x[i]);
        const double along = distance[i] + way + (bx - x_b[i]) - (ax - x_a[i]);
        n_near += free_length[i] - along <= reach[i] ? 0.0 : 1.0; /* not a number is near */
    }
    return n_near == 0.0;
}

/* The same by the closures themselves: that of a released coupler is not along the line. */
static int closures_are_apart(const CzBlock *d) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict closure = S(CLOSURE), *restrict reach = d->coupler_reach;
    double n_near = d->couplers_rest ? 0.0 : 1.0;
    _Pragma("omp simd reduction(+ : n_near)") for (size_t i = 0; i < n; ++i) {
        n_near += closure[i] <= reach[i] ? 0.0 : 1.0;
    }
    return n_near == 0.0;
}

/* Closure of the couplers that are there. */
static void keep_closure(CzBlock *d) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict exists = P(COUPLER), *restrict closure = S(CLOSURE);
    double *restrict kept = S(COUPLER_CLOSURE);
    CZ_LANES (i, n) {
        kept[i] = exists[i] * closure[i];
    }
}

/* All couplers; 0 when none was at work. Where they changed nothing and are still apart they are
 * left out: no force, and both copies of their memory hold what they would leave. */
static int couplers(CzBlock *d, double step) {
    const int released = some_are_released(d);
    if (!released && couplers_are_apart(d)) {
        memcpy(S(COUPLER_FORCE), M(COUPLER_FORCE), sizeof(CzRow));
        return 0;
    }
    const Carrier a = coupler_carrier(d, 0);
    const Carrier b = coupler_carrier(d, 1);
    coupler_geometry(d, &a, &b);
    if (released)
        released_geometry(d, &a, &b);
    keep_closure(d);
    if (released && closures_are_apart(d)) {
        memcpy(S(COUPLER_FORCE), M(COUPLER_FORCE), sizeof(CzRow));
        return 0;
    }
    const int slack = coupler_chain_force(d, step);
    coupler_engagement(d);
    hinge_moment(d, 0, &a);
    hinge_moment(d, 1, &b);
    d->couplers_rest = slack && couplers_remember(d) && !d->leaves_nothing_out;
    coupler_forces(d);
    return 1;
}

#endif
