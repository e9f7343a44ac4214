/* Least squares of staged curves. */
#include "fit/staged.h"

#include "problem/strokes.h"

enum {
    MAX_TERMS = CZ_MAX_STAGES + 1, /* forces of the stages and a preload */
    SWEEPS = 28,
    SECTIONS = 24 /* steps of one line search */
};

#define GOLDEN 0.6180339887498949
#define ROUNDING 1e-12 /* of a difference of integrals of squares, as a share of them */
#define MIN_FORCE 1e-3 /* of the mean force: smallest force of a stage (ours) */

CzStaged cz_staged_begin(bool is_strength) {
    return (CzStaged){.is_strength = is_strength, .trigger = NAN, .trigger_length = 0.01};
}

static void breakpoints_of(const CzStaged *staged, const CzStage *stage, double trigger,
                           double preload, CzBreakpoints *breakpoints) {
    static const CzTable none;
    if (staged->is_strength)
        cz_breakpoints_strength(breakpoints, stage, staged->n_stage, &none, trigger,
                                staged->trigger_length, staged->bottom_stiffness);
    else
        cz_breakpoints_loading(breakpoints, preload, stage, staged->n_stage, &none,
                               staged->bottom_stiffness);
}

void cz_staged_breakpoints(const CzStaged *staged, CzBreakpoints *breakpoints) {
    breakpoints_of(staged, staged->stage, staged->trigger, staged->preload, breakpoints);
}

double cz_staged_stroke(const CzStaged *staged) {
    static const CzTable none;
    return cz_total_stroke(staged->stage, staged->n_stage, &none);
}

/* Strokes of a curve's breakpoints and of both its ends, each once, rising. */
static int bends_of(const CzBreakpoints *breakpoints, double stroke,
                    double at[CZ_MAX_STAGED_BREAKPOINTS]) {
    int n = 0;
    at[n++] = 0.0;
    at[n++] = stroke;
    for (int i = 0; i < breakpoints->n; i++) {
        const double x = breakpoints->at[i];
        int place = 0;
        while (place < n && at[place] < x)
            place++;
        if (!(x > 0.0 && x < stroke) || at[place] == x)
            continue;
        for (int k = n; k > place; k--)
            at[k] = at[k - 1];
        at[place] = x;
        n++;
    }
    return n;
}

int cz_staged_breakpoint_strokes(const CzStaged *staged, double at[CZ_MAX_STAGED_BREAKPOINTS]) {
    CzBreakpoints breakpoints;
    cz_staged_breakpoints(staged, &breakpoints);
    return bends_of(&breakpoints, cz_staged_stroke(staged), at);
}

double cz_staged_energy(const CzStaged *staged) {
    double at[CZ_MAX_STAGED_BREAKPOINTS], energy = 0.0;
    CzBreakpoints breakpoints;
    cz_staged_breakpoints(staged, &breakpoints);
    const int n = bends_of(&breakpoints, cz_staged_stroke(staged), at);
    for (int i = 1; i < n; i++)
        energy += 0.5 * (at[i] - at[i - 1]) *
                  (cz_breakpoints_value(&breakpoints, at[i]) +
                   cz_breakpoints_value(&breakpoints, at[i - 1]));
    return energy;
}

/* ---- forces for given strokes ---- */

/* Values of the fixed part and of every phi at the breakpoints. */
typedef struct Terms {
    int n_bend, n_term;
    double at[CZ_MAX_STAGED_BREAKPOINTS];
    double fixed[CZ_MAX_STAGED_BREAKPOINTS];
    double phi[MAX_TERMS][CZ_MAX_STAGED_BREAKPOINTS];
} Terms;

static void put_values(const Terms *terms, const CzBreakpoints *breakpoints, double *value) {
    for (int i = 0; i < terms->n_bend; i++)
        value[i] = cz_breakpoints_value(breakpoints, terms->at[i]);
}

