/* `dakota`: one evaluation of a study by Dakota, from its parameters file to its results file. */
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/messages.h"
#include "cli/session.h"
#include "crushzone/dakota.h"

#include <stdio.h>
#include <string.h>

static CzStatus write_results(const void *data, FILE *stream, CzError *error) {
    (void)error; /* the stream keeps its failures */
    cz_dakota_write(data, stream);
    return CZ_OK;
}

static CzStatus write_failure(const void *data, FILE *stream, CzError *error) {
    (void)error;
    cz_dakota_write_failure(data, stream);
    return CZ_OK;
}

/* Writes the results, which Dakota always expects, completely or not at all. */
static int write_file(const CzArguments *arguments, CzReportWriter *write, const void *data) {
    CzError error = {0};
    const CzStatus status = cz_report_write_file(arguments->operand[1], write, data, &error);
    return status == CZ_OK ? 0 : cz_print_error(arguments, &error);
}

/* Reports a mistake, and writes the results of a failed evaluation. */
static int refuse(const CzSession *session, const CzError *error) {
    const int code = cz_session_fail(session, error);
    const int unwritten = write_file(session->arguments, write_failure, error->message);
    return unwritten != 0 ? unwritten : code;
}

static int evaluate(const CzSession *session) {
    const CzArguments *arguments = session->arguments;
    const CzProblemOptions problem_options = cz_session_problem_options(arguments);
    const CzDakotaOptions options = {.problem = &problem_options,
                                     .n_job = arguments->n_job,
                                     .scenario = arguments->text[CZ_OPTION_SCENARIO],
                                     .stop = cz_interrupt_flag()};
    CzDakota *dakota = NULL;
    CzError error = {0};
    const CzStatus status =
        cz_dakota_evaluate(session->problem, arguments->operand[0], &options, &dakota, &error);
    if (status == CZ_STATUS_INTERRUPTED)
        return cz_interrupt_code();
    if (status != CZ_OK)
        return refuse(session, &error);
    if (cz_dakota_failure(dakota)[0] != '\0')
        cz_print_note(arguments, "the evaluation failed: %s", cz_dakota_failure(dakota));
    const int code = write_file(arguments, write_results, dakota);
    cz_dakota_free(dakota);
    return code;
}

int cz_command_dakota(const CzArguments *arguments) {
    const char *file = arguments->text[CZ_OPTION_PROBLEM];
    CzSession session;
    if (file == NULL || strcmp(file, "-") == 0)
        return cz_print_error(arguments, &(CzError){.status = CZ_STATUS_INPUT,
                                                    .message = "the problem is missing: give "
                                                               "--problem FILE"});
    cz_interrupt_catch();
    int code = cz_session_read(&session, arguments, file);
    if (code == 0)
        code = evaluate(&session);
    else if (write_file(arguments, write_failure, "the problem cannot be read") != 0)
        code = cz_status_exit_code(CZ_STATUS_OUTPUT);
    cz_session_end(&session);
    return code;
}
