/* Linear response surfaces: planes around a base design, and their correction. */
#include "optimise/surface.h"
#include "optimise/nlopt_adapter.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool cz_surface_create(CzSurface *surface, CzSearch *search, int most) {
    const int n = search->function->n_variable, m = cz_search_n_detail(search);
    const size_t batch = (size_t)(most > n + 1 ? most : n + 1);
    *surface = (CzSurface){.search = search, .n = n, .m = m, .record = -1, .most = (int)batch};
    CzArena *arena = &surface->arena;
    surface->u = cz_arena_numbers(arena, (size_t)n);
    surface->c = cz_arena_numbers(arena, (size_t)m);
    surface->df = cz_arena_numbers(arena, (size_t)n);
    surface->dc = cz_arena_numbers(arena, (size_t)(m * n));
    surface->x = cz_arena_numbers(arena, batch * (size_t)n);
    surface->many_f = cz_arena_numbers(arena, batch);
    surface->many_c = cz_arena_numbers(arena, batch * (size_t)search->function->n_constraint);
    surface->many_d = cz_arena_numbers(arena, batch * (size_t)m);
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

static void set_base(CzSurface *surface, long record, int point, const double *u) {
    surface->record = record;
    memcpy(surface->u, u, (size_t)surface->n * sizeof *u);
    surface->f = surface->many_f[point];
    memcpy(surface->c, surface->many_d + point * surface->m, (size_t)surface->m * sizeof(double));
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
            surface->dc[k * n + i] = (surface->many_d[i * m + k] - surface->c[k]) / h;
    }
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
        largest = fmax(largest, c);
        *penalty += cz_search_compressed(fmax(c, 0));
    }
    return surface->search->function->is_minimax ? largest
                                                 : plane_at(surface, surface->f, surface->df, u);
}

/* ---- the best design on the planes ----------------------------------------------------------- */

/* The planes as a function for NLopt, which needs no simulation. */
typedef struct Planes {
    const CzSurface *surface;
    const int *detail; /* those that can matter within the box (n_constraint) */
    int n_constraint;
} Planes;

static CzStatus evaluate_planes(void *data, int n_point, const double *u, double *objective,
                                double *constraint, double *detail, CzError *error) {
    const Planes *planes = data;
    const CzSurface *surface = planes->surface;
    (void)detail;
    (void)error;
    for (int point = 0; point < n_point; point++) {
        const double *at = u + point * surface->n;
        double *c = constraint + point * planes->n_constraint;
        double largest = -1;
        for (int j = 0; j < planes->n_constraint; j++) {
            c[j] = detail_at(surface, planes->detail[j], at);
            largest = fmax(largest, c[j]);
        }
        objective[point] = surface->search->function->is_minimax
                               ? largest
                               : plane_at(surface, surface->f, surface->df, at);
    }
    return CZ_OK;
}

/* Lists the details that can be the largest or violated within the box around the base. */
static int choose_details(const CzSurface *surface, double radius, int *chosen) {
    const int n = surface->n;
    double floor = 0;
    for (int pass = 0; pass < 2; pass++) {
        int n_chosen = 0;
        for (int k = 0; k < surface->m; k++) {
            double reach = 0;
            for (int i = 0; i < n; i++)
                reach += fabs(surface->dc[k * n + i]) * radius;
            if (pass == 0 && surface->search->function->is_minimax)
                floor = k == 0 ? surface->c[k] - reach : fmax(floor, surface->c[k] - reach);
            else if (pass == 1 && surface->c[k] + reach >= fmin(floor, 0) - 1e-3)
                chosen[n_chosen++] = k;
        }
        if (pass == 1)
            return n_chosen;
    }
    return 0;
}

/* Searches the planes in the box lo..hi with NLopt; the best design is written to u. */
static bool search_planes(const CzSurface *surface, const Planes *planes, const double *lo,
                          const double *hi, const double *no_step, double *u) {
    const CzFunction function = {.n_variable = surface->n,
                                 .n_constraint = planes->n_constraint,
                                 .min = lo,
                                 .max = hi,
                                 .start = surface->u,
                                 .step = no_step,
                                 .is_minimax = surface->search->function->is_minimax,
                                 .evaluate = evaluate_planes,
                                 .data = (void *)planes};
    const CzOptimiseOptions options = {.evaluations = 400L * (surface->n + 1)};
    CzSearch inner;
    cz_search_init(&inner, &function, &options);
    CzNloptRun run = cz_nlopt_run_default("LD_SLSQP");
    run.form = CZ_FORM_ELASTIC;
    run.reserve = 1e-3;
    double *start = cz_search_numbers(surface->search, (size_t)surface->n);
    bool found = start != NULL;
    if (found) {
        cz_search_scale(&inner, surface->u, start);
        found = cz_nlopt_run(&inner, &run, start, NULL) == CZ_OK && inner.best >= 0;
    }
    if (found)
        memcpy(u, cz_search_x(&inner, inner.best), (size_t)surface->n * sizeof *u);
    cz_search_free(&inner);
    free(start);
    return found;
}

bool cz_surface_best(const CzSurface *surface, double radius, double *u) {
    const size_t n = (size_t)surface->n;
    double *box = cz_search_numbers(surface->search, 3 * n);
    int *detail = calloc((size_t)surface->m + 1, sizeof *detail);
    bool found = box != NULL && detail != NULL;
    if (found) {
        for (size_t i = 0; i < n; i++) {
            box[i] = fmax(surface->u[i] - radius, 0);
            box[n + i] = fmin(surface->u[i] + radius, 1);
        }
        const Planes planes = {.surface = surface,
                               .detail = detail,
                               .n_constraint = choose_details(surface, radius, detail)};
        found = search_planes(surface, &planes, box, box + n, box + 2 * n, u);
    }
    free(box);
    free(detail);
    return found;
}

/* ---- moving ---------------------------------------------------------------------------------- */

enum {
    RADII = 3,   /* boxes tried side by side: the radius, a third, a ninth */
    PATIENCE = 2 /* evaluations without an improvement, in multiples of those of a gradient */
};

void cz_surface_descend(CzSurface *surface, const char *phase, const double *u, long evaluations) {
    CzSearch *search = surface->search;
    const int n = surface->n;
    const long limit = search->n_record + evaluations;
    const double smallest = 5e-3;
    double radius = 0.15, secant = 0.02;
    double *tried = cz_search_numbers(search, (size_t)(RADII * n));
    if (tried == NULL || evaluations < n + 1 + RADII ||
        !cz_surface_begin(surface, phase, u, secant)) {
        free(tried);
        return;
    }
    while (radius > smallest && search->n_record + RADII <= limit &&
           search->n_record - search->last_gain <= PATIENCE * (n + 1)) {
        int n_tried = 0, moved_to;
        for (int i = 0; i < RADII; i++)
            n_tried += cz_surface_best(surface, radius * pow(3, -i), tried + n_tried * n);
        if (n_tried == 0 || !cz_surface_try(surface, phase, n_tried, tried, &moved_to))
            break;
        if (moved_to == 0)
            radius = fmin(1.5 * radius, 0.4);
        else if (moved_to > 0)
            radius *= moved_to == 1 ? 0.6 : 0.2;
        else if (surface->is_fresh || search->n_record + n > limit)
            radius *= 0.1;
        else if (refresh(surface, phase, fmin(secant, radius)))
            radius = fmax(0.3 * radius, 0.02);
        else
            break;
    }
    free(tried);
}
