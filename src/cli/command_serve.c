/* `serve`: answers the requests of a design loop, one line each. */
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/lines.h"
#include "cli/messages.h"
#include "cli/session.h"
#include "crushzone/serve.h"

#include <stdio.h>
#include <string.h>

/* A problem that cannot be served is an answer too, beside the messages. */
static int refuse(const CzSession *session, int code) {
    CzReply reply = {0};
    if (session->problem != NULL && cz_problem_n_mistake(session->problem) > 0)
        reply.error = *cz_problem_mistake(session->problem, 0);
    const CzReport report = {.kind = CZ_REPORT_ANSWER, .reply = &reply};
    CzError error = {0};
    if (reply.error.status != CZ_OK && cz_report_write_json(&report, stdout, &error) != CZ_OK)
        return cz_print_error(session->arguments, &error);
    return code;
}

/* Answers lines until there are no more; returns the exit code. */
static int answer_lines(const CzArguments *arguments, CzServer *server) {
    CzLines lines = {.most = CZ_LONGEST_REQUEST};
    CzStatus status = CZ_OK;
    CzError error = {0};
    int code = -1;
    while (code < 0) {
        const char *line = NULL;
        size_t n_byte = 0;
        switch (cz_lines_next(&lines, &line, &n_byte)) {
        case CZ_LINE:
            status = cz_server_answer(server, line, n_byte, stdout, &error);
            break;
        case CZ_LINE_TOO_LONG:
            status = cz_server_refuse_line(stdout, &error);
            break;
        case CZ_LINES_END:
            code = 0;
            break;
        case CZ_LINES_STOPPED:
            status = CZ_STATUS_INTERRUPTED;
            break;
        case CZ_LINES_FAILED:
            code =
                cz_print_error(arguments, &(CzError){.status = CZ_STATUS_INPUT,
                                                     .message = "standard input cannot be read"});
            break;
        }
        if (status == CZ_STATUS_INTERRUPTED)
            code = cz_interrupt_code();
        else if (status != CZ_OK)
            code = cz_print_error(arguments, &error);
    }
    cz_lines_free(&lines);
    return code;
}

int cz_command_serve(const CzArguments *arguments) {
    CzSession session;
    CzServer *server = NULL;
    CzError error = {0};
    if (strcmp(arguments->operand[0], "-") == 0)
        return cz_print_error(arguments, &(CzError){.status = CZ_STATUS_INPUT,
                                                    .message = "standard input has the requests; "
                                                               "the problem must be a file"});
    cz_interrupt_catch();
    int code = cz_session_read(&session, arguments, arguments->operand[0]);
    if (code != 0)
        code = refuse(&session, code);
    const CzServerOptions options = {.n_job = arguments->n_job,
                                     .scenario = arguments->text[CZ_OPTION_SCENARIO],
                                     .stop = cz_interrupt_flag()};
    if (code == 0 && cz_server_build(session.problem, &options, &server, &error) != CZ_OK)
        code = cz_session_fail(&session, &error);
    if (code == 0)
        code = answer_lines(arguments, server);
    cz_server_free(server);
    cz_session_end(&session);
    return code;
}
