/* Crush zone of a vehicle end: lines from zero, and two stages of unloading (laws/vehicle_end.h).
 *
 * From the force F_m at the largest shortening x_m the law unloads along
 *
 *   x_m - x = c_1 min(F_m - F, (1 - r) F_m) + c_2 max(r F_m - F, 0),   c_i = 1 / Ku_i
 *
 * which is linear in c_1 and c_2. For each share r both follow from the least squares of the
 * shortening over the force, under the condition that the measured part returns its energy.
 */
#include "base/error.h"
#include "fit/fit.h"
#include "fit/plateaus.h"
#include "laws/vehicle_end.h"

#define ASSUMED_UNLOADING 1e8 /* of a curve that does not unload [N/m] (ours) */
#define SHARE_STEP 0.01
#define ONE_LINE 0.02  /* of the unloading's length: root mean square error of one line (ours) */
#define SHORTEST 0.005 /* of a stage, as a share of the stroke (ours) */

enum { STAGES = 4, SHARES = 99 };

typedef struct Unloading {
    double c_1, c_2, left; /* left: weighted sum of squares */
} Unloading;

/* The best compliances for one share; `left` is INFINITY when one of them is not positive. */
static Unloading unload_with(const CzTrace *trace, double peak, double share) {
    const int top = trace->n_loading - 1;
    const double turn = share * peak, low = trace->f[trace->n - 1];
    const double energy = -cz_work(trace->x, trace->f, top, trace->n - 1);
    const double upper = fmax(low, turn);
    const double a_1 = 0.5 * (peak * peak - upper * upper);
    const double a_2 = low < turn ? 0.5 * (turn * turn - low * low) : 0.0;
    Unloading found = {.left = INFINITY};
    if (!(a_2 > 0.0))
        return found;

    /* with c_2 = (energy - c_1 a_1) / a_2 one unknown remains */
    double pp = 0.0, pd = 0.0, dd = 0.0;
    for (int i = top + 1; i < trace->n; i++) {
        const double weight = fmax(trace->f[i - 1] - trace->f[i], 0.0);
        const double first = fmin(fmax(peak - trace->f[i], 0.0), peak - turn);
        const double second = fmax(turn - trace->f[i], 0.0);
        const double p = first - second * a_1 / a_2;
        const double d = trace->x[top] - trace->x[i] - second * energy / a_2;
        pp += weight * p * p;
        pd += weight * p * d;
        dd += weight * d * d;
    }
    if (!(pp > 0.0))
        return found;
    found.c_1 = pd / pp;
    found.c_2 = (energy - found.c_1 * a_1) / a_2;
    if (found.c_1 > 0.0 && found.c_2 > 0.0)
        found.left = fmax(dd - pd * pd / pp, 0.0);
    return found;
}

/* Golden section around the best share of a scan. */
static double find_share(const CzTrace *trace, double peak) {
    double best = 0.5, left = INFINITY;
    for (int i = 1; i <= SHARES; i++) {
        const Unloading unloading = unload_with(trace, peak, i * SHARE_STEP);
        if (unloading.left < left) {
            left = unloading.left;
            best = i * SHARE_STEP;
        }
    }
    double low = fmax(best - SHARE_STEP, 1e-3), high = fmin(best + SHARE_STEP, 1.0 - 1e-3);
    for (int i = 0; i < 40; i++) {
        const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
        if (unload_with(trace, peak, a).left < unload_with(trace, peak, b).left)
            high = b;
        else
            low = a;
    }
    return 0.5 * (low + high);
}

static double within(const CzKey *key, double stiffness) {
    return cz_fit_round(fmin(fmax(stiffness, key->lo), key->hi), 1e6);
}

/* Steepest rise of the first line, or of all others. */
static double steepest(const CzStaged *staged, bool of_first) {
    double rise = 0.0, force = 0.0;
    for (int i = 0; i < staged->n_stage; i++) {
        if ((i == 0) == of_first)
            rise = fmax(rise, (staged->stage[i].force - force) / staged->stage[i].stroke);
        force = staged->stage[i].force;
    }
    return rise;
}

/* Factor on the unloading stiffness that is required so that a stage does not return more energy
 * than it absorbed. */
static double missing_stiffness(const CzFit *fit) {
    const CzVehicleEndLaw law = {.unloading = fit->unloading,
                                 .share = fit->share,
                                 .second_unloading = fit->second_unloading};
    const double later = steepest(&fit->member, false);
    const double all = fmax(later, steepest(&fit->member, true));
    return fmax(later / cz_vehicle_end_steepest(&law), all / fit->unloading);
}

/* Raises the unloading stiffness as required: both stages by the same factor, or to one stage where
 * a range ends. */
