/* Tables of a search, for the terminal and for the page. */
#ifndef CZ_REPORT_OUTCOME_TABLE_H
#define CZ_REPORT_OUTCOME_TABLE_H

#include "crushzone/report.h"
#include "report/table.h"

/* Bounds and values of the variables; on a page with a drawing of where they are. */
void cz_outcome_begin_variables(CzReportTable *table, const CzEvaluator *evaluator,
                                const CzOutcome *outcome, bool on_page);

/* Constraints: begins the table, `left` being the head of its last column; then a row for one, with
 * what is left of it. */
void cz_outcome_begin_constraints(CzReportTable *table, const char *name, const char *left);
void cz_outcome_put_constraint(CzReportTable *table, const CzEvaluator *evaluator,
                               const CzEvaluation *best, int i, double left);

/* What each method of a verification changes most. */
void cz_verified_begin_methods(CzReportTable *table, const CzVerification *verification,
                               bool on_page);

#endif
