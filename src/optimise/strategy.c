/* The default strategy, that of a fit, and single algorithms by name.
 *
 *   screen    the start, then points that fill the box and a smaller one around the start
 *   descend   response surfaces from the best points that lie apart: planes; without catalogue
 *             increments then smooth ones between all designs, also from near the best design
 *   polish    COBYLA and elastic SLSQP by turns from the best, with smaller and smaller steps
 *   snap      to the catalogue increments
 *
 * The objective of a fit is a sum of squares of residuals that change smoothly. It descends by the
 * Gauss-Newton method, on planes of the residuals, and polishes with that method, BOBYQA, Sbplx and
 * COBYLA in turn.
 *
 * All slopes are secants over a share of the range: the response of a long train is chaotic, and
 * its local derivatives do not describe larger steps.
 */
#include "optimise/strategy.h"
#include "base/error.h"
#include "optimise/gauss_newton.h"
#include "optimise/nlopt_adapter.h"
#include "optimise/response.h"
#include "optimise/surface_held.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    MAX_STARTS = 60,
    MAX_STARTS_OF_FIT = 6,
    MAX_IDLE_STARTS = 8, /* descents in a row without an improvement (ours) */
    MIN_POINTS = 6,      /* of a screen between two descents */
    SCREEN_BATCH = 16    /* points of a screen side by side in a search of the usual width */
};

/* Half width of the smaller box around the start, from which every other screening point is
 * drawn. */
static const double near_start = 0.2;

/* Half width of the box around the best design from which every other descent begins. */
static const double hop_width = 0.25;

static void screen(CzSearch *search, unsigned long seed, long offset, long n_point) {
    const int n = search->function->n_variable;
    const int most = search->width > SCREEN_BATCH ? search->width : SCREEN_BATCH;
    const size_t room = (size_t)(2 * n + 1 + search->function->n_constraint);
    double *u = cz_search_numbers(search, (size_t)most * room + (size_t)n);
    if (u == NULL)
        return;
    double *x = u + most * n, *start = x + most * n;
    double *objective = start + n, *constraint = objective + most;
    cz_search_scale(search, search->function->start, start);
    for (long first = 0; first < n_point; first += most) {
        const long left = n_point - first;
        const int batch = left < most ? (int)left : most;
        for (int i = 0; i < batch; i++) {
            double *point = u + i * n;
            cz_sample_point(seed, offset + first + i, n, point);
            for (int j = 0; j < n && i % 2 == 1; j++) {
                point[j] = start[j] + near_start * (2 * point[j] - 1);
                point[j] = fmin(fmax(point[j], 0), 1);
            }
        }
        cz_search_unscale(search, batch, u, x);
        if (!cz_search_evaluate(search, "screen", batch, x, objective, constraint, NULL))
            break;
    }
    free(u);
}

/* The best record that is distant from all chosen points, -1 when there is none. */
static long best_apart(const CzSearch *search, int n_chosen, const double *chosen, double apart,
                       double *u) {
    long best = -1;
    for (long record = 0; record < search->n_record; record++) {
        if (isnan(search->record[record].objective) || !cz_search_is_better(search, record, best))
            continue;
        if (cz_search_is_apart(search, record, n_chosen, chosen, apart, u))
            best = record;
    }
    return best;
}

/* Descends on the residuals of a fit, from each of the best distant screening points. */
static CzStatus descend_fit(CzSearch *search, long evaluations, CzError *error) {
    const int n = search->function->n_variable;
    const long limit = search->n_record + evaluations;
    double *chosen = calloc((size_t)(MAX_STARTS_OF_FIT + 1) * (size_t)n, sizeof *chosen);
    if (chosen == NULL)
        return cz_no_memory(error, "the starting points");
    double *u = chosen + MAX_STARTS_OF_FIT * n;
    CzStatus status = CZ_OK;
    for (int start = 0; start < MAX_STARTS_OF_FIT && status == CZ_OK; start++) {
        const long record = best_apart(search, start, chosen, start == 0 ? 0 : 0.15, u);
        cz_search_resume(search); /* failures of earlier, distant points do not count here */
        const long left = limit - search->n_record;
        if (record < 0 || left < 3 * (n + 3) || cz_search_left(search) == 0)
            break;
        double *from = chosen + start * n;
        cz_search_scale(search, cz_search_x(search, record), from);
        status = cz_gauss_newton(search, "descend", from, left, error);
    }
    free(chosen);
    return status;
}

