/* Timoshenko elements on seats: matrices, a banded solver, steps.
 *
 * Unknowns of a bay stand together: the seat's rail deflection and rotation, sleeper, ballast
 * block, then deflection and rotation of the bay's other nodes. The first and last seat are pinned.
 */
#include "dynamics/track_elements.h"

#include <math.h>
#include <string.h>

#define MARGIN 20.0 /* of rail beyond the outer wheels [m]: waves die out over 14 m (ours) */

/* ---- one element ----
 *
 * Of length l between deflection and rotation of two nodes, with F = 12 E I / (k G A l^2):
 *   k_zz = 12 EI / (l^3 (1 + F))   k_zr = 6 EI / (l^2 (1 + F))
 *   k_rr = (4 + F) EI / (l (1 + F))   k_rr' = (2 - F) EI / (l (1 + F))
 */
typedef struct Stiffness {
    double zz, zr, rr, cross;
} Stiffness;

static Stiffness stiffness_of(const CzSeats *seats, double l) {
    const double f = 12.0 * seats->bending / (seats->shear * l * l);
    const double unit = seats->bending / (l * (1.0 + f));
    return (Stiffness){12.0 * unit / (l * l), 6.0 * unit / l, (4.0 + f) * unit, (2.0 - f) * unit};
}

/* Deflection at a share x of an element per deflection and rotation of its nodes. */
static void shape_of(const CzSeats *seats, double l, double x, double shape[4]) {
    const double f = 12.0 * seats->bending / (seats->shear * l * l), scale = 1.0 / (1.0 + f);
    const double y = 1.0 - x;
    shape[0] = scale * (1.0 - 3.0 * x * x + 2.0 * x * x * x + f * y);
    shape[1] = scale * l * x * y * (y + 0.5 * f);
    shape[2] = scale * (3.0 * x * x - 2.0 * x * x * x + f * x);
    shape[3] = -scale * l * x * y * (x + 0.5 * f);
}

static void shape_slope_of(const CzSeats *seats, double l, double x, double slope[4]) {
    const double f = 12.0 * seats->bending / (seats->shear * l * l), scale = 1.0 / (1.0 + f);
    slope[0] = scale / l * (-6.0 * x + 6.0 * x * x - f);
    slope[1] = scale * (1.0 - 4.0 * x + 3.0 * x * x + 0.5 * f * (1.0 - 2.0 * x));
    slope[2] = -slope[0];
    slope[3] = scale * (3.0 * x * x - 2.0 * x - 0.5 * f * (1.0 - 2.0 * x));
}

/* What an element with held nodes gives way at a share x of it: its two parts in parallel. */
static double held_flexibility(const CzSeats *seats, double l, double x) {
    if (x < 1e-6 || x > 1.0 - 1e-6)
        return 0.0;
    const Stiffness a = stiffness_of(seats, x * l), b = stiffness_of(seats, (1.0 - x) * l);
    const double zz = a.zz + b.zz, zr = b.zr - a.zr, rr = a.rr + b.rr;
    return rr / (zz * rr - zr * zr);
}

/* ---- banded matrices: row i holds the columns i - band ... i ---- */

static double *entry(const CzElements *elements, double *matrix, size_t i, size_t j) {
    const size_t row = i > j ? i : j, column = i > j ? j : i;
    return &matrix[row * (elements->band + 1) + elements->band - (row - column)];
}

static void couple(const CzElements *elements, double *matrix, size_t i, size_t j, double value) {
    *entry(elements, matrix, i, i) += value;
    *entry(elements, matrix, j, j) += value;
    *entry(elements, matrix, i, j) -= value;
}

/* y = A x */
static void multiply(const CzElements *elements, const double *matrix, const double *x, double *y) {
    const size_t n = elements->n, band = elements->band;
    memset(y, 0, n * sizeof *y);
    for (size_t i = 0; i < n; ++i) {
        const double *row = matrix + i * (band + 1);
        for (size_t j = i > band ? i - band : 0; j < i; ++j) {
            const double a = row[band - (i - j)];
            y[i] += a * x[j];
            y[j] += a * x[i];
        }
        y[i] += row[band] * x[i];
    }
}

