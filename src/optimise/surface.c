/* Linear response surfaces: planes around a base design, and their correction. */
#include "optimise/surface.h"
#include "optimise/linear_program.h"

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
    surface->df = cz_arena_numbers(arena, (size_t)n);
    surface->dc = cz_arena_numbers(arena, (size_t)(m * n));
    surface->x = cz_arena_numbers(arena, batch * (size_t)n);
    surface->usual_reserve = cz_arena_numbers(arena, (size_t)m);
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

/* The largest detail so far, with detail k of this value where it counts. */
static double counted_in(double largest, const CzSurface *surface, int k, double c) {
    return cz_detail_is_activation(surface->search->function, k) ? largest : fmax(largest, c);
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
        largest = counted_in(largest, surface, k, c[k]);
    return isfinite(largest) ? largest : surface->many_f[point];
}

static void set_base(CzSurface *surface, long record, int point, const double *u) {
    surface->record = record;
    memcpy(surface->u, u, (size_t)surface->n * sizeof *u);
    surface->f = objective_of(surface, point);
    memcpy(surface->c, surface->many_d + point * surface->m, (size_t)surface->m * sizeof(double));
}

/* Replaces the slopes of a detail by its secants (a column of many_d), unless it is violated and no
 * variable changes it, as when a stroke is exhausted: the slopes from the designs before lead back.
 */