static void make_terms(const CzStaged *staged, Terms *terms) {
    CzStage unit[CZ_MAX_STAGES];
    CzBreakpoints breakpoints;
    for (int i = 0; i < staged->n_stage; i++)
        unit[i] = (CzStage){.stroke = staged->stage[i].stroke, .end_force = NAN};
    breakpoints_of(staged, unit, staged->trigger, 0.0, &breakpoints);
    terms->n_bend = bends_of(&breakpoints, cz_staged_stroke(staged), terms->at);
    put_values(terms, &breakpoints, terms->fixed);
    terms->n_term = staged->n_stage + (staged->has_preload ? 1 : 0);
    for (int term = 0; term < terms->n_term; term++) {
        if (term < staged->n_stage)
            unit[term].force = 1.0;
        breakpoints_of(staged, unit, isnan(staged->trigger) ? NAN : 0.0, term == staged->n_stage,
                       &breakpoints);
        put_values(terms, &breakpoints, terms->phi[term]);
        if (term < staged->n_stage)
            unit[term].force = 0.0;
    }
}

/* Integral of a product of two polylines over the breakpoints. */
static double product(const Terms *terms, const double *a, const double *b) {
    double sum = 0.0;
    for (int i = 1; i < terms->n_bend; i++)
        sum += (terms->at[i] - terms->at[i - 1]) / 6.0 *
               (2.0 * (a[i - 1] * b[i - 1] + a[i] * b[i]) + a[i - 1] * b[i] + a[i] * b[i - 1]);
    return sum;
}

/* Integral of a polyline times the measured force; `sums` of the branch at the breakpoints. */
static double product_with(const Terms *terms, const CzBranchSums *sums, const double *a) {
    double sum = 0.0;
    for (int i = 1; i < terms->n_bend; i++) {
        const double h = terms->at[i] - terms->at[i - 1];
        const double area = sums[i].area - sums[i - 1].area;
        const double moment = sums[i].moment - sums[i - 1].moment;
        const double slope = (a[i] - a[i - 1]) / h;
        sum += (a[i - 1] - slope * terms->at[i - 1]) * area + slope * moment;
    }
    return sum;
}

/* Equations for the forces and the multiplier of the condition. */
typedef struct Equations {
    int n;
    double a[MAX_TERMS + 1][MAX_TERMS + 1];
    double x[MAX_TERMS + 1]; /* right-hand side, then the solution */
} Equations;

static void swap(double *a, double *b) {
    const double keep = *a;
    *a = *b;
    *b = keep;
}

/* Elimination with pivoting; false when there is no single solution. */
static bool eliminate(Equations *equations) {
    const int n = equations->n;
    for (int column = 0; column < n; column++) {
        int pivot = column;
        for (int row = column + 1; row < n; row++)
            if (fabs(equations->a[row][column]) > fabs(equations->a[pivot][column]))
                pivot = row;
        if (!(fabs(equations->a[pivot][column]) > 0.0))
            return false;
        for (int k = 0; k < n; k++)
            swap(&equations->a[pivot][k], &equations->a[column][k]);
        swap(&equations->x[pivot], &equations->x[column]);
        for (int row = 0; row < n; row++) {
            if (row == column)
                continue;
            const double factor = equations->a[row][column] / equations->a[column][column];
            for (int k = column; k < n; k++)
                equations->a[row][k] -= factor * equations->a[column][k];
            equations->x[row] -= factor * equations->x[column];
        }
    }
    for (int row = 0; row < n; row++)
        equations->x[row] /= equations->a[row][row];
    return true;
}

/* Stores the solution in the stages and returns the integral of the squared difference. */
static double store_forces(CzStaged *staged, const Terms *terms, const CzBranchSums *sums,
                           const double *force) {
    double value[CZ_MAX_STAGED_BREAKPOINTS];
    for (int k = 0; k < terms->n_bend; k++)
        value[k] = terms->fixed[k];
    for (int i = 0; i < terms->n_term; i++) {
        if (i < staged->n_stage)
            staged->stage[i].force = force[i];
        else
            staged->preload = force[i];
        for (int k = 0; k < terms->n_bend; k++)
            value[k] += force[i] * terms->phi[i][k];
    }
    const double squares = sums[terms->n_bend - 1].squares;
    return fmax(squares - 2.0 * product_with(terms, sums, value) + product(terms, value, value),
                0.0);
}

