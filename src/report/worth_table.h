/* What limits and bounds are worth at the best design of a search, and which limits conflict. */
#ifndef CZ_REPORT_WORTH_TABLE_H
#define CZ_REPORT_WORTH_TABLE_H

#include "crushzone/report.h"
#include "report/markup.h"
#include "report/table.h"

/* Whether the outcome has a condition of an optimum. */
bool cz_worth_is_known(const CzOutcome *outcome);

/* A sentence on the condition of an optimum, or on the limits that conflict; `room` bytes. */
void cz_worth_sentence(const CzReport *report, size_t room, char *text);

/* The worth of each limit and bound. */
void cz_worth_begin_table(CzReportTable *table, const CzReport *report);

/* The smallest margins in order; whether there are any that no variable raises. */
bool cz_margins_are_capped(const CzOutcome *outcome);
void cz_margins_begin_table(CzReportTable *table, const CzReport *report);

/* A sentence on the smallest relaxation of one limit, "" when none is known; `room` bytes. */
void cz_relaxation_sentence(const CzReport *report, size_t room, char *text);

/* Number of scenarios in which the best design violates the check of a constraint, where this
 * constraint is the worst of them; 0 for all others. */
int cz_worth_n_violated(const CzEvaluation *best, int constraint);

#endif
