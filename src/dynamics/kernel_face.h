/* Anti-climbers (or the bare ends) and side buffers: contact of faces, along the normal a series
 * chain, across it ribs and friction. Part of kernel.c only. */
#ifndef CZ_DYNAMICS_KERNEL_FACE_H
#define CZ_DYNAMICS_KERNEL_FACE_H

#include "dynamics/kernel_chain_solve.h"
#include "dynamics/kernel_contact.h"
#include <string.h>

#include "dynamics/stored.h"
#include "laws/ribs.h"
#include "laws/slider.h"

#define LARGE_DROP 0.01 /* share of its force that a spring loses in a step (ours) */

static const Chain face_chain = {2,
                                 2,
                                 CZ_M_FACE_FORCE,
                                 CZ_M_LIMP_A,
                                 CZ_M_FACE_A,
                                 CZ_P_FACE_COMPLIANCE,
                                 CZ_CURVE_FACE_A,
                                 CZ_P_FACE_RATE_A,
                                 CZ_S_SPEED_RISE_A};
static const ContactRows face_contact = {CZ_P_FACE_X_A, CZ_P_FACE_Z_A, CZ_P_FACE_X_B,
                                         CZ_P_FACE_Z_B, CZ_P_FACE_GAP, CZ_P_FACE_RISE};
static const Chain side_chain = {2,
                                 2,
                                 CZ_M_SIDE_FORCE,
                                 CZ_M_SIDE_BUFFER_A,
                                 CZ_M_SIDE_TUBE_A,
                                 CZ_P_SIDE_COMPLIANCE,
                                 CZ_CURVE_SIDE_TUBE_A,
                                 CZ_P_SIDE_RATE_A,
                                 -1};
static const BufferRows side_buffer = {CZ_CURVE_SIDE_BUFFER_A,
                                       CZ_P_SIDE_TRANSITION_A,
                                       CZ_P_SIDE_SHARE_A,
                                       CZ_P_SIDE_DAMPING_A,
                                       CZ_P_SIDE_QUADRATIC_A,
                                       -1,
                                       -1,
                                       CZ_M_SIDE_RATE_A,
                                       CZ_M_SIDE_OFFSET_A,
                                       CZ_C_SIDE_COMPLIANCE_A};
static const ContactRows side_contact = {CZ_P_SIDE_X_A, CZ_P_SIDE_Z_A, CZ_P_SIDE_X_B,
                                         CZ_P_SIDE_Z_B, CZ_P_SIDE_GAP, CZ_P_SIDE_RISE};

/* Force per way of this step that the damping of a crush zone without end mass adds: scaled in over
 * the stroke that it had before. */
static inline double limp_damper(double damping, double committed, double step) {
    return damping * cz_fade_in(committed, CZ_FADE_LENGTH) / step;
}

/* Linearises a crush zone without end mass as spring member `side`, a damper beside it. A lane
 * without one is rigid: its compliance is 0. */
