/* `corridor`: the widest corridor of a device's curve; the widths reached so far are kept on the
 * first signal. */
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/messages.h"
#include "cli/progress.h"
#include "cli/session.h"

static int judge(const CzArguments *arguments, const CzCorridor *corridor) {
    if (corridor->is_interrupted)
        return cz_interrupt_code();
    if (corridor->exists)
        return 0;
    if (corridor->curve[0].state == CZ_SAMPLE_RUN_FAILED) {
        cz_print_note(arguments, "a run of the nominal curve failed or is incomplete");
        return cz_status_exit_code(CZ_STATUS_RUN_FAILED);
    }
    return cz_status_exit_code(CZ_STATUS_VIOLATED);
}

static int finish(CzSession *session, const CzCorridor *corridor) {
    const CzArguments *arguments = session->arguments;
    const char *folder = arguments->text[CZ_OPTION_OUTPUT];
    CzReport report = cz_session_report(session, CZ_REPORT_CORRIDOR, corridor->wall_s);
    report.corridor = corridor;
    const int code = cz_session_deliver(session, &report);
    if (code != 0)
        return code;
    cz_print_note(arguments, "%d curves in %.3g s%s%s", corridor->n_curve, corridor->wall_s,
                  folder != NULL ? ", results in " : "", folder != NULL ? folder : "");
    return judge(arguments, corridor);
}

static int find_corridor(CzSession *session, void *data) {
    (void)data;
    const CzArguments *arguments = session->arguments;
    const CzProblemOptions problem_options = cz_session_problem_options(arguments);
    CzCorridorOptions options = cz_corridor_options_default();
    options.part = arguments->text[CZ_OPTION_PART];
    options.n_random = (int)arguments->n_curve;
    options.seed = arguments->seed;
    options.has_scatter = arguments->text[CZ_OPTION_NO_SCATTER] == NULL;
    options.n_job = arguments->n_job;
    options.executor = arguments->executor;
    options.text = session->text;
    options.n_text = session->n_text;
    options.stop = cz_interrupt_flag();
    options.progress = cz_progress_count;
    options.progress_data = (void *)arguments;
    CzCorridor *corridor = NULL;
    CzError error = {0};
    int code;
    cz_interrupt_catch();
    if (cz_corridor(session->file, &problem_options, &options, &corridor, &error) == CZ_OK)
        code = finish(session, corridor);
    else
        code = cz_session_fail(session, &error);
    cz_corridor_free(corridor);
    return code;
}

int cz_command_corridor(const CzArguments *arguments) {
    return cz_session_study(arguments, find_corridor, NULL);
}
