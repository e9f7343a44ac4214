/* `report`, `plot` and `compare`: figures and pages of existing results. */
#include "base/error.h"
#include "cli/command.h"
#include "cli/messages.h"
#include "cli/result.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Restores a folder that a process was replacing when it died. */
static void restore(const CzArguments *arguments) {
    for (int i = 0; i < arguments->n_operand; i++)
        if (cz_report_restore_folder(arguments->operand[i]))
            cz_tell(arguments,
                    "restored %s, which an interrupted process had left under another name",
                    arguments->operand[i]);
}

/* ---- report ---- */

static CzStatus write_page(const void *report, FILE *stream, CzError *error) {
    return cz_report_write_page(report, stream, error);
}

/* Path of the report of a folder. */
static void find_report(const CzArguments *arguments, char path[4096]) {
    const char *folder = arguments->operand[0], *given = arguments->text[CZ_OPTION_OUTPUT];
    struct stat found;
    const bool is_folder = stat(folder, &found) == 0 && S_ISDIR(found.st_mode);
    if (given != NULL)
        snprintf(path, 4096, "%s", given);
    else
        snprintf(path, 4096, "%.4000s%sreport.html", is_folder ? folder : "", is_folder ? "/" : "");
}

/* Whether a folder is that of a search against scatter, whose rounds and samples only the search
 * itself can write again. */
static bool is_against_scatter(const char *folder) {
    return cz_recall_is_there(folder, "samples.html");
}

static int refuse_report(const CzArguments *arguments, const char *folder) {
    CzError error;
    cz_fail(&error, CZ_STATUS_INPUT,
            "%.200s is the folder of a search against scatter, whose report needs the samples of "
            "its rounds" CZ_HELP "crushzone optimise FILE --resume %.200s writes the folder "
            "again; for a report of the best design only give a file: -o best.html",
            folder, folder);
    return cz_tell_error(arguments, &error);
}

/* The report of the best design of a search alone has a separate file. */
int cz_command_report(const CzArguments *arguments) {
    char path[4096];
    CzResult result;
    CzOutcome *outcome = NULL;
    const char *folder = arguments->operand[0];
    restore(arguments);
    const bool is_search = arguments->text[CZ_OPTION_OUTPUT] == NULL && cz_recall_is_search(folder);
    char problem[4096];
    if (is_search && is_against_scatter(folder))
        return refuse_report(arguments, folder);
    find_report(arguments, path);
    if (is_search)
        cz_recall_problem(folder, problem);
    int code = cz_result_begin(&result, arguments, is_search ? problem : folder, path);
    if (code == 0 && is_search)
        code = cz_recall_outcome(&result.session, folder, &outcome);
    if (code == 0) {
        CzReport report =
            cz_session_report(&result.session, is_search ? CZ_REPORT_SEARCH : CZ_REPORT_RUN, 0);
        report.evaluation = &result.evaluation;
        report.outcome = outcome;
        code = cz_result_write(arguments, path, write_page, &report);
    }
    cz_outcome_free(outcome);
    cz_result_end(&result);
    return code;
}

/* ---- plot ---- */

static CzStatus write_chart(const void *data, FILE *stream, CzError *error) {
    const CzResult *result = data;
    const char *const *text = result->arguments.text;
    CzChartOptions options = cz_chart_options_default();
    if (text[CZ_OPTION_WHAT] != NULL)
        options.what = text[CZ_OPTION_WHAT];
    options.at = text[CZ_OPTION_AT];
    options.measured = text[CZ_OPTION_MEASURED];
    options.column = text[CZ_OPTION_COLUMN];
    if (text[CZ_OPTION_CSV_SEP] != NULL)
        options.csv_separator = result->arguments.csv_separator;
    if (text[CZ_OPTION_CSV_DECIMAL] != NULL)
        options.csv_decimal = result->arguments.csv_decimal;
    return cz_report_write_chart(&result->run, &options, stream, error);
}

int cz_command_plot(const CzArguments *arguments) {
    const char *path = arguments->text[CZ_OPTION_SVG];
    CzResult result;
    restore(arguments);
    int code = cz_result_begin(&result, arguments, arguments->operand[0], path);
    if (code == 0)
        code = cz_result_write(arguments, path != NULL ? path : "-", write_chart, &result);
    cz_result_end(&result);
    return code;
}

/* ---- compare ---- */

static int compare(const CzArguments *arguments, const CzResult *result) {
    CzReportRun run[CZ_MOST_COMPARED];
    CzReport report = {
        .kind = CZ_REPORT_COMPARISON, .compared = run, .n_compared = arguments->n_operand};
    CzComparison *comparison = NULL;
    CzError error = {0};
    for (int i = 0; i < arguments->n_operand; i++)
        run[i] = result[i].run;
    if (cz_comparison_make(&report, &comparison, &error) != CZ_OK)
        return cz_tell_error(arguments, &error);
    report.comparison = comparison;
    const char *page = arguments->text[CZ_OPTION_OUTPUT];
    int code = cz_print_results(arguments, &report);
    if (code == 0 && page != NULL)
        code = cz_result_write(arguments, page, write_page, &report);
    cz_comparison_free(comparison);
    return code;
}

int cz_command_compare(const CzArguments *arguments) {
    CzResult *result = calloc((size_t)arguments->n_operand, sizeof *result);
    if (result == NULL) {
        const CzError error = {.status = CZ_STATUS_NO_MEMORY, .message = "no memory to compare"};
        return cz_tell_error(arguments, &error);
    }
    int code = 0;
    restore(arguments);
    for (int i = 0; i < arguments->n_operand && code == 0; i++)
        code = cz_result_begin(&result[i], arguments, arguments->operand[i],
                               arguments->text[CZ_OPTION_OUTPUT]);
    if (code == 0)
        code = compare(arguments, result);
    for (int i = 0; i < arguments->n_operand; i++)
        cz_result_end(&result[i]);
    free(result);
    return code;
}
