/* The edges of a corridor, by bisection in steps of the resolution: both together, then the lower
 * one, then the upper one.
 *
 * A corridor passes when no curve that failed so far lies in it, and all curves that are tried in
 * it pass. Quasi-random curves, samples and the adversary try the widest one alone; what fails
 * there is tried at every width from then on, because it would fail at many. A failing curve that
 * they find, or one found at a larger width, can lie in a corridor that passed before: that one is
 * then refused, and the search begins again with what is known.
 *
 * The runs are brief. What decides is run in full at the end; a curve that then has another verdict
 * keeps it, and the search begins again.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "optimise/corridor.h"

enum {
    N_SHAPES = 8,
    MAX_CRITICAL = 8, /* curves that failed in a widest corridor and are tried at every width */
    N_CHALLENGED = 2, /* curves from which the adversary begins */
    N_CONFIRMED = 6,  /* of the smallest margins in the corridor, in full (ours) */
    N_SEARCHED = 3    /* lower and upper edge together, then each */
};

typedef struct Search {
    CzCorridor *corridor;
    int most_steps;
    int n_critical;
    CzTriedCurve critical[MAX_CRITICAL]; /* by shape, number and sample, at any width */
    int n_done;                          /* corridors that were tried, for the progress */
} Search;

/* ---- curves that were tried ------------------------------------------------------------------ */

CzStatus cz_corridor_keep(CzCorridor *corridor, int n, const CzTriedCurve *curve, CzError *error) {
    const size_t n_all = (size_t)(corridor->n_curve + n);
    CzTriedCurve *all = realloc(corridor->curve, (n_all + 1) * sizeof *all);
    if (all == NULL)
        return cz_no_memory(error, "the curves of a corridor");
    corridor->curve = all;
    for (int i = 0; i < n; i++)
        if (curve[i].state != CZ_SAMPLE_NOT_RUN)
            all[corridor->n_curve++] = curve[i];
    return CZ_OK;
}

static bool is_inside(const CzCorridor *corridor, const CzCorridorBox *box,
                      const CzTriedCurve *curve) {
    for (int i = 0; i < cz_corridor_n_factor(corridor); i++)
        if (curve->factor[i] < cz_box_factor(corridor, box, 0) - 1e-9 ||
            curve->factor[i] > cz_box_factor(corridor, box, 1) + 1e-9)
            return false;
    return true;
}

/* The first curve in a corridor that failed; -1 when there is none. */
static int find_failing(const CzCorridor *corridor, const CzCorridorBox *box) {
    for (int i = 0; i < corridor->n_curve; i++)
        if (!cz_curve_passes(&corridor->curve[i]) && is_inside(corridor, box, &corridor->curve[i]))
            return i;
    return -1;
}

/* ---- one corridor ---------------------------------------------------------------------------- */

/* Share of the way from the lower to the upper edge at piece i of n. */
static double share_of(CzCurveShape shape, int i, int n) {
    const double along = n > 1 ? (double)i / (n - 1) : 0.5;
    switch (shape) {
    case CZ_CURVE_UPPER:
    case CZ_CURVE_UPPER_FLAT:
        return 1;
    case CZ_CURVE_RISING:
        return along;
    case CZ_CURVE_FALLING:
        return 1 - along;
    case CZ_CURVE_ALTERNATING:
        return i % 2;
    case CZ_CURVE_ALTERNATING_HIGH:
        return 1 - i % 2;
    default:
        return 0;
    }
}

/* The peak is high on its own, or unlike the first piece where shapes rise, fall or alternate. */
static double share_of_peak(CzCurveShape shape) {
    return shape == CZ_CURVE_UPPER || shape == CZ_CURVE_LOWER_PEAKED || shape == CZ_CURVE_RISING ||
           shape == CZ_CURVE_ALTERNATING;
}

static CzTriedCurve make_shape(const CzCorridor *corridor, const CzCorridorBox *box,
                               CzCurveShape shape, int sample) {
    CzTriedCurve curve = {.shape = shape, .sample = sample};
    const double low = cz_box_factor(corridor, box, 0), high = cz_box_factor(corridor, box, 1);
    for (int i = 0; i < cz_corridor_n_factor(corridor); i++) {
        const double share =
            i < corridor->n_piece ? share_of(shape, i, corridor->n_piece) : share_of_peak(shape);
        curve.factor[i] = shape == CZ_CURVE_NOMINAL ? 1 : low + share * (high - low);
    }
    return curve;
}

