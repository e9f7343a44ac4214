/* The usual strategy, and one algorithm by name.
 *
 *   screen    the start, then points that fill the box and a smaller one around the start
 *   descend   response surfaces from the best points that lie apart
 *   polish    COBYLA and elastic SLSQP by turns from the best, with smaller and smaller steps
 *   snap      to the catalogue increments
 *
 * A fit goes another way: its objective is a sum of squares of residuals that change smoothly, so
 * planes of the residuals lead further than planes of the objective; BOBYQA, Sbplx and COBYLA take
 * over where they do not.
 *
 * The gain of a long train's rattling is in secants: local derivatives are exact and useless.
 */
#include "optimise/strategy.h"
#include "base/error.h"
#include "optimise/gauss_newton.h"
#include "optimise/nlopt_adapter.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_STARTS = 6, SCREEN_BATCH = 16, MOST_BATCH = 8 };

/* Half width of the smaller box around the start that every other screening point is drawn from. */
static const double near_start = 0.2;

/* Evaluates scaled points in one batch. */
static bool evaluate_scaled(CzSearch *search, const char *phase, int n_point, const double *u) {
    const size_t n = (size_t)search->function->n_variable;
    const size_t m = (size_t)search->function->n_constraint + 1;
    double *x = cz_search_numbers(search, (size_t)n_point * (n + 1 + m));
    bool done = false;
    if (x != NULL) {
        for (int i = 0; i < n_point; i++)
            cz_search_unscale(search, u + (size_t)i * n, x + (size_t)i * n);
        double *objective = x + (size_t)n_point * n;
        done = cz_search_evaluate(search, phase, n_point, x, objective, objective + n_point);
    }
    free(x);
    return done;
}

/* The start as it is written, to the last bit. */
static bool evaluate_start(CzSearch *search) {
    double objective,
        *constraint = cz_search_numbers(search, (size_t)search->function->n_constraint);
    const bool done =
        constraint != NULL &&
        cz_search_evaluate(search, "start", 1, search->function->start, &objective, constraint);
    free(constraint);
    return done;
}

static void screen(CzSearch *search, unsigned long seed, long n_point) {
    const int n = search->function->n_variable;
    double *u = cz_search_numbers(search, (size_t)(SCREEN_BATCH + 1) * (size_t)n);
    if (u == NULL)
        return;
    double *start = u + SCREEN_BATCH * n;
    cz_search_scale(search, search->function->start, start);
    for (long first = 0; first < n_point; first += SCREEN_BATCH) {
        const long left = n_point - first;
        const int batch = left < SCREEN_BATCH ? (int)left : SCREEN_BATCH;
        for (int i = 0; i < batch; i++) {
            double *point = u + i * n;
            cz_sample_point(seed, first + i, n, point);
            for (int j = 0; j < n && i % 2 == 1; j++) {
                point[j] = start[j] + near_start * (2 * point[j] - 1);
                point[j] = fmin(fmax(point[j], 0), 1);
            }
        }
        if (!evaluate_scaled(search, "screen", batch, u))
            break;
    }
    free(u);
}

/* The best record that lies apart from all chosen points, -1 when there is none. */
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

/* Response surfaces from the best screened points that lie apart. */
static CzStatus descend(CzSurface *surface, long evaluations, CzError *error) {
    CzSearch *search = surface->search;
    const int n = surface->n;
    const long limit = search->n_record + evaluations;
    double *chosen = calloc((size_t)(MOST_STARTS + 1) * (size_t)n, sizeof *chosen);
    if (chosen == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the starting points");
    double *u = chosen + MOST_STARTS * n;
    for (int start = 0; start < MOST_STARTS; start++) {
        const long record = best_apart(search, start, chosen, start == 0 ? 0 : 0.15, u);
        const long left = limit - search->n_record;
        if (record < 0 || left < 3 * (n + 1) || cz_search_left(search) == 0)
            break;
        cz_search_scale(search, cz_search_x(search, record), u);
        memcpy(chosen + start * n, u, (size_t)n * sizeof *u);
        cz_surface_descend(surface, "descend", u, left);
    }
    free(chosen);
    return CZ_OK;
}

/* One more run from the best design, or from the start while every design failed. */
static CzStatus run_from_best(CzSearch *search, const CzNloptRun *run, bool *gained,
                              CzError *error) {
    const long before = search->last_gain;
    double *u = calloc((size_t)search->function->n_variable, sizeof *u);
    if (u == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for a starting point");
    cz_search_scale(
        search, search->best >= 0 ? cz_search_x(search, search->best) : search->function->start, u);
    const CzStatus status = cz_nlopt_run(search, run, u, error);
    free(u);
    *gained = search->last_gain != before;
    return status;
}

/* COBYLA and elastic SLSQP by turns from the best design, with smaller and smaller steps, until
 * neither gains. */
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
        const CzStatus status = run_from_best(search, &run, &gained, error);
        if (status != CZ_OK)
            return status;
        n_idle = gained ? 0 : n_idle + 1;
        if (!gained && !by_values) {
            step /= 3;
            secant /= 3;
        }
    }
    return CZ_OK;
}

/* Screen, descend, polish; what is set aside for the catalogue increments stays. */
static CzStatus lead(CzSurface *surface, unsigned long seed, CzError *error) {
    CzSearch *search = surface->search;
    const long reserve = cz_snap_reserve(search);
    const long total = search->most_evaluations - reserve;
    if (!evaluate_start(search))
        return CZ_OK;
    const long enough = 2L * search->function->n_variable; /* a poor start costs more than these */
    screen(search, seed, fmax(total / 10, fmin(enough, total / 4)));
    CZ_TRY(descend(surface, total * 2 / 3, error));
    return polish(search, reserve, error);
}

