/* NLopt as one function.
 *
 * NLopt requests the objective and the constraints one after the other at the same point, so the
 * last point is stored and evaluated only once. Gradients are secants: n further designs are
 * evaluated side by side. NLopt receives finite numbers only, always has a limit and a tolerance,
 * and its result is not used: the search keeps the best design.
 */
#include "optimise/nlopt_adapter.h"
#include "base/arena.h"
#include "base/error.h"
#include "base/suggest.h"

#include <math.h>
#include <nlopt.h>
#include <stdio.h>
#include <string.h>

/* ---- algorithms by name ---------------------------------------------------------------------- */

static bool is_compiled_in(nlopt_algorithm algorithm) {
    return strstr(nlopt_algorithm_name(algorithm), "NOT COMPILED") == NULL;
}

int cz_n_algorithm(void) {
    int n = 0;
    for (int i = 0; i < NLOPT_NUM_ALGORITHMS; i++)
        n += is_compiled_in((nlopt_algorithm)i);
    return n;
}

const char *cz_algorithm_name(int index) {
    for (int i = 0; i < NLOPT_NUM_ALGORITHMS; i++)
        if (is_compiled_in((nlopt_algorithm)i) && index-- == 0)
            return nlopt_algorithm_to_string((nlopt_algorithm)i);
    return NULL;
}

void cz_nlopt_version(char *text, size_t n) {
    int major, minor, bugfix;
    nlopt_version(&major, &minor, &bugfix);
    snprintf(text, n, "%d.%d.%d", major, minor, bugfix);
}

/* Number of the algorithm with this name, -1 when there is none. */
static int find_algorithm(const char *name) {
    for (int i = 0; i < NLOPT_NUM_ALGORITHMS; i++)
        if (strcmp(nlopt_algorithm_to_string((nlopt_algorithm)i), name) == 0)
            return i;
    return -1;
}

CzStatus cz_nlopt_check(const char *algorithm, CzError *error) {
    const int number = find_algorithm(algorithm);
    if (number >= 0 && is_compiled_in((nlopt_algorithm)number))
        return CZ_OK;
    if (number >= 0)
        return cz_fail(error, CZ_STATUS_INPUT,
                       "the NLopt library of this system was built without the algorithm '%s'",
                       algorithm);
    CzSuggestion nearest = {0};
    for (int i = 0; i < cz_n_algorithm(); i++)
        cz_suggest(&nearest, algorithm, cz_algorithm_name(i));
    const CzStatus status =
        cz_fail(error, CZ_STATUS_INPUT, "there is no algorithm '%s'", algorithm);
    if (error != NULL)
        snprintf(error->help, sizeof error->help, "%s%s%s'auto' is the usual choice",
                 nearest.best[0] != '\0' ? "did you mean '" : "", nearest.best,
                 nearest.best[0] != '\0' ? "'? " : "");
    return status;
}

CzNloptRun cz_nlopt_run_default(const char *algorithm) {
    return (CzNloptRun){.algorithm = algorithm,
                        .phase = "search",
                        .form = CZ_FORM_NATIVE,
                        .evaluations = 1000000000,
                        .weight = 10,
                        .reserve = 1e-4,
                        .secant = 1e-3,
                        .first_step = 0,
                        .tolerance = 1e-4,
                        .seed = 1};
}

/* ---- NLopt's callbacks and the search -------------------------------------------------------- */

typedef struct Bridge {
    CzArena arena;
    CzSearch *search;
    const CzNloptRun *run;
    nlopt_opt opt;
    int n, m;     /* variables and constraints of the search */
    bool elastic; /* with the additional variable s */
    bool penalty; /* constraints are part of the objective */
    long limit;   /* evaluations of the search at which this run ends */
    double scale; /* of the objective */

    double *u; /* scaled variables of the remembered point (n) */
    bool has_value, has_gradient;
    double f, *c;                /* objective / scale, constraints + reserve (m) */
    double *df, *dc;             /* their gradients (n), (m x n) */
    double *x, *many_f, *many_c; /* scratch for n + 1 designs */
} Bridge;

