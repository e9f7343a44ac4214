/* Messages in addition to the results: mistakes with their place, warnings, notes. */
#ifndef CZ_CLI_MESSAGES_H
#define CZ_CLI_MESSAGES_H

#include "cli/arguments.h"
#include "crushzone/problem.h"

/* Whether a stream gets colours: on a terminal, unless NO_COLOR or a dumb TERM forbids it. */
bool cz_uses_colour(const CzArguments *arguments, int descriptor);

/* Reports one error, as JSON on standard output with --json, else on standard error. Returns its
 * exit code. */
int cz_print_error(const CzArguments *arguments, const CzError *error);

/* Reports all mistakes of a problem; `error` when there are none. `problem` may be NULL. */
int cz_print_mistakes(const CzArguments *arguments, const CzProblem *problem, const CzError *error);

/* Reports the warnings of a problem, unless --quiet or --json. */
void cz_print_warnings(const CzArguments *arguments, const CzProblem *problem);

/* One line on standard error, unless --quiet or --json. */
void cz_print_note(const CzArguments *arguments, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Prints a mistake or a warning with its source line, a caret and its help. */
void cz_print_mistake(const CzArguments *arguments, const char *kind, const CzProblem *problem,
                      const CzError *mistake);

/* Flushes standard output; a failure is reported, and its exit code returned instead of `code`. */
int cz_end_output(const CzArguments *arguments, int code);

#endif