static CzTriedCurve make_random(const CzCorridor *corridor, const CzCorridorBox *box, int k) {
    CzTriedCurve curve = {
        .shape = CZ_CURVE_RANDOM, .number = k + 1, .sample = corridor->n_draw > 0 ? k : -1};
    const double low = cz_box_factor(corridor, box, 0), high = cz_box_factor(corridor, box, 1);
    const int n = cz_corridor_n_factor(corridor);
    for (int i = 0; i < n; i++)
        curve.factor[i] = low + corridor->parts->u[k * n + i] * (high - low);
    return curve;
}

/* The same curve among those that were tried; -1 when there is none. */
static int find_known(const CzCorridor *corridor, const CzTriedCurve *curve) {
    for (int i = 0; i < corridor->n_curve; i++)
        if (corridor->curve[i].sample == curve->sample &&
            memcmp(corridor->curve[i].factor, curve->factor, sizeof curve->factor) == 0)
            return i;
    return -1;
}

/* Runs those curves that are new, and keeps them; *passes becomes false when one fails. */
static CzStatus run_and_keep(CzCorridor *corridor, int n, CzTriedCurve *curve, bool *passes,
                             CzError *error) {
    int n_new = 0;
    for (int i = 0; i < n; i++) {
        const int known = find_known(corridor, &curve[i]);
        if (known >= 0)
            *passes &= cz_curve_passes(&corridor->curve[known]);
        else
            curve[n_new++] = curve[i];
    }
    CzStatus status = cz_corridor_run(corridor, n_new, curve, error);
    CZ_TRY(status == CZ_STATUS_INTERRUPTED ? CZ_OK : status);
    for (int i = 0; i < n_new; i++)
        *passes &= cz_curve_passes(&curve[i]);
    CZ_TRY(cz_corridor_keep(corridor, n_new, curve, error));
    return status;
}

/* Shapes with the values of the file; those that equal an earlier one are left out. */
static CzStatus try_shapes(CzCorridor *corridor, const CzCorridorBox *box, bool *passes,
                           CzError *error) {
    CzTriedCurve curve[N_SHAPES];
    int n = 0;
    for (CzCurveShape shape = CZ_CURVE_LOWER; shape <= CZ_CURVE_ALTERNATING_HIGH; shape++) {
        curve[n] = make_shape(corridor, box, shape, -1);
        bool is_new = true;
        for (int i = 0; i < n; i++)
            is_new &= memcmp(curve[i].factor, curve[n].factor, sizeof curve[n].factor) != 0;
        n += is_new;
    }
    return run_and_keep(corridor, n, curve, passes, error);
}

/* ---- curves that are tried at every width once they failed ----------------------------------- */

static bool is_critical(const Search *search, const CzTriedCurve *curve) {
    for (int i = 0; i < search->n_critical; i++)
        if (search->critical[i].shape == curve->shape &&
            search->critical[i].number == curve->number &&
            search->critical[i].sample == curve->sample)
            return true;
    return false;
}

/* Whether one failing curve is worse than another: a failed run is worse than any margin. */
static bool is_worse(const CzTriedCurve *one, const CzTriedCurve *other) {
    return isnan(one->margin) ? !isnan(other->margin) : one->margin < other->margin;
}

/* Notes the curves from the first one on that failed, the worst ones. */
static void note_critical(Search *search, int first) {
    const CzCorridor *corridor = search->corridor;
    while (search->n_critical < MAX_CRITICAL) {
        const CzTriedCurve *worst = NULL;
        for (int i = first; i < corridor->n_curve; i++) {
            const CzTriedCurve *curve = &corridor->curve[i];
            if (!cz_curve_passes(curve) && !is_critical(search, curve) &&
                (worst == NULL || is_worse(curve, worst)))
                worst = curve;
        }
        if (worst == NULL)
            return;
        search->critical[search->n_critical++] = *worst;
    }
}

/* Critical curves between the edges of a corridor. */
static CzStatus try_critical(Search *search, const CzCorridorBox *box, bool *passes,
                             CzError *error) {
    CzTriedCurve curve[MAX_CRITICAL];
    for (int i = 0; i < search->n_critical; i++) {
        const CzTriedCurve *critical = &search->critical[i];
        curve[i] = critical->shape == CZ_CURVE_RANDOM
                       ? make_random(search->corridor, box, critical->number - 1)
                       : make_shape(search->corridor, box, critical->shape, critical->sample);
    }
    return run_and_keep(search->corridor, search->n_critical, curve, passes, error);
}

/* ---- the widest corridor --------------------------------------------------------------------- */