/* Least squares of forces with a lower bound:
 *
 *   minimise c'A c / 2 - b'c   under   p'c = e,   c_i >= least
 *
 * by an active set: forces that would be lower are held at the bound, and released again where the
 * multiplier m = A c + l p - b is negative (Karush, Kuhn and Tucker: m >= 0). */
typedef struct Problem {
    int n;
    bool has_energy, is_held[MAX_TERMS];
    double a[MAX_TERMS][MAX_TERMS], b[MAX_TERMS], p[MAX_TERMS];
    double energy, least;
    double force[MAX_TERMS], multiplier; /* the solution, and l */
} Problem;

/* Solves for the forces that are not held at the bound; false when there is no single solution. */
static bool solve_free(Problem *problem) {
    int index[MAX_TERMS], n = 0;
    Equations equations;
    double energy = problem->energy;
    for (int i = 0; i < problem->n; i++) {
        if (problem->is_held[i]) {
            problem->force[i] = problem->least;
            energy -= problem->p[i] * problem->least;
        } else
            index[n++] = i;
    }
    equations.n = problem->has_energy ? n + 1 : n;
    for (int i = 0; i < n; i++) {
        equations.x[i] = problem->b[index[i]];
        for (int k = 0; k < problem->n; k++)
            if (problem->is_held[k])
                equations.x[i] -= problem->a[index[i]][k] * problem->least;
        for (int k = 0; k < n; k++)
            equations.a[i][k] = problem->a[index[i]][index[k]];
        equations.a[i][n] = equations.a[n][i] = problem->p[index[i]];
    }
    equations.a[n][n] = 0.0;
    equations.x[n] = energy;
    if (n == 0 || !eliminate(&equations))
        return false;
    for (int i = 0; i < n; i++)
        problem->force[index[i]] = equations.x[i];
    problem->multiplier = problem->has_energy ? equations.x[n] : 0.0;
    return true;
}

/* Holds the forces below the bound at it; false when there is none. */
static bool hold_low_forces(Problem *problem) {
    bool is_low = false;
    for (int i = 0; i < problem->n; i++)
        if (!problem->is_held[i] && !(problem->force[i] >= problem->least))
            is_low = problem->is_held[i] = true;
    return is_low;
}

/* Releases the force with the most negative multiplier; false when there is none. */
static bool release_one(Problem *problem) {
    double lowest = 0.0;
    int which = -1;
    for (int i = 0; i < problem->n; i++) {
        double m = problem->multiplier * problem->p[i] - problem->b[i], size = fabs(m);
        for (int k = 0; k < problem->n; k++) {
            m += problem->a[i][k] * problem->force[k];
            size = fmax(size, fabs(problem->a[i][k] * problem->force[k]));
        }
        if (problem->is_held[i] && m < -ROUNDING * size && m < lowest) {
            lowest = m;
            which = i;
        }
    }
    if (which >= 0)
        problem->is_held[which] = false;
    return which >= 0;
}

static bool solve_bounded(Problem *problem) {
    for (int i = 0; i < 4 * problem->n + 4; i++) {
        if (!solve_free(problem))
            return false;
        if (!hold_low_forces(problem) && !release_one(problem))
            return true;
    }
    return false; /* forces that are held and released in turn because of rounding */
}

double cz_staged_solve(CzStaged *staged, const CzBranch *branch, double energy) {
    Terms terms;
    CzBranchSums sums[CZ_MAX_STAGED_BREAKPOINTS];
    double one[CZ_MAX_STAGED_BREAKPOINTS];
    make_terms(staged, &terms);
    for (int i = 0; i < terms.n_bend; i++) {
        sums[i] = cz_branch_sums(branch, terms.at[i]);
        one[i] = 1.0;
    }
    const int n = terms.n_term;
    Problem problem = {.n = n, .has_energy = !isnan(energy)};
    problem.least = MIN_FORCE * cz_branch_mean(branch, 0.0, terms.at[terms.n_bend - 1]);
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < n; k++)
            problem.a[i][k] = product(&terms, terms.phi[i], terms.phi[k]);
        problem.p[i] = product(&terms, terms.phi[i], one);
        problem.b[i] =
            product_with(&terms, sums, terms.phi[i]) - product(&terms, terms.phi[i], terms.fixed);
    }
    problem.energy = energy - product(&terms, terms.fixed, one);
    if (!solve_bounded(&problem))
        return INFINITY;
    return store_forces(staged, &terms, sums, problem.force);
}