static double linearise_limp_end(CzBlock *d, int side, double step, int again) {
    const size_t n = CZ_LANE_BLOCK;
    if (!d->has_limp_end[side])
        return leave_out_spring(d, side);
    double *shortening = S(TRIAL_STROKE);
    choose_stroke(d, &face_chain, side, again, shortening);
    double *restrict curve = S(CURVE_VALUE), *restrict slope = S(CURVE_SLOPE);
    double *restrict peak = S(CURVE_PEAK), *restrict largest = S(LARGEST);
    largest_of_stages(d, CZ_CURVE_LIMP_END_A + side, M_AT(LIMP_PEAK_A, side), largest);
    double *restrict falls = S(LAW_FALLS);
    evaluate_curve(d, CZ_CURVE_LIMP_END_A + side, largest, peak, S(UNUSED));
    evaluate_curve(d, CZ_CURVE_LIMP_END_A + side, shortening, curve, slope);
    const double *restrict unloading = P_AT(LIMP_UNLOADING_A, side), *restrict share =
                                                                         P_AT(LIMP_SHARE_A, side);
    const double *restrict second = P_AT(LIMP_SECOND_UNLOADING_A, side);
    const double *restrict exists = P_AT(LIMP_END_A, side), *restrict wanted = S(CHAIN_FORCE);
    const double *restrict damping = P_AT(LIMP_DAMPING_A, side), *restrict committed =
                                                                     M_AT(LIMP_A, side);
    double *restrict force = S(TRIAL_FORCE);
    double *restrict up = S(TRIAL_UP), *restrict down = S(TRIAL_DOWN);
    const double is_again = again ? 1.0 : 0.0;
    CZ_LANES (i, n) {
        const CzVehicleEndLaw law = {cz_larger(unloading[i], 1.0), share[i],
                                     cz_larger(second[i], 1.0), 0.0};
        const CzVehicleEndResponse response =
            cz_vehicle_end(&law, curve[i], peak[i], shortening[i], largest[i]);
        const double loading = cz_larger(slope[i], CZ_SMALLEST_STIFFNESS);
        const double path =
            response.force < curve[i] ? response.slope : cz_larger(slope[i], response.slope);
        const double stop = shortening[i] > largest[i] ? slope[i] : path;
        const double damper = limp_damper(damping[i], committed[i], step);
        const double resists = response.force + damper * (shortening[i] - committed[i]);
        const double off = fabs(resists - wanted[i]);
        const double drops = off > LARGE_DROP * fabs(wanted[i]) ? is_again : 0.0;
        const double falling = slope[i] + damper < 0.0 ? exists[i] * drops : 0.0;
        const double back = cz_larger(shortening[i] > 0.0 ? stop : slope[i], CZ_SMALLEST_STIFFNESS);
        falls[i] += shortening[i] > largest[i] ? falling : 0.0;
        force[i] = exists[i] > 0.5 ? resists : wanted[i];
        up[i] = exists[i] / (damper + (shortening[i] >= largest[i] ? loading : back));
        down[i] = exists[i] / (damper + back);
    }
    if (again)
        count_turns(d, CZ_CURVE_LIMP_END_A + side, largest, shortening, falls);
    return accept(d, side, again, shortening, force, up, down);
}

/* The law of that in one lane. */
static double limp_end_force(const CzBlock *d, int side, size_t i, double shortening, double step) {
    const int id = CZ_CURVE_LIMP_END_A + side;
    const CzVehicleEndLaw law = {cz_larger(P_AT(LIMP_UNLOADING_A, side)[i], 1.0),
                                 P_AT(LIMP_SHARE_A, side)[i],
                                 cz_larger(P_AT(LIMP_SECOND_UNLOADING_A, side)[i], 1.0), 0.0};
    const double largest = cz_smaller(M_AT(LIMP_PEAK_A, side)[i], d->curve[id].usable[i]);
    double backbone, peak, slope;
    curve_at(d, id, i, largest, &peak, &slope);
    curve_at(d, id, i, shortening, &backbone, &slope);
    const double committed = M_AT(LIMP_A, side)[i];
    const double damper = limp_damper(P_AT(LIMP_DAMPING_A, side)[i], committed, step);
    return cz_vehicle_end(&law, backbone, peak, shortening, largest).force +
           damper * (shortening - committed);
}

static double limp_end_turns(const CzBlock *d, int side, size_t i, double from, int rises,
                             double step) {
    const double committed = M_AT(LIMP_A, side)[i];
    const double damper = limp_damper(P_AT(LIMP_DAMPING_A, side)[i], committed, step);
    const double loaded = cz_larger(from, cz_larger(committed, M_AT(LIMP_PEAK_A, side)[i]));
    const Resistance added = {committed, 0.0, SEARCH_STIFFNESS + damper};
    return curve_turns_at(d, CZ_CURVE_LIMP_END_A + side, i, loaded, rises, &added);
}

static const Springs face_springs = {linearise_limp_end, limp_end_force, limp_end_turns};

