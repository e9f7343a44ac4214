/* `optimise`: search with a journal, keep the best on the first signal, print before and after. */
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/messages.h"
#include "cli/progress.h"
#include "cli/resume.h"
#include "crushzone/robust.h"

#include <stdio.h>

static const char default_folder[] = "out-optimised";

/* A search with its folder. */
typedef struct Search {
    CzArguments arguments; /* of the command line; of a resumed search with those of its journal */
    CzSession session;
    CzReport report;
    CzJournalFile *journal;
    const char *folder;
    CzRobust *robust; /* of a problem with uncertainty; else NULL */
    CzOutcome *outcome;
} Search;

static CzOptimiseOptions options_of(const Search *search) {
    const CzArguments *arguments = &search->arguments;
    const CzJournalHead *head = cz_journal_head(search->journal);
    CzOptimiseOptions options = cz_optimise_options_default();
    if (head != NULL)
        options.algorithm = head->algorithm;
    if (arguments->text[CZ_OPTION_ALGORITHM] != NULL)
        options.algorithm = arguments->text[CZ_OPTION_ALGORITHM];
    if (arguments->evaluations > 0)
        options.evaluations = arguments->evaluations;
    if (arguments->seed >= 0)
        options.seed = arguments->seed;
    options.width = (int)arguments->width;
    options.stop = cz_interrupt_flag();
    return options;
}

/* Whether the uncertainty of the problem is part of the search: not in a single scenario. */
static bool is_robust(const Search *search) {
    return cz_robust_is_asked(search->session.problem) &&
           search->arguments.text[CZ_OPTION_SCENARIO] == NULL;
}

static CzStatus run(Search *search, CzOptimiseOptions *options, CzError *error) {
    const CzArguments *arguments = &search->arguments;
    const CzEvaluator *evaluator = search->session.evaluator;
    CzProgressLine line;
    options->progress = cz_progress_show;
    options->progress_data = &line;
    cz_interrupt_catch();
    if (arguments->max_time > 0)
        cz_interrupt_after(arguments->max_time);
    cz_progress_begin(&line, arguments, cz_evaluator_maximises_margin(evaluator),
                      cz_evaluator_objective_unit(evaluator));
    CzStatus status;
    if (is_robust(search)) {
        const CzEvaluatorOptions given = cz_session_evaluator_options(arguments);
        status =
            cz_optimise_robust(search->session.problem, &given, options, &search->robust, error);
        if (search->robust != NULL) {
            search->outcome = search->robust->outcome;
            search->report.robust = search->robust;
            search->report.problem = search->robust->problem;
            search->report.evaluator = search->robust->evaluator;
        }
    } else {
        status = cz_optimise(search->session.evaluator, options, &search->outcome, error);
    }
    cz_progress_end(&line);
    return status;
}

/* Whether the verdict on the best design passes, which covers checks that no search can meet. Of a
 * fit the tolerances decide alone. */
static int judge_best(const CzArguments *arguments, const CzEvaluation *best) {
    if (cz_verdict_passes(best->verdict) || best->n_match > 0)
        return 0;
    if (best->verdict == CZ_VERDICT_NOT_CHECKED)
        cz_print_note(arguments, "some checks could not be made, so the verdict is not a pass");
    return cz_status_exit_code(CZ_STATUS_VIOLATED);
}

/* Results that lack a part are not those that were asked for, whatever their verdict. */
static int judge(const CzArguments *arguments, const CzOutcome *outcome) {
    if (outcome->is_cut_short)
        return cz_interrupt_code();
    switch (outcome->status) {
    case CZ_OUTCOME_FEASIBLE:
        return judge_best(arguments, &outcome->best_evaluation);
    case CZ_OUTCOME_UNVERIFIED:
    case CZ_OUTCOME_INFEASIBLE:
        return cz_status_exit_code(CZ_STATUS_VIOLATED);
    case CZ_OUTCOME_INTERRUPTED:
        return cz_interrupt_code();
    }
    return cz_status_exit_code(CZ_STATUS_INTERNAL);
}

/* The folder is written first, so that the best design is kept even if the terminal fails. */
static int finish(Search *search) {
    const CzArguments *arguments = &search->arguments;
    CzOutcome *outcome = search->outcome;
    if (outcome->status == CZ_OUTCOME_INTERRUPTED && cz_interrupt_is_limit())
        snprintf(outcome->why_stopped, sizeof outcome->why_stopped,
                 "the time limit of %.40s is reached", arguments->text[CZ_OPTION_MAX_TIME]);
    search->session.options.wall_s = outcome->wall_s;
    search->session.options.journal = cz_journal_path(search->journal);
    search->report.outcome = outcome;
    const int unkept = cz_save_results(arguments, &search->report, search->folder);
    const int unprinted = cz_print_results(arguments, &search->report);
    if (unkept == 0)
        cz_print_note(arguments,
                      "results in %s, computed in %.3g s; run the best design with: crushzone "
                      "check %s/optimised.yaml",
                      search->folder, outcome->wall_s, search->folder);
    return unkept != 0 ? unkept : unprinted != 0 ? unprinted : judge(arguments, outcome);
}

static int search_and_finish(Search *search) {
    CzError error = {0};
    CzOptimiseOptions options = options_of(search);
    int code = 0;
    search->report = cz_session_report(&search->session, CZ_REPORT_SEARCH, 0);
    CzStatus status = cz_optimise_fill_defaults(search->session.evaluator, &options, &error);
    if (status == CZ_OK)
        status = cz_journal_begin(search->journal, &search->report, &options, &error);
    if (status == CZ_OK)
        status = run(search, &options, &error);
    if (search->outcome != NULL)
        code = finish(search);
    if (status != CZ_OK && search->outcome != NULL) {
        cz_print_mistake(&search->arguments, "error", NULL, &error);
        code = cz_status_exit_code(status);
    } else if (status != CZ_OK) {
        code = cz_session_fail(&search->session, &error);
    }
    cz_journal_end(search->journal, cz_resume_is_useless(status));
    search->journal = NULL;
    return code;
}

int cz_command_optimise(const CzArguments *arguments) {
    Search search = {.arguments = *arguments};
    const bool resumes = arguments->text[CZ_OPTION_RESUME] != NULL;
    search.folder = resumes ? arguments->text[CZ_OPTION_RESUME] : arguments->text[CZ_OPTION_OUTPUT];
    if (search.folder == NULL)
        search.folder = default_folder;
    int code = resumes ? cz_resume_open(&search.arguments, search.folder, &search.journal) : 0;
    if (code == 0) {
        code = cz_session_begin(&search.session, &search.arguments, arguments->operand[0]);
        if (code == 0)
            code = cz_session_check_folder(&search.session, search.folder, true);
        if (code == 0)
            code = cz_session_write_depfile(&search.session, search.folder, "outcome.json");
        if (code == 0 && !resumes)
            code = cz_resume_open(&search.arguments, search.folder, &search.journal);
        if (code == 0)
            code = search_and_finish(&search);
        if (search.robust == NULL)
            cz_outcome_free(search.outcome);
        cz_robust_free(search.robust);
        cz_session_end(&search.session);
    }
    cz_journal_end(search.journal, false);
    return code;
}
