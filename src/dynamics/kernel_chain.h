/* Series chains: one force passes through all members, their shortenings add up to the closure.
 * Part of kernel.c only. This file linearises the members and finds the force that balances them;
 * kernel_chain_search.h finds the force in one lane from the laws themselves; kernel_chain_solve.h
 * solves a step.
 *
 *   sum over springs of (x + (F - F_x) c(F))
 *       + sum over plastic members of (s + crush(F)) + C F = closure
 *
 * The left side grows with F and is piecewise linear, so Newton's method with a bracket finds F in
 * as many steps as breakpoints are passed. F never falls below the tension that the chain can carry
 * (0 where it is not coupled). Lanes that have converged are not changed any more, so that the
 * result of a lane does not depend on its neighbours.
 */
#ifndef CZ_DYNAMICS_KERNEL_CHAIN_H
#define CZ_DYNAMICS_KERNEL_CHAIN_H

#include "dynamics/kernel_lanes.h"
#include "laws/plastic_member.h"

enum { CHAIN_ITERATIONS = 60, MAX_PLASTIC = 6 };
#define CHAIN_TOLERANCE 1e-13 /* closure left unbalanced [m] */
#define REACH_MARGIN 1e-6     /* far more than the rounding of a chain's sum [m] (ours) */
#define LAW_TOLERANCE 1.0     /* largest deviation of a member from its law [N] (ours) */

typedef struct Chain Chain;

/* Linearises a member of one side: first about its committed stroke, later (`again`) about its
 * stroke under the chain's force, in the lanes where it does not satisfy its law. Returns whether
 * there are such lanes. */
typedef int Linearise(Chain *chain, int side, int again);

/* Force of the spring of one side at a stroke, in one lane: the law that Linearise linearises. */
typedef double ForceAt(const Chain *chain, int side, size_t lane, double stroke);

/* First stroke, not below `from`, at which the law of that spring under loading begins to fall, or
 * to rise again (`rises`); infinite where there is none. */
typedef double TurnsAt(const Chain *chain, int side, size_t lane, double from, int rises);

/* The law of the springs of a chain. */
typedef struct {
    Linearise *linearise;
    ForceAt *force_at;
    TurnsAt *turns_at; /* NULL: no spring has a falling part */
} SpringLaw;

/* A plastic member: tube, anti-climber or shear-off. */
typedef struct {
    const CzBlockCurve *curve;   /* of its strength; NULL for a shear-off */
    const CzShearOffRows *shear; /* of a shear-off */
    const double *rate;          /* rate factor */
    const double *rise;          /* increase of its strength by the closing speed */
    const double *stroke;        /* committed */
    double *next;
    int is_missing; /* in all lanes: it would neither yield nor change any sum */
} Plastic;

/* Rows of a spring, and of the energies of its side. */
typedef struct {
    const double *stroke, *energy, *plastic_energy; /* committed */
    double *next, *next_energy, *next_plastic_energy;
    int is_missing; /* in all lanes: all of it is and remains 0 */
} Spring;

/* A spring linearised about a stroke. */
typedef struct {
    CzRow at, force; /* stroke and its force there */
    CzRow up, down;  /* compliance while the stroke grows, and while it shrinks */
} SpringState;

/* A plastic member linearised. */
typedef struct {
    CzRow strength, compliance; /* compliance of the step beyond the strength */
} PlasticState;

/* State of the solution of a chain. */
typedef struct {
    _Alignas(64) CzRow force;
    CzRow lowest;   /* smallest force that it can carry */
    CzRow active;   /* 1 where the chain exists */
    CzRow distance; /* largest deviation of a member from its law [N] */
    CzRow falls; /* above 0 where a falling part of a law begins or ends in this step, or the force
                    drops far */
    CzRow top;   /* largest strength at which a member began to yield in this step */
    SpringState spring[2];
    PlasticState plastic[MAX_PLASTIC];
} ChainState;

/* A chain of a block in one step. Members of side B follow those of side A; data of one type of
 * element is in a struct that begins with its chain. */
struct Chain {
    int n_plastic, n_curve; /* plastic members; those with a curve come first */
    int falls;              /* a strength fell in this step */
    double step;
    const double *closure;
    const double *compliance; /* of all tubes together */
    const double *last;       /* force, committed */
    double *next;
    const SpringLaw *law;
    Spring spring[2];
    Plastic plastic[MAX_PLASTIC];
    ChainState now;
};

/* Sets up a chain with two plastic members that have curves: `last` and `next` are its force,
 * committed and new. */
static void begin_chain(Chain *chain, const SpringLaw *law, const double *closure, double step,
                        const double *last, double *next) {
    chain->n_plastic = chain->n_curve = 2;
    chain->step = step;
    chain->closure = closure;
    chain->last = last;
    chain->next = next;
    chain->law = law;
    chain->spring[0].is_missing = chain->spring[1].is_missing = 0;
}

/* A tube or an anti-climber whose strength does not depend on the closing speed. */
static void list_collapsing(Plastic *member, const CzBlockCurve *strength, const double *rate,
                            const double *stroke, double *next) {
    member->is_missing = !strength->is_there;
    member->stroke = stroke;
    if (member->is_missing)
        return;
    member->curve = strength;
    member->rate = rate;
    member->rise = zeros;
    member->next = next;
}