/* The closing speed at first contact is frozen; the rise of one side's strength follows from it. */
static void speed_factor(CzBlock *d, int side) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict closure = S(CLOSURE), *restrict rate = S(RATE),
                           *restrict speed = M(FACE_SPEED);
    const double *restrict factor = P_AT(SPEED_FACTOR_A, side);
    double *restrict next = NEXT(FACE_SPEED), *restrict rise = S_AT(SPEED_RISE_A, side);
    CZ_LANES (i, n) {
        const double touching = closure[i] > 0.0 ? cz_larger(rate[i], 1e-9) : 0.0;
        next[i] = speed[i] > 0.0 ? speed[i] : touching;
        rise[i] = factor[i] * next[i];
    }
}

/* Normal force of the faces: chain, damping, and what is left of them while the overlap runs out.
 * What has let go does not take hold again before the faces have parted. */
static void face_normal(CzBlock *d) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict chain = S(CHAIN_FORCE), *restrict closure = S(CLOSURE),
                           *restrict rate = S(RATE);
    const double *restrict damping = P(FACE_DAMPING), *restrict level = P(FACE_OVERLAP),
                           *restrict pitch = P(RIB_PITCH);
    const double *restrict slip = S(SLIP);
    double *restrict normal = S(FACE_FORCE), *restrict remaining = S(FACE_REMAINING);
    const double *restrict lost_before = M(FACE_LOST);
    double *restrict lost_next = NEXT(FACE_LOST);
    double *restrict power = POWER(FACE), *restrict lost = POWER(FACE_DAMPING);
    CZ_LANES (i, n) {
        const double wanted =
            damping[i] * cz_positive_part(rate[i]) * cz_fade_in(closure[i], CZ_FADE_LENGTH);
        const double damped = cz_smaller(wanted, chain[i]);
        const double overlap = level[i] - fabs(slip[i]);
        const double gone = 1.0 - cz_clamp(overlap / pitch[i], 0.0, 1.0);
        const double most = cz_larger(lost_before[i], gone);
        const double held = 1.0 - most;
        lost_next[i] = closure[i] > 0.0 ? most : 0.0;
        remaining[i] = overlap;
        normal[i] = held * (chain[i] + damped);
        power[i] += held * chain[i] * rate[i];
        lost[i] += held * damped * rate[i];
    }
}

/* Members of faces that have let go are carried on without work: of the mean force of the step they
 * count what was and is held. */
static void count_held(CzBlock *d, const double *restrict before, double *restrict next) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict lost = NEXT(FACE_LOST), *restrict lost_before = M(FACE_LOST);
    const double *restrict force = NEXT(FACE_FORCE), *restrict last = M(FACE_FORCE);
    CZ_LANES (i, n) {
        const double held = (1.0 - lost_before[i]) * last[i] + (1.0 - lost[i]) * force[i];
        const double share = held / cz_larger(last[i] + force[i], 1e-30);
        next[i] = before[i] + share * (next[i] - before[i]);
    }
}

/* Work on the compliance of the faces: what it stored is lost where they let go under load. */
static void strain_faces(CzBlock *d) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict compliance = P(FACE_COMPLIANCE), *restrict lost = NEXT(FACE_LOST);
    const double *restrict force = NEXT(FACE_FORCE), *restrict last = M(FACE_FORCE);
    const double *restrict lost_before = M(FACE_LOST), *restrict before = M(FACE_STRAIN);
    double *restrict after = NEXT(FACE_STRAIN);
    CZ_LANES (i, n) {
        const double held = (1.0 - lost_before[i]) * last[i] + (1.0 - lost[i]) * force[i];
        after[i] = before[i] + 0.5 * held * compliance[i] * (force[i] - last[i]);
    }
}

