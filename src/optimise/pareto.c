/* Fronts by the epsilon-constraint method:
 *
 *   minimise a(x)   subject to all checks and b(x) <= bound_k
 *   bound_k = b_first + k / (n - 1) (b_last - b_first)
 *
 * where b_first belongs to the design with the least a, b_last is the least b. Of designs as good
 * as an end, the one with the least of the other objective is searched. The order is from strict to
 * loose bounds, so that every search begins at a design that satisfies its bound; points that do
 * not improve are searched again from the other side. Of the smallest margin, b is its negative: a
 * margin is then required of every constraint.
 */
#include "crushzone/pareto.h"
#include "base/arena.h"
#include "base/clock.h"
#include "base/error.h"
#include "evaluate/evaluator.h"
#include "optimise/outcome.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

CzParetoOptions cz_pareto_options_default(void) {
    return (CzParetoOptions){.n_point = 12, .search = cz_optimise_options_default()};
}

const char *cz_pareto_state_text(CzParetoState state) {
    static const char *const texts[] = {
        [CZ_PARETO_VERIFIED] = "verified",     [CZ_PARETO_NOT_VERIFIED] = "not verified",
        [CZ_PARETO_INFEASIBLE] = "infeasible", [CZ_PARETO_FAILED] = "failed",
        [CZ_PARETO_NOT_NEEDED] = "not needed", [CZ_PARETO_NOT_RUN] = "not run"};
    return texts[state];
}

bool cz_pareto_is_feasible(const CzParetoPoint *point) {
    return point->state == CZ_PARETO_VERIFIED || point->state == CZ_PARETO_NOT_VERIFIED;
}

/* The front is the first member, so that its address is that of the struct. */
typedef struct Owned {
    CzPareto pareto;
    CzArena arena;
    CzEvaluator
        *measure[2]; /* evaluators of each objective alone; the first is that of the front */
} Owned;

typedef struct Front {
    const CzProblem *problem;
    const CzParetoOptions *options;
    Owned *owned;
    CzPareto *pareto;
    int order[2]; /* numbers, in the options, of the objective that is minimised and of the one
                     that is bounded */
    int n_begun;
    long n_answered;   /* evaluations of the searches so far, also those of the journal */
    long n_evaluation; /* of the current search */
} Front;

static bool is_margin(const char *name) {
    return strcmp(name, CZ_PARETO_MARGIN) == 0;
}

/* Value of an objective in the sense in which smaller is better. */
static double to_minimise(const Front *front, int objective, double value) {
    return front->pareto->objective[objective].is_margin ? -value : value;
}

/* ---- evaluators ------------------------------------------------------------------------------ */

/* An evaluator that minimises one objective, with a bound on the other one unless that is NaN. */
static CzStatus build(const Front *front, int objective, double bound, CzEvaluator **evaluator,
                      CzError *error) {
    const char *const *name = front->options->minimise;
    const char *other = name[1 - objective];
    const bool has_bound = !isnan(bound);
    const CzAim aim = {.minimise = is_margin(name[objective]) ? NULL : name[objective],
                       .margin = has_bound && is_margin(other) ? bound : NAN,
                       .bounded = has_bound && !is_margin(other) ? other : NULL,
                       .bound = bound};
    CzEvaluatorOptions options = cz_evaluator_options_default();
    options.n_job = front->options->n_job;
    options.executor = front->options->executor;
    options.aim = &aim;
    return cz_evaluator_build(front->problem, &options, evaluator, error);
}

/* A point before its search. */
static const CzParetoPoint blank = {.state = CZ_PARETO_NOT_RUN,
                                    .bound = NAN,
                                    .value = {NAN, NAN},
                                    .dominated_by = -1,
                                    .verdict = CZ_VERDICT_NOT_CHECKED,
                                    .violation = INFINITY};

