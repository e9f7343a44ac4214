/* Changes of single numbers that would help a check: each is run in all scenarios, and its effect
 * on the check and on the others is noted.
 *
 * Varied are the variables of the problem, or without them every number of a vehicle end that a
 * search may change, as it is written.
 */
#include "evaluate/explain_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "problem/varying.h"

/* Changes of a number, relative to its size (ours). */
static const double steps[] = {-0.5, -0.25, -0.1, 0.1, 0.25, 0.5};
enum { N_STEP = sizeof steps / sizeof *steps, MAX_NUMBERS = 64 };

#define SMALLEST_GAIN 1e-3 /* of the margin, for a change that helps (ours) */

/* One number that is varied. */
typedef struct Number {
    int variable; /* of the evaluator */
    double size;  /* of a change of 100 % */
    int n, first; /* of its designs */
    double change[N_STEP];
} Number;

/* The designs of all changes, the first of them without a change. */
typedef struct Trial {
    CzEvaluator *evaluator;
    int n_variable;
    int n_number;
    Number number[MAX_NUMBERS];
    int n_design;
    double *x;                /* (n_design x n_variable) */
    CzEvaluation *evaluation; /* (n_design) */
} Trial;

/* ---- the evaluator with variables ---- */

/* Marks the vehicles that are in no train behind: changes of the partner alone do not improve a
 * design. NULL without memory. */
static bool *mark_partners(const CzEvaluator *evaluator) {
    bool *is_partner = malloc((size_t)evaluator->n_vehicle + 1);
    if (is_partner == NULL)
        return NULL;
    memset(is_partner, true, (size_t)evaluator->n_vehicle + 1);
    for (int s = 0; s < evaluator->n_scene; s++)
        for (int i = 0; i <= evaluator->scene[s].colliding; i++)
            is_partner[evaluator->scene[s].record[i]] = false;
    return is_partner;
}

/* An evaluator whose variables are the numbers of the problem; none when it has no such number. */
static CzStatus build_varying(const CzEvaluator *evaluator, CzVaryingNumber *number, int *n,
                              CzProblem **problem, CzEvaluator **varying, CzError *error) {
    CzEvaluatorOptions options = cz_evaluator_options_default();
    options.executor = &evaluator->executor;
    options.scenario = evaluator->only;
    options.first_scenario = evaluator->first_scenario;
    options.beside = evaluator;
    bool *is_partner = mark_partners(evaluator);
    const CzStatus found =
        is_partner != NULL
            ? cz_problem_find_varying(evaluator->problem, is_partner, MAX_NUMBERS, number, n, error)
            : cz_no_memory(error, "the changes");
    free(is_partner);
    CZ_TRY(found);
    if (*n == 0)
        return CZ_OK;
    CZ_TRY(cz_problem_read_varying(evaluator->problem, *n, number, problem, error));
    return cz_evaluator_build(*problem, &options, varying, error);
}

/* ---- designs ---- */

static void add_number(Trial *trial, int variable, double size) {
    const CzVariableInfo *info = cz_evaluator_variable(trial->evaluator, variable);
    if (trial->n_number == MAX_NUMBERS || info->n_choice > 0 || info->is_fixed || !(size > 0))
        return;
    Number *number = &trial->number[trial->n_number];
    *number = (Number){.variable = variable, .size = size, .first = trial->n_design};
    for (int i = 0; i < N_STEP; i++) {
        const double value = info->start + steps[i] * size;
        if (value >= info->min && value <= info->max)
            number->change[number->n++] = steps[i];
    }
    trial->n_design += number->n;
    trial->n_number += number->n > 0;
}

