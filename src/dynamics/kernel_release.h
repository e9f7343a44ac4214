/* Shear-offs of couplers. Part of kernel.c only.
 *
 * A shear-off releases inside a step. The chain is first solved as if it held, which gives the
 * moment when its force F_x is reached and the closure beyond that. Then it releases, and the
 * step's mean force is that of the path through F_x,
 *
 *   theta (F_last + F_x) / 2 + (1 - theta) (s (F_x + F_end) / 2 + (1 - s) F_end)
 *
 * theta is the share of the step before F_x, s that of the rest in which the force falls: it falls
 * over a closure of softening - compliance F_x, at once where the chain deflects faster than the
 * shear-off softens. The integrator takes a step's impulse as the mean of the forces at its ends;
 * the remainder is added once to the force on the bodies. Without it results would change with F_x
 * only in jumps from step to step.
 */
#ifndef CZ_DYNAMICS_KERNEL_RELEASE_H
#define CZ_DYNAMICS_KERNEL_RELEASE_H

#include "dynamics/kernel_buffer.h"
#include "dynamics/kernel_chain_solve.h"

enum { SHEAR_OFF = 4 }; /* plastic member of the chain, of side A */

/* A release in this step. */
typedef struct {
    CzRow force; /* at which a shear-off releases; 0 where none does [N] */
    CzRow left;  /* closure of the step after that [m] */
    CzRow more;  /* mean force of the step less the mean of the forces at its ends [N] */
} Release;

/* The chain of the couplers. */
typedef struct {
    BufferChain buffers;       /* must be first: the solution passes its address back */
    _Alignas(64) CzRow damage; /* share of the coupler's strength lost by the shear-off */
    Release release;
    int yields;   /* a shear-off travels in this step */
    int releases; /* an undamaged one releases in this step */
} CouplerChain;

/* A shear-off that no lane has never yields. */
static int leave_out_shear_off(PlasticState *plastic) {
    CZ_LANES (i) {
        plastic->strength[i] = CZ_NEVER;
        plastic->compliance[i] = 0.0;
    }
    return 0;
}

/* Linearises the shear-off of one side; the first time also computes the damage. */
static int linearise_shear_off(Chain *chain, int side, int again) {
    const int member = SHEAR_OFF + side;
    const CzShearOffRows *restrict rows = chain->plastic[member].shear;
    PlasticState *plastic = &chain->now.plastic[member];
    const double step = chain->step;
    _Alignas(64) CzRow trial, unused = {0.0};
    CurveAt curve;
    if (chain->plastic[member].is_missing)
        return leave_out_shear_off(plastic);
    if (again && !trial_of_plastic(chain, member, trial))
        return 0;
    const double *restrict travel = again ? trial : chain->plastic[member].stroke;
    double *restrict damage = again ? unused : ((CouplerChain *)chain)->damage;
    CZ_LANES (i) {
        const CzShearOffLaw law = cz_shear_off_at(rows, i);
        const CzShearOffResponse response = cz_shear_off(&law, travel[i]);
        curve.value[i] = response.strength;
        curve.slope[i] = response.slope;
        damage[i] = cz_larger(damage[i], response.damage);
    }
    if (again)
        return accept_plastic(chain, member, trial, &curve);
    CZ_LANES (i) {
        plastic->strength[i] = curve.value[i];
        plastic->compliance[i] = cz_plastic_compliance(curve.value[i], curve.slope[i], 0.0, step);
    }
    return 1;
}

/* Makes the lanes in which a shear-off yields the active ones. Finds the force at which an
 * undamaged one releases there and the closure left after that, including the deflection of the
 * springs beyond this force. Sets `yields` and `releases`. */
static void mark_release(CouplerChain *of) {
    Chain *chain = &of->buffers.chain;
    ChainState *now = &chain->now;
    const Plastic *shear_off = &chain->plastic[SHEAR_OFF];
    const PlasticState *state = &now->plastic[SHEAR_OFF];
    const double *restrict compliance = chain->compliance;
    double yields = 0.0, releases = 0.0;
    _Pragma("omp simd reduction(max : yields, releases)") for (size_t i = 0; i < CZ_LANE_BLOCK;
                                                               ++i) {
        const double force = now->force[i];
        double all_moved = 0.0, new_moved = 0.0, weakest = CZ_NEVER;
        for (int side = 0; side < 2; ++side) {
            const double strength = state[side].strength[i];
            const double moved = cz_plastic_crush(force, strength, state[side].compliance[i]);
            const double begun = shear_off[side].stroke[i] > 0.0 ? 0.0 : moved;
            all_moved += moved;
            new_moved += begun;
            weakest = cz_smaller(weakest, begun > 0.0 ? strength : CZ_NEVER);
        }
        const double begins = new_moved > 0.0 ? now->active[i] : 0.0;
        const double at = begins > 0.0 ? weakest : force;
        const double sprung =
            (compliance[i] + now->spring[0].up[i] + now->spring[1].up[i]) * (force - at);
        now->active[i] = all_moved > 0.0 ? now->active[i] : 0.0;
        of->release.force[i] = begins * at;
        of->release.left[i] = begins * (new_moved + sprung);
        yields = cz_larger(yields, now->active[i]);
        releases = cz_larger(releases, begins);
    }
    of->yields = yields > 0.0;
    of->releases = releases > 0.0;
}

/* Force after release of the shear-offs that release, both sides. */
typedef struct {
    _Alignas(
        64) CzRow force; /* smallest at the end of the step; CZ_NEVER where none releases [N] */
    CzRow residual;      /* largest residual friction [N] */
    CzRow softening;     /* sum of their lengths [m] */
} Kept;

