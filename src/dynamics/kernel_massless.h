/* Crush zones without an end mass, in series with the anti-climbers: springs of the faces' chain,
 * with a damper parallel to each. Part of kernel.c only. */
#ifndef CZ_DYNAMICS_KERNEL_MASSLESS_H
#define CZ_DYNAMICS_KERNEL_MASSLESS_H

#include "dynamics/kernel_chain_solve.h"
#include "laws/buffer.h"

#define LARGE_DROP 0.01 /* share of its force that a chain loses in a step (ours) */

/* The crush zone of one side. */
typedef struct {
    int in_some_lane;
    const double *exists;
    const CzCrushRows *rows;
    const CzBlockCurve *curve; /* backbone */
    const CzMasslessMemory *memory;
    CzMasslessMemory *next;
} Massless;

/* The chain of the faces. */
typedef struct {
    Chain chain; /* must be first: the solution passes its address back */
    Massless massless[2];
    _Alignas(64) CzRow rise[2]; /* of the anti-climbers' strength by the speed at first contact */
} FaceChain;

/* Linearises the crush zone of a side. A lane without one is rigid: its compliance is 0. */
static double linearise_massless(Chain *chain, int side, int again) {
    const Massless *massless = &((const FaceChain *)chain)->massless[side];
    if (!massless->in_some_lane)
        return leave_out_spring(&chain->now, side);
    const CzCrushRows *restrict rows = massless->rows;
    const double *restrict exists = massless->exists, *restrict committed =
                                                          massless->memory->stroke;
    const double *restrict wanted = chain->now.force;
    double *restrict falls = chain->now.falls;
    const double step = chain->step, is_again = again ? 1.0 : 0.0;
    _Alignas(64) CzRow largest;
    CurveAt curve, peak;
    Trial trial;
    choose_stroke(chain, side, again, trial.stroke);
    largest_of_stages(massless->curve, massless->memory->peak, largest);
    evaluate_curve(massless->curve, largest, &peak);
    evaluate_curve(massless->curve, trial.stroke, &curve);
    CZ_LANES (i) {
        const CzVehicleEndLaw law = cz_crush_at(rows, i);
        const double shortening = trial.stroke[i], slope = curve.slope[i];
        const CzVehicleEndResponse response =
            cz_vehicle_end(&law, curve.value[i], peak.value[i], shortening, largest[i]);
        const double loading = cz_larger(slope, CZ_SMALLEST_STIFFNESS);
        const double path =
            response.force < curve.value[i] ? response.slope : cz_larger(slope, response.slope);
        const double stop = shortening > largest[i] ? slope : path;
        const double damper = cz_vehicle_end_damper(rows->damping[i], committed[i], step);
        const double resists = response.force + damper * (shortening - committed[i]);
        const double off = fabs(resists - wanted[i]);
        const double drops = off > LARGE_DROP * fabs(wanted[i]) ? is_again : 0.0;
        const double falling = slope + damper < 0.0 ? exists[i] * drops : 0.0;
        const double back = cz_larger(shortening > 0.0 ? stop : slope, CZ_SMALLEST_STIFFNESS);
        falls[i] += shortening > largest[i] ? falling : 0.0;
        trial.force[i] = exists[i] > 0.5 ? resists : wanted[i];
        trial.up[i] = exists[i] / (damper + (shortening >= largest[i] ? loading : back));
        trial.down[i] = exists[i] / (damper + back);
    }
    if (again)
        count_turns(massless->curve, largest, trial.stroke, falls);
    return accept(&chain->now, side, again, &trial);
}

/* Its force in one lane. */
static double massless_force(const Chain *chain, int side, size_t i, double shortening) {
    const Massless *massless = &((const FaceChain *)chain)->massless[side];
    const CzVehicleEndLaw law = cz_crush_at(massless->rows, i);
    const double largest = cz_smaller(massless->memory->peak[i], massless->curve->usable[i]);
    const double committed = massless->memory->stroke[i];
    double backbone, peak, slope;
    curve_at(massless->curve, i, largest, &peak, &slope);
    curve_at(massless->curve, i, shortening, &backbone, &slope);
    const double damper = cz_vehicle_end_damper(massless->rows->damping[i], committed, chain->step);
    return cz_vehicle_end(&law, backbone, peak, shortening, largest).force +
           damper * (shortening - committed);
}

static double massless_turns(const Chain *chain, int side, size_t i, double from, int rises) {
    const Massless *massless = &((const FaceChain *)chain)->massless[side];
    const double committed = massless->memory->stroke[i];
    const double damper = cz_vehicle_end_damper(massless->rows->damping[i], committed, chain->step);
    const double loaded = cz_larger(from, cz_larger(committed, massless->memory->peak[i]));
    const Resistance added = {committed, 0.0, SEARCH_STIFFNESS + damper};
    return curve_turns_at(massless->curve, i, loaded, rises, &added);
}

static const SpringLaw crush_zones = {linearise_massless, massless_force, massless_turns};

/* Stores the largest shortening and the energy dissipated by the damping in the step. */
static void keep_massless(const Massless *massless, double step) {
    const CzMasslessMemory *restrict before = massless->memory;
    CzMasslessMemory *restrict next = massless->next;
    const double *restrict damping = massless->rows->damping;
    CZ_LANES (i) {
        const double moved = next->stroke[i] - before->stroke[i];
        const double resisting = cz_vehicle_end_damper(damping[i], before->stroke[i], step) * moved;
        next->peak[i] = cz_larger(before->peak[i], next->stroke[i]);
        next->resists[i] = resisting;
        next->damped[i] = before->damped[i] + 0.5 * (before->resists[i] + resisting) * moved;
    }
}

#endif
