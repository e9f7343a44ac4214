/* Tables of a search, for the terminal and for the page. */
#ifndef CZ_REPORT_OUTCOME_TABLE_H
#define CZ_REPORT_OUTCOME_TABLE_H

#include "crushzone/report.h"
#include "report/table.h"

/* Bounds and values of the variables; on a page with a drawing of the values between the bounds. */
void cz_outcome_begin_variables(CzReportTable *table, const CzReport *report, bool on_page);

/* A row of a table of constraints; these heads come after that of the name. */
#define CZ_CONSTRAINT_HEADS "where;scenario;>limit;>value;>margin"
void cz_outcome_put_constraint(CzReportTable *table, const CzEvaluator *evaluator,
                               const CzEvaluation *best, int i, double margin);

/* End of a search, in capital letters; for a fit with respect to its tolerances. */
const char *cz_outcome_words(const CzEvaluator *evaluator, const CzOutcome *outcome);

/* A sentence on the scenarios that the search selected, "" when it ran all designs in all of them;
 * `room` bytes. */
void cz_scenario_use_sentence(const CzOutcome *outcome, size_t room, char *text);

/* A sentence on a design that was not verified, without a full stop; `room` bytes. */
void cz_rejected_sentence(const CzReport *report, const CzRejected *rejected, size_t room,
                          char *text);

/* The largest change by each method of a verification. */
void cz_verified_begin_methods(CzReportTable *table, const CzVerification *verification,
                               bool on_page);

#endif
