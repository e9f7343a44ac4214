/* Moves from the best design to the best one with every variable on its catalogue increment.
 *
 * First it dives: the planes are solved with one variable after the other on an increment. Then the
 * planes rank designs on the increments, and the best of them are simulated: the corners of the
 * cell of increments around the best design, and designs that differ by one increment, or by one in
 * each of two variables, from the best design on the increments.
 */
#include "optimise/strategy.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    BATCH = 6,          /* designs on the increments that are simulated side by side */
    MAX_OPEN = 12,      /* variables whose rounding is tried both ways: 4096 corners */
    MAX_WALK = 40,      /* steps of a path on the planes */
    MAX_IDLE = 2,       /* batches without an improvement before a feasible design is accepted */
    MAX_IDLE_BROKEN = 8 /* likewise for an infeasible one */
};

/* Secant step of the slopes that rank designs on the increments: of the order of the increments. */
static const double secant = 0.05;

/* Largest distance from their base at which the planes are used, in scaled variables, unless within
 * one increment. */
static const double farthest = 0.1;

typedef struct Design {
    double *x; /* natural variables (n_variable) */
    double penalty, objective, distance;
} Design;

/* The most promising designs so far, best first. */
typedef struct Shortlist {
    const CzSurface *surface;
    int n_design;
    Design design[BATCH + 1];
    double *u; /* scratch (n_variable) */
} Shortlist;

static bool is_before(const Design *a, const Design *b) {
    return a->penalty != b->penalty ? a->penalty < b->penalty : a->objective < b->objective;
}

static void swap(Design *a, Design *b) {
    const Design kept = *a;
    *a = *b;
    *b = kept;
}

static bool is_near(const CzSurface *surface, const double *u) {
    const CzFunction *function = surface->search->function;
    for (int i = 0; i < surface->n; i++) {
        const double step = function->step[i] / (function->max[i] - function->min[i]);
        const double most = surface->is_frozen[i] ? 1e-9 : fmax(farthest, 1.01 * step);
        if (fabs(u[i] - surface->u[i]) > most)
            return false;
    }
    return true;
}

static double distance_from_base(const CzSurface *surface, const double *u) {
    double square = 0;
    for (int i = 0; i < surface->n; i++)
        square += (u[i] - surface->u[i]) * (u[i] - surface->u[i]);
    return square;
}

/* The listed design that equals a new one on the planes: a simulation of both would add no
 * information. NULL when there is none. */
static Design *find_equal(Shortlist *list, const Design *new) {
    const double close = 1e-3; /* of a margin; ours */
    for (int i = 0; i < list->n_design; i++)
        if (fabs(new->penalty - list->design[i].penalty) < close &&
            fabs(new->objective - list->design[i].objective) < close)
            return &list->design[i];
    return NULL;
}

/* Adds a design to the list unless it has been simulated, equals a listed one that is nearer to the
 * base, or is not among the best. */
static void offer(Shortlist *list, const double *x) {
    const CzSurface *surface = list->surface;
    const int at = list->n_design;
    Design *new = &list->design[at];
    cz_search_scale(surface->search, x, list->u);
    if (!is_near(surface, list->u) || cz_search_find(surface->search, x) >= 0)
        return;
    new->objective = cz_surface_predict(surface, list->u, &new->penalty);
    new->distance = distance_from_base(surface, list->u);
    Design *equal = find_equal(list, new);
    if (equal == NULL ? at == BATCH && !is_before(new, &list->design[BATCH - 1])
                      : new->distance >= equal->distance)
        return;
    memcpy(new->x, x, (size_t)surface->n * sizeof *x);
    if (equal != NULL) {
        swap(new, equal);
        return;
    }
    for (; new > list->design &&is_before(new, new - 1); new --)
        swap(new, new - 1);
    list->n_design = at < BATCH ? at + 1 : BATCH;
}

/* Moves one variable by whole increments; false when it has none or leaves its bounds. */
static bool move(const CzSearch *search, double *x, int variable, int n_step) {
    const CzFunction *function = search->function;
    const double step = function->step[variable];
    if (!(step > 0))
        return false;
    const double value = (round(x[variable] / step) + n_step) * step;
    if (value < function->min[variable] || value > function->max[variable])
        return false;
    x[variable] = value;
    return true;
}

