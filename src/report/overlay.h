/* The optimum as settings of a problem file. */
#ifndef CZ_REPORT_OVERLAY_H
#define CZ_REPORT_OVERLAY_H

#include <stdio.h>

#include "crushzone/report.h"

/* Writes `set:` with the settings of the command line in `options` (NULL for none) and the best
 * value of every place that a variable drives, exact to the last bit. */
void cz_overlay_write_set(const CzEvaluator *evaluator, const CzOutcome *outcome,
                          const CzReportOptions *options, FILE *stream);

#endif