static void list_energies(Spring *side, const double *energy, double *next_energy,
                          const double *plastic_energy, double *next_plastic_energy) {
    side->energy = energy;
    side->next_energy = next_energy;
    side->plastic_energy = plastic_energy;
    side->next_plastic_energy = next_plastic_energy;
}

/* Sum of the members' shortenings less the closure, and its derivative, at a force. */
static inline void unbalance(const Chain *chain, const double *restrict force,
                             CurveAt *restrict sum) {
    const ChainState *now = &chain->now;
    CZ_LANES (i) {
        sum->value[i] = chain->compliance[i] * force[i] - chain->closure[i];
        sum->slope[i] = chain->compliance[i];
    }
    for (int side = 0; side < 2; ++side) {
        const SpringState *spring = &now->spring[side];
        if (chain->spring[side].is_missing)
            continue;
        CZ_LANES (i) {
            const double excess = force[i] - spring->force[i];
            const double up = spring->up[i], down = spring->down[i];
            const double c = excess > 0.0 ? up : down;
            sum->value[i] += spring->at[i] + excess * c;
            sum->slope[i] += c;
        }
    }
    for (int member = 0; member < chain->n_plastic; ++member) {
        if (chain->plastic[member].is_missing)
            continue;
        const double *restrict stroke = chain->plastic[member].stroke;
        const PlasticState *plastic = &now->plastic[member];
        CZ_LANES (i) {
            const double strength = plastic->strength[i], compliance = plastic->compliance[i];
            const double yields = force[i] > strength ? compliance : 0.0;
            sum->value[i] += stroke[i] + cz_plastic_crush(force[i], strength, compliance);
            sum->slope[i] += yields;
        }
    }
}

/* A force that is sought, and its bracket. */
typedef struct {
    _Alignas(64) CzRow force;
    CzRow low, high;
} Sought;

/* One Newton step in all lanes that have not converged; returns whether all have. */
static inline int improve(const ChainState *now, const CurveAt *restrict sum,
                          Sought *restrict sought) {
    double some_move = 0.0;
    CZ_LANES_MAX(i, some_move) {
        const double f = sought->force[i], low = sought->low[i], high = sought->high[i];
        const double lowest = now->lowest[i], active = now->active[i];
        const double off = fabs(sum->value[i]) > CHAIN_TOLERANCE ? active : 0.0;
        const double released = sum->value[i] > 0.0 ? 1.0 : 0.0;
        const double slack = f <= lowest ? released : 0.0;
        const double moving = off > slack ? 1.0 : 0.0;
        const double new_high = sum->value[i] > 0.0 ? f : high;
        const double new_low = sum->value[i] > 0.0 ? low : f;
        const double newton = f - sum->value[i] / cz_larger(sum->slope[i], 1e-30);
        const double middle = 0.5 * (new_low + new_high);
        const double above = newton > new_low ? newton : middle;
        const double inside = above < new_high ? above : middle;
        const double next = cz_larger(inside, lowest);
        sought->force[i] = moving > 0.0 ? next : f;
        sought->low[i] = moving > 0.0 ? new_low : low;
        sought->high[i] = moving > 0.0 ? new_high : high;
        some_move = cz_larger(some_move, moving);
    }
    return some_move == 0.0;
}

/* Finds the chain's force in all lanes, starting at the present one; returns whether all
 * converged. What changes from step to step is in rows of its own, which stay in registers. */
static int solve_linear(Chain *chain) {
    ChainState *now = &chain->now;
    Sought sought;
    CurveAt sum;
    CZ_LANES (i) {
        sought.force[i] = now->force[i];
        sought.low[i] = -1e10;
        sought.high[i] = 1e10;
    }
    int arrived = 0;
    for (int iteration = 0; iteration < CHAIN_ITERATIONS && !arrived; ++iteration) {
        unbalance(chain, sought.force, &sum);
        arrived = improve(now, &sum, &sought);
    }
    CZ_LANES (i) {
        now->force[i] = sought.force[i];
    }
    return arrived;
}

/* Stroke about which a spring is linearised: the committed one, or that under the chain's force. */
static inline void choose_stroke(const Chain *chain, int side, int again, double *restrict stroke) {
    const double *restrict committed = chain->spring[side].stroke;
    const double *restrict force = chain->now.force;
    const SpringState *spring = &chain->now.spring[side];
    if (!again) {
        CZ_LANES (i) {
            stroke[i] = committed[i];
        }
        return;
    }
    CZ_LANES (i) {
        const double excess = force[i] - spring->force[i];
        stroke[i] = spring->at[i] + excess * (excess > 0.0 ? spring->up[i] : spring->down[i]);
    }
}

/* Whether in some lane the law of a spring at its trial stroke differs from the chain's force. */
static inline int some_deviate(ChainState *now, const double *restrict force) {
    double *restrict distance = now->distance;
    double deviates = 0.0;
    CZ_LANES_MAX(i, deviates) {
        const double off = now->active[i] * fabs(force[i] - now->force[i]);
        distance[i] = cz_larger(distance[i], off);
        deviates = cz_larger(deviates, off > LAW_TOLERANCE ? 1.0 : 0.0);
    }
    return deviates > 0.0;
}