static CzStatus prepare(Front *front, CzError *error) {
    const CzParetoOptions *options = front->options;
    CzPareto *pareto = front->pareto;
    const char *const *name = options->minimise;
    if (name[0] == NULL || name[1] == NULL || strcmp(name[0], name[1]) == 0)
        return cz_fail(error, CZ_STATUS_INPUT, "a front needs two different objectives");
    if (options->n_point < 2)
        return cz_fail(error, CZ_STATUS_INPUT, "a front has at least 2 points, not %d",
                       options->n_point);
    for (int k = 0; k < 2; k++) {
        CZ_TRY(build(front, k, NAN, &front->owned->measure[k], error));
        const CzEvaluator *evaluator = front->owned->measure[k];
        pareto->objective[k] = (CzParetoObjective){
            .name = is_margin(name[k]) ? CZ_PARETO_MARGIN : cz_evaluator_objective_name(evaluator),
            .unit = cz_evaluator_objective_unit(evaluator),
            .is_margin = is_margin(name[k])};
    }
    pareto->evaluator = front->owned->measure[0];
    if (cz_evaluator_is_fit(pareto->evaluator))
        return cz_fail(error, CZ_STATUS_INPUT, "a fit has no front: it minimises its differences");
    CZ_TRY(cz_optimise_check(pareto->evaluator, &options->search, error));
    front->order[0] = is_margin(name[0]) ? 1 : 0; /* a margin can only be required */
    front->order[1] = pareto->bounded = 1 - front->order[0];
    pareto->n_variable = cz_evaluator_n_variable(pareto->evaluator);
    pareto->n_point = options->n_point;
    pareto->point =
        cz_arena_allocate(&front->owned->arena, (size_t)pareto->n_point, sizeof *pareto->point);
    if (pareto->point == NULL)
        return cz_no_memory(error, "the points");
    for (int i = 0; i < pareto->n_point; i++)
        pareto->point[i] = blank;
    return CZ_OK;
}

/* ---- one point ------------------------------------------------------------------------------- */

/* Takes the design of an outcome, with both objectives from full evaluations. */
static CzStatus take(const Front *front, const CzOutcome *outcome, CzParetoPoint *point,
                     CzError *error) {
    const size_t n = (size_t)front->pareto->n_variable;
    const CzEvaluation *best = &outcome->best_evaluation;
    point->n_evaluation = outcome->n_evaluation;
    snprintf(point->why, sizeof point->why, "%s", outcome->why_stopped);
    point->state = best->violation > 0 || best->status != CZ_OK ? CZ_PARETO_INFEASIBLE
                   : outcome->status == CZ_OUTCOME_FEASIBLE     ? CZ_PARETO_VERIFIED
                                                                : CZ_PARETO_NOT_VERIFIED;
    if (outcome->status == CZ_OUTCOME_UNVERIFIED)
        snprintf(point->why, sizeof point->why, "the verification changes results too much");
    if (best->status != CZ_OK) {
        snprintf(point->why, sizeof point->why, "%s", best->failure);
        return CZ_OK;
    }
    point->verdict = best->verdict;
    point->violation = best->violation;
    point->x = cz_arena_numbers(&front->owned->arena, n);
    if (point->x == NULL)
        return cz_no_memory(error, "a point");
    memcpy(point->x, outcome->best, n * sizeof *point->x);
    point->between_increments = !cz_is_on_increments(front->pareto->evaluator, point->x);
    for (int k = 0; k < 2; k++) {
        CzEvaluation evaluation;
        CZ_TRY(cz_evaluate(front->owned->measure[k], 1, point->x, false, &evaluation, error));
        point->value[k] = to_minimise(front, k, evaluation.objective);
        cz_evaluation_free(&evaluation);
    }
    return CZ_OK;
}

/* Counts the evaluations of a search, also of one that fails, and passes them on. */
static void count(const CzProgress *progress, void *data) {
    Front *front = data;
    const CzOptimiseOptions *search = &front->options->search;
    front->n_evaluation = progress->n_evaluation;
    if (search->progress != NULL)
        search->progress(progress, search->progress_data);
}

/* The part of the journal that belongs to the next search. */
static CzJournal rest_of_journal(const Front *front) {
    CzJournal rest = cz_journal_remaining(front->options->search.journal, front->n_answered);
    rest.n_earlier = 0;
    return rest;
}

/* One search for a point: the least of an objective within the point's bound on the other one. */
static CzStatus search_once(Front *front, int objective, const double *start, CzParetoPoint *point,
                            CzError *error) {
    CzOptimiseOptions options = front->options->search;
    CzEvaluator *evaluator = NULL;
    CzOutcome *outcome = NULL;
    CzJournal rest;
    if (options.journal != NULL) {
        rest = rest_of_journal(front);
        options.journal = &rest;
    }
    options.start = start;
    options.no_sensitivities = true;
    options.progress = count;
    options.progress_data = front;
    front->n_evaluation = 0;
    CZ_TRY(build(front, objective, point->bound, &evaluator, error));
    CzStatus status = cz_optimise(evaluator, &options, &outcome, error);
    front->n_answered += front->n_evaluation;
    if (status == CZ_OK) {
        front->pareto->is_interrupted =
            outcome->status == CZ_OUTCOME_INTERRUPTED || outcome->is_cut_short;
        status = take(front, outcome, point, error);
    } else if (status == CZ_STATUS_RUN_FAILED) {
        point->state = CZ_PARETO_FAILED;
        snprintf(point->why, sizeof point->why, "%.511s", error != NULL ? error->message : "");
        status = CZ_OK;
    }
    cz_outcome_free(outcome);
    cz_evaluator_free(evaluator);
    return status;
}