static void stiffen(CzFit *fit, const CzKey *key) {
    const double more = 1.0 + 1e-4; /* margin for rounding */
    const double factor = missing_stiffness(fit);
    if (factor <= 1.0)
        return;
    cz_fit_add_note(fit,
                    "unloading is %.3g times as stiff as measured: a softer one would return more "
                    "energy than the steepest stage received",
                    factor);
    fit->unloading = within(key, fit->unloading * factor * more);
    fit->second_unloading = within(key, fit->second_unloading * factor * more);
    if (missing_stiffness(fit) <= 1.0)
        return;
    const double all = fmax(steepest(&fit->member, false), steepest(&fit->member, true));
    fit->unloading = fit->second_unloading = cz_fit_round(all * more, 1e6);
}

/* One stiffness for the whole unloading. */
static double mean_unloading(const CzTrace *trace, double peak) {
    const int top = trace->n_loading - 1, last = trace->n - 1;
    const double low = trace->f[last];
    return (peak * peak - low * low) / (-2.0 * cz_work(trace->x, trace->f, top, last));
}

/* Whether one line of that stiffness describes the measured unloading. A second stage would then
 * fit the noise of the peak, with a stiffness that requires very small time steps. */
static bool one_line_will_do(const CzTrace *trace, double peak, double stiffness) {
    const int top = trace->n_loading - 1;
    double squares = 0.0, weights = 0.0;
    for (int i = top + 1; i < trace->n; i++) {
        const double weight = fmax(trace->f[i - 1] - trace->f[i], 0.0);
        const double missed = trace->x[top] - trace->x[i] - (peak - trace->f[i]) / stiffness;
        squares += weight * missed * missed;
        weights += weight;
    }
    const double length = trace->x[top] - trace->x[trace->n - 1];
    return sqrt(squares / weights) <= ONE_LINE * length;
}

static void fit_unloading(CzFit *fit, double peak) {
    const CzKey *key = cz_fit_key(CZ_RECORD_CzEnd, "unloading_stiffness");
    double first = ASSUMED_UNLOADING, second = ASSUMED_UNLOADING;
    fit->share = cz_fit_key(CZ_RECORD_CzEnd, "unloading_share")->absent;
    if (fit->trace.unloads) {
        const double share = cz_fit_round(find_share(&fit->trace, peak), 1.0);
        const Unloading found = unload_with(&fit->trace, peak, share);
        first = second = mean_unloading(&fit->trace, peak);
        if (one_line_will_do(&fit->trace, peak, first))
            cz_fit_add_note(fit,
                            "one stiffness describes the unloading; a second stage is not needed");
        else if (found.left < INFINITY) {
            fit->share = share;
            first = 1.0 / found.c_1;
            second = 1.0 / found.c_2;
        } else
            cz_fit_add_note(fit, "the unloading does not have two stages; one stiffness is taken");
    } else
        cz_fit_add_note(fit, "the curve does not unload; unloading_stiffness is a guess (ours)");
    fit->unloading = within(key, first);
    fit->second_unloading = within(key, second);
    stiffen(fit, key);
}

CzStatus cz_fit_end(CzFit *fit, int n_stage, CzError *error) {
    CzBranch branch, part;
    const CzStop stop = cz_fit_find_stop(fit);
    fit->stiffness = INFINITY;
    CZ_TRY(cz_fit_branch(fit, INFINITY, &branch, error));
    const CzLines lines = {
        .n_stage = n_stage < 0 ? (int)STAGES : n_stage, .n_most = STAGES, .shortest = SHORTEST};
    if (!cz_branch_cut(&fit->arena, &branch, 0.0, branch.x[stop.onset], &part) ||
        !cz_fit_lines(&fit->arena, &part, &lines, &fit->member))
        return cz_no_memory(error, "a fit");
    fit->member.bottom_stiffness = cz_fit_key(CZ_RECORD_CzEnd, "bottom_stiffness")->absent;
    CZ_TRY(cz_fit_place_stop(fit, &stop, &fit->member, &part, error));
    CZ_TRY(cz_fit_match_energy(fit, &fit->member, &part, error));
    const double peak = fit->member.stage[fit->member.n_stage - 1].force;
    fit_unloading(fit, peak);
    const CzVehicleEndLaw law = {.unloading = fit->unloading,
                                 .share = fit->share,
                                 .second_unloading = fit->second_unloading};
    const double low = fit->trace.unloads ? fit->trace.f[fit->trace.n - 1] : 0.0;
    fit->summary.law_returned =
        cz_vehicle_end_stored(&law, peak, peak) - cz_vehicle_end_stored(&law, peak, low);
    return CZ_OK;
}
