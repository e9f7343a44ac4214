/* Existing results: a result folder or a problem file that is run again. */
#ifndef CZ_CLI_RESULT_H
#define CZ_CLI_RESULT_H

#include "cli/recall.h"

/* A run from which figures are drawn. */
typedef struct CzResult {
    CzArguments arguments; /* of this result, with the scenario of its folder */
    CzRunLog log;          /* of that folder */
    char file[4096];       /* file that is run: resolved.yaml of a folder */
    CzSession session;
    CzEvaluation evaluation;
    CzReportRun run; /* label: the operand */
} CzResult;

/* Runs the problem of a folder, or a problem file, with everything recorded. The results are the
 * same bytes as those in the folder, so that data of figures need not be stored. It first checks
 * whether `output` can be written (NULL for none). Reports failures and returns the exit code, 0 on
 * success; end with cz_result_end in any case. */
CZ_MUST_CHECK int cz_result_begin(CzResult *result, const CzArguments *arguments,
                                  const char *operand, const char *output);
void cz_result_end(CzResult *result);

/* Checks whether a file can be written, before it is computed; `problem` is NULL when none was read
 * yet. Returns the exit code. */
CZ_MUST_CHECK int cz_result_check(const CzArguments *arguments, const CzProblem *problem,
                                  const char *path);

/* Writes a file whole or not at all; "-" is standard output. Returns the exit code. */
CZ_MUST_CHECK int cz_result_write(const CzArguments *arguments, const char *path,
                                  CzReportWriter *write, const void *data);

#endif
