/* A session: the problem file of a command, its evaluator, and its results. */
#ifndef CZ_CLI_SESSION_H
#define CZ_CLI_SESSION_H

#include "cli/arguments.h"
#include "crushzone/report.h"

typedef struct CzSession {
    const CzArguments *arguments;
    const char *file;
    CzProblem *problem;
    CzEvaluator *evaluator;
    char *text;           /* text from standard input; NULL when a file was read */
    size_t n_text;        /* [byte] */
    double setup_s;       /* reading and building [s] */
    const char *word[16]; /* options that change results, except settings (n_word) */
    int n_word;
    CzJunit *junit;          /* of a study; NULL without --junit */
    bool is_judged;          /* the verdicts of the study are in it */
    CzReportOptions options; /* of its results, set by cz_session_report */
} CzSession;

/* Folder of shipped data of this program (share_folder.c). */
extern const char *const cz_share_folder;

/* Options for reading problem files: settings of the command line, folder of shipped data. */
CzProblemOptions cz_session_problem_options(const CzArguments *arguments);

/* Options of the evaluator of the command line. */
CzEvaluatorOptions cz_session_evaluator_options(const CzArguments *arguments);

/* Reads a problem file with the settings of the command line and reports its mistakes and warnings.
 * Returns the exit code, 0 on success; end with cz_session_end in any case. */
CZ_MUST_CHECK int cz_session_read(CzSession *session, const CzArguments *arguments,
                                  const char *file);

/* The same, with an evaluator. */
CZ_MUST_CHECK int cz_session_begin(CzSession *session, const CzArguments *arguments,
                                   const char *file);
void cz_session_end(CzSession *session);

/* The report of this session for writing; the caller adds the results of its kind. */
CzReport cz_session_report(CzSession *session, CzReportKind kind, double wall_s);

/* Prints results, a JSON document with --json, else tables; writes their folder (NULL: none). Both
 * report a failure and return its exit code, 0 on success. */
CZ_MUST_CHECK int cz_print_results(const CzArguments *arguments, const CzReport *report);
CZ_MUST_CHECK int cz_save_results(const CzArguments *arguments, const CzReport *report,
                                  const char *folder);

/* Whether results can be written to a folder (NULL: to none), before any run; returns the exit
 * code. */
CZ_MUST_CHECK int cz_session_check_folder(const CzSession *session, const char *folder,
                                          bool replaces_search);

/* Writes the file of --depfile, if any: a document in the result folder (NULL: none) depends on the
 * files of the problem. Returns the exit code of a failure, 0 without. */
CZ_MUST_CHECK int cz_session_write_depfile(const CzSession *session, const char *folder,
                                           const char *document);

/* Writes the folder of -o, if any, then prints, and adds verdicts to the document of --junit;
 * returns the exit code of a failure, 0 without. */
CZ_MUST_CHECK int cz_session_deliver(CzSession *session, const CzReport *report);

/* A command that studies a problem by many runs: reads the problem, reports its mistakes, checks
 * that the folder of -o can be written, and calls `study`, which returns the exit code; `data` is
 * passed on to it. */
typedef int (*CzStudy)(CzSession *session, void *data);
int cz_session_study(const CzArguments *arguments, CzStudy study, void *data);

/* Reports a failure of this session's problem; returns its exit code. */
int cz_session_fail(const CzSession *session, const CzError *error);

#endif