static bool bridge_allocate(Bridge *bridge) {
    const size_t n = (size_t)bridge->n, m = (size_t)bridge->m;
    bridge->u = cz_arena_numbers(&bridge->arena, n);
    bridge->c = cz_arena_numbers(&bridge->arena, m);
    bridge->df = cz_arena_numbers(&bridge->arena, n);
    bridge->dc = cz_arena_numbers(&bridge->arena, m * n);
    bridge->x = cz_arena_numbers(&bridge->arena, (n + 1) * n);
    bridge->many_f = cz_arena_numbers(&bridge->arena, n + 1);
    bridge->many_c = cz_arena_numbers(&bridge->arena, (n + 1) * m);
    return !bridge->arena.out_of_memory;
}

/* Evaluates n_point designs of bridge->x, or stops NLopt where the search or this run's share of it
 * ends; it does so at every call, because a nested algorithm ignores an earlier stop. */
static bool evaluate(Bridge *bridge, int n_point) {
    if (bridge->search->n_record + n_point > bridge->limit ||
        !cz_search_evaluate(bridge->search, bridge->run->phase, n_point, bridge->x, bridge->many_f,
                            bridge->many_c, NULL)) {
        nlopt_force_stop(bridge->opt);
        return false;
    }
    return true;
}

/* Makes sure that the value (and gradient) at u is known; false once the run has ended. */
static bool prepare(Bridge *bridge, const double *given, bool with_gradient) {
    const int n = bridge->n, m = bridge->m;
    const CzFunction *function = bridge->search->function;
    const bool same = bridge->has_value && memcmp(bridge->u, given, (size_t)n * sizeof *given) == 0;
    if (same && (bridge->has_gradient || !with_gradient))
        return true;
    double *u = bridge->u;
    memcpy(u, given, (size_t)n * sizeof *u);
    int n_point = 0;
    if (!same)
        cz_search_unscale(bridge->search, 1, u, bridge->x + n * n_point++);
    for (int i = 0; with_gradient && i < n; i++, n_point++) {
        const double kept = u[i];
        u[i] = fmin(fmax(kept, 0), 1);
        u[i] += cz_search_secant(u[i], bridge->run->secant);
        cz_search_unscale(bridge->search, 1, u, bridge->x + n * n_point);
        u[i] = kept;
    }
    bridge->has_value = same;
    bridge->has_gradient = false;
    if (!evaluate(bridge, n_point))
        return false;
    if (!same) {
        bridge->f = bridge->many_f[0] / bridge->scale;
        for (int j = 0; j < m; j++)
            bridge->c[j] = bridge->many_c[j] + bridge->run->reserve;
    }
    bridge->has_value = true;
    bridge->has_gradient = with_gradient;
    for (int i = 0; with_gradient && i < n; i++) {
        const int point = i + !same;
        const double h = cz_search_secant(fmin(fmax(u[i], 0), 1), bridge->run->secant);
        bridge->df[i] = (bridge->many_f[point] / bridge->scale - bridge->f) / h;
        for (int j = 0; j < m; j++)
            bridge->dc[j * n + i] = (bridge->many_c[point * function->n_constraint + j] +
                                     bridge->run->reserve - bridge->c[j]) /
                                    h;
    }
    return true;
}

/* Objective in the form of this run. After a stop the number is not used, but is finite. */
static double objective(unsigned n_all, const double *u, double *gradient, void *data) {
    Bridge *bridge = data;
    const int n = bridge->n;
    const double s = bridge->elastic ? u[n] : 0;
    (void)n_all;
    if (!prepare(bridge, u, gradient != NULL)) {
        for (unsigned i = 0; gradient != NULL && i < n_all; i++)
            gradient[i] = 0;
        return bridge->f;
    }
    const bool is_minimax = bridge->elastic && bridge->search->function->is_minimax;
    const double slope = is_minimax ? 1 : bridge->run->weight;
    double value = (is_minimax ? 0 : bridge->f) + slope * s * bridge->elastic;
    for (int i = 0; gradient != NULL && i < n; i++)
        gradient[i] = is_minimax ? 0 : bridge->df[i];
    if (gradient != NULL && bridge->elastic)
        gradient[n] = slope;
    for (int j = 0; bridge->penalty && j < bridge->m; j++) {
        if (bridge->c[j] <= 0)
            continue;
        value += bridge->run->weight * bridge->c[j];
        for (int i = 0; gradient != NULL && i < n; i++)
            gradient[i] += bridge->run->weight * bridge->dc[j * n + i];
    }
    return value;
}

