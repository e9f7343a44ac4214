/* Contact of two faces: geometry, and forces put on their carriers. Part of kernel.c only.
 *
 * n is the mean normal of the faces, t is normal to it, r_A and r_B are the face centres, P is
 * midway between them: closure = n . (r_A - r_B),   slip = t . (r_A - r_B) Both are exact integrals
 * of the relative velocity of the material points at P, where both forces act: power and moment
 * balance to rounding.
 */
#ifndef CZ_DYNAMICS_KERNEL_CONTACT_H
#define CZ_DYNAMICS_KERNEL_CONTACT_H

#include "dynamics/kernel_rows.h"

/* Parameter rows of a contact: face centres, gap and rise at t = 0. */
typedef struct {
    int x_a, z_a, x_b, z_b, gap, rise; /* CzParameter */
} ContactRows;

static void contact_geometry(CzBlock *d, const Carrier *a, const Carrier *b,
                             const ContactRows *rows) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict x_a = d->parameter[rows->x_a];
    const double *restrict z_a = d->parameter[rows->z_a];
    const double *restrict x_b = d->parameter[rows->x_b];
    const double *restrict z_b = d->parameter[rows->z_b];
    const double *restrict gap = d->parameter[rows->gap];
    const double *restrict rise = d->parameter[rows->rise];
    const double *restrict tilts = P(TILTS);
    const Carrier ca = *a, cb = *b;
    double *restrict closure = S(CLOSURE), *restrict rate = S(RATE);
    double *restrict slip = S(SLIP), *restrict slip_rate = S(SLIP_RATE);
    double *restrict normal_x = S(NORMAL_X), *restrict normal_z = S(NORMAL_Z);
    double *restrict arm_x_a = S(ARM_X_A), *restrict arm_z_a = S(ARM_Z_A);
    double *restrict arm_x_b = S(ARM_X_B), *restrict arm_z_b = S(ARM_Z_B);
    CZ_LANES (i, n) {
        /* Face centres from their carriers' centres of gravity, and from each other. */
        const double ax = x_a[i] * ca.cosine[i] - z_a[i] * ca.sine[i];
        const double az = x_a[i] * ca.sine[i] + z_a[i] * ca.cosine[i];
        const double bx = x_b[i] * cb.cosine[i] - z_b[i] * cb.sine[i];
        const double bz = x_b[i] * cb.sine[i] + z_b[i] * cb.cosine[i];
        const double dx = gap[i] + (cb.x[i] - ca.x[i]) + (bx - x_b[i]) - (ax - x_a[i]);
        const double dz =
            tilts[i] * (rise[i] + (cb.z[i] - ca.z[i]) + (bz - z_b[i]) - (az - z_a[i]));

        /* Mean normal: it turns at the mean rate of both carriers. */
        const double sum_x = ca.cosine[i] + cb.cosine[i];
        const double sum_z = tilts[i] * (ca.sine[i] + cb.sine[i]);
        const double size = sqrt(sum_x * sum_x + sum_z * sum_z);
        const double nx = sum_x / size, nz = sum_z / size;

        /* Point of action and relative velocity there. */
        const double pax = ax + 0.5 * dx, paz = az + 0.5 * dz;
        const double pbx = bx - 0.5 * dx, pbz = bz - 0.5 * dz;
        const double vx = (ca.vx[i] - paz * ca.turn[i]) - (cb.vx[i] - pbz * cb.turn[i]);
        const double vz = (ca.vz[i] + pax * ca.turn[i]) - (cb.vz[i] + pbx * cb.turn[i]);
        closure[i] = -(nx * dx + nz * dz);
        rate[i] = nx * vx + nz * vz;
        slip[i] = nz * dx - nx * dz;
        slip_rate[i] = nx * vz - nz * vx;
        normal_x[i] = nx;
        normal_z[i] = nz;
        arm_x_a[i] = pax;
        arm_z_a[i] = paz;
        arm_x_b[i] = pbx;
        arm_z_b[i] = pbz;
    }
}

/* Generalised force rows of a carrier. */
typedef struct {
    double *x, *z, *pitch;
} CarrierForce;

static CarrierForce three_rows(CzRow *row) {
    return (CarrierForce){row[0], row[1], row[2]};
}

/* The body or end mass at side A or B of an interface. What an interface pushes on the car ahead
 * has rows of its own, which that car takes over once all interfaces are done. */
static CarrierForce body_force(CzBlock *d, int side) {
    return three_rows(side == 0 ? &d->force[CZ_DOF_BODY_X] : &d->scratch[CZ_S_PUSHED_X]);
}

static CarrierForce end_force(CzBlock *d, int side) {
    return three_rows(side == 0 ? &d->force[CZ_DOF_END_X_FRONT] : &d->scratch[CZ_S_PUSHED_END_X]);
}

/* Puts a force (fx, fz) at an arm on a carrier; sign turns it round for side B. */
static inline void put_force(size_t n, const CarrierForce *on, double sign,
                             const double *restrict fx, const double *restrict fz,
                             const double *restrict arm_x, const double *restrict arm_z) {
    double *restrict gx = on->x, *restrict gz = on->z, *restrict moment = on->pitch;
    CZ_LANES (i, n) {
        gx[i] += sign * fx[i];
        gz[i] += sign * fz[i];
        moment[i] += sign * (arm_x[i] * fz[i] - arm_z[i] * fx[i]);
    }
}

/* Puts normal force and slip force of the contact on both carriers. The components are left in
 * CURVE_VALUE (x) and CURVE_SLOPE (z) as they act on side B. */
static void contact_forces(CzBlock *d, const CarrierForce *on_a, const CarrierForce *on_b,
                           const double *restrict normal, const double *restrict tangential) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict nx = S(NORMAL_X), *restrict nz = S(NORMAL_Z);
    double *restrict fx = S(CURVE_VALUE), *restrict fz = S(CURVE_SLOPE);
    double *restrict total = S(INTERFACE_FORCE);
    CZ_LANES (i, n) {
        fx[i] = normal[i] * nx[i] - tangential[i] * nz[i];
        fz[i] = normal[i] * nz[i] + tangential[i] * nx[i];
        total[i] += fx[i];
    }
    put_force(n, on_a, -1.0, fx, fz, S(ARM_X_A), S(ARM_Z_A));
    put_force(n, on_b, 1.0, fx, fz, S(ARM_X_B), S(ARM_Z_B));
}

#endif
