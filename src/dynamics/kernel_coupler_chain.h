/* Couplers along their line: buffers, tubes and shear-offs in series. Part of kernel.c only.
 *
 * A shear-off lets go inside a step. The chain is first solved as if it held, which tells when its
 * force F_x is reached: the closure beyond that is what it would have to flow. Then it lets go, and
 * the step's mean force is that of the way through F_x,
 *
 *   theta (F_last + F_x) / 2 + (1 - theta) (s (F_x + F_end) / 2 + (1 - s) F_end)
 *
 * theta is the share of the step before F_x, s that of the rest in which the force falls: it falls
 * over a closure of softening - compliance F_x, at once where the chain gives way faster than the
 * shear-off softens. The integrator takes a step's impulse as the mean of the forces at its ends;
 * what that leaves out is added to the force on the bodies, once. Without it an outcome would not
 * depend on F_x but in jumps from step to step.
 */
#ifndef CZ_DYNAMICS_KERNEL_COUPLER_CHAIN_H
#define CZ_DYNAMICS_KERNEL_COUPLER_CHAIN_H

#include "dynamics/kernel_chain_solve.h"
#include "laws/shear_off.h"
#include "model/kinks.h"

#define LARGEST_PULL                                                                               \
    1e8 /* tension that whole coupled couplers carry [N]: more than any train asks for (ours) */

enum { SHEAR_OFF_A = 4, SHEAR_OFF_B = 5 }; /* plastic members of the chain */

static const Chain coupler_chain = {6,
                                    4,
                                    CZ_M_COUPLER_FORCE,
                                    CZ_M_BUFFER_A,
                                    CZ_M_TUBE_A,
                                    CZ_P_COUPLER_COMPLIANCE,
                                    CZ_CURVE_TUBE_A,
                                    CZ_P_TUBE_RATE_A,
                                    -1};
static const BufferRows coupler_buffer = {CZ_CURVE_BUFFER_A,        CZ_P_BUFFER_TRANSITION_A,
                                          CZ_P_BUFFER_SHARE_A,      CZ_P_BUFFER_DAMPING_A,
                                          CZ_P_BUFFER_QUADRATIC_A,  CZ_P_BUFFER_DRAW_STIFFNESS_A,
                                          CZ_P_BUFFER_DRAW_SLACK_A, CZ_M_BUFFER_RATE_A,
                                          CZ_M_BUFFER_OFFSET_A,     CZ_C_BUFFER_COMPLIANCE_A};

/* Linearises the shear-off of one side; the first time also tells the damage that it has done. */
static double linearise_shear_off(CzBlock *d, int side, double step, int again) {
    const size_t n = CZ_LANE_BLOCK;
    const int member = 4 + side;
    const double *restrict force = P_AT(SHEAR_FORCE_A, side), *restrict softening =
                                                                  P_AT(SHEAR_SOFTENING_A, side);
    const double *restrict space = P_AT(SHEAR_SPACE_A, side), *restrict bottom =
                                                                  P_AT(SHEAR_BOTTOM_A, side);
    const double *restrict residual = P_AT(SHEAR_RESIDUAL_A, side);
    double *trial = S(TRIAL_STROKE);
    if (again && trial_of_plastic(d, &coupler_chain, member, trial) == 0.0)
        return 0.0;
    const double *restrict travel = again ? trial : M_AT(SHEAR_A, side);
    double *restrict strength = S(CURVE_VALUE), *restrict slope = S(CURVE_SLOPE);
    double *restrict damage = again ? S(UNUSED) : S(DAMAGE);
    CZ_LANES (i, n) {
        const CzShearOffLaw law = {force[i], residual[i], cz_larger(softening[i], 1e-6), space[i],
                                   bottom[i]};
        const CzShearOffResponse response = cz_shear_off(&law, travel[i]);
        strength[i] = response.strength;
        slope[i] = response.slope;
        damage[i] = cz_larger(damage[i], response.damage);
    }
    if (again)
        return accept_plastic(d, &coupler_chain, member, trial, strength, slope, S(ZERO), step);
    double *restrict first = S_AT(STRENGTH_0, member), *restrict flow = S_AT(FLOW_0, member);
    CZ_LANES (i, n) {
        first[i] = strength[i];
        flow[i] = cz_plastic_compliance(strength[i], slope[i], 0.0, step);
    }
    return (double)n;
}

static double linearise_coupler_buffer(CzBlock *d, int side, double step, int again) {
    return linearise_buffer(d, &coupler_chain, &coupler_buffer, side, step, again);
}

