/* The optimum as settings of a problem file. */
#ifndef CZ_REPORT_OVERLAY_H
#define CZ_REPORT_OVERLAY_H

#include <stdio.h>

#include "crushzone/report.h"

/* Writes the record `set:` of the best design: the settings of the command line in `options` (NULL:
 * none), then the best value of every place that a variable sets, exact to the last bit. Status:
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_overlay_write_values(const CzEvaluator *evaluator,
                                               const CzOutcome *outcome,
                                               const CzReportOptions *options, FILE *stream,
                                               CzError *error);

/* Reads the problem again with the best values; the caller frees *best, also after a failure.
 * Statuses: as cz_problem_read. */
CZ_MUST_CHECK CzStatus cz_overlay_read_best(const CzProblem *problem, const CzEvaluator *evaluator,
                                            const CzOutcome *outcome,
                                            const CzReportOptions *options, CzProblem **best,
                                            CzError *error);

/* Writes the resolved problem with the best values. Status: CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_overlay_write_resolved(const CzProblem *problem,
                                                 const CzEvaluator *evaluator,
                                                 const CzOutcome *outcome,
                                                 const CzReportOptions *options, FILE *stream,
                                                 CzError *error);

#endif
