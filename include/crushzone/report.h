/* Results as text and files: pure functions from const structs to a stream or a folder. */
#ifndef CRUSHZONE_REPORT_H
#define CRUSHZONE_REPORT_H

#include <stdio.h>

#include "crushzone/optimise.h"

#ifdef __cplusplus
extern "C" {
#endif

/* JSON documents `crushzone.summary` and `crushzone.outcome`. Status: CZ_STATUS_OUTPUT when the
 * stream fails. */
CZ_MUST_CHECK CZ_API CzStatus cz_report_write_summary(const CzProblem *problem,
                                                      const CzEvaluation *evaluation, FILE *stream,
                                                      CzError *error);
CZ_MUST_CHECK CZ_API CzStatus cz_report_write_outcome(const CzProblem *problem,
                                                      const CzEvaluator *evaluator,
                                                      const CzOutcome *outcome, FILE *stream,
                                                      CzError *error);

/* The table of a run on a terminal. `colour` allows escape codes. */
CZ_API void cz_report_write_table(const CzProblem *problem, const CzEvaluation *evaluation,
                                  bool colour, FILE *stream);

/* Writes a whole result folder: to a temporary name first, renamed at the end; replaces only a
 * folder of our own. */
CZ_MUST_CHECK CZ_API CzStatus cz_report_write_folder(const CzProblem *problem,
                                                     const CzEvaluation *evaluation,
                                                     const char *folder, CzError *error);

#ifdef __cplusplus
}
#endif
#endif
