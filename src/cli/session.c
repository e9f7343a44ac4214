/* A session: reading a problem file, building its evaluator, writing its results. */
#include "cli/session.h"
#include "cli/junit_file.h"

#include "base/clock.h"
#include "base/error.h"
#include "cli/messages.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { LARGEST_INPUT = 20 << 20 }; /* more than any problem file may have [byte] */

/* Reads standard input to its end, or a little more than a problem file may have. */
static CzStatus read_input(CzSession *session, CzError *error) {
    session->text = malloc(LARGEST_INPUT);
    if (session->text == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for standard input");
    session->n_text = fread(session->text, 1, LARGEST_INPUT, stdin);
    if (!ferror(stdin))
        return CZ_OK;
    return cz_fail(error, CZ_STATUS_INPUT, "standard input cannot be read");
}

CzProblemOptions cz_session_problem_options(const CzArguments *arguments) {
    CzProblemOptions options = cz_problem_options_default();
    options.set = arguments->set;
    options.n_set = arguments->n_set;
    options.share_folder = cz_share_folder;
    return options;
}

static CzStatus read_problem(CzSession *session, CzError *error) {
    const CzProblemOptions options = cz_session_problem_options(session->arguments);
    if (strcmp(session->file, "-") != 0)
        return cz_problem_read(session->file, &options, &session->problem, error);
    CZ_TRY(read_input(session, error));
    return cz_problem_read_text(session->text, session->n_text, "<standard input>", ".", &options,
                                &session->problem, error);
}

/* Collects the options of the command line that change results; --time-step-ms is among the
 * settings. */
static void list_options(CzSession *session) {
    static const CzOption listed[] = {
        CZ_OPTION_SCENARIO, CZ_OPTION_INTEGRATOR, CZ_OPTION_ALGORITHM, CZ_OPTION_EVALUATIONS,
        CZ_OPTION_SEED,     CZ_OPTION_WIDTH,      CZ_OPTION_POINTS};
    static const char *const words[] = {"--scenario",    "--integrator", "--algorithm",
                                        "--evaluations", "--seed",       "--width",
                                        "--points"};
    for (int k = 0; k < session->arguments->n_minimise && k < 2; k++) {
        session->word[session->n_word++] = "--minimise";
        session->word[session->n_word++] = session->arguments->minimise[k];
    }
    for (size_t i = 0; i < sizeof listed / sizeof *listed; i++) {
        const char *value = session->arguments->text[listed[i]];
        if (value == NULL)
            continue;
        session->word[session->n_word++] = words[i];
        session->word[session->n_word++] = value;
    }
}

int cz_session_read(CzSession *session, const CzArguments *arguments, const char *file) {
    const double started = cz_clock();
    memset(session, 0, sizeof *session);
    session->arguments = arguments;
    session->file = file;
    list_options(session);
    CzError error = {0};
    if (read_problem(session, &error) != CZ_OK)
        return cz_session_fail(session, &error);
    cz_print_warnings(arguments, session->problem);
    session->setup_s = cz_clock() - started;
    return 0;
}

CzEvaluatorOptions cz_session_evaluator_options(const CzArguments *arguments) {
    CzEvaluatorOptions options = cz_evaluator_options_default();
    options.n_job = arguments->n_job;
    options.executor = arguments->executor;
    options.scenario = arguments->text[CZ_OPTION_SCENARIO];
    options.integrator = arguments->integrator;
    return options;
}

int cz_session_begin(CzSession *session, const CzArguments *arguments, const char *file) {
    const double started = cz_clock();
    const int code = cz_session_read(session, arguments, file);
    if (code != 0)
        return code;
    const CzEvaluatorOptions options = cz_session_evaluator_options(arguments);
    CzError error = {0};
    if (cz_evaluator_build(session->problem, &options, &session->evaluator, &error) != CZ_OK)
        return cz_session_fail(session, &error);
    session->setup_s = cz_clock() - started;
    return 0;
}

void cz_session_end(CzSession *session) {
    cz_evaluator_free(session->evaluator);
    cz_problem_free(session->problem);
    free(session->text);
    session->evaluator = NULL;
    session->text = NULL;
    session->problem = NULL;
}

/* Number of threads or ranks that were used: as requested, else the number of processors. */
static int n_job_of(const CzArguments *arguments) {
    const long n_processor = sysconf(_SC_NPROCESSORS_ONLN);
    if (arguments->executor != NULL)
        return arguments->executor->n_place;
    return arguments->n_job > 0 ? arguments->n_job : n_processor > 0 ? (int)n_processor : 0;
}

CzReport cz_session_report(CzSession *session, CzReportKind kind, double wall_s) {
    CzReportOptions *options = &session->options;
    *options = cz_report_options_default();
    options->csv_separator = session->arguments->csv_separator;
    options->csv_decimal = session->arguments->csv_decimal;
    options->n_job = n_job_of(session->arguments);
    options->setup_s = session->setup_s;
    options->wall_s = wall_s;
    options->set = session->arguments->set;
    options->n_set = session->arguments->n_set;
    options->command = session->arguments->command == CZ_COMMAND_OPTIMISE ? "optimise" : NULL;
    options->word = session->word;
    options->n_word = session->n_word;
    options->text = session->text;
    options->n_text = session->n_text;
    options->iso_mme = session->arguments->text[CZ_OPTION_ISO_MME] != NULL;
    options->replaces_search = session->arguments->text[CZ_OPTION_REPLACE] != NULL;
    return (CzReport){.kind = kind,
                      .options = options,
                      .problem = session->problem,
                      .evaluator = session->evaluator};
}

static int end_results(const CzArguments *arguments, CzStatus status, const CzError *error) {
    if (status != CZ_OK)
        cz_print_mistake(arguments, "error", NULL, error);
    return cz_status_exit_code(status);
}

/* Characters of a line of standard output; 0 where it is no terminal, or its size is unknown. */
static int terminal_width(void) {
    struct winsize size;
    return isatty(STDOUT_FILENO) && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

int cz_print_results(const CzArguments *arguments, const CzReport *report) {
    const bool colour = cz_uses_colour(arguments, STDOUT_FILENO);
    CzReportOptions options =
        report->options != NULL ? *report->options : cz_report_options_default();
    options.text_width = terminal_width();
    CzReport printed = *report;
    printed.options = &options;
    CzError error = {0};
    const CzStatus status = arguments->text[CZ_OPTION_JSON] != NULL
                                ? cz_report_write_json(&printed, stdout, &error)
                                : cz_report_write_table(&printed, colour, stdout, &error);
    return end_results(arguments, status, &error);
}

int cz_save_results(const CzArguments *arguments, const CzReport *report, const char *folder) {
    CzError error = {0};
    return folder == NULL
               ? 0
               : end_results(arguments, cz_report_write_folder(report, folder, &error), &error);
}

int cz_session_check_folder(const CzSession *session, const char *folder, bool replaces_search) {
    CzError error = {0};
    if (folder == NULL)
        return 0;
    const CzStatus status =
        cz_report_check_folder(session->problem, folder, replaces_search, &error);
    /* A search opens its own folder. */
    const bool is_open = session->arguments->command != CZ_COMMAND_OPTIMISE &&
                         session->arguments->command != CZ_COMMAND_PARETO &&
                         cz_journal_is_open(folder);
    if (status == CZ_OK && !is_open)
        return 0;
    if (status == CZ_OK)
        cz_fail(&error, CZ_STATUS_OUTPUT,
                "another process is searching in the folder %.300s; choose another one with -o",
                folder);
    return cz_print_error(session->arguments, &error);
}

/* A target and the problem that it is made from. */
typedef struct Made {
    const CzProblem *problem;
    char target[4096];
} Made;

static CzStatus write_rule(const void *data, FILE *stream, CzError *error) {
    const Made *made = data;
    (void)error; /* the stream keeps its failures */
    cz_report_write_dependencies(made->problem, made->target, stream);
    return CZ_OK;
}

int cz_session_write_depfile(const CzSession *session, const char *folder, const char *document) {
    const char *path = session->arguments->text[CZ_OPTION_DEPFILE];
    CzError error = {0};
    if (path == NULL)
        return 0;
    CzStatus status = CZ_OK;
    Made made = {.problem = session->problem};
    if (folder == NULL)
        status = cz_fail(&error, CZ_STATUS_INPUT, "--depfile needs a result folder: give -o DIR");
    else if (session->arguments->n_operand > 1)
        status = cz_fail(&error, CZ_STATUS_INPUT,
                         "--depfile is of one problem file: run the files one at a time");
    if (status == CZ_OK)
        status = cz_report_check_file(session->problem, path, false, &error);
    if (status == CZ_OK) {
        size_t n = strlen(folder);
        while (n > 1 && folder[n - 1] == '/')
            n--;
        snprintf(made.target, sizeof made.target, "%.*s/%s", (int)n, folder, document);
        status = cz_report_write_file(path, write_rule, &made, &error);
    }
    return status == CZ_OK ? 0 : cz_print_error(session->arguments, &error);
}

/* Mistakes that were found while reading are all reported; later ones alone, with their source
 * line. */
int cz_session_fail(const CzSession *session, const CzError *error) {
    if (session->problem == NULL || cz_problem_n_mistake(session->problem) > 0 ||
        session->arguments->text[CZ_OPTION_JSON] != NULL)
        return cz_print_mistakes(session->arguments, session->problem, error);
    cz_print_mistake(session->arguments, "error", session->problem, error);
    return cz_status_exit_code(error->status);
}

int cz_session_deliver(CzSession *session, const CzReport *report) {
    const CzArguments *arguments = session->arguments;
    session->is_judged = true;
    if (session->junit != NULL)
        cz_junit_add(session->junit, report);
    const int code = cz_save_results(arguments, report, arguments->text[CZ_OPTION_OUTPUT]);
    return code != 0 ? code : cz_print_results(arguments, report);
}

int cz_session_study(const CzArguments *arguments, CzStudy study, void *data) {
    const char *file = arguments->operand[0];
    CzSession session;
    CzJunit *junit;
    int code = cz_junit_file_begin(arguments, &junit);
    if (code != 0)
        return code;
    code = cz_session_read(&session, arguments, file);
    session.junit = junit;
    if (code == 0)
        code = cz_session_check_folder(&session, arguments->text[CZ_OPTION_OUTPUT],
                                       arguments->text[CZ_OPTION_REPLACE] != NULL);
    if (code == 0)
        code = study(&session, data);
    if (!session.is_judged)
        cz_junit_file_add_unjudged(junit, file);
    cz_session_end(&session);
    const int junit_code = cz_junit_file_end(arguments, junit);
    return junit_code > code ? junit_code : code;
}
