/* Coupler: a buffer, then the plateaus of its tube, then the shear-off when the force drops.
 *
 * The elastic shortening F / k of the tube is subtracted first, which leaves the sum of the strokes
 * u = x_b + s.
 *
 *   0 .. u_b     the buffer's lines
 *   u_b .. u_t   the tube's plateaus
 *   u_t .. u_p   the rise along the tube's stop to the force F_s that shears off
 *   u_p .. u_d   its fall, of equal area: softening length = 2 area / F_s
 *
 * u_b is the stroke at which lines before and plateaus after it fit with the least squares.
 */
#include "base/error.h"
#include "base/number.h"
#include "fit/fit.h"
#include "fit/plateaus.h"

#define GONE 0.05   /* of the highest force: a smaller one counts as 0 (ours) */
#define HIGH_UP 0.5 /* of the highest force: above this the coupler has not sheared off (ours) */
#define LIKE_RESIDUAL 1.1     /* of the residual force: a drop ends at this force (ours) */
#define LARGEST_RESIDUAL 0.35 /* of the shear-off: more is a stage, not friction (ours) */
#define PEAK_BEFORE 0.05      /* of the stroke: largest distance of the peak before that (ours) */
#define LONGEST_DROP 0.25     /* of the stroke: a longer fall is not a shear-off (ours) */
#define RISES 1.05            /* smallest ratio of a shear-off to the tube before it (ours) */
#define RISE_FOOT 0.2         /* part of that rise at which it begins (ours) */
#define REVERSIBLE 0.1        /* largest permanent share of the stroke of a buffer alone (ours) */
#define SHORTEST 0.05         /* of a buffer's stage, as a share of its stroke (ours) */
#define STIFFER 2.0     /* factor over the steepest line from zero to a point of the curve (ours) */
#define MIN_STROKE 1e-3 /* of the largest: less is insufficient for a stiffness (ours) */
#define MIN_FORCE 0.1   /* of the highest: likewise (ours) */
#define WORTH_A_PRELOAD 0.05 /* of the buffer's force: a smaller preload is left out (ours) */

enum { CELLS = 60, BUFFER_STAGES = 3 };

/* Strokes of the parts [m], as above. */
typedef struct Parts {
    double tube, stop, peak, drop; /* where they begin: u_b, u_t, u_p, u_d */
    double stop_stiffness;         /* of the rise [N/m] */
    CzStop rise;                   /* at the end of a curve without shear-off */
    double force;                  /* F_s [N]; NaN without shear-off */
    double residual;               /* mean force after it [N] */
    double too_much; /* residual of a drop that is not a shear-off, as a share of its peak */
    int end;         /* last point of the drop, or of the curve */
} Parts;

/* ---- shear-off ---- */

static int highest_point(const CzBranch *branch, int from, int to) {
    int top = from;
    for (int i = from; i <= to; i++)
        top = branch->f[i] > branch->f[top] ? i : top;
    return top;
}

/* The last point with a high force; the force stays low after it. */
static int find_edge(const CzBranch *branch, double highest) {
    int edge = branch->n - 1;
    while (edge > 0 && branch->f[edge] < HIGH_UP * highest)
        edge--;
    return edge;
}

/* Residual force after the shear-off: the mean over the second half of the stroke after the edge; 0
 * where the last force is small. */
static double residual_behind(const CzBranch *branch, int edge, double highest) {
    const double last = cz_branch_last(branch);
    const double kept = cz_branch_mean(branch, 0.5 * (branch->x[edge] + last), last);
    return branch->f[branch->n - 1] < GONE * highest ? 0.0 : kept;
}

/* Finds the final drop of the force, to 0 or to a residual force; without one `parts` ends with the
 * curve. */