/* Quasi-random curves; in every sample of the scatter one of them and both edges. */
static CzStatus try_random(Search *search, const CzCorridorBox *box, CzError *error) {
    CzCorridor *corridor = search->corridor;
    const int per_sample = corridor->n_draw > 0 ? 3 : 1, n = corridor->n_random * per_sample;
    const int first = corridor->n_curve;
    bool passes = true;
    CzTriedCurve *curve = malloc((size_t)n * sizeof *curve);
    if (curve == NULL)
        return cz_no_memory(error, "the curves of a corridor");
    for (int k = 0; k < corridor->n_random; k++) {
        curve[k * per_sample] = make_random(corridor, box, k);
        for (int i = 1; i < per_sample; i++)
            curve[k * per_sample + i] =
                make_shape(corridor, box, i == 1 ? CZ_CURVE_LOWER : CZ_CURVE_UPPER, k);
    }
    const CzStatus status = run_and_keep(corridor, n, curve, &passes, error);
    free(curve);
    note_critical(search, first);
    return status;
}

/* The adversary, from the curves in a corridor with the smallest margins. */
static CzStatus challenge(CzCorridor *corridor, const CzCorridorBox *box, CzError *error) {
    CzTriedCurve start[N_CHALLENGED];
    int chosen[N_CHALLENGED], n = 0;
    for (; n < N_CHALLENGED; n++) {
        int worst = -1;
        for (int i = 0; i < corridor->n_curve; i++) {
            const CzTriedCurve *curve = &corridor->curve[i];
            const bool is_open = !isnan(curve->margin) && !(n > 0 && i == chosen[0]) &&
                                 is_inside(corridor, box, curve);
            if (is_open && (worst < 0 || curve->margin < corridor->curve[worst].margin))
                worst = i;
        }
        if (worst < 0)
            break;
        chosen[n] = worst;
        start[n] = corridor->curve[worst];
    }
    return cz_corridor_challenge(corridor, box, n, start, error);
}

/* Runs a curve in full, once; *is_refuted becomes true when its verdict is another one then. */
static CzStatus run_whole(CzCorridor *corridor, int at, bool *is_refuted, CzError *error) {
    CzTriedCurve whole = corridor->curve[at];
    if (whole.is_whole)
        return CZ_OK;
    whole.is_whole = true;
    whole.message[0] = '\0';
    CZ_TRY(cz_corridor_run(corridor, 1, &whole, error));
    *is_refuted |= cz_curve_passes(&whole) != cz_curve_passes(&corridor->curve[at]);
    corridor->curve[at] = whole;
    return CZ_OK;
}

/* Runs in full what decides: the curves of the smallest margins in a corridor, and those that fail
 * just beyond its edges. */
static CzStatus confirm(CzCorridor *corridor, const CzCorridorBox *box, bool *is_refuted,
                        CzError *error) {
    for (int k = 0; k < N_CONFIRMED && find_failing(corridor, box) < 0; k++) {
        int worst = -1;
        for (int i = 0; i < corridor->n_curve; i++)
            if (!corridor->curve[i].is_whole && is_inside(corridor, box, &corridor->curve[i]) &&
                (worst < 0 || is_worse(&corridor->curve[i], &corridor->curve[worst])))
                worst = i;
        if (worst >= 0)
            CZ_TRY(run_whole(corridor, worst, is_refuted, error));
    }
    for (int edge = 0; edge < 2; edge++) {
        CzCorridorBox wider = *box;
        wider.steps[edge]++;
        const int failing = find_failing(corridor, &wider);
        if (failing >= 0)
            CZ_TRY(run_whole(corridor, failing, is_refuted, error));
    }
    return CZ_OK;
}

/* Whether a corridor passes; it ends at the first kind of curves of which one fails. */
static CzStatus try_box(Search *search, const CzCorridorBox *box, bool *passes, CzError *error) {
    CzCorridor *corridor = search->corridor;
    const CzCorridorOptions *options = &corridor->parts->options;
    const int usual = N_SEARCHED * (int)ceil(log2(search->most_steps + 1));
    *passes = find_failing(corridor, box) < 0;
    if (!*passes)
        return CZ_OK;
    CZ_TRY(try_critical(search, box, passes, error));
    if (*passes)
        CZ_TRY(try_shapes(corridor, box, passes, error));
    search->n_done++;
    if (options->progress != NULL)
        options->progress(search->n_done, usual > search->n_done ? usual : search->n_done + 1,
                          options->progress_data);
    return CZ_OK;
}

/* ---- edges ----------------------------------------------------------------------------------- */

