/* One problem file on its way through a command. */
#ifndef CZ_CLI_SESSION_H
#define CZ_CLI_SESSION_H

#include "cli/arguments.h"
#include "crushzone/report.h"

typedef struct CzSession {
    const CzArguments *arguments;
    const char *file;
    CzProblem *problem;
    CzEvaluator *evaluator;
    char *text;           /* what came from standard input; NULL when a file was read */
    size_t n_text;        /* [byte] */
    double setup_s;       /* reading and building [s] */
    const char *word[10]; /* options that results depend on, but for settings (n_word) */
    int n_word;
} CzSession;

/* Folder of shipped data of this program (share_folder.c). */
extern const char *const cz_share_folder;

/* How this program reads problem files: settings of the command line, shipped data. */
CzProblemOptions cz_session_problem_options(const CzArguments *arguments);

/* Reads a problem file with the settings of the command line and reports its mistakes and warnings.
 * Returns the exit code, 0 when all is well; end with cz_session_end in any case. */
CZ_MUST_CHECK int cz_session_read(CzSession *session, const CzArguments *arguments,
                                  const char *file);

/* The same, with an evaluator. */
CZ_MUST_CHECK int cz_session_begin(CzSession *session, const CzArguments *arguments,
                                   const char *file);
void cz_session_end(CzSession *session);

/* How the results of this session are written. */
CzReportOptions cz_session_report_options(const CzSession *session, double wall_s);

/* Prints results: a JSON document with --json, else tables. Reports a failure and returns its exit
 * code, 0 when all is well. */
CZ_MUST_CHECK int cz_print_results(const CzArguments *arguments, const CzReport *report);

/* Whether results can be written to a folder (NULL: to none), before anything runs in vain; returns
 * the exit code. */
CZ_MUST_CHECK int cz_session_check_folder(const CzSession *session, const char *folder,
                                          bool replaces_search);

/* Reports a failure of this session's problem; returns its exit code. */
int cz_session_fail(const CzSession *session, const CzError *error);

#endif
