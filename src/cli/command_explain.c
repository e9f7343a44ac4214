/* `explain`: why it climbed, and what would have to be otherwise. */
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/messages.h"
#include "cli/progress.h"
#include "cli/session.h"

#include <stdio.h>
#include <unistd.h>

static int answer(const CzSession *session, const CzExplanation *explanation) {
    const CzArguments *arguments = session->arguments;
    const CzReportOptions options = cz_session_report_options(session, explanation->wall_s);
    CzError error = {0};
    CzStatus status;
    if (arguments->text[CZ_OPTION_JSON] == NULL)
        status = cz_end_table(cz_report_write_explanation_table(
                                  explanation, cz_wants_colour(arguments, STDOUT_FILENO), stdout),
                              &error);
    else
        status =
            cz_report_write_explanation(session->problem, explanation, &options, stdout, &error);
    if (status != CZ_OK) {
        cz_print_mistake(arguments, "error", NULL, &error);
        return cz_status_exit_code(status);
    }
    cz_tell(arguments, "%ld collisions in %.3g s", explanation->n_run, explanation->wall_s);
    return 0;
}

int cz_command_explain(const CzArguments *arguments) {
    CzSession session;
    int code = cz_session_begin(&session, arguments, arguments->operand[0]);
    if (code == 0) {
        CzExplainOptions options = cz_explain_options_default();
        CzExplanation *explanation = NULL;
        CzError error = {0};
        options.stop = cz_interrupt_flag();
        options.progress = cz_progress_count;
        options.progress_data = (void *)arguments;
        cz_interrupt_catch();
        const CzStatus status = cz_explain(session.evaluator, &options, &explanation, &error);
        if (status == CZ_OK)
            code = answer(&session, explanation);
        else if (status == CZ_STATUS_INTERRUPTED)
            code = (cz_tell_error(arguments, &error), 128 + cz_interrupt_signal());
        else
            code = cz_session_fail(&session, &error);
        cz_explanation_free(explanation);
    }
    cz_session_end(&session);
    return code;
}
