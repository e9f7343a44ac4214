/* The table of checks, with or without a column for the design before. */
#ifndef CZ_REPORT_CHECKS_TABLE_H
#define CZ_REPORT_CHECKS_TABLE_H

#include <stdio.h>

#include "report/figure.h"
#include "report/markup.h"
#include "crushzone/report.h"

/* One line per check of a single scenario; of several scenarios the worst line of each check and
 * every failure, of a family of scenarios its worst failure; of scenarios that were left out one
 * line in all. `before` (NULL for none) is an
 * evaluation with the same checks. Ends with a line that counts the verdicts. */
bool cz_checks_write_table(const CzEvaluation *evaluation, const CzEvaluation *before, bool colour,
                           FILE *stream);

/* The rows of a page: those that are shown, or the rest; failures first. `before` as above. */
void cz_checks_write_rows(CzMarkup *markup, const CzEvaluation *evaluation,
                          const CzEvaluation *before, bool rest);

/* A value in its unit, with as many digits as set it apart from its limit when it breaks it. */
void cz_checks_format_value(const CzCheckResult *check, size_t room, char *text);

/* The limit in its unit; a lower one says so. */
void cz_checks_format_limit(const CzCheckResult *check, size_t room, char *text);

/* Its verdict as people read it: "pass", "FAIL", "n/a". */
const char *cz_checks_word(const CzCheckResult *check);

/* Whether a table that is short of room shows check i: it fails, or it is the worst of its name. */
bool cz_checks_is_shown(const CzEvaluation *evaluation, int i);

/* Number of checks of scenarios that were left out. */
int cz_checks_n_omitted(const CzEvaluation *evaluation);

/* How a search ended, in capital letters; of a fit, about its tolerances. */
const char *cz_outcome_words(const CzEvaluator *evaluator, const CzOutcome *outcome);

/* A value or bound of a variable: a bound to its last digit, any other value with six, or with all
 * of them where six would read as a bound that it is not at. */
const char *cz_outcome_number(char text[CZ_FIGURE_ROOM], const CzVariableInfo *variable,
                              double value);

/* What is to be said of a variable beside its values: that it is fixed, or at its bound; else "".
 */
const char *cz_outcome_remark(const CzVariableInfo *variable, bool is_at_bound);

#endif
