/* Linear response surfaces: planes around a base design, their correction, and descents on them. */
#include "optimise/surface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool cz_surface_create(CzSurface *surface, CzSearch *search, int most) {
    const int n = search->function->n_variable, m = cz_search_n_detail(search);
    const size_t batch = (size_t)(most > n + 1 ? most : n + 1);
    *surface = (CzSurface){.search = search,
                           .n = n,
                           .m = m,
                           .record = -1,
                           .scale = 1,
                           .weight = 10,
                           .most = (int)batch};
    CzArena *arena = &surface->arena;
    surface->u = cz_arena_numbers(arena, (size_t)n);
    surface->c = cz_arena_numbers(arena, (size_t)m);
    surface->is_known = cz_arena_allocate(arena, (size_t)m + 1, sizeof *surface->is_known);
    surface->df = cz_arena_numbers(arena, (size_t)n);
    surface->dc = cz_arena_numbers(arena, (size_t)(m * n));
    surface->x = cz_arena_numbers(arena, batch * (size_t)n);
    surface->usual_reserve = cz_arena_numbers(arena, (size_t)m);
    surface->is_held = cz_arena_allocate(arena, (size_t)m + 1, sizeof(bool));
    surface->is_frozen = cz_arena_allocate(arena, (size_t)n, sizeof(bool));
    surface->frozen_at = cz_arena_numbers(arena, (size_t)n);
    surface->many_f = cz_arena_numbers(arena, batch);
    surface->many_c = cz_arena_numbers(arena, batch * (size_t)search->function->n_constraint);
    surface->many_d = cz_arena_numbers(arena, batch * (size_t)m);
    for (int k = 0; k < m && !arena->out_of_memory; k++)
        surface->usual_reserve[k] = 1e-3;
    return !arena->out_of_memory;
}

void cz_surface_free(CzSurface *surface) {
    cz_arena_free(&surface->arena);
}

/* Evaluates n_point designs of surface->x. */
static bool evaluate(CzSurface *surface, const char *phase, int n_point) {
    return cz_search_evaluate(surface->search, phase, n_point, surface->x, surface->many_f,
                              surface->many_c, surface->many_d);
}

/* Value of a plane at scaled u. */
static double plane_at(const CzSurface *surface, double base, const double *slope,
                       const double *u) {
    for (int i = 0; i < surface->n; i++)
        base += slope[i] * (u[i] - surface->u[i]);
    return base;
}

static double detail_at(const CzSurface *surface, int k, const double *u) {
    return plane_at(surface, surface->c[k], surface->dc + k * surface->n, u);
}

/* Objective of point `point` of the last evaluation: where the smallest margin is maximised, that
 * of the details that are margins, because an energy that must be zero has a margin of -100 % at
 * once. */
static double objective_of(const CzSurface *surface, int point) {
    const double *c = surface->many_d + point * surface->m;
    double largest = -INFINITY;
    if (!surface->search->function->is_minimax)
        return surface->many_f[point];
    for (int k = 0; k < surface->m; k++)
        largest = cz_surface_counted(largest, surface, k, c[k]);
    return isfinite(largest) ? largest : surface->many_f[point];
}

/* Largest value of a detail that is not known: its scenario did not limit a design yet (ours). */
static const double largest_unknown = -0.05;

static void set_base(CzSurface *surface, long record, int point, const double *u) {
    const double *c = surface->many_d + point * surface->m;
    for (int k = 0; k < surface->m; k++) {
        surface->is_known[k] = !isnan(c[k]);
        surface->c[k] =
            surface->is_known[k] ? c[k] : fmin(detail_at(surface, k, u), largest_unknown);
    }
    surface->record = record;
    memcpy(surface->u, u, (size_t)surface->n * sizeof *u);
    surface->f = objective_of(surface, point);
}

/* Replaces the slopes of a detail by its secants (a column of many_d), unless they are not known,
 * or it is violated and no variable changes it, as when a stroke is exhausted: the slopes from the
 * designs before lead back. */
static void renew_slopes(CzSurface *surface, int k) {
    const double flat = 1e-2; /* of a margin over the range of a variable */
    double largest = 0;
    for (int i = 0; i < surface->n; i++)
        if (!surface->is_known[k] || isnan(surface->many_d[i * surface->m + k]))
            return;
    for (int i = 0; i < surface->n; i++)
        largest = fmax(largest, fabs(surface->many_d[i * surface->m + k]));
    if (surface->c[k] > 0 && largest < flat)
        return;
    for (int i = 0; i < surface->n; i++)
        surface->dc[k * surface->n + i] = surface->many_d[i * surface->m + k];
}