static void renew_slopes(CzSurface *surface, int k) {
    const double flat = 1e-2; /* of a margin over the range of a variable */
    double largest = 0;
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
    for (int i = 0; i < n; i++) {
        const double kept = surface->u[i];
        surface->u[i] += cz_search_secant(kept, secant);
        cz_search_unscale(surface->search, 1, surface->u, surface->x + i * n);
        surface->u[i] = kept;
    }
    if (!evaluate(surface, phase, n))
        return false;
    for (int i = 0; i < n; i++) {
        const double h = cz_search_secant(surface->u[i], secant);
        surface->df[i] = (surface->many_f[i] - surface->f) / h;
        for (int k = 0; k < m; k++)
            surface->many_d[i * m + k] = (surface->many_d[i * m + k] - surface->c[k]) / h;
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
    for (int k = 0; k < surface->m; k++)
        correct(surface->dc + k * surface->n, surface->n, step, square,
                surface->many_d[point * surface->m + k] - surface->c[k]);
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

double cz_surface_predict(const CzSurface *surface, const double *u, double *penalty) {
    double largest = -INFINITY;
    *penalty = 0;
    for (int k = 0; k < surface->m; k++) {
        const double c = detail_at(surface, k, u);
        largest = counted_in(largest, surface, k, c);
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
        largest = counted_in(largest, surface, k, c);
        penalty += cz_search_compressed(fmax(c + (reserve != NULL ? reserve[k] : 0), 0));
    }
    const double objective = surface->search->function->is_minimax
                                 ? largest
                                 : plane_at(surface, surface->f, surface->df, u) / surface->scale;
    return objective + surface->weight * penalty;
}

/* ---- the best design on the planes ----------------------------------------------------------- */

/* Whether a detail can be violated, or, where the largest one counts, be the largest, within the
 * box. */
static bool can_matter(const CzSurface *surface, int k, const double *lo, const double *hi,
                       double floor) {
    double largest = surface->c[k];
    for (int i = 0; i < surface->n; i++) {
        const double slope = surface->dc[k * surface->n + i];
        largest += fmax(slope * (lo[i] - surface->u[i]), slope * (hi[i] - surface->u[i]));
    }
    return largest >= floor;
}

/* No design in the box has its largest detail below this. */
static double least_largest(const CzSurface *surface, const double *lo, const double *hi) {
    double floor = -INFINITY;
    for (int k = 0; k < surface->m; k++) {
        double least = surface->c[k];
        for (int i = 0; i < surface->n; i++) {
            const double slope = surface->dc[k * surface->n + i];
            least += fmin(slope * (lo[i] - surface->u[i]), slope * (hi[i] - surface->u[i]));
        }
        floor = counted_in(floor, surface, k, least);
    }
    return floor;
}

/* A linear program under construction: the variables are the change of the design, and the largest
 * detail where that is minimised. */
typedef struct Draft {
    CzArena arena;
    CzLinearProgram program;
    double *g, *c, *a, *w, *lo, *hi, *d;
} Draft;

static bool begin_draft(Draft *draft, int n, int most) {
    CzArena *arena = &draft->arena;
    draft->g = cz_arena_numbers(arena, (size_t)n);
    draft->lo = cz_arena_numbers(arena, (size_t)n);
    draft->hi = cz_arena_numbers(arena, (size_t)n);
    draft->d = cz_arena_numbers(arena, (size_t)n);
    draft->c = cz_arena_numbers(arena, (size_t)most);
    draft->w = cz_arena_numbers(arena, (size_t)most);
    draft->a = cz_arena_numbers(arena, (size_t)(most * n));
    draft->program = (CzLinearProgram){.n = n,
                                       .g = draft->g,
                                       .c = draft->c,
                                       .a = draft->a,
                                       .w = draft->w,
                                       .lo = draft->lo,
                                       .hi = draft->hi};
    return !arena->out_of_memory;
}

/* Adds detail k, less the largest detail where `below` is 1. */
static void add_row(Draft *draft, const CzSurface *surface, int k, double price, double reserve,
                    double below) {
    const int n = draft->program.n, row = draft->program.m++;
    memcpy(draft->a + row * n, surface->dc + k * surface->n, (size_t)surface->n * sizeof *draft->a);
    if (n > surface->n)
        draft->a[row * n + surface->n] = -below;
    draft->c[row] = surface->c[k] + reserve;
    draft->w[row] = price;
}

/* Price of a violation: with it the sum over the details changes as the penalty of a search. */
static double price_of(const CzSurface *surface, double c) {
    return surface->weight * cz_search_compressed_slope(c);
}

static void fill_draft(Draft *draft, const CzSurface *surface, const double *lo, const double *hi,
                       const double *reserve) {
    const bool is_minimax = surface->search->function->is_minimax;
    const double floor = is_minimax ? fmin(least_largest(surface, lo, hi), 0) : 0;
    double largest = -INFINITY;
    for (int k = 0; k < surface->m; k++)
        largest = counted_in(largest, surface, k, surface->c[k]);
    for (int i = 0; i < surface->n; i++) {
        draft->g[i] = is_minimax ? 0 : surface->df[i] / surface->scale;
        draft->lo[i] = lo[i] - surface->u[i];
        draft->hi[i] = hi[i] - surface->u[i];
        draft->d[i] = fmin(fmax(0, draft->lo[i]), draft->hi[i]);
    }
    if (is_minimax) {
        const int n = surface->n;
        draft->g[n] = 1;
        draft->lo[n] = -2;
        draft->hi[n] = draft->d[n] = fmax(largest, 0) + 1;
    }
    for (int k = 0; k < surface->m; k++) {
        const bool is_margin = is_minimax && !cz_detail_is_activation(surface->search->function, k);
        if (!can_matter(surface, k, lo, hi, (is_margin ? floor : 0) - 1e-3))
            continue;
        if (is_margin)
            add_row(draft, surface, k, 1e3, 0, 1);
        if (!is_margin || largest > 0)
            add_row(draft, surface, k, price_of(surface, surface->c[k]), reserve[k], 0);
    }
}

bool cz_surface_best_in(const CzSurface *surface, const double *lo, const double *hi,
                        const double *reserve, double *u) {
    const bool is_minimax = surface->search->function->is_minimax;
    Draft draft = {.arena = {0}};
    bool found = begin_draft(&draft, surface->n + is_minimax, surface->m * (1 + is_minimax));
    if (found) {
        fill_draft(&draft, surface, lo, hi, reserve);
        found = cz_linear_program(&draft.program, draft.d);
    }
    if (!found)
        cz_search_end_without_memory(surface->search);
    for (int i = 0; i < surface->n && found; i++)
        u[i] = fmin(fmax(surface->u[i] + draft.d[i], 0), 1);
    cz_arena_free(&draft.arena);
    return found;
}

bool cz_surface_best(const CzSurface *surface, double radius, double *u) {
    const size_t n = (size_t)surface->n;
    double *box = cz_search_numbers(surface->search, 2 * n);
    bool found = box != NULL;
    for (size_t i = 0; i < n && found; i++) {
        box[i] = fmax(surface->u[i] - radius, 0);
        box[n + i] = fmin(surface->u[i] + radius, 1);
    }
    found = found && cz_surface_best_in(surface, box, box + n, surface->usual_reserve, u);
    free(box);
    return found;
}

/* ---- moving ---------------------------------------------------------------------------------- */

/* Sum of the compressed violations of point `point` of the last evaluation, as the planes have
 * them; infinite when it failed. */
static double penalty_of(const CzSurface *surface, int point) {
    const CzSearch *search = surface->search;
    const CzRecord *record = &search->record[search->n_record - 1];
    const double *c = surface->many_d + point * surface->m;
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

static double farthest_step(const CzSurface *surface, const double *u) {
    double largest = 0;
    for (int i = 0; i < surface->n; i++)
        largest = fmax(largest, fabs(u[i] - surface->u[i]));
    return largest;
}

/* Evaluates one scaled design and moves the base to it when its merit is less; returns the change
 * of the merit over the predicted one, NaN when the search ended. */
static double try_step(CzSurface *surface, const char *phase, const double *u) {
    CzSearch *search = surface->search;
    const double wanted =
        cz_surface_merit_at(surface, surface->u, NULL) - cz_surface_merit_at(surface, u, NULL);
    double *step = cz_search_numbers(search, (size_t)surface->n);
    if (step == NULL)
        return NAN;
    cz_search_unscale(search, 1, u, surface->x);
    if (!evaluate(surface, phase, 1)) {
        free(step);
        return NAN;
    }
    const double penalty = penalty_of(surface, 0);
    const double gain =
        merit(surface, surface->f, surface->penalty) -
        (isfinite(penalty) ? merit(surface, objective_of(surface, 0), penalty) : INFINITY);
    if (isfinite(penalty))
        correct_all(surface, 0, u, step);
    if (gain > 0) {
        surface->n_outside = penalty > 0.5 * surface->penalty ? surface->n_outside + 1 : 0;
        set_base(surface, search->n_record - 1, 0, u);
        surface->penalty = penalty;
    }
    free(step);
    return gain / fmax(wanted, 1e-9);
}

static const double largest_radius = 0.5;
static const double least_gain = 1e-5; /* on the planes, of the merit, for a step */

static const double first_weight = 1;

/* Boxes do not become smaller: a share of an increment is of no use. */
static double smallest_box(const CzSearch *search) {
    const CzFunction *function = search->function;
    double least = 0.5;
    for (int i = 0; i < function->n_variable; i++)
        least = fmin(least, function->step[i] / (function->max[i] - function->min[i]));
    return fmax(2e-3, least / 2);
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
    if (!evaluate(surface, search->n_record == 0 ? "start" : phase, 1)) {
        free(u);
        return false;
    }
    set_base(surface, surface->search->n_record - 1, 0, u);
    const double size = fabs(surface->f);
    surface->scale = surface->search->function->is_minimax || !(size > 1e-9) ? 1 : size;
    surface->weight = first_weight;
    surface->penalty = penalty_of(surface, 0);
    surface->n_outside = 0;
    free(u);
    return isfinite(surface->penalty) && refresh(surface, phase, secant);
}

void cz_surface_descend(CzSurface *surface, const char *phase, const double *x, long evaluations) {
    CzSearch *search = surface->search;
    const int n = surface->n;
    const long limit = search->n_record + evaluations;
    double radius = 0.2;
    const double smallest_radius = smallest_box(search);
    const double least_progress = !cz_search_has_steps(search)   ? 1e-3
                                  : search->function->is_minimax ? 5e-3
                                                                 : 2e-2;
    const double secant = 0.02;
    double *next = cz_search_numbers(search, (size_t)n);
    if (next == NULL || evaluations < n + 2 || !begin_descent(surface, phase, x, secant)) {
        free(next);
        return;
    }
    int n_failed = 0;
    double at_refresh = merit(surface, surface->f, surface->penalty);
    while (search->n_record < limit && cz_surface_best(surface, radius, next)) {
        const double step = farthest_step(surface, next);
        const double wanted = cz_surface_merit_at(surface, surface->u, NULL) -
                              cz_surface_merit_at(surface, next, NULL);
        const bool is_worth = wanted > least_gain && step > smallest_radius / 4;
        double ratio = -1;
        if (is_worth) {
            ratio = try_step(surface, phase, next);
            if (isnan(ratio))
                break;
        }
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
        if (is_worth && n_failed < 4 && radius > smallest_radius)
            continue;
        if (surface->is_fresh || search->n_record + n > limit ||
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