static CzStatus lay_out(Trial *trial, CzError *error) {
    const size_t n_design = (size_t)trial->n_design, n = (size_t)trial->n_variable;
    trial->x = malloc(n_design * n * sizeof *trial->x);
    trial->evaluation = calloc(n_design, sizeof *trial->evaluation);
    if (trial->x == NULL || trial->evaluation == NULL)
        return cz_no_memory(error, "the changes");
    for (size_t i = 0; i < n_design; i++)
        for (size_t v = 0; v < n; v++)
            trial->x[i * n + v] = cz_evaluator_variable(trial->evaluator, (int)v)->start;
    for (int k = 0; k < trial->n_number; k++) {
        const Number *number = &trial->number[k];
        for (int i = 0; i < number->n; i++)
            trial->x[(size_t)(number->first + i) * n + (size_t)number->variable] +=
                number->change[i] * number->size;
    }
    return CZ_OK;
}

/* Runs all designs in parts, between which progress is reported: to their ends, because energies of
 * runs that end early lack what is dissipated after the crush. */
static CzStatus run(Trial *trial, const CzExplainOptions *options, CzError *error) {
    enum { PART = 16 };
    CzStatus status = CZ_OK;
    for (int first = 0; first < trial->n_design && status == CZ_OK; first += PART) {
        const int left = trial->n_design - first, n = left < PART ? left : PART;
        status =
            cz_evaluate(trial->evaluator, n, trial->x + (size_t)first * (size_t)trial->n_variable,
                        false, trial->evaluation + first, error);
        if (options->progress != NULL)
            options->progress(first + n, trial->n_design, options->progress_data);
    }
    return status;
}

/* ---- effects ---- */

static double margin_of(const CzCheckResult *check) {
    if (!check->is_flag)
        return check->margin;
    return check->verdict == CZ_VERDICT_FAIL   ? CZ_BROKEN_FLAG
           : cz_verdict_passes(check->verdict) ? CZ_SATISFIED_FLAG
                                               : NAN;
}

/* Smallest margin of a check over its scenarios; whether it passes in all of them. */
static double margin_of_name(const CzEvaluation *evaluation, const char *name, bool *passes) {
    double smallest = NAN;
    *passes = true;
    for (int i = 0; i < evaluation->n_check; i++) {
        const CzCheckResult *check = &evaluation->check[i];
        if (strcmp(check->name, name) != 0)
            continue;
        smallest = fmin(smallest, margin_of(check)); /* fmin ignores NaN */
        *passes &= check->verdict != CZ_VERDICT_FAIL;
    }
    return smallest;
}

/* Notes the other checks: how many break, and the one with the smallest margin. The checks of two
 * evaluations are in one order. */
static void note_others(const CzEvaluation *before, const CzEvaluation *now, const char *name,
                        CzTriedChange *change) {
    change->other_margin = change->other_before = NAN;
    for (int i = 0; i < now->n_check; i++) {
        const CzCheckResult *check = &now->check[i];
        const double margin = margin_of(check);
        if (strcmp(check->name, name) == 0)
            continue;
        change->n_broken +=
            check->verdict == CZ_VERDICT_FAIL && before->check[i].verdict != CZ_VERDICT_FAIL;
        if (isnan(margin) || margin >= change->other_margin)
            continue;
        change->other_margin = margin;
        change->other_before = margin_of(&before->check[i]);
        snprintf(change->other, sizeof change->other, "%s", check->name);
        snprintf(change->other_scenario, sizeof change->other_scenario, "%s", check->scenario);
    }
}

/* Whether a change passes without breaking another check. */
static bool is_clean(const CzTriedChange *change) {
    return change->passes && change->n_broken == 0;
}

static bool is_better(const CzTriedChange *a, const CzTriedChange *b) {
    if (is_clean(a) != is_clean(b))
        return is_clean(a);
    if (is_clean(a) && fabs(a->change) != fabs(b->change))
        return fabs(a->change) < fabs(b->change);
    return a->margin > b->margin;
}