/* Variables between two increments, those nearest to the middle first. */
static int list_open(const CzSearch *search, const double *x, const double *near, int *open) {
    const int n = search->function->n_variable;
    int n_open = 0;
    for (int i = 0; i < n; i++) {
        const double step = search->function->step[i];
        if (!(step > 0) || near[i] == x[i])
            continue;
        int at = n_open < MAX_OPEN ? n_open++ : MAX_OPEN - 1;
        const double distance = fabs(x[i] - near[i]) / step;
        while (at > 0 && distance > fabs(x[open[at - 1]] - near[open[at - 1]]) /
                                        search->function->step[open[at - 1]]) {
            open[at] = open[at - 1];
            at--;
        }
        open[at] = i;
    }
    return n_open;
}

/* Offers the corners of the cell of increments around a design. */
static void offer_corners(Shortlist *list, const double *x, double *near, double *corner) {
    const CzSearch *search = list->surface->search;
    const size_t size = (size_t)list->surface->n * sizeof *x;
    int open[MAX_OPEN];
    cz_search_round(search, x, near);
    const int n_open = list_open(search, x, near, open);
    for (int code = 0; code < 1 << n_open; code++) {
        bool is_inside = true;
        memcpy(corner, near, size);
        for (int k = 0; k < n_open && is_inside; k++)
            if (code >> k & 1)
                is_inside = move(search, corner, open[k], x[open[k]] > near[open[k]] ? 1 : -1);
        if (is_inside)
            offer(list, corner);
    }
}

/* Offers the designs that differ from a design by one increment in one variable or in each of
 * two. */
static void offer_neighbours(Shortlist *list, const double *x, double *other) {
    const CzSearch *search = list->surface->search;
    const int n = list->surface->n;
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++)
            for (int sign = 0; sign < (i == j ? 2 : 4); sign++) {
                memcpy(other, x, (size_t)n * sizeof *x);
                if (move(search, other, i, sign % 2 == 0 ? 1 : -1) &&
                    (i == j || move(search, other, j, sign / 2 == 0 ? 1 : -1)))
                    offer(list, other);
            }
}

/* Moves on the planes from a design to successively better neighbours and offers all of them. */
static void explore(Shortlist *list, const double *from, double *at, double *other) {
    const size_t size = (size_t)list->surface->n * sizeof *at;
    memcpy(at, from, size);
    for (int step = 0; step < MAX_WALK; step++) {
        offer_neighbours(list, at, other);
        if (list->n_design == 0 || memcmp(list->design[0].x, at, size) == 0)
            return;
        memcpy(at, list->design[0].x, size);
    }
}

/* Simulates the first `left` designs of the list; false when there is none or the search ended. */
static bool simulate(CzSurface *surface, Shortlist *list, long left) {
    const int n_design = list->n_design < left ? list->n_design : (int)left;
    if (n_design <= 0)
        return false;
    for (int i = 0; i < n_design; i++)
        memcpy(surface->x + i * surface->n, list->design[i].x,
               (size_t)surface->n * sizeof *surface->x);
    int moved_to;
    return cz_surface_try_exact(surface, "snap", n_design, &moved_to);
}

long cz_snap_reserve(const CzSearch *search) {
    if (!cz_search_has_steps(search))
        return 0;
    const long wanted = search->function->n_variable + 1 + 6L * BATCH;
    const long share = search->most_evaluations / 3;
    return wanted < share ? wanted : share;
}

/* Simulates batch after batch until none is an improvement. `scratch` is (3 x n_variable). */
static void snap(CzSurface *surface, Shortlist *list, long limit, double *scratch) {
    CzSearch *search = surface->search;
    const int n = surface->n;
    int n_idle = 0;
    memcpy(scratch, cz_search_x(search, search->best), (size_t)n * sizeof *scratch);
    offer_corners(list, scratch, scratch + n, scratch + 2 * n);
    search->is_snapped |= list->n_design == 0; /* all corners are known */
    explore(list, scratch + n, scratch, scratch + 2 * n);
    while (simulate(surface, list, limit - search->n_record)) {
        search->is_snapped = true;
        const long at = search->best_on_grid;
        const bool is_kept = at >= 0 && search->record[at].penalty <= 0;
        n_idle = at >= search->n_record - list->n_design ? 0 : n_idle + 1;
        if (at < 0 || n_idle > (is_kept ? MAX_IDLE : MAX_IDLE_BROKEN))
            return;
        list->n_design = 0;
        explore(list, cz_search_x(search, at), scratch, scratch + n);
    }
}