/* Adds one side, without the part of the force due to CZ_SMALLEST_RESISTANCE. */
static void add_kept(const Chain *chain, int side, Kept *restrict kept) {
    const double *restrict force = chain->now.force;
    const double *restrict travel = chain->plastic[SHEAR_OFF + side].stroke;
    const PlasticState *plastic = &chain->now.plastic[SHEAR_OFF + side];
    const CzShearOffRows *restrict rows = chain->plastic[SHEAR_OFF + side].shear;
    CZ_LANES (i) {
        const double moved =
            cz_plastic_crush(force[i], plastic->strength[i], plastic->compliance[i]);
        const double begins = travel[i] > 0.0 ? 0.0 : moved;
        const double keeps = force[i] - CZ_SMALLEST_RESISTANCE * moved;
        const double softening = begins > 0.0 ? rows->softening[i] : 0.0;
        kept->force[i] = cz_smaller(kept->force[i], begins > 0.0 ? keeps : CZ_NEVER);
        kept->residual[i] = cz_larger(kept->residual[i], softening > 0.0 ? rows->residual[i] : 0.0);
        kept->softening[i] += softening;
    }
}

/* Where a shear-off releases: force on the bodies in addition to that at the end of the step. */
static void release_impulse(const double *restrict rate, CouplerChain *of) {
    const Chain *chain = &of->buffers.chain;
    const ChainState *now = &chain->now;
    const double *restrict last = chain->last, *restrict compliance = chain->compliance;
    const double step = chain->step;
    Release *release = &of->release;
    Kept kept = {.residual = {0.0}, .softening = {0.0}};
    CZ_LANES (i) {
        kept.force[i] = CZ_NEVER;
    }
    for (int side = 0; side < 2; ++side)
        add_kept(chain, side, &kept);
    CZ_LANES (i) {
        const double released = release->force[i], beyond = release->left[i];
        const double rest = beyond / cz_larger(cz_larger(rate[i] * step, beyond), 1e-30);
        const double dropped = cz_positive_part(released - kept.residual[i]);
        const double back =
            (compliance[i] + now->spring[0].down[i] + now->spring[1].down[i]) * dropped;
        const double length = kept.softening[i] - back;
        const double falls = cz_clamp(length / cz_larger(beyond, 1e-30), 0.0, 1.0);
        const double end = cz_smaller(kept.force[i], released);
        const double before = 0.5 * (last[i] + released);
        const double after = end + 0.5 * falls * (released - end);
        const double mean = before + rest * (after - before);
        const double given = end + mean - 0.5 * (last[i] + end);
        release->more[i] = released > 0.0 ? given - now->force[i] : 0.0;
    }
}

/* Releases shear-offs in lanes where they yield; returns how often the force was solved again. */
static int release(CzBlock *d, const double *restrict rate, CouplerChain *of) {
    Chain *chain = &of->buffers.chain;
    of->yields = of->releases = 0;
    if (!chain->plastic[SHEAR_OFF].is_missing || !chain->plastic[SHEAR_OFF + 1].is_missing)
        mark_release(of);
    if (!of->yields)
        return 0;
    int n_anew = 0;
    if (linearise_shear_off(chain, 0, 1) | linearise_shear_off(chain, 1, 1)) {
        const int found = solve_linear(chain);
        n_anew = 1 + settle_chain(chain, &d->published, linearise_shear_off, found);
    }
    if (of->releases)
        release_impulse(rate, of);
    return n_anew;
}

/* Work of the additional force on the members of the side that releases. */
static void release_work(CzBlock *d, const double *restrict rate, const CouplerChain *of) {
    const double *restrict more = of->release.more;
    const double step = of->buffers.chain.step;
    const CzCouplerMemory *restrict memory = &d->memory->coupler;
    CzCouplerMemory *restrict next = &d->next_memory->coupler;
    for (int side = 0; side < 2; ++side)
        CZ_LANES (i) {
            const double own = memory->side[side].shear[i] > 0.0 ? 0.0 : next->side[side].shear[i];
            const double other =
                memory->side[1 - side].shear[i] > 0.0 ? 0.0 : next->side[1 - side].shear[i];
            const double share = own / cz_larger(own + other, 1e-30);
            const double work = share * more[i] * rate[i] * step;
            next->side[side].energy[i] += work;
            next->side[side].tube_energy[i] += work;
        }
}

/* Buffers that snap back as a shear-off releases: their force falls along their own law, at least
 * to that at the end of the step, and not in proportion to their travel. The energy that they would
 * return beyond that under the mean force of the step is not given to the shear-off. */
static void snap_work(const CzCouplerMemory *restrict memory, CzCouplerMemory *restrict next) {
    CZ_LANES (i) {
        double moved[2], back[2];
        for (int side = 0; side < 2; ++side) {
            moved[side] = next->side[side].shear[i] - memory->side[side].shear[i];
            back[side] = cz_positive_part(memory->side[side].buffer.stroke[i] -
                                          next->side[side].buffer.stroke[i]);
        }
        const double all_moved = moved[0] + moved[1];
        const double fell = 0.5 * cz_positive_part(memory->force[i] - next->force[i]);
        const double falls = all_moved > 0.0 ? fell : 0.0;
        const double lost = (falls * back[0] + falls * back[1]) / cz_larger(all_moved, 1e-30);
        for (int side = 0; side < 2; ++side) {
            next->side[side].energy[i] += falls * back[side] - lost * moved[side];
            next->side[side].tube_energy[i] -= lost * moved[side];
        }
    }
}

#endif
