/* An outcome: its memory and its parts. */
#ifndef CZ_OPTIMISE_OUTCOME_H
#define CZ_OPTIMISE_OUTCOME_H

#include "optimise/combinations.h"

/* Creates an outcome with room for n_trial trials; start and best are those of the evaluator.
 * Status: CZ_OK, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_outcome_create(const CzEvaluator *evaluator, long n_trial,
                                         CzOutcome **outcome, CzError *error);

/* Memory of the outcome for n numbers; NULL when there is none. */
double *cz_outcome_numbers(CzOutcome *outcome, size_t n);
CzOrderedMargin *cz_outcome_margins(CzOutcome *outcome, size_t n);
CzMultiplier *cz_outcome_multipliers(CzOutcome *outcome, size_t n);

/* Passes an outcome on, or frees it where the status is a failure; returns the status. */
CzStatus cz_outcome_pass_on(CzOutcome *made, CzStatus status, CzOutcome **outcome);

/* Fills `at_bound` from `best`. */
void cz_outcome_mark_bounds(const CzEvaluator *evaluator, CzOutcome *outcome);

/* Memory of the outcome for n designs that are not verified; NULL when there is none. */
CzRejected *cz_outcome_rejected(CzOutcome *outcome, size_t n);

/* Fills the history and the runs by scenario from the searches so far. Status: CZ_OK,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_outcome_take_history(CzOutcome *outcome,
                                               const CzCombinations *combinations, CzError *error);

/* Whether every variable of a design (n_variable) is on its catalogue increment. */
bool cz_is_on_increments(const CzEvaluator *evaluator, const double *x);

/* Verifies a design with the methods of a search; `whole` is its evaluation with the runs kept,
 * NULL when it has to be made. Statuses: those of cz_verify. */
CZ_MUST_CHECK CzStatus cz_outcome_verify_design(CzEvaluator *evaluator,
                                                const CzOptimiseOptions *options, const double *x,
                                                const CzEvaluation *whole,
                                                CzVerification **verification, CzError *error);

/* Verifies the best design when it passes, and sets the status by it. After a signal it remains
 * unverified, and the outcome is interrupted. */
CZ_MUST_CHECK CzStatus cz_outcome_verify(CzEvaluator *evaluator, const CzOptimiseOptions *options,
                                         CzOutcome *outcome, CzError *error);

/* Leaves scenarios out of what follows an interruption, so that it takes about a second whatever
 * their number: where there are more than eight, all but the two with the smallest margins by
 * `detail` (n_detail, of a design in the search; NULL: the first two) are not checked (ours).
 * Statuses: CZ_OK, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_outcome_leave_out(CzEvaluator *evaluator, int n_detail,
                                            const double *detail, CzError *error);

/* Notes that the stop flag left out a part of the results, unless the search itself was interrupted
 * or an earlier part was left out. */
void cz_outcome_cut_short(CzOutcome *outcome, const char *part);

/* Adds to the outcome of a fit the best parameter sets that fit about as well as record `best` and
 * are distant from it and from one another (alternatives.c). Statuses: CZ_OK,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_alternatives_find(const CzSubspace *subspace, long best,
                                            CzOutcome *outcome, CzError *error);

/* Fills `sensitivity_increment`, `objective_change` and `constraint_change` from one run of each
 * changed design, with the run settings of a search; leaves the first NULL when the stop flag is
 * set (sensitivity.c). Statuses: CZ_OK, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_sensitivity_take(CzEvaluator *evaluator,
                                           const volatile sig_atomic_t *stop, CzOutcome *outcome,
                                           CzError *error);

/* Evaluates the start (outcome.c). Once the best design is final, the deciding one of its runs is
 * recorded for the start, too: all runs of both together can need gigabytes. Statuses: those of
 * cz_evaluate. */
CZ_MUST_CHECK CzStatus cz_outcome_evaluate_start(CzEvaluator *evaluator, CzOutcome *outcome,
                                                 CzError *error);
CZ_MUST_CHECK CzStatus cz_outcome_record_start(const CzEvaluator *evaluator, CzOutcome *outcome,
                                               CzError *error);

/* Fills `stationarity` and `multiplier` from the sensitivities (stationarity.c). Statuses: CZ_OK,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_stationarity_find(const CzEvaluator *evaluator, CzOutcome *outcome,
                                            CzError *error);

/* Fills `margin` from the sensitivities (margin_order.c). Statuses: CZ_OK, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_margins_order(const CzEvaluator *evaluator, CzOutcome *outcome,
                                        CzError *error);

/* Fills `relaxation` when no design passes, by short searches of the least violation of one limit
 * with all others satisfied (relaxation.c); a design that passes without a relaxation becomes the
 * best design, not yet verified. Statuses: those of cz_evaluate; CZ_OK after the stop
 * flag was set. */
CZ_MUST_CHECK CzStatus cz_relaxation_find(CzEvaluator *evaluator, const CzOptimiseOptions *given,
                                          CzOutcome *outcome, CzError *error);

#endif
