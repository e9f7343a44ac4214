/* The law under a slowly growing shortening, and its difference from the curve.
 *
 *   d = x_b(F) + s + F / k
 *
 * The members of a coupler are in series: the buffer x_b deflects until it is on its stop or the
 * tube begins to crush, then the tube crushes by s until its stroke is exhausted, then the force
 * rises along the tube's stop until the shear-off releases. The unloading of the buffer while the
 * force of the tube falls is neglected.
 */
#include "fit/fit.h"

/* A law that ends earlier than the curve by at most this share of the stroke counts as ending with
 * it (ours). */
static const double rounded = 1e-3;

enum { SAMPLES = 4000, STRETCH = SAMPLES / 10 }; /* for the mean square, and for a stretch of it */

static void add(CzLoading *loading, double x, double f) {
    const double before = loading->n > 0 ? loading->x[loading->n - 1] : 0.0;
    if (loading->n > 0 && x == before && f == loading->f[loading->n - 1])
        return;
    loading->x[loading->n] = fmax(x, before);
    loading->f[loading->n++] = f;
}

/* Appends a staged curve whose stroke begins at `from`; returns its end. */
static double add_staged(CzLoading *loading, const CzStaged *staged, double from,
                         double compliance) {
    double at[CZ_MAX_STAGED_BREAKPOINTS];
    CzBreakpoints breakpoints;
    if (staged->n_stage == 0)
        return from;
    cz_staged_breakpoints(staged, &breakpoints);
    const int n = cz_staged_breakpoint_strokes(staged, at);
    for (int i = 0; i < n; i++) {
        const double force = cz_breakpoints_value(&breakpoints, at[i]);
        add(loading, from + at[i] + force * compliance, force);
    }
    return from + at[n - 1];
}

static double last_force(const CzLoading *loading) {
    return loading->n > 0 ? loading->f[loading->n - 1] : 0.0;
}

/* Appends a stop up to a force; returns the members' stroke there. */
static double add_stop(CzLoading *loading, double at, double force, double stiffness,
                       double compliance) {
    if (force > last_force(loading)) {
        at += (force - last_force(loading)) / stiffness;
        add(loading, at + force * compliance, force);
    }
    return at;
}

/* Stiffness of the stop at the end of the stroke. */
static double last_stop(const CzFit *fit) {
    return fit->member.n_stage > 0 ? fit->member.bottom_stiffness : fit->buffer.bottom_stiffness;
}

void cz_fit_load(const CzFit *fit, CzLoading *loading) {
    const double compliance = cz_fit_compliance(fit), stop = last_stop(fit);
    double at = 0.0;
    loading->n = 0;
    if (compliance > 0.0 || fit->buffer.n_stage > 0)
        add(loading, 0.0, 0.0);
    at = add_staged(loading, &fit->buffer, at, compliance);
    if (fit->buffer.n_stage > 0 && fit->member.n_stage > 0) {
        CzBreakpoints breakpoints;
        cz_staged_breakpoints(&fit->member, &breakpoints);
        at = add_stop(loading, at, breakpoints.start, fit->buffer.bottom_stiffness, compliance);
    }
    at = add_staged(loading, &fit->member, at, compliance);
    if (!isnan(fit->stop_force))
        add_stop(loading, at, fit->stop_force, stop, compliance);
    if (isnan(fit->shear_force))
        return;
    at = add_stop(loading, at, fit->shear_force, stop, compliance);
    at += fit->softening;
    add(loading, at + fit->residual * compliance, fit->residual);
    if (fit->residual > 0.0)
        add(loading, at + fit->retraction + fit->residual * compliance, fit->residual);
}

void cz_fit_load_full_stroke(const CzFit *fit, CzLoading *loading) {
    cz_fit_load(fit, loading);
    const double last = loading->x[loading->n - 1], end = cz_branch_last(&fit->curve);
    if (end - last <= rounded * end)
        return;
    const double soft = cz_fit_compliance(fit) + 1.0 / last_stop(fit);
    const double slope = isnan(fit->shear_force) ? 1.0 / soft : 0.0;
    add(loading, end, last_force(loading) + slope * (end - last));
}

