/* `challenge`: an optimiser as adversary looks for the weakest point of a design; what it has found
 * is kept on the first signal. */
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/messages.h"
#include "cli/progress.h"
#include "cli/session.h"

static int judge(const CzArguments *arguments, const CzChallenge *challenge) {
    if (challenge->is_interrupted)
        return cz_interrupt_code();
    for (int i = 0; i < challenge->n_weak; i++)
        if (challenge->weak[i].state != CZ_SAMPLE_DONE) {
            cz_print_note(arguments,
                          "a run gave no result: do not use the design before its cause is "
                          "known");
            return cz_status_exit_code(CZ_STATUS_RUN_FAILED);
        }
    return cz_verdict_passes(challenge->judgement) ? 0 : cz_status_exit_code(CZ_STATUS_VIOLATED);
}

static int finish(CzSession *session, const CzChallenge *challenge) {
    const CzArguments *arguments = session->arguments;
    const char *folder = arguments->text[CZ_OPTION_OUTPUT];
    CzReport report = cz_session_report(session, CZ_REPORT_CHALLENGE, challenge->wall_s);
    report.challenge = challenge;
    const int code = cz_session_deliver(session, &report);
    if (code != 0)
        return code;
    cz_print_note(arguments, "%d runs in %.3g s%s%s", challenge->n_point, challenge->wall_s,
                  folder != NULL ? ", results in " : "", folder != NULL ? folder : "");
    return judge(arguments, challenge);
}

static int challenge_file(CzSession *session, void *data) {
    (void)data;
    const CzArguments *arguments = session->arguments;
    CzChallengeOptions options = cz_challenge_options_default();
    if (arguments->n_run > 0)
        options.n_run = (int)arguments->n_run;
    options.seed = arguments->seed;
    options.n_job = arguments->n_job;
    options.executor = arguments->executor;
    options.stop = cz_interrupt_flag();
    options.progress = cz_progress_count;
    options.progress_data = (void *)arguments;
    CzChallenge *challenge = NULL;
    CzError error = {0};
    int code;
    cz_interrupt_catch();
    if (cz_challenge(session->problem, NULL, &options, &challenge, &error) == CZ_OK)
        code = finish(session, challenge);
    else
        code = cz_session_fail(session, &error);
    cz_challenge_free(challenge);
    return code;
}

int cz_command_challenge(const CzArguments *arguments) {
    return cz_session_study(arguments, challenge_file, NULL);
}
