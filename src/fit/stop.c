/* The stop at the end of a curve, and that of the law.
 *
 * The rise from the onset d_o to the last point (d_e, F_e) has the area A. A member whose last
 * force is F_p ends at d_s and rises with the stiffness k_t along a line of the same area and last
 * force:
 *
 *   d_s = d_e - 2 (A - F_p (d_e - d_o)) / (F_e - F_p),   k_t = (F_e - F_p) / (d_e - d_s)
 *
 * k_t contains the elasticity k in series with the member: 1 / k_bottom = 1 / k_t - 1 / k.
 */
#include "fit/fit.h"

#include "base/error.h"
#include "base/number.h"

#define RECENT 0.75 /* of the stroke so far: the level is the mean from this stroke on (ours) */
#define LEVEL 1.1   /* of the mean force of the stroke so far: a rise begins above it (ours) */
#define HEIGHT 1.5  /* of the highest force before: a lower rise is a stage (ours) */
#define STEEP 20.0  /* times the ratio of force to stroke: a flatter rise is a stage (ours) */
#define STIFFER 1.1 /* smallest ratio of the series elasticity to the stop (ours) */
#define RAISED 2.0  /* likewise where the elasticity must be raised (ours) */

/* The last point whose force is not above the level of the last quarter of the stroke so far, so
 * that the end of a rising plateau does not count as a part of the stop. */
static int find_onset(const CzBranch *curve) {
    int i = curve->n - 1;
    while (i > 0 && curve->f[i] > LEVEL * cz_branch_mean(curve, RECENT * curve->x[i], curve->x[i]))
        i--;
    return i;
}

CzStop cz_fit_find_stop(const CzFit *fit) {
    const CzBranch *curve = &fit->curve;
    const int last = curve->n - 1, onset = find_onset(curve);
    const double length = curve->x[last] - curve->x[onset];
    CzStop stop = {.onset = last};
    if (onset == 0 || !(curve->x[onset] > 0.0) || !(length > 0.0))
        return stop;
    double highest = 0.0;
    for (int i = 0; i <= onset; i++)
        if (curve->x[i] >= 0.25 * curve->x[onset])
            highest = fmax(highest, curve->f[i]);
    const double level = cz_branch_mean(curve, 0.5 * curve->x[onset], curve->x[onset]);
    const double area =
        cz_branch_sums(curve, curve->x[last]).area - cz_branch_sums(curve, curve->x[onset]).area;
    const double above = area - level * length;
    const double rise = curve->f[last] - level;
    if (!(above > 0.0) || !(curve->f[last] > HEIGHT * highest))
        return stop;
    stop.stiffness = rise * rise / (2.0 * above);
    const CzKey *key = cz_fit_key(CZ_RECORD_CzTube, "bottom_stiffness");
    stop.is_there = stop.stiffness >= key->lo && stop.stiffness >= STEEP * level / curve->x[onset];
    if (stop.is_there)
        stop.onset = onset;
    return stop;
}

double cz_fit_stiffness_for(CzFit *fit, const CzStop *stop, double stiffness) {
    if (!stop->is_there || stiffness >= STIFFER * stop->stiffness)
        return stiffness;
    cz_fit_add_note(
        fit,
        "the elastic rise is too soft for the stop: `stiffness` is set to twice that of the stop");
    return cz_fit_round(RAISED * stop->stiffness, 1e6);
}

/* Extends a part to the end of a longer member with the force of its last stage. */
static bool extend(CzArena *arena, double stroke, double force, CzBranch *part) {
    const CzBranch shorter = *part;
    if (!cz_branch_begin(arena, shorter.n + 1, part))
        return false;
    for (int i = 0; i < shorter.n; i++)
        cz_branch_add(part, shorter.x[i], shorter.f[i]);
    cz_branch_add(part, fmax(stroke, cz_branch_last(&shorter)), force);
    return cz_branch_end(arena, part);
}

CzStatus cz_fit_place_stop(CzFit *fit, const CzStop *stop, CzStaged *staged, CzBranch *part,
                           CzError *error) {
    if (!stop->is_there)
        return CZ_OK;
    const CzKey *key = cz_fit_key(CZ_RECORD_CzTube, "bottom_stiffness");
    const CzBranch *curve = &fit->curve;
    CzStage *stage = &staged->stage[staged->n_stage - 1];
    CzLoading loading;
    const double end = cz_branch_last(curve), onset = curve->x[stop->onset];
    const double force = curve->f[curve->n - 1], plateau = stage->force;
    const double area = cz_branch_sums(curve, end).area - cz_branch_sums(curve, onset).area;
    const double above = area - plateau * (end - onset);
    const double length = fmin(2.0 * above / (force - plateau), 2.0 * (end - onset));
    cz_fit_load(fit, &loading);
    if (!(force > plateau) || !(length > 0.0))
        return CZ_OK;
    const double moves = end - length - loading.x[loading.n - 1];
    const double soft = length / (force - plateau) - cz_fit_compliance(fit);
    stage->stroke = cz_fit_round(fmax(stage->stroke + moves, 0.5 * stage->stroke), 1e-3);
    staged->bottom_stiffness = cz_fit_round(fmin(fmax(1.0 / soft, key->lo), key->hi), 1e6);
    fit->stop_force = force;
    char at[CZ_NUMBER_TEXT];
    cz_fit_add_note(fit, "the stop begins at %s mm; its stiffness is that of the curve",
                    cz_number_print_short(at, 1e3 * (end - length)));
    return extend(&fit->arena, cz_staged_stroke(staged), plateau, part)
               ? CZ_OK
               : cz_no_memory(error, "a fit");
}
