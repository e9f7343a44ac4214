/* Prints mistakes with their source line and a caret under the place. */
#include "cli/messages.h"

#include "base/error.h"
#include "crushzone/report.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SHOWN_BEFORE = 60, SHOWN_AFTER = 40 }; /* characters of a long line around its caret */

bool cz_uses_colour(const CzArguments *arguments, int descriptor) {
    if (arguments->colour != CZ_COLOUR_AUTO)
        return arguments->colour == CZ_COLOUR_ALWAYS;
    if (arguments->executor != NULL)
        return false; /* mpirun shows a terminal to rank 0 even where its own output is a file */
    const char *no_color = getenv("NO_COLOR"), *term = getenv("TERM");
    return isatty(descriptor) && (no_color == NULL || no_color[0] == '\0') && term != NULL &&
           term[0] != '\0' && strcmp(term, "dumb") != 0;
}

static bool begins_character(char byte) {
    return ((unsigned char)byte & 0xc0) != 0x80;
}

/* Prints the part of a source line around a column (counted in characters from 1) and the caret. */
static void print_place(const char *line, int column) {
    int first = column > SHOWN_BEFORE ? column - SHOWN_BEFORE : 1;
    const int last = column + SHOWN_AFTER;
    int character = 0;
    fputs(first > 1 ? "  ..." : "  ", stderr);
    for (const char *c = line; *c != '\0'; c++) {
        character += begins_character(*c);
        if (character > last) {
            fputs("...", stderr);
            break;
        }
        if (character >= first)
            fputc((unsigned char)*c >= 0x20 && *c != 0x7f ? *c : ' ', stderr);
    }
    fprintf(stderr, "\n%*s^\n", (first > 1 ? 5 : 2) + column - first, "");
}

void cz_print_mistake(const CzArguments *arguments, const char *kind, const CzProblem *problem,
                      const CzError *mistake) {
    const bool colour = cz_uses_colour(arguments, STDERR_FILENO);
    const bool is_error = strcmp(kind, "error") == 0;
    if (mistake->file[0] == '\0')
        fputs("crushzone: ", stderr);
    else if (mistake->line > 0)
        fprintf(stderr, "%s:%d:%d: ", mistake->file, mistake->line, mistake->column);
    else
        fprintf(stderr, "%s: ", mistake->file);
    fprintf(stderr, "%s%s:%s %s\n", colour ? (is_error ? "\033[1;31m" : "\033[33m") : "", kind,
            colour ? "\033[0m" : "", mistake->message);
    const char *line = problem != NULL ? cz_problem_source_line(problem, mistake) : NULL;
    if (line != NULL && mistake->line > 0 && mistake->column > 0)
        print_place(line, mistake->column);
    if (mistake->help[0] != '\0')
        fprintf(stderr, "  help: %s\n", mistake->help);
}

static bool speaks_json(const CzArguments *arguments) {
    return arguments->text[CZ_OPTION_JSON] != NULL;
}

static int exit_code_of(const CzError *error) {
    return cz_status_exit_code(error->status != CZ_OK ? error->status : CZ_STATUS_INTERNAL);
}

int cz_print_error(const CzArguments *arguments, const CzError *error) {
    const CzReport report = {.kind = CZ_REPORT_MISTAKES, .mistake = &error, .n_mistake = 1};
    CzError failure = {0};
    if (!speaks_json(arguments) || error->status == CZ_STATUS_OUTPUT)
        cz_print_mistake(arguments, "error", NULL, error);
    if (speaks_json(arguments) && cz_report_write_json(&report, stdout, &failure) != CZ_OK &&
        error->status != CZ_STATUS_OUTPUT)
        cz_print_mistake(arguments, "error", NULL, error);
    return exit_code_of(error);
}

int cz_print_mistakes(const CzArguments *arguments, const CzProblem *problem,
                      const CzError *error) {
    const int n = problem != NULL ? cz_problem_n_mistake(problem) : 0;
    if (n == 0)
        return cz_print_error(arguments, error);
    const CzError **mistake = speaks_json(arguments) ? calloc((size_t)n, sizeof *mistake) : NULL;
    for (int i = 0; i < n; i++) {
        if (mistake != NULL)
            mistake[i] = cz_problem_mistake(problem, i);
        else
            cz_print_mistake(arguments, "error", problem, cz_problem_mistake(problem, i));
    }
    const CzReport report = {.kind = CZ_REPORT_MISTAKES, .mistake = mistake, .n_mistake = n};
    CzError failure = {0};
    if (mistake != NULL && cz_report_write_json(&report, stdout, &failure) != CZ_OK)
        cz_print_mistake(arguments, "error", NULL, &failure);
    if (mistake == NULL && n > 1)
        fprintf(stderr, "%s: %d mistakes\n", cz_problem_file(problem), n);
    free(mistake);
    return exit_code_of(cz_problem_mistake(problem, 0));
}

static bool is_silent(const CzArguments *arguments) {
    return speaks_json(arguments) || arguments->text[CZ_OPTION_QUIET] != NULL;
}

void cz_print_warnings(const CzArguments *arguments, const CzProblem *problem) {
    for (int i = 0; !is_silent(arguments) && i < cz_problem_n_warning(problem); i++)
        cz_print_mistake(arguments, "warning", problem, cz_problem_warning(problem, i));
}

void cz_print_note(const CzArguments *arguments, const char *format, ...) {
    if (is_silent(arguments))
        return;
    fflush(stdout); /* keeps the order of both streams */
    va_list values;
    va_start(values, format);
    vfprintf(stderr, format, values);
    va_end(values);
    fputc('\n', stderr);
}

int cz_end_output(const CzArguments *arguments, int code) {
    errno = 0;
    if (fflush(stdout) == 0 && !ferror(stdout))
        return code;
    const int why = errno;
    CzError error;
    cz_fail(&error, CZ_STATUS_OUTPUT, "standard output cannot be written%s%s", why != 0 ? ": " : "",
            why != 0 ? strerror(why) : "");
    cz_print_mistake(arguments, "error", NULL, &error);
    return cz_status_exit_code(CZ_STATUS_OUTPUT);
}
