/* Verdicts in words, the same on a terminal and on a page. The rule is that of evaluate/verdict.c.
 */
#ifndef CZ_REPORT_VERDICT_WORDS_H
#define CZ_REPORT_VERDICT_WORDS_H

#include "crushzone/evaluate.h"
#include "report/table.h"

/* Words of a table: capital letters for all but a plain pass. */
const char *cz_verdict_word(CzVerdict verdict);
CzStyle cz_verdict_style(CzVerdict verdict);

/* Words of a banner: "PROVISIONAL PASS"; and its class on a page. */
const char *cz_verdict_title(CzVerdict verdict);
const char *cz_verdict_class(CzVerdict verdict);

/* What follows a verdict that is one by screening, as " (screening): 6 requirements of the profile
 * are not covered"; empty for others. Returns text. */
enum { CZ_SCREENING_SIZE = 96 };
const char *cz_screening_remark(CzVerdict verdict, int n_not_covered, char text[CZ_SCREENING_SIZE]);

/* What stands apart from the checks, a line each: trains that are not judged, scenarios of the
 * profile that the problem changes or that do not apply, requirements of the profile that are not
 * covered. */
void cz_not_checked_print(const CzEvaluation *evaluation, CzTerminal *terminal);
void cz_not_checked_write(const CzEvaluation *evaluation, CzMarkup *markup);

/* One line for a table or page with many verdicts: how many requirements of the profile of a
 * problem are not covered, and which, so that a pass is one by screening; nothing without one. */
void cz_screening_print(const CzProblem *problem, CzTerminal *terminal);
void cz_screening_write(const CzProblem *problem, CzMarkup *markup);

#endif