/* Computes new secants around the base. False when the search ended. */
static bool refresh(CzSurface *surface, const char *phase, double secant) {
    const int n = surface->n, m = surface->m;
    int n_free = 0;
    for (int i = 0; i < n; i++) {
        const double kept = surface->u[i];
        if (surface->is_frozen[i])
            continue;
        surface->u[i] += cz_search_secant(kept, secant);
        cz_search_unscale(surface->search, 1, surface->u, surface->x + n_free++ * n);
        surface->u[i] = kept;
    }
    if (!evaluate(surface, phase, n_free))
        return false;
    for (int i = n - 1, point = n_free; i >= 0; i--) { /* no column is overwritten before its use */
        const double h = cz_search_secant(surface->u[i], secant);
        const bool is_frozen = surface->is_frozen[i];
        point -= !is_frozen;
        surface->df[i] = is_frozen ? 0 : (surface->many_f[point] - surface->f) / h;
        for (int k = 0; k < m; k++)
            surface->many_d[i * m + k] =
                is_frozen ? 0 : (surface->many_d[point * m + k] - surface->c[k]) / h;
    }
    for (int k = 0; k < m; k++)
        renew_slopes(surface, k);
    surface->is_fresh = true;
    return true;
}

bool cz_surface_begin(CzSurface *surface, const char *phase, const double *u, double secant) {
    cz_search_unscale(surface->search, 1, u, surface->x);
    if (!evaluate(surface, phase, 1))
        return false;
    set_base(surface, surface->search->n_record - 1, 0, u);
    return refresh(surface, phase, secant);
}

/* Broyden's update: the smallest change of the slopes with which the plane contains a new point. */
static void correct(double *slope, int n, const double *step, double square, double change) {
    double predicted = 0;
    for (int i = 0; i < n; i++)
        predicted += slope[i] * step[i];
    for (int i = 0; i < n; i++)
        slope[i] += (change - predicted) * step[i] / square;
}

/* Over shorter steps the scatter of a chaotic response would falsify the slopes. */
static const double shortest_step = 0.01;

static void correct_all(CzSurface *surface, int point, const double *u, double *step) {
    double square = 0, largest = 0;
    for (int i = 0; i < surface->n; i++) {
        step[i] = u[i] - surface->u[i];
        square += step[i] * step[i];
        largest = fmax(largest, fabs(step[i]));
    }
    if (surface->record < 0 || largest < shortest_step ||
        isnan(surface->search->record[surface->record].objective))
        return;
    correct(surface->df, surface->n, step, square, surface->many_f[point] - surface->f);
    for (int k = 0; k < surface->m; k++) {
        const double c = surface->many_d[point * surface->m + k];
        if (!surface->is_known[k] && !isnan(c))
            surface->c[k] += c - detail_at(surface, k, u);
        else if (!isnan(c))
            correct(surface->dc + k * surface->n, surface->n, step, square, c - surface->c[k]);
    }
    surface->is_fresh = false;
}

bool cz_surface_try_exact(CzSurface *surface, const char *phase, int n_point, int *moved_to) {
    CzSearch *search = surface->search;
    const int n = surface->n;
    *moved_to = -1;
    double *u = cz_search_numbers(search, 2 * (size_t)n), *step = u + n;
    if (u == NULL || !evaluate(surface, phase, n_point)) {
        free(u);
        return false;
    }
    const long first = search->n_record - n_point;
    long best = surface->record;
    for (int point = 0; point < n_point; point++) {
        cz_search_scale(search, surface->x + point * n, u);
        if (!isnan(search->record[first + point].objective))
            correct_all(surface, point, u, step);
        if (cz_search_is_better(search, first + point, best)) {
            best = first + point;
            *moved_to = point;
        }
    }
    if (*moved_to >= 0) {
        cz_search_scale(search, surface->x + *moved_to * n, u);
        set_base(surface, best, *moved_to, u);
    }
    free(u);
    return true;
}

bool cz_surface_try(CzSurface *surface, const char *phase, int n_point, const double *u,
                    int *moved_to) {
    cz_search_unscale(surface->search, n_point, u, surface->x);
    return cz_surface_try_exact(surface, phase, n_point, moved_to);
}

double cz_surface_predict(const CzSurface *surface, const double *u, double *penalty) {
    double largest = -INFINITY;
    *penalty = 0;
    for (int k = 0; k < surface->m; k++) {
        const double c = detail_at(surface, k, u);
        largest = cz_surface_counted(largest, surface, k, c);
        *penalty += cz_search_compressed(fmax(c, 0));
    }
    return surface->search->function->is_minimax ? largest
                                                 : plane_at(surface, surface->f, surface->df, u);
}

bool cz_surface_probe(CzSurface *surface, const char *phase) {
    return evaluate(surface, phase, 1);
}