/* ---- diving ---------------------------------------------------------------------------------- */

/* A design on the increments from the planes: one variable after the other is fixed on one of its
 * two nearest increments, and the planes are solved again for the others. */
typedef struct Dive {
    double *lo, *hi; /* box that is left, scaled (n) */
    double *u, *x;   /* solution, scaled and natural (n) */
    double *other;   /* scratch (n) */
    double *reserve; /* distance of details below 0 (m) */
    double reach;    /* from the base in each variable, or one increment where that is more */
    bool *is_fixed;  /* (n) */
} Dive;

static double rounded(const CzFunction *function, int i, double x, int side) {
    const double step = function->step[i];
    const double value = (side < 0 ? floor(x / step + 1e-9) : ceil(x / step - 1e-9)) * step;
    return value >= function->min[i] && value <= function->max[i] ? value : NAN;
}

static double scaled(const CzFunction *function, int i, double x) {
    return (x - function->min[i]) / (function->max[i] - function->min[i]);
}

/* The free variable that is nearest to an increment, -1 when all are fixed. */
static int nearest_open(const CzFunction *function, const Dive *dive) {
    int nearest = -1;
    double least = INFINITY;
    for (int i = 0; i < function->n_variable; i++) {
        const double step = function->step[i];
        if (dive->is_fixed[i] || !(step > 0))
            continue;
        const double distance = fabs(dive->x[i] / step - round(dive->x[i] / step));
        if (distance < least) {
            least = distance;
            nearest = i;
        }
    }
    return nearest;
}

/* Merit on the planes with variable i fixed at a value; the solution is written to u. Infinite when
 * there is none. */
static double solve_fixed(const CzSurface *surface, Dive *dive, int i, double value, double *u) {
    if (isnan(value))
        return INFINITY;
    const double lo = dive->lo[i], hi = dive->hi[i];
    dive->lo[i] = dive->hi[i] = scaled(surface->search->function, i, value);
    double merit = INFINITY;
    if (cz_surface_best_in(surface, dive->lo, dive->hi, dive->reserve, u))
        merit = cz_surface_merit_at(surface, u, dive->reserve);
    dive->lo[i] = lo;
    dive->hi[i] = hi;
    return merit;
}

/* Dives from the base of the planes; dive->x gets the design. False when it is incomplete. */
static bool dive_once(const CzSurface *surface, Dive *dive) {
    const CzFunction *function = surface->search->function;
    const int n = surface->n;
    for (int i = 0; i < n; i++) {
        const double step = function->step[i] / (function->max[i] - function->min[i]);
        const double reach = surface->is_frozen[i] ? 0 : fmax(dive->reach, 1.01 * step);
        dive->lo[i] = fmax(surface->u[i] - reach, 0);
        dive->hi[i] = fmin(surface->u[i] + reach, 1);
        dive->is_fixed[i] = false;
    }
    if (!cz_surface_best_in(surface, dive->lo, dive->hi, dive->reserve, dive->u))
        return false;
    cz_search_unscale(surface->search, 1, dive->u, dive->x);
    for (int i; (i = nearest_open(function, dive)) >= 0;) {
        double value = rounded(function, i, dive->x[i], -1);
        const double up = rounded(function, i, dive->x[i], 1);
        const double below = solve_fixed(surface, dive, i, value, dive->u);
        const double above = solve_fixed(surface, dive, i, up, dive->other);
        if (!isfinite(below) && !isfinite(above))
            return false;
        if (above < below) {
            memcpy(dive->u, dive->other, (size_t)n * sizeof *dive->u);
            value = up;
        }
        dive->lo[i] = dive->hi[i] = scaled(function, i, value);
        cz_search_unscale(surface->search, 1, dive->u, dive->x);
        dive->is_fixed[i] = true;
        for (int k = 0; k < n; k++) /* exactly on the increment */
            if (dive->is_fixed[k])
                dive->x[k] = round(dive->x[k] / function->step[k]) * function->step[k];
    }
    return true;
}

/* Dives again and again, on planes that each simulated design corrects; when it is the best one, it
 * becomes their base, else the next box is half as large. What a design violates, the next one
 * keeps with a reserve of that size more; where a design passes, the reserves are halved. */
