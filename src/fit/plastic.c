/* Anti-climber or collapse tube: plateaus after an elastic shortening.
 *
 *   d = s + F / k
 *
 * A curve that begins without force shows the elastic rise: k is taken from its unloading, by the
 * energy that this returns, else from the rise; the plateaus are fitted over s = d - F / k. A curve
 * that begins with force has no rise, and its strokes are plastic.
 */
#include "base/error.h"
#include "fit/fit.h"
#include "fit/plateaus.h"

#define STEEPER 5.0     /* than the whole curve: a flatter rise is not elastic (ours) */
#define FIRST_FROM 0.03 /* part of the stroke whose mean is the first force (ours) */
#define FIRST_TO 0.13
#define WITHOUT_FORCE 0.2 /* of the mean force: a smaller force counts as zero (ours) */
#define RISE_LOW 0.2      /* lower end of the rise for the stiffness, of the mean force (ours) */
#define RISE_HIGH 0.8
#define NO_RISE 2e-4 /* of the stroke: a rise over less is a jump without a stiffness (ours) */

/* Stroke at which the loading first reaches a force. */
static double stroke_of(const CzBranch *curve, double force) {
    for (int i = 1; i < curve->n; i++)
        if (curve->f[i] >= force) {
            const double rise = curve->f[i] - curve->f[i - 1];
            const double share = rise > 0.0 ? (force - curve->f[i - 1]) / rise : 0.0;
            return curve->x[i - 1] + share * (curve->x[i] - curve->x[i - 1]);
        }
    return cz_branch_last(curve);
}

static double stiffness_of_unloading(const CzTrace *trace) {
    const int top = trace->n_loading - 1, last = trace->n - 1;
    const double high = trace->f[top], low = trace->f[last];
    const double returned = -cz_work(trace->x, trace->f, top, last);
    return returned > 0.0 ? (high * high - low * low) / (2.0 * returned) : INFINITY;
}

/* Stiffness from the rise to the first force; INFINITY when the rise is too short to differ from a
 * jump. */
static double stiffness_of_rise(const CzBranch *curve, double first, double last) {
    const double low = stroke_of(curve, RISE_LOW * first);
    const double high = stroke_of(curve, RISE_HIGH * first);
    return high - low > NO_RISE * last ? (RISE_HIGH - RISE_LOW) * first / (high - low) : INFINITY;
}

static double find_stiffness(CzFit *fit, const CzStop *stop) {
    const CzKey *key = cz_fit_key(CZ_RECORD_CzAntiClimber, "stiffness");
    const double last = fit->curve.x[stop->onset];
    const double mean = cz_branch_mean(&fit->curve, 0.0, last);
    if (fit->curve.f[0] > WITHOUT_FORCE * mean)
        return INFINITY;
    const double first =
        fmin(mean, cz_branch_mean(&fit->curve, FIRST_FROM * last, FIRST_TO * last));
    double peak = 0.0;
    for (int i = 0; i <= stop->onset; i++)
        peak = fmax(peak, fit->curve.f[i]);
    double stiffness = stiffness_of_rise(&fit->curve, first, last);
    if (fit->trace.unloads)
        stiffness = stiffness_of_unloading(&fit->trace);
    else if (!(stiffness >= STEEPER * peak / last && isfinite(stiffness))) {
        stiffness = key->absent;
        cz_fit_add_note(fit, "the curve shows no elastic rise; stiffness is the usual one (ours)");
    }
    return cz_fit_round(fmin(fmax(stiffness, key->lo), key->hi), 1e6);
}

CzStatus cz_fit_plastic(CzFit *fit, int n_stage, CzError *error) {
    CzBranch branch, part;
    const CzStop stop = cz_fit_find_stop(fit);
    fit->stiffness = cz_fit_stiffness_for(fit, &stop, find_stiffness(fit, &stop));
    if (!isfinite(fit->stiffness))
        cz_fit_add_note(fit, "the curve begins with force: its strokes are taken as plastic");
    CZ_TRY(cz_fit_branch(fit, fit->stiffness, &branch, error));
    if (!cz_branch_cut(&fit->arena, &branch, 0.0, branch.x[stop.onset], &part) ||
        !cz_fit_plateaus(&fit->arena, &part, n_stage, fit->stiffness, &fit->member))
        return cz_no_memory(error, "a fit");
    fit->member.bottom_stiffness = cz_fit_key(CZ_RECORD_CzAntiClimber, "bottom_stiffness")->absent;
    CZ_TRY(cz_fit_place_stop(fit, &stop, &fit->member, &part, error));
    CZ_TRY(cz_fit_match_energy(fit, &fit->member, &part, error));
    if (fit->trace.unloads && isfinite(fit->stiffness)) {
        CzLoading loading;
        cz_fit_load(fit, &loading);
        const double force = loading.f[loading.n - 1];
        fit->summary.law_returned = force * force / (2.0 * fit->stiffness);
    }
    return CZ_OK;
}
