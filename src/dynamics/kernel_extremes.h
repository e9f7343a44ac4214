/* The commit of a step: adds work and updates the largest values. Part of kernel.c only. */
#ifndef CZ_DYNAMICS_KERNEL_EXTREMES_H
#define CZ_DYNAMICS_KERNEL_EXTREMES_H

#include "dynamics/kernel_coupler_line.h"

#define PUSHING 1e4 /* force from which faces count as pushed [N] (ours) */

static void keep_larger(double *restrict kept, const double *restrict value) {
    CZ_LANES (i) {
        kept[i] = cz_larger(kept[i], value[i]);
    }
}

static void keep_larger_size(double *restrict kept, const double *restrict value) {
    CZ_LANES (i) {
        kept[i] = cz_larger(kept[i], fabs(value[i]));
    }
}

/* Total force of the interfaces, and closure between the bodies. */
static void interface_extremes(CzBlock *d, double time) {
    const double *restrict total = d->published.interface.force, *restrict drop =
                                                                     d->published.interface.drop;
    const double *restrict x = d->position.body.x, *restrict x_ahead = d->ahead.body.displacement.x;
    CzExtremes *restrict kept = &d->extreme;
    CZ_LANES (i) {
        const double size = cz_larger(fabs(total[i]), fabs(total[i] + drop[i]));
        kept->interface_time[i] = size > kept->interface_force[i] ? time : kept->interface_time[i];
        kept->interface_force[i] = cz_larger(size, kept->interface_force[i]);
        kept->interface_shortening[i] = cz_larger(kept->interface_shortening[i], x[i] - x_ahead[i]);
    }
}

static void face_extremes(CzBlock *d) {
    CzExtremes *kept = &d->extreme;
    keep_larger(kept->face_force, d->published.face.force);
    keep_larger(kept->face_force, d->published.face.top);
    keep_larger(kept->face_closure, d->published.face.closure);
}

/* Updates the smallest distances of the faces from climbing. `chain` is the chain's own force: it
 * remains after the faces have passed each other. */
static void climbing_extremes(CzBlock *d, double time) {
    const double *restrict normal = d->published.face.force, *restrict remaining =
                                                                 d->published.face.remaining;
    const double *restrict demand = d->published.face.demand_vertical, *restrict ready =
                                                                           d->published.face.ready;
    const double *restrict chain = d->memory->face.force, *restrict slipped =
                                                              d->memory->face.slipped;
    const double *restrict stiffness = d->parameter.face.stiffness_vertical;
    const double *restrict ramp = d->published.face.ramp;
    CzExtremes *restrict kept = &d->extreme;
    CZ_LANES (i) {
        const double pushing = chain[i] > PUSHING ? 1.0 : 0.0;
        const double passed = remaining[i] <= 0.0 ? pushing : 0.0;
        const double engaged = normal[i] > PUSHING ? 1.0 : 0.0;
        const double excess = fabs(demand[i]) - ready[i] + stiffness[i] * slipped[i];
        const double used = pushing > 0.0 ? -remaining[i] : CZ_NOT_YET;
        const double margin_lost = normal[i] > 0.0 ? excess : CZ_NOT_YET;
        kept->face_overlap_time[i] =
            used > kept->face_lost_overlap[i] ? time : kept->face_overlap_time[i];
        kept->face_margin_time[i] =
            margin_lost > kept->face_lost_margin[i] ? time : kept->face_margin_time[i];
        kept->face_lost_overlap[i] = cz_larger(kept->face_lost_overlap[i], used);
        kept->face_lost_margin[i] = cz_larger(kept->face_lost_margin[i], margin_lost);
        kept->face_ramp[i] = cz_larger(kept->face_ramp[i], engaged * ramp[i]);
        kept->face_climbed[i] = cz_larger(kept->face_climbed[i], passed);
        kept->climb_time[i] = cz_larger(kept->climb_time[i], passed > 0.0 ? -time : CZ_NOT_YET);
    }
    keep_larger_size(kept->face_demand_vertical, demand);
}

static void coupler_extremes(CzBlock *d) {
    CzExtremes *kept = &d->extreme;
    for (int side = 0; side < 2; ++side) {
        keep_larger_size(kept->swing_vertical[side], d->published.coupler.swing_vertical[side]);
        keep_larger(kept->buffer[side], d->memory->coupler.side[side].buffer.stroke);
    }
    keep_larger_size(kept->coupler_force, d->published.coupler.force);
    keep_larger(kept->coupler_force, d->published.coupler.top);
    keep_larger(kept->coupler_closure, d->published.coupler.closure);
}

