/* Computes a design again by other methods, and the change of the numbers by which it is judged.
 *
 *   production run, the same run by another method --> change = |again - production| / scale
 *
 * The change of a check is that of its margin: a wheel lift of some micrometres counts against its
 * limit. A margin above 100 % counts as 100 %, since no verdict depends on a larger one. Where a
 * limit is exceeded many times, as one of 0 is, the change is relative to the excess.
 *
 * The change of any other number is relative to itself. Where the number is next to 0, an energy is
 * compared with a hundredth of the initial kinetic energy, so that at most 1e-4 of that passes,
 * which is the tolerance of the energy balance (ours); a force, a length or another metric is
 * compared with the smallest scale of its margins.
 */
#include "crushzone/verify.h"

#include "base/clock.h"
#include "base/error.h"
#include "evaluate/compose.h"
#include "evaluate/evaluator_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LIMIT 0.01        /* largest change that passes (ours) */
#define SETTLED_SHARE 0.1 /* largest change of a check by ending early, of the limit (ours) */
/* Factor on the time step that shifts the steps relative to all events and changes the error by
 * 6 %; with 33 steps for 32 the end criterion is examined at the same times (ours). */
#define NUDGE (32.0 / 33.0)

static const struct {
    const char *key, *text;
} methods[CZ_N_VERIFY_METHOD] = {
#define CZ_VERIFY_METHOD(constant, key, text, doc) [constant] = {key, text},
#include "crushzone/verify_methods.def"
#undef CZ_VERIFY_METHOD
};

const char *cz_verify_method_key(CzVerifyMethod method) {
    return methods[method].key;
}

const char *cz_verify_method_text(CzVerifyMethod method) {
    return methods[method].text;
}

CzVerifyOptions cz_verify_options_default(void) {
    return (CzVerifyOptions){
        .methods = (1u << CZ_N_VERIFY_METHOD) - 1, .limit = LIMIT, .solver_step = 1.0};
}

static CzTrack track_of(const CzEvaluator *evaluator) {
    return cz_problem_track(evaluator->problem);
}

static CzTrackUse track_of_solvers(const CzEvaluator *evaluator) {
    return track_of(evaluator) == CZ_TRACK_FE ? CZ_TRACK_USE_MODAL : CZ_TRACK_USE_OWN;
}

/* Settings of the runs of a method. All tracks are compared with the modal one, and that with
 * finite elements, which the solvers do not support. */
static CzManner manner_of(const CzEvaluator *evaluator, CzVerifyMethod method, double solver_step) {
    CzManner manner = evaluator->manner;
    switch (method) {
    case CZ_METHOD_HALF_STEP:
        manner.step_factor *= 0.5;
        break;
    case CZ_METHOD_SCATTER:
        manner.step_factor *= NUDGE;
        break;
    case CZ_METHOD_TRACK:
        manner.track = track_of(evaluator) == CZ_TRACK_MODAL ? CZ_TRACK_USE_FE : CZ_TRACK_USE_MODAL;
        break;
    case CZ_METHOD_ERK:
        manner.step_factor *= solver_step;
        manner.integrator = CZ_INTEGRATOR_ERK;
        manner.track = track_of_solvers(evaluator);
        break;
    case CZ_METHOD_ADAMS:
        manner.step_factor *= solver_step;
        manner.integrator = CZ_INTEGRATOR_ADAMS;
        manner.track = track_of_solvers(evaluator);
        break;
    case CZ_N_VERIFY_METHOD:
        break;
    }
    return manner;
}

/* ---- numbers of an evaluation ---------------------------------------------------------------- */

/* A number by which a design is judged; their order is the same for every evaluation. */
typedef struct Number {
    const char *name, *scenario, *where, *unit;
    double value;
    double counted;             /* the change is the difference of this value over `scale` */
    double scale;               /* infinite: no change counts */
    const CzCheckResult *check; /* NULL for the objective and the total results of a scenario */
    bool beyond_validity;
    bool is_total; /* adds up over the whole run */
} Number;

