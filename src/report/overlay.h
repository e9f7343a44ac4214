/* The optimum as settings of a problem file. For reports of a search only. */
#ifndef CZ_REPORT_OVERLAY_H
#define CZ_REPORT_OVERLAY_H

#include <stdio.h>

#include "crushzone/report.h"

/* Writes the record `set:` of the best design: with `all` the settings of the command line first,
 * then the best value of every place that a variable sets, exact to the last bit. Status:
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_overlay_write_values(const CzReport *report, bool all, FILE *stream,
                                               CzError *error);

/* Reads the problem again with the best values; the caller frees *best, also after a failure.
 * Statuses: as cz_problem_read. */
CZ_MUST_CHECK CzStatus cz_overlay_read_best(const CzReport *report, CzProblem **best,
                                            CzError *error);

/* Writes the resolved problem with the best values. Status: CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_overlay_write_resolved(const CzReport *report, FILE *stream,
                                                 CzError *error);

/* Writes a design, outcome->best, as a problem file for `folder`: `extends:` the problem's file and
 * `set:` the best values. A problem that came from standard input is written out whole. Statuses:
 * CZ_STATUS_OUTPUT, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_overlay_write_design(const CzReport *report, const char *folder,
                                               FILE *stream, CzError *error);

/* Writes the optimum likewise, below a comment with its quality. */
CZ_MUST_CHECK CzStatus cz_overlay_write(const CzReport *report, const char *folder, FILE *stream,
                                        CzError *error);

/* Begins a problem file of the result folder `folder`: `extends:` the file of the problem and
 * `set:` the settings of the command line; `above` leads from its own folder up to that one, such
 * as "../".
 */
void cz_overlay_write_base(const CzReport *report, const CzProblem *problem, const char *folder,
                           const char *above, FILE *stream);
/* Writes a text in double quotes. */
void cz_overlay_write_text(const char *text, FILE *stream);

#endif
