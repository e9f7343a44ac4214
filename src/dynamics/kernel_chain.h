/* Series chains: one force passes through all members, their shortenings add up to the closure.
 * Part of kernel.c only.
 *
 *   sum over springs of (x + (F - F_x) c(F)) + sum over plastic members of (s + flow(F)) + C F =
 * closure
 *
 * The left side grows with F and is piecewise linear, so Newton's method with a bracket finds F in
 * as many steps as kinks are passed. F never falls below what the chain can pull (0 where nothing
 * couples). Lanes that have arrived are left alone, so that a lane's answer does not depend on its
 * neighbours.
 */
#ifndef CZ_DYNAMICS_KERNEL_CHAIN_H
#define CZ_DYNAMICS_KERNEL_CHAIN_H

#include "dynamics/kernel_rows.h"
#include "laws/buffer.h"
#include "laws/plastic_member.h"
#include "laws/vehicle_end.h"

enum { CHAIN_ITERATIONS = 60 };
#define CHAIN_TOLERANCE 1e-13 /* closure left unbalanced [m] */

/* What a chain is made of: first rows of its members; side B follows side A. */
typedef struct {
    int n_plastic;
    int force, spring, plastic; /* CzMemory: chain force, spring strokes, plastic strokes */
    int compliance;             /* CzParameter */
} Chain;

/* Buffers as the springs of a chain. */
typedef struct {
    int curve; /* CzCurveId of side A */
    int transition, share, damping, quadratic, draw,
        slack;        /* CzParameter of side A; draw -1: no tension */
    int rate, offset; /* CzMemory of side A */
} BufferRows;

/* Sum of the members' shortenings less the closure, and its derivative, at the chain's present
 * force. */
static void unbalance(const CzDynamics *d, const Chain *chain, const double *restrict closure,
                      double *restrict sum, double *restrict slope) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict force = S(CHAIN_FORCE);
    const double *restrict compliance = cz_row(d->lanes->parameter, d->stride, chain->compliance);
    CZ_LANES (i, n) {
        sum[i] = compliance[i] * force[i] - closure[i];
        slope[i] = compliance[i];
    }
    for (int side = 0; side < 2; ++side) {
        const double *restrict stroke = cz_row(d->memory, d->stride, chain->spring + side);
        const double *restrict rest = S_AT(SPRING_FORCE_A, side);
        const double *restrict up = S_AT(SPRING_UP_A, side);
        const double *restrict down = S_AT(SPRING_DOWN_A, side);
        CZ_LANES (i, n) {
            const double excess = force[i] - rest[i];
            const double c = excess > 0.0 ? up[i] : down[i];
            sum[i] += stroke[i] + excess * c;
            slope[i] += c;
        }
    }
    for (int member = 0; member < chain->n_plastic; ++member) {
        const double *restrict stroke = cz_row(d->memory, d->stride, chain->plastic + member);
        const double *restrict strength = S_AT(STRENGTH_0, member);
        const double *restrict flow = S_AT(FLOW_0, member);
        CZ_LANES (i, n) {
            const double yields = force[i] > strength[i] ? flow[i] : 0.0;
            sum[i] += stroke[i] + cz_plastic_flow(force[i], strength[i], flow[i]);
            slope[i] += yields;
        }
    }
}

/* One Newton step in all lanes that have not arrived; returns whether all have. */
static int improve(const CzDynamics *d, const double *restrict sum, const double *restrict slope) {
    const size_t n = CZ_LANE_BLOCK;
    double *restrict force = S(CHAIN_FORCE);
    double *restrict low = S(CHAIN_LOW);
    double *restrict high = S(CHAIN_HIGH);
    const double *restrict lowest = S(CHAIN_LOWEST);
    const double *restrict active = S(CHAIN_ACTIVE);
    double n_moving = 0.0;
    _Pragma("omp simd reduction(+ : n_moving)") for (size_t i = 0; i < n; ++i) {
        const double f = force[i];
        const double off = fabs(sum[i]) > CHAIN_TOLERANCE ? active[i] : 0.0;
        const double released = sum[i] > 0.0 ? 1.0 : 0.0;
        const double slack = f <= lowest[i] ? released : 0.0;
        const double moving = off > slack ? 1.0 : 0.0;
        const double new_high = sum[i] > 0.0 ? f : high[i];
        const double new_low = sum[i] > 0.0 ? low[i] : f;
        const double newton = f - sum[i] / cz_larger(slope[i], 1e-30);
        const double middle = 0.5 * (new_low + new_high);
        const double above = newton > new_low ? newton : middle;
        const double inside = above < new_high ? above : middle;
        const double next = cz_larger(inside, lowest[i]);
        force[i] = moving > 0.0 ? next : f;
        low[i] = moving > 0.0 ? new_low : low[i];
        high[i] = moving > 0.0 ? new_high : high[i];
        n_moving += moving;
    }
    return n_moving == 0.0;
}

