/* `pareto`: a front of two objectives; completed points are kept on the first signal. */
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/messages.h"
#include "cli/progress.h"
#include "cli/session.h"

#include <stdio.h>

static const char default_folder[] = "out-pareto";

/* Progress of the search of each point. */
typedef struct Progress {
    CzProgressLine line;
    int point, n_point;
} Progress;

static void begin_point(int point, int n_point, void *data) {
    Progress *progress = data;
    progress->point = point;
    progress->n_point = n_point;
}

static void show(const CzProgress *of_search, void *data) {
    Progress *progress = data;
    CzProgress shown = *of_search;
    char phase[80];
    snprintf(phase, sizeof phase, "%s, point %d of %d",
             of_search->phase != NULL ? of_search->phase : "search", progress->point + 1,
             progress->n_point);
    shown.phase = phase;
    cz_progress_show(&shown, &progress->line);
}

/* 0 when every point is an optimum that passes; a point that is no better than another one is. */
static int judge(const CzPareto *pareto) {
    CzStatus worst = CZ_OK;
    if (pareto->is_interrupted)
        return cz_interrupt_is_limit() ? cz_status_exit_code(CZ_STATUS_RUN_FAILED)
                                       : 128 + cz_interrupt_signal();
    for (int i = 0; i < pareto->n_point; i++)
        if (pareto->point[i].state == CZ_PARETO_FAILED)
            worst = CZ_STATUS_RUN_FAILED;
        else if (pareto->point[i].state != CZ_PARETO_VERIFIED &&
                 pareto->point[i].state != CZ_PARETO_NOT_NEEDED && worst == CZ_OK)
            worst = CZ_STATUS_VIOLATED;
    return cz_status_exit_code(worst);
}

static int finish(CzSession *session, const CzPareto *pareto, const char *folder) {
    const CzArguments *arguments = session->arguments;
    CzReport report = cz_session_report(session, CZ_REPORT_PARETO, pareto->wall_s);
    report.evaluator = pareto->evaluator;
    report.pareto = pareto;
    const int unkept = cz_keep_results(arguments, &report, folder);
    const int unprinted = cz_print_results(arguments, &report);
    if (unkept == 0)
        cz_tell(arguments, "results in %s, computed in %.3g s", folder, pareto->wall_s);
    return unkept != 0 ? unkept : unprinted != 0 ? unprinted : judge(pareto);
}

static int find_front(CzSession *session, const char *folder) {
    const CzArguments *arguments = session->arguments;
    Progress progress = {.n_point = 1};
    CzParetoOptions options = cz_pareto_options_default();
    for (int k = 0; k < 2; k++)
        options.minimise[k] = arguments->minimise[k];
    if (arguments->n_point > 0)
        options.n_point = arguments->n_point;
    options.n_job = arguments->n_job;
    options.search.algorithm = arguments->text[CZ_OPTION_ALGORITHM];
    options.search.evaluations = arguments->evaluations;
    options.search.seed = arguments->seed;
    options.search.stop = cz_interrupt_flag();
    options.search.progress = show;
    options.search.progress_data = &progress;
    options.begins = begin_point;
    options.begins_data = &progress;
    cz_interrupt_catch();
    if (arguments->max_time > 0)
        cz_interrupt_after(arguments->max_time);
    cz_progress_begin(&progress.line, arguments, false, "");
    CzPareto *pareto = NULL;
    CzError error = {0};
    const CzStatus status = cz_pareto(session->problem, &options, &pareto, &error);
    cz_progress_end(&progress.line);
    const int code =
        status == CZ_OK ? finish(session, pareto, folder) : cz_session_fail(session, &error);
    cz_pareto_free(pareto);
    return code;
}

int cz_command_pareto(const CzArguments *arguments) {
    const char *folder = arguments->text[CZ_OPTION_OUTPUT];
    CzSession session;
    if (folder == NULL)
        folder = default_folder;
    int code = cz_session_read(&session, arguments, arguments->operand[0]);
    if (code == 0)
        code =
            cz_session_check_folder(&session, folder, arguments->text[CZ_OPTION_REPLACE] != NULL);
    if (code == 0)
        code = find_front(&session, folder);
    cz_session_end(&session);
    return code;
}