/* ---- fits ------------------------------------------------------------------------------------ */

/* The algorithm at the i-th turn; BOBYQA needs two variables. */
static const char *turn_of(int i, int n_variable) {
    static const char *const turns[] = {"LN_BOBYQA", "LN_SBPLX", "LN_COBYLA"};
    return n_variable < 2 && i % 3 == 0 ? "LN_COBYLA" : turns[i % 3];
}

/* Steps on residuals from the best design. */
static CzStatus step_from_best(CzSearch *search, long evaluations, bool *gained, CzError *error) {
    const long before = search->last_gain;
    double *u = calloc((size_t)search->function->n_variable, sizeof *u);
    if (u == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for a starting point");
    cz_search_scale(search, cz_search_x(search, search->best), u);
    const CzStatus status = cz_gauss_newton(search, "polish", u, evaluations, error);
    free(u);
    *gained = search->last_gain != before;
    return status;
}

/* Steps on residuals from each of the best screened points that lie apart. */
static CzStatus descend_apart(CzSearch *search, long evaluations, CzError *error) {
    const int n = search->function->n_variable;
    const long limit = search->n_record + evaluations;
    double *chosen = calloc((size_t)(MOST_STARTS + 1) * (size_t)n, sizeof *chosen);
    if (chosen == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the starting points");
    double *u = chosen + MOST_STARTS * n;
    CzStatus status = CZ_OK;
    for (int start = 0; start < MOST_STARTS && status == CZ_OK; start++) {
        const long record = best_apart(search, start, chosen, start == 0 ? 0 : 0.15, u);
        cz_search_resume(search); /* failures further away say nothing about here */
        const long left = limit - search->n_record;
        if (record < 0 || left < 3 * (n + 3) || cz_search_left(search) == 0)
            break;
        cz_search_scale(search, cz_search_x(search, record), u);
        memcpy(chosen + start * n, u, (size_t)n * sizeof *u);
        status = cz_gauss_newton(search, "descend", u, left, error);
    }
    free(chosen);
    return status;
}

/* Four methods by turns from the best design, until none of them gains with the smallest step. */
static CzStatus refine(CzSearch *search, long reserve, CzError *error) {
    const int n = search->function->n_variable;
    double step = 0.05;
    int n_idle = 0;
    for (int turn = 0; step > 1e-4; turn++) {
        cz_search_resume(search);
        const long left = cz_search_left(search) - reserve;
        const long some = left < 25L * (n + 1) ? left : 25L * (n + 1);
        if (left < n + 4 || search->best < 0)
            break;
        bool gained = false;
        if (turn % 4 == 0) {
            CZ_TRY(step_from_best(search, some, &gained, error));
        } else {
            CzNloptRun run = cz_nlopt_run_default(turn_of(turn % 4 - 1, n));
            run.phase = "polish";
            run.form = CZ_FORM_PENALTY;
            run.first_step = step;
            run.tolerance = step / 1000;
            run.evaluations = some;
            CZ_TRY(run_from_best(search, &run, &gained, error));
        }
        n_idle = gained ? 0 : n_idle + 1;
        if (n_idle == 4) {
            step /= 4;
            n_idle = 0;
        }
    }
    return CZ_OK;
}

static CzStatus fit(CzSearch *search, unsigned long seed, CzError *error) {
    const long reserve = cz_snap_reserve(search);
    const long total = search->most_evaluations - reserve;
    if (!evaluate_start(search))
        return CZ_OK;
    screen(search, seed, total / 5);
    CZ_TRY(descend_apart(search, total / 2, error));
    return refine(search, reserve, error);
}

/* One algorithm again and again from the best design while that gains. */
static CzStatus repeat(CzSearch *search, const char *algorithm, unsigned long seed,
                       CzError *error) {
    const long reserve = cz_snap_reserve(search);
    CzNloptRun run = cz_nlopt_run_default(algorithm);
    bool gained = evaluate_start(search); /* the start is the first gain */
    for (run.seed = seed; gained; run.seed++) {
        run.evaluations = cz_search_left(search) - reserve;
        if (run.evaluations < 1)
            break;
        CZ_TRY(run_from_best(search, &run, &gained, error));
    }
    return CZ_OK;
}

/* `algorithm` NULL: the usual strategy, or that of a fit. */
static CzStatus search_and_snap(CzSearch *search, const char *algorithm, bool is_fit,
                                unsigned long seed, CzError *error) {
    CzSurface surface;
    if (!cz_surface_create(&surface, search, MOST_BATCH))
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the response surfaces");
    const CzStatus status = algorithm != NULL ? repeat(search, algorithm, seed, error)
                            : is_fit          ? fit(search, seed, error)
                                              : lead(&surface, seed, error);
    search->is_spent =
        cz_search_left(search) - cz_snap_reserve(search) < search->function->n_variable + 2;
    if (status == CZ_OK)
        cz_snap(&surface, search->most_evaluations - search->n_record);
    cz_surface_free(&surface);
    return status;
}

CzStatus cz_strategy_auto(CzSearch *search, unsigned long seed, CzError *error) {
    return search_and_snap(search, NULL, false, seed, error);
}

CzStatus cz_strategy_fit(CzSearch *search, unsigned long seed, CzError *error) {
    return search_and_snap(search, NULL, true, seed, error);
}

CzStatus cz_strategy_named(CzSearch *search, const char *algorithm, unsigned long seed,
                           CzError *error) {
    return search_and_snap(search, algorithm, false, seed, error);
}