static void dive(CzSurface *surface, long limit) {
    enum { MAX_DIVES = 12, MAX_IDLE_DIVES = 5 };
    CzSearch *search = surface->search;
    const size_t n = (size_t)surface->n, m = (size_t)surface->m;
    CzArena arena = {0};
    Dive dive = {.lo = cz_arena_numbers(&arena, n),
                 .hi = cz_arena_numbers(&arena, n),
                 .u = cz_arena_numbers(&arena, n),
                 .x = cz_arena_numbers(&arena, n),
                 .other = cz_arena_numbers(&arena, n),
                 .reserve = cz_arena_numbers(&arena, m),
                 .reach = farthest,
                 .is_fixed = cz_arena_allocate(&arena, n, sizeof(bool))};
    int n_idle = 0;
    if (arena.out_of_memory)
        cz_search_end_without_memory(search);
    for (int k = 0; k < MAX_DIVES && !arena.out_of_memory && n_idle < MAX_IDLE_DIVES; k++) {
        if (search->n_record >= limit || !dive_once(surface, &dive))
            break;
        const long before = search->best_on_grid;
        long record = cz_search_find(search, dive.x);
        memcpy(surface->x, dive.x, n * sizeof *dive.x);
        if (record < 0) {
            int moved_to;
            if (!cz_surface_try_exact(surface, "snap", 1, &moved_to))
                break;
            record = search->n_record - 1;
        } else { /* its details are not known any more */
            memset(surface->many_d, 0, m * sizeof *surface->many_d);
        }
        search->is_snapped = true;
        n_idle = search->best_on_grid != before ? 0 : n_idle + 1;
        if (n_idle > 0)
            dive.reach /= 2;
        const bool is_kept = search->record[record].penalty <= 0;
        for (size_t j = 0; j < m; j++) {
            const double c = surface->many_d[j];
            if (is_kept)
                dive.reserve[j] /= 2;
            else if (c >= 0)
                dive.reserve[j] += fmin(c + 1e-3, 0.05);
        }
    }
    cz_arena_free(&arena);
}

/* Computes slopes around the best design if the evaluations suffice for them and for a further
 * design, else uses those of the last base; without slopes the nearest designs are tried first. */
static bool begin(CzSurface *surface, const double *u, long evaluations) {
    if (evaluations > surface->n + 1)
        return cz_surface_begin(surface, "snap", u, secant);
    if (surface->record < 0)
        memcpy(surface->u, u, (size_t)surface->n * sizeof *u);
    return true;
}

/* Dives from the best design on the increments, as long as it passes, with new slopes around it
 * each time: while it is an improvement of design `base` (-1: of none), around which the slopes
 * are, and evaluations for more than slopes are left. `u` is scratch (n_variable). */
static void dive_from_best(CzSurface *surface, long base, long limit, double *u) {
    CzSearch *search = surface->search;
    for (long at; (at = search->best_on_grid) >= 0 && search->record[at].penalty <= 0 &&
                  cz_search_is_gain(search, at, base);
         base = at) {
        const long left = limit - search->n_record;
        cz_search_scale(search, cz_search_x(search, at), u);
        if (left <= surface->n + 3 || !begin(surface, u, left))
            return;
        dive(surface, limit);
    }
}

void cz_snap(CzSurface *surface, long evaluations, bool is_last) {
    CzSearch *search = surface->search;
    if (!cz_search_has_steps(search) || search->best < 0)
        return;
    cz_search_resume(search);
    const size_t n = (size_t)surface->n;
    const long limit = search->n_record + evaluations;
    double *memory = calloc((BATCH + 1 + 4) * n, sizeof *memory);
    if (memory == NULL) {
        cz_search_end_without_memory(search);
        return;
    }
    double *u = memory + (BATCH + 1 + 3) * n;
    cz_search_scale(search, cz_search_x(search, search->best), u);
    Shortlist list = {.surface = surface, .u = u};
    for (size_t i = 0; i <= BATCH; i++)
        list.design[i].x = memory + i * n;
    /* the last time the slopes are those of the best design, before that those of a near one */
    const bool is_at_best =
        surface->record >= 0 && (is_last ? surface->record == search->best : is_near(surface, u));
    const long base = is_at_best ? surface->record : search->best;
    if (is_at_best || begin(surface, u, evaluations)) {
        dive(surface, limit);
        dive_from_best(surface, search->record[base].on_grid ? base : -1, limit, u);
        const long few = search->n_record + BATCH;
        snap(surface, &list, is_last || few > limit ? limit : few, memory + (BATCH + 1) * n);
    }
    free(memory);
}