/* L D L^T in place. */
static void factorise(const CzElements *elements, double *matrix) {
    const size_t n = elements->n, band = elements->band;
    for (size_t i = 0; i < n; ++i) {
        const size_t first = i > band ? i - band : 0;
        for (size_t j = first; j < i; ++j) {
            double sum = *entry(elements, matrix, i, j);
            for (size_t k = j > band && j - band > first ? j - band : first; k < j; ++k)
                sum -= *entry(elements, matrix, i, k) * *entry(elements, matrix, j, k);
            *entry(elements, matrix, i, j) = sum; /* L D until the row is done */
        }
        double diagonal = *entry(elements, matrix, i, i);
        for (size_t j = first; j < i; ++j) {
            double *l = entry(elements, matrix, i, j);
            const double scaled = *l / *entry(elements, matrix, j, j);
            diagonal -= scaled * *l;
            *l = scaled;
        }
        *entry(elements, matrix, i, i) = diagonal;
    }
}

/* x = A^-1 x */
static void solve(const CzElements *elements, const double *factor, double *x) {
    const size_t n = elements->n, band = elements->band;
    for (size_t i = 0; i < n; ++i)
        for (size_t j = i > band ? i - band : 0; j < i; ++j)
            x[i] -= factor[i * (band + 1) + band - (i - j)] * x[j];
    for (size_t i = 0; i < n; ++i)
        x[i] /= factor[i * (band + 1) + band];
    for (size_t i = n; i-- > 0;)
        for (size_t j = i > band ? i - band : 0; j < i; ++j)
            x[j] -= factor[i * (band + 1) + band - (i - j)] * x[i];
}

/* ---- assembly ---- */

/* Deflection of a node; its rotation is the next unknown. */
static size_t node_at(const CzElements *elements, size_t node) {
    const size_t bay = node / (size_t)elements->nodes, within = node % (size_t)elements->nodes;
    return bay * elements->per_bay + (within == 0 ? 0 : 2 + 2 * within);
}

static size_t n_node(const CzElements *elements) {
    return (size_t)elements->n_bay * (size_t)elements->nodes + 1;
}

static void add_rail(CzElements *elements) {
    const double l = elements->seats.spacing / elements->nodes;
    const Stiffness k = stiffness_of(&elements->seats, l);
    double *a = elements->stiffness;
    for (size_t node = 0; node + 1 < n_node(elements); ++node) {
        const size_t i = node_at(elements, node), j = node_at(elements, node + 1);
        *entry(elements, a, i, i) += k.zz;
        *entry(elements, a, i, i + 1) += k.zr;
        *entry(elements, a, i + 1, i + 1) += k.rr;
        *entry(elements, a, i, j) -= k.zz;
        *entry(elements, a, i, j + 1) += k.zr;
        *entry(elements, a, i + 1, j) -= k.zr;
        *entry(elements, a, i + 1, j + 1) += k.cross;
        *entry(elements, a, j, j) += k.zz;
        *entry(elements, a, j, j + 1) -= k.zr;
        *entry(elements, a, j + 1, j + 1) += k.rr;
        for (int end = 0; end < 2; ++end) {
            elements->mass[end == 0 ? i : j] += 0.5 * l * elements->seats.mass;
            elements->mass[(end == 0 ? i : j) + 1] += 0.5 * l * elements->seats.rotation;
        }
    }
}

/* A seat: pad, sleeper, ballast block, ground, and the next seat's ballast block. */
static void add_seat(CzElements *elements, int bay) {
    const CzSeats *seats = &elements->seats;
    const size_t rail = (size_t)bay * elements->per_bay, sleeper = rail + 2, ballast = rail + 3;
    couple(elements, elements->stiffness, rail, sleeper, seats->pad_k);
    couple(elements, elements->damping, rail, sleeper, seats->pad_c);
    couple(elements, elements->stiffness, sleeper, ballast, seats->upper_k);
    couple(elements, elements->damping, sleeper, ballast, seats->upper_c);
    *entry(elements, elements->stiffness, ballast, ballast) += seats->lower_k;
    *entry(elements, elements->damping, ballast, ballast) += seats->lower_c;
    elements->mass[sleeper] = seats->sleeper;
    elements->mass[ballast] = seats->ballast;
    if (seats->across_k > 0.0 && bay < elements->n_bay) {
        couple(elements, elements->stiffness, ballast, ballast + elements->per_bay,
               seats->across_k);
        couple(elements, elements->damping, ballast, ballast + elements->per_bay, seats->across_c);
    }
}

/* Holds the rail's deflection at both ends: by a stiffness that leaves no more than rounding. */
static void pin(CzElements *elements) {
    const size_t last = (size_t)elements->n_bay * elements->per_bay;
    *entry(elements, elements->stiffness, 0, 0) += 1e3 * elements->seats.shear;
    *entry(elements, elements->stiffness, last, last) += 1e3 * elements->seats.shear;
}

