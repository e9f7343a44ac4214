/* Descents on smooth response surfaces. */
#include "optimise/response.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double first_radius = 0.2, largest_radius = 0.5, smallest_radius = 1e-3;
static const double least_gain = 1e-5; /* on the response, of the merit, for a step */
static const double first_weight = 10, most_weight = 1e4; /* price of violations */

enum {
    MAX_PLANES = 150, /* planes of a response until its best design (ours) */
    MAX_IDLE = 4      /* designs without the gain that was planned (ours) */
};

typedef struct Descent {
    CzSurface *surface;
    CzResponse response;
    const char *phase;
    long first, limit; /* records of this descent */
    long base;         /* record with the least merit */
    double radius;
    int n_idle;                        /* designs in a row that gained little */
    int n_outside;                     /* steps in a row that left the base violated as before */
    double *u, *next, *best, *lo, *hi; /* base, scratch, best on the response, box, scaled (n) */
    double *direction;                 /* of the designs near the base (n x n) */
    int n_direction;
} Descent;

/* ---- merit of designs ------------------------------------------------------------------------ */

/* Objective of a record: where the smallest margin is maximised, that of the details. */
static double objective_of(const CzSurface *surface, long number) {
    const double *c = cz_search_detail(surface->search, number);
    double largest = -INFINITY;
    for (int k = 0; k < surface->m && surface->search->function->is_minimax; k++)
        if (!isnan(c[k]))
            largest = cz_surface_counted(largest, surface, k, c[k]);
    return isfinite(largest) ? largest : surface->search->record[number].objective;
}

/* Infinite where a run failed. */
static double merit_of(const CzSurface *surface, long number) {
    if (isnan(surface->search->record[number].objective))
        return INFINITY;
    return objective_of(surface, number) / surface->scale +
           surface->weight * cz_surface_penalty(surface, number);
}

/* Sets the base to the record of the descent with the least merit. */
static void choose_base(Descent *descent) {
    const CzSearch *search = descent->surface->search;
    double least = INFINITY;
    for (long i = descent->first; i < search->n_record; i++) {
        const double merit = merit_of(descent->surface, i);
        if (merit < least) {
            least = merit;
            descent->base = i;
        }
    }
    cz_search_scale(search, cz_search_x(search, descent->base), descent->u);
}

/* ---- the best design on the response --------------------------------------------------------- */

/* Merit on the response, whose planes at u the surface gets. */
static double merit_at(const Descent *descent, const double *u) {
    CzSurface *surface = descent->surface;
    cz_response_linearise(&descent->response, u, false, surface);
    return cz_surface_merit_at(surface, u, surface->usual_reserve);
}

/* The best design on the planes of the surface within `reach` of a design and in the box. */
static bool best_near(Descent *descent, const double *u, double reach, double *box) {
    CzSurface *surface = descent->surface;
    const int n = surface->n;
    for (int i = 0; i < n; i++) {
        box[i] = fmax(descent->lo[i], u[i] - reach);
        box[n + i] = fmin(descent->hi[i], u[i] + reach);
    }
    return cz_surface_best_in(surface, box, box + n, surface->usual_reserve, descent->next);
}

/* Sets `best` to the best design on the response in the box, by planes of it in boxes around the
 * best one so far that grow and shrink. */
static void find_best(Descent *descent) {
    CzSurface *surface = descent->surface;
    const size_t n = (size_t)surface->n;
    double *box = cz_search_numbers(surface->search, 2 * n);
    memcpy(descent->best, descent->u, n * sizeof *descent->u);
    double reach = descent->radius, merit = merit_at(descent, descent->best);
    for (int i = 0; box != NULL && i < MAX_PLANES && reach > 1e-4; i++) {
        if (!best_near(descent, descent->best, reach, box))
            break;
        const double planned =
            merit - cz_surface_merit_at(surface, descent->next, surface->usual_reserve);
        if (planned < 1e-7)
            break;
        const double other = merit_at(descent, descent->next);
        const double ratio = (merit - other) / planned;
        const double step = cz_largest_difference(descent->next, descent->best, (int)n);
        if (ratio > 0) {
            memcpy(descent->best, descent->next, n * sizeof *descent->best);
            merit = other;
        } else {
            merit_at(descent, descent->best);
        }
        if (ratio < 0.3)
            reach = fmin(reach, step) * 0.4;
        else if (ratio > 0.6)
            reach = fmin(2 * reach, descent->radius);
    }
    free(box);
}

/* The gain of merit that the response plans for its best design, without a reserve. */
static double planned_gain(const Descent *descent) {
    CzSurface *surface = descent->surface;
    cz_response_linearise(&descent->response, descent->u, true, surface);
    const double before = cz_surface_merit_at(surface, descent->u, NULL);
    cz_response_linearise(&descent->response, descent->best, true, surface);
    return before - cz_surface_merit_at(surface, descent->best, NULL);
}

/* Largest difference of a record from the response at its best design, as a share of the largest
 * change from the base that the response had planned. */