double cz_surface_merit_at(const CzSurface *surface, const double *u, const double *reserve) {
    double largest = -INFINITY, penalty = 0;
    for (int k = 0; k < surface->m; k++) {
        const double c = detail_at(surface, k, u);
        largest = cz_surface_counted(largest, surface, k, c);
        penalty += cz_search_compressed(fmax(c + (reserve != NULL ? reserve[k] : 0), 0));
    }
    const double objective = surface->search->function->is_minimax
                                 ? largest
                                 : plane_at(surface, surface->f, surface->df, u) / surface->scale;
    return objective + surface->weight * penalty;
}

/* ---- moving ---------------------------------------------------------------------------------- */

double cz_surface_penalty(const CzSurface *surface, long number) {
    const CzRecord *record = &surface->search->record[number];
    const double *c = cz_search_detail(surface->search, number);
    if (isnan(record->objective))
        return INFINITY;
    double penalty = record->violation > 0 && record->missed <= 0 ? record->violation : 0;
    for (int k = 0; k < surface->m; k++)
        penalty += cz_search_compressed(fmax(c[k], 0));
    return penalty;
}

/* What a descent lowers: the objective and the price of violations. A design that violates a
 * constraint by little is a good base, because the planes then lead to one that does not. */
static double merit(const CzSurface *surface, double objective, double penalty) {
    return objective / surface->scale + surface->weight * penalty;
}

/* A step of a descent. */
typedef struct Step {
    double radius; /* of its box */
    double length; /* largest change of a variable, scaled */
    double wanted; /* change of the merit that the planes predict */
    double gain;   /* change of the merit; minus infinity for a design that failed */
} Step;

enum { MAX_STEPS = 8 }; /* at once, from the width of 64 designs on (ours) */

/* Evaluates scaled designs of n steps (n x n_variable), and moves the base to that with the largest
 * gain. Returns the index of this step, or of the shortest one where none is a gain; -1 when the
 * search ended. */
static int try_steps(CzSurface *surface, const char *phase, int n_step, Step *step,
                     const double *u) {
    CzSearch *search = surface->search;
    const int n = surface->n;
    double penalty[MAX_STEPS];
    double *change = cz_search_numbers(search, (size_t)n);
    if (change == NULL)
        return -1;
    cz_search_unscale(search, n_step, u, surface->x);
    if (!evaluate(surface, phase, n_step)) {
        free(change);
        return -1;
    }
    const long first = search->n_record - n_step;
    const double before = merit(surface, surface->f, surface->penalty);
    int best = 0, shortest = 0;
    for (int i = 0; i < n_step; i++) {
        penalty[i] = cz_surface_penalty(surface, first + i);
        step[i].gain =
            before - (isfinite(penalty[i]) ? merit(surface, objective_of(surface, i), penalty[i])
                                           : INFINITY);
        if (isfinite(penalty[i]))
            correct_all(surface, i, u + i * n, change);
        best = step[i].gain > step[best].gain ? i : best;
        shortest = step[i].length < step[shortest].length ? i : shortest;
    }
    free(change);
    if (!(step[best].gain > 0))
        return shortest;
    surface->n_outside = penalty[best] > 0.5 * surface->penalty ? surface->n_outside + 1 : 0;
    set_base(surface, first + best, best, u + best * n);
    surface->penalty = penalty[best];
    return best;
}

static const double largest_radius = 0.5;
static const double least_gain = 1e-5; /* on the planes, of the merit, for a step */

static bool is_worth(const Step *step, double smallest_radius) {
    return step->wanted > least_gain && step->length > smallest_radius / 4;
}

static const double first_weight = 1;

/* Secant steps of a descent, as shares of the range of a variable (ours). With catalogue increments
 * the designs that count lie farther apart. */
static const double usual_secant = 0.02, secant_of_steps = 0.05;

/* Boxes do not become smaller: a share of an increment is of no use. */
static double smallest_box(const CzSearch *search) {
    const CzFunction *function = search->function;
    double least = 0.5;
    for (int i = 0; i < function->n_variable; i++)
        least = fmin(least, function->step[i] / (function->max[i] - function->min[i]));
    return fmax(2e-3, least / 2);
}

/* Sets the frozen variables of a scaled design, and of surface->x. */
static void set_frozen(CzSurface *surface, double *u) {
    const CzFunction *function = surface->search->function;
    for (int i = 0; i < surface->n; i++)
        if (surface->is_frozen[i] && u[i] != surface->frozen_at[i]) {
            u[i] = surface->frozen_at[i];
            surface->x[i] = function->min[i] + u[i] * (function->max[i] - function->min[i]);
        }
}

/* Sets the base, with new secants, and what is lowered. False when the search ended or the design
 * failed. */