static Number number_of_check(const CzCheck *check, const CzCheckResult *result) {
    return (Number){.name = result->name,
                    .scenario = check->scenario == CZ_NO_SCENARIO ? NULL : result->scenario,
                    .where = result->where,
                    .unit = result->unit,
                    .value = result->value,
                    .counted = result->margin > 1.0 ? 1.0 : result->margin,
                    .scale = check->scale == CZ_FLAG_SCALE ? INFINITY : fmax(1.0, -result->margin),
                    .check = result,
                    .beyond_validity = result->beyond_validity,
                    .is_total = check->metric.kind != NULL && check->metric.kind->is_total};
}

enum { N_BULK = 3 };

/* Scale of an energy near 0, in its unit. */
static double energy_scale(const CzRunSummary *run, double per_unit) {
    const double share = 0.01; /* ours */
    return share * run->energy.initial / per_unit;
}

static Number bulk_of(const CzRunSummary *run, int which) {
    static const char *const name[N_BULK] = {"largest interface force", "largest closure",
                                             "dissipated energy"};
    static const char *const unit[N_BULK] = {"kN", "mm", "kJ"};
    const double least[N_BULK] = {1, 1, energy_scale(run, 1e3)}; /* those of the metrics */
    Number number = {.name = name[which],
                     .scenario = run->scenario,
                     .unit = unit[which],
                     .where = "",
                     .beyond_validity = run->beyond_validity};
    if (which == 2)
        number.value = 1e-3 * cz_run_total(run, run->energy.dissipated);
    for (int i = 0; which < 2 && i < run->n_interface; i++) {
        const CzInterfaceResult *interface = &run->interface[i];
        const double value =
            which == 0 ? 1e-3 * interface->peak_force : 1e3 * interface->shortening;
        if (value > number.value) {
            number.value = value;
            number.where = interface->name;
        }
    }
    number.counted = number.value;
    number.scale = fmax(fabs(number.value), least[which]);
    return number;
}

/* The change of a match is relative to the measured value. */
static Number number_of_match(const CzMatchResult *match, const CzCheckResult *result) {
    return (Number){.name = match->name,
                    .scenario = match->scenario,
                    .where = match->where,
                    .unit = match->unit,
                    .value = match->value,
                    .counted = match->value,
                    .scale = fmax(fabs(match->target), match->tolerance),
                    .check = result};
}

/* Scale of an objective near 0 that is a metric. */
static double least_scale_of(const CzMetricKind *kind, const CzEvaluation *evaluation) {
    double scale = fabs(kind->scale); /* 1 of a yes or no */
    for (int i = 0; strcmp(kind->unit->text, "kJ") == 0 && i < evaluation->n_run; i++)
        if (evaluation->run != NULL && evaluation->run[i] != NULL)
            scale =
                fmax(scale, energy_scale(cz_run_summary(evaluation->run[i]), kind->unit->in_si));
    return scale;
}

/* Scale of the objective: 1 of a margin; infinite for the sum of squares of a fit, which is near 0
 * and whose terms are compared one by one; else its own size. */
static double scale_of_objective(const CzEvaluator *evaluator, const CzEvaluation *evaluation) {
    if (cz_evaluator_maximises_margin(evaluator))
        return 1.0;
    const double own = fabs(evaluation->objective);
    if (evaluator->own_objective != NULL)
        return own;
    return evaluation->n_match > 0
               ? INFINITY
               : fmax(own, least_scale_of(evaluator->objective.kind, evaluation));
}

static int most_numbers(const CzEvaluator *evaluator, const CzEvaluation *evaluation) {
    return 1 + evaluator->list.n_check + evaluation->n_match + N_BULK * evaluation->n_run;
}