/* Returns all constraints at once. */
static void constraints(unsigned m, double *result, unsigned n_all, const double *u,
                        double *gradient, void *data) {
    Bridge *bridge = data;
    const int n = bridge->n;
    const bool ready = prepare(bridge, u, gradient != NULL);
    for (unsigned j = 0; j < m; j++) {
        result[j] = bridge->c[j] - (bridge->elastic ? u[n] : 0);
        if (gradient == NULL)
            continue;
        for (int i = 0; i < n; i++)
            gradient[j * n_all + (unsigned)i] = ready ? bridge->dc[(int)j * n + i] : 0;
        if (bridge->elastic)
            gradient[j * n_all + (unsigned)n] = -1;
    }
}

/* ---- one run --------------------------------------------------------------------------------- */

/* Algorithms that need a local optimizer. */
static bool needs_local(nlopt_algorithm algorithm) {
    const char *name = nlopt_algorithm_to_string(algorithm);
    return strstr(name, "AUGLAG") != NULL || strstr(name, "MLSL") != NULL;
}

static bool uses_gradients(nlopt_algorithm algorithm) {
    const char *name = nlopt_algorithm_to_string(algorithm);
    return strncmp(name, "LD_", 3) == 0 || strncmp(name, "GD_", 3) == 0;
}

/* The local optimizer of an algorithm. It must accept bounds, and inequalities where the outer
 * algorithm (AUGLAG_EQ) passes them on. */
static nlopt_algorithm choose_local(const Bridge *bridge, nlopt_algorithm algorithm) {
    const bool passes_on = strstr(nlopt_algorithm_to_string(algorithm), "AUGLAG_EQ") != NULL;
    if (uses_gradients(algorithm))
        return passes_on ? NLOPT_LD_SLSQP : NLOPT_LD_LBFGS;
    return passes_on || bridge->n == 1 ? NLOPT_LN_COBYLA : NLOPT_LN_BOBYQA;
}

static nlopt_result set_local(const Bridge *bridge, nlopt_algorithm algorithm) {
    nlopt_opt local =
        nlopt_create(choose_local(bridge, algorithm), (unsigned)(bridge->n + bridge->elastic));
    if (local == NULL)
        return NLOPT_OUT_OF_MEMORY;
    nlopt_set_xtol_abs1(local, bridge->run->tolerance);
    nlopt_set_maxeval(local, 100 * (bridge->n + 1));
    const nlopt_result result = nlopt_set_local_optimizer(bridge->opt, local);
    nlopt_destroy(local);
    return result;
}

/* Largest number of calls of this run; some algorithms allocate memory for that many. */
static int most_calls(const Bridge *bridge) {
    const long left = cz_search_left(bridge->search);
    const long share = bridge->run->evaluations < left ? bridge->run->evaluations : left;
    return share < 10000000 ? (int)share + 1 : 10000000;
}

/* Sets bounds, tolerances, limit and first step: everything except objective and constraints. */
static nlopt_result set_frame(Bridge *bridge, nlopt_algorithm algorithm, double most_s) {
    const CzNloptRun *run = bridge->run;
    nlopt_opt opt = bridge->opt;
    nlopt_result result = nlopt_set_lower_bounds1(opt, 0);
    if (result > 0)
        result = nlopt_set_upper_bounds1(opt, 1);
    if (result > 0 && bridge->elastic) {
        result = nlopt_set_upper_bound(opt, bridge->n, most_s);
        if (result > 0 && bridge->search->function->is_minimax)
            result = nlopt_set_lower_bound(opt, bridge->n, -1);
    }
    if (result > 0)
        result = nlopt_set_xtol_abs1(opt, run->tolerance);
    if (result > 0)
        result = nlopt_set_maxeval(opt, most_calls(bridge));
    if (result > 0 && run->first_step > 0)
        result = nlopt_set_initial_step1(opt, run->first_step);
    if (result > 0 && strstr(run->algorithm, "ISRES") != NULL)
        result = nlopt_set_population(opt, 50); /* its default is a random search at our sizes */
    if (result > 0 && needs_local(algorithm))
        result = set_local(bridge, algorithm);
    return result;
}