static double error_of(Descent *descent, long record) {
    const double small = 5e-4, far = -0.3; /* a difference, and margins, that do not count (ours) */
    CzSurface *surface = descent->surface;
    const double *is = cz_search_detail(surface->search, record);
    const double *was = cz_search_detail(surface->search, descent->base);
    double error = 0, change = 1e-9;
    if (isnan(surface->search->record[record].objective))
        return INFINITY;
    cz_response_linearise(&descent->response, descent->best, true, surface);
    if (!surface->search->function->is_minimax) {
        error = fabs(objective_of(surface, record) - surface->f) / surface->scale;
        change = fabs(surface->f - objective_of(surface, descent->base)) / surface->scale;
    }
    for (int v = 1; v < descent->response.n_value; v++) {
        const int k = descent->response.detail[v];
        if (isnan(is[k]) || isnan(was[k]) || (is[k] < far && surface->c[k] < far))
            continue;
        const double planned = cz_search_compressed(surface->c[k]);
        error = fmax(error, fabs(cz_search_compressed(is[k]) - planned));
        change = fmax(change, fabs(planned - cz_search_compressed(was[k])));
    }
    return fmax(error - small, 0) / change;
}

/* ---- designs around the base ----------------------------------------------------------------- */

/* Evaluates n_point designs of surface->x. */
static bool evaluate(Descent *descent, int n_point) {
    CzSurface *surface = descent->surface;
    CzSearch *search = surface->search;
    return cz_search_evaluate(search, search->n_record == 0 ? "start" : descent->phase, n_point,
                              surface->x, surface->many_f, surface->many_c, surface->many_d);
}

/* Adds the part of d that is orthogonal to the directions so far, unless it is shorter than
 * `least`. */
static void add_direction(Descent *descent, double *d, double least) {
    const int n = descent->surface->n;
    double square = 0;
    for (int k = 0; k < descent->n_direction; k++) {
        const double *direction = descent->direction + k * n;
        double dot = 0;
        for (int i = 0; i < n; i++)
            dot += d[i] * direction[i];
        for (int i = 0; i < n; i++)
            d[i] -= dot * direction[i];
    }
    for (int i = 0; i < n; i++)
        square += d[i] * d[i];
    if (!(square > least * least) || descent->n_direction == n)
        return;
    for (int i = 0; i < n; i++)
        descent->direction[descent->n_direction * n + i] = d[i] / sqrt(square);
    descent->n_direction++;
}

/* Lists the directions of the designs within `near` of the base, the latest ones first. */
static void list_directions(Descent *descent, double near) {
    const double least_angle = 0.1; /* to the directions before (ours) */
    const CzSearch *search = descent->surface->search;
    const int n = descent->surface->n;
    double *d = descent->next;
    descent->n_direction = 0;
    for (long record = search->n_record - 1; record >= 0; record--) {
        double square = 0;
        if (record == descent->base || isnan(search->record[record].objective))
            continue;
        cz_search_scale(search, cz_search_x(search, record), d);
        if (cz_largest_difference(d, descent->u, n) > near)
            continue;
        for (int i = 0; i < n; i++) {
            d[i] -= descent->u[i];
            square += d[i] * d[i];
        }
        add_direction(descent, d, least_angle * sqrt(fmax(square, 0.01 * near * near)));
    }
}

/* The variable whose change is the most independent of the directions, -1 when none is. */
static int most_independent(const Descent *descent) {
    const int n = descent->surface->n;
    int best = -1;
    double most = 1e-6;
    for (int i = 0; i < n && descent->n_direction < n; i++) {
        double left = 1;
        for (int k = 0; k < descent->n_direction; k++)
            left -= descent->direction[k * n + i] * descent->direction[k * n + i];
        if (left > most) {
            most = left;
            best = i;
        }
    }
    return best;
}

/* Evaluates designs that change one variable of the base, where no design near it shows what that
 * variable does. False when the search ended. */
static bool explore(Descent *descent, double step, double near) {
    CzSurface *surface = descent->surface;
    const int n = surface->n;
    const long left = descent->limit - surface->search->n_record;
    int n_point = 0;
    list_directions(descent, near);
    for (int i; n_point < left && (i = most_independent(descent)) >= 0;) {
        const int before = descent->n_direction;
        memset(descent->next, 0, (size_t)n * sizeof *descent->next);
        descent->next[i] = 1;
        add_direction(descent, descent->next, 0);
        if (descent->n_direction == before)
            break;
        const double kept = descent->u[i];
        descent->u[i] += cz_search_secant(kept, step);
        if (!surface->is_frozen[i])
            cz_search_unscale(surface->search, 1, descent->u, surface->x + n_point++ * n);
        descent->u[i] = kept;
    }
    return n_point == 0 || evaluate(descent, n_point);
}

/* ---- the descent ----------------------------------------------------------------------------- */

