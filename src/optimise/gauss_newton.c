/* Gauss-Newton method with Levenberg-Marquardt damping, within bounds.
 *
 *   r(u + p) ~ r + J p          J by secants, n designs side by side
 *   minimise |r + J p|^2 + damping |p|^2   with 0 <= u + p <= 1
 *
 * The small problem is solved exactly by cyclic minimisation over its variables within the bounds;
 * three dampings are tried side by side. Residuals are smooth where their sum of squares is not yet
 * quadratic, so this requires a tenth of the evaluations of methods that use the sum alone. Further
 * constraints of the problem are residuals as long as they are violated.
 */
#include "optimise/gauss_newton.h"
#include "base/arena.h"
#include "base/error.h"

#include <math.h>
#include <string.h>

enum { DAMPINGS = 3, SWEEPS = 300 };

typedef struct Newton {
    CzArena arena;
    CzSearch *search;
    const char *phase;
    int n, m, n_detail;  /* numbers of variables, of residuals, of residuals that are matches */
    double *u, *r, f;    /* base (n), its residuals (m) and their sum of squares */
    double *slope;       /* J (m x n) */
    double *x, *many_f;  /* (most x n), (most) with `most` designs side by side */
    double *many_c;      /* (most x n_constraint) */
    double *many_d;      /* (most x n_detail) */
    double *many_r;      /* (most x m) */
    double *tried;       /* scaled designs (most x n) */
    double *rest, *norm; /* scratch (m), (n) */
} Newton;

static bool create(Newton *newton, CzSearch *search, const char *phase) {
    const size_t n = (size_t)search->function->n_variable;
    const size_t n_constraint = (size_t)search->function->n_constraint;
    const size_t n_detail = (size_t)cz_search_n_detail(search), m = n_detail + n_constraint;
    const size_t most = n > DAMPINGS ? n : DAMPINGS;
    *newton = (Newton){
        .search = search, .phase = phase, .n = (int)n, .m = (int)m, .n_detail = (int)n_detail};
    CzArena *arena = &newton->arena;
    newton->u = cz_arena_numbers(arena, n);
    newton->r = cz_arena_numbers(arena, m);
    newton->slope = cz_arena_numbers(arena, m * n);
    newton->x = cz_arena_numbers(arena, most * n);
    newton->many_f = cz_arena_numbers(arena, most);
    newton->many_c = cz_arena_numbers(arena, most * n_constraint);
    newton->many_d = cz_arena_numbers(arena, most * n_detail);
    newton->many_r = cz_arena_numbers(arena, most * m);
    newton->tried = cz_arena_numbers(arena, most * n);
    newton->rest = cz_arena_numbers(arena, m);
    newton->norm = cz_arena_numbers(arena, n);
    return !arena->out_of_memory;
}

static double sum_of_squares(const double *r, int m) {
    double sum = 0;
    for (int k = 0; k < m; k++)
        sum += r[k] * r[k];
    return sum;
}

/* Evaluates designs of `tried` and collects their residuals. */
static bool evaluate(Newton *newton, int n_point) {
    const CzFunction *function = newton->search->function;
    cz_search_unscale(newton->search, n_point, newton->tried, newton->x);
    if (!cz_search_evaluate(newton->search, newton->phase, n_point, newton->x, newton->many_f,
                            newton->many_c, newton->many_d))
        return false;
    const long first = newton->search->n_record - n_point;
    for (int i = 0; i < n_point; i++) {
        double *r = newton->many_r + i * newton->m;
        memcpy(r, newton->many_d + i * newton->n_detail, (size_t)newton->n_detail * sizeof *r);
        for (int j = 0; j < function->n_constraint; j++)
            r[newton->n_detail + j] =
                cz_constraint_kind(function, j) == CZ_CONSTRAINT_GRADED
                    ? cz_search_residual(newton->many_c[i * function->n_constraint + j])
                    : 0;
        newton->many_f[i] = isnan(newton->search->record[first + i].objective)
                                ? INFINITY
                                : sum_of_squares(r, newton->m);
    }
    return true;
}

static void move_to(Newton *newton, int point) {
    memcpy(newton->u, newton->tried + point * newton->n, (size_t)newton->n * sizeof(double));
    memcpy(newton->r, newton->many_r + point * newton->m, (size_t)newton->m * sizeof(double));
    newton->f = newton->many_f[point];
}