static double coupler_buffer_force(const CzBlock *d, int side, size_t lane, double stroke,
                                   double step) {
    return buffer_force_at(d, &coupler_chain, &coupler_buffer, (Place){side, lane}, stroke, step);
}

static const Springs coupler_springs = {linearise_coupler_buffer, coupler_buffer_force, NULL};

/* Marks the lanes in which a shear-off flows as the active ones, and what begins there: the force
 * at which a whole one lets go, and the closure left after that, with what the springs took of it
 * while the smallest resistance held on. Returns whether there are any. */
static int mark_release(CzBlock *d) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict force = S(CHAIN_FORCE), *restrict compliance = P(COUPLER_COMPLIANCE);
    const double *restrict up_a = S(SPRING_UP_A), *restrict up_b = S(SPRING_UP_B);
    const double *restrict first_a = S_AT(STRENGTH_0, SHEAR_OFF_A), *restrict first_b = S_AT(
                                                                        STRENGTH_0, SHEAR_OFF_B);
    const double *restrict flow_a = S_AT(FLOW_0, SHEAR_OFF_A), *restrict flow_b =
                                                                   S_AT(FLOW_0, SHEAR_OFF_B);
    const double *restrict travel_a = M(SHEAR_A), *restrict travel_b = M(SHEAR_B);
    double *restrict active = S(CHAIN_ACTIVE);
    double *restrict released = S(RELEASE_FORCE), *restrict beyond = S(RELEASE_WAY);
    double n_flowing = 0.0;
    _Pragma("omp simd reduction(+ : n_flowing)") for (size_t i = 0; i < n; ++i) {
        const double way_a = cz_plastic_flow(force[i], first_a[i], flow_a[i]);
        const double way_b = cz_plastic_flow(force[i], first_b[i], flow_b[i]);
        const double new_a = travel_a[i] > 0.0 ? 0.0 : way_a;
        const double new_b = travel_b[i] > 0.0 ? 0.0 : way_b;
        const double of_a = new_a > 0.0 ? first_a[i] : CZ_NEVER;
        const double of_b = new_b > 0.0 ? first_b[i] : CZ_NEVER;
        const double begins = new_a + new_b > 0.0 ? active[i] : 0.0;
        const double at = begins > 0.0 ? cz_smaller(of_a, of_b) : force[i];
        const double sprung = (compliance[i] + up_a[i] + up_b[i]) * (force[i] - at);
        active[i] = way_a + way_b > 0.0 ? active[i] : 0.0;
        released[i] = begins * at;
        beyond[i] = begins * (new_a + new_b + sprung);
        n_flowing += active[i];
    }
    return n_flowing > 0.0;
}

/* Force that a shear-off of one side keeps at the end of the step in which it lets go, without what
 * the smallest resistance adds to so long a way, and its softening length; CZ_NEVER and 0 where it
 * does not. */
static void released_to(CzBlock *d, int side, double *restrict left, double *restrict softening) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict force = S(CHAIN_FORCE), *restrict travel = M_AT(SHEAR_A, side);
    const double *restrict strength = S_AT(STRENGTH_0, SHEAR_OFF_A + side), *restrict flow = S_AT(
                                                                                FLOW_0,
                                                                                SHEAR_OFF_A + side);
    const double *restrict length = P_AT(SHEAR_SOFTENING_A, side);
    CZ_LANES (i, n) {
        const double way = cz_plastic_flow(force[i], strength[i], flow[i]);
        const double begins = travel[i] > 0.0 ? 0.0 : way;
        const double keeps = force[i] - CZ_SMALLEST_RESISTANCE * way;
        left[i] = begins > 0.0 ? keeps : CZ_NEVER;
        softening[i] = begins > 0.0 ? length[i] : 0.0;
    }
}