/* Lists the numbers and returns how many there are. */
static int list_numbers(const CzEvaluator *evaluator, const CzEvaluation *evaluation,
                        Number *number) {
    int n = 0, n_check = 0, n_constraint = 0;
    const CzOptimise *optimise = &cz_problem_input(evaluator->problem)->optimise;
    if (optimise->given || evaluator->own_objective != NULL)
        number[n++] = (Number){.name = evaluator->objective_name,
                               .where = "",
                               .unit = evaluator->objective_unit,
                               .value = evaluation->objective,
                               .counted = evaluation->objective,
                               .beyond_validity = evaluation->beyond_validity,
                               .scale = scale_of_objective(evaluator, evaluation)};
    for (int i = 0; i < evaluator->list.n_check; i++) {
        const CzCheck *check = &evaluator->list.check[i];
        const CzCheckResult *result = check->is_target ? &evaluation->constraint_check[n_constraint]
                                                       : &evaluation->check[n_check++];
        n_constraint += check->is_constraint;
        if (!result->is_omitted && (!check->is_rule || check->scale == CZ_FLAG_SCALE))
            number[n++] = number_of_check(check, result);
    }
    for (int i = 0; i < evaluation->n_match; i++) /* their checks are the last ones */
        number[n++] = number_of_match(&evaluation->match[i], &evaluation->check[n_check + i]);
    for (int i = 0; i < N_BULK * evaluation->n_run; i++)
        number[n++] = bulk_of(cz_run_summary(evaluation->run[i / N_BULK]), i % N_BULK);
    return n;
}

/* ---- comparison ------------------------------------------------------------------------------ */

/* Whether two verdicts differ; a provisional pass is a pass. */
static bool differs(CzVerdict a, CzVerdict b) {
    return cz_verdict_passes(a) != cz_verdict_passes(b) ||
           (a == CZ_VERDICT_FAIL) != (b == CZ_VERDICT_FAIL);
}

static void begin_value(CzVerifiedValue *value, const Number *number) {
    *value = (CzVerifiedValue){.name = number->name,
                               .unit = number->unit,
                               .production = number->value,
                               .beyond_validity = number->beyond_validity};
    snprintf(value->scenario, sizeof value->scenario, "%s",
             number->scenario != NULL ? number->scenario : "");
    snprintf(value->where, sizeof value->where, "%s", number->where);
    for (int method = 0; method < CZ_N_VERIFY_METHOD; method++)
        value->value[method] = value->change[method] = NAN;
}

static void compare(CzVerification *verification, CzVerifyMethod method, int index,
                    const Number *record, const Number *again) {
    CzVerifiedValue *value = &verification->value[index];
    const double difference = fabs(again->counted - record->counted);
    value->value[method] = again->value;
    if (isfinite(record->scale))
        value->change[method] = difference == 0.0 ? 0.0 : difference / record->scale;
    value->flips[method] =
        record->check != NULL && differs(record->check->verdict, again->check->verdict);
    verification->n_flip[method] += value->flips[method];
    if (value->change[method] > verification->largest_change[method]) { /* not for NaN */
        verification->largest_change[method] = value->change[method];
        verification->worst[method] = index;
    }
}

/* Writes the name of the scenario of an evaluation that failed. */
static void write_failure(CzVerification *verification, const char *method,
                          const CzEvaluation *evaluation) {
    verification->status = CZ_STATUS_RUN_FAILED;
    snprintf(verification->failure, sizeof verification->failure, "%s: a run failed", method);
    for (int i = 0; i < evaluation->n_run; i++) {
        const CzRunSummary *run = cz_run_summary(evaluation->run[i]);
        if (run->status == CZ_OK && run->ended != CZ_ENDED_INCOMPLETE)
            continue;
        char why[220];
        snprintf(verification->failure, sizeof verification->failure, "%s, scenario %.60s: %s",
                 method, run->scenario, cz_failure_text(run, sizeof why, why));
        return;
    }
}

