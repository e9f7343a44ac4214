/* Crush zones without an end mass, in series with the anti-climbers: springs of the faces' chain,
 * with a damper parallel to each. Part of kernel.c only. */
#ifndef CZ_DYNAMICS_KERNEL_MASSLESS_H
#define CZ_DYNAMICS_KERNEL_MASSLESS_H

#include "dynamics/kernel_chain_solve.h"
#include "laws/buffer.h"

#define LARGE_DROP 0.01 /* share of its force that a chain loses in a step (ours) */

/* The crush zone of one side. */
typedef struct {
    const double *exists;
    const CzCrushRows *rows;
    const double *compliance, *second_compliance; /* 1 / unloading stiffnesses */
    const CzBlockCurve *curve;                    /* backbone */
    const CzMasslessMemory *memory;
    CzMasslessMemory *next;
    _Alignas(64) CzRow largest; /* shortening within the stages, before the step [m] */
    CzRow peak;                 /* backbone force there [N] */
    CzRow damper;               /* force of its damping per travel in the step [N/m] */
} Massless;

/* The chain of the faces. */
typedef struct {
    Chain chain; /* must be first: the solution passes its address back */
    Massless massless[2];
    _Alignas(64) CzRow rise[2]; /* of the anti-climbers' strength by the speed at first contact */
} FaceChain;

/* Computes what stays the same in a step. */
static void begin_massless(Massless *massless, double step) {
    const double *restrict damping = massless->rows->damping, *restrict committed =
                                                                  massless->memory->stroke;
    double *restrict damper = massless->damper;
    CurveAt peak;
    largest_of_stages(massless->curve, massless->memory->peak, massless->largest);
    evaluate_curve(massless->curve, massless->largest, &peak);
    memcpy(massless->peak, peak.value, sizeof(CzRow));
    CZ_LANES (i) {
        damper[i] = cz_vehicle_end_damper(damping[i], committed[i], step);
    }
}

/* Force of the crush zone at a stroke; `path` is the slope of its path there. Adds to `falls` in
 * the lanes where the chain has taken it far down a falling part. */
static void resist_massless(const Chain *chain, const Massless *massless, int again,
                            const CurveAt *restrict curve, const double *restrict stroke,
                            double *restrict force, double *restrict path, double *restrict falls) {
    const double *restrict exists = massless->exists, *restrict committed =
                                                          massless->memory->stroke;
    const double *restrict largest = massless->largest, *restrict peak = massless->peak;
    const double *restrict compliance = massless->compliance, *restrict second =
                                                                  massless->second_compliance;
    const double *restrict wanted = chain->now.force, *restrict damper = massless->damper;
    const CzCrushRows *restrict rows = massless->rows;
    const double is_again = again ? 1.0 : 0.0;
    CZ_LANES (i) {
        const CzVehicleEndLaw law = cz_crush_at(rows, i);
        const double shortening = stroke[i], slope = curve->slope[i], backbone = curve->value[i];
        const CzVehicleEndResponse response = cz_vehicle_end_of(
            &law, compliance[i], second[i], backbone, peak[i], shortening, largest[i]);
        const double resists = response.force + damper[i] * (shortening - committed[i]);
        const double off = fabs(resists - wanted[i]);
        const double drops = off > LARGE_DROP * fabs(wanted[i]) ? is_again : 0.0;
        const double falling = slope + damper[i] < 0.0 ? exists[i] * drops : 0.0;
        falls[i] += shortening > largest[i] ? falling : 0.0;
        force[i] = exists[i] > 0.5 ? resists : wanted[i];
        path[i] = response.force < backbone ? response.slope : cz_larger(slope, response.slope);
    }
}

/* Linearises the crush zone of a side. A lane without one is rigid: its compliance is 0. */
static int linearise_massless(Chain *chain, int side, int again) {
    Massless *massless = &((FaceChain *)chain)->massless[side];
    if (chain->spring[side].is_missing)
        return leave_out_spring(&chain->now, side, again);
    const double *restrict exists = massless->exists, *restrict damper = massless->damper;
    const double *restrict largest = massless->largest;
    _Alignas(64) CzRow path;
    CurveAt curve;
    SpringState trial;
    if (!again)
        begin_massless(massless, chain->step);
    choose_stroke(chain, side, again, trial.at);
    evaluate_curve(massless->curve, trial.at, &curve);
    resist_massless(chain, massless, again, &curve, trial.at, trial.force, path, chain->now.falls);
    if (again)
        count_turns(massless->curve, largest, trial.at, chain->now.falls);
    if (again && !some_deviate(&chain->now, trial.force))
        return 0;
    CZ_LANES (i) {
        const double shortening = trial.at[i], slope = curve.slope[i];
        const double loading = cz_larger(slope, CZ_SMALLEST_STIFFNESS);
        const double stop = shortening > largest[i] ? slope : path[i];
        const double back = cz_larger(shortening > 0.0 ? stop : slope, CZ_SMALLEST_STIFFNESS);
        trial.up[i] = exists[i] / (damper[i] + (shortening >= largest[i] ? loading : back));
        trial.down[i] = exists[i] / (damper[i] + back);
    }
    accept(&chain->now, side, again, &trial);
    return 1;
}

/* Its force in one lane. */
static double massless_force(const Chain *chain, int side, size_t i, double shortening) {
    const Massless *massless = &((const FaceChain *)chain)->massless[side];
    const CzVehicleEndLaw law = cz_crush_at(massless->rows, i);
    const double moved = shortening - massless->memory->stroke[i];
    double backbone, slope;
    curve_at(massless->curve, i, shortening, &backbone, &slope);
    return cz_vehicle_end_of(&law, massless->compliance[i], massless->second_compliance[i],
                             backbone, massless->peak[i], shortening, massless->largest[i])
               .force +
           massless->damper[i] * moved;
}

static double massless_turns(const Chain *chain, int side, size_t i, double from, int rises) {
    const Massless *massless = &((const FaceChain *)chain)->massless[side];
    const double committed = massless->memory->stroke[i];
    const double loaded = cz_larger(from, cz_larger(committed, massless->memory->peak[i]));
    const Resistance added = {committed, 0.0, SEARCH_STIFFNESS + massless->damper[i]};
    return curve_turns_at(massless->curve, i, loaded, rises, &added);
}

static const SpringLaw crush_zones = {linearise_massless, massless_force, massless_turns};

/* Stores the largest shortening and the energy dissipated by the damping in the step. */
static void keep_massless(const Massless *massless) {
    const CzMasslessMemory *restrict before = massless->memory;
    CzMasslessMemory *restrict next = massless->next;
    const double *restrict damper = massless->damper;
    CZ_LANES (i) {
        const double moved = next->stroke[i] - before->stroke[i];
        const double resisting = damper[i] * moved;
        next->peak[i] = cz_larger(before->peak[i], next->stroke[i]);
        next->resists[i] = resisting;
        next->damped[i] = before->damped[i] + 0.5 * (before->resists[i] + resisting) * moved;
    }
}

#endif