/* Accepts the linearisation of a spring about its trial stroke: in all lanes, or `again` where the
 * law's force there differs from the chain's. */
static void accept(ChainState *now, int side, int again, const SpringState *restrict trial) {
    SpringState *restrict spring = &now->spring[side];
    if (!again) {
        memcpy(spring, trial, sizeof *spring);
        return;
    }
    CZ_LANES (i) {
        const double off = now->active[i] * fabs(trial->force[i] - now->force[i]);
        const double at = trial->at[i], force = trial->force[i];
        const double up = trial->up[i], down = trial->down[i];
        spring->at[i] = off > LAW_TOLERANCE ? at : spring->at[i];
        spring->force[i] = off > LAW_TOLERANCE ? force : spring->force[i];
        spring->up[i] = off > LAW_TOLERANCE ? up : spring->up[i];
        spring->down[i] = off > LAW_TOLERANCE ? down : spring->down[i];
    }
}

/* A spring that no lane has is rigid. */
static int leave_out_spring(ChainState *now, int side, int again) {
    if (!again)
        memset(&now->spring[side], 0, sizeof now->spring[side]);
    return 0;
}

/* Linearises a plastic member about its committed stroke: strength with its rise, and rate
 * factor. */
static void prepare_plastic(Chain *chain, int number) {
    const Plastic *member = &chain->plastic[number];
    PlasticState *plastic = &chain->now.plastic[number];
    const double *restrict rise = member->rise, *restrict rate = member->rate;
    const double step = chain->step;
    CurveAt curve;
    evaluate_curve(member->curve, member->stroke, &curve);
    CZ_LANES (i) {
        const double scaled = curve.value[i] * (1.0 + rise[i]);
        plastic->compliance[i] =
            cz_plastic_compliance(scaled, curve.slope[i] * (1.0 + rise[i]), rate[i], step);
        plastic->strength[i] = scaled;
    }
}

/* Stroke of a plastic member under the chain's force; returns whether it yields in some lane. */
static int trial_of_plastic(const Chain *chain, int number, double *restrict stroke) {
    const double *restrict committed = chain->plastic[number].stroke;
    const double *restrict force = chain->now.force;
    const PlasticState *plastic = &chain->now.plastic[number];
    double some_crush = 0.0;
    CZ_LANES_MAX(i, some_crush) {
        stroke[i] =
            committed[i] + cz_plastic_crush(force[i], plastic->strength[i], plastic->compliance[i]);
        some_crush = cz_larger(some_crush, stroke[i] > committed[i] ? 1.0 : 0.0);
    }
    return some_crush > 0.0;
}

/* Linearises a plastic member about a trial stroke where its strength there, `curve`, differs from
 * the chain's force: with its tangent where the strength rises, such as in a stop; with constant
 * strength where it falls. Returns whether there are such lanes. */
static int accept_plastic(Chain *chain, int number, const double *restrict stroke,
                          const CurveAt *restrict curve) {
    ChainState *now = &chain->now;
    PlasticState *plastic = &now->plastic[number];
    const double *restrict committed = chain->plastic[number].stroke;
    const double *restrict rate = chain->plastic[number].rate;
    const double step = chain->step;
    double some_change = 0.0;
    CZ_LANES_MAX(i, some_change) {
        const double moved = stroke[i] - committed[i];
        const double tangent = cz_positive_part(curve->slope[i]);
        const double resistance = cz_plastic_resistance(curve->value[i], tangent, rate[i], step);
        const double start = curve->value[i] - tangent * moved;
        const double crushes = moved > 0.0 ? now->active[i] : 0.0;
        const double off = crushes * fabs(start + moved * resistance - now->force[i]);
        const double changed = off > LAW_TOLERANCE ? 1.0 : 0.0;
        now->distance[i] = cz_larger(now->distance[i], off);
        plastic->strength[i] = changed > 0.0 ? start : plastic->strength[i];
        plastic->compliance[i] = changed > 0.0 ? 1.0 / resistance : plastic->compliance[i];
        some_change = cz_larger(some_change, changed);
    }
    return some_change > 0.0;
}

/* The same for a member with a curve. */
static int relinearise_plastic(Chain *chain, int number) {
    const Plastic *member = &chain->plastic[number];
    const double *restrict rise = member->rise;
    _Alignas(64) CzRow stroke;
    CurveAt curve;
    if (!trial_of_plastic(chain, number, stroke))
        return 0;
    count_turns(member->curve, member->stroke, stroke, chain->now.falls);
    evaluate_curve(member->curve, stroke, &curve);
    CZ_LANES (i) {
        curve.value[i] *= 1.0 + rise[i];
        curve.slope[i] *= 1.0 + rise[i];
    }
    const int changed = accept_plastic(chain, number, stroke, &curve);
    chain->falls |= changed; /* perhaps: a breakpoint to a steeper slope counts too */
    return changed;
}

#endif