/* Vertical force of the faces: they stick, by ribs and friction, up to a capacity. */
static void face_tangential(CzBlock *d) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict normal = S(FACE_FORCE), *restrict closure = S(CLOSURE),
                           *restrict slip = S(SLIP);
    const double *restrict slip_rate = S(SLIP_RATE), *restrict pitch = P(RIB_PITCH);
    const double *restrict level = P(FACE_OVERLAP), *restrict depth = P(RIB_DEPTH),
                           *restrict ribs = P(RIB_CAPACITY);
    const double *restrict friction = P(FACE_FRICTION), *restrict stiffness =
                                                            P(FACE_VERTICAL_STIFFNESS);
    const double *restrict offset = M(FACE_SLIP), *restrict compliance = C(GRIP_COMPLIANCE);
    const double *restrict slipped = M(FACE_SLIPPED), *restrict sheared = M(FACE_SHEARED);
    double *restrict next = NEXT(FACE_SLIP), *restrict next_slipped = NEXT(FACE_SLIPPED),
                     *restrict next_sheared = NEXT(FACE_SHEARED);
    double *restrict ready = S(FACE_READY), *restrict tangential = S(FACE_DEMAND);
    double *restrict power = POWER(FACE_SLIDING);
    const double *restrict nx = S(NORMAL_X), *restrict nz = S(NORMAL_Z);
    double *restrict ramp = S(FACE_RAMP);
    CZ_LANES (i, n) {
        const CzRibsLaw law = {pitch[i], level[i], depth[i], ribs[i], friction[i]};
        const CzRibsResponse grip = cz_ribs(&law, slip[i], closure[i], normal[i], sheared[i]);
        const CzSliderResponse held =
            cz_slider_of(stiffness[i], compliance[i], grip.capacity, slip[i], offset[i]);
        const double way = grip.engaged * fabs(held.offset - offset[i]);
        ready[i] = grip.ready;
        next[i] = held.offset;
        next_slipped[i] = slipped[i] + way;
        next_sheared[i] = sheared[i] + grip.mesh * way;
        tangential[i] = held.force;
        ramp[i] = fabs(nz[i]) / nx[i];
        power[i] += held.force * slip_rate[i];
    }
}

/* Whether no chain pushes. Their sums at no force then tell up to which closure that will stay so,
 * for as long as nothing moves; a face that was never touched remembers the speed of the first
 * touch. */
static int faces_are_slack(CzBlock *d) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict closure = S(CLOSURE), *restrict speed = M(FACE_SPEED);
    const double *force = S(CHAIN_FORCE);
    double n_busy = 0.0;
    _Pragma("omp simd reduction(+ : n_busy)") for (size_t i = 0; i < n; ++i) {
        n_busy += fabs(force[i]);
    }
    if (n_busy != 0.0)
        return 0;
    double *sum = S(CURVE_VALUE), *restrict reach = d->face_reach;
    unbalance(d, &face_chain, closure, sum, S(CURVE_SLOPE));
    double n_closed = 0.0;
    _Pragma("omp simd reduction(+ : n_closed)") for (size_t i = 0; i < n; ++i) {
        const double of_chain = closure[i] + sum[i] - REACH_MARGIN;
        reach[i] = cz_smaller(of_chain, speed[i] > 0.0 ? of_chain : -REACH_MARGIN);
        n_closed += closure[i] <= reach[i] ? 0.0 : 1.0;
    }
    return n_closed == 0.0;
}

/* Whether the evaluation at hand leaves the memory of the faces as it was, but for where the ribs
 * will seat. */
static int faces_remember(const CzBlock *d) {
    const size_t before = (size_t)(CZ_M_FACE_SLIP - CZ_M_FACE_FORCE) * sizeof(CzRow);
    const size_t after = (size_t)(CZ_M_FACE_STRAIN - CZ_M_FACE_SLIP) * sizeof(CzRow);
    return memcmp(M(FACE_FORCE), NEXT(FACE_FORCE), before) == 0 &&
           memcmp(M(FACE_ENERGY_A), NEXT(FACE_ENERGY_A), after) == 0;
}

/* Whether the last evaluation changed nothing and no face has come within reach since. */
static int faces_are_apart(CzBlock *d) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict closure = S(CLOSURE), *restrict reach = d->face_reach;
    double n_near = d->faces_rest ? 0.0 : 1.0;
    _Pragma("omp simd reduction(+ : n_near)") for (size_t i = 0; i < n; ++i) {
        n_near += closure[i] <= reach[i] ? 0.0 : 1.0; /* not a number is near */
    }
    return n_near == 0.0;
}

