/* Reads result folders by running their problem again, and writes single files. */
#include "cli/result.h"

#include "base/error.h"
#include "cli/messages.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* What a folder without a resolved problem is; empty when it is not one of ours. */
static const char *what_folder(const char *folder) {
    if (cz_recall_exists(folder, "sweep.json"))
        return "it is the folder of a sweep, whose report was written by the sweep; 'crushzone "
               "plot "
               "FILE --vary PATH=A,B,C' draws the curves of several values";
    if (cz_recall_exists(folder, "pareto.json"))
        return "it is the folder of a front, whose report was written with it";
    return cz_recall_exists(folder, "history.jsonl")
               ? "it is the folder of a search that has not ended; go on with --resume"
               : "";
}

/* File to run for an operand: the file itself, or that in the folder. */
static int find_file(CzResult *result, const char *operand) {
    struct stat found;
    CzError error;
    if (stat(operand, &found) != 0 || !S_ISDIR(found.st_mode)) {
        snprintf(result->file, sizeof result->file, "%s", operand);
        return 0;
    }
    if (!cz_recall_exists(operand, "resolved.yaml")) {
        cz_fail(&error, CZ_STATUS_INPUT,
                "%.200s is not a result folder: it has no resolved.yaml" CZ_HELP "%s", operand,
                what_folder(operand));
        return cz_print_error(&result->arguments, &error);
    }
    snprintf(result->file, sizeof result->file, "%s/resolved.yaml", operand);
    result->log = cz_recall_log(operand);
    if (!result->log.is_ours) /* which may give other results than those in the folder */
        cz_print_note(
            &result->arguments,
            "warning: the results in %s are from another version of crushzone; this version "
            "computed them again",
            operand);
    if (cz_recall_exists(operand, "channels.csv") && result->log.scenario[0] != '\0' &&
        result->arguments.text[CZ_OPTION_SCENARIO] == NULL)
        result->arguments.text[CZ_OPTION_SCENARIO] = result->log.scenario;
    return 0;
}

int cz_result_begin(CzResult *result, const CzArguments *arguments, const char *operand,
                    const char *output) {
    memset(result, 0, sizeof *result);
    result->arguments = *arguments;
    result->session.arguments = &result->arguments; /* also when the session cannot begin */
    int code = find_file(result, operand);
    if (code == 0)
        code = cz_session_begin(&result->session, &result->arguments, result->file);
    if (code == 0)
        code = cz_result_check(arguments, result->session.problem, output);
    if (code != 0)
        return code;
    CzError error = {0};
    if (cz_evaluate(result->session.evaluator, 1, NULL, true, &result->evaluation, &error) != CZ_OK)
        return cz_session_fail(&result->session, &error);
    result->run = (CzReportRun){.label = operand,
                                .problem = result->session.problem,
                                .evaluation = &result->evaluation,
                                .scenario = -1};
    return 0;
}

void cz_result_end(CzResult *result) {
    cz_evaluation_free(&result->evaluation);
    cz_session_end(&result->session);
}

static bool is_same_file(const char *path, const char *other) {
    struct stat first, second;
    return other != NULL && stat(path, &first) == 0 && stat(other, &second) == 0 &&
           S_ISREG(first.st_mode) && first.st_dev == second.st_dev && first.st_ino == second.st_ino;
}

/* Whether the command line names a file as an input. */
static bool is_read(const CzArguments *arguments, const char *path) {
    bool is_read = is_same_file(path, arguments->text[CZ_OPTION_MEASURED]);
    for (int i = 0; i < arguments->n_operand; i++)
        is_read |= is_same_file(path, arguments->operand[i]);
    return is_read;
}

int cz_result_check(const CzArguments *arguments, const CzProblem *problem, const char *path) {
    CzError error = {0};
    if (path == NULL)
        return 0;
    CzStatus status =
        cz_report_check_file(problem, path, arguments->command == CZ_COMMAND_REPORT, &error);
    if (status == CZ_OK && is_read(arguments, path)) {
        status = cz_fail(
            &error, CZ_STATUS_OUTPUT,
            "%.200s is read and would be replaced by what is written; choose another file", path);
    }
    return status == CZ_OK ? 0 : cz_print_error(arguments, &error);
}

int cz_result_write(const CzArguments *arguments, const char *path, CzReportWriter *write,
                    const void *data) {
    CzError error = {0};
    if (strcmp(path, "-") == 0) {
        const CzStatus status = write(data, stdout, &error);
        return status == CZ_OK ? 0 : cz_print_error(arguments, &error);
    }
    if (cz_report_write_file(path, write, data, &error) != CZ_OK)
        return cz_print_error(arguments, &error);
    cz_print_note(arguments, "wrote %s", path);
    return 0;
}
