/* Solves a series chain for one step and updates its members. Part of kernel.c only.
 *
 * The members are linearised about their committed strokes, and again about their strokes under the
 * chain's force where a law is not satisfied. Lanes that have not converged after some passes, and
 * lanes in which a falling part of a law begins or ends, are searched one by one; that search
 * always finds a solution.
 */
#ifndef CZ_DYNAMICS_KERNEL_CHAIN_SOLVE_H
#define CZ_DYNAMICS_KERNEL_CHAIN_SOLVE_H

#include "dynamics/kernel_chain_search.h"

enum {
    CHAIN_PASSES = 12
}; /* linearisations of one step: more breakpoints than a step passes (ours) */

/* Linearises all members about their committed strokes and finds the force that balances them. The
 * caller has set the lowest force, the active lanes and the plastic members without a curve.
 * Returns whether the force was found. */
static int start_chain(Chain *chain) {
    ChainState *now = &chain->now;
    const double *restrict last = chain->last;
    CZ_LANES (i) {
        now->force[i] = cz_larger(last[i], now->lowest[i]);
    }
    chain->falls = 0;
    memset(now->falls, 0, sizeof(CzRow));
    memset(now->distance, 0, sizeof(CzRow));
    for (int side = 0; side < 2; ++side)
        chain->law->linearise(chain, side, 0);
    for (int member = 0; member < chain->n_curve; ++member)
        if (!chain->plastic[member].is_missing)
            prepare_plastic(chain, member);
    return solve_linear(chain);
}

/* Searches the active lanes in which a member does not satisfy its law or begins to fall; `holds`:
 * the shear-offs do not soften. */
static void search_lanes(Chain *chain, CzPublished *published, int holds) {
    for (size_t i = 0; i < CZ_LANE_BLOCK; ++i)
        if (chain->now.active[i] > 0.0)
            search_lane(chain, published, holds, i, chain->now.falls[i] > 0.0);
}

static int some_lane_falls(const ChainState *now) {
    double falls = 0.0;
    CZ_LANES_MAX(i, falls) {
        falls = cz_larger(falls, now->falls[i]);
    }
    return falls > 0.0;
}

/* Linearises members again until all of them satisfy their laws in the active lanes. `others`
 * linearises the plastic members without a curve (NULL: they stay as they are); `found`: the first
 * linearisation has given a force. Returns how often the force was solved again. */
static int settle_chain(Chain *chain, CzPublished *published, Linearise *others, int found) {
    int n_anew = 0, settled = 0;
    for (int pass = 1; found && !settled && pass < CHAIN_PASSES; ++pass) {
        memset(chain->now.distance, 0, sizeof(CzRow));
        int changed = chain->law->linearise(chain, 0, 1) | chain->law->linearise(chain, 1, 1);
        for (int member = 0; member < chain->n_curve; ++member)
            if (!chain->plastic[member].is_missing)
                changed |= relinearise_plastic(chain, member);
        if (others != NULL)
            changed |= others(chain, 0, 1) | others(chain, 1, 1);
        settled = !changed;
        if (!settled) {
            found = solve_linear(chain);
            ++n_anew;
        }
    }
    if (settled && !some_lane_falls(&chain->now))
        return n_anew;
    search_lanes(chain, published, others == NULL);
    return n_anew + 1;
}

/* Stores the chain's force, and publishes the deviation of its members from their laws. */
static void finish_chain(Chain *chain, CzPublished *published) {
    ChainState *now = &chain->now;
    double *restrict kept = chain->next, *restrict largest = published->chain.distance;
    CZ_LANES (i) {
        largest[i] = cz_larger(largest[i], now->active[i] * now->distance[i]);
        now->force[i] *= now->active[i];
        kept[i] = now->force[i];
    }
}

/* Starts, settles and finishes a chain whose plastic members all have curves. Returns whether the
 * first linearisation was sufficient in all lanes. */