static void find_drop(const CzBranch *branch, Parts *parts) {
    const int last = branch->n - 1;
    const double length = cz_branch_last(branch);
    const double highest = branch->f[highest_point(branch, 0, last)];
    const int edge = find_edge(branch, highest);
    parts->stop = parts->peak = parts->drop = length;
    parts->force = NAN;
    parts->residual = parts->too_much = 0.0;
    parts->end = last;
    if (edge == last)
        return;
    const double residual = residual_behind(branch, edge, highest);
    const double low = residual > 0.0 ? LIKE_RESIDUAL * residual : GONE * highest;
    int end = edge;
    while (end < last && !(branch->f[end] < low))
        end++;
    int first = edge;
    while (first > 0 && branch->x[edge] - branch->x[first] <= PEAK_BEFORE * length)
        first--;
    const int top = highest_point(branch, first, edge);
    if (branch->x[end] - branch->x[top] > LONGEST_DROP * length || (residual > 0.0 && end == last))
        return; /* a curve that decreases gradually */
    if (residual > LARGEST_RESIDUAL * branch->f[top]) {
        parts->too_much = residual / branch->f[top];
        return; /* a lower stage */
    }
    while (residual == 0.0 && end < last && branch->f[end + 1] < branch->f[end])
        end++;
    parts->stop = parts->peak = branch->x[top];
    parts->drop = branch->x[end];
    parts->force = branch->f[top];
    parts->end = residual > 0.0 ? last : end;
    parts->residual = residual > 0.0 ? cz_branch_mean(branch, parts->drop, length) : 0.0;
}

/* Finds the foot of the rise to the shear-off, and the stiffness for the same area. */
static double find_stop(const CzBranch *branch, Parts *parts) {
    const CzKey *key = cz_fit_key(CZ_RECORD_CzTube, "bottom_stiffness");
    const double before = cz_branch_mean(branch, 0.8 * parts->peak, 0.95 * parts->peak);
    const double foot = before + RISE_FOOT * (parts->force - before);
    if (!(parts->force > RISES * before))
        return key->absent;
    int i = branch->n - 1;
    while (i > 0 && (branch->x[i] > parts->peak || branch->f[i] > foot))
        i--;
    const double area =
        cz_branch_sums(branch, parts->peak).area - cz_branch_sums(branch, branch->x[i]).area;
    const double length = 2.0 * area / (parts->force + before);
    const double stiffness = length > 0.0 ? (parts->force - before) / length : INFINITY;
    if (stiffness < key->lo)
        return key->absent; /* no stop: a tube that stiffens */
    parts->stop = branch->x[i];
    return cz_fit_round(fmin(stiffness, key->absent), 1e6);
}

static void fit_shear_off(CzFit *fit, const CzBranch *branch, const Parts *parts) {
    const CzKey *force = cz_fit_key(CZ_RECORD_CzShearOff, "force");
    const CzKey *length = cz_fit_key(CZ_RECORD_CzShearOff, "softening_length");
    const double area =
        cz_branch_sums(branch, parts->drop).area - cz_branch_sums(branch, parts->peak).area;
    const double softening = 2.0 * area / (parts->force + parts->residual);
    char kN[CZ_NUMBER_TEXT], kept[CZ_NUMBER_TEXT], at[CZ_NUMBER_TEXT];
    fit->shear_force = cz_fit_round(fmax(parts->force, force->lo), 1e3);
    fit->residual = cz_fit_round(parts->residual, 1e3);
    fit->softening = cz_fit_round(fmin(fmax(softening, length->lo), length->hi), 1e-3);
    fit->retraction = cz_fit_round(fmax(cz_branch_last(branch) - parts->drop, 0.0), 1e-3);
    if (!(parts->stop < parts->peak))
        cz_fit_doubt_that(fit,
                          "the force falls from %s to %s kN at %s mm without a stop before it: "
                          "this may be a ruptured tube instead of a shear-off",
                          cz_number_print_short(kN, 1e-3 * parts->force),
                          cz_number_print_short(kept, 1e-3 * parts->residual),
                          cz_number_print_short(at, 1e3 * parts->peak));
    cz_fit_add_note(fit, "retraction_space is the free travel of the curve; the coupler's own may "
                         "be longer");
}

/* ---- buffer ---- */

/* Fits the lines of the buffer over its part, with a preload when that is large enough and saves
 * stages or reduces the error. */
static CzStatus fit_buffer(CzFit *fit, const CzBranch *part, CzError *error) {
    CzStaged preloaded;
    const CzLines lines = {.n_stage = -1, .n_most = BUFFER_STAGES, .shortest = SHORTEST};
    CzLines with_preload = lines;
    with_preload.has_preload = true;
    if (!cz_fit_lines(&fit->arena, part, &lines, &fit->buffer) ||
        !cz_fit_lines(&fit->arena, part, &with_preload, &preloaded))
        return cz_no_memory(error, "a fit");
    const double energy = part->area[part->n - 1];
    const double worth = WORTH_A_PRELOAD * preloaded.stage[preloaded.n_stage - 1].force;
    if (cz_staged_solve(&preloaded, part, energy) < INFINITY && preloaded.preload > worth &&
        preloaded.n_stage <= fit->buffer.n_stage)
        fit->buffer = preloaded;
    fit->buffer.bottom_stiffness = cz_fit_key(CZ_RECORD_CzBuffer, "bottom_stiffness")->absent;
    cz_fit_make_rising(&fit->buffer);
    return CZ_OK;
}