/* A further run from the best design, or from the start as long as every design failed. Without an
 * algorithm it is one of the Gauss-Newton method. */
static CzStatus run_from_best(CzSearch *search, const CzNloptRun *run, bool *gained,
                              CzError *error) {
    const long before = search->last_gain;
    double *u = calloc((size_t)search->function->n_variable, sizeof *u);
    if (u == NULL)
        return cz_no_memory(error, "a starting point");
    cz_search_scale(
        search, search->best >= 0 ? cz_search_x(search, search->best) : search->function->start, u);
    const CzStatus status = run->algorithm != NULL
                                ? cz_nlopt_run(search, run, u, error)
                                : cz_gauss_newton(search, run->phase, u, run->evaluations, error);
    free(u);
    *gained = search->last_gain != before;
    return status;
}

/* Runs COBYLA and elastic SLSQP in turn from the best design, with decreasing steps, until neither
 * improves it. */
static CzStatus polish(CzSearch *search, long reserve, CzError *error) {
    const int n = search->function->n_variable;
    double step = 0.05, secant = 3e-3;
    int n_idle = 0;
    while (n_idle < 4) {
        const long left = cz_search_left(search) - reserve;
        if (left < n + 2)
            break;
        const bool by_values = n_idle % 2 == 0;
        CzNloptRun run = cz_nlopt_run_default(by_values ? "LN_COBYLA" : "LD_SLSQP");
        run.phase = "polish";
        run.form = CZ_FORM_ELASTIC;
        run.first_step = by_values ? step : 0;
        run.secant = secant;
        run.evaluations = left < 12L * (n + 1) ? left : 12L * (n + 1);
        bool gained = false;
        CZ_TRY(run_from_best(search, &run, &gained, error));
        n_idle = gained ? 0 : n_idle + 1;
        if (!gained && !by_values) {
            step /= 3;
            secant /= 3;
        }
    }
    return CZ_OK;
}

/* The i-th of the four methods of a fit, NULL for Gauss-Newton; BOBYQA needs two variables. */
static const char *method_at(int i, int n_variable) {
    static const char *const methods[] = {NULL, "LN_BOBYQA", "LN_SBPLX", "LN_COBYLA"};
    return n_variable < 2 && i == 1 ? "LN_COBYLA" : methods[i];
}

/* Runs four methods in turn from the best design of a fit, until none of them improves it with the
 * smallest step. */
static CzStatus polish_fit(CzSearch *search, long reserve, CzError *error) {
    const int n = search->function->n_variable;
    double step = 0.05;
    int n_idle = 0;
    for (int turn = 0; step > 1e-4; turn++) {
        cz_search_resume(search);
        const long left = cz_search_left(search) - reserve;
        if (left < n + 4 || search->best < 0)
            break;
        CzNloptRun run = cz_nlopt_run_default(method_at(turn % 4, n));
        run.phase = "polish";
        run.form = CZ_FORM_PENALTY;
        run.first_step = step;
        run.tolerance = step / 1000;
        run.evaluations = left < 25L * (n + 1) ? left : 25L * (n + 1);
        bool gained = false;
        CZ_TRY(run_from_best(search, &run, &gained, error));
        n_idle = gained ? 0 : n_idle + 1;
        if (n_idle == 4) {
            step /= 4;
            n_idle = 0;
        }
    }
    return CZ_OK;
}

/* Screen, descend, polish of a fit, without the evaluations that are reserved for the catalogue
 * increments. */
static CzStatus fit_by_phases(CzSearch *search, unsigned long seed, CzError *error) {
    const long reserve = cz_snap_reserve(search);
    const long total = search->most_evaluations - reserve;
    if (!cz_search_evaluate_start(search, "start"))
        return CZ_OK;
    screen(search, seed, 0, total / 5);
    CZ_TRY(descend_fit(search, total / 2, error));
    return polish_fit(search, reserve, error);
}

/* Starts and ends of the descents so far, scaled (n x n_variable). */
typedef struct Visited {
    int n;
    long n_screened; /* points that filled the box */
    double *u;
    double *scratch; /* (n_variable) */
} Visited;

static void visit(Visited *visited, const double *u, int n_variable) {
    memcpy(visited->u + visited->n++ * n_variable, u, (size_t)n_variable * sizeof *u);
}