static void assemble(CzElements *elements) {
    add_rail(elements);
    for (int bay = 0; bay <= elements->n_bay; ++bay)
        add_seat(elements, bay);
    pin(elements);
    const double h = elements->step;
    const size_t size = elements->n * (elements->band + 1);
    for (size_t k = 0; k < size; ++k)
        elements->factor[k] =
            0.5 * h * elements->damping[k] + 0.25 * h * h * elements->stiffness[k];
    for (size_t i = 0; i < elements->n; ++i)
        *entry(elements, elements->factor, i, i) += elements->mass[i];
    factorise(elements, elements->factor);
}

CzElements *cz_elements_create(const CzSeats *seats, int nodes, double span, double step,
                               size_t n_under, CzArena *arena) {
    CzElements *elements = cz_arena_allocate(arena, 1, sizeof *elements);
    if (elements == NULL)
        return NULL;
    elements->seats = *seats;
    elements->step = step;
    elements->nodes = nodes;
    elements->n_bay = 2 * (int)ceil((0.5 * span + MARGIN) / seats->spacing);
    elements->per_bay = 2 + 2 * (size_t)nodes;
    elements->n = (size_t)elements->n_bay * elements->per_bay + 4;
    elements->band = seats->across_k > 0.0 || nodes == 1 ? elements->per_bay + 1 : 5;
    const size_t size = elements->n * (elements->band + 1);
    elements->stiffness = cz_arena_allocate(arena, size, sizeof(double));
    elements->damping = cz_arena_allocate(arena, size, sizeof(double));
    elements->factor = cz_arena_allocate(arena, size, sizeof(double));
    elements->mass = cz_arena_allocate(arena, elements->n, sizeof(double));
    elements->work = cz_arena_allocate(arena, 2 * elements->n, sizeof(double));
    elements->n_under = n_under;
    elements->under = cz_arena_allocate(arena, n_under, sizeof *elements->under);
    if (elements->stiffness == NULL || elements->damping == NULL || elements->factor == NULL ||
        elements->mass == NULL || elements->work == NULL || elements->under == NULL)
        return NULL;
    assemble(elements);
    return elements;
}

/* ---- under one car ---- */

/* Where a wheel is: its element's first unknowns, and a share of the element. */
typedef struct Stand {
    size_t i, j;
    double x;
} Stand;

static Stand stand_of(const CzElements *elements, const CzElementsUnder *under, double place) {
    const double l = elements->seats.spacing / elements->nodes, way = (place - under->from) / l;
    const double node = floor(way);
    const size_t first = (size_t)node;
    return (Stand){node_at(elements, first), node_at(elements, first + 1), way - node};
}

static double between(const Stand *stand, const double *u, const double shape[4]) {
    return shape[0] * u[stand->i] + shape[1] * u[stand->i + 1] + shape[2] * u[stand->j] +
           shape[3] * u[stand->j + 1];
}

/* Adds forces at the wheels to the nodes. */
static void press(const CzElements *elements, const CzElementsUnder *under, const double force[4],
                  double *load) {
    const double l = elements->seats.spacing / elements->nodes;
    for (int wheel = 0; wheel < 4; ++wheel) {
        const Stand stand = stand_of(elements, under, under->place[wheel]);
        double shape[4];
        shape_of(&elements->seats, l, stand.x, shape);
        load[stand.i] += force[wheel] * shape[0];
        load[stand.i + 1] += force[wheel] * shape[1];
        load[stand.j] += force[wheel] * shape[2];
        load[stand.j + 1] += force[wheel] * shape[3];
    }
}

bool cz_elements_lay(CzElements *elements, size_t index, const double place[4],
                     const double load[4], CzArena *arena) {
    CzElementsUnder *under = &elements->under[index];
    const size_t n = elements->n, size = n * (elements->band + 1);
    under->u = cz_arena_allocate(arena, n, sizeof(double));
    under->before = cz_arena_allocate(arena, n, sizeof(double));
    under->v = cz_arena_allocate(arena, n, sizeof(double));
    double *factor = cz_arena_allocate(arena, size, sizeof(double));
    if (under->u == NULL || under->before == NULL || under->v == NULL || factor == NULL)
        return false;
    under->from = -0.5 * elements->n_bay * elements->seats.spacing;
    under->middle = 0.25 * (place[0] + place[1] + place[2] + place[3]);
    memcpy(under->place, place, sizeof under->place);
    const double force[4] = {-load[0], -load[1], -load[2], -load[3]};
    memcpy(factor, elements->stiffness, size * sizeof *factor);
    factorise(elements, factor);
    press(elements, under, force, under->u);
    for (size_t i = 0; i < n; ++i) /* at rest every kick turns the rate round */
        under->v[i] = -0.5 * elements->step * under->u[i] / elements->mass[i];
    solve(elements, factor, under->u);
    memcpy(under->before, under->u, n * sizeof *under->u);
    return true;
}

