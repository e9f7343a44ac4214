/* One problem file on its way through a command. */
#include "cli/session.h"

#include "cli/messages.h"
#include "cli/progress.h"

#include <string.h>

int cz_session_read(CzSession *session, const CzArguments *arguments, const char *file) {
    const double started = cz_clock();
    memset(session, 0, sizeof *session);
    session->arguments = arguments;
    session->file = file;
    CzProblemOptions options = cz_problem_options_default();
    options.set = arguments->set;
    options.n_set = arguments->n_set;
    CzError error = {0};
    if (cz_problem_read(file, &options, &session->problem, &error) != CZ_OK)
        return cz_session_fail(session, &error);
    cz_tell_warnings(arguments, session->problem);
    session->setup_s = cz_clock() - started;
    return 0;
}

int cz_session_begin(CzSession *session, const CzArguments *arguments, const char *file) {
    const double started = cz_clock();
    const int code = cz_session_read(session, arguments, file);
    if (code != 0)
        return code;
    CzEvaluatorOptions options = cz_evaluator_options_default();
    options.n_job = arguments->n_job;
    options.scenario = arguments->text[CZ_OPTION_SCENARIO];
    CzError error = {0};
    if (cz_evaluator_build(session->problem, &options, &session->evaluator, &error) != CZ_OK)
        return cz_session_fail(session, &error);
    session->setup_s = cz_clock() - started;
    return 0;
}

void cz_session_end(CzSession *session) {
    cz_evaluator_free(session->evaluator);
    cz_problem_free(session->problem);
    session->evaluator = NULL;
    session->problem = NULL;
}

CzReportOptions cz_session_report_options(const CzSession *session, double wall_s) {
    CzReportOptions options = cz_report_options_default();
    options.csv_separator = session->arguments->csv_separator;
    options.csv_decimal = session->arguments->csv_decimal;
    options.n_job = session->arguments->n_job;
    options.setup_s = session->setup_s;
    options.wall_s = wall_s;
    options.set = session->arguments->set;
    options.n_set = session->arguments->n_set;
    return options;
}

/* Mistakes that were found while reading are told all; later ones alone, with their source line. */
int cz_session_fail(const CzSession *session, const CzError *error) {
    if (session->problem == NULL || cz_problem_n_mistake(session->problem) > 0 ||
        session->arguments->text[CZ_OPTION_JSON] != NULL)
        return cz_tell_mistakes(session->arguments, session->problem, error);
    cz_print_mistake(session->arguments, "error", session->problem, error);
    return cz_status_exit_code(error->status);
}