static double energy_under(const CzLoading *loading, double end) {
    double energy = 0.0;
    for (int i = 1; i < loading->n && loading->x[i - 1] < end; i++) {
        const double x = fmin(loading->x[i], end), length = loading->x[i] - loading->x[i - 1];
        const double share = length > 0.0 ? (x - loading->x[i - 1]) / length : 0.0;
        const double force = loading->f[i - 1] + share * (loading->f[i] - loading->f[i - 1]);
        energy += 0.5 * (force + loading->f[i - 1]) * (x - loading->x[i - 1]);
    }
    return energy;
}

double cz_fit_law_energy(const CzFit *fit) {
    CzLoading loading;
    cz_fit_load(fit, &loading);
    return cz_work(loading.x, loading.f, 0, loading.n - 1);
}

/* Smallest and largest force of the law at a shortening, which differ at a jump. */
static void force_at(const CzLoading *loading, double x, double *low, double *high) {
    int i = 0;
    while (i + 1 < loading->n && loading->x[i + 1] < x)
        i++;
    const int next = i + 1 < loading->n ? i + 1 : i;
    const double length = loading->x[next] - loading->x[i];
    const double share = length > 0.0 ? fmin((x - loading->x[i]) / length, 1.0) : 0.0;
    *low = *high = loading->f[i] + share * (loading->f[next] - loading->f[i]);
    for (int k = 0; k < loading->n; k++)
        if (loading->x[k] == x) {
            *low = fmin(*low, loading->f[k]);
            *high = fmax(*high, loading->f[k]);
        }
}

/* Force of the law less that of the curve. */
static double difference_at(const CzLoading *loading, double x, double force) {
    double low, high;
    force_at(loading, x, &low, &high);
    return force < low ? low - force : force > high ? high - force : 0.0;
}

static void keep_larger(CzFit *fit, const CzLoading *loading, double x, double force) {
    const double difference = fabs(difference_at(loading, x, force));
    const double none = 1e-9 * fit->summary.peak_force; /* rounding */
    if (difference > fmax(fit->summary.largest_difference, none)) {
        fit->summary.largest_difference = difference;
        fit->summary.at_stroke = x;
    }
}

/* Differences at evenly spread strokes: their mean square, and the largest mean over a stretch. */
static void compare_samples(CzFit *fit, const CzLoading *loading, double end) {
    double squares = 0.0, stretch = 0.0, last[STRETCH] = {0.0};
    fit->summary.stretch_difference = 0.0;
    for (int i = 0; i < SAMPLES; i++) {
        const double x = end * (i + 0.5) / SAMPLES;
        const double difference = difference_at(loading, x, cz_branch_force(&fit->curve, x));
        squares += difference * difference;
        stretch += difference - last[i % STRETCH];
        last[i % STRETCH] = difference;
        if (i + 1 >= STRETCH)
            fit->summary.stretch_difference =
                fmax(fit->summary.stretch_difference, fabs(stretch) / STRETCH);
    }
    fit->summary.mean_square = sqrt(squares / SAMPLES);
}

void cz_fit_compare(CzFit *fit) {
    CzFitSummary *summary = &fit->summary;
    CzLoading loading;
    cz_fit_load_full_stroke(fit, &loading);
    const double end = fmin(loading.x[loading.n - 1], cz_branch_last(&fit->curve));
    summary->largest_difference = summary->at_stroke = summary->law_peak = 0.0;
    for (int i = 0; i < fit->curve.n && fit->curve.x[i] <= end; i++)
        keep_larger(fit, &loading, fit->curve.x[i], fit->curve.f[i]);
    for (int i = 0; i < loading.n && loading.x[i] <= end; i++) {
        const bool is_jump = (i > 0 && loading.x[i] == loading.x[i - 1]) ||
                             (i + 1 < loading.n && loading.x[i] == loading.x[i + 1]);
        if (!is_jump)
            keep_larger(fit, &loading, loading.x[i], cz_branch_force(&fit->curve, loading.x[i]));
    }
    for (int i = 0; i < loading.n && loading.x[i] <= end * (1.0 + rounded); i++)
        summary->law_peak = fmax(summary->law_peak, loading.f[i]);
    compare_samples(fit, &loading, end);
    summary->law_whole_energy = energy_under(&loading, cz_branch_last(&fit->curve));
}