/* Moves the piece by whole bays until the wheels are about its middle. */
static void follow(const CzElements *elements, CzElementsUnder *under, const double place[4]) {
    const double d = elements->seats.spacing;
    const double centre = under->from + 0.5 * elements->n_bay * d + under->middle;
    const double way = 0.25 * (place[0] + place[1] + place[2] + place[3]) - centre;
    const int n_bay = (int)(way / d);
    if (n_bay == 0)
        return;
    const size_t moved = (size_t)(n_bay > 0 ? n_bay : -n_bay) * elements->per_bay;
    const size_t kept = moved < elements->n ? elements->n - moved : 0, lost = elements->n - kept;
    double *const part[] = {under->u, under->before, under->v};
    for (size_t k = 0; k < 3; ++k) {
        if (n_bay > 0) {
            memmove(part[k], part[k] + lost, kept * sizeof(double));
            memset(part[k] + kept, 0, lost * sizeof(double));
        } else {
            memmove(part[k] + lost, part[k], kept * sizeof(double));
            memset(part[k], 0, lost * sizeof(double));
        }
    }
    under->from += n_bay * d;
}

void cz_elements_look(CzElements *elements, size_t index, const double place[4],
                      CzElementsPoint point[4]) {
    const CzSeats *seats = &elements->seats;
    CzElementsUnder *under = &elements->under[index];
    const double l = seats->spacing / elements->nodes, beside = 1e-3;
    follow(elements, under, place);
    memcpy(under->place, place, sizeof under->place);
    for (int wheel = 0; wheel < 4; ++wheel) {
        const Stand stand = stand_of(elements, under, place[wheel]);
        double shape[4], slope[4];
        shape_of(seats, l, stand.x, shape);
        shape_slope_of(seats, l, stand.x, slope);
        point[wheel] = (CzElementsPoint){
            .z = between(&stand, under->u, shape),
            .past =
                0.5 * (between(&stand, under->u, shape) + between(&stand, under->before, shape)),
            .slope = between(&stand, under->u, slope),
            .flexibility = held_flexibility(seats, l, stand.x),
            .flexibility_slope = (held_flexibility(seats, l, fmin(stand.x + beside, 1.0)) -
                                  held_flexibility(seats, l, fmax(stand.x - beside, 0.0))) /
                                 (2.0 * beside * l)};
    }
}

double cz_elements_past(const CzElements *elements, size_t index, int wheel) {
    const CzElementsUnder *under = &elements->under[index];
    const Stand stand = stand_of(elements, under, under->place[wheel]);
    double shape[4];
    shape_of(&elements->seats, elements->seats.spacing / elements->nodes, stand.x, shape);
    return 0.5 * (between(&stand, under->u, shape) + between(&stand, under->before, shape));
}

void cz_elements_step(CzElements *elements, size_t index, const double force[4]) {
    CzElementsUnder *under = &elements->under[index];
    const size_t n = elements->n;
    const double h = elements->step;
    double *kick = elements->work, *sum = elements->work + n;
    memset(kick, 0, n * sizeof *kick);
    press(elements, under, force, kick);
    multiply(elements, elements->stiffness, under->u, sum);
    for (size_t i = 0; i < n; ++i) {
        under->v[i] += h * kick[i] / elements->mass[i];
        sum[i] = 2.0 * elements->mass[i] * under->v[i] - h * sum[i];
    }
    solve(elements, elements->factor, sum);
    memcpy(under->before, under->u, n * sizeof *under->u);
    for (size_t i = 0; i < n; ++i) {
        under->u[i] += 0.5 * h * sum[i];
        under->v[i] = sum[i] - under->v[i];
    }
}

double cz_elements_energy(const CzElements *elements, size_t index) {
    const CzElementsUnder *under = &elements->under[index];
    double *middle = elements->work, *force = elements->work + elements->n, energy = 0.0;
    for (size_t i = 0; i < elements->n; ++i) {
        const double rate = (under->u[i] - under->before[i]) / elements->step;
        middle[i] = 0.5 * (under->u[i] + under->before[i]);
        energy += 0.5 * elements->mass[i] * rate * rate;
    }
    multiply(elements, elements->stiffness, middle, force);
    for (size_t i = 0; i < elements->n; ++i)
        energy += 0.5 * middle[i] * force[i];
    return energy;
}
