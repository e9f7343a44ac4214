/* The optimum as a problem file that extends the file of the user. */
#define _XOPEN_SOURCE 700 /* realpath */
#include "report/overlay.h"

#include "base/arena.h"
#include "base/error.h"
#include "base/number.h"
#include "evaluate/evaluator.h"
#include "problem/problem.h"
#include "report/options.h"

#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <math.h>
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

/* A value as typed; in quotes where YAML could read it as something else. */
static void write_value(const char *text, FILE *stream) {
    bool plain = text[0] != '\0';
    for (const char *c = text; *c != '\0'; c++)
        plain = plain && (isalnum((unsigned char)*c) || strchr("+-._/", *c) != NULL);
    if (plain)
        fputs(text, stream);
    else
        write_quoted(text, strlen(text), stream);
}

/* Adds a setting, in place of an earlier one for the same path. */
static void add_setting(const char **setting, int *n_setting, const char *added) {
    const size_t n = strcspn(added, "=") + 1;
    for (int i = 0; i < *n_setting; i++)
        if (strncmp(setting[i], added, n) == 0) {
            setting[i] = added;
            return;
        }
    setting[(*n_setting)++] = added;
}

/* The setting of a number or of the name of a part at a path of n bytes; NULL without memory. */
static const char *setting_at(const char *path, size_t n, const char *key, const char *value,
                              CzArena *arena) {
    const size_t room = n + strlen(key) + strlen(value) + 2;
    char *text = cz_arena_allocate(arena, room, 1);
    if (text != NULL)
        snprintf(text, room, "%.*s%s=%s", (int)n, path, key, value);
    return text;
}

/* The setting of a variable at one of its places in the best design. */
static const char *best_at(const CzVariableInfo *variable, const CzVariablePlace *place,
                           double value, CzArena *arena) {
    char number[CZ_NUMBER_TEXT];
    const double own = value * place->factor;
    return setting_at(
        place->path, strlen(place->path), "",
        variable->n_choice > 0 ? variable->choice[(int)own] : cz_number_print(number, own), arena);
}

/* The setting that keeps the stroke for which the car is drawn, in addition to a new stroke. */
static const char *drawn_stroke_at(const CzVariablePlace *place, CzArena *arena) {
    char number[CZ_NUMBER_TEXT];
    const char *stages = strstr(place->path, ".stages[");
    return setting_at(place->path, stages != NULL ? (size_t)(stages - place->path) : 0,
                      ".drawn_stroke_m", cz_number_print(number, place->drawn_stroke), arena);
}

/* Settings "path=value" that turn the problem file into the best design: with `all` those of the
 * command line, then the best value of every place that a variable sets, exact to the last bit;
 * every path occurs once. NULL without memory. */
static const char **settings_of(const CzReport *report, bool all, CzArena *arena, int *n_setting) {
    const CzReportOptions *options = cz_report_options_of(report);
    const CzEvaluator *evaluator = report->evaluator;
    const CzOutcome *outcome = report->outcome;
    const int n_given = all ? options->n_set : 0;
    size_t room = (size_t)n_given + 1;
    for (int variable = 0; variable < outcome->n_variable; variable++)
        room += 2 * (size_t)cz_evaluator_variable(evaluator, variable)->n_place;
    const char **setting = cz_arena_allocate(arena, room, sizeof *setting);
    *n_setting = 0;
    for (int i = 0; i < n_given && setting != NULL; i++)
        if (strchr(options->set[i], '=') != NULL)
            add_setting(setting, n_setting, options->set[i]);
    for (int variable = 0; variable < outcome->n_variable && setting != NULL; variable++) {
        const CzVariableInfo *info = cz_evaluator_variable(evaluator, variable);
        for (int i = 0; i < info->n_place; i++) {
            const CzVariablePlace *place = &info->place[i];
            const char *own = best_at(info, place, outcome->best[variable], arena);
            const bool is_drawn = !isnan(place->drawn_stroke);
            const char *drawn = is_drawn ? drawn_stroke_at(place, arena) : NULL;
            if (own == NULL || (is_drawn && drawn == NULL))
                return NULL;
            add_setting(setting, n_setting, own);
            if (is_drawn)
                add_setting(setting, n_setting, drawn);
        }
    }
    return setting;
}

static void write_set(int n_setting, const char *const *setting, FILE *stream) {
    fputs("set:\n", stream);
    for (int i = 0; i < n_setting; i++) {
        const size_t n = strcspn(setting[i], "=");
        fputs("  ", stream);
        write_quoted(setting[i], n, stream);
        fputs(": ", stream);
        write_value(setting[i] + n + 1, stream);
        fputc('\n', stream);
    }
}

