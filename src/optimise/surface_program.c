/* The best design on response surfaces, by a linear program. */
#include "optimise/linear_program.h"
#include "optimise/surface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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
        floor = cz_surface_counted(floor, surface, k, least);
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
        largest = cz_surface_counted(largest, surface, k, surface->c[k]);
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
        const bool is_margin = is_minimax && cz_surface_counts(surface, k);
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
        const double reach = surface->is_frozen[i] ? 0 : radius;
        box[i] = fmax(surface->u[i] - reach, 0);
        box[n + i] = fmin(surface->u[i] + reach, 1);
    }
    found = found && cz_surface_best_in(surface, box, box + n, surface->usual_reserve, u);
    free(box);
    return found;
}