/* Compares the evaluation of a method with the production run. */
static void judge_method(CzVerification *verification, const CzEvaluator *evaluator,
                         CzVerifyMethod method, const CzEvaluation *evaluation,
                         const Number *record, Number *again) {
    for (int i = 0; i < evaluation->n_run; i++)
        verification->run_s[method] += cz_run_summary(evaluation->run[i])->wall_s;
    if (evaluation->status != CZ_OK) {
        write_failure(verification, methods[method].text, evaluation);
        return;
    }
    verification->is_done[method] = true;
    verification->largest_change[method] = 0.0;
    list_numbers(evaluator, evaluation, again);
    for (int i = 0; i < verification->n_value; i++)
        compare(verification, method, i, &record[i], &again[i]);
}

/* Settings of the runs of the requested methods, the solvers, which take longest, first; `place` is
 * that of each method, -1 for one that is not requested. Returns how many there are. */
static int list_manners(const CzVerification *verification, const CzEvaluator *evaluator,
                        int *place, CzManner *manner) {
    int n = 0;
    for (int is_fixed_step = 0; is_fixed_step < 2; is_fixed_step++)
        for (int method = 0; method < CZ_N_VERIFY_METHOD; method++) {
            CzManner own = manner_of(evaluator, (CzVerifyMethod)method, verification->solver_step);
            own.brief = verification->until_settled;
            if ((own.integrator == CZ_INTEGRATOR_ZHAI) != is_fixed_step)
                continue;
            const bool is_requested = (verification->methods & (1u << method)) != 0;
            place[method] = is_requested ? n : -1;
            if (is_requested)
                manner[n++] = own;
        }
    return n;
}

/* Runs all methods side by side; `number` has room for the numbers of the production run and, from
 * `most` on, for those of a method. */
static CzStatus run_methods(CzVerification *verification, const CzEvaluator *evaluator,
                            const double *x, const CzEvaluation *record, Number *number, int most,
                            CzError *error) {
    verification->n_value = list_numbers(evaluator, record, number);
    for (int i = 0; i < verification->n_value; i++)
        begin_value(&verification->value[i], &number[i]);
    int place[CZ_N_VERIFY_METHOD];
    CzManner manner[CZ_N_VERIFY_METHOD];
    CzEvaluation evaluation[CZ_N_VERIFY_METHOD];
    const int n = list_manners(verification, evaluator, place, manner);
    if (n > 0)
        CZ_TRY(cz_evaluator_repeat(evaluator, n, manner, x, evaluation, error));
    for (int method = 0; method < CZ_N_VERIFY_METHOD; method++)
        if (place[method] >= 0)
            judge_method(verification, evaluator, (CzVerifyMethod)method,
                         &evaluation[place[method]], number, number + most);
    for (int i = 0; i < n; i++)
        cz_evaluation_free(&evaluation[i]);
    return CZ_OK;
}

static CzVerdict judge(const CzVerification *verification) {
    const unsigned requested = verification->methods;
    for (int method = 0; method < CZ_N_VERIFY_METHOD; method++) {
        if ((requested & (1u << method)) == 0)
            continue;
        if (!verification->is_done[method] || verification->n_flip[method] > 0 ||
            !(verification->largest_change[method] <= verification->limit))
            return CZ_VERDICT_FAIL;
    }
    return verification->status == CZ_OK && requested != 0 ? CZ_VERDICT_PASS
                                                           : CZ_VERDICT_NOT_CHECKED;
}

/* Whether the checks of a run that ended early agree with those of the whole run; for totals, such
 * as the energy in brakes, only the verdicts. */
static bool has_same_checks(const CzEvaluator *evaluator, double limit, const CzEvaluation *whole,
                            const CzEvaluation *settled, Number *number) {
    Number *other = number + most_numbers(evaluator, whole);
    const int n = list_numbers(evaluator, whole, number);
    bool is_same = list_numbers(evaluator, settled, other) == n;
    for (int i = 0; i < n && is_same; i++) {
        const double change = fabs(other[i].counted - number[i].counted) / number[i].scale;
        const bool is_off = !number[i].is_total && change > SETTLED_SHARE * limit;
        if (number[i].check != NULL)
            is_same = !is_off && !differs(number[i].check->verdict, other[i].check->verdict);
    }
    return is_same;
}