static void side_buffer_extremes(CzBlock *d) {
    CzExtremes *kept = &d->extreme;
    for (int side = 0; side < 2; ++side)
        keep_larger(kept->side_buffer[side], d->memory->side_buffers.side[side].buffer.stroke);
    keep_larger(kept->side_force, d->published.side_buffers.force);
    keep_larger(kept->side_force, d->published.side_buffers.top);
    keep_larger(kept->side_closure, d->published.side_buffers.closure);
}

static void wheel_extremes(CzBlock *d, double time) {
    CzExtremes *restrict kept = &d->extreme;
    for (int axle = 0; axle < 4; ++axle) {
        const double *restrict approach = d->published.wheel[axle].approach;
        CZ_LANES (i) {
            const double now = -approach[i];
            kept->lift_time[axle][i] = now > kept->lift[axle][i] ? time : kept->lift_time[axle][i];
            kept->lift[axle][i] = cz_larger(kept->lift[axle][i], now);
        }
    }
    for (int bogie = 0; bogie < 2; ++bogie) {
        const double *restrict first = d->published.wheel[2 * bogie].approach,
                               *restrict second = d->published.wheel[2 * bogie + 1].approach;
        CZ_LANES (i) {
            const double lower = cz_smaller(-first[i], -second[i]);
            kept->bogie_lift_time[bogie][i] =
                lower > kept->bogie_lift[bogie][i] ? time : kept->bogie_lift_time[bogie][i];
            kept->bogie_lift[bogie][i] = cz_larger(kept->bogie_lift[bogie][i], lower);
        }
    }
}

static void car_extremes(CzBlock *d, double time) {
    CzExtremes *kept = &d->extreme;
    wheel_extremes(d, time);
    for (int bogie = 0; bogie < 2; ++bogie) {
        keep_larger_size(kept->link_force, d->published.link[bogie].force);
        keep_larger_size(kept->link_travel, d->published.link[bogie].travel);
        keep_larger_size(kept->bogie_acceleration, d->acceleration.bogie[bogie].x);
    }
    keep_larger_size(kept->body_pitch, d->position.body.pitch);
    for (int end = 0; end < 2; ++end)
        keep_larger(kept->end_force[end], d->published.end[end].force);
}

/* Updates the residuals of the series chains. */
static void chain_extremes(CzBlock *d) {
    const double *restrict searched = d->published.chain.searched;
    CzExtremes *restrict kept = &d->extreme;
    keep_larger(kept->chain_residual, d->published.chain.residual);
    keep_larger(kept->chain_distance, d->published.chain.distance);
    CZ_LANES (i) {
        kept->searched[i] += searched[i];
    }
}

static void extremes(const CzLanes *lanes, CzBlock *d, double time) {
    CzExtremes *kept = &d->extreme;
    interface_extremes(d, time);
    face_extremes(d);
    if (d->can_climb)
        climbing_extremes(d, time);
    if (lanes->has.couplers)
        coupler_extremes(d);
    if (lanes->has.side_buffers)
        side_buffer_extremes(d);
    if (lanes->has.superstructures)
        keep_larger(kept->superstructure_force, d->published.superstructure.force);
    if (lanes->has.draw_gears)
        keep_larger_size(kept->draw_gear_force, d->published.draw_gear.force);
    for (int end = 0; end < 2; ++end)
        keep_larger(kept->section[end], d->published.section[end]);
    keep_larger_size(kept->body_acceleration, d->acceleration.body.x);
    chain_extremes(d);
    if (lanes->has.full_cars) {
        underframe_extremes(d);
        car_extremes(d, time);
    }
    if (lanes->has.drag) {
        keep_larger_size(kept->slide_travel, d->position.body.x);
        keep_larger(kept->slide_force, d->published.slide_force);
    }
}

/* Work of the first n powers over the step by the mean of the powers at its ends. */
static void add_work(CzBlock *d, size_t n, double step) {
    const double *restrict last = d->last_power->coupler, *restrict power = d->power->coupler;
    double *restrict work = d->work.coupler;
    _Pragma("omp simd") for (size_t i = 0; i < n; ++i) {
        work[i] += 0.5 * step * (last[i] + power[i]);
    }
}

static void commit_block(const CzDynamics *dynamics, CzBlock *d, double step, double time) {
    add_work(d, dynamics->n_power, step);
    CzPower *const power = d->power;
    d->power = d->last_power;
    d->last_power = power;
    CzMemory *const memory = d->memory;
    d->memory = d->next_memory;
    d->next_memory = memory;
    extremes(dynamics->lanes, d, time);
}

#endif
