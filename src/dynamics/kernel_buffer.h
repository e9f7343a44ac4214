/* Buffers as the springs of a chain: of couplers, and of side buffers. Part of kernel.c only. */
#ifndef CZ_DYNAMICS_KERNEL_BUFFER_H
#define CZ_DYNAMICS_KERNEL_BUFFER_H

#include "dynamics/kernel_chain.h"
#include "laws/buffer.h"

/* The buffer of one side. */
typedef struct {
    const CzBufferRows *rows;
    const CzBlockCurve *curve; /* loading curve */
    const double *compliance;  /* 1 / transition */
    const CzBufferMemory *memory;
    CzBufferMemory *next;
} Buffer;

/* A chain with buffers as its springs. */
typedef struct {
    Chain chain; /* must be first: the solution passes its address back */
    Buffer buffer[2];
} BufferChain;

static inline CzBufferLaw buffer_law(const CzBufferRows *rows, const CzBlockCurve *curve,
                                     size_t i) {
    return (CzBufferLaw){cz_larger(rows->transition[i], 1.0),
                         rows->share[i],
                         rows->damping[i],
                         rows->quadratic[i],
                         rows->draw_stiffness[i],
                         rows->draw_slack[i],
                         curve->usable[i]};
}

/* Force of a buffer at a stroke in a lane, with the offset found by the first linearisation. */
static double buffer_force(const Chain *chain, int side, size_t i, double stroke) {
    const Buffer *buffer = &((const BufferChain *)chain)->buffer[side];
    const CzBufferLaw law = buffer_law(buffer->rows, buffer->curve, i);
    double value, slope;
    curve_at(buffer->curve, i, stroke, &value, &slope);
    const CzBufferResponse response = cz_buffer_of(
        &law, buffer->compliance[i], value, slope, stroke, stroke - buffer->memory->stroke[i],
        buffer->memory->rate[i], buffer->next->offset[i], chain->step);
    return response.force;
}

/* The law at a stroke in a lane, with the offset of the hysteresis before it. */
static inline CzBufferResponse respond(const Chain *chain, const Buffer *buffer,
                                       const CurveAt *restrict curve, const double *restrict stroke,
                                       const double *restrict offset, size_t i) {
    const CzBufferLaw law = buffer_law(buffer->rows, buffer->curve, i);
    return cz_buffer_of(&law, buffer->compliance[i], curve->value[i], curve->slope[i], stroke[i],
                        stroke[i] - buffer->memory->stroke[i], buffer->memory->rate[i], offset[i],
                        chain->step);
}

/* Linearises a buffer. The hysteresis starts from its state at the committed stroke. */
static int linearise_buffer(Chain *chain, int side, int again) {
    const Buffer *buffer = &((const BufferChain *)chain)->buffer[side];
    _Alignas(64) CzRow unused;
    const double *restrict offset = again ? buffer->next->offset : buffer->memory->offset;
    double *restrict next_offset = again ? unused : buffer->next->offset;
    CurveAt curve;
    SpringState trial;
    choose_stroke(chain, side, again, trial.at);
    evaluate_curve(buffer->curve, trial.at, &curve);
    if (again) { /* without the divisions for the compliances */
        CZ_LANES (i) {
            trial.force[i] = respond(chain, buffer, &curve, trial.at, offset, i).force;
        }
        if (!some_deviate(&chain->now, trial.force))
            return 0;
    }
    CZ_LANES (i) {
        const CzBufferResponse response = respond(chain, buffer, &curve, trial.at, offset, i);
        trial.force[i] = response.force;
        trial.up[i] = response.loading;
        trial.down[i] = response.unloading;
        next_offset[i] = response.offset;
    }
    accept(&chain->now, side, again, &trial);
    return 1;
}

static const SpringLaw buffers = {linearise_buffer, buffer_force, NULL};

/* Adds the buffer of a side to the chain; the caller adds the energies of the side. */
static void list_buffer(BufferChain *of, int side, Buffer buffer) {
    of->buffer[side] = buffer;
    of->chain.spring[side].stroke = buffer.memory->stroke;
    of->chain.spring[side].next = buffer.next->stroke;
}

/* Stores the rates of the buffers over this step for the next one. */
static void keep_rates(const BufferChain *of) {
    const double per_step = 1.0 / of->chain.step;
    for (int side = 0; side < 2; ++side) {
        const CzBufferMemory *restrict before = of->buffer[side].memory;
        CzBufferMemory *restrict after = of->buffer[side].next;
        CZ_LANES (i) {
            after->rate[i] = (after->stroke[i] - before->stroke[i]) * per_step;
        }
    }
}

#endif
