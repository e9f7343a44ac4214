/* The adversary of a corridor: COBYLA minimises the smallest margin over the factors of a curve
 * between the edges of a corridor. It ends with the first curve that fails. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "evaluate/tasks.h"
#include "optimise/corridor.h"
#include "optimise/nlopt_adapter.h"

enum { MAX_SEARCHES = 4 };

/* One search from one curve, with curves of its own. */
typedef struct Adversary {
    CzCorridor *corridor;
    const CzTriedCurve *start;
    int most, n;         /* limit of curves, and those that were run */
    CzTriedCurve *curve; /* (most) */
} Adversary;

/* Runs the curves that the algorithm asks for; interrupted when no further one is allowed, or one
 * fails, which ends the search. */
static CzStatus evaluate(void *data, int n_point, const double *factor, double *objective,
                         double *constraint, double *detail, CzError *error) {
    Adversary *own = data;
    const int n_factor = cz_corridor_n_factor(own->corridor);
    (void)constraint;
    (void)detail;
    for (int k = 0; k < n_point; k++) {
        if (own->n == own->most || (own->n > 0 && !cz_curve_passes(&own->curve[own->n - 1])))
            return CZ_STATUS_INTERRUPTED;
        CzTriedCurve *curve = &own->curve[own->n];
        *curve = (CzTriedCurve){
            .shape = CZ_CURVE_ADVERSARY, .number = own->n + 1, .sample = own->start->sample};
        memcpy(curve->factor, factor + k * n_factor, (size_t)n_factor * sizeof *factor);
        CZ_TRY(cz_corridor_run_in_thread(own->corridor, 1, curve, error));
        own->n++;
        objective[k] = curve->state == CZ_SAMPLE_DONE ? curve->margin : NAN;
    }
    return CZ_OK;
}

/* Bounds of the factors. */
typedef struct Bounds {
    double low[CZ_MAX_FACTORS], high[CZ_MAX_FACTORS], step[CZ_MAX_FACTORS];
} Bounds;

static CzStatus run_search(Adversary *own, const Bounds *bounds, CzError *error) {
    const int n = cz_corridor_n_factor(own->corridor);
    double u[CZ_MAX_FACTORS];
    const CzFunction function = {.n_variable = n,
                                 .min = bounds->low,
                                 .max = bounds->high,
                                 .start = own->start->factor,
                                 .step = bounds->step,
                                 .is_minimax = true,
                                 .evaluate = evaluate,
                                 .data = own};
    CzOptimiseOptions options = cz_optimise_options_default();
    CzSearch search;
    options.evaluations = own->most;
    options.stop = own->corridor->parts->options.stop;
    for (int i = 0; i < n; i++)
        u[i] = (own->start->factor[i] - bounds->low[i]) / (bounds->high[i] - bounds->low[i]);
    cz_search_init(&search, &function, &options);
    CzNloptRun run = cz_nlopt_run_default("LN_COBYLA");
    run.phase = "adversary";
    run.evaluations = own->most;
    run.first_step = 0.25;
    run.tolerance = 1e-2;
    CzStatus status = cz_nlopt_run(&search, &run, u, error);
    if (status == CZ_OK && search.status == CZ_STATUS_NO_MEMORY)
        status = cz_no_memory(error, "the search of a corridor");
    cz_search_free(&search);
    return status;
}

/* Searches side by side. */
typedef struct Round {
    Bounds bounds;
    Adversary adversary[MAX_SEARCHES];
} Round;

static CzStatus run_task(int index, void *data, CzError *error) {
    Round *round = data;
    return run_search(&round->adversary[index], &round->bounds, error);
}

static bool request_adversary(int index, void *data, CzMemoryText *request) {
    const Round *round = data;
    const Adversary *adversary = &round->adversary[index];
    cz_put_int(request, CZ_CORRIDOR_ADVERSARY);
    cz_put_int(request, adversary->most);
    cz_put(request, &round->bounds, 1, sizeof round->bounds);
    cz_put(request, adversary->start, 1, sizeof *adversary->start);
    return !cz_corridor_is_stopped(adversary->corridor);
}

static CzStatus take_adversary(int index, void *data, CzReading *answer, CzError *error) {
    Adversary *adversary = &((Round *)data)->adversary[index];
    const int n = cz_get_int(answer);
    if (n < 0 || n > adversary->most)
        return cz_no_memory(error, "the results of an adversary");
    adversary->n = n;
    cz_get(answer, adversary->curve, (size_t)n, sizeof *adversary->curve);
    return answer->has_ended ? cz_no_memory(error, "the results of an adversary") : CZ_OK;
}

CzStatus cz_corridor_answer_adversary(CzCorridor *corridor, CzReading *request,
                                      CzMemoryText *answer, CzError *error) {
    Bounds bounds;
    CzTriedCurve start;
    Adversary own = {.corridor = corridor, .start = &start, .most = cz_get_int(request)};
    cz_get(request, &bounds, 1, sizeof bounds);
    cz_get(request, &start, 1, sizeof start);
    if (own.most < 1 || request->has_ended)
        return cz_no_memory(error, "a task");
    own.curve = malloc((size_t)own.most * sizeof *own.curve);
    if (own.curve == NULL)
        return cz_no_memory(error, "the search of a corridor");
    const CzStatus status = run_search(&own, &bounds, error);
    if (status == CZ_OK) {
        cz_put_int(answer, own.n);
        cz_put(answer, own.curve, (size_t)own.n, sizeof *own.curve);
    }
    free(own.curve);
    return status;
}

CzStatus cz_corridor_challenge(CzCorridor *corridor, const CzCorridorBox *box, int n,
                               const CzTriedCurve *start, CzError *error) {
    const int n_factor = cz_corridor_n_factor(corridor),
              most = 2 * (n_factor + 1) + corridor->n_random;
    const CzTaskData plain = {&corridor->parts->study, request_adversary, take_adversary};
    Round round = {0};
    for (int i = 0; i < n_factor; i++) {
        round.bounds.low[i] = cz_box_factor(corridor, box, 0);
        round.bounds.high[i] = cz_box_factor(corridor, box, 1);
    }
    CzTriedCurve *curve = malloc((size_t)(n * most) * sizeof *curve);
    if (curve == NULL)
        return cz_no_memory(error, "the search of a corridor");
    for (int a = 0; a < n; a++)
        round.adversary[a] = (Adversary){
            .corridor = corridor, .start = &start[a], .most = most, .curve = curve + a * most};
    CzStatus status = cz_tasks_share(&plain, n, run_task, &round, error);
    for (int a = 0; a < n && status == CZ_OK; a++)
        status = cz_corridor_keep(corridor, round.adversary[a].n, round.adversary[a].curve, error);
    free(curve);
    return status == CZ_OK && cz_corridor_is_stopped(corridor) ? CZ_STATUS_INTERRUPTED : status;
}