static bool begin_descent(CzSurface *surface, const char *phase, const double *x, double secant) {
    CzSearch *search = surface->search;
    double *u = cz_search_numbers(search, (size_t)surface->n);
    if (u == NULL)
        return false;
    memcpy(surface->x, x, (size_t)surface->n * sizeof *x); /* `x` may move with the history */
    cz_search_scale(search, surface->x, u);
    set_frozen(surface, u);
    if (!evaluate(surface, search->n_record == 0 ? "start" : phase, 1)) {
        free(u);
        return false;
    }
    set_base(surface, surface->search->n_record - 1, 0, u);
    const double size = fabs(surface->f);
    surface->scale = surface->search->function->is_minimax || !(size > 1e-9) ? 1 : size;
    surface->weight = first_weight;
    surface->penalty = cz_surface_penalty(surface, search->n_record - 1);
    surface->n_outside = 0;
    free(u);
    return isfinite(surface->penalty) && refresh(surface, phase, secant);
}

/* Lists steps to the best designs on the planes in boxes of this radius and, in a wide search, of
 * others; those that are worth an evaluation, but always the first one. Returns their number, 0
 * when there is none. */
static int list_steps(const CzSurface *surface, double radius, double smallest, long left,
                      Step *step, double *u) {
    static const double factor[MAX_STEPS] = {1, 0.5, 2, 0.25, 0.125, 4, 0.0625, 0.03125};
    const int n = surface->n, asked = surface->search->width / CZ_USUAL_WIDTH;
    const int most = asked < MAX_STEPS ? asked : MAX_STEPS;
    const double here = cz_surface_merit_at(surface, surface->u, NULL);
    int n_step = 0;
    for (int i = 0; i < most && n_step < left; i++) {
        double *next = u + n_step * n;
        Step *listed = &step[n_step];
        listed->radius = factor[i] * radius;
        if (i > 0 && (listed->radius < smallest || listed->radius > largest_radius))
            continue;
        if (!cz_surface_best(surface, listed->radius, next)) {
            if (i == 0)
                return 0;
            continue;
        }
        listed->length = cz_largest_difference(next, surface->u, n);
        listed->wanted = here - cz_surface_merit_at(surface, next, NULL);
        bool is_new = i == 0 || is_worth(listed, smallest);
        for (int k = 0; k < n_step && is_new; k++)
            is_new = memcmp(next, u + k * n, (size_t)n * sizeof *u) != 0;
        n_step += is_new;
    }
    return n_step;
}

void cz_surface_descend(CzSurface *surface, const char *phase, const double *x, long evaluations,
                        bool with_refresh) {
    CzSearch *search = surface->search;
    const int n = surface->n;
    const long limit = search->n_record + evaluations;
    double radius = 0.2;
    const double smallest_radius = smallest_box(search);
    const double least_progress = !cz_search_has_steps(search)   ? 1e-3
                                  : search->function->is_minimax ? 5e-3
                                                                 : 2e-2;
    const double secant = cz_search_has_steps(search) ? secant_of_steps : usual_secant;
    Step listed[MAX_STEPS];
    double *next = cz_search_numbers(search, MAX_STEPS * (size_t)n);
    if (next == NULL || evaluations < n + 2 || !begin_descent(surface, phase, x, secant)) {
        free(next);
        return;
    }
    int n_failed = 0, n_step;
    double at_refresh = merit(surface, surface->f, surface->penalty);
    while ((n_step = list_steps(surface, radius, smallest_radius, limit - search->n_record, listed,
                                next)) > 0) {
        const bool goes_on = is_worth(&listed[0], smallest_radius);
        int tried = 0;
        double ratio = -1;
        if (goes_on) {
            tried = try_steps(surface, phase, n_step, listed, next);
            if (tried < 0)
                break;
            ratio = listed[tried].gain / fmax(listed[tried].wanted, 1e-9);
        }
        const double step = listed[tried].length;
        radius = listed[tried].radius;
        if (surface->n_outside >= 3 && surface->weight < 1e4) {
            surface->weight *= 5;
            surface->n_outside = 0;
            at_refresh = INFINITY;
        }
        const bool may_grow = n_failed == 0;
        n_failed = ratio > 0.1 ? 0 : n_failed + 1;
        if (ratio > 0.7 && step > 0.9 * radius && may_grow)
            radius = fmin(2 * radius, largest_radius);
        else if (ratio < 0.25)
            radius = fmin(radius, fmax(step, smallest_radius)) * (ratio < 0 ? 0.35 : 0.5);
        if (goes_on && n_failed < 4 && radius > smallest_radius)
            continue;
        const bool is_enough =
            !with_refresh && (surface->penalty <= 0 || search->function->is_minimax);
        if (is_enough || surface->is_fresh || search->n_record + n > limit ||
            !(merit(surface, surface->f, surface->penalty) < at_refresh - least_progress))
            break;
        at_refresh = merit(surface, surface->f, surface->penalty);
        if (!refresh(surface, phase, fmax(fmin(secant, radius), smallest_radius)))
            break;
        radius = fmax(radius, 0.05);
        n_failed = 0;
    }
    free(next);
}