/* The answer for faces that are apart: no force, ribs that will seat where they meet. Both copies
 * of the other memory hold what would be left. */
static void leave_faces(CzBlock *d) {
    memset(S(FACE_FORCE), 0, sizeof(CzRow));
    memset(S(FACE_DEMAND), 0, sizeof(CzRow));
    memset(S(FACE_READY), 0, sizeof(CzRow));
    memcpy(NEXT(FACE_SLIP), S(SLIP), sizeof(CzRow));
}

/* Largest force of a step in which a strength of the chain at hand falls, into the element's `top`,
 * and what the interface and sections without end mass lost by it; `normal` is the force at the end
 * of the step. */
static void contact_top(CzBlock *d, const Chain *chain, const double *restrict normal,
                        double *restrict top) {
    const size_t n = CZ_LANE_BLOCK;
    if (!d->falls)
        return;
    chain_top(d, chain);
    const double *restrict force = S(CHAIN_FORCE), *restrict chain_most = S(CHAIN_TOP);
    const double *restrict nx = S(NORMAL_X), *restrict slaved = P(SLAVED_ENDS),
                           *restrict slaved_ahead = C(SLAVED_ENDS_AHEAD);
    double *restrict drop = S(STEP_DROP), *restrict section = S(SECTION_FRONT),
                     *restrict pushed = S(PUSHED_SECTION);
    CZ_LANES (i, n) {
        const double held = normal[i] / cz_larger(force[i], 1.0); /* damped, on what overlaps */
        const double more = held * cz_positive_part(chain_most[i] - force[i]);
        const double lost = more * nx[i];
        top[i] = normal[i] + more;
        drop[i] += lost;
        section[i] += slaved[i] * lost;
        pushed[i] += slaved_ahead[i] * lost;
    }
}

/* Largest shortening of a crush zone without end mass, and what its damping took in the step. */
static void keep_limp(CzBlock *d, int side, double step) {
    const size_t n = CZ_LANE_BLOCK;
    const double *restrict peak = M_AT(LIMP_PEAK_A, side), *restrict before = M_AT(LIMP_A, side);
    const double *restrict now = NEXT_AT(LIMP_A, side), *restrict damped =
                                                            M_AT(LIMP_DAMPED_A, side);
    const double *restrict damping = P_AT(LIMP_DAMPING_A, side);
    const double *restrict last = M_AT(LIMP_RESISTS_A, side);
    double *restrict next_peak = NEXT_AT(LIMP_PEAK_A, side);
    double *restrict resists = NEXT_AT(LIMP_RESISTS_A, side);
    double *restrict next_damped = NEXT_AT(LIMP_DAMPED_A, side);
    CZ_LANES (i, n) {
        const double way = now[i] - before[i];
        const double resisting = limp_damper(damping[i], before[i], step) * way;
        next_peak[i] = cz_larger(peak[i], now[i]);
        resists[i] = resisting;
        next_damped[i] = damped[i] + 0.5 * (last[i] + resisting) * way;
    }
}

/* All anti-climbers and bare ends; 0 when all are apart. */
static int faces(CzBlock *d, double step) {
    const size_t n = CZ_LANE_BLOCK;
    const Carrier a = end_carrier(d, 0), b = end_carrier(d, 1);
    contact_geometry(d, &a, &b, &face_contact);
    if (faces_are_apart(d)) {
        leave_faces(d);
        return 0;
    }
    memcpy(S(FACE_CLOSURE), S(CLOSURE), sizeof(CzRow));
    for (int side = 0; side < 2; ++side)
        speed_factor(d, side);
    double *restrict lowest = S(CHAIN_LOWEST), *restrict active = S(CHAIN_ACTIVE);
    CZ_LANES (i, n) {
        lowest[i] = 0.0;
        active[i] = 1.0;
    }
    const int settled = solve_chain(d, &face_chain, &face_springs, step);
    move_members(d, &face_chain, CZ_M_LIMP_ENERGY_A, CZ_M_FACE_ENERGY_A);
    for (int side = 0; side < 2; ++side)
        keep_limp(d, side, step);
    d->faces_rest = settled && faces_are_slack(d) && faces_remember(d) && !d->leaves_nothing_out;
    face_normal(d);
    contact_top(d, &face_chain, S(FACE_FORCE), S(FACE_TOP));
    for (int side = 0; side < 2; ++side) {
        count_held(d, M_AT(FACE_ENERGY_A, side), NEXT_AT(FACE_ENERGY_A, side));
        count_held(d, M_AT(LIMP_ENERGY_A, side), NEXT_AT(LIMP_ENERGY_A, side));
    }
    strain_faces(d);
    face_tangential(d);
    const CarrierForce on_a = end_force(d, 0), on_b = end_force(d, 1);
    contact_forces(d, &on_a, &on_b, S(FACE_FORCE), S(FACE_DEMAND));
    /* Where the ends have no mass, the force goes straight into the body's section. */
    add(n, S(SECTION_FRONT), P(SLAVED_ENDS), S(CURVE_VALUE));
    add(n, S(PUSHED_SECTION), C(SLAVED_ENDS_AHEAD), S(CURVE_VALUE));
    return 1;
}