/* Where a shear-off lets go: what the bodies get beyond the force at the end of the step. */
static void release_impulse(CzBlock *d, double step) {
    const size_t n = CZ_LANE_BLOCK;
    double *left_a = S(TRIAL_UP), *left_b = S(TRIAL_DOWN);
    double *softening_a = S(TRIAL_FORCE), *softening_b = S(TRIAL_STROKE);
    released_to(d, 0, left_a, softening_a);
    released_to(d, 1, left_b, softening_b);
    const double *restrict released = S(RELEASE_FORCE), *restrict beyond = S(RELEASE_WAY);
    const double *restrict last = M(COUPLER_FORCE), *restrict force = S(CHAIN_FORCE);
    const double *restrict rate = S(RATE), *restrict compliance = P(COUPLER_COMPLIANCE);
    const double *restrict down_a = S(SPRING_DOWN_A), *restrict down_b = S(SPRING_DOWN_B);
    const double *restrict kept_a = P(SHEAR_RESIDUAL_A), *restrict kept_b = P(SHEAR_RESIDUAL_B);
    double *restrict more = S(RELEASE_MORE);
    CZ_LANES (i, n) {
        const double rest = beyond[i] / cz_larger(cz_larger(rate[i] * step, beyond[i]), 1e-30);
        const double of_a = softening_a[i] > 0.0 ? kept_a[i] : 0.0;
        const double of_b = softening_b[i] > 0.0 ? kept_b[i] : 0.0;
        const double dropped = cz_positive_part(released[i] - cz_larger(of_a, of_b));
        const double back = (compliance[i] + down_a[i] + down_b[i]) * dropped;
        const double length = softening_a[i] + softening_b[i] - back;
        const double falls = cz_clamp(length / cz_larger(beyond[i], 1e-30), 0.0, 1.0);
        const double end = cz_smaller(cz_smaller(left_a[i], left_b[i]), released[i]);
        const double before = 0.5 * (last[i] + released[i]);
        const double after = end + 0.5 * falls * (released[i] - end);
        const double mean = before + rest * (after - before);
        const double given = end + mean - 0.5 * (last[i] + end);
        more[i] = released[i] > 0.0 ? given - force[i] : 0.0;
    }
}

/* Work of that on the members of the side that lets go. */
static void release_work(CzBlock *d, double step) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict more = S(RELEASE_MORE), *restrict rate = S(RATE);
    for (int side = 0; side < 2; ++side) {
        const double *restrict before = M_AT(SHEAR_A, side), *restrict other =
                                                                 M_AT(SHEAR_A, 1 - side);
        const double *restrict after = NEXT_AT(SHEAR_A, side), *restrict other_after =
                                                                   NEXT_AT(SHEAR_A, 1 - side);
        double *restrict all = NEXT_AT(COUPLER_ENERGY_A, side);
        double *restrict plastic = NEXT_AT(TUBE_ENERGY_A, side);
        CZ_LANES (i, n) {
            const double way = before[i] > 0.0 ? 0.0 : after[i];
            const double other_way = other[i] > 0.0 ? 0.0 : other_after[i];
            const double share = way / cz_larger(way + other_way, 1e-30);
            const double work = share * more[i] * rate[i] * step;
            all[i] += work;
            plastic[i] += work;
        }
    }
}

/* Buffers that snap back as a shear-off lets go: their force falls along their own law, at least to
 * that at the end of the step, and not in proportion to their way. What the mean force of the step
 * would have them give back beyond that, the shear-off does not get. */
static void snap_work(CzBlock *d) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict last = M(COUPLER_FORCE), *restrict force = NEXT(COUPLER_FORCE);
    const double *restrict shear_a = M(SHEAR_A), *restrict next_a = NEXT(SHEAR_A);
    const double *restrict shear_b = M(SHEAR_B), *restrict next_b = NEXT(SHEAR_B);
    const double *restrict buffer_a = M(BUFFER_A), *restrict moved_a = NEXT(BUFFER_A);
    const double *restrict buffer_b = M(BUFFER_B), *restrict moved_b = NEXT(BUFFER_B);
    double *restrict all_a = NEXT(COUPLER_ENERGY_A), *restrict all_b = NEXT(COUPLER_ENERGY_B);
    double *restrict tube_a = NEXT(TUBE_ENERGY_A), *restrict tube_b = NEXT(TUBE_ENERGY_B);
    CZ_LANES (i, n) {
        const double way_a = next_a[i] - shear_a[i], way_b = next_b[i] - shear_b[i];
        const double ways = way_a + way_b;
        const double falls = ways > 0.0 ? 0.5 * cz_positive_part(last[i] - force[i]) : 0.0;
        const double kept_a = falls * cz_positive_part(buffer_a[i] - moved_a[i]);
        const double kept_b = falls * cz_positive_part(buffer_b[i] - moved_b[i]);
        const double lost = (kept_a + kept_b) / cz_larger(ways, 1e-30);
        all_a[i] += kept_a - lost * way_a;
        all_b[i] += kept_b - lost * way_b;
        tube_a[i] -= lost * way_a;
        tube_b[i] -= lost * way_b;
    }
}

