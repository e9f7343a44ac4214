/* `report`, `plot` and `compare`: figures and pages of existing results. */
#include "base/error.h"
#include "cli/command.h"
#include "cli/messages.h"
#include "cli/result.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Restores a folder that a process was replacing when it was killed. */
static void restore(const CzArguments *arguments) {
    for (int i = 0; i < arguments->n_operand; i++)
        if (cz_report_restore_folder(arguments->operand[i]))
            cz_print_note(arguments,
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
    return cz_recall_exists(folder, "samples.html");
}

static int refuse_report(const CzArguments *arguments, const char *folder) {
    CzError error;
    cz_fail(&error, CZ_STATUS_INPUT,
            "%.200s is the folder of a search against scatter, whose report needs the samples of "
            "its rounds" CZ_HELP "crushzone optimise FILE --resume %.200s writes the folder "
            "again; for a report of the best design only give a file: -o best.html",
            folder, folder);
    return cz_print_error(arguments, &error);
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

/* ---- plot --vary: curves of several points over one another ---- */

typedef struct Varied {
    const CzSweep *sweep;
    const char *what;
} Varied;

static CzStatus write_varied(const void *data, FILE *stream, CzError *error) {
    const Varied *varied = data;
    return cz_report_write_sweep_chart(varied->sweep, varied->what, stream, error);
}

/* Options that a figure of several points does not take. */
static int refuse_with_vary(const CzArguments *arguments) {
    static const CzOption refused[] = {CZ_OPTION_AT, CZ_OPTION_MEASURED, CZ_OPTION_COLUMN};
    CzError error;
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++)
        if (arguments->text[refused[i]] != NULL) {
            cz_fail(&error, CZ_STATUS_INPUT, "--%s is not for a figure with --vary",
                    cz_options[refused[i]].name);
            return cz_print_error(arguments, &error);
        }
    return 0;
}

/* The first scenario, or the one that was asked for, is run at every point. */
static int plot_points(CzSession *session, void *data) {
    const CzArguments *arguments = session->arguments;
    const CzProblemOptions problem_options = cz_session_problem_options(arguments);
    const char *path = arguments->text[CZ_OPTION_SVG], *what = arguments->text[CZ_OPTION_WHAT];
    CzSweepOptions options = cz_sweep_options_default();
    CzSweep *sweep = NULL;
    CzError error = {0};
    options.n_axis = arguments->n_vary;
    options.axis = data;
    options.scenario = arguments->text[CZ_OPTION_SCENARIO];
    if (options.scenario == NULL)
        options.scenario = cz_problem_scenario_name(session->problem, 0);
    options.curves = true;
    options.n_job = arguments->n_job;
    options.text = session->text;
    options.n_text = session->n_text;
    int code = cz_result_check(arguments, session->problem, path);
    if (code != 0)
        return code;
    if (cz_sweep(session->file, &problem_options, &options, &sweep, &error) != CZ_OK)
        return cz_print_error(arguments, &error);
    const Varied varied = {sweep, what != NULL ? what : cz_chart_options_default().what};
    code = cz_result_write(arguments, path != NULL ? path : "-", write_varied, &varied);
    cz_sweep_free(sweep);
    return code;
}

static int plot_varied(const CzArguments *arguments) {
    CzSweepAxis axis[CZ_MAX_AXES];
    CzError error = {0};
    const int code = refuse_with_vary(arguments);
    if (code != 0)
        return code;
    for (int k = 0; k < arguments->n_vary; k++)
        if (cz_sweep_axis_parse(arguments->vary[k], &axis[k], &error) != CZ_OK)
            return cz_print_error(arguments, &error);
    return cz_session_study(arguments, plot_points, axis);
}

int cz_command_plot(const CzArguments *arguments) {
    const char *path = arguments->text[CZ_OPTION_SVG];
    CzResult result;
    if (arguments->n_vary > 0)
        return plot_varied(arguments);
    restore(arguments);
    int code = cz_result_begin(&result, arguments, arguments->operand[0], path);
    if (code == 0)
        code = cz_result_write(arguments, path != NULL ? path : "-", write_chart, &result);
    cz_result_end(&result);
    return code;
}

/* ---- compare ---- */

static int compare(const CzArguments *arguments, const CzResult *result) {
    CzReportRun run[CZ_MAX_COMPARED];
    CzReport report = {
        .kind = CZ_REPORT_COMPARISON, .compared = run, .n_compared = arguments->n_operand};
    CzComparison *comparison = NULL;
    CzError error = {0};
    for (int i = 0; i < arguments->n_operand; i++)
        run[i] = result[i].run;
    if (cz_comparison_make(&report, &comparison, &error) != CZ_OK)
        return cz_print_error(arguments, &error);
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
        return cz_print_error(arguments, &error);
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
