/* Solution of a series chain for one step, and what the step leaves in its members. Part of
 * kernel.c only.
 *
 * The members are linearised about their committed strokes, and again about where the force takes
 * them where that misses a law. What has not settled after some passes, and every lane in which a
 * law begins or ends to fall, is searched for lane by lane: that search has an answer always.
 */
#ifndef CZ_DYNAMICS_KERNEL_CHAIN_SOLVE_H
#define CZ_DYNAMICS_KERNEL_CHAIN_SOLVE_H

#include "dynamics/kernel_chain_search.h"

enum { CHAIN_PASSES = 12 }; /* linearisations of one step: more kinks than a step passes (ours) */

/* Linearises all members about their committed strokes and finds the force that balances them:
 * S(CHAIN_FORCE). CHAIN_LOWEST, CHAIN_ACTIVE and the plastic members that have no curve are set
 * before. Returns whether it did. */
static int start_chain(CzBlock *d, const Chain *chain, const Springs *springs, double step) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict last = d->memory[chain->force], *restrict lowest = S(CHAIN_LOWEST);
    double *restrict force = S(CHAIN_FORCE);
    CZ_LANES (i, n) {
        force[i] = cz_larger(last[i], lowest[i]);
    }
    d->falls = 0;
    memset(S(LAW_FALLS), 0, sizeof(CzRow));
    for (int side = 0; side < 2; ++side)
        springs->linearise(d, side, step, 0);
    for (int member = 0; member < chain->n_curve; ++member)
        if (!is_missing(d, chain, member))
            prepare_plastic(d, chain, member, step);
    return solve_linear(d, chain, S(CLOSURE));
}

/* Searches the active lanes in which something misses its law or begins to fall; `holds`: the
 * shear-offs do not soften. */
static void search_lanes(CzBlock *d, const Chain *chain, const Springs *springs, int holds,
                         double step) {
    for (size_t i = 0; i < CZ_LANE_BLOCK; ++i)
        if (S(CHAIN_ACTIVE)[i] > 0.0)
            search_lane(d, chain, springs, holds, i, step, S(LAW_FALLS)[i] > 0.0);
}

static int some_lane_falls(CzBlock *d) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict falls = S(LAW_FALLS);
    double n_falling = 0.0;
    _Pragma("omp simd reduction(+ : n_falling)") for (size_t i = 0; i < n; ++i) {
        n_falling += falls[i];
    }
    return n_falling > 0.0;
}

/* Linearises again what misses its law, `others` being the plastic members without a curve (NULL:
 * they stay as they are), until every member keeps it in the active lanes; `found`: the force of
 * the first linearisation was. Returns how often the force was found anew. */
static int settle_chain(CzBlock *d, const Chain *chain, const Springs *springs, Linearise *others,
                        double step, int found) {
    int n_anew = 0, settled = 0;
    for (int pass = 1; found && !settled && pass < CHAIN_PASSES; ++pass) {
        memset(S(LAW_DISTANCE), 0, sizeof(CzRow));
        double n_changed = springs->linearise(d, 0, step, 1) + springs->linearise(d, 1, step, 1);
        for (int member = 0; member < chain->n_curve; ++member)
            if (!is_missing(d, chain, member))
                n_changed += relinearise_plastic(d, chain, member, step);
        if (others != NULL)
            n_changed += others(d, 0, step, 1) + others(d, 1, step, 1);
        settled = n_changed == 0.0;
        if (!settled) {
            found = solve_linear(d, chain, S(CLOSURE));
            ++n_anew;
        }
    }
    if (settled && !some_lane_falls(d))
        return n_anew;
    search_lanes(d, chain, springs, others == NULL, step);
    return n_anew + 1;
}

/* Keeps the chain's force, and how far its members are from their laws for the run to judge. */
static void finish_chain(CzBlock *d, const Chain *chain) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict active = S(CHAIN_ACTIVE), *restrict distance = S(LAW_DISTANCE);
    double *restrict force = S(CHAIN_FORCE), *restrict largest = S(CHAIN_DISTANCE);
    double *restrict kept = d->next_memory[chain->force];
    CZ_LANES (i, n) {
        largest[i] = cz_larger(largest[i], active[i] * distance[i]);
        force[i] *= active[i];
        kept[i] = force[i];
    }
}

/* All three for a chain whose plastic members have curves. Returns whether the first linearisation
 * held in all lanes. */
