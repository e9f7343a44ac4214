/* `explain`: why it climbed, and what would have to be otherwise. */
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/messages.h"
#include "cli/progress.h"
#include "cli/session.h"

static int answer(const CzSession *session, const CzExplanation *explanation) {
    const CzArguments *arguments = session->arguments;
    const CzReportOptions options = cz_session_report_options(session, explanation->wall_s);
    const CzReport report = {.kind = CZ_REPORT_EXPLANATION,
                             .options = &options,
                             .problem = session->problem,
                             .explanation = explanation};
    const int code = cz_print_results(arguments, &report);
    if (code != 0)
        return code;
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