/* ---- strokes ---- */

/* Variables of a search: the length of the trigger, then the ends of all stages except the last. */
typedef struct Breaks {
    int n;
    double at[CZ_MAX_STAGES + 2]; /* at[0] is 0, at[n + 1] the stroke (n + 2) */
} Breaks;

static Breaks breaks_of(const CzStaged *staged) {
    Breaks breaks = {.n = 0};
    double x = 0.0;
    if (!isnan(staged->trigger))
        breaks.at[++breaks.n] = staged->trigger_length;
    for (int i = 0; i + 1 < staged->n_stage; i++)
        breaks.at[++breaks.n] = x += staged->stage[i].stroke;
    breaks.at[breaks.n + 1] = cz_staged_stroke(staged);
    return breaks;
}

static void put_breaks(CzStaged *staged, const Breaks *breaks) {
    int k = 0;
    double before = 0.0;
    if (!isnan(staged->trigger))
        staged->trigger_length = breaks->at[++k];
    for (int i = 0; i < staged->n_stage; i++) {
        const double end = breaks->at[++k];
        staged->stage[i].stroke = end - before;
        before = end;
    }
}

/* A search over the breaks. */
typedef struct Search {
    CzStaged *staged;
    const CzBranch *branch;
    double energy, shortest;
    Breaks breaks;
    double best; /* integral at `breaks` */
} Search;

static double try_break(Search *search, int k, double at) {
    Breaks breaks = search->breaks;
    CzStaged staged = *search->staged;
    breaks.at[k] = at;
    put_breaks(&staged, &breaks);
    return cz_staged_solve(&staged, search->branch, search->energy);
}

/* Golden section search within `reach` of a break, which moves when that is better. */
static void move_break(Search *search, int k, double reach) {
    const double now = search->breaks.at[k];
    double low = fmax(now - reach, search->breaks.at[k - 1] + search->shortest);
    double high = fmin(now + reach, search->breaks.at[k + 1] - search->shortest);
    if (k == 1 && !isnan(search->staged->trigger))
        high = fmin(high, CZ_LONGEST_TRIGGER);
    if (!(low < high))
        return;
    double a = high - GOLDEN * (high - low), b = low + GOLDEN * (high - low);
    double at_a = try_break(search, k, a), at_b = try_break(search, k, b);
    for (int i = 0; i < SECTIONS; i++) {
        if (at_a < at_b) {
            high = b, b = a, at_b = at_a;
            a = high - GOLDEN * (high - low);
            at_a = try_break(search, k, a);
        } else {
            low = a, a = b, at_a = at_b;
            b = low + GOLDEN * (high - low);
            at_b = try_break(search, k, b);
        }
    }
    const double found = at_a < at_b ? at_a : at_b;
    if (found < search->best) {
        search->best = found;
        search->breaks.at[k] = at_a < at_b ? a : b;
    }
}

double cz_staged_refine(CzStaged *staged, const CzBranch *branch, double energy, double shortest) {
    Search search = {.staged = staged,
                     .branch = branch,
                     .energy = energy,
                     .shortest = shortest,
                     .breaks = breaks_of(staged)};
    search.best = cz_staged_solve(staged, branch, energy);
    double reach = cz_branch_last(branch) / 8.0;
    for (int sweep = 0; sweep < SWEEPS; sweep++, reach *= 0.6)
        for (int k = 1; k <= search.breaks.n; k++)
            move_break(&search, k, reach);
    put_breaks(staged, &search.breaks);
    return cz_staged_solve(staged, branch, energy);
}

double cz_staged_rounding(const CzBranch *branch) {
    return ROUNDING * branch->squares[branch->n - 1];
}
