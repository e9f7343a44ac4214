/* Timoshenko elements on seats: matrices, a banded solver, steps.
 *
 * Unknowns of a bay are together: the seat's rail deflection and rotation, sleeper, ballast
 * block, then deflection and rotation of the bay's other nodes. The first and last seat are pinned.
 */
#include "dynamics/track_elements.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define EACH_LANE(k) _Pragma("omp simd") for (size_t k = 0; k < CZ_LANE_BLOCK; ++k)
#define MARGIN 20.0 /* of rail beyond the outer wheels [m]: waves decay over 14 m (ours) */

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

/* Flexibility of an element with fixed nodes at a share x of its length: its two parts in
 * parallel. */
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

/* y = A x, lane by lane */
static void multiply(const CzElements *elements, const double *matrix, const CzElementsRow *x,
                     CzElementsRow *y) {
    const size_t n = elements->n, band = elements->band;
    for (size_t i = 0; i < n; ++i) {
        const double *row = matrix + i * band + band; /* by column */
        const double *restrict own = x[i];
        double *restrict sum = y[i];
        EACH_LANE(k) sum[k] = row[i] * own[k];
        for (size_t j = elements->first[i]; j < i; ++j) {
            const double a = row[j];
            if (a == 0.0)
                continue;
            const double *restrict other = x[j];
            double *restrict mirrored = y[j];
            EACH_LANE(k) {
                sum[k] += a * other[k];
                mirrored[k] += a * own[k];
            }
        }
    }
}

/* x -= l y */
static inline void subtract(double *restrict x, double l, const double *restrict y) {
    EACH_LANE(k) x[k] -= l * y[k];
}

