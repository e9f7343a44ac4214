/* Series chains: one force passes through all members, their shortenings add up to the closure.
 * Part of kernel.c only. This part: the members linearised, and the force that balances them;
 * kernel_chain_search.h finds the force from the laws themselves in one lane, kernel_chain_solve.h
 * is the solution of a step.
 *
 *   sum over springs of (x + (F - F_x) c(F))
 *       + sum over plastic members of (s + flow(F)) + C F = closure
 *
 * The left side grows with F and is piecewise linear, so Newton's method with a bracket finds F in
 * as many steps as kinks are passed. F never falls below what the chain can pull (0 where nothing
 * couples). Lanes that have arrived are left alone, so that a lane's answer does not depend on its
 * neighbours.
 */
#ifndef CZ_DYNAMICS_KERNEL_CHAIN_H
#define CZ_DYNAMICS_KERNEL_CHAIN_H

#include "dynamics/kernel_rows.h"

#include <string.h>

#include "laws/buffer.h"
#include "laws/plastic_member.h"
#include "laws/vehicle_end.h"

enum { CHAIN_ITERATIONS = 60 };
#define CHAIN_TOLERANCE 1e-13 /* closure left unbalanced [m] */
#define REACH_MARGIN 1e-6     /* more than the rounding of a chain's sum by far [m] (ours) */
#define LAW_TOLERANCE 1.0     /* force by which a member may miss its law [N] (ours) */

/* What a chain is made of: first rows of its members; side B follows side A. */
typedef struct {
    int n_plastic, n_curve;     /* plastic members; those of them that have a curve come first */
    int force, spring, plastic; /* CzMemory: chain force, spring strokes, plastic strokes */
    int compliance;             /* CzParameter */
    int curve, rate;            /* CzCurveId and CzParameter (rate factor) of the first member */
    int rise;                   /* CzScratch: rise of the strengths, of side A; -1: none */
} Chain;

/* Linearises a member of one side: the first time about its committed stroke, later about where
 * the chain's force takes it, in the lanes where it misses its law. Returns how many those are. */
typedef double Linearise(CzBlock *d, int side, double step, int again);

/* Force of the spring of one side at a stroke, in one lane: the law that Linearise linearises. */
typedef double ForceAt(const CzBlock *d, int side, size_t lane, double stroke, double step);

/* First stroke from `from` on at which the law of that spring, being loaded, begins to fall, or to
 * rise again (`rises`); infinite where there is none. */
typedef double TurnsAt(const CzBlock *d, int side, size_t lane, double from, int rises,
                       double step);

/* The springs of a chain. */
typedef struct {
    Linearise *linearise;
    ForceAt *force_at;
    TurnsAt *turns_at; /* NULL: none ever falls */
} Springs;

/* Buffers as the springs of a chain. */
typedef struct {
    int curve; /* CzCurveId of side A */
    int transition, share, damping, quadratic, draw,
        slack;        /* CzParameter of side A; draw -1: no tension */
    int rate, offset; /* CzMemory of side A */
    int compliance;   /* CzConstant of side A */
} BufferRows;

/* Whether a plastic member is missing in all lanes: it would neither flow nor add to any sum. */
static int is_missing(const CzBlock *d, const Chain *chain, int member) {
    return member < chain->n_curve && !d->curve[chain->curve + member].is_there;
}

/* Sum of the members' shortenings less the closure, and its derivative, at the chain's present
 * force. */