/* Sets the first design of a descent, which is evaluated unless it is in the history. */
static bool begin(Descent *descent, const double *x) {
    CzSurface *surface = descent->surface;
    CzSearch *search = surface->search;
    memcpy(surface->x, x, (size_t)surface->n * sizeof *x); /* `x` may move with the history */
    descent->first = descent->base = cz_search_find(search, surface->x);
    if (descent->base < 0) {
        descent->first = descent->base = search->n_record;
        if (!evaluate(descent, 1))
            return false;
    }
    if (isnan(search->record[descent->base].objective))
        return false;
    const double size = fabs(search->record[descent->base].objective);
    const bool is_minimax = search->function->is_minimax;
    surface->scale = is_minimax || !(size > 1e-9) ? 1 : size;
    /* where no design passes, the largest violation is the objective */
    surface->weight =
        is_minimax && cz_surface_penalty(surface, descent->base) > 0 ? 0 : first_weight;
    descent->radius = first_radius;
    cz_search_scale(search, cz_search_x(search, descent->base), descent->u);
    return explore(descent, 0.02, first_radius);
}

/* Interpolates around the base: the farther the steps, the more distant designs. */
static bool fit(Descent *descent) {
    const CzSurface *surface = descent->surface;
    choose_base(descent);
    for (int i = 0; i < surface->n; i++) {
        const double reach = surface->is_frozen[i] ? 0 : descent->radius;
        descent->lo[i] = fmax(descent->u[i] - reach, 0);
        descent->hi[i] = fmin(descent->u[i] + reach, 1);
    }
    return cz_response_fit(&descent->response, descent->u, 2 * descent->radius * sqrt(surface->n));
}

/* Raises the price of violations when gains leave the base as violated as before. */
static void raise_weight(Descent *descent, double penalty, double before) {
    CzSurface *surface = descent->surface;
    descent->n_outside = penalty > 0.5 * before ? descent->n_outside + 1 : 0;
    if (descent->n_outside < 3 || !(surface->weight > 0) || surface->weight >= most_weight)
        return;
    surface->weight *= 5;
    descent->n_outside = 0;
}

/* Evaluates the best design on the response; false when the search ended or knows it. The response
 * learns from a design that it predicted badly, so the box shrinks only where it was far off. */
static bool try_best(Descent *descent) {
    CzSurface *surface = descent->surface;
    CzSearch *search = surface->search;
    const double planned = planned_gain(descent);
    const double step = cz_largest_difference(descent->best, descent->u, surface->n);
    cz_search_unscale(search, 1, descent->best, surface->x);
    if (cz_search_find(search, surface->x) >= 0 || !evaluate(descent, 1))
        return false;
    const long record = search->n_record - 1;
    const double gain = merit_of(surface, descent->base) - merit_of(surface, record);
    const double error = error_of(descent, record);
    if (error < 0.25 && step > 0.9 * descent->radius)
        descent->radius = fmin(2 * descent->radius, largest_radius);
    else if (error > 0.6 && gain <= 0)
        descent->radius = 0.6 * fmin(fmax(step, 0.4 * descent->radius), descent->radius);
    descent->n_idle = gain > 0.1 * fmax(planned, 1e-4) ? 0 : descent->n_idle + 1;
    if (gain > 0)
        raise_weight(descent, cz_surface_penalty(surface, record),
                     cz_surface_penalty(surface, descent->base));
    return true;
}

static void descend(Descent *descent) {
    const CzSearch *search = descent->surface->search;
    while (search->n_record < descent->limit && !search->is_over && fit(descent)) {
        find_best(descent);
        const bool is_worth = planned_gain(descent) > least_gain &&
                              cz_largest_difference(descent->best, descent->u,
                                                    descent->surface->n) > smallest_radius / 4;
        if (is_worth && !try_best(descent))
            return;
        if (is_worth && descent->n_idle < MAX_IDLE && descent->radius > smallest_radius)
            continue;
        descent->n_idle = 0;
        descent->radius *= 0.5;
        choose_base(descent);
        if (descent->radius <= smallest_radius ||
            !explore(descent, descent->radius, 2.5 * descent->radius))
            return;
    }
}

/* Leaves the surface at the base, with the planes of the response. */
static void end(Descent *descent) {
    CzSurface *surface = descent->surface;
    if (surface->search->is_over || surface->search->n_record <= descent->first || !fit(descent))
        return;
    cz_response_linearise(&descent->response, descent->u, false, surface);
    surface->record = descent->base;
}

void cz_response_descend(CzSurface *surface, const char *phase, const double *x, long evaluations) {
    CzSearch *search = surface->search;
    const size_t n = (size_t)surface->n;
    Descent descent = {.surface = surface, .phase = phase, .limit = search->n_record + evaluations};
    double *memory = cz_search_numbers(search, (5 + n) * n);
    if (memory == NULL)
        return;
    if (cz_response_create(&descent.response, surface)) {
        descent.u = memory;
        descent.next = memory + n;
        descent.best = memory + 2 * n;
        descent.lo = memory + 3 * n;
        descent.hi = memory + 4 * n;
        descent.direction = memory + 5 * n;
        if (begin(&descent, x))
            descend(&descent);
        end(&descent);
    } else {
        cz_search_end_without_memory(search);
    }
    cz_response_free(&descent.response);
    free(memory);
}
