/* The smallest margins of the best design in order, and which of them no variable can raise. */
#include "base/error.h"
#include "evaluate/evaluator.h"
#include "optimise/outcome.h"

#include <math.h>
#include <stdlib.h>

enum { MAX_MARGINS = 8 };

/* Change of a margin by an increment of a variable below which it does not depend on it (ours). */
static const double least_change = 1e-4;

/* Whether no variable raises a constraint's margin: each leaves it as it is, or is at its bound and
 * lowers it on the way back. */
static bool is_capped(const CzOutcome *outcome, int constraint) {
    for (int i = 0; i < outcome->n_variable; i++) {
        const double change =
            -outcome->constraint_change[i * outcome->best_evaluation.n_constraint + constraint];
        const bool is_known = outcome->sensitivity_increment[i] != 0 && isfinite(change);
        if (is_known &&
            (change > least_change || (change < -least_change && !outcome->at_bound[i])))
            return false;
    }
    return true;
}

/* By margin, of equal ones the earlier constraint first. */
static int compare(const void *one, const void *other) {
    const CzOrderedMargin *a = one, *b = other;
    if (a->margin != b->margin)
        return a->margin < b->margin ? -1 : 1;
    return (a->constraint > b->constraint) - (a->constraint < b->constraint);
}

CzStatus cz_margins_order(const CzEvaluator *evaluator, CzOutcome *outcome, CzError *error) {
    const CzEvaluation *best = &outcome->best_evaluation;
    if (!cz_evaluator_maximises_margin(evaluator) || outcome->sensitivity_increment == NULL ||
        best->status != CZ_OK || best->violation > 0)
        return CZ_OK;
    outcome->margin = cz_outcome_margins(outcome, (size_t)best->n_constraint);
    if (outcome->margin == NULL)
        return cz_no_memory(error, "the margins of a design");
    int n = 0;
    for (int j = 0; j < best->n_constraint; j++)
        if (cz_evaluator_constraint_kind(evaluator, j) == CZ_CONSTRAINT_GRADED &&
            isfinite(best->constraint_check[j].margin))
            outcome->margin[n++] =
                (CzOrderedMargin){.constraint = j, .margin = best->constraint_check[j].margin};
    qsort(outcome->margin, (size_t)n, sizeof *outcome->margin, compare);
    outcome->n_margin = n < MAX_MARGINS ? n : MAX_MARGINS;
    for (int i = 0; i < outcome->n_margin; i++)
        outcome->margin[i].is_capped = is_capped(outcome, outcome->margin[i].constraint);
    return CZ_OK;
}