/* Whether the design of one search for a point is preferred to that of another one. */
static bool is_preferred(const Front *front, int objective, const CzParetoPoint *one,
                         const CzParetoPoint *other) {
    if (cz_pareto_is_feasible(one) != cz_pareto_is_feasible(other))
        return cz_pareto_is_feasible(one);
    if (!cz_pareto_is_feasible(one))
        return one->violation < other->violation;
    return to_minimise(front, objective, one->value[objective]) <
           to_minimise(front, objective, other->value[objective]);
}

/* Searches a point, for the first time or again, and keeps the better design. */
static CzStatus search(Front *front, int objective, const double *start, int number,
                       CzError *error) {
    const CzParetoOptions *options = front->options;
    CzParetoPoint *point = &front->pareto->point[number], trial = blank;
    if (options->begins != NULL)
        options->begins(number, front->pareto->n_point, options->begins_data);
    trial.bound = point->bound;
    CZ_TRY(search_once(front, objective, start, &trial, error));
    trial.n_evaluation += point->n_evaluation;
    if (point->state == CZ_PARETO_NOT_RUN || is_preferred(front, objective, &trial, point))
        *point = trial;
    point->n_evaluation = trial.n_evaluation;
    return CZ_OK;
}

/* ---- the front ------------------------------------------------------------------------------- */

/* Number, from the first to the last point, of the end of the objective that is minimised. */
static int end_of(const Front *front, int objective) {
    return objective == 0 ? 0 : front->pareto->n_point - 1;
}

/* Searches an end from the file's start, and again from the design of the other end where that is
 * the better start. */
static CzStatus search_end(Front *front, int objective, CzError *error) {
    CzPareto *pareto = front->pareto;
    const int number = end_of(front, objective);
    const CzParetoPoint *end = &pareto->point[number];
    const CzParetoPoint *other = &pareto->point[end_of(front, 1 - objective)];
    if (end->state == CZ_PARETO_NOT_RUN)
        CZ_TRY(search(front, objective, NULL, number, error));
    const bool is_beaten =
        cz_pareto_is_feasible(other) && !is_preferred(front, objective, end, other);
    return is_beaten && !pareto->is_interrupted ? search(front, objective, other->x, number, error)
                                                : CZ_OK;
}

/* The first end again where only the second one has a design that passes. */
static CzStatus search_ends(Front *front, CzError *error) {
    const int strict = front->order[1], loose = front->order[0];
    CZ_TRY(search_end(front, strict, error));
    if (!front->pareto->is_interrupted)
        CZ_TRY(search_end(front, loose, error));
    return front->pareto->is_interrupted ? CZ_OK : search_end(front, strict, error);
}

/* Whether both ends have designs that pass, and one has less of the bounded objective. */
static bool ends_conflict(const Front *front) {
    const CzPareto *pareto = front->pareto;
    const CzParetoPoint *first = &pareto->point[0], *last = &pareto->point[pareto->n_point - 1];
    const int bounded = front->order[1];
    return cz_pareto_is_feasible(first) && cz_pareto_is_feasible(last) &&
           first->value[bounded] != last->value[bounded];
}

/* Searches the least of the other objective among designs as good as an end: often many are. */
static CzStatus improve_end(Front *front, int objective, CzError *error) {
    const CzParetoOptions *options = front->options;
    const double slack = 1e-3; /* of the objective, or of a margin (ours) */
    const int number = end_of(front, objective);
    CzParetoPoint *end = &front->pareto->point[number], trial = blank;
    const bool is_required = is_margin(options->minimise[objective]);
    const double value = end->value[objective];
    if (options->begins != NULL)
        options->begins(number, front->pareto->n_point, options->begins_data);
    trial.bound = is_required ? value - slack : value + slack * fabs(value);
    CZ_TRY(search_once(front, 1 - objective, end->x, &trial, error));
    trial.bound = end->bound;
    trial.n_evaluation += end->n_evaluation;
    if (is_preferred(front, 1 - objective, &trial, end))
        *end = trial;
    end->n_evaluation = trial.n_evaluation;
    return CZ_OK;
}

static CzStatus improve_ends(Front *front, CzError *error) {
    for (int k = 0; k < 2 && ends_conflict(front) && !front->pareto->is_interrupted; k++)
        CZ_TRY(improve_end(front, front->order[k], error));
    return CZ_OK;
}