static CzTriedChange effect_of(const Trial *trial, const Number *number, int step,
                               const char *name) {
    const CzVariableInfo *info = cz_evaluator_variable(trial->evaluator, number->variable);
    const CzEvaluation *now = &trial->evaluation[number->first + step];
    CzTriedChange change = {.value = info->start,
                            .tried = info->start + number->change[step] * number->size,
                            .change = number->change[step],
                            .margin = NAN};
    snprintf(change.name, sizeof change.name, "%.*s", CZ_PATH_SIZE - 1, info->name);
    snprintf(change.unit, sizeof change.unit, "%.15s", info->unit);
    if (now->status != CZ_OK)
        return change;
    change.margin = margin_of_name(now, name, &change.passes);
    note_others(&trial->evaluation[0], now, name, &change);
    return change;
}

static int compare_changes(const void *a, const void *b) {
    return is_better(a, b) ? -1 : is_better(b, a) ? 1 : 0;
}

/* Keeps the best change of each number that raises the margin of a check. */
static CzStatus keep_changes(const Trial *trial, CzExplainedCheck *explained, CzError *error) {
    const char *name = explained->check.name;
    bool passes;
    explained->margin = margin_of_name(&trial->evaluation[0], name, &passes);
    explained->change = calloc((size_t)trial->n_number + 1, sizeof *explained->change);
    if (explained->change == NULL)
        return cz_no_memory(error, "the changes");
    for (int k = 0; k < trial->n_number; k++) {
        CzTriedChange best = {.margin = NAN};
        for (int i = 0; i < trial->number[k].n; i++) {
            const CzTriedChange change = effect_of(trial, &trial->number[k], i, name);
            const bool helps = change.margin > explained->margin + SMALLEST_GAIN ||
                               (isnan(explained->margin) && !isnan(change.margin));
            if (helps && (isnan(best.margin) || is_better(&change, &best)))
                best = change;
        }
        if (!isnan(best.margin))
            explained->change[explained->n_change++] = best;
    }
    qsort(explained->change, (size_t)explained->n_change, sizeof *explained->change,
          compare_changes);
    return CZ_OK;
}

/* ---- all changes ---- */

static CzStatus try_changes(Trial *trial, const CzExplainOptions *options,
                            CzExplanation *explanation, CzError *error) {
    cz_evaluator_set_stop(trial->evaluator, options->stop);
    explanation->n_tried = trial->n_number;
    explanation->n_run += (long)trial->n_design * trial->evaluator->n_scene;
    CzStatus status = lay_out(trial, error);
    if (status == CZ_OK)
        status = run(trial, options, error);
    for (int i = 0; i < explanation->n_check && status == CZ_OK; i++)
        status = keep_changes(trial, &explanation->check[i], error);
    for (int i = 0; trial->evaluation != NULL && i < trial->n_design; i++)
        cz_evaluation_free(&trial->evaluation[i]);
    free(trial->evaluation);
    free(trial->x);
    return status;
}

CzStatus cz_explain_changes(CzEvaluator *evaluator, const CzExplainOptions *options,
                            CzExplanation *explanation, CzError *error) {
    Trial trial = {.evaluator = evaluator, .n_design = 1};
    CzProblem *problem = NULL;
    CzEvaluator *varying = NULL;
    CzStatus status = CZ_OK;
    if (cz_evaluator_n_variable(evaluator) > 0 && !cz_evaluator_is_fit(evaluator)) {
        trial.n_variable = cz_evaluator_n_variable(evaluator);
        for (int i = 0; i < trial.n_variable; i++)
            add_number(&trial, i, fabs(cz_evaluator_variable(evaluator, i)->start));
    } else {
        CzVaryingNumber *number = calloc(MAX_NUMBERS, sizeof *number);
        status = number != NULL ? build_varying(evaluator, number, &trial.n_variable, &problem,
                                                &varying, error)
                                : cz_no_memory(error, "the changes");
        trial.evaluator = varying;
        for (int i = 0; i < trial.n_variable && status == CZ_OK; i++)
            add_number(&trial, i, number[i].size);
        free(number);
    }
    if (status == CZ_OK && trial.n_number > 0)
        status = try_changes(&trial, options, explanation, error);
    cz_evaluator_free(varying);
    cz_problem_free(problem);
    return status;
}
