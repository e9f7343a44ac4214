/* Couplers: along their line a series chain of buffers, tubes and shear-offs; their ends rotate
 * against hinges. Part of kernel.c only.
 *
 *   hinge i:  M_i = engaged * (slider(theta - beta_i) + swing stop),  reacted by transverse forces
 *             (M_A + M_B) / length
 *
 * with the angle theta of the line. Faces that are not coupled are pressed flat by a force along
 * it.
 */
#ifndef CZ_DYNAMICS_KERNEL_COUPLER_H
#define CZ_DYNAMICS_KERNEL_COUPLER_H

#include "dynamics/kernel_coupler_chain.h"
#include "laws/coupler.h"
#include "laws/slider.h"

static int some_are_released(const CzCouplerMemory *restrict memory) {
    double released = 0.0;
    CZ_LANES_MAX(i, released) {
        const double travel = memory->side[0].shear[i] + memory->side[1].shear[i];
        released = cz_larger(released, travel > 0.0 ? 1.0 : 0.0);
    }
    return released > 0.0;
}

static void engage_couplers(CzBlock *d, const CouplerLine *restrict line,
                            const double *restrict damage, double *restrict grows) {
    const CzCouplerRows *restrict rows = &d->parameter.coupler;
    double *restrict engaged = d->published.coupler.engaged;
    CZ_LANES (i) {
        const CzEngagement engagement =
            cz_coupler_engagement(rows->exists[i], rows->coupled[i], line->closure[i], damage[i]);
        engaged[i] = engagement.engaged;
        grows[i] = engagement.grows;
    }
}

/* Moment of the hinge of one side on its carrier, and the force along the line that presses the
 * faces flat against it; `grows` is the increase of their engagement with the closure. */
static void turn_hinge(CzBlock *d, int side, const CouplerLine *line, CzCarrier car,
                       const double *restrict grows, CouplerForces *restrict forces) {
    const CzHingeRows *restrict rows = &d->parameter.coupler.side[side].hinge_vertical;
    const double *restrict compliance = d->constant.hinge_compliance[side];
    const double *restrict engaged = d->published.coupler.engaged;
    const double *restrict yielded = d->memory->coupler.side[side].hinge_vertical;
    double *restrict next = d->next_memory->coupler.side[side].hinge_vertical;
    double *restrict power = d->power->hinge[side];
    double *restrict kept = d->published.coupler.swing_vertical[side];
    double *restrict moment = forces->moment[side], *restrict push = forces->mating[side];
    _Alignas(64) CzRow swing, turning;
    line_up_swing(car, line, d->constant.rest_angle_vertical, swing, turning);
    CZ_LANES (i) {
        const CzSliderResponse hinge =
            cz_slider_of(rows->stiffness[i], compliance[i], rows->moment[i], swing[i], yielded[i]);
        const double held =
            engaged[i] * (hinge.force + cz_stop(rows->stop_stiffness[i], rows->stop[i], swing[i]));
        next[i] = engaged[i] >= 1.0 ? hinge.offset : yielded[i];
        kept[i] = engaged[i] * swing[i];
        moment[i] = held;
        push[i] = grows[i] * (cz_slider_energy(compliance[i], hinge.force, swing[i], yielded[i]) +
                              cz_stop_energy(rows->stop_stiffness[i], rows->stop[i], swing[i]));
        power[i] += held * turning[i] + push[i] * line->rate[i];
    }
}

/* Publishes the closure of the couplers that exist. */
static void keep_closure(const double *restrict exists, const double *restrict closure,
                         double *restrict kept) {
    CZ_LANES (i) {
        kept[i] = exists[i] * closure[i];
    }
}

/* Whether this evaluation leaves the memory of the couplers unchanged. */
static int couplers_remember(const CzBlock *d) {
    return memcmp(&d->memory->coupler, &d->next_memory->coupler, sizeof d->memory->coupler) == 0;
}

/* For couplers that changed nothing and are still apart: both copies of their memory are up to
 * date. */
static void leave_couplers(CzBlock *d) {
    memcpy(d->published.coupler.force, d->memory->coupler.force, sizeof(CzRow));
}

/* Evaluates the couplers where at least one may carry a force. */
static void push_couplers(CzBlock *d, const CzCarrier car[2], const CouplerLine *line,
                          double step) {
    CouplerForces forces;
    CouplerChain of;
    list_couplers(d, line, step, &of);
    const int slack = coupler_chain_force(d, line, &of);
    _Alignas(64) CzRow grows;
    engage_couplers(d, line, of.damage, grows);
    for (int side = 0; side < 2; ++side)
        turn_hinge(d, side, line, car[side], grows, &forces);
    d->couplers_rest = slack && couplers_remember(d) && !d->leaves_nothing_out;
    sum_coupler_forces(d, line, of.buffers.chain.now.force, of.release.more, &forces);
    for (int side = 0; side < 2; ++side) {
        put_coupler(d, side, line, &forces);
        if (d->budget != NULL)
            note_coupler(d, side, line, &forces, step);
    }
}

/* Evaluates all couplers. */
static void couplers(CzBlock *d, double step) {
    const int released = some_are_released(&d->memory->coupler);
    if (!released && d->couplers_rest && !pivots_are_near(d)) {
        leave_couplers(d);
        return;
    }
    _Alignas(64) CzMotion motion[2];
    const CzCarrier car[2] = {coupler_carrier(d, 0, &motion[0]), coupler_carrier(d, 1, &motion[1])};
    CouplerLine line;
    line_up_coupler(car[0], car[1], &d->parameter.coupler, d->parameter.tilts, &line);
    if (released)
        line_up_released(car[0], car[1], d, &line);
    keep_closure(d->parameter.coupler.exists, line.closure, d->published.coupler.closure);
    if (released && d->couplers_rest && !is_within(line.closure, d->coupler_reach)) {
        leave_couplers(d);
        return;
    }
    push_couplers(d, car, &line, step);
}

#endif
