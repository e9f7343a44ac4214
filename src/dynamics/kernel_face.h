/* Anti-climbers, or the bare ends: contact of faces, along the normal a series chain of
 * anti-climbers and crush zones without end mass, across it ribs and friction. Part of kernel.c
 * only. */
#ifndef CZ_DYNAMICS_KERNEL_FACE_H
#define CZ_DYNAMICS_KERNEL_FACE_H

#include "dynamics/kernel_contact_line.h"
#include "dynamics/kernel_massless.h"
#include "dynamics/kernel_snap.h"
#include "laws/face.h"
#include "laws/ribs.h"
#include "laws/slider.h"

/* ---- along the normal ---- */

static void list_massless(const CzBlock *d, int side, const CzMasslessMemory *memory,
                          CzMasslessMemory *next, Massless *massless) {
    const CzFaceRows *rows = &d->parameter.face;
    massless->exists = rows->side[side].has_massless;
    massless->rows = &rows->side[side].massless;
    massless->compliance = d->constant.massless_compliance[side];
    massless->second_compliance = d->constant.massless_second_compliance[side];
    massless->curve = &d->curve.massless[side];
    massless->memory = memory;
    massless->next = next;
}

static void list_faces(CzBlock *d, const Contact *contact, double step, FaceChain *of) {
    const CzFaceRows *rows = &d->parameter.face;
    const CzFaceMemory *memory = &d->memory->face;
    CzFaceMemory *next = &d->next_memory->face;
    Chain *chain = &of->chain;
    begin_chain(chain, &crush_zones, contact->closure, step, memory->force, next->force);
    chain->compliance = rows->compliance;
    for (int side = 0; side < 2; ++side) {
        const CzMasslessMemory *before = &memory->side[side].massless;
        CzMasslessMemory *after = &next->side[side].massless;
        list_massless(d, side, before, after, &of->massless[side]);
        chain->spring[side].is_missing = !d->has_massless[side];
        chain->spring[side].stroke = before->stroke;
        chain->spring[side].next = after->stroke;
        list_energies(&chain->spring[side], before->energy, after->energy,
                      memory->side[side].energy, next->side[side].energy);
        list_collapsing(&chain->plastic[side], &d->curve.face[side], rows->side[side].rate,
                        memory->side[side].stroke, next->side[side].stroke);
        chain->plastic[side].rise = of->rise[side];
    }
}

/* The closing speed at first contact is frozen; the rise of the strengths of both sides follows
 * from it. */
static void freeze_speed(const Contact *restrict contact, const double *restrict speed,
                         double *restrict next, const double *restrict factor_behind,
                         const double *restrict factor_ahead, CzRow *restrict rise) {
    CZ_LANES (i) {
        next[i] = cz_first_speed(contact->closure[i], contact->rate[i], speed[i]);
        rise[0][i] = factor_behind[i] * next[i];
        rise[1][i] = factor_ahead[i] * next[i];
    }
}

/* Normal force of the faces: chain and damping, of which less remains as the overlap is lost.
 */
static void press_faces(CzBlock *d, const Contact *restrict contact, const double *restrict chain) {
    const CzFaceRows *restrict rows = &d->parameter.face;
    const double *restrict lost_before = d->memory->face.lost;
    double *restrict lost_next = d->next_memory->face.lost;
    double *restrict normal = d->published.face.force, *restrict remaining =
                                                           d->published.face.remaining;
    double *restrict power = d->power->face, *restrict lost = d->power->face_damping;
    CZ_LANES (i) {
        const CzFaceLaw law = {rows->damping[i], rows->overlap[i], rows->rib_pitch[i]};
        const double rate = contact->rate[i];
        const double offset = contact->slip_vertical[i] + rows->eccentricity[i];
        const CzFaceResponse response =
            cz_face(&law, chain[i], contact->closure[i], rate, offset, lost_before[i]);
        lost_next[i] = response.lost;
        remaining[i] = response.remaining;
        normal[i] = response.normal;
        power[i] += response.held * chain[i] * rate;
        lost[i] += response.held * response.damped * rate;
    }
}

/* Corrects the energies by the share of the chain's mean force that the faces still transmit:
 * members of released faces move without work. */
static void count_held(const CzFaceMemory *restrict memory, CzFaceMemory *restrict next,
                       const double *restrict compliance) {
    CZ_LANES (i) {
        const double force = next->force[i], last = memory->force[i];
        const double held = (1.0 - memory->lost[i]) * last + (1.0 - next->lost[i]) * force;
        const double share = held / cz_larger(last + force, 1e-30);
        next->strain[i] = memory->strain[i] + 0.5 * held * compliance[i] * (force - last);
        for (int side = 0; side < 2; ++side) {
            const double face = memory->side[side].energy[i];
            const double massless = memory->side[side].massless.energy[i];
            next->side[side].energy[i] = face + share * (next->side[side].energy[i] - face);
            next->side[side].massless.energy[i] =
                massless + share * (next->side[side].massless.energy[i] - massless);
        }
    }
}

/* ---- across it ---- */