static nlopt_result set_functions(Bridge *bridge) {
    nlopt_result result = nlopt_set_min_objective(bridge->opt, objective, bridge);
    if (result < 0 || bridge->penalty || bridge->m == 0)
        return result;
    result = nlopt_add_inequality_mconstraint(bridge->opt, (unsigned)bridge->m, constraints, bridge,
                                              NULL); /* tolerances of 0 */
    if (result == NLOPT_INVALID_ARGS && bridge->run->form == CZ_FORM_NATIVE) {
        bridge->penalty = true; /* bounds only */
        return NLOPT_SUCCESS;
    }
    return result;
}

/* Runs a bridge that is set up; `variables` are n, and s if elastic. */
static nlopt_result start(Bridge *bridge, nlopt_algorithm algorithm, double *variables) {
    const int n = bridge->n;
    double largest = 0;
    if (bridge->elastic) {
        if (!prepare(bridge, variables, false))
            return NLOPT_FORCED_STOP;
        largest = bridge->search->function->is_minimax ? -1 : 0;
        for (int j = 0; j < bridge->m; j++)
            largest = fmax(largest, bridge->c[j]);
        variables[n] = largest;
    }
    const double most_s = 2 * fmax(largest, 0) + 1;
    nlopt_result result = set_frame(bridge, algorithm, most_s);
    if (result > 0)
        result = set_functions(bridge);
    if (result < 0)
        return result;
    double value;
    nlopt_srand(bridge->run->seed);
    return nlopt_optimize(bridge->opt, variables, &value);
}

static CzStatus judge_result(const Bridge *bridge, nlopt_result result, CzError *error) {
    if (result == NLOPT_OUT_OF_MEMORY)
        return cz_no_memory(error, bridge->run->algorithm);
    if (result == NLOPT_INVALID_ARGS)
        return cz_fail(error, CZ_STATUS_INPUT,
                       "the algorithm %s does not take a problem with %d variables and %d "
                       "constraints; 'auto' does",
                       bridge->run->algorithm, bridge->n, bridge->m);
    return CZ_OK; /* the best design is in the search, however NLopt ended */
}

CzStatus cz_nlopt_run(CzSearch *search, const CzNloptRun *run, const double *u, CzError *error) {
    CZ_TRY(cz_nlopt_check(run->algorithm, error));
    const nlopt_algorithm algorithm = (nlopt_algorithm)find_algorithm(run->algorithm);
    const CzFunction *function = search->function;
    Bridge bridge = {.search = search,
                     .run = run,
                     .n = function->n_variable,
                     .m = function->n_constraint,
                     .elastic = run->form == CZ_FORM_ELASTIC && function->n_constraint > 0,
                     .penalty = run->form == CZ_FORM_PENALTY,
                     .limit = search->n_record + run->evaluations,
                     .scale = 1};
    if (search->best >= 0) {
        const double size = fabs(search->record[search->best].objective);
        bridge.scale = size > 1e-9 && !function->is_minimax ? size : 1;
    }
    const int n_all = bridge.n + bridge.elastic;
    double *variables = cz_arena_numbers(&bridge.arena, (size_t)n_all);
    bridge.opt = nlopt_create(algorithm, (unsigned)n_all);
    CzStatus status = CZ_OK;
    if (bridge.opt == NULL || !bridge_allocate(&bridge)) {
        status = cz_no_memory(error, run->algorithm);
    } else {
        for (int i = 0; i < bridge.n; i++)
            variables[i] = fmin(fmax(u[i], 0), 1);
        status = judge_result(&bridge, start(&bridge, algorithm, variables), error);
    }
    nlopt_destroy(bridge.opt);
    cz_arena_free(&bridge.arena);
    return status;
}
