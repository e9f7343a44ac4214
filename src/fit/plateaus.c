/* Finds the ends of stages: by dynamic programming for plateaus, by trial of all sets of a few
 * likely strokes for lines; both are refined afterwards.
 *
 * The cost of a plateau is the squared difference from its mean, and the total is a sum over
 * stages, so the best n plateaus over a grid follow from the best n - 1 up to every stroke (Bellman
 * 1961, "On the approximation of curves by line segments using dynamic programming", CACM 4(6),
 * 10.1145/366573.366611). Lines that meet at their ends depend on their neighbours, so all their
 * sets are tried.
 */
#include "fit/plateaus.h"

#include <string.h>

#include "problem/reduce_curve.h"

enum {
    CELLS = 240,    /* of the grid for the search of plateaus */
    SAMPLES = 600,  /* of a curve for the search of likely strokes */
    LIKELY = 40,    /* strokes that are tried as ends of lines */
    MAX_OF_OWN = 4, /* most stages unless more are requested */
    MAX_LINES = 4
};

#define SHORTEST 0.005  /* of a stage, as a share of the stroke (ours) */
#define PAYS 0.75       /* a further stage must reduce the squares below this share (ours) */
#define PEAK_WITHIN 0.2 /* part of the stroke in which a trigger peak may be (ours) */
#define PEAK_HEIGHT 1.1 /* of a trigger over the following force (ours) */
#define DOWN 1.02       /* of the following force: a peak ends at this force (ours) */
#define AHEAD 0.1       /* part of the stroke whose mean is the following force (ours) */

/* Number of stages beyond which further ones reduce the error too little, from the integrals for 1
 * to n stages. */
static int stages_that_pay(const double *squares, int n, double nothing) {
    for (int few = 1; few < n; few++) {
        bool pays = false;
        double share = 1.0;
        for (int more = few + 1; more <= n; more++) {
            share *= PAYS;
            pays = pays || squares[more - 1] < share * squares[few - 1];
        }
        if (!pays || squares[few - 1] <= nothing)
            return few;
    }
    return n;
}

/* ---- plateaus ---- */

/* Best plateaus between grid strokes: cost and last break for every number of stages and end. */
typedef struct Table {
    double stroke[CELLS + 1];
    CzBranchSums sums[CELLS + 1];
    double cost[CZ_MAX_STAGES][CELLS + 1];
    int before[CZ_MAX_STAGES][CELLS + 1];
} Table;

static double cost_of(const Table *table, int from, int to) {
    const double length = table->stroke[to] - table->stroke[from];
    const double area = table->sums[to].area - table->sums[from].area;
    return table->sums[to].squares - table->sums[from].squares - area * area / length;
}

static void fill_table(Table *table, const CzBranch *branch, double from, int n_stage) {
    const double last = cz_branch_last(branch);
    for (int i = 0; i <= CELLS; i++) {
        table->stroke[i] = i == CELLS ? last : from + (last - from) * i / CELLS;
        table->sums[i] = cz_branch_sums(branch, table->stroke[i]);
        table->cost[0][i] = i > 0 ? cost_of(table, 0, i) : 0.0;
    }
    for (int n = 1; n < n_stage; n++)
        for (int to = 0; to <= CELLS; to++) {
            table->cost[n][to] = INFINITY;
            for (int at = n; at < to; at++) {
                const double cost = table->cost[n - 1][at] + cost_of(table, at, to);
                if (cost < table->cost[n][to]) {
                    table->cost[n][to] = cost;
                    table->before[n][to] = at;
                }
            }
        }
}

/* Strokes of the best n stages; the first begins at 0. */
static void store_breaks(const Table *table, int n_stage, double shortest, CzStaged *staged) {
    double end[CZ_MAX_STAGES];
    int at = CELLS;
    for (int i = n_stage - 1; i >= 0; i--) {
        end[i] = table->stroke[at];
        at = i > 0 ? table->before[i][at] : 0;
    }
    staged->n_stage = n_stage;
    for (int i = 0; i < n_stage; i++) {
        const double stroke = end[i] - (i > 0 ? end[i - 1] : 0.0);
        staged->stage[i] = (CzStage){.stroke = fmax(stroke, shortest), .end_force = NAN};
    }
}

/* A peak at the beginning that exceeds the following force. */
typedef struct Peak {
    bool is_there;
    double force, level; /* of the peak, and after it [N] */
    double end;          /* stroke at which the force has fallen to `level` [m] */
    double area;         /* between the peak and `level` [J] */
} Peak;

