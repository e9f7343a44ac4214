/* `verify`: the numbers of a problem once more with a halved time step and by two other solvers. */
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/messages.h"
#include "cli/progress.h"
#include "cli/session.h"

static int judge(const CzVerification *verification) {
    if (verification->status != CZ_OK)
        return cz_status_exit_code(CZ_STATUS_RUN_FAILED);
    return verification->verdict == CZ_VERDICT_PASS ? 0 : cz_status_exit_code(CZ_STATUS_VIOLATED);
}

static int answer(const CzSession *session, const CzVerification *verification) {
    const CzArguments *arguments = session->arguments;
    const CzReportOptions options = cz_session_report_options(session, 0.0);
    const CzReport report = {.kind = CZ_REPORT_VERIFICATION,
                             .options = &options,
                             .problem = session->problem,
                             .verification = verification};
    const int code = cz_print_results(arguments, &report);
    if (code != 0)
        return code;
    for (int method = 0; method < CZ_N_VERIFY_METHOD; method++)
        if (verification->is_done[method] && arguments->text[CZ_OPTION_VERBOSE] != NULL)
            cz_tell(arguments, "%s: %.3g s", cz_verify_method_text((CzVerifyMethod)method),
                    verification->wall_s[method]);
    return judge(verification);
}

int cz_command_verify(const CzArguments *arguments) {
    CzError error = {0};
    CzSession session;
    CzVerification *verification = NULL;
    int code = cz_session_begin(&session, arguments, arguments->operand[0]);
    if (code == 0) {
        CzVerifyOptions options = cz_verify_options_default();
        options.stop = cz_interrupt_flag();
        cz_interrupt_catch();
        const CzStatus status =
            cz_verify(session.evaluator, NULL, NULL, &options, &verification, &error);
        if (status == CZ_OK)
            code = answer(&session, verification);
        else if (status == CZ_STATUS_INTERRUPTED)
            code = 128 + cz_interrupt_signal();
        else
            code = cz_session_fail(&session, &error);
    }
    cz_verification_free(verification);
    cz_session_end(&session);
    return code;
}
