/* `optimise`: search, keep the best on the first signal, print before and after. */
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/messages.h"
#include "cli/progress.h"
#include "cli/session.h"

static const char default_folder[] = "out-optimised";

static CzStatus search(CzSession *session, CzOutcome **outcome, CzError *error) {
    const CzArguments *arguments = session->arguments;
    CzProgressLine line;
    CzOptimiseOptions options = cz_optimise_options_default();
    if (arguments->text[CZ_OPTION_ALGORITHM] != NULL)
        options.algorithm = arguments->text[CZ_OPTION_ALGORITHM];
    if (arguments->evaluations > 0)
        options.evaluations = arguments->evaluations;
    if (arguments->seed >= 0)
        options.seed = arguments->seed;
    options.stop = cz_interrupt_flag();
    options.progress = cz_progress_show;
    options.progress_data = &line;

    cz_interrupt_catch();
    cz_progress_begin(&line, arguments, cz_evaluator_maximises_margin(session->evaluator),
                      cz_evaluator_objective_unit(session->evaluator));
    const CzStatus status = cz_optimise(session->evaluator, &options, outcome, error);
    cz_progress_end(&line);
    return status;
}

static int judge(const CzOutcome *outcome) {
    switch (outcome->status) {
    case CZ_OUTCOME_FEASIBLE:
        return 0;
    case CZ_OUTCOME_INFEASIBLE:
        return cz_status_exit_code(CZ_STATUS_VIOLATED);
    case CZ_OUTCOME_INTERRUPTED:
        return 128 + cz_interrupt_signal();
    }
    return cz_status_exit_code(CZ_STATUS_INTERNAL);
}

/* The folder is written first, so that the best design is kept even if the terminal fails. */
static int finish(CzSession *session, const CzOutcome *outcome, const char *folder) {
    const CzArguments *arguments = session->arguments;
    CzReport report = cz_session_report(session, CZ_REPORT_SEARCH, outcome->wall_s);
    report.outcome = outcome;
    const int unkept = cz_keep_results(arguments, &report, folder);
    const int unprinted = cz_print_results(arguments, &report);
    if (unkept == 0)
        cz_tell(arguments,
                "results in %s, computed in %.3g s; run the best design with: crushzone "
                "check %s/optimised.yaml",
                folder, outcome->wall_s, folder);
    return unkept != 0 ? unkept : unprinted != 0 ? unprinted : judge(outcome);
}

int cz_command_optimise(const CzArguments *arguments) {
    const char *folder = arguments->text[CZ_OPTION_OUTPUT];
    CzError error = {0};
    if (folder == NULL)
        folder = default_folder;
    CzSession session;
    CzOutcome *outcome = NULL;
    int code = cz_session_begin(&session, arguments, arguments->operand[0]);
    if (code == 0)
        code = cz_session_check_folder(&session, folder, true);
    if (code == 0) {
        const CzStatus status = search(&session, &outcome, &error);
        if (outcome != NULL)
            code = finish(&session, outcome, folder);
        if (status != CZ_OK && outcome != NULL) {
            cz_print_mistake(arguments, "error", NULL, &error);
            code = cz_status_exit_code(status);
        } else if (status != CZ_OK) {
            code = cz_session_fail(&session, &error);
        }
    }
    cz_outcome_free(outcome);
    cz_session_end(&session);
    return code;
}