/* Whether the unloading returns to the start of the loading: then there is no plastic stroke. */
static bool is_reversible(const CzTrace *trace) {
    return trace->unloads && trace->x[trace->n - 1] < REVERSIBLE * trace->x[trace->n_loading - 1];
}

/* ---- beginning of the tube ---- */

/* The tube's plateaus as they are, their first one lengthened or shortened to begin at a stroke. */
static bool begin_tube_at(CzStaged *tube, double stop, double from) {
    const double longer = stop - from - cz_staged_stroke(tube);
    tube->stage[0].stroke += longer;
    return tube->stage[0].stroke > 0.0;
}

/* Squared error of one line before a stroke and the tube's plateaus after it. */
static CzStatus left_by(CzFit *fit, const CzBranch *branch, const Parts *parts, double from,
                        double *left, CzError *error) {
    CzArena scratch = {0};
    CzBranch behind;
    CzStaged tube = fit->member;
    *left = INFINITY;
    if (!begin_tube_at(&tube, parts->stop, from) || !(from > 0.0))
        return CZ_OK;
    const bool has_memory = cz_branch_cut(&scratch, branch, from, parts->stop, &behind);
    if (has_memory)
        *left = cz_fit_left_by_line(branch, from) + cz_staged_solve(&tube, &behind, NAN);
    cz_arena_free(&scratch);
    return has_memory ? CZ_OK : cz_no_memory(error, "a fit");
}

/* Refines the beginning of the tube by scans with decreasing increments. */
static CzStatus sharpen_tube(CzFit *fit, const CzBranch *branch, Parts *parts, CzError *error) {
    double best = INFINITY, reach = parts->stop / CELLS;
    for (int pass = 0; pass < 5; pass++, reach /= 4.0) {
        const double middle = parts->tube;
        for (int i = -4; i <= 4; i++) {
            double left;
            CZ_TRY(left_by(fit, branch, parts, middle + i * reach / 4.0, &left, error));
            if (left < best) {
                best = left;
                parts->tube = middle + i * reach / 4.0;
            }
        }
    }
    return CZ_OK;
}

/* The buffer cannot exceed the force at which the tube crushes, so higher forces of the buffer are
 * cut. Their energy is added to both members, the trigger included, because it would raise a short
 * tube alone far above the curve. */
static void limit_buffer(CzFit *fit) {
    CzStaged *buffer = &fit->buffer, *tube = &fit->member;
    const double found = cz_staged_energy(buffer);
    const double crushes = isnan(tube->trigger) ? tube->stage[0].force : tube->trigger;
    buffer->preload = fmin(buffer->preload, crushes);
    for (int i = 0; i < buffer->n_stage; i++)
        buffer->stage[i].force = fmin(buffer->stage[i].force, crushes);
    const double kept = cz_staged_energy(buffer), all = kept + cz_staged_energy(tube);
    const double factor = (all + found - kept) / all;
    cz_fit_scale_forces(buffer, -1, factor);
    tube->trigger *= factor;
}

/* Fits the plateaus of the tube over its part of the curve. */
static bool fit_tube(CzFit *fit, const CzBranch *branch, int n_stage, const Parts *parts,
                     CzBranch *behind) {
    return cz_branch_cut(&fit->arena, branch, parts->tube, parts->stop, behind) &&
           cz_fit_plateaus(&fit->arena, behind, n_stage, fit->stiffness, &fit->member);
}

/* Splits buffer and tube, and fits both. */
static CzStatus fit_members(CzFit *fit, const CzBranch *branch, int n_stage, Parts *parts,
                            CzError *error) {
    CzBranch before, behind;
    if (!fit_tube(fit, branch, n_stage, parts, &behind))
        return cz_no_memory(error, "a fit");
    CZ_TRY(sharpen_tube(fit, branch, parts, error));
    if (!fit_tube(fit, branch, n_stage, parts, &behind) ||
        !cz_branch_cut(&fit->arena, branch, 0.0, parts->tube, &before))
        return cz_no_memory(error, "a fit");
    CZ_TRY(fit_buffer(fit, &before, error));

    limit_buffer(fit);
    cz_fit_round_staged(&fit->buffer);
    fit->member.bottom_stiffness = parts->stop_stiffness;
    CZ_TRY(cz_fit_place_stop(fit, &parts->rise, &fit->member, &behind, error));
    return cz_fit_match_energy(fit, &fit->member, &behind, error);
}

