/* Side buffers: contact of plates, along the normal a series chain of buffers and crash elements,
 * across it friction. Part of kernel.c only. */
#ifndef CZ_DYNAMICS_KERNEL_SIDE_BUFFERS_H
#define CZ_DYNAMICS_KERNEL_SIDE_BUFFERS_H

#include "dynamics/kernel_buffer.h"
#include "dynamics/kernel_contact_line.h"
#include "dynamics/kernel_face.h"
#include "dynamics/stored.h"
#include "laws/slider.h"

/* Rise of the strengths of anti-climbers in the place of crash elements, by the closing speed at
 * first contact, which is frozen. */
typedef struct {
    _Alignas(64) CzRow of[2];
} PlateRise;

static void list_side_buffers(CzBlock *d, const Contact *contact, double step,
                              const PlateRise *rise, BufferChain *of) {
    const CzSideBufferRows *rows = &d->parameter.side_buffers;
    const CzSideBufferMemory *memory = &d->memory->side_buffers;
    CzSideBufferMemory *next = &d->next_memory->side_buffers;
    begin_chain(&of->chain, &buffers, contact->closure, step, memory->force, next->force);
    of->chain.compliance = rows->compliance;
    for (int side = 0; side < 2; ++side) {
        list_buffer(of, side,
                    (Buffer){&rows->side[side].buffer, &d->curve.side_buffer[side],
                             d->constant.side_compliance[side], &memory->side[side].buffer,
                             &next->side[side].buffer});
        list_energies(&of->chain.spring[side], memory->side[side].energy, next->side[side].energy,
                      memory->side[side].tube_energy, next->side[side].tube_energy);
        list_collapsing(&of->chain.plastic[side], &d->curve.side_tube[side],
                        rows->side[side].tube_rate, memory->side[side].tube, next->side[side].tube);
        of->chain.plastic[side].rise = rise->of[side];
    }
}

/* Friction of the plates. */
static void slide_plates(CzBlock *d, const Contact *restrict contact,
                         const double *restrict force) {
    const double *restrict friction = d->parameter.side_buffers.friction;
    const double *restrict offset = d->memory->side_buffers.slip_vertical;
    double *restrict next = d->next_memory->side_buffers.slip_vertical;
    double *restrict kept = d->published.side_buffers.force;
    double *restrict tangential = d->published.side_buffers.sliding_vertical;
    double *restrict power = d->power->side_buffers, *restrict sliding = d->power->side_sliding;
    CZ_LANES (i) {
        const CzSliderResponse grip = cz_slider(CZ_PLATE_STIFFNESS, friction[i] * force[i],
                                                contact->slip_vertical[i], offset[i]);
        next[i] = grip.offset;
        kept[i] = force[i];
        tangential[i] = grip.force;
        power[i] += force[i] * contact->rate[i];
        sliding[i] += grip.force * contact->slip_rate[i];
    }
}

/* Evaluates all side buffers, which act on the end masses, in series with the crush zones. */
static void side_buffers(CzBlock *d, const Normal *normal, double step) {
    const CzSideBufferRows *rows = &d->parameter.side_buffers;
    Contact contact;
    PlateRise rise;
    BufferChain of;
    line_up_contact(d, end_at(d, 0), end_at(d, 1), &rows->contact, normal, &contact);
    memcpy(d->published.side_buffers.closure, contact.closure, sizeof(CzRow));
    freeze_speed(&contact, d->memory->side_buffers.speed, d->next_memory->side_buffers.speed,
                 rows->side[0].speed_factor, rows->side[1].speed_factor, rise.of);
    list_side_buffers(d, &contact, step, &rise, &of);
    memset(of.chain.now.lowest, 0, sizeof(CzRow));
    memcpy(of.chain.now.active, rows->exists, sizeof(CzRow));
    solve_chain(&of.chain, &d->published);
    move_members(&of.chain);
    keep_rates(&of);
    slide_plates(d, &contact, of.chain.now.force);
    if (of.chain.falls) {
        chain_top(&of.chain);
        put_drop(d, &contact, &of.chain.now, d->published.side_buffers.force,
                 d->published.side_buffers.top);
    }
    put_contact(force_on_end(d, 0), force_on_end(d, 1), &contact, d->published.side_buffers.force,
                d->published.side_buffers.sliding_vertical, d->published.interface.force);
    put_into_sections(d, &contact);
}

#endif
