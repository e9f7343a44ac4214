/* The optimum as a problem file: the user's own file is extended, never rewritten. */
#define _XOPEN_SOURCE 700 /* realpath */
#include "report/overlay.h"

#include "base/error.h"
#include "base/number.h"

#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void write_quoted(const char *text, size_t n, FILE *stream) {
    fputc('"', stream);
    for (size_t i = 0; i < n; i++) {
        const unsigned char byte = (unsigned char)text[i];
        if (byte < 0x20 || byte == 0x7f)
            fprintf(stream, "\\x%02X", byte);
        else if (byte == '"' || byte == '\\')
            fprintf(stream, "\\%c", byte);
        else
            fputc(byte, stream);
    }
    fputc('"', stream);
}

/* A value as typed; in quotes when YAML could read it otherwise. */
static void write_value(const char *text, FILE *stream) {
    bool plain = text[0] != '\0';
    for (const char *c = text; *c != '\0'; c++)
        plain = plain && (isalnum((unsigned char)*c) || strchr("+-._/", *c) != NULL);
    if (plain)
        fputs(text, stream);
    else
        write_quoted(text, strlen(text), stream);
}

static bool is_driven(const CzEvaluator *evaluator, const char *path, size_t n) {
    for (int variable = 0; variable < cz_evaluator_n_variable(evaluator); variable++)
        for (int i = 0; i < cz_evaluator_n_place(evaluator, variable); i++) {
            const char *place = cz_evaluator_place(evaluator, variable, i).path;
            if (strlen(place) == n && strncmp(place, path, n) == 0)
                return true;
        }
    return false;
}

/* Whether a later setting names the same path. */
static bool is_overruled(const CzReportOptions *options, int index, size_t n) {
    for (int i = index + 1; i < options->n_set; i++)
        if (strncmp(options->set[i], options->set[index], n + 1) == 0)
            return true;
    return false;
}

void cz_overlay_write_set(const CzEvaluator *evaluator, const CzOutcome *outcome,
                          const CzReportOptions *options, FILE *stream) {
    fputs("set:\n", stream);
    for (int i = 0; options != NULL && i < options->n_set; i++) {
        const char *equals = strchr(options->set[i], '=');
        const size_t n = equals != NULL ? (size_t)(equals - options->set[i]) : 0;
        if (n == 0 || is_overruled(options, i, n) || is_driven(evaluator, options->set[i], n))
            continue;
        fputs("  ", stream);
        write_quoted(options->set[i], n, stream);
        fputs(": ", stream);
        write_value(equals + 1, stream);
        fputc('\n', stream);
    }
    for (int variable = 0; variable < outcome->n_variable; variable++)
        for (int i = 0; i < cz_evaluator_n_place(evaluator, variable); i++) {
            const CzVariablePlace place = cz_evaluator_place(evaluator, variable, i);
            char number[CZ_NUMBER_TEXT];
            fputs("  ", stream);
            write_quoted(place.path, strlen(place.path), stream);
            fprintf(stream, ": %s\n",
                    cz_number_print(number, outcome->best[variable] * place.factor));
        }
}

/* Path of `target` as seen from `folder`, both absolute and without dots. */
static void relative_path(const char *folder, const char *target, size_t room, char *text) {
    size_t common = 0; /* length of the shared part, a slash at its end */
    for (size_t i = 0;; i++) {
        const bool folder_ends = folder[i] == '\0' || folder[i] == '/';
        const bool target_ends = target[i] == '\0' || target[i] == '/';
        if (folder_ends && target_ends)
            common = i + 1;
        if (folder[i] != target[i] || folder[i] == '\0')
            break;
    }
    size_t used = 0;
    text[0] = '\0';
    const char *rest = strlen(folder) < common ? "" : folder + common;
    for (bool inside = *rest != '\0'; inside && used + 4 < room; rest++) {
        if (*rest != '/' && *rest != '\0')
            continue;
        used += (size_t)snprintf(text + used, room - used, "../");
        if (*rest == '\0')
            break;
    }
    snprintf(text + used, room - used, "%s", target + common);
}

/* Absolute path of a folder that may not be there yet. Its parent must be. */
static bool resolve_folder(const char *folder, char resolved[PATH_MAX]) {
    if (realpath(folder, resolved) != NULL)
        return true;
    char parent[PATH_MAX], absolute[PATH_MAX];
    size_t n = strlen(folder);
    while (n > 1 && folder[n - 1] == '/')
        n--;
    size_t slash = n;
    while (slash > 0 && folder[slash - 1] != '/')
        slash--;
    if (n >= sizeof parent)
        return false;
    snprintf(parent, sizeof parent, "%.*s", (int)slash, folder);
    if (realpath(slash == 0 ? "." : parent, absolute) == NULL)
        return false;
    const int written =
        snprintf(resolved, PATH_MAX, "%s/%.*s", strcmp(absolute, "/") == 0 ? "" : absolute,
                 (int)(n - slash), folder + slash);
    return written > 0 && written < PATH_MAX;
}

CzStatus cz_report_write_overlay(const CzProblem *problem, const CzEvaluator *evaluator,
                                 const CzOutcome *outcome, const CzReportOptions *options,
                                 const char *folder, FILE *stream, CzError *error) {
    char file[PATH_MAX], from[PATH_MAX], path[PATH_MAX];
    const char *name = cz_problem_file(problem);
    const bool extends = realpath(name, file) != NULL && resolve_folder(folder, from);
    fprintf(stream, "# The best design of %ld evaluations: %s.\n", outcome->n_evaluation,
            outcome->best_evaluation.violation <= 0 ? "it keeps every constraint"
                                                    : "IT BREAKS A CONSTRAINT");
    if (extends) {
        relative_path(from, file, sizeof path, path);
        fputs("extends: ", stream);
        write_quoted(path, strlen(path), stream);
        fputc('\n', stream);
        cz_overlay_write_set(evaluator, outcome, options, stream);
    } else { /* nothing to extend, such as standard input */
        cz_problem_write_resolved(problem, stream);
        cz_overlay_write_set(evaluator, outcome, NULL, stream);
    }
    if (fflush(stream) != 0 || ferror(stream))
        return cz_fail(error, CZ_STATUS_OUTPUT, "the overlay cannot be written: %s",
                       strerror(errno));
    return CZ_OK;
}
