/* Geometry and forces of an end of a car, between its end mass and the body. Part of kernel.c
 * only. */
#ifndef CZ_DYNAMICS_KERNEL_END_LINE_H
#define CZ_DYNAMICS_KERNEL_END_LINE_H

#include "dynamics/kernel_carrier.h"

/* Geometry of an end, except its shortening along the body's axis and its slip across it, which are
 * published. */
typedef struct {
    _Alignas(64) CzRow rate;      /* of the shortening */
    CzRow slip_rate;              /* across the axis */
    CzRow folded, folding;        /* pitch of the end mass against the body, and its rate */
    CzRow arm_x, arm_z;           /* point of action from the body's centre of gravity */
    CzRow mass_arm_x, mass_arm_z; /* from that of the end mass */
} EndLine;

/* Forces of its laws. */
typedef struct {
    _Alignas(64) CzRow across; /* guidance, downward on the end mass [N] */
    CzRow moment;              /* against its pitch [N m] */
} EndForces;

static inline double outwards(int end) {
    return end == 0 ? -1.0 : 1.0;
}

/* ---- geometry ---- */

static void line_up_end(CzBlock *d, int end, EndLine *restrict line) {
    const CzCarrier body = own_body(d), mass = own_end(d, end);
    const CzEndRows *restrict rows = &d->parameter.end[end];
    double *restrict stroke = d->published.end[end].stroke;
    double *restrict slip = d->published.end[end].slip_vertical;
    const double sign = outwards(end);
    CZ_LANES (i) {
        const double c = body.turned->cosine[i], s = body.turned->sine[i];
        const CzPoint b = cz_point_of(body, i, rows->x[i], rows->body_z[i]);
        const CzPoint e = cz_point_of(mass, i, 0.0, rows->mass_z[i]);
        const double qx = (mass.displacement->x[i] + e.arm_x) -
                          (body.displacement->x[i] + (b.arm_x - rows->x[i]));
        const double qz = (mass.displacement->z[i] + (e.arm_z - rows->mass_z[i])) -
                          (body.displacement->z[i] + (b.arm_z - rows->body_z[i]));
        const CzPoint p = cz_point_at(body, i, b.arm_x + qx, b.arm_z + qz);
        const double vx = e.velocity_x - p.velocity_x, vz = e.velocity_z - p.velocity_z;
        stroke[i] = -sign * (c * qx + s * qz);
        line->rate[i] = -sign * (c * vx + s * vz);
        slip[i] = c * qz - s * qx;
        line->slip_rate[i] = c * vz - s * vx;
        line->folded[i] = mass.displacement->pitch[i] - body.displacement->pitch[i];
        line->folding[i] = mass.rate->pitch[i] - body.rate->pitch[i];
        line->arm_x[i] = p.arm_x;
        line->arm_z[i] = p.arm_z;
        line->mass_arm_x[i] = e.arm_x;
        line->mass_arm_z[i] = e.arm_z;
    }
}

/* ---- forces on the carriers ---- */

static void put_end(CzBlock *d, int end, const EndLine *restrict line,
                    const EndForces *restrict forces) {
    const double sign = outwards(end);
    const CzTurned *restrict axis = &d->turned.body;
    const double *restrict force = d->published.end[end].force;
    double *restrict section = d->published.section[end];
    CzPlane *on_mass = &d->force.end[end], *on_body = &d->force.body;
    CZ_LANES (i) { /* on the end mass */
        const double c = axis->cosine[i], s = axis->sine[i];
        const double fx = sign * force[i] * c + forces->across[i] * s;
        const double fz = sign * force[i] * s - forces->across[i] * c;
        const CzPoint e = {.arm_x = line->mass_arm_x[i], .arm_z = line->mass_arm_z[i]};
        const CzPoint p = {.arm_x = line->arm_x[i], .arm_z = line->arm_z[i]};
        cz_put_force(on_mass, i, e, (CzPush){fx, fz, -forces->moment[i]});
        cz_put_force(on_body, i, p, (CzPush){-fx, -fz, forces->moment[i]});
        section[i] += force[i];
    }
}

/* Adds to a budget the forces of crush zone and guidance on the body. */
static void note_end(CzBlock *d, int end, const EndLine *restrict line,
                     const EndForces *restrict forces, double step) {
    const double sign = outwards(end);
    const CzTurned *restrict axis = &d->turned.body;
    const double *restrict force = d->published.end[end].force;
    CzBudgetRows *restrict budget = d->budget;
    CZ_LANES (i) {
        const double c = axis->cosine[i], s = axis->sine[i];
        const CzPoint p = {.arm_x = line->arm_x[i], .arm_z = line->arm_z[i]};
        const CzPush crush =
            cz_push_at_centre(p, (CzPush){-(sign * force[i] * c), -(sign * force[i] * s), 0.0});
        const CzPush guide = cz_push_at_centre(
            p, (CzPush){-(forces->across[i] * s), forces->across[i] * c, forces->moment[i]});
        budget->end_lift[end][i] += step * crush.z;
        budget->end_moment[end][i] += step * crush.pitch;
        budget->guide_lift[end][i] += step * guide.z;
        budget->guide_moment[end][i] += step * guide.pitch;
    }
}

#endif