/* Vertical force of the faces: they stick, by ribs and friction, up to a capacity. */
static void grip_faces(CzBlock *d, const Contact *restrict contact) {
    const CzFaceRows *restrict rows = &d->parameter.face;
    const double *restrict compliance = d->constant.grip_compliance;
    const double *restrict offset = d->memory->grip.slip_vertical;
    const CzFaceMemory *restrict memory = &d->memory->face;
    CzFaceMemory *restrict next = &d->next_memory->face;
    double *restrict next_offset = d->next_memory->grip.slip_vertical;
    const double *restrict normal = d->published.face.force;
    double *restrict ready = d->published.face.ready;
    double *restrict tangential = d->published.face.demand_vertical;
    double *restrict power = d->power->face_sliding;
    CZ_LANES (i) {
        const CzRibsLaw law = {rows->rib_pitch[i], rows->overlap[i], rows->rib_depth[i],
                               rows->rib_capacity[i], rows->friction[i]};
        const double slip = contact->slip_vertical[i];
        const CzRibsResponse grip =
            cz_ribs(&law, slip, contact->closure[i], normal[i], memory->sheared[i]);
        const CzSliderResponse held = cz_slider_of(rows->stiffness_vertical[i], compliance[i],
                                                   grip.capacity, slip, offset[i]);
        const double slid = grip.engaged * fabs(held.offset - offset[i]);
        ready[i] = grip.ready;
        next_offset[i] = held.offset;
        next->slipped[i] = memory->slipped[i] + slid;
        next->sheared[i] = memory->sheared[i] + grip.mesh * slid;
        tangential[i] = held.force;
        power[i] += held.force * contact->slip_rate[i];
    }
}

/* ---- faces that are apart ---- */

/* Whether no chain pushes. Then the sum of its members at zero force is the closure up to which
 * this remains so; for faces that never touched it is first contact, whose speed must be stored. */
static int faces_are_slack(CzBlock *d, const Chain *chain) {
    const double *restrict closure = chain->closure, *restrict speed = d->memory->face.speed;
    double *restrict reach = d->face_reach;
    if (!is_slack(&chain->now))
        return 0;
    CurveAt sum;
    unbalance(chain, chain->now.force, &sum);
    CZ_LANES (i) {
        const double of_chain = closure[i] + sum.value[i] - REACH_MARGIN;
        reach[i] = cz_smaller(of_chain, speed[i] > 0.0 ? of_chain : -REACH_MARGIN);
    }
    return !is_within(closure, reach);
}

/* Whether this evaluation leaves the memory of the faces unchanged, except where the ribs will
 * seat. */
static int faces_remember(const CzBlock *d) {
    return memcmp(&d->memory->face, &d->next_memory->face, sizeof d->memory->face) == 0;
}

/* For faces that are apart: no force, and ribs that will seat where the faces meet. Both copies of
 * their other memory are up to date. */
static void leave_faces(CzBlock *d, const Contact *contact) {
    memset(d->published.face.force, 0, sizeof(CzRow));
    if (!d->can_climb)
        return;
    memset(d->published.face.demand_vertical, 0, sizeof(CzRow));
    memset(d->published.face.ready, 0, sizeof(CzRow));
    memcpy(d->next_memory->grip.slip_vertical, contact->slip_vertical, sizeof(CzRow));
}

/* Solves the chain and moves its members. */
static void push_faces(CzBlock *d, const Contact *contact, FaceChain *of) {
    Chain *chain = &of->chain;
    memset(chain->now.lowest, 0, sizeof(CzRow));
    CZ_LANES (i) {
        chain->now.active[i] = 1.0;
    }
    const int settled = solve_chain(chain, &d->published);
    move_members(chain);
    for (int side = 0; side < 2; ++side)
        if (!chain->spring[side].is_missing)
            keep_massless(&of->massless[side]);
    d->faces_rest =
        settled && faces_are_slack(d, chain) && faces_remember(d) && !d->leaves_nothing_out;
    press_faces(d, contact, chain->now.force);
}

/* Evaluates all anti-climbers and bare ends. */
static void faces(const CzDynamics *dynamics, int index, const Normal *normal, double step) {
    CzBlock *d = &dynamics->block[index];
    Contact contact;
    line_up_contact(d, end_at(d, 0), end_at(d, 1), &d->parameter.face.contact, normal, &contact);
    if (d->faces_rest && !is_within(contact.closure, d->face_reach)) {
        leave_faces(d, &contact);
        return;
    }
    FaceChain of;
    memcpy(d->published.face.closure, contact.closure, sizeof(CzRow));
    list_faces(d, &contact, step, &of);
    freeze_speed(&contact, d->memory->face.speed, d->next_memory->face.speed,
                 d->parameter.face.side[0].speed_factor, d->parameter.face.side[1].speed_factor,
                 of.rise);
    push_faces(d, &contact, &of);
    if (of.chain.falls) {
        chain_top(&of.chain);
        put_drop(d, &contact, &of.chain.now, d->published.face.force, d->published.face.top);
    }
    count_held(&d->memory->face, &d->next_memory->face, d->parameter.face.compliance);
    if (d->has_tilts)
        line_up_ramp(normal, d->published.face.ramp);
    if (d->can_climb)
        grip_faces(d, &contact);
    put_contact(force_on_end(d, 0), force_on_end(d, 1), &contact, d->published.face.force,
                d->published.face.demand_vertical, d->published.interface.force);
    put_into_sections(d, &contact);
    settle_snaps(dynamics, index, &of);
    if (d->budget != NULL)
        note_faces(d->budget, &contact);
}

#endif
