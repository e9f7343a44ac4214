/* Parts of the report of a search. */
#ifndef CZ_REPORT_PAGE_OUTCOME_H
#define CZ_REPORT_PAGE_OUTCOME_H

#include "report/page.h"

/* The most critical constraint that is not among the first n; -1 when there is none. */
int cz_page_next_constraint(const CzEvaluation *evaluation, int n_told, const int *told);

/* All designs of the search as lines over the variables (page_designs.c); nothing for fewer than
 * two variables. */
CZ_MUST_CHECK CzStatus cz_page_write_designs(CzMarkup *markup, const CzEvaluator *evaluator,
                                             const CzOutcome *outcome, CzError *error);
/* Change of objective and critical margins per increment of each variable (page_designs.c). */
void cz_page_write_sensitivities(CzMarkup *markup, const CzEvaluator *evaluator,
                                 const CzOutcome *outcome);

#endif
