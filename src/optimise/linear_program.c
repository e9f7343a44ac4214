/* The primal simplex method with piecewise linear costs.
 *
 * Variables are d_j (j < n) and the excesses v_k = c_k + a_k . d (n + k), which are free and cost
 * w_k where they are positive. The v are basic at first. A step changes one variable that is not
 * basic, and with it the basic ones, in the direction of the steepest fall of the cost, until the
 * cost rises again: at a corner where a basic v changes its sign or a d is at its bound. That
 * variable then leaves the basis. Every point is within the box, so there is no first phase.
 */
#include "optimise/linear_program.h"
#include "base/arena.h"

#include <math.h>
#include <stdlib.h>

typedef struct Tableau {
    const CzLinearProgram *program;
    double *value;         /* of all variables (n + m) */
    double *row;           /* change of the basic variable of each row by the others (m x n) */
    int *basic;            /* variable of each row (m) */
    int *other;            /* variable of each column (n) */
    double *slope;         /* of the cost by each column, upwards and downwards (2 n) */
    struct Corner *corner; /* (m + 1) */
} Tableau;

/* A place on the line of a step. */
typedef struct Corner {
    double at;   /* distance */
    int row;     /* basic variable that reaches it, -1 for the changed one */
    double bend; /* change of the slope of the cost; infinite at a bound */
} Corner;

static const double zero = 1e-11; /* relative to values and slopes of the order of 1 */

/* Slope of the cost of a variable at its value, in a direction of change. */
static double cost_slope(const Tableau *tableau, int variable, double direction) {
    const CzLinearProgram *program = tableau->program;
    if (variable < program->n)
        return program->g[variable] * direction;
    const double v = tableau->value[variable];
    const bool is_above = v > zero || (v >= -zero && direction > 0);
    return is_above ? program->w[variable - program->n] * direction : 0;
}

static bool can_move(const Tableau *tableau, int variable, double sign) {
    const CzLinearProgram *program = tableau->program;
    if (variable >= program->n)
        return true;
    const double value = tableau->value[variable];
    return sign > 0 ? value < program->hi[variable] - zero : value > program->lo[variable] + zero;
}

/* The column and direction of the steepest fall; the slope, 0 when there is none. */
static double choose(Tableau *tableau, int *column, double *sign) {
    const int n = tableau->program->n, m = tableau->program->m;
    for (int j = 0; j < n; j++) {
        tableau->slope[2 * j] = cost_slope(tableau, tableau->other[j], 1);
        tableau->slope[2 * j + 1] = cost_slope(tableau, tableau->other[j], -1);
    }
    for (int r = 0; r < m; r++)
        for (int j = 0; j < n; j++) {
            const double change = tableau->row[r * n + j];
            tableau->slope[2 * j] += cost_slope(tableau, tableau->basic[r], change);
            tableau->slope[2 * j + 1] += cost_slope(tableau, tableau->basic[r], -change);
        }
    double steepest = -1e-9;
    *column = -1;
    for (int k = 0; k < 2 * n; k++)
        if (tableau->slope[k] < steepest &&
            can_move(tableau, tableau->other[k / 2], k % 2 == 0 ? 1 : -1)) {
            steepest = tableau->slope[k];
            *column = k / 2;
            *sign = k % 2 == 0 ? 1 : -1;
        }
    return *column >= 0 ? steepest : 0;
}

static int compare_corners(const void *one, const void *other) {
    const Corner *a = one, *b = other;
    if (a->at != b->at)
        return a->at < b->at ? -1 : 1;
    return (a->row > b->row) - (a->row < b->row);
}

/* Lists the corners of a step. */
static int list_corners(const Tableau *tableau, int column, double sign) {
    const CzLinearProgram *program = tableau->program;
    const int n = program->n, entering = tableau->other[column];
    int n_corner = 0;
    if (entering < n) {
        const double bound = sign > 0 ? program->hi[entering] : program->lo[entering];
        tableau->corner[n_corner++] =
            (Corner){fmax((bound - tableau->value[entering]) * sign, 0), -1, INFINITY};
    }
    for (int r = 0; r < program->m; r++) {
        const double rate = tableau->row[r * n + column] * sign;
        const int variable = tableau->basic[r];
        const double value = tableau->value[variable];
        if (fabs(rate) < 1e-9)
            continue;
        if (variable < n) {
            const double bound = rate > 0 ? program->hi[variable] : program->lo[variable];
            tableau->corner[n_corner++] = (Corner){fmax((bound - value) / rate, 0), r, INFINITY};
        } else if (value * rate < 0 && fabs(value) > zero) {
            tableau->corner[n_corner++] =
                (Corner){-value / rate, r, program->w[variable - n] * fabs(rate)};
        }
    }
    qsort(tableau->corner, (size_t)n_corner, sizeof *tableau->corner, compare_corners);
    return n_corner;
}

