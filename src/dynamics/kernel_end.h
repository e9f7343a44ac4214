/* Crush zone, vertical guidance and folding of one end of a car, between its end mass and the body.
 * Part of kernel.c only.
 *
 * Every force acts at one point on both bodies, on the axis of the crush zone at the end mass.
 */
#ifndef CZ_DYNAMICS_KERNEL_END_H
#define CZ_DYNAMICS_KERNEL_END_H

#include "dynamics/kernel_end_line.h"
#include "dynamics/kernel_massless.h"
#include "laws/link.h"
#include "laws/slider.h"

/* Force of the crush zone along the axis. */
static void crush_end(CzBlock *d, int end, const EndLine *restrict line) {
    const CzCrushRows *restrict rows = &d->parameter.end[end].crush;
    const CzBlockCurve *backbone = &d->curve.end[end];
    const double *restrict stroke = d->published.end[end].stroke;
    const double *restrict before = d->memory->end[end].peak;
    const double *restrict compliance = d->constant.end_compliance[end],
                           *restrict second = d->constant.end_second_compliance[end];
    double *restrict next = d->next_memory->end[end].peak;
    double *restrict force = d->published.end[end].force;
    double *restrict power = d->power->end[end], *restrict lost = d->power->end_damping[end];
    CzPeak *peak = &d->end_peak[end];
    _Alignas(64) CzRow largest;
    CurveAt curve;
    CZ_LANES (i) {
        next[i] = cz_larger(before[i], stroke[i]);
    }
    largest_of_stages(backbone, next, largest);
    if (memcmp(largest, peak->at, sizeof(CzRow)) != 0) {
        evaluate_curve(backbone, largest, &curve);
        memcpy(peak->force, curve.value, sizeof(CzRow));
        memcpy(peak->at, largest, sizeof(CzRow));
    }
    evaluate_curve(backbone, stroke, &curve);
    CZ_LANES (i) {
        const CzVehicleEndLaw law = cz_crush_at(rows, i);
        const CzVehicleEndResponse response = cz_vehicle_end_of(
            &law, compliance[i], second[i], curve.value[i], peak->force[i], stroke[i], largest[i]);
        const double damped = cz_vehicle_end_damping(rows->damping[i], stroke[i], line->rate[i]);
        force[i] = response.force + damped;
        power[i] = response.force * line->rate[i];
        lost[i] += damped * line->rate[i];
    }
}

/* Guidance across the axis and folding moment. */
static void guide_end(CzBlock *d, int end, const EndLine *restrict line,
                      EndForces *restrict forces) {
    const CzEndRows *restrict rows = &d->parameter.end[end];
    const double *restrict compliance = d->constant.fold_compliance[end];
    const double *restrict slip = d->published.end[end].slip_vertical;
    const double *restrict yielded = d->memory->end[end].fold_pitch;
    double *restrict next = d->next_memory->end[end].fold_pitch;
    double *restrict guide = d->power->guide[end], *restrict guide_lost =
                                                       d->power->guide_damping[end];
    double *restrict fold = d->power->fold[end], *restrict fold_lost = d->power->fold_damping[end];
    CZ_LANES (i) {
        const double spring = cz_link_spring(rows->guide_vertical.stiffness[i], slip[i]);
        const double damper = cz_link_damper(rows->guide_vertical.damping[i], line->slip_rate[i]);
        const CzSliderResponse hinge =
            cz_slider_of(rows->fold_pitch.stiffness[i], compliance[i], rows->fold_pitch.moment[i],
                         line->folded[i], yielded[i]);
        const double resisting = rows->fold_pitch.damping[i] * line->folding[i];
        next[i] = hinge.offset;
        forces->across[i] = spring + damper;
        forces->moment[i] = hinge.force + resisting;
        guide[i] += spring * line->slip_rate[i];
        guide_lost[i] += damper * line->slip_rate[i];
        fold[i] += hinge.force * line->folding[i];
        fold_lost[i] += resisting * line->folding[i];
    }
}

static void vehicle_end(CzBlock *d, int end, double step) {
    EndLine line;
    EndForces forces;
    line_up_end(d, end, &line);
    crush_end(d, end, &line);
    guide_end(d, end, &line, &forces);
    put_end(d, end, &line, &forces);
    if (d->budget != NULL)
        note_end(d, end, &line, &forces, step);
}

#endif