/* Widens a corridor that passes, at one edge or both, as far as it passes. When a failing curve is
 * found in what had passed, it begins again; when that is in `box` as given, it ends. */
static CzStatus widen(Search *search, bool moves_lower, bool moves_upper, CzCorridorBox *box,
                      CzError *error) {
    const CzCorridorBox given = *box;
    int beyond = search->most_steps + 1;
    const int from = given.steps[moves_lower ? 0 : 1];
    for (int at = from; beyond - at > 1;) {
        const int middle = (at + beyond) / 2;
        CzCorridorBox tried = given;
        bool passes;
        if (moves_lower)
            tried.steps[0] = middle;
        if (moves_upper)
            tried.steps[1] = middle;
        CZ_TRY(try_box(search, &tried, &passes, error));
        if (passes) {
            at = middle;
            *box = tried;
            continue;
        }
        beyond = middle;
        if (find_failing(search->corridor, box) < 0)
            continue;
        beyond = at;
        at = from;
        *box = given;
        if (find_failing(search->corridor, box) >= 0)
            break;
    }
    return CZ_OK;
}

/* Widens both edges, and tries all other curves in what was found; again as long as a curve in it
 * fails, or a run in full refutes a verdict. */
static CzStatus search_edges(Search *search, CzCorridorBox *box, CzError *error) {
    const CzCorridorBox nominal = {{0, 0}};
    CzCorridor *corridor = search->corridor;
    bool is_refuted;
    do {
        *box = (CzCorridorBox){{0, 0}};
        is_refuted = false;
        CZ_TRY(widen(search, true, true, box, error));
        CZ_TRY(widen(search, true, false, box, error));
        CZ_TRY(widen(search, false, true, box, error));
        const bool is_wide = box->steps[0] + box->steps[1] > 0;
        if (is_wide && find_failing(corridor, box) < 0)
            CZ_TRY(try_random(search, box, error));
        if (is_wide && find_failing(corridor, box) < 0)
            CZ_TRY(challenge(corridor, box, error));
        if (find_failing(corridor, box) < 0)
            CZ_TRY(confirm(corridor, box, &is_refuted, error));
        corridor->exists = find_failing(corridor, &nominal) < 0;
    } while (corridor->exists && (is_refuted || find_failing(corridor, box) >= 0));
    return CZ_OK;
}

/* The nominal curve, with the values of the file and in every sample. */
static CzStatus try_nominal(CzCorridor *corridor, CzError *error) {
    const CzCorridorBox box = {{0, 0}};
    const int n = corridor->n_draw > 0 ? corridor->n_random : 0;
    CzTriedCurve first = make_shape(corridor, &box, CZ_CURVE_NOMINAL, -1);
    first.is_whole = true;
    bool passes = true;
    CZ_TRY(run_and_keep(corridor, 1, &first, &passes, error));
    if (passes && n > 0) {
        CzTriedCurve *curve = malloc((size_t)n * sizeof *curve);
        if (curve == NULL)
            return cz_no_memory(error, "the curves of a corridor");
        for (int k = 0; k < n; k++)
            curve[k] = make_shape(corridor, &box, CZ_CURVE_NOMINAL, k);
        const CzStatus status = run_and_keep(corridor, n, curve, &passes, error);
        free(curve);
        CZ_TRY(status);
    }
    corridor->exists = passes;
    return CZ_OK;
}

/* Keeps the edges, with the curve that fails one step beyond each. */
static void keep_edges(CzCorridor *corridor, const CzCorridorBox *box) {
    for (int edge = 0; edge < 2; edge++) {
        CzCorridorBox wider = *box;
        wider.steps[edge]++;
        corridor->edge[edge] = (CzCorridorEdge){box->steps[edge] * corridor->resolution,
                                                find_failing(corridor, &wider)};
    }
    for (int i = 0; i < corridor->n_curve; i++) {
        corridor->n_inside += corridor->exists && is_inside(corridor, box, &corridor->curve[i]);
        corridor->n_refused += corridor->curve[i].state == CZ_SAMPLE_INVALID;
    }
}

CzStatus cz_corridor_search(CzCorridor *corridor, CzError *error) {
    Search search = {.corridor = corridor,
                     .most_steps = (int)lround(corridor->widest / corridor->resolution)};
    CzCorridorBox box = {{0, 0}};
    CzStatus status = try_nominal(corridor, error);
    if (status == CZ_OK && corridor->exists)
        status = search_edges(&search, &box, error);
    CZ_TRY(status == CZ_STATUS_INTERRUPTED ? CZ_OK : status);
    keep_edges(corridor, &box);
    return status;
}