/* x = A^-1 x, lane by lane */
static void solve(const CzElements *elements, const double *factor, CzElementsRow *x) {
    const size_t n = elements->n, band = elements->band;
    for (size_t i = 0; i < n; ++i)
        for (size_t j = elements->first[i]; j < i; ++j)
            subtract(x[i], factor[i * band + band + j], x[j]);
    for (size_t i = 0; i < n; ++i) {
        const double inverse = 1.0 / factor[i * band + band + i];
        double *own = x[i];
        EACH_LANE(k) own[k] *= inverse;
    }
    for (size_t i = n; i-- > 0;)
        for (size_t j = elements->first[i]; j < i; ++j)
            subtract(x[j], factor[i * band + band + j], x[i]);
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

/* The first column of each row that is not zero; the factors have the same. */
static void find_first(CzElements *elements) {
    for (size_t i = 0; i < elements->n; ++i) {
        size_t j = i > elements->band ? i - elements->band : 0;
        while (j < i && *entry(elements, elements->stiffness, i, j) == 0.0 &&
               *entry(elements, elements->damping, i, j) == 0.0)
            ++j;
        elements->first[i] = j;
    }
}

static void assemble(CzElements *elements) {
    add_rail(elements);
    for (int bay = 0; bay <= elements->n_bay; ++bay)
        add_seat(elements, bay);
    pin(elements);
    find_first(elements);
    const double h = elements->step;
    const size_t size = elements->n * (elements->band + 1);
    for (size_t k = 0; k < size; ++k)
        elements->flight[k] =
            0.5 * h * elements->damping[k] + 0.25 * h * h * elements->stiffness[k];
    for (size_t i = 0; i < elements->n; ++i)
        *entry(elements, elements->flight, i, i) += elements->mass[i];
    factorise(elements, elements->flight);
    memcpy(elements->rest, elements->stiffness, size * sizeof *elements->rest);
    factorise(elements, elements->rest);
}

CzElements *cz_elements_create(const CzSeats *seats, int nodes, double span, double step,
                               size_t n_lane, CzArena *arena) {
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
    elements->first = cz_arena_allocate(arena, elements->n, sizeof *elements->first);
    elements->stiffness = cz_arena_allocate(arena, size, sizeof(double));
    elements->damping = cz_arena_allocate(arena, size, sizeof(double));
    elements->flight = cz_arena_allocate(arena, size, sizeof(double));
    elements->rest = cz_arena_allocate(arena, size, sizeof(double));
    elements->mass = cz_arena_allocate(arena, elements->n, sizeof(double));
    elements->work = cz_arena_allocate(arena, 2 * elements->n, sizeof *elements->work);
    elements->n_lane = n_lane;
    elements->under = cz_arena_allocate(arena, n_lane, sizeof *elements->under);
    elements->block = cz_arena_allocate(arena, n_lane / CZ_LANE_BLOCK + 1, sizeof *elements->block);
    if (elements->first == NULL || elements->stiffness == NULL || elements->damping == NULL ||
        elements->flight == NULL || elements->rest == NULL || elements->mass == NULL ||
        elements->work == NULL || elements->under == NULL || elements->block == NULL)
        return NULL;
    assemble(elements);
    return elements;
}

/* ---- under the cars of a block ---- */

static CzElementsBlock *block_of(const CzElements *elements, size_t lane) {
    return &elements->block[lane / CZ_LANE_BLOCK];
}

/* Place of a wheel: the first unknowns of its element, and the share of the element's length. */
typedef struct Stand {
    size_t i, j;
    double x;
} Stand;

static Stand stand_of(const CzElements *elements, const CzElementsUnder *under, double place) {
    const double l = elements->seats.spacing / elements->nodes,
                 from_first = (place - under->from) / l;
    const double node = floor(from_first);
    const size_t first = (size_t)node;
    return (Stand){node_at(elements, first), node_at(elements, first + 1), from_first - node};
}

static double between(const Stand *stand, const CzElementsRow *u, size_t k, const double shape[4]) {
    return shape[0] * u[stand->i][k] + shape[1] * u[stand->i + 1][k] + shape[2] * u[stand->j][k] +
           shape[3] * u[stand->j + 1][k];
}

/* Adds the forces at the wheels of a lane to the nodes, each over `divisor`, NULL for none. */
static void press(const CzElements *elements, size_t lane, double factor, const double *divisor,
                  CzElementsRow *load) {
    const CzElementsUnder *under = &elements->under[lane];
    const double l = elements->seats.spacing / elements->nodes;
    const size_t k = lane % CZ_LANE_BLOCK;
    for (int wheel = 0; wheel < 4; ++wheel) {
        const Stand stand = stand_of(elements, under, under->place[wheel]);
        const size_t at[4] = {stand.i, stand.i + 1, stand.j, stand.j + 1};
        double shape[4];
        shape_of(&elements->seats, l, stand.x, shape);
        for (int i = 0; i < 4; ++i)
            load[at[i]][k] +=
                factor * under->force[wheel] * shape[i] / (divisor != NULL ? divisor[at[i]] : 1.0);
    }
}

static bool make_block(const CzElements *elements, CzElementsBlock *block, CzArena *arena) {
    if (block->u != NULL)
        return true;
    block->u = cz_arena_allocate(arena, elements->n, sizeof *block->u);
    block->before = cz_arena_allocate(arena, elements->n, sizeof *block->before);
    block->v = cz_arena_allocate(arena, elements->n, sizeof *block->v);
    return block->u != NULL && block->before != NULL && block->v != NULL;
}

/* The piece of a lane under constant forces. */
static void rest(const CzElements *elements, size_t lane) {
    const CzElementsBlock *block = block_of(elements, lane);
    const size_t k = lane % CZ_LANE_BLOCK;
    CzElementsRow *u = elements->work;
    memset(u, 0, elements->n * sizeof *u);
    press(elements, lane, 1.0, NULL, u);
    for (size_t i = 0; i < elements->n; ++i) /* at rest every kick reverses the rate */
        block->v[i][k] = -0.5 * elements->step * u[i][k] / elements->mass[i];
    solve(elements, elements->rest, u);
    for (size_t i = 0; i < elements->n; ++i)
        block->u[i][k] = block->before[i][k] = u[i][k];
}

bool cz_elements_lay(CzElements *elements, size_t lane, const double place[4], const double load[4],
                     CzArena *arena) {
    CzElementsUnder *under = &elements->under[lane];
    if (!make_block(elements, block_of(elements, lane), arena))
        return false;
    *under = (CzElementsUnder){.is_laid = true,
                               .from = -0.5 * elements->n_bay * elements->seats.spacing,
                               .middle = 0.25 * (place[0] + place[1] + place[2] + place[3]),
                               .force = {-load[0], -load[1], -load[2], -load[3]}};
    memcpy(under->place, place, sizeof under->place);
    rest(elements, lane);
    return true;
}

/* Moves one lane of a part by whole bays: nodes that drop out behind return unloaded in front. */
static void shift(CzElementsRow *part, size_t n, size_t moved, bool forwards, size_t k) {
    for (size_t i = 0; i < n; ++i) {
        const size_t to = forwards ? i : n - 1 - i;
        const bool is_kept = i + moved < n;
        part[to][k] = is_kept ? part[forwards ? to + moved : to - moved][k] : 0.0;
    }
}

/* Moves the piece of a lane by whole bays until the wheels are near its middle. */
static void follow(const CzElements *elements, size_t lane, const double place[4]) {
    const CzElementsBlock *block = block_of(elements, lane);
    CzElementsUnder *under = &elements->under[lane];
    const double d = elements->seats.spacing;
    const double centre = under->from + 0.5 * elements->n_bay * d + under->middle;
    const double off_centre = 0.25 * (place[0] + place[1] + place[2] + place[3]) - centre;
    const int n_bay = (int)(off_centre / d);
    if (n_bay == 0)
        return;
    CzElementsRow *const part[] = {block->u, block->before, block->v};
    const size_t moved = (size_t)abs(n_bay) * elements->per_bay;
    for (size_t i = 0; i < sizeof part / sizeof *part; ++i)
        shift(part[i], elements->n, moved, n_bay > 0, lane % CZ_LANE_BLOCK);
    under->from += n_bay * d;
}

void cz_elements_deflection(CzElements *elements, size_t lane, const double place[4],
                            CzRailPoint point[4]) {
    const CzSeats *seats = &elements->seats;
    const CzElementsBlock *block = block_of(elements, lane);
    CzElementsUnder *under = &elements->under[lane];
    const double l = seats->spacing / elements->nodes, beside = 1e-3;
    const size_t k = lane % CZ_LANE_BLOCK;
    follow(elements, lane, place);
    memcpy(under->place, place, sizeof under->place);
    for (int wheel = 0; wheel < 4; ++wheel) {
        const Stand stand = stand_of(elements, under, place[wheel]);
        double shape[4], slope[4];
        shape_of(seats, l, stand.x, shape);
        shape_slope_of(seats, l, stand.x, slope);
        const double z = between(&stand, block->u, k, shape);
        point[wheel] = (CzRailPoint){.z = z,
                                     .past = 0.5 * (z + between(&stand, block->before, k, shape)),
                                     .slope = between(&stand, block->u, k, slope),
                                     .flexibility = held_flexibility(seats, l, stand.x),
                                     .flexibility_slope =
                                         (held_flexibility(seats, l, fmin(stand.x + beside, 1.0)) -
                                          held_flexibility(seats, l, fmax(stand.x - beside, 0.0))) /
                                         (2.0 * beside * l)};
    }
}

double cz_elements_past(const CzElements *elements, size_t lane, int wheel) {
    const CzElementsBlock *block = block_of(elements, lane);
    const CzElementsUnder *under = &elements->under[lane];
    const Stand stand = stand_of(elements, under, under->place[wheel]);
    const size_t k = lane % CZ_LANE_BLOCK;
    double shape[4];
    shape_of(&elements->seats, elements->seats.spacing / elements->nodes, stand.x, shape);
    return 0.5 * (between(&stand, block->u, k, shape) + between(&stand, block->before, k, shape));
}

void cz_elements_step(CzElements *elements, size_t block_index) {
    const CzElementsBlock *block = &elements->block[block_index];
    const size_t n = elements->n, first = block_index * CZ_LANE_BLOCK;
    const double h = elements->step;
    CzElementsRow *sum = elements->work;
    for (size_t lane = first; lane < first + CZ_LANE_BLOCK && lane < elements->n_lane; ++lane)
        if (elements->under[lane].is_laid)
            press(elements, lane, h, elements->mass, block->v);
    multiply(elements, elements->stiffness, block->u, sum);
    for (size_t i = 0; i < n; ++i)
        EACH_LANE(k) sum[i][k] = 2.0 * elements->mass[i] * block->v[i][k] - h * sum[i][k];
    solve(elements, elements->flight, sum);
    memcpy(block->before, block->u, n * sizeof *block->u);
    for (size_t i = 0; i < n; ++i)
        EACH_LANE(k) {
            block->u[i][k] += 0.5 * h * sum[i][k];
            block->v[i][k] = sum[i][k] - block->v[i][k];
        }
}

double cz_elements_energy(const CzElements *elements, size_t lane) {
    const CzElementsBlock *block = block_of(elements, lane);
    const size_t k = lane % CZ_LANE_BLOCK;
    CzElementsRow *middle = elements->work, *force = elements->work + elements->n;
    double energy = 0.0;
    for (size_t i = 0; i < elements->n; ++i) {
        const double rate = (block->u[i][k] - block->before[i][k]) / elements->step;
        EACH_LANE(other)
        middle[i][other] = 0.5 * (block->u[i][other] + block->before[i][other]);
        energy += 0.5 * elements->mass[i] * rate * rate;
    }
    multiply(elements, elements->stiffness, middle, force);
    for (size_t i = 0; i < elements->n; ++i)
        energy += 0.5 * middle[i][k] * force[i][k];
    return energy;
}