/* Finds the runs of the design that end early, where requested and with the same checks. */
static CzStatus find_settled(CzVerification *verification, const CzEvaluator *evaluator,
                             const double *x, const CzEvaluation *record, Number *number,
                             CzEvaluation *settled, CzError *error) {
    CzManner manner = evaluator->manner;
    manner.brief = true;
    CZ_TRY(cz_evaluator_repeat(evaluator, 1, &manner, x, settled, error));
    verification->until_settled =
        settled->status == CZ_OK &&
        has_same_checks(evaluator, verification->limit, record, settled, number);
    return CZ_OK;
}

/* Runs all methods, and before them the runs that end early, with which they are compared. */
static CzStatus run_all(CzVerification *verification, const CzEvaluator *evaluator, const double *x,
                        const CzEvaluation *record, bool until_settled, CzError *error) {
    const int most = most_numbers(evaluator, record);
    Number *number = calloc(2 * (size_t)most, sizeof *number);
    CzEvaluation settled = {0};
    verification->value = calloc((size_t)most, sizeof *verification->value);
    CzStatus status = CZ_OK;
    if (number == NULL || verification->value == NULL)
        status = cz_no_memory(error, "the verification");
    else if (until_settled)
        status = find_settled(verification, evaluator, x, record, number, &settled, error);
    if (status == CZ_OK)
        status = run_methods(verification, evaluator, x,
                             verification->until_settled ? &settled : record, number, most, error);
    cz_evaluation_free(&settled);
    free(number);
    return status;
}

/* Verifies a production evaluation with its runs. */
static CzStatus verify(CzVerification *verification, CzEvaluator *evaluator, const double *x,
                       const CzEvaluation *record, const CzVerifyOptions *options, CzError *error) {
    verification->limit = options->limit;
    verification->methods = options->methods;
    verification->solver_step = options->solver_step;
    if (track_of(evaluator) == CZ_TRACK_RIGID)
        verification->methods &= ~(1u << CZ_METHOD_TRACK);
    for (int method = 0; method < CZ_N_VERIFY_METHOD; method++) {
        verification->largest_change[method] = NAN;
        verification->worst[method] = -1;
    }
    if (record->status != CZ_OK) {
        write_failure(verification, "the production run", record);
        verification->verdict = CZ_VERDICT_FAIL;
        return CZ_OK;
    }
    const volatile sig_atomic_t *stop = evaluator->stop;
    cz_evaluator_set_stop(evaluator, options->stop);
    const CzStatus status =
        run_all(verification, evaluator, x, record, options->until_settled, error);
    cz_evaluator_set_stop(evaluator, stop);
    verification->verdict = judge(verification);
    return status;
}

CzStatus cz_verify(CzEvaluator *evaluator, const double *x, const CzEvaluation *record,
                   const CzVerifyOptions *options, CzVerification **made, CzError *error) {
    const double began = cz_clock();
    const CzVerifyOptions chosen = options != NULL ? *options : cz_verify_options_default();
    CzVerification *verification = calloc(1, sizeof *verification);
    CzEvaluation own = {0};
    CzStatus status = CZ_OK;
    *made = NULL;
    if (verification == NULL)
        return cz_no_memory(error, "the verification");
    if (record == NULL)
        status = cz_evaluator_repeat(evaluator, 1, &evaluator->manner, x, &own, error);
    if (status == CZ_OK)
        status = verify(verification, evaluator, x, record != NULL ? record : &own, &chosen, error);
    cz_evaluation_free(&own);
    verification->wall_s = cz_clock() - began;
    if (status == CZ_OK)
        *made = verification;
    else
        cz_verification_free(verification);
    return status;
}

void cz_verification_free(CzVerification *verification) {
    if (verification == NULL)
        return;
    free(verification->value);
    free(verification);
}