/* Fits a buffer without a tube: the whole curve up to its end or its drop. */
static CzStatus fit_buffer_alone(CzFit *fit, const CzBranch *branch, Parts *parts, CzError *error) {
    CzBranch part;
    if (!cz_branch_cut(&fit->arena, branch, 0.0, parts->stop, &part))
        return cz_no_memory(error, "a fit");
    CZ_TRY(fit_buffer(fit, &part, error));
    CZ_TRY(cz_fit_place_stop(fit, &parts->rise, &fit->buffer, &part, error));
    CZ_TRY(cz_fit_match_energy(fit, &fit->buffer, &part, error));
    if (is_reversible(&fit->trace))
        fit->share = cz_fit_round(fmin(fit->summary.returned / fit->summary.energy, 1.0), 1.0);
    return CZ_OK;
}

/* Elastic stiffness of the tube: the usual one, unless the curve rises more steeply than that. The
 * ratio of two numbers near zero is not used. */
static double find_stiffness(const CzFit *fit) {
    const CzKey *key = cz_fit_key(CZ_RECORD_CzTube, "stiffness");
    const double least_x = MIN_STROKE * cz_branch_last(&fit->curve);
    const double least_f = MIN_FORCE * fit->summary.peak_force;
    double steepest = 0.0;
    for (int i = 0; i < fit->curve.n; i++)
        if (fit->curve.x[i] > least_x && fit->curve.f[i] > least_f)
            steepest = fmax(steepest, fit->curve.f[i] / fit->curve.x[i]);
    return fmax(key->absent, cz_fit_round(fmin(STIFFER * steepest, key->hi), 1e6));
}

/* Subtracts the elasticity and finds the parts; without a tube its beginning is the end. */
static CzStatus find_parts(CzFit *fit, bool is_alone, int n_stage, CzBranch *branch, Parts *parts,
                           CzError *error) {
    CzBranch whole;
    const CzStop rise = cz_fit_find_stop(fit);
    fit->stiffness = is_alone ? INFINITY : cz_fit_stiffness_for(fit, &rise, find_stiffness(fit));
    CZ_TRY(cz_fit_branch(fit, fit->stiffness, branch, error));
    find_drop(branch, parts);
    parts->rise = rise;
    parts->rise.is_there = rise.is_there && isnan(parts->force);
    parts->stop_stiffness = find_stop(branch, parts);
    if (parts->rise.is_there)
        parts->stop = branch->x[rise.onset];
    parts->tube = parts->stop;
    if (is_alone)
        return CZ_OK;
    if (!cz_branch_cut(&fit->arena, branch, 0.0, parts->stop, &whole) ||
        !cz_fit_split(&fit->arena, &whole, n_stage, &parts->tube))
        return cz_no_memory(error, "a fit");
    return CZ_OK;
}

CzStatus cz_fit_coupler(CzFit *fit, int n_stage, CzError *error) {
    CzBranch branch;
    Parts parts;
    bool is_alone = n_stage == 0 || (n_stage < 0 && is_reversible(&fit->trace));
    CZ_TRY(find_parts(fit, is_alone, n_stage, &branch, &parts, error));
    if (!is_alone && n_stage < 0 && parts.stop - parts.tube < SHORTEST * parts.stop) {
        is_alone = true;
        CZ_TRY(find_parts(fit, is_alone, n_stage, &branch, &parts, error));
    }
    if (!isnan(parts.force))
        fit_shear_off(fit, &branch, &parts);
    if (parts.too_much > 0.0)
        cz_fit_add_note(
            fit,
            "the force drops to %.0f %% of its peak and stays there: more than the %.0f %% that "
            "friction after a shear-off can give, so both are stages of the tube",
            100.0 * parts.too_much, 100.0 * LARGEST_RESIDUAL);
    fit->summary.energy = cz_work(fit->path_x, fit->path_f, 0, parts.end);
    return is_alone ? fit_buffer_alone(fit, &branch, &parts, error)
                    : fit_members(fit, &branch, n_stage, &parts, error);
}
