/* The evaluation of one design from the summaries of its runs. */
#ifndef CZ_EVALUATE_COMPOSE_H
#define CZ_EVALUATE_COMPOSE_H

#include "evaluate/evaluator_parts.h"

/* Reason why a scenario has no values; NULL when it has. `run` NULL: it was left out. */
const char *cz_failure_of(const CzRunSummary *run);
/* The same in full, for a run that failed or is incomplete: its own reason, or what the end
 * criterion still waits for. Returns text. */
const char *cz_failure_text(const CzRunSummary *run, size_t room, char *text);

/* Source of metrics: a scenario with its run, or the design alone for CZ_NO_SCENARIO and no run. */
CzSubject cz_subject_of(const CzEvaluator *evaluator, const CzVehicle *vehicles, int scenario,
                        const CzRunSummary *run);

/* Fills an evaluation except its runs. `vehicles` is the vehicle array with the design's values,
 * `run` (n_scene) has NULL for scenarios that were left out, `whole` has the same runs with their
 * channels. A refused design violates a rule of files and was not run. Statuses: CZ_OK,
 * CZ_STATUS_INPUT for a match with a channel that the run does not have, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_compose(const CzEvaluator *evaluator, const CzVehicle *vehicles,
                                  const CzRunSummary *const *run, CzRun *const *whole,
                                  bool is_refused, CzEvaluation *evaluation, CzError *error);

/* Fills the details of a design whose runs were all completed (n_detail); `whole` as above.
 * Statuses: CZ_OK, CZ_STATUS_INPUT. */
CZ_MUST_CHECK CzStatus cz_compose_details(const CzEvaluator *evaluator, const CzVehicle *vehicles,
                                          const CzRunSummary *const *run, CzRun *const *whole,
                                          double *detail, CzError *error);

#endif
