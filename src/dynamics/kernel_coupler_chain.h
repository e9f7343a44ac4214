/* Couplers along their line: buffers, tubes and shear-offs in series; kernel_release.h treats the
 * step in which a shear-off releases. Part of kernel.c only. */
#ifndef CZ_DYNAMICS_KERNEL_COUPLER_CHAIN_H
#define CZ_DYNAMICS_KERNEL_COUPLER_CHAIN_H

#include "dynamics/kernel_coupler_line.h"
#include "dynamics/kernel_release.h"

#define LARGEST_PULL                                                                               \
    1e8 /* tension of undamaged coupled couplers: more than any train has [N] (ours) */

/* The members of the couplers of a block in this step. */
static void list_couplers(CzBlock *d, const CouplerLine *line, double step, CouplerChain *of) {
    const CzCouplerRows *rows = &d->parameter.coupler;
    const CzCouplerMemory *memory = &d->memory->coupler;
    CzCouplerMemory *next = &d->next_memory->coupler;
    Chain *chain = &of->buffers.chain;
    begin_chain(chain, &buffers, line->closure, step, memory->force, next->force);
    chain->compliance = rows->compliance;
    chain->n_plastic = 6;
    chain->n_curve = 4;
    for (int side = 0; side < 2; ++side) {
        list_buffer(&of->buffers, side,
                    (Buffer){&rows->side[side].buffer, &d->curve.buffer[side],
                             d->constant.buffer_compliance[side], &memory->side[side].buffer,
                             &next->side[side].buffer});
        list_energies(&chain->spring[side], memory->side[side].energy, next->side[side].energy,
                      memory->side[side].tube_energy, next->side[side].tube_energy);
        list_collapsing(&chain->plastic[side], &d->curve.tube[side], rows->side[side].tube_rate,
                        memory->side[side].tube, next->side[side].tube);
        list_collapsing(&chain->plastic[2 + side], &d->curve.second_tube[side],
                        rows->side[side].second_tube_rate, memory->side[side].second_tube,
                        next->side[side].second_tube);
        chain->plastic[SHEAR_OFF + side] = (Plastic){.shear = &rows->side[side].shear,
                                                     .rate = zeros,
                                                     .rise = zeros,
                                                     .stroke = memory->side[side].shear,
                                                     .next = next->side[side].shear,
                                                     .is_missing = !d->has_shear_off[side]};
    }
}

/* Strengths of the shear-offs, tension that the chains can carry, and lanes in which they exist. */
static void prepare_couplers(const CzCouplerRows *restrict rows, CouplerChain *of) {
    ChainState *now = &of->buffers.chain.now;
    memset(of->damage, 0, sizeof(CzRow));
    memset(&of->release, 0, sizeof of->release);
    for (int side = 0; side < 2; ++side)
        linearise_shear_off(&of->buffers.chain, side, 0);
    CZ_LANES (i) {
        now->lowest[i] = -LARGEST_PULL * rows->coupled[i] * (1.0 - of->damage[i]);
        now->active[i] = rows->exists[i];
    }
}

/* Whether no chain pushes or could pull. Then the sum of their members at zero force is the closure
 * up to which this remains so, because a sum changes with the closure alone. */
static int couplers_are_slack(const CouplerChain *of, double *restrict reach) {
    const Chain *chain = &of->buffers.chain;
    const double *restrict closure = chain->closure, *restrict active = chain->now.active;
    if (!is_slack(&chain->now))
        return 0;
    CurveAt sum;
    unbalance(chain, chain->now.force, &sum);
    CZ_LANES (i) {
        const double of_chain = closure[i] + sum.value[i] - REACH_MARGIN;
        const double of_hinges = of->damage[i] >= 1.0 ? CZ_NEVER : 0.0; /* not engaged up to here */
        reach[i] = active[i] > 0.0 ? cz_smaller(of_chain, of_hinges) : CZ_NEVER;
    }
    return !is_within(closure, reach);
}

/* Largest force of a step in which a shear-off releases or a tube's strength falls. */
static void coupler_top(CouplerChain *of, double *restrict top) {
    if (of->buffers.chain.falls) {
        chain_top(&of->buffers.chain);
        memcpy(top, of->buffers.chain.now.top, sizeof(CzRow));
    }
    if (of->releases)
        CZ_LANES (i) {
            top[i] = cz_larger(top[i], of->release.force[i]);
        }
}

/* Solves the chain and moves its members; returns whether the result is the same for any closure up
 * to the couplers' reach. */
static int coupler_chain_force(CzBlock *d, const CouplerLine *line, CouplerChain *of) {
    Chain *chain = &of->buffers.chain;
    prepare_couplers(&d->parameter.coupler, of);
    const int found = start_chain(chain);
    int n_anew = settle_chain(chain, &d->published, NULL, found);
    n_anew += release(d, line->rate, of);
    memcpy(chain->now.active, d->parameter.coupler.exists, sizeof(CzRow));
    finish_chain(chain, &d->published);
    move_members(chain);
    if (of->releases)
        release_work(d, line->rate, of);
    if (of->yields)
        snap_work(&d->memory->coupler, &d->next_memory->coupler);
    coupler_top(of, d->published.coupler.top);
    keep_rates(&of->buffers);
    return n_anew == 0 && couplers_are_slack(of, d->coupler_reach);
}

#endif
