/* Results that are looked at again: a result folder or a problem file, run once more. */
#ifndef CZ_CLI_RESULT_H
#define CZ_CLI_RESULT_H

#include "cli/recall.h"

/* A run to draw from. */
typedef struct CzResult {
    CzArguments arguments; /* of this result: with the scenario that its folder holds */
    CzRunLog log;          /* of that folder */
    char file[4096];       /* what is run: resolved.yaml of a folder */
    CzSession session;
    CzEvaluation evaluation;
    CzReportRun run; /* label: the operand */
} CzResult;

/* Runs what a folder holds, or a problem file, with everything recorded: the same bytes come out as
 * when the folder was written, so nothing that a figure needs has to be stored. Before that it is
 * tried whether `output` can be written, NULL for none. Reports what is wrong and returns the exit
 * code, 0 when all is well; end with cz_result_end in any case. */
CZ_MUST_CHECK int cz_result_begin(CzResult *result, const CzArguments *arguments,
                                  const char *operand, const char *output);
void cz_result_end(CzResult *result);

/* Whether a file can be written, before it is computed; `problem` is NULL when none was read yet.
 * Returns the exit code. */
CZ_MUST_CHECK int cz_result_check(const CzArguments *arguments, const CzProblem *problem,
                                  const char *path);

/* Writes a file whole or not at all; "-" is standard output. Returns the exit code. */
CZ_MUST_CHECK int cz_result_write(const CzArguments *arguments, const char *path,
                                  CzReportWriter *write, const void *data);

#endif
