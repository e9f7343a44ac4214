/* The two parts of the explanation of checks: what happened, and what would help. */
#ifndef CZ_EVALUATE_EXPLAIN_PARTS_H
#define CZ_EVALUATE_EXPLAIN_PARTS_H

#include "crushzone/explain.h"
#include "evaluate/evaluator_parts.h"

/* Chooses the checks to explain and describes, from runs that were recorded, when and where their
 * values arose and what carried the force (explain_checks.c). Statuses: CZ_OK, CZ_STATUS_INPUT for
 * a name that is no check, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_explain_checks(const CzEvaluator *evaluator,
                                         const CzEvaluation *evaluation,
                                         const CzExplainOptions *options,
                                         CzExplanation *explanation, CzError *error);

/* Runs changes of single numbers and adds those that help to the explained checks
 * (explain_changes.c). Statuses as of cz_evaluate. */
CZ_MUST_CHECK CzStatus cz_explain_changes(CzEvaluator *evaluator, const CzExplainOptions *options,
                                          CzExplanation *explanation, CzError *error);

#endif
