/* Parts of the report of a search. */
#ifndef CZ_REPORT_PAGE_OUTCOME_H
#define CZ_REPORT_PAGE_OUTCOME_H

#include "report/page.h"

/* The constraint with least left that has not been reported; -1 when there is none. */
int cz_page_next_constraint(const CzEvaluation *evaluation, int n_told, const int *told);

/* All designs that were looked at, as lines over the variables (page_designs.c). Nothing for fewer
 * than two variables. */
CZ_MUST_CHECK CzStatus cz_page_write_designs(CzMarkup *markup, const CzEvaluator *evaluator,
                                             const CzOutcome *outcome, CzError *error);
/* Sensitivities per increment of each variable would change (page_designs.c). */
void cz_page_write_sensitivities(CzMarkup *markup, const CzEvaluator *evaluator,
                                 const CzOutcome *outcome);

#endif
