/* Sensitivities at the best design, as secants:
 *
 *   change_ij = c_i(x + h_j e_j) - c_i(x)
 *
 * where h_j is one catalogue increment or more, at least 2 % of the range, and negative at the
 * upper bound. A step of this size is a change that a designer would make; a derivative would be
 * dominated by the chaotic response of a long train. Both designs are run as in a search, so that
 * only the design differs.
 */

#include "base/error.h"
#include "evaluate/evaluator.h"
#include "evaluate/listed.h"
#include "optimise/outcome.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SMALLEST_SHARE 0.02 /* smallest step as a share of a variable's range (ours) */

/* The step of a variable at a value, negative towards the lower bound; 0 when there is none. */
static double step_of(const CzVariableInfo *variable, double value) {
    const double range = variable->max - variable->min;
    if (variable->n_value > 1) { /* to the next size of the list */
        const double place = cz_listed_place(variable, value);
        const bool is_last = place >= variable->n_value - 1;
        return cz_listed_value(variable, is_last ? place - 1 : floor(place) + 1) - value;
    }
    if (variable->n_choice > 0 || variable->is_fixed || !(range > 0))
        return 0;
    double step = SMALLEST_SHARE * range;
    if (variable->increment > 0)
        step = variable->increment * fmax(ceil(step / variable->increment - 1e-9), 1);
    if (value + step <= variable->max)
        return step;
    return value - step >= variable->min ? -step : 0;
}

static void keep_changes(CzOutcome *outcome, int variable, const CzEvaluation *base,
                         const CzEvaluation *changed) {
    const int n = base->n_constraint;
    outcome->objective_change[variable] = changed->objective - base->objective;
    for (int i = 0; i < n; i++) /* a yes or no has no margin that could change */
        outcome->constraint_change[variable * n + i] =
            base->constraint_check[i].is_flag ? NAN : changed->constraint[i] - base->constraint[i];
}

static CzStatus evaluate(CzEvaluator *evaluator, CzOutcome *outcome, CzError *error) {
    const int n = outcome->n_variable;
    const double *h = outcome->sensitivity_increment;
    double *x = malloc((size_t)(n + 1) * (size_t)n * sizeof *x);
    CzEvaluation *evaluation = calloc((size_t)n + 1, sizeof *evaluation);
    CzStatus status;
    if (x == NULL || evaluation == NULL) {
        status = cz_no_memory(error, "the sensitivities");
    } else {
        for (int point = 0; point <= n; point++) {
            memcpy(&x[point * n], outcome->best, (size_t)n * sizeof *x);
            if (point > 0)
                x[point * n + point - 1] += h[point - 1];
        }
        status = cz_evaluator_search(evaluator, n + 1, x, evaluation, NULL, error);
    }
    for (int point = 1; point <= n && status == CZ_OK; point++)
        if (h[point - 1] != 0 && evaluation[0].status == CZ_OK && evaluation[point].status == CZ_OK)
            keep_changes(outcome, point - 1, &evaluation[0], &evaluation[point]);
    for (int point = 0; evaluation != NULL && point <= n; point++)
        cz_evaluation_free(&evaluation[point]);
    free(evaluation);
    free(x);
    return status;
}

static void cut_short(CzOutcome *outcome) {
    outcome->sensitivity_increment = NULL;
    cz_outcome_cut_short(outcome, "sensitivities");
}

CzStatus cz_sensitivity_take(CzEvaluator *evaluator, const volatile sig_atomic_t *stop,
                             CzOutcome *outcome, CzError *error) {
    const size_t n = (size_t)outcome->n_variable;
    const size_t n_constraint = (size_t)outcome->best_evaluation.n_constraint;
    if (stop != NULL && *stop != 0) {
        cut_short(outcome);
        return CZ_OK;
    }
    double *increment = cz_outcome_numbers(outcome, n);
    outcome->objective_change = cz_outcome_numbers(outcome, n);
    outcome->constraint_change = cz_outcome_numbers(outcome, n * n_constraint);
    if (increment == NULL || outcome->objective_change == NULL ||
        outcome->constraint_change == NULL)
        return cz_no_memory(error, "the sensitivities");
    outcome->sensitivity_increment = increment;
    for (size_t i = 0; i < n; i++) {
        increment[i] = step_of(cz_evaluator_variable(evaluator, (int)i), outcome->best[i]);
        outcome->objective_change[i] = NAN;
    }
    for (size_t i = 0; i < n * n_constraint; i++)
        outcome->constraint_change[i] = NAN;
    cz_evaluator_set_stop(evaluator, stop);
    const CzStatus status = evaluate(evaluator, outcome, error);
    cz_evaluator_set_stop(evaluator, NULL);
    if (status != CZ_STATUS_INTERRUPTED)
        return status;
    cut_short(outcome);
    return CZ_OK;
}