static void unbalance(const CzBlock *d, const Chain *chain, const double *restrict closure,
                      double *restrict sum, double *restrict slope) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict force = S(CHAIN_FORCE);
    const double *restrict compliance = d->parameter[chain->compliance];
    CZ_LANES (i, n) {
        sum[i] = compliance[i] * force[i] - closure[i];
        slope[i] = compliance[i];
    }
    for (int side = 0; side < 2; ++side) {
        const double *restrict at = S_AT(SPRING_AT_A, side);
        const double *restrict rest = S_AT(SPRING_FORCE_A, side);
        const double *restrict up = S_AT(SPRING_UP_A, side);
        const double *restrict down = S_AT(SPRING_DOWN_A, side);
        CZ_LANES (i, n) {
            const double excess = force[i] - rest[i];
            const double c = excess > 0.0 ? up[i] : down[i];
            sum[i] += at[i] + excess * c;
            slope[i] += c;
        }
    }
    for (int member = 0; member < chain->n_plastic; ++member) {
        if (is_missing(d, chain, member))
            continue;
        const double *restrict stroke = d->memory[chain->plastic + member];
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
static int improve(CzBlock *d, const double *restrict sum, const double *restrict slope) {
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

/* Finds the chain's force in all lanes from the one in S(CHAIN_FORCE) on; returns whether it did.
 */
static int solve_linear(CzBlock *d, const Chain *chain, const double *closure) {
    const size_t n = CZ_LANE_BLOCK;
    double *restrict low = S(CHAIN_LOW);
    double *restrict high = S(CHAIN_HIGH);
    double *sum = S(CURVE_VALUE);
    double *slope = S(CURVE_SLOPE);
    CZ_LANES (i, n) {
        low[i] = -1e10;
        high[i] = 1e10;
    }
    int arrived = 0;
    for (int iteration = 0; iteration < CHAIN_ITERATIONS && !arrived; ++iteration) {
        unbalance(d, chain, closure, sum, slope);
        arrived = improve(d, sum, slope);
    }
    return arrived;
}

/* Where a spring is linearised: its committed stroke, or where the chain's force takes it. */
static void choose_stroke(CzBlock *d, const Chain *chain, int side, int again,
                          double *restrict stroke) {
    const size_t n = CZ_LANE_BLOCK;
    if (!again) {
        const double *restrict committed = d->memory[chain->spring + side];
        CZ_LANES (i, n) {
            stroke[i] = committed[i];
        }
        return;
    }
    const double *restrict force = S(CHAIN_FORCE), *restrict at = S_AT(SPRING_AT_A, side);
    const double *restrict rest = S_AT(SPRING_FORCE_A, side);
    const double *restrict up = S_AT(SPRING_UP_A, side), *restrict down = S_AT(SPRING_DOWN_A, side);
    CZ_LANES (i, n) {
        const double excess = force[i] - rest[i];
        stroke[i] = at[i] + excess * (excess > 0.0 ? up[i] : down[i]);
    }
}

/* Takes over a spring's linearisation about `stroke` where it is the first one or the law's force
 * there is not the chain's; returns in how many lanes. */
static double accept(CzBlock *d, int side, int again, const double *restrict stroke,
                     const double *restrict law_force, const double *restrict loading,
                     const double *restrict unloading) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict force = S(CHAIN_FORCE), *restrict active = S(CHAIN_ACTIVE);
    double *restrict at = S_AT(SPRING_AT_A, side), *restrict rest = S_AT(SPRING_FORCE_A, side);
    double *restrict up = S_AT(SPRING_UP_A, side), *restrict down = S_AT(SPRING_DOWN_A, side);
    const double first = again ? 0.0 : 1.0;
    double *restrict distance = S(LAW_DISTANCE);
    double n_changed = 0.0;
    _Pragma("omp simd reduction(+ : n_changed)") for (size_t i = 0; i < n; ++i) {
        const double off = active[i] * fabs(law_force[i] - force[i]);
        const double changed = first + (off > LAW_TOLERANCE ? 1.0 : 0.0);
        distance[i] = cz_larger(distance[i], off);
        at[i] = changed > 0.0 ? stroke[i] : at[i];
        rest[i] = changed > 0.0 ? law_force[i] : rest[i];
        up[i] = changed > 0.0 ? loading[i] : up[i];
        down[i] = changed > 0.0 ? unloading[i] : down[i];
        n_changed += changed;
    }
    return n_changed;
}

/* Linearises a spring that no lane has: it is rigid, whatever the force. */
static double leave_out_spring(CzBlock *d, int side) {
    memset(S_AT(SPRING_AT_A, side), 0, sizeof(CzRow));
    memset(S_AT(SPRING_FORCE_A, side), 0, sizeof(CzRow));
    memset(S_AT(SPRING_UP_A, side), 0, sizeof(CzRow));
    memset(S_AT(SPRING_DOWN_A, side), 0, sizeof(CzRow));
    return 0.0;
}

/* One side of the chain in one lane. */
typedef struct {
    int side;
    size_t lane;
} Place;

/* The law of a buffer in a lane at a stroke, where the first linearisation has taken its offset. */
static double buffer_force_at(const CzBlock *d, const Chain *chain, const BufferRows *rows,
                              Place place, double stroke, double step) {
    const int side = place.side, pulls = rows->draw >= 0;
    const size_t i = place.lane;
    const CzBufferLaw law = {cz_larger(d->parameter[rows->transition + side][i], 1.0),
                             d->parameter[rows->share + side][i],
                             d->parameter[rows->damping + side][i],
                             d->parameter[rows->quadratic + side][i],
                             pulls ? d->parameter[rows->draw + side][i] : 0.0,
                             pulls ? d->parameter[rows->slack + side][i] : 0.0,
                             d->curve[rows->curve + side].usable[i]};
    double value, slope;
    curve_at(d, rows->curve + side, i, stroke, &value, &slope);
    const CzBufferResponse response =
        cz_buffer_of(&law, d->constant[rows->compliance + side][i], value, slope, stroke,
                     stroke - d->memory[chain->spring + side][i], d->memory[rows->rate + side][i],
                     d->next_memory[rows->offset + side][i], step);
    return response.force;
}

/* Linearises a buffer as spring member `side` of the chain. The hysteresis starts from where the
 * committed stroke has taken it. */
static double linearise_buffer(CzBlock *d, const Chain *chain, const BufferRows *rows, int side,
                               double step, int again) {
    const size_t n = CZ_LANE_BLOCK;
    double *stroke = S(TRIAL_STROKE);
    choose_stroke(d, chain, side, again, stroke);
    const double *restrict committed = d->memory[chain->spring + side];
    double *restrict curve = S(CURVE_VALUE);
    double *restrict slope = S(CURVE_SLOPE);
    evaluate_curve(d, rows->curve + side, stroke, curve, slope);
    const double *restrict transition = d->parameter[rows->transition + side];
    const double *restrict share = d->parameter[rows->share + side];
    const double *restrict damping = d->parameter[rows->damping + side];
    const double *restrict quadratic = d->parameter[rows->quadratic + side];
    const int pulls = rows->draw >= 0;
    const double *restrict draw = pulls ? d->parameter[rows->draw + side] : S(ZERO);
    const double *restrict slack = pulls ? d->parameter[rows->slack + side] : S(ZERO);
    const double *restrict rate = d->memory[rows->rate + side];
    const double *restrict offset = (again ? d->next_memory : d->memory)[rows->offset + side];
    double *restrict next_offset = again ? S(UNUSED) : d->next_memory[rows->offset + side];
    const double *restrict usable = d->curve[rows->curve + side].usable;
    const double *restrict compliance = d->constant[rows->compliance + side];
    double *restrict force = S(TRIAL_FORCE), *restrict up = S(TRIAL_UP),
                     *restrict down = S(TRIAL_DOWN);
    CZ_LANES (i, n) {
        const CzBufferLaw law = {cz_larger(transition[i], 1.0),
                                 share[i],
                                 damping[i],
                                 quadratic[i],
                                 draw[i],
                                 slack[i],
                                 usable[i]};
        const CzBufferResponse response =
            cz_buffer_of(&law, compliance[i], curve[i], slope[i], stroke[i],
                         stroke[i] - committed[i], rate[i], offset[i], step);
        force[i] = response.force;
        up[i] = response.loading;
        down[i] = response.unloading;
        next_offset[i] = response.offset;
    }
    return accept(d, side, again, stroke, force, up, down);
}

/* Rise of the strength of a plastic member. */
static const double *rise_of(CzBlock *d, const Chain *chain, int member) {
    return chain->rise < 0 ? S(ZERO) : d->scratch[chain->rise + member % 2];
}

/* Sets a plastic member: strength over its stroke, with its rise and its rate factor. */
static void prepare_plastic(CzBlock *d, const Chain *chain, int member, double step) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict stroke = d->memory[chain->plastic + member];
    const double *restrict rate = d->parameter[chain->rate + member];
    const double *restrict rise = rise_of(d, chain, member);
    double *restrict strength = S_AT(STRENGTH_0, member);
    double *restrict flow = S_AT(FLOW_0, member);
    evaluate_curve(d, chain->curve + member, stroke, strength, flow);
    CZ_LANES (i, n) {
        const double scaled = strength[i] * (1.0 + rise[i]);
        flow[i] = cz_plastic_compliance(scaled, flow[i] * (1.0 + rise[i]), rate[i], step);
        strength[i] = scaled;
    }
}