/* Finds the chain's force in all lanes: S(CHAIN_FORCE). What is left unbalanced is kept for the run
 * to judge. */
static void solve_chain(CzDynamics *d, const Chain *chain, const double *closure) {
    const size_t n = CZ_LANE_BLOCK;
    double *restrict force = S(CHAIN_FORCE);
    double *restrict low = S(CHAIN_LOW);
    double *restrict high = S(CHAIN_HIGH);
    double *sum = S(CURVE_VALUE);
    double *slope = S(CURVE_SLOPE);
    {
        const double *restrict last = cz_row(d->memory, d->stride, chain->force);
        const double *restrict lowest = S(CHAIN_LOWEST);
        CZ_LANES (i, n) {
            force[i] = cz_larger(last[i], lowest[i]);
            low[i] = -1e10;
            high[i] = 1e10;
        }
    }
    int arrived = 0;
    for (int iteration = 0; iteration < CHAIN_ITERATIONS && !arrived; ++iteration) {
        unbalance(d, chain, closure, sum, slope);
        arrived = improve(d, sum, slope);
    }
    double *restrict residual = S(RESIDUAL);
    double *restrict kept = cz_row(d->next_memory, d->stride, chain->force);
    const double *restrict active = S(CHAIN_ACTIVE);
    const double *restrict left = sum;
    const double unsolved = arrived ? 0.0 : 1.0;
    CZ_LANES (i, n) {
        residual[i] = cz_larger(residual[i], unsolved * active[i] * fabs(left[i]));
        force[i] *= active[i];
        kept[i] = force[i];
    }
}

/* Sets a buffer as spring member `side` of the chain. */
static void prepare_buffer(CzDynamics *d, const Chain *chain, const BufferRows *rows, int side,
                           double step) {
    const size_t n = CZ_LANE_BLOCK;
    double *parameter = d->lanes->parameter;
    const double *restrict stroke = cz_row(d->memory, d->stride, chain->spring + side);
    double *restrict curve = S(CURVE_VALUE);
    double *restrict slope = S(CURVE_SLOPE);
    evaluate_curve(d, rows->curve + side, stroke, curve, slope);
    const double *restrict transition = cz_row(parameter, d->stride, rows->transition + side);
    const double *restrict share = cz_row(parameter, d->stride, rows->share + side);
    const double *restrict damping = cz_row(parameter, d->stride, rows->damping + side);
    const double *restrict quadratic = cz_row(parameter, d->stride, rows->quadratic + side);
    const int pulls = rows->draw >= 0;
    const double *restrict draw = pulls ? cz_row(parameter, d->stride, rows->draw + side) : S(ZERO);
    const double *restrict slack =
        pulls ? cz_row(parameter, d->stride, rows->slack + side) : S(ZERO);
    const double *restrict rate = cz_row(d->memory, d->stride, rows->rate + side);
    const double *restrict offset = cz_row(d->memory, d->stride, rows->offset + side);
    double *restrict next_offset = cz_row(d->next_memory, d->stride, rows->offset + side);
    const double *restrict usable = d->lanes->curve[rows->curve + side].usable;
    double *restrict rest = S_AT(SPRING_FORCE_A, side);
    double *restrict up = S_AT(SPRING_UP_A, side);
    double *restrict down = S_AT(SPRING_DOWN_A, side);
    CZ_LANES (i, n) {
        const CzBufferLaw law = {cz_larger(transition[i], 1.0),
                                 share[i],
                                 damping[i],
                                 quadratic[i],
                                 draw[i],
                                 slack[i],
                                 usable[i]};
        const CzBufferResponse response =
            cz_buffer(&law, curve[i], slope[i], stroke[i], rate[i], offset[i], step);
        rest[i] = response.force;
        up[i] = response.loading;
        down[i] = response.unloading;
        next_offset[i] = response.offset;
    }
}