static int solve_chain(Chain *chain, CzPublished *published) {
    const int found = start_chain(chain);
    const int n_anew = settle_chain(chain, published, NULL, found);
    finish_chain(chain, published);
    return n_anew == 0;
}

/* Moves the springs to the end of the step and adds the mean force times their travel to the
 * energies.
 */
static void move_springs(const Chain *chain) {
    const ChainState *now = &chain->now;
    const double *restrict last = chain->last;
    for (int side = 0; side < 2; ++side) {
        const Spring *rows = &chain->spring[side];
        const SpringState *spring = &now->spring[side];
        if (rows->is_missing)
            continue;
        CZ_LANES (i) {
            const double excess = now->active[i] * (now->force[i] - spring->force[i]);
            const double c = excess > 0.0 ? spring->up[i] : spring->down[i];
            const double moved = now->active[i] * (spring->at[i] - rows->stroke[i]) + excess * c;
            rows->next[i] = rows->stroke[i] + moved;
            rows->next_energy[i] = rows->energy[i] + 0.5 * (last[i] + now->force[i]) * moved;
        }
    }
}

/* The same for the plastic members, whose travel counts for both energies of their side; the sum of
 * the plastic one starts with the `first` member. */
static void move_plastic(const Chain *chain, int member, int first) {
    const Plastic *rows = &chain->plastic[member];
    const PlasticState *plastic = &chain->now.plastic[member];
    const Spring *side = &chain->spring[member % 2];
    const double *restrict last = chain->last, *restrict force = chain->now.force;
    const double *restrict before = first ? side->plastic_energy : side->next_plastic_energy;
    CZ_LANES (i) {
        const double moved =
            cz_plastic_crush(force[i], plastic->strength[i], plastic->compliance[i]);
        rows->next[i] = rows->stroke[i] + moved;
        side->next_energy[i] += 0.5 * (last[i] + force[i]) * moved;
        side->next_plastic_energy[i] =
            before[i] + 0.5 * (last[i] + force[i]) * (rows->next[i] - rows->stroke[i]);
    }
}

static void move_members(const Chain *chain) {
    move_springs(chain);
    for (int member = 0; member < chain->n_plastic; ++member) {
        const Spring *side = &chain->spring[member % 2];
        if (!chain->plastic[member].is_missing)
            move_plastic(chain, member, member < 2);
        else if (member < 2)
            memcpy(side->next_plastic_energy, side->plastic_energy, sizeof(CzRow));
    }
}

/* Largest strength at which a member began to yield in this step: where a strength falls, such as
 * behind a trigger peak, that is the largest force of the step. */
static void chain_top(Chain *chain) {
    double *restrict top = chain->now.top;
    CurveAt curve;
    memset(top, 0, sizeof(CzRow));
    for (int number = 0; number < chain->n_curve; ++number) {
        const Plastic *member = &chain->plastic[number];
        if (member->is_missing)
            continue;
        evaluate_curve(member->curve, member->stroke, &curve);
        CZ_LANES (i) {
            const double strength = curve.value[i] * (1.0 + member->rise[i]);
            top[i] = cz_larger(top[i], member->next[i] > member->stroke[i] ? strength : 0.0);
        }
    }
}

/* Whether no chain pushes, and no chain exists that can pull. */
static int is_slack(const ChainState *now) {
    double busy = 0.0;
    CZ_LANES_MAX(i, busy) {
        const double pulls = now->lowest[i] < 0.0 ? now->active[i] : 0.0;
        const double idle = fabs(now->force[i]) + pulls;
        busy = cz_larger(busy, idle == 0.0 ? 0.0 : 1.0); /* a NaN is busy */
    }
    return busy == 0.0;
}

/* Whether some lane is within reach; so is a closure that is not a number. */
static int is_within(const double *restrict closure, const double *restrict reach) {
    double near = 0.0;
    CZ_LANES_MAX(i, near) {
        near = cz_larger(near, closure[i] <= reach[i] ? 0.0 : 1.0);
    }
    return near > 0.0;
}

#endif