/* Where the chain's force takes a plastic member; returns in how many lanes it flows. */
static double trial_of_plastic(CzBlock *d, const Chain *chain, int member,
                               double *restrict stroke) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict force = S(CHAIN_FORCE);
    const double *restrict committed = d->memory[chain->plastic + member];
    const double *restrict strength = S_AT(STRENGTH_0, member), *restrict flow =
                                                                    S_AT(FLOW_0, member);
    double n_flowing = 0.0;
    _Pragma("omp simd reduction(+ : n_flowing)") for (size_t i = 0; i < n; ++i) {
        stroke[i] = committed[i] + cz_plastic_flow(force[i], strength[i], flow[i]);
        n_flowing += stroke[i] > committed[i] ? 1.0 : 0.0;
    }
    return n_flowing;
}

/* Linearises a plastic member about a trial stroke where its strength there, `curve` with `slope`,
 * is not the chain's force: with its tangent where the strength rises, such as in a stop; with the
 * strength itself where it falls. Returns in how many lanes. */
static double accept_plastic(CzBlock *d, const Chain *chain, int member,
                             const double *restrict stroke, const double *restrict curve,
                             const double *restrict slope, const double *restrict rate,
                             double step) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict force = S(CHAIN_FORCE), *restrict active = S(CHAIN_ACTIVE);
    const double *restrict committed = d->memory[chain->plastic + member];
    double *restrict strength = S_AT(STRENGTH_0, member), *restrict flow = S_AT(FLOW_0, member);
    double *restrict distance = S(LAW_DISTANCE);
    double n_changed = 0.0;
    _Pragma("omp simd reduction(+ : n_changed)") for (size_t i = 0; i < n; ++i) {
        const double way = stroke[i] - committed[i];
        const double tangent = cz_positive_part(slope[i]);
        const double compliance = cz_plastic_compliance(curve[i], tangent, rate[i], step);
        const double start = curve[i] - tangent * way;
        const double flows = way > 0.0 ? active[i] : 0.0;
        const double off = flows * fabs(start + way / compliance - force[i]);
        const double changed = off > LAW_TOLERANCE ? 1.0 : 0.0;
        distance[i] = cz_larger(distance[i], off);
        strength[i] = changed > 0.0 ? start : strength[i];
        flow[i] = changed > 0.0 ? compliance : flow[i];
        n_changed += changed;
    }
    return n_changed;
}

/* The same for a member with a curve. */
static double relinearise_plastic(CzBlock *d, const Chain *chain, int member, double step) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict rise = rise_of(d, chain, member);
    double *stroke = S(TRIAL_STROKE);
    double *restrict curve = S(CURVE_VALUE), *restrict slope = S(CURVE_SLOPE);
    if (trial_of_plastic(d, chain, member, stroke) == 0.0)
        return 0.0;
    count_turns(d, chain->curve + member, d->memory[chain->plastic + member], stroke, S(LAW_FALLS));
    evaluate_curve(d, chain->curve + member, stroke, curve, slope);
    CZ_LANES (i, n) {
        curve[i] *= 1.0 + rise[i];
        slope[i] *= 1.0 + rise[i];
    }
    const double n_changed = accept_plastic(d, chain, member, stroke, curve, slope,
                                            d->parameter[chain->rate + member], step);
    d->falls |= n_changed > 0.0; /* may: a kink upwards is taken too */
    return n_changed;
}

#endif