static double linearise_side_buffer(CzBlock *d, int side, double step, int again) {
    return linearise_buffer(d, &side_chain, &side_buffer, side, step, again);
}

static double side_buffer_force(const CzBlock *d, int side, size_t lane, double stroke,
                                double step) {
    return buffer_force_at(d, &side_chain, &side_buffer, (Place){side, lane}, stroke, step);
}

static const Springs side_springs = {linearise_side_buffer, side_buffer_force, NULL};

/* All side buffers: on the end masses, so that the crush zones lie behind them. */
static void side_buffers(CzBlock *d, double step) {
    const size_t n = CZ_LANE_BLOCK;
    const Carrier a = end_carrier(d, 0), b = end_carrier(d, 1);
    contact_geometry(d, &a, &b, &side_contact);
    memcpy(S(SIDE_CLOSURE), S(CLOSURE), sizeof(CzRow));
    double *restrict lowest = S(CHAIN_LOWEST), *restrict active = S(CHAIN_ACTIVE);
    const double *restrict exists = P(SIDE_BUFFERS);
    CZ_LANES (i, n) {
        lowest[i] = 0.0;
        active[i] = exists[i];
    }
    solve_chain(d, &side_chain, &side_springs, step);
    move_members(d, &side_chain, CZ_M_SIDE_ENERGY_A, CZ_M_SIDE_TUBE_ENERGY_A);
    keep_rates(d, &side_chain, CZ_M_SIDE_RATE_A, step);

    /* Friction of the plates. */
    const double *restrict force = S(CHAIN_FORCE), *restrict friction = P(SIDE_FRICTION);
    const double *restrict slip = S(SLIP), *restrict rate = S(RATE),
                           *restrict slip_rate = S(SLIP_RATE);
    const double *restrict offset = M(SIDE_SLIP);
    double *restrict next = NEXT(SIDE_SLIP), *restrict kept = S(SIDE_FORCE),
                     *restrict tangential = S(SIDE_SLIDING);
    double *restrict power = POWER(SIDE), *restrict sliding = POWER(SIDE_SLIDING);
    CZ_LANES (i, n) {
        const CzSliderResponse grip =
            cz_slider(CZ_PLATE_STIFFNESS, friction[i] * force[i], slip[i], offset[i]);
        next[i] = grip.offset;
        kept[i] = force[i];
        tangential[i] = grip.force;
        power[i] += force[i] * rate[i];
        sliding[i] += grip.force * slip_rate[i];
    }
    contact_top(d, &side_chain, S(SIDE_FORCE), S(SIDE_TOP));
    const CarrierForce on_a = end_force(d, 0), on_b = end_force(d, 1);
    contact_forces(d, &on_a, &on_b, S(SIDE_FORCE), S(SIDE_SLIDING));
    add(n, S(SECTION_FRONT), P(SLAVED_ENDS), S(CURVE_VALUE));
    add(n, S(PUSHED_SECTION), C(SLAVED_ENDS_AHEAD), S(CURVE_VALUE));
}

#endif