static int solve_chain(CzBlock *d, const Chain *chain, const Springs *springs, double step) {
    const int found = start_chain(d, chain, springs, step);
    const int n_anew = settle_chain(d, chain, springs, NULL, step, found);
    finish_chain(d, chain);
    return n_anew == 0;
}

/* Takes the members to the end of the step and adds the mean force times their way to the energies;
 * `first` is the energy row of side A that gets the way of the springs and plastic
 * members, `second` the one that gets the way of the plastic members alone (-1: none). */
static void move_members(CzBlock *d, const Chain *chain, int first, int second) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict force = S(CHAIN_FORCE);
    const double *restrict last = d->memory[chain->force];
    for (int side = 0; side < 2; ++side) {
        const double *restrict energy = d->memory[first + side];
        double *restrict next_energy = d->next_memory[first + side];
        const double *restrict stroke = d->memory[chain->spring + side];
        const double *restrict at = S_AT(SPRING_AT_A, side);
        double *restrict next = d->next_memory[chain->spring + side];
        const double *restrict rest = S_AT(SPRING_FORCE_A, side);
        const double *restrict up = S_AT(SPRING_UP_A, side);
        const double *restrict down = S_AT(SPRING_DOWN_A, side);
        const double *restrict active = S(CHAIN_ACTIVE);
        CZ_LANES (i, n) {
            const double excess = active[i] * (force[i] - rest[i]);
            const double c = excess > 0.0 ? up[i] : down[i];
            const double way = active[i] * (at[i] - stroke[i]) + excess * c;
            next[i] = stroke[i] + way;
            next_energy[i] = energy[i] + 0.5 * (last[i] + force[i]) * way;
        }
    }
    for (int member = 0; member < chain->n_plastic; ++member) {
        const int side = member % 2;
        if (is_missing(d, chain, member)) {
            if (second >= 0 && member < 2)
                memcpy(d->next_memory[second + side], d->memory[second + side], sizeof(CzRow));
            continue;
        }
        const double *restrict stroke = d->memory[chain->plastic + member];
        double *restrict next = d->next_memory[chain->plastic + member];
        double *restrict next_energy = d->next_memory[first + side];
        const double *restrict strength = S_AT(STRENGTH_0, member);
        const double *restrict flow = S_AT(FLOW_0, member);
        CZ_LANES (i, n) {
            const double way = cz_plastic_flow(force[i], strength[i], flow[i]);
            next[i] = stroke[i] + way;
            next_energy[i] += 0.5 * (last[i] + force[i]) * way;
        }
        if (second >= 0) {
            const double *restrict before = member < 2
                                                ? d->memory[second + side]
                                                : (const double *)d->next_memory[second + side];
            double *restrict after = d->next_memory[second + side];
            CZ_LANES (i, n) {
                after[i] = before[i] + 0.5 * (last[i] + force[i]) * (next[i] - stroke[i]);
            }
        }
    }
}

/* Strengths that members had where they began to flow in this step, into S(CHAIN_TOP): where a
 * strength falls, such as behind a trigger peak, that is the largest force of the step. */
static void chain_top(CzBlock *d, const Chain *chain) {
    const size_t n = CZ_LANE_BLOCK;
    double *restrict top = S(CHAIN_TOP);
    double *restrict curve = S(CURVE_VALUE);
    memset(top, 0, sizeof(CzRow));
    for (int member = 0; member < chain->n_curve; ++member) {
        if (is_missing(d, chain, member))
            continue;
        const double *restrict stroke = d->memory[chain->plastic + member];
        const double *restrict next = d->next_memory[chain->plastic + member];
        const double *restrict rise = rise_of(d, chain, member);
        evaluate_curve(d, chain->curve + member, stroke, curve, S(CURVE_SLOPE));
        CZ_LANES (i, n) {
            const double strength = curve[i] * (1.0 + rise[i]);
            top[i] = cz_larger(top[i], next[i] > stroke[i] ? strength : 0.0);
        }
    }
}

/* Rates of the springs over the step, for the next one. */
static void keep_rates(CzBlock *d, const Chain *chain, int rate_row, double step) {
    const size_t n = CZ_LANE_BLOCK;
    const double per_step = 1.0 / step;
    for (int side = 0; side < 2; ++side) {
        const double *restrict before = d->memory[chain->spring + side];
        const double *restrict after = d->next_memory[chain->spring + side];
        double *restrict rate = d->next_memory[rate_row + side];
        CZ_LANES (i, n) {
            rate[i] = (after[i] - before[i]) * per_step;
        }
    }
}

#endif
