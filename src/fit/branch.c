/* One branch of a measured curve and its integrals. */
#include "fit/branch.h"

#include <string.h>

#include "problem/trace.h"

static bool make_room(CzArena *arena, int n, CzBranch *branch) {
    double **const rows[] = {&branch->x, &branch->f, &branch->area, &branch->moment,
                             &branch->squares};
    branch->n = n;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        *rows[i] = cz_arena_numbers(arena, (size_t)n);
        if (*rows[i] == NULL)
            return false;
    }
    return true;
}

/* Integrals of f, f x and f^2 over a straight piece from (x, f) to (x + h, f_end). */
static CzBranchSums over_piece(double x, double f, double h, double f_end) {
    return (CzBranchSums){
        .area = 0.5 * h * (f + f_end),
        .moment = h * (0.5 * x * (f + f_end) + h * (f + 2.0 * f_end) / 6.0),
        .squares = h * (f * f + f * f_end + f_end * f_end) / 3.0,
    };
}

static void sum_up(CzBranch *branch) {
    branch->area[0] = branch->moment[0] = branch->squares[0] = 0.0;
    for (int i = 1; i < branch->n; i++) {
        const CzBranchSums piece = over_piece(branch->x[i - 1], branch->f[i - 1],
                                              branch->x[i] - branch->x[i - 1], branch->f[i]);
        branch->area[i] = branch->area[i - 1] + piece.area;
        branch->moment[i] = branch->moment[i - 1] + piece.moment;
        branch->squares[i] = branch->squares[i - 1] + piece.squares;
    }
}

bool cz_branch_build(CzArena *arena, int n, const double *x, const double *f, CzBranch *branch) {
    if (!make_room(arena, n, branch) || !cz_trace_raise(arena, x, n, branch->x))
        return false;
    memcpy(branch->f, f, (size_t)n * sizeof *f);
    sum_up(branch);
    return true;
}

/* Index of the last point at or before a stroke; 0 when there is none. */
static int find(const CzBranch *branch, double x) {
    int low = 0, high = branch->n;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if (branch->x[middle] <= x)
            low = middle;
        else
            high = middle;
    }
    return low;
}

double cz_branch_force(const CzBranch *branch, double x) {
    const int i = find(branch, x);
    if (i + 1 == branch->n || x <= branch->x[i])
        return branch->f[i];
    const double share = (x - branch->x[i]) / (branch->x[i + 1] - branch->x[i]);
    return branch->f[i] + share * (branch->f[i + 1] - branch->f[i]);
}

CzBranchSums cz_branch_sums(const CzBranch *branch, double x) {
    const int i = find(branch, x);
    const double h = x - branch->x[i];
    CzBranchSums sums = {branch->area[i], branch->moment[i], branch->squares[i]};
    if (i + 1 < branch->n && h > 0.0) {
        const CzBranchSums piece =
            over_piece(branch->x[i], branch->f[i], h, cz_branch_force(branch, x));
        sums.area += piece.area;
        sums.moment += piece.moment;
        sums.squares += piece.squares;
    }
    return sums;
}

double cz_branch_mean(const CzBranch *branch, double from, double to) {
    if (!(to > from))
        return cz_branch_force(branch, from);
    return (cz_branch_sums(branch, to).area - cz_branch_sums(branch, from).area) / (to - from);
}

bool cz_branch_cut(CzArena *arena, const CzBranch *branch, double from, double to, CzBranch *part) {
    int n = 0;
    double *x = cz_arena_numbers(arena, (size_t)branch->n + 2);
    double *f = cz_arena_numbers(arena, (size_t)branch->n + 2);
    if (x == NULL || f == NULL)
        return false;
    x[n] = 0.0;
    f[n++] = cz_branch_force(branch, from);
    for (int i = 0; i < branch->n; i++)
        if (branch->x[i] > from && branch->x[i] < to) {
            x[n] = branch->x[i] - from;
            f[n++] = branch->f[i];
        }
    x[n] = to - from;
    f[n] = cz_branch_force(branch, to);
    /* At a jump that ends the part, the force before it. */
    for (int i = 0; i < branch->n; i++)
        if (branch->x[i] == to) {
            f[n] = branch->f[i];
            break;
        }
    return cz_branch_build(arena, n + 1, x, f, part);
}
