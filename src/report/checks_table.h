/* The table of checks, with or without a column for the design before. */
#ifndef CZ_REPORT_CHECKS_TABLE_H
#define CZ_REPORT_CHECKS_TABLE_H

#include "crushzone/report.h"
#include "report/figure.h"
#include "report/table.h"

/* Writes a line per check of a single scenario; of several scenarios the worst line of each check
 * and every failure, of a family of scenarios its worst failure; of a scenario without a run one
 * line. `before` (NULL for none) is an evaluation with the same checks. The last line counts the
 * verdicts. */
void cz_checks_write_table(const CzEvaluation *evaluation, const CzEvaluation *before,
                           CzTerminal *terminal);

/* The rows of a page: those that are shown, with a line for each scenario without a run, or the
 * rest; failures first. `before` as above. */
void cz_checks_write_rows(CzMarkup *markup, const CzEvaluation *evaluation,
                          const CzEvaluation *before, bool rest);

/* A value in its unit, with enough digits to differ from a limit that it violates; the limit in its
 * unit, a lower limit with "min" in front; of a yes or no the words. Both return a text. */
enum { CZ_CHECK_SIZE = 96 };
const char *cz_checks_value(char text[CZ_CHECK_SIZE], const CzCheckResult *check);
const char *cz_checks_limit(char text[CZ_CHECK_SIZE], const CzCheckResult *check);

/* Time at which the value was reached, or window of a mean [ms]; empty where it is not known. */
void cz_checks_time(const CzCheckResult *check, size_t room, char *text);

/* The verdict in a table: "pass", "FAIL", "n/a". */
const char *cz_checks_word(const CzCheckResult *check);

/* Whether a short table shows check i: it fails, or it is the worst of its name. */
bool cz_checks_is_shown(const CzEvaluation *evaluation, int i);

/* Whether a check does not apply to this problem, so that it passes. */
bool cz_checks_does_not_apply(const CzCheckResult *check);

/* The scenario of a check, or its family. */
const char *cz_checks_scenario(const CzCheckResult *check);

#endif