CzStatus cz_overlay_write_values(const CzReport *report, bool all, FILE *stream, CzError *error) {
    CzArena arena = {0};
    int n_setting;
    const char **setting = settings_of(report, all, &arena, &n_setting);
    if (setting != NULL)
        write_set(n_setting, setting, stream);
    cz_arena_free(&arena);
    return setting != NULL ? CZ_OK
                           : cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the best values");
}

CzStatus cz_overlay_read_best(const CzReport *report, CzProblem **best, CzError *error) {
    if (report->robust != NULL) /* with the scenarios that the search added */
        return cz_evaluator_read_design(report->evaluator, report->outcome->best, best, error);
    const CzReportOptions *options = cz_report_options_of(report);
    const char *file = cz_problem_file(report->problem);
    CzArena arena = {0};
    CzProblemOptions read = cz_problem_options_default();
    CzStatus status = CZ_STATUS_NO_MEMORY;
    read.share_folder = cz_problem_share_folder(report->problem);
    read.set = settings_of(report, true, &arena, &read.n_set);
    if (read.set == NULL)
        status = cz_fail(error, status, "no memory for the best values");
    else if (options->text == NULL)
        status = cz_problem_read(file, &read, best, error);
    else
        status =
            cz_problem_read_text(options->text, options->n_text, file, ".", &read, best, error);
    cz_arena_free(&arena);
    return status;
}

CzStatus cz_overlay_write_resolved(const CzReport *report, FILE *stream, CzError *error) {
    CzProblem *best = NULL;
    CzError mistake = {0};
    CzStatus status = cz_overlay_read_best(report, &best, &mistake);
    if (status == CZ_OK) {
        cz_problem_write_resolved_in_folder(best, stream);
    } else if (status == CZ_STATUS_NO_MEMORY) {
        status = cz_fail(error, status, "%s", mistake.message);
    } else { /* such as a file that has changed meanwhile: the best values must still be written */
        fprintf(stream, "# The problem cannot be read again (%s), so these are the values alone.\n",
                mistake.message);
        status = cz_overlay_write_values(report, true, stream, error);
    }
    cz_problem_free(best);
    return status;
}

/* Path of `target` relative to `folder`; both are absolute and without dots. */
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

/* Absolute path of a folder that may not exist yet; its parent must exist. */
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

/* Writes `extends:` with the path of a problem's file from a folder on, behind `above`; false where
 * there is none. */
static bool write_extends(const CzProblem *problem, const char *folder, const char *above,
                          FILE *stream) {
    char file[PATH_MAX], from[PATH_MAX], path[PATH_MAX], whole[PATH_MAX + 16];
    if (realpath(cz_problem_file(problem), file) == NULL || !resolve_folder(folder, from))
        return false;
    relative_path(from, file, sizeof path, path);
    snprintf(whole, sizeof whole, "%.8s%s", above, path);
    fputs("extends: ", stream);
    cz_overlay_write_text(whole, stream);
    fputc('\n', stream);
    return true;
}

void cz_overlay_write_text(const char *text, FILE *stream) {
    write_quoted(text, strlen(text), stream);
}

void cz_overlay_write_base(const CzReport *report, const CzProblem *problem, const char *folder,
                           const char *above, FILE *stream) {
    const CzReportOptions *options = cz_report_options_of(report);
    if (!write_extends(problem, folder, above, stream))
        fputs("# The file of the problem is not there any more.\n", stream);
    if (options->n_set > 0)
        write_set(options->n_set, options->set, stream);
}

CzStatus cz_overlay_write_design(const CzReport *report, const char *folder, FILE *stream,
                                 CzError *error) {
    if (cz_report_options_of(report)->text == NULL &&
        write_extends(report->problem, folder, "", stream))
        CZ_TRY(cz_overlay_write_values(report, true, stream, error));
    else
        CZ_TRY(cz_overlay_write_resolved(report, stream, error));
    if (fflush(stream) != 0 || ferror(stream))
        return cz_fail(error, CZ_STATUS_OUTPUT, "the overlay cannot be written: %s",
                       strerror(errno));
    return CZ_OK;
}

CzStatus cz_overlay_write(const CzReport *report, const char *folder, FILE *stream,
                          CzError *error) {
    const CzOutcome *outcome = report->outcome;
    fprintf(
        stream, "# The best design of %ld evaluation%s: %s. Verdict of its checks: %s.\n",
        outcome->n_evaluation, outcome->n_evaluation == 1 ? "" : "s",
        outcome->best_evaluation.violation <= 0 ? "it satisfies every constraint"
                                                : "IT VIOLATES A CONSTRAINT",
        cz_verdict_words(outcome->best_evaluation.verdict, outcome->best_evaluation.n_not_covered));
    return cz_overlay_write_design(report, folder, stream, error);
}
