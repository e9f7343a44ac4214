/* Contact of two faces: geometry, and forces on their carriers. Part of kernel.c only.
 *
 * n is the mean normal of the faces, t is normal to it, r_A and r_B are the face centres, P is
 * midway between them: closure = n . (r_A - r_B),   slip = t . (r_A - r_B). Both are exact
 * integrals of the relative velocity of the material points at P, where both forces act: power and
 * moment balance to rounding.
 */
#ifndef CZ_DYNAMICS_KERNEL_CONTACT_LINE_H
#define CZ_DYNAMICS_KERNEL_CONTACT_LINE_H

#include "dynamics/kernel_carrier.h"
#include "dynamics/kernel_chain_solve.h"

/* Mean normal of two faces, from side A to side B. */
typedef struct {
    _Alignas(64) CzRow x, z;
} Normal;

/* Geometry and force of a contact. */
typedef struct {
    const Normal *normal;
    _Alignas(64) CzRow closure;
    CzRow rate;
    CzRow slip_vertical; /* displacement of side A over side B across the normal */
    CzRow slip_rate;
    CzRow arm_x[2], arm_z[2]; /* point of action from the carriers' centres of gravity */
    CzRow force_x, force_z;   /* on side B */
} Contact;

/* ---- geometry ---- */

/* The normal turns at the mean rate of both carriers; where nothing tilts, it is along the track.
 */
static void line_up_normal(const CzBlock *d, CzCarrier a, CzCarrier b, Normal *restrict normal) {
    const double *restrict tilts = d->parameter.tilts;
    if (!d->has_tilts) {
        CZ_LANES (i) {
            normal->x[i] = 1.0;
            normal->z[i] = 0.0;
        }
        return;
    }
    CZ_LANES (i) {
        const double sum_x = a.turned->cosine[i] + b.turned->cosine[i];
        const double sum_z = tilts[i] * (a.turned->sine[i] + b.turned->sine[i]);
        const double size = sqrt(sum_x * sum_x + sum_z * sum_z);
        normal->x[i] = sum_x / size;
        normal->z[i] = sum_z / size;
    }
}

/* The vector between the face centres; level where nothing tilts. */
static inline CzPair pair_of_faces(CzCarrier a, CzCarrier b, const CzPairRows *at,
                                   const double *restrict tilts, size_t i) {
    CzPair pair = cz_pair_of(a, b, at, i);
    pair.z = tilts[i] * pair.z;
    return pair;
}

/* The closure alone. */
static void line_up_closure(const CzBlock *d, CzCarrier a, CzCarrier b, const CzPairRows *at,
                            const Normal *normal, double *restrict closure) {
    const double *restrict nx = normal->x, *restrict nz = normal->z;
    const double *restrict tilts = d->parameter.tilts;
    CZ_LANES (i) {
        const CzPair pair = pair_of_faces(a, b, at, tilts, i);
        closure[i] = -(nx[i] * pair.x + nz[i] * pair.z);
    }
}

static void line_up_contact(const CzBlock *d, CzCarrier a, CzCarrier b, const CzPairRows *at,
                            const Normal *normal, Contact *restrict contact) {
    const double *restrict normal_x = normal->x, *restrict normal_z = normal->z;
    const double *restrict tilts = d->parameter.tilts;
    contact->normal = normal;
    CZ_LANES (i) {
        const CzPair pair = pair_of_faces(a, b, at, tilts, i);
        const double nx = normal_x[i], nz = normal_z[i];
        const CzPair met = cz_met_midway(a, b, pair, i);
        const double vx = met.a.velocity_x - met.b.velocity_x;
        const double vz = met.a.velocity_z - met.b.velocity_z;
        contact->closure[i] = -(nx * pair.x + nz * pair.z);
        contact->rate[i] = nx * vx + nz * vz;
        contact->slip_vertical[i] = nz * pair.x - nx * pair.z;
        contact->slip_rate[i] = nx * vz - nz * vx;
        contact->arm_x[0][i] = met.a.arm_x;
        contact->arm_z[0][i] = met.a.arm_z;
        contact->arm_x[1][i] = met.b.arm_x;
        contact->arm_z[1][i] = met.b.arm_z;
    }
}

/* Slope of the faces. */
static void line_up_ramp(const Normal *restrict normal, double *restrict ramp) {
    CZ_LANES (i) {
        ramp[i] = fabs(normal->z[i]) / normal->x[i];
    }
}

/* ---- forces on the carriers ---- */

/* Applies normal force and vertical force of the contact to both carriers. */
static void put_contact(CzPlane *on_a, CzPlane *on_b, Contact *restrict contact,
                        const double *restrict normal, const double *restrict tangential,
                        double *restrict total) {
    const double *restrict normal_x = contact->normal->x, *restrict normal_z = contact->normal->z;
    CZ_LANES (i) {
        const double nx = normal_x[i], nz = normal_z[i];
        const double fx = normal[i] * nx - tangential[i] * nz;
        const double fz = normal[i] * nz + tangential[i] * nx;
        const CzPoint a = {.arm_x = contact->arm_x[0][i], .arm_z = contact->arm_z[0][i]};
        const CzPoint b = {.arm_x = contact->arm_x[1][i], .arm_z = contact->arm_z[1][i]};
        cz_put_force(on_a, i, a, (CzPush){-fx, -fz, 0.0});
        cz_put_force(on_b, i, b, (CzPush){fx, fz, 0.0});
        contact->force_x[i] = fx;
        contact->force_z[i] = fz;
        total[i] += fx;
    }
}

/* Forces on ends without mass pass directly into the body's section. */
static void put_into_sections(CzBlock *d, const Contact *contact) {
    add(d->published.section[1], d->parameter.slaved_ends[1], contact->force_x);
    add(d->pushed.section, d->constant.slaved_end_ahead, contact->force_x);
}

/* Drop of the force at the interface and in sections without end mass, in a step in which the force
 * of a chain fell; `normal` is the normal force of the element, `top` becomes its largest. */
static void put_drop(CzBlock *d, const Contact *restrict contact, const ChainState *restrict now,
                     const double *restrict normal, double *restrict top) {
    const double *restrict slaved = d->parameter.slaved_ends[1], *restrict slaved_ahead =
                                                                     d->constant.slaved_end_ahead;
    double *restrict drop = d->published.interface.drop,
                     *restrict section = d->published.section[1],
                     *restrict pushed = d->pushed.section;
    const double *restrict normal_x = contact->normal->x;
    CZ_LANES (i) {
        const double held =
            normal[i] / cz_larger(now->force[i], 1.0); /* with damping and lost overlap */
        const double more = held * cz_positive_part(now->top[i] - now->force[i]);
        const double lost = more * normal_x[i];
        top[i] = normal[i] + more;
        drop[i] += lost;
        section[i] += slaved[i] * lost;
        pushed[i] += slaved_ahead[i] * lost;
    }
}

/* Records for a budget the force, and its points of action relative to the end masses. */
static void note_faces(CzBudgetRows *budget, const Contact *contact) {
    memcpy(budget->face.x, contact->force_x, sizeof(CzRow));
    memcpy(budget->face.z, contact->force_z, sizeof(CzRow));
    memcpy(budget->face.arm_x, contact->arm_x, sizeof contact->arm_x);
    memcpy(budget->face.arm_z, contact->arm_z, sizeof contact->arm_z);
}

#endif