/* Secants around the base, away from the nearer bound. The slopes of a variable whose design failed
 * are 0, so that it does not move. */
static bool find_slopes(Newton *newton, double secant) {
    const int n = newton->n, m = newton->m;
    for (int i = 0; i < n; i++) {
        memcpy(newton->tried + i * n, newton->u, (size_t)n * sizeof(double));
        newton->tried[i * n + i] += newton->u[i] > 0.5 ? -secant : secant;
    }
    if (!evaluate(newton, n))
        return false;
    for (int i = 0; i < n; i++) {
        const double h = newton->u[i] > 0.5 ? -secant : secant;
        for (int k = 0; k < m; k++)
            newton->slope[k * n + i] =
                isinf(newton->many_f[i]) ? 0 : (newton->many_r[i * m + k] - newton->r[k]) / h;
    }
    return true;
}

/* The best step with a damping, by cyclic minimisation over the variables. */
static void solve(Newton *newton, double damping, double *u) {
    const int n = newton->n, m = newton->m;
    memcpy(newton->rest, newton->r, (size_t)m * sizeof(double));
    memcpy(u, newton->u, (size_t)n * sizeof(double));
    for (int i = 0; i < n; i++) {
        newton->norm[i] = damping;
        for (int k = 0; k < m; k++)
            newton->norm[i] += newton->slope[k * n + i] * newton->slope[k * n + i];
    }
    double change = 1;
    for (int sweep = 0; sweep < SWEEPS && change > 1e-12; sweep++) {
        change = 0;
        for (int i = 0; i < n; i++) {
            double gradient = damping * (u[i] - newton->u[i]);
            for (int k = 0; k < m; k++)
                gradient += newton->slope[k * n + i] * newton->rest[k];
            const double wanted = newton->norm[i] > 0 ? u[i] - gradient / newton->norm[i] : u[i];
            const double step = fmin(fmax(wanted, 0), 1) - u[i];
            u[i] += step;
            for (int k = 0; k < m; k++)
                newton->rest[k] += newton->slope[k * n + i] * step;
            change = fmax(change, fabs(step));
        }
    }
}

/* Tries three dampings and moves to the best design if it is an improvement. Returns the length of
 * the step, 0 without an improvement, below 0 when the search is over. */
static double try_step(Newton *newton, double *damping) {
    for (int k = 0; k < DAMPINGS; k++)
        solve(newton, *damping * pow(10, 2 * (k - 1)), newton->tried + k * newton->n);
    if (!evaluate(newton, DAMPINGS))
        return -1;
    int best = 0;
    for (int k = 1; k < DAMPINGS; k++)
        best = newton->many_f[k] < newton->many_f[best] ? k : best;
    *damping *= pow(10, best - 1);
    if (!(newton->many_f[best] < newton->f)) {
        *damping *= 100;
        return 0;
    }
    double length = 0;
    for (int i = 0; i < newton->n; i++)
        length = fmax(length, fabs(newton->tried[best * newton->n + i] - newton->u[i]));
    move_to(newton, best);
    return length;
}

static void descend(Newton *newton, long evaluations) {
    const CzSearch *search = newton->search;
    const long limit = search->n_record + evaluations;
    const long round = newton->n + DAMPINGS;
    double secant = 1e-2, damping = 1e-2;
    for (int n_idle = 0; n_idle < 4 && search->n_record + round <= limit;) {
        const double before = newton->f;
        if (!find_slopes(newton, secant))
            return;
        damping = fmax(damping, 1e-9);
        const double length = try_step(newton, &damping);
        if (length < 0)
            return;
        n_idle = newton->f < 0.999 * before ? 0 : n_idle + 1;
        secant = fmin(fmax(length > 0 ? length / 3 : secant / 5, 1e-6), 1e-2);
    }
}

CzStatus cz_gauss_newton(CzSearch *search, const char *phase, const double *u, long evaluations,
                         CzError *error) {
    Newton newton;
    CzStatus status = CZ_OK;
    if (!create(&newton, search, phase)) {
        status = cz_no_memory(error, "a fit");
    } else {
        memcpy(newton.tried, u, (size_t)newton.n * sizeof *u);
        if (evaluate(&newton, 1) && isfinite(newton.many_f[0])) {
            move_to(&newton, 0);
            descend(&newton, evaluations - 1);
        }
    }
    cz_arena_free(&newton.arena);
    return status;
}
