/* Composing the answer of one design from the summaries of its runs. */
#ifndef CZ_EVALUATE_COMPOSE_H
#define CZ_EVALUATE_COMPOSE_H

#include "evaluate/evaluator_parts.h"

/* What a metric is read from: a scenario with its run, or CZ_NO_SCENARIO and no run. */
CzSubject cz_subject_of(const CzEvaluator *evaluator, const CzVehicle *vehicles, int scenario,
                        const CzRunSummary *run);

/* Fills an evaluation but for its runs. `vehicles` is the vehicle array with the design's values,
 * `run` (n_scene) with NULL for scenarios that were left out. Status: CZ_OK, CZ_STATUS_NO_MEMORY.
 */
CZ_MUST_CHECK CzStatus cz_compose(const CzEvaluator *evaluator, const CzVehicle *vehicles,
                                  const CzRunSummary *const *run, CzEvaluation *evaluation,
                                  CzError *error);

/* Fills the details of a design whose runs all came to their end (n_detail). */
void cz_compose_details(const CzEvaluator *evaluator, const CzVehicle *vehicles,
                        const CzRunSummary *const *run, double *detail);

#endif