static Peak find_peak(const CzBranch *branch) {
    const double last = cz_branch_last(branch);
    const double within = fmin(PEAK_WITHIN * last, CZ_LONGEST_TRIGGER);
    Peak peak = {.force = 0.0};
    int top = 0;
    for (int i = 0; i < branch->n && branch->x[i] <= within; i++)
        if (branch->f[i] > branch->f[top])
            top = i;
    peak.force = branch->f[top];
    for (int i = top; i < branch->n && branch->x[i] <= within + AHEAD * last; i++) {
        peak.end = branch->x[i];
        peak.level = cz_branch_mean(branch, peak.end, fmin(peak.end + AHEAD * last, last));
        if (branch->f[i] <= DOWN * peak.level)
            break;
    }
    peak.area = cz_branch_sums(branch, peak.end).area - peak.level * peak.end;
    peak.is_there = peak.end > 0.0 && peak.end < within + AHEAD * last && peak.area > 0.0 &&
                    peak.force > PEAK_HEIGHT * peak.level;
    return peak;
}

/* The best n plateaus after a trigger peak. */
static double best_of(const Table *table, const CzBranch *branch, int n_stage, const Peak *peak,
                      double stiffness, CzStaged *staged) {
    const double last = cz_branch_last(branch);
    const double shortest = fmax(SHORTEST * last, 1.1 * CZ_SHORTEST_STAGE);
    const double energy = branch->area[branch->n - 1];
    store_breaks(table, n_stage, shortest, staged);
    if (!peak->is_there)
        return cz_staged_refine(staged, branch, energy, shortest);
    const double steep = (peak->force - peak->level) / stiffness; /* softer than the elasticity */
    const double least = fmax(fmax(1e-3, steep), shortest);
    const double length = 2.0 * peak->area / (peak->force - peak->level);
    const double room = n_stage > 1 ? staged->stage[0].stroke : last;
    staged->trigger = peak->force;
    staged->trigger_length = fmin(fmin(fmax(length, least), 0.9 * room), CZ_LONGEST_TRIGGER);
    return cz_staged_refine(staged, branch, energy, least);
}

bool cz_fit_plateaus(CzArena *arena, const CzBranch *branch, int n_stage, double stiffness,
                     CzStaged *staged) {
    const int n_most = n_stage > 0 ? n_stage : MAX_OF_OWN;
    Table *table = cz_arena_allocate(arena, 1, sizeof *table);
    CzStaged *found = cz_arena_allocate(arena, (size_t)n_most, sizeof *found);
    double squares[CZ_MAX_STAGES];
    if (table == NULL || found == NULL)
        return false;
    const Peak peak = find_peak(branch);
    fill_table(table, branch, peak.is_there ? peak.end : 0.0, n_most);
    for (int n = n_stage > 0 ? n_stage : 1; n <= n_most; n++) {
        found[n - 1] = cz_staged_begin(true);
        squares[n - 1] = best_of(table, branch, n, &peak, stiffness, &found[n - 1]);
    }
    const int n =
        n_stage > 0 ? n_stage : stages_that_pay(squares, n_most, cz_staged_rounding(branch));
    *staged = found[n - 1];
    return true;
}

/* ---- a line before plateaus ---- */

/* The curve read from its end. */
static bool mirror(CzArena *arena, const CzBranch *branch, CzBranch *mirrored) {
    if (!cz_branch_begin(arena, branch->n, mirrored))
        return false;
    for (int i = branch->n - 1; i >= 0; i--)
        cz_branch_add(mirrored, cz_branch_last(branch) - branch->x[i], branch->f[i]);
    return cz_branch_end(arena, mirrored);
}

double cz_fit_left_by_line(const CzBranch *branch, double to) {
    const CzBranchSums sums = cz_branch_sums(branch, to);
    const double through_zero = sums.squares - 3.0 * sums.moment * sums.moment / (to * to * to);
    const double mean = sums.area / to;
    const double turn = sums.moment - mean * to * to / 2.0; /* moment about the mean */
    const double slope = 12.0 * turn / (to * to * to);
    const bool is_preloaded = mean - slope * to / 2.0 > 0.0 && slope > 0.0;
    const double free = sums.squares - mean * mean * to - slope * turn;
    return is_preloaded ? fmin(through_zero, free) : through_zero;
}

/* The best end of the line before n plateaus; returns the squared error. */
static double split_before(const Table *table, const CzBranch *branch, int n, double *at) {
    double least = INFINITY;
    for (int i = 1; i < CELLS; i++) {
        const double from = cz_branch_last(branch) * i / CELLS;
        const double left = cz_fit_left_by_line(branch, from) + table->cost[n - 1][CELLS - i];
        if (left < least) {
            least = left;
            *at = from;
        }
    }
    return least;
}

bool cz_fit_split(CzArena *arena, const CzBranch *branch, int n_stage, double *at) {
    const int n_most = n_stage > 0 ? n_stage : MAX_OF_OWN;
    Table *table = cz_arena_allocate(arena, 1, sizeof *table);
    CzBranch mirrored;
    double left[CZ_MAX_STAGES], from[CZ_MAX_STAGES];
    if (table == NULL || !mirror(arena, branch, &mirrored))
        return false;
    fill_table(table, &mirrored, 0.0, n_most);
    for (int n = 1; n <= n_most; n++)
        left[n - 1] = split_before(table, branch, n, &from[n - 1]);
    *at = from[stages_that_pay(left, n_most, cz_staged_rounding(branch)) - 1];
    return true;
}

