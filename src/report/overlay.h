/* The optimum as settings of a problem file. */
#ifndef CZ_REPORT_OVERLAY_H
#define CZ_REPORT_OVERLAY_H

#include <stdio.h>

#include "base/arena.h"
#include "crushzone/report.h"

/* Settings "path=value" that turn the problem file into the best design: those of the command line
 * in `options`, then the best value of every place that a variable drives, exact to the last bit.
 * No path stands twice. NULL when there is no memory; lives as long as the arena. */
const char **cz_overlay_settings(const CzEvaluator *evaluator, const CzOutcome *outcome,
                                 const CzReportOptions *options, CzArena *arena, int *n_setting);

/* Writes settings as the record `set:`. */
void cz_overlay_write_set(int n_setting, const char *const *setting, FILE *stream);

/* Reads the problem again with the best values; the caller frees *best, also after a failure.
 * Statuses: as cz_problem_read. */
CZ_MUST_CHECK CzStatus cz_overlay_read_best(const CzProblem *problem, const CzEvaluator *evaluator,
                                            const CzOutcome *outcome,
                                            const CzReportOptions *options, CzProblem **best,
                                            CzError *error);

/* Writes the whole problem with the best values, as it is when it is read again with them. Status:
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_overlay_write_resolved(const CzProblem *problem,
                                                 const CzEvaluator *evaluator,
                                                 const CzOutcome *outcome,
                                                 const CzReportOptions *options, FILE *stream,
                                                 CzError *error);

#endif