/* Lets shear-offs go where they are to flow; returns how often the force was found anew. */
static int release(CzBlock *d, double step) {
    if (!mark_release(d))
        return 0;
    d->releases = 1;
    int n_anew = 0;
    if (linearise_shear_off(d, 0, step, 1) + linearise_shear_off(d, 1, step, 1) > 0.0) {
        const int found = solve_linear(d, &coupler_chain, S(CLOSURE));
        n_anew =
            1 + settle_chain(d, &coupler_chain, &coupler_springs, linearise_shear_off, step, found);
    }
    release_impulse(d, step);
    return n_anew;
}

/* Whether no chain pushes or could pull. Their sums at no force then tell up to which closure that
 * will stay so, for as long as nothing moves: a sum falls with the closure alone. */
static int couplers_are_slack(CzBlock *d) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict active = S(CHAIN_ACTIVE), *restrict lowest = S(CHAIN_LOWEST);
    const double *restrict closure = S(CLOSURE), *restrict damage = S(DAMAGE);
    const double *force = S(CHAIN_FORCE);
    double n_busy = 0.0;
    _Pragma("omp simd reduction(+ : n_busy)") for (size_t i = 0; i < n; ++i) {
        const double pulls = lowest[i] < 0.0 ? active[i] : 0.0;
        n_busy += fabs(force[i]) + pulls;
    }
    if (n_busy != 0.0)
        return 0;
    double *sum = S(CURVE_VALUE), *restrict reach = d->coupler_reach;
    unbalance(d, &coupler_chain, closure, sum, S(CURVE_SLOPE));
    double n_closed = 0.0;
    _Pragma("omp simd reduction(+ : n_closed)") for (size_t i = 0; i < n; ++i) {
        const double of_chain = closure[i] + sum[i] - REACH_MARGIN;
        const double of_hinges = damage[i] >= 1.0 ? CZ_NEVER : 0.0; /* ENGAGED is 0 up to here */
        reach[i] = active[i] > 0.0 ? cz_smaller(of_chain, of_hinges) : CZ_NEVER;
        n_closed += closure[i] <= reach[i] ? 0.0 : 1.0;
    }
    return n_closed == 0.0;
}

/* Largest force of a step in which a shear-off lets go or a tube's strength falls. */
static void coupler_top(CzBlock *d) {
    const size_t n = CZ_LANE_BLOCK;
    double *restrict top = S(COUPLER_TOP);
    if (d->falls) {
        chain_top(d, &coupler_chain);
        memcpy(top, S(CHAIN_TOP), sizeof(CzRow));
    }
    if (d->releases) {
        const double *restrict released = S(RELEASE_FORCE);
        CZ_LANES (i, n) {
            top[i] = cz_larger(top[i], released[i]);
        }
    }
}

/* Strengths of the shear-offs, what the chains can pull, and where they exist. */
static void prepare_couplers(CzBlock *d, double step) {
    const size_t n = CZ_LANE_BLOCK;
    memset(S(DAMAGE), 0, sizeof(CzRow));
    if (d->releases) {
        memset(S(RELEASE_FORCE), 0, sizeof(CzRow));
        memset(S(RELEASE_MORE), 0, sizeof(CzRow));
        d->releases = 0;
    }
    for (int side = 0; side < 2; ++side)
        linearise_shear_off(d, side, step, 0);
    const double *restrict coupled = P(COUPLED), *restrict exists = P(COUPLER),
                           *restrict damage = S(DAMAGE);
    double *restrict lowest = S(CHAIN_LOWEST), *restrict active = S(CHAIN_ACTIVE);
    CZ_LANES (i, n) {
        lowest[i] = -LARGEST_PULL * coupled[i] * (1.0 - damage[i]);
        active[i] = exists[i];
    }
}

/* Force of the chain, and the members moved on; returns whether it would be the same again for any
 * closure up to the couplers' reach. */
static int coupler_chain_force(CzBlock *d, double step) {
    prepare_couplers(d, step);
    const int found = start_chain(d, &coupler_chain, &coupler_springs, step);
    int n_anew = settle_chain(d, &coupler_chain, &coupler_springs, NULL, step, found);
    n_anew += release(d, step);
    memcpy(S(CHAIN_ACTIVE), P(COUPLER), sizeof(CzRow));
    finish_chain(d, &coupler_chain);
    move_members(d, &coupler_chain, CZ_M_COUPLER_ENERGY_A, CZ_M_TUBE_ENERGY_A);
    if (d->releases) {
        release_work(d, step);
        snap_work(d);
    }
    coupler_top(d);
    keep_rates(d, &coupler_chain, CZ_M_BUFFER_RATE_A, step);
    return n_anew == 0 && couplers_are_slack(d);
}

#endif