/* Sets a plastic member: strength over its stroke, times a factor, with a rate factor. */
static void prepare_plastic(CzDynamics *d, const Chain *chain, int member, int curve_id,
                            const double *restrict factor, const double *restrict rate_factor,
                            double step) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict stroke = cz_row(d->memory, d->stride, chain->plastic + member);
    double *restrict strength = S_AT(STRENGTH_0, member);
    double *restrict flow = S_AT(FLOW_0, member);
    evaluate_curve(d, curve_id, stroke, strength, flow);
    CZ_LANES (i, n) {
        const double scaled = strength[i] * (1.0 + factor[i]);
        flow[i] = cz_plastic_compliance(scaled, flow[i] * (1.0 + factor[i]), rate_factor[i], step);
        strength[i] = scaled;
    }
}

/* Takes the members to the end of the step and adds the mean force times their way to the energies;
 * `first` is the energy row of side A that gets the way of the springs and plastic members,
 * `second` the one that gets the way of the plastic members alone (-1: none). */
static void move_members(CzDynamics *d, const Chain *chain, int first, int second) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict force = S(CHAIN_FORCE);
    const double *restrict last = cz_row(d->memory, d->stride, chain->force);
    for (int side = 0; side < 2; ++side) {
        const double *restrict energy = cz_row(d->memory, d->stride, first + side);
        double *restrict next_energy = cz_row(d->next_memory, d->stride, first + side);
        const double *restrict stroke = cz_row(d->memory, d->stride, chain->spring + side);
        double *restrict next = cz_row(d->next_memory, d->stride, chain->spring + side);
        const double *restrict rest = S_AT(SPRING_FORCE_A, side);
        const double *restrict up = S_AT(SPRING_UP_A, side);
        const double *restrict down = S_AT(SPRING_DOWN_A, side);
        const double *restrict active = S(CHAIN_ACTIVE);
        CZ_LANES (i, n) {
            const double excess = active[i] * (force[i] - rest[i]);
            const double c = excess > 0.0 ? up[i] : down[i];
            const double way = excess * c;
            next[i] = stroke[i] + way;
            next_energy[i] = energy[i] + 0.5 * (last[i] + force[i]) * way;
        }
    }
    for (int member = 0; member < chain->n_plastic; ++member) {
        const int side = member % 2;
        const double *restrict stroke = cz_row(d->memory, d->stride, chain->plastic + member);
        double *restrict next = cz_row(d->next_memory, d->stride, chain->plastic + member);
        double *restrict next_energy = cz_row(d->next_memory, d->stride, first + side);
        const double *restrict strength = S_AT(STRENGTH_0, member);
        const double *restrict flow = S_AT(FLOW_0, member);
        CZ_LANES (i, n) {
            const double way = cz_plastic_flow(force[i], strength[i], flow[i]);
            next[i] = stroke[i] + way;
            next_energy[i] += 0.5 * (last[i] + force[i]) * way;
        }
        if (second >= 0) {
            const double *restrict before =
                member < 2 ? cz_row(d->memory, d->stride, second + side)
                           : (const double *)cz_row(d->next_memory, d->stride, second + side);
            double *restrict after = cz_row(d->next_memory, d->stride, second + side);
            CZ_LANES (i, n) {
                after[i] = before[i] + 0.5 * (last[i] + force[i]) * (next[i] - stroke[i]);
            }
        }
    }
}

/* Rates of the springs over the step, for the next one. */
static void keep_rates(CzDynamics *d, const Chain *chain, int rate_row, double step) {
    const size_t n = CZ_LANE_BLOCK;
    for (int side = 0; side < 2; ++side) {
        const double *restrict before = cz_row(d->memory, d->stride, chain->spring + side);
        const double *restrict after = cz_row(d->next_memory, d->stride, chain->spring + side);
        double *restrict rate = cz_row(d->next_memory, d->stride, rate_row + side);
        CZ_LANES (i, n) {
            rate[i] = (after[i] - before[i]) / step;
        }
    }
}

#endif
