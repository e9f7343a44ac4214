/* One branch of a measured curve and its integrals. */
#include "fit/branch.h"

#include "problem/trace.h"

bool cz_branch_begin(CzArena *arena, int n, CzBranch *branch) {
    double **const rows[] = {&branch->x, &branch->f, &branch->area, &branch->moment,
                             &branch->squares};
    branch->n = 0;
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

bool cz_branch_end(CzArena *arena, CzBranch *branch) {
    if (!cz_trace_raise(arena, branch->x, branch->n, branch->x))
        return false;
    branch->area[0] = branch->moment[0] = branch->squares[0] = 0.0;
    for (int i = 1; i < branch->n; i++) {
        const CzBranchSums piece = over_piece(branch->x[i - 1], branch->f[i - 1],
                                              branch->x[i] - branch->x[i - 1], branch->f[i]);
        branch->area[i] = branch->area[i - 1] + piece.area;
        branch->moment[i] = branch->moment[i - 1] + piece.moment;
        branch->squares[i] = branch->squares[i - 1] + piece.squares;
    }
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
    double last = cz_branch_force(branch, to);
    if (!cz_branch_begin(arena, branch->n + 2, part))
        return false;
    cz_branch_add(part, 0.0, cz_branch_force(branch, from));
    for (int i = 0; i < branch->n; i++)
        if (branch->x[i] > from && branch->x[i] < to)
            cz_branch_add(part, branch->x[i] - from, branch->f[i]);
    for (int i = branch->n - 1; i >= 0; i--) /* at a jump at the end, the force before it */
        last = branch->x[i] == to ? branch->f[i] : last;
    cz_branch_add(part, to - from, last);
    return cz_branch_end(arena, part);
}