/* ---- lines ---- */

/* Strokes at which a line may end, rising: half of them evenly spread, half the curve's own
 * corners; returns how many, -1 without memory. */
static int likely_strokes(CzArena *arena, const CzBranch *branch, double shortest,
                          double stroke[LIKELY]) {
    const double last = cz_branch_last(branch);
    double *x = cz_arena_numbers(arena, SAMPLES), *f = cz_arena_numbers(arena, SAMPLES);
    CzCurveChange change;
    int n_corner = SAMPLES, n = 0;
    if (x == NULL || f == NULL)
        return -1;
    for (int i = 0; i < SAMPLES; i++) {
        x[i] = last * i / (SAMPLES - 1);
        f[i] = cz_branch_force(branch, x[i]);
    }
    if (!cz_reduce_curve(arena, x, f, &n_corner, LIKELY / 2 + 2, &change))
        return -1;
    for (int even = 1, corner = 1; even <= LIKELY / 2 || corner < n_corner - 1;) {
        const double next_even = even <= LIKELY / 2 ? last * even / (LIKELY / 2 + 1) : INFINITY;
        const double next_corner = corner < n_corner - 1 ? x[corner] : INFINITY;
        const double next = fmin(next_even, next_corner);
        even += next == next_even;
        corner += next == next_corner;
        if (next - (n > 0 ? stroke[n - 1] : 0.0) >= shortest && last - next >= shortest)
            stroke[n++] = next;
    }
    return n;
}

/* All sets of breaks among the likely strokes, in order. */
typedef struct Trial {
    const CzBranch *branch;
    const double *stroke;
    int n_stroke;
    CzStaged best;
    double squares; /* of the best */
} Trial;

static void try_set(Trial *trial, const int *set, CzStaged *staged) {
    double before = 0.0;
    for (int i = 0; i < staged->n_stage; i++) {
        const double end =
            i + 1 < staged->n_stage ? trial->stroke[set[i]] : cz_branch_last(trial->branch);
        staged->stage[i] = (CzStage){.stroke = end - before, .end_force = NAN};
        before = end;
    }
    const double energy = trial->branch->area[trial->branch->n - 1];
    const double squares = cz_staged_solve(staged, trial->branch, energy);
    if (squares < trial->squares) {
        trial->squares = squares;
        trial->best = *staged;
    }
}

/* Tries the sets one after the other, in the order of the digits of a number. */
static void try_all(Trial *trial, CzStaged staged) {
    int set[MAX_LINES] = {0};
    const int n = staged.n_stage - 1;
    for (int i = 0; i < n; i++)
        set[i] = i;
    while (n == 0 || set[n - 1] < trial->n_stroke) {
        try_set(trial, set, &staged);
        int digit = n - 1;
        while (digit > 0 && set[digit] == trial->n_stroke - n + digit)
            digit--;
        if (n == 0)
            return;
        set[digit]++;
        for (int i = digit + 1; i < n; i++)
            set[i] = set[i - 1] + 1;
    }
}

static double best_lines(const CzBranch *branch, const double *stroke, int n_stroke,
                         double shortest, CzStaged *staged) {
    Trial trial = {.branch = branch, .stroke = stroke, .n_stroke = n_stroke, .squares = INFINITY};
    try_all(&trial, *staged);
    if (trial.squares < INFINITY)
        *staged = trial.best;
    return cz_staged_refine(staged, branch, branch->area[branch->n - 1], shortest);
}

bool cz_fit_lines(CzArena *arena, const CzBranch *branch, const CzLines *lines, CzStaged *staged) {
    double stroke[LIKELY], squares[MAX_LINES];
    CzStaged found[MAX_LINES];
    const double shortest = fmax(lines->shortest * cz_branch_last(branch), 1.1 * CZ_SHORTEST_STAGE);
    const int n_stroke = likely_strokes(arena, branch, shortest, stroke);
    if (n_stroke < 0)
        return false;
    const int room = n_stroke + 1; /* largest number of stages between the strokes */
    const int n_requested = lines->n_stage > 0 ? lines->n_stage : lines->n_most;
    const int last = n_requested < room ? n_requested : room,
              n_stage = lines->n_stage > 0 ? last : -1;
    for (int n = n_stage > 0 ? n_stage : 1; n <= last; n++) {
        found[n - 1] = cz_staged_begin(false);
        found[n - 1].n_stage = n;
        found[n - 1].has_preload = lines->has_preload;
        squares[n - 1] = best_lines(branch, stroke, n_stroke, shortest, &found[n - 1]);
    }
    const int n =
        n_stage > 0 ? n_stage : stages_that_pay(squares, last, cz_staged_rounding(branch));
    *staged = found[n - 1];
    return !arena->out_of_memory;
}