/* Points that fill the box before another descent. */
static long n_screen_of(const CzSearch *search, long left) {
    const int n = search->function->n_variable;
    const long usual = n + 2 < MIN_POINTS     ? MIN_POINTS
                       : n + 2 < SCREEN_BATCH ? n + 2
                                              : SCREEN_BATCH;
    /* a descent that follows needs evaluations too */
    return search->width > CZ_USUAL_WIDTH && search->width > usual && search->width < left / 2
               ? search->width
               : usual;
}

/* The design from which the next descent begins: the start, or the best one where margins are held,
 * then the best one that is distant from the earlier descents, after more points; -1 when there is
 * none. The last evaluations, too few for a new descent, go to the best design. */
static long next_start(const CzSurface *surface, unsigned long seed, int start, long left,
                       Visited *visited) {
    CzSearch *search = surface->search;
    const int n = search->function->n_variable;
    const long n_screen = n_screen_of(search, left);
    if (start == 0)
        return surface->n_held > 0 ? search->best : 0;
    if (left <= n_screen + 3 * (n + 2))
        return search->best;
    screen(search, seed, visited->n_screened, n_screen);
    visited->n_screened += n_screen;
    const double apart = 0.15 / (1 + start / 4);
    return best_apart(search, visited->n, visited->u, apart, visited->scratch);
}

/* Whether descents go on on smooth surfaces between all designs: not with catalogue increments,
 * where the best design between them is often far from the best one on them. */
static bool has_smooth_surfaces(const CzSearch *search) {
    return !cz_search_has_steps(search);
}

/* Descends on planes, then, from a design that passes or where the smallest margin is maximised, on
 * smooth surfaces. */
static void descend(CzSurface *surface, const double *from, long evaluations) {
    CzSearch *search = surface->search;
    const long first = search->n_record;
    const bool is_smooth = has_smooth_surfaces(search);
    cz_surface_descend(surface, "descend", from, evaluations, !is_smooth);
    const long left = evaluations - (search->n_record - first);
    if (surface->record < first || left < 1 || !is_smooth ||
        (surface->penalty > 0 && !search->function->is_minimax))
        return;
    memcpy(surface->x, cz_search_x(search, surface->record),
           (size_t)surface->n * sizeof *surface->x);
    cz_response_descend(surface, "descend", surface->x, left);
}

/* Descends on smooth surfaces from a random design near the best one; false where only more points
 * in the whole box may find a design that passes. */
static bool hop(CzSurface *surface, unsigned long seed, int start, long reserve) {
    CzSearch *search = surface->search;
    const int n = surface->n;
    const long left = cz_search_left(search) - reserve;
    if (left < n + 2 || search->best < 0 || !has_smooth_surfaces(search) ||
        (search->record[search->best].penalty > 0 && !search->function->is_minimax))
        return false;
    double *u = cz_search_numbers(search, 3 * (size_t)n), *x = u + n, *best = x + n;
    if (u == NULL)
        return false;
    cz_sample_point(seed + 1000, start, n, u);
    cz_search_scale(search, cz_search_x(search, search->best), best);
    for (int i = 0; i < n; i++)
        u[i] = fmin(fmax(best[i] + hop_width * (2 * u[i] - 1), 0), 1);
    cz_search_unscale(search, 1, u, x);
    cz_response_descend(surface, "descend", x, left);
    free(u);
    return true;
}

/* Descends from a record, or from the file's own design where that is -1. */
static void descend_from(CzSurface *surface, long record, long evaluations, Visited *visited) {
    CzSearch *search = surface->search;
    const double *from = record < 0 ? search->function->start : cz_search_x(search, record);
    cz_search_scale(search, from, visited->scratch);
    visit(visited, visited->scratch, surface->n);
    descend(surface, from, evaluations);
    visit(visited, surface->u, surface->n);
}

/* Descends from the start, then from the best of further points that fill the box, as long as
 * evaluations are left and some of the latest descents improved the best design, which each time is
 * moved to the catalogue increments. Then the last evaluations are left to `cz_snap`. */