static bool dominates(const Front *front, int one, int other) {
    const int strict = end_of(front, front->order[1]);
    bool is_better = abs(one - strict) < abs(other - strict); /* of equal points the strictest */
    for (int k = 0; k < 2; k++) {
        const double a = to_minimise(front, k, front->pareto->point[one].value[k]);
        const double b = to_minimise(front, k, front->pareto->point[other].value[k]);
        const double nothing = 1e-9 * fmax(fabs(a), fabs(b)); /* rounding */
        if (a > b + nothing)
            return false;
        is_better |= a < b - nothing;
    }
    return is_better;
}

static void mark_dominated(const Front *front) {
    CzPareto *pareto = front->pareto;
    for (int i = 0; i < pareto->n_point; i++) {
        pareto->point[i].dominated_by = -1;
        for (int k = 0; k < pareto->n_point; k++)
            if (k != i && pareto->point[i].dominated_by < 0 &&
                cz_pareto_is_feasible(&pareto->point[i]) &&
                cz_pareto_is_feasible(&pareto->point[k]) && dominates(front, k, i))
                pareto->point[i].dominated_by = k;
    }
}

/* The nearest feasible design from a point on in steps; with `is_less` one that has less of the
 * objective. NULL when there is none. */
static const double *nearest(const Front *front, int point, int step, bool is_less) {
    const CzPareto *pareto = front->pareto;
    for (int i = point + step; i >= 0 && i < pareto->n_point; i += step)
        if (cz_pareto_is_feasible(&pareto->point[i]) &&
            (!is_less ||
             is_preferred(front, front->order[0], &pareto->point[i], &pareto->point[point])))
            return pareto->point[i].x;
    return NULL;
}

/* Searches the points between the ends: from strict to loose bounds, then those that are no better
 * than another one again, from loose to strict. */
static CzStatus search_points(Front *front, int strict, int loose, CzError *error) {
    CzPareto *pareto = front->pareto;
    const int step = loose > strict ? 1 : -1;
    for (int i = strict + step; i != loose && !pareto->is_interrupted; i += step)
        CZ_TRY(search(front, front->order[0], nearest(front, i, -step, false), i, error));
    for (int i = loose - step; i != strict && !pareto->is_interrupted; i -= step) {
        mark_dominated(front);
        if (cz_pareto_is_feasible(&pareto->point[i]) && pareto->point[i].dominated_by < 0)
            continue;
        const double *start = nearest(front, i, step, true);
        if (start != NULL)
            CZ_TRY(search(front, front->order[0], start, i, error));
    }
    return CZ_OK;
}

static CzStatus search_between(Front *front, CzError *error) {
    CzPareto *pareto = front->pareto;
    const int n = pareto->n_point, bounded = front->order[1];
    const int strict = end_of(front, bounded), loose = end_of(front, front->order[0]);
    const double from = pareto->point[strict].value[bounded];
    const double to = pareto->point[loose].value[bounded];
    const bool has_ends = cz_pareto_is_feasible(&pareto->point[strict]) &&
                          cz_pareto_is_feasible(&pareto->point[loose]);
    for (int i = 1; i + 1 < n; i++) {
        CzParetoPoint *point = &pareto->point[i];
        point->bound = from + (to - from) * abs(i - strict) / (n - 1);
        if (has_ends && from == to)
            point->state = CZ_PARETO_NOT_NEEDED;
        if (!has_ends || from == to)
            snprintf(point->why, sizeof point->why, "%s",
                     has_ends ? "the objectives do not conflict: both ends are as good"
                              : "an end has no design that passes");
    }
    return has_ends && from != to ? search_points(front, strict, loose, error) : CZ_OK;
}

static CzStatus search_all(Front *front, CzError *error) {
    CZ_TRY(search_ends(front, error));
    CZ_TRY(improve_ends(front, error));
    if (!front->pareto->is_interrupted)
        CZ_TRY(search_between(front, error));
    mark_dominated(front);
    return CZ_OK;
}

CzStatus cz_pareto(const CzProblem *problem, const CzParetoOptions *options, CzPareto **pareto,
                   CzError *error) {
    const double began = cz_clock();
    Owned *owned = calloc(1, sizeof *owned);
    *pareto = NULL;
    if (owned == NULL)
        return cz_no_memory(error, "a front");
    Front front = {
        .problem = problem, .options = options, .owned = owned, .pareto = &owned->pareto};
    CzStatus status = prepare(&front, error);
    if (status == CZ_OK)
        status = search_all(&front, error);
    owned->pareto.wall_s = cz_clock() - began;
    if (status == CZ_OK)
        *pareto = &owned->pareto;
    else
        cz_pareto_free(&owned->pareto);
    return status;
}

void cz_pareto_free(CzPareto *pareto) {
    if (pareto == NULL)
        return;
    Owned *owned = (Owned *)pareto;
    for (int k = 0; k < 2; k++)
        cz_evaluator_free(owned->measure[k]);
    cz_arena_free(&owned->arena);
    free(owned);
}