/* Exchanges the variables of a row and a column. */
static void exchange(Tableau *tableau, int row, int column) {
    const int n = tableau->program->n, m = tableau->program->m;
    double *pivot_row = tableau->row + row * n;
    const double pivot = pivot_row[column];
    for (int j = 0; j < n; j++)
        pivot_row[j] = j == column ? 1 / pivot : -pivot_row[j] / pivot;
    for (int r = 0; r < m; r++) {
        double *other = tableau->row + r * n;
        const double share = other[column];
        if (r == row || share == 0)
            continue;
        for (int j = 0; j < n; j++)
            other[j] = j == column ? share * pivot_row[j] : other[j] + share * pivot_row[j];
    }
    const int kept = tableau->basic[row];
    tableau->basic[row] = tableau->other[column];
    tableau->other[column] = kept;
}

/* Makes one step; false when there is none that lowers the cost. */
static bool step(Tableau *tableau) {
    const CzLinearProgram *program = tableau->program;
    const int n = program->n;
    int column;
    double sign = 1;
    double slope = choose(tableau, &column, &sign);
    if (column < 0)
        return false;
    const int n_corner = list_corners(tableau, column, sign);
    int last = 0;
    while (last < n_corner && (slope += tableau->corner[last].bend) < 0)
        last++;
    if (last == n_corner) /* rounding: a slope of nearly zero without an end */
        return false;
    const Corner end = tableau->corner[last];
    tableau->value[tableau->other[column]] += sign * end.at;
    for (int r = 0; r < program->m; r++)
        tableau->value[tableau->basic[r]] += sign * end.at * tableau->row[r * n + column];
    if (end.row < 0) {
        const int entering = tableau->other[column];
        tableau->value[entering] = sign > 0 ? program->hi[entering] : program->lo[entering];
        return true;
    }
    const int leaving = tableau->basic[end.row];
    const double rate = tableau->row[end.row * n + column] * sign;
    tableau->value[leaving] = leaving >= n ? 0
                              : rate > 0   ? program->hi[leaving]
                                           : program->lo[leaving];
    exchange(tableau, end.row, column);
    return true;
}

static void begin(Tableau *tableau, const double *d) {
    const CzLinearProgram *program = tableau->program;
    const int n = program->n, m = program->m;
    for (int j = 0; j < n; j++) {
        tableau->other[j] = j;
        tableau->value[j] = d[j];
    }
    for (int k = 0; k < m; k++) {
        double v = program->c[k];
        for (int j = 0; j < n; j++) {
            tableau->row[k * n + j] = program->a[k * n + j];
            v += program->a[k * n + j] * d[j];
        }
        tableau->basic[k] = n + k;
        tableau->value[n + k] = v;
    }
}

bool cz_linear_program(const CzLinearProgram *program, double *d) {
    const size_t n = (size_t)program->n, m = (size_t)program->m;
    CzArena arena = {0};
    Tableau tableau = {.program = program,
                       .value = cz_arena_numbers(&arena, n + m),
                       .row = cz_arena_numbers(&arena, m * n),
                       .basic = cz_arena_allocate(&arena, m + 1, sizeof(int)),
                       .other = cz_arena_allocate(&arena, n, sizeof(int)),
                       .slope = cz_arena_numbers(&arena, 2 * n),
                       .corner = cz_arena_allocate(&arena, m + 1, sizeof(Corner))};
    const bool has_memory = !arena.out_of_memory;
    if (has_memory) {
        begin(&tableau, d);
        /* Degenerate corners may be visited in turn for ever. */
        for (size_t i = 0; i < 20 * (n + m) && step(&tableau); i++)
            continue;
        for (size_t j = 0; j < n; j++)
            d[j] = fmin(fmax(tableau.value[j], program->lo[j]), program->hi[j]);
    }
    cz_arena_free(&arena);
    return has_memory;
}