static void search_basins(CzSurface *surface, unsigned long seed, Visited *visited) {
    CzSearch *search = surface->search;
    const long reserve = cz_search_has_steps(search) ? surface->n / 2 + 8 : 0;
    int n_idle = 0;
    for (int start = 0; start < MAX_STARTS && n_idle < MAX_IDLE_STARTS; start++) {
        const long gain_before = search->last_gain, best_before = search->best;
        const bool has_hopped = start % 2 == 1 && hop(surface, seed, start, reserve);
        const long record = has_hopped ? search->best
                                       : next_start(surface, seed, start,
                                                    cz_search_left(search) - reserve, visited);
        const long left = cz_search_left(search) - reserve;
        const bool is_for_increments = start > 0 && record == search->best && record >= 0 &&
                                       cz_search_has_steps(search) &&
                                       search->record[record].penalty <= 0;
        if (left < surface->n + 2 || is_for_increments)
            break;
        if (record >= 0 && !has_hopped)
            descend_from(surface, start == 0 && surface->n_held == 0 ? -1 : record, left, visited);
        if (search->last_gain != gain_before)
            n_idle = 0;
        else if (record >= 0)
            n_idle++;
        if (search->best != best_before)
            cz_snap(surface, cz_search_left(search), false);
        if (cz_surface_is_capped(surface))
            break;
    }
}

/* Holds the smallest margin, and the next ones, where they are capped at the best design. Returns
 * whether there is a next margin to maximise. */
static bool hold_margins(CzSurface *surface) {
    CzSearch *search = surface->search;
    const long best = cz_search_has_steps(search) ? search->best_on_grid : search->best;
    if (!search->function->is_minimax || best < 0 || search->record[best].penalty > 0 ||
        cz_search_left(search) < 2 * (surface->n + 2))
        return false;
    if (surface->record < 0 || cz_search_is_better(search, best, surface->record)) {
        double *u = cz_search_numbers(search, (size_t)surface->n);
        if (u == NULL)
            return false;
        cz_search_scale(search, cz_search_x(search, best), u);
        const bool has_planes = cz_surface_begin(surface, "descend", u, 0.02);
        free(u);
        if (!has_planes)
            return false;
    }
    return cz_surface_hold_capped(surface);
}

/* Descents from several designs; then the best one is refined, on the increments by `cz_strategy`.
 * Where the smallest margin cannot grow, the next ones are maximised in turn. */
static CzStatus search_by_phases(CzSurface *surface, unsigned long seed, CzError *error) {
    CzSearch *search = surface->search;
    const size_t n = (size_t)surface->n;
    Visited visited = {.u = cz_search_numbers(search, (2 * MAX_STARTS + 1) * n)};
    if (visited.u == NULL)
        return cz_no_memory(error, "the starting points");
    visited.scratch = visited.u + 2 * MAX_STARTS * n;
    search_basins(surface, seed, &visited);
    CzStatus status = CZ_OK;
    if (search->n_record == 0) /* too few evaluations for planes */
        cz_search_evaluate_start(search, "start");
    if (!cz_search_has_steps(search) && !cz_surface_is_capped(surface))
        status = polish(search, 0, error);
    while (status == CZ_OK && hold_margins(surface)) {
        visited.n = 0;
        search_basins(surface, seed, &visited);
    }
    free(visited.u);
    return status;
}

/* Repeats one algorithm from the best design as long as that is an improvement. */
static CzStatus repeat(CzSearch *search, const char *algorithm, unsigned long seed,
                       CzError *error) {
    const long reserve = cz_snap_reserve(search);
    CzNloptRun run = cz_nlopt_run_default(algorithm);
    bool gained = cz_search_evaluate_start(search, "start"); /* counts as the first improvement */
    for (run.seed = seed; gained; run.seed++) {
        run.evaluations = cz_search_left(search) - reserve;
        if (run.evaluations < 1)
            break;
        CZ_TRY(run_from_best(search, &run, &gained, error));
    }
    return CZ_OK;
}

CzStatus cz_strategy(CzSearch *search, const char *algorithm, unsigned long seed, CzError *error) {
    CzSurface surface;
    if (!cz_surface_create(&surface, search, CZ_USUAL_WIDTH)) {
        cz_surface_free(&surface);
        return cz_no_memory(error, "the response surfaces");
    }
    const CzStatus status = algorithm != NULL          ? repeat(search, algorithm, seed, error)
                            : search->function->is_fit ? fit_by_phases(search, seed, error)
                                                       : search_by_phases(&surface, seed, error);
    search->is_spent =
        cz_search_left(search) - cz_snap_reserve(search) < search->function->n_variable + 2;
    if (status == CZ_OK)
        cz_snap(&surface, search->most_evaluations - search->n_record, true);
    cz_surface_free(&surface);
    return status;
}
