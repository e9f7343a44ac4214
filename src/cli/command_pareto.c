/* `pareto`: a front of two objectives; completed points are kept on the first signal. */
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/messages.h"
#include "cli/progress.h"
#include "cli/resume.h"

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
        return cz_interrupt_code();
    for (int i = 0; i < pareto->n_point; i++)
        if (pareto->point[i].state == CZ_PARETO_FAILED)
            worst = CZ_STATUS_RUN_FAILED;
        else if (pareto->point[i].state != CZ_PARETO_NOT_NEEDED && worst == CZ_OK &&
                 (pareto->point[i].state != CZ_PARETO_VERIFIED ||
                  !cz_verdict_passes(pareto->point[i].verdict)))
            worst = CZ_STATUS_VIOLATED;
    return cz_status_exit_code(worst);
}

/* A front with its folder. */
typedef struct Front {
    CzArguments arguments; /* of the command line; of a resumed front with those of its journal */
    CzSession session;
    CzReport report;
    CzJournalFile *journal;
    const char *folder;
    CzPareto *pareto;
} Front;

static int finish(Front *front) {
    const CzArguments *arguments = &front->arguments;
    const CzPareto *pareto = front->pareto;
    front->session.options.wall_s = pareto->wall_s;
    front->session.options.journal = cz_journal_path(front->journal);
    front->session.options.replaces_search = true; /* its own journal */
    front->report.evaluator = pareto->evaluator;
    front->report.pareto = pareto;
    const int unkept = cz_save_results(arguments, &front->report, front->folder);
    const int unprinted = cz_print_results(arguments, &front->report);
    if (unkept == 0)
        cz_print_note(arguments, "results in %s, computed in %.3g s", front->folder,
                      pareto->wall_s);
    return unkept != 0 ? unkept : unprinted != 0 ? unprinted : judge(pareto);
}

static CzParetoOptions options_of(const Front *front, Progress *progress) {
    const CzArguments *arguments = &front->arguments;
    const CzJournalHead *head = cz_journal_head(front->journal);
    CzParetoOptions options = cz_pareto_options_default();
    for (int k = 0; k < 2 && k < arguments->n_minimise; k++)
        options.minimise[k] = arguments->minimise[k];
    if (arguments->n_point > 0)
        options.n_point = arguments->n_point;
    options.n_job = arguments->n_job;
    options.executor = arguments->executor;
    options.search.algorithm = head != NULL ? head->algorithm : NULL;
    if (arguments->text[CZ_OPTION_ALGORITHM] != NULL)
        options.search.algorithm = arguments->text[CZ_OPTION_ALGORITHM];
    options.search.evaluations = arguments->evaluations;
    options.search.seed = arguments->seed;
    options.search.width = (int)arguments->width;
    options.search.stop = cz_interrupt_flag();
    options.search.progress = show;
    options.search.progress_data = progress;
    options.begins = begin_point;
    options.begins_data = progress;
    return options;
}

static int find_front(Front *front) {
    Progress progress = {.n_point = 1};
    CzError error = {0};
    CzParetoOptions options = options_of(front, &progress);
    front->report = cz_session_report(&front->session, CZ_REPORT_PARETO, 0);
    front->report.evaluator = front->session.evaluator;
    CzStatus status = cz_optimise_fill_defaults(front->session.evaluator, &options.search, &error);
    if (status == CZ_OK)
        status = cz_journal_begin(front->journal, &front->report, &options.search, &error);
    if (status == CZ_OK) {
        cz_interrupt_catch();
        if (front->arguments.max_time > 0)
            cz_interrupt_after(front->arguments.max_time);
        cz_progress_begin(&progress.line, &front->arguments, false, "");
        status = cz_pareto(front->session.problem, &options, &front->pareto, &error);
        cz_progress_end(&progress.line);
    }
    const int code = status == CZ_OK ? finish(front) : cz_session_fail(&front->session, &error);
    cz_journal_end(front->journal, cz_resume_is_useless(status));
    front->journal = NULL;
    return code;
}

int cz_command_pareto(const CzArguments *arguments) {
    Front front = {.arguments = *arguments};
    const bool resumes = arguments->text[CZ_OPTION_RESUME] != NULL;
    front.folder = resumes ? arguments->text[CZ_OPTION_RESUME] : arguments->text[CZ_OPTION_OUTPUT];
    if (front.folder == NULL)
        front.folder = default_folder;
    int code = resumes ? cz_resume_open(&front.arguments, front.folder, &front.journal) : 0;
    if (code == 0) {
        code = cz_session_begin(&front.session, &front.arguments, arguments->operand[0]);
        if (code == 0)
            code = cz_session_check_folder(&front.session, front.folder,
                                           resumes || arguments->text[CZ_OPTION_REPLACE] != NULL);
        if (code == 0 && !resumes)
            code = cz_resume_open(&front.arguments, front.folder, &front.journal);
        if (code == 0)
            code = find_front(&front);
        cz_pareto_free(front.pareto);
        cz_session_end(&front.session);
    }
    cz_journal_end(front.journal, false);
    return code;
}
