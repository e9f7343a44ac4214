/* `run` and `check`: simulate every scenario, print the table, write the result folder. */
#include "base/error.h"
#include "cli/command.h"
#include "cli/junit_file.h"
#include "base/clock.h"
#include "cli/messages.h"
#include "cli/progress.h"
#include "cli/session.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

static const char default_folder[] = "out";

/* Result folder of one of the files, NULL when no results are written. `room` is space for its
 * name; with several files each has a folder of its own inside the requested one. */
static const char *folder_of(const CzArguments *arguments, const char *file, char room[4096]) {
    const char *folder = arguments->text[CZ_OPTION_OUTPUT];
    const bool by_default =
        arguments->command == CZ_COMMAND_RUN && arguments->text[CZ_OPTION_JSON] == NULL;
    if (folder == NULL && by_default)
        folder = default_folder;
    if (folder == NULL || arguments->n_operand == 1)
        return folder;
    const char *slash = strrchr(file, '/');
    const char *name = slash != NULL ? slash + 1 : file;
    const char *dot = strrchr(name, '.');
    snprintf(room, 4096, "%s/%.*s", folder,
             dot != NULL && dot != name ? (int)(dot - name) : (int)strlen(name), name);
    return room;
}

static void print_runs(const CzArguments *arguments, const CzEvaluation *evaluation) {
    for (int i = 0; i < evaluation->n_run; i++) {
        if (evaluation->run == NULL || evaluation->run[i] == NULL)
            continue; /* a scenario that was left out */
        const CzRunSummary *run = cz_run_summary(evaluation->run[i]);
        cz_print_note(arguments, "%s: %ld steps of %.3g ms in %.3g s, momentum error %.2g",
                      run->scenario, run->n_step, 1e3 * run->time_step, run->wall_s,
                      run->momentum_error);
    }
}

/* Prints what to do about runs that ended at the longest time. */
static void print_incomplete(const CzArguments *arguments, const CzEvaluation *evaluation) {
    for (int i = 0; i < evaluation->n_run; i++) {
        if (evaluation->run == NULL || evaluation->run[i] == NULL)
            continue;
        const CzRunSummary *run = cz_run_summary(evaluation->run[i]);
        if (run->status == CZ_OK && run->ended == CZ_ENDED_INCOMPLETE)
            cz_print_note(arguments,
                          "scenario '%s' has not met its end criterion after %.3g s, the "
                          "simulation.longest_s of the problem: %s; allow more, such as --set "
                          "simulation.longest_s=%.3g, or choose the end by simulation.duration_s",
                          run->scenario, run->simulated, run->awaited, 2.0 * run->simulated);
    }
}

/* Only `check`, or `run --strict`, judges by exit code. A check that could not be judged does not
 * pass. */
static int judge(const CzArguments *arguments, const CzEvaluation *evaluation) {
    if (evaluation->status != CZ_OK) {
        print_incomplete(arguments, evaluation);
        cz_print_note(arguments,
                      "a run failed or is incomplete: do not use its results for a design");
        return cz_status_exit_code(CZ_STATUS_RUN_FAILED);
    }
    const bool judges =
        arguments->command == CZ_COMMAND_CHECK || arguments->text[CZ_OPTION_STRICT] != NULL;
    if (!judges || cz_verdict_passes(evaluation->verdict))
        return 0;
    if (evaluation->verdict == CZ_VERDICT_NOT_CHECKED)
        cz_print_note(arguments, "some checks could not be made, so the verdict is not a pass");
    return cz_status_exit_code(CZ_STATUS_VIOLATED);
}

static int finish(CzSession *session, const CzEvaluation *evaluation, double wall_s,
                  const char *folder, CzJunit *junit) {
    const CzArguments *arguments = session->arguments;
    CzReport report = cz_session_report(session, CZ_REPORT_RUN, wall_s);
    report.evaluation = evaluation;
    if (junit != NULL)
        cz_junit_add(junit, &report);
    int code = cz_print_results(arguments, &report);
    if (code == 0)
        code = cz_save_results(arguments, &report, folder);
    if (code != 0)
        return code;
    if (folder != NULL)
        cz_print_note(arguments, "results in %s, computed in %.2g s", folder, wall_s);
    return judge(arguments, evaluation);
}

static int run_file(const CzArguments *arguments, const char *file, CzJunit *junit) {
    char room[4096];
    const char *folder = folder_of(arguments, file, room);
    CzError error = {0};
    CzSession session;
    int code = cz_session_begin(&session, arguments, file);
    if (code == 0)
        code =
            cz_session_check_folder(&session, folder, arguments->text[CZ_OPTION_REPLACE] != NULL);
    if (code == 0)
        code = cz_session_write_depfile(&session, folder, "summary.json");
    bool is_judged = code == 0;
    if (is_judged) {
        CzEvaluation evaluation = {0};
        const double started = cz_clock();
        if (cz_evaluate(session.evaluator, 1, NULL, true, &evaluation, &error) != CZ_OK) {
            code = cz_session_fail(&session, &error);
            is_judged = false;
        } else {
            const double wall_s = cz_clock() - started;
            if (arguments->text[CZ_OPTION_VERBOSE] != NULL)
                print_runs(arguments, &evaluation);
            code = finish(&session, &evaluation, wall_s, folder, junit);
        }
        cz_evaluation_free(&evaluation);
    }
    if (!is_judged)
        cz_junit_file_add_unjudged(junit, file);
    cz_session_end(&session);
    return code;
}

/* Whether two of the files would be written to the same folder, which the second would replace. On
 * file systems that ignore case, names that differ by case are the same folder. */
static int check_folders(const CzArguments *arguments) {
    char first[4096], second[4096];
    for (int i = 0; i < arguments->n_operand; i++)
        for (int k = 0; k < i; k++) {
            const char *folder = folder_of(arguments, arguments->operand[i], first);
            const char *other = folder_of(arguments, arguments->operand[k], second);
            if (folder == NULL || strcasecmp(folder, other) != 0)
                continue;
            CzError error;
            cz_fail(&error, CZ_STATUS_OUTPUT,
                    "%.150s and %.150s would be written to the same folder, %.100s" CZ_HELP
                    "run them one at a time, each with its own -o",
                    arguments->operand[k], arguments->operand[i], folder);
            return cz_print_error(arguments, &error);
        }
    return 0;
}

/* Refuses what cannot be written, before anything is computed. */
static int check_outputs(const CzArguments *arguments) {
    char room[4096];
    CzError error = {0};
    const int code = check_folders(arguments);
    if (code != 0)
        return code;
    if (arguments->text[CZ_OPTION_ISO_MME] != NULL &&
        folder_of(arguments, arguments->operand[0], room) == NULL) {
        cz_fail(&error, CZ_STATUS_INPUT, "--iso-mme needs a result folder: give -o DIR");
        return cz_print_error(arguments, &error);
    }
    return 0;
}

int cz_command_run(const CzArguments *arguments) {
    CzJunit *junit = NULL;
    int worst = check_outputs(arguments);
    if (worst == 0)
        worst = cz_junit_file_begin(arguments, &junit);
    if (worst != 0)
        return worst;
    for (int i = 0; i < arguments->n_operand; i++) {
        if (i > 0)
            fputc('\n', stdout);
        const int code = run_file(arguments, arguments->operand[i], junit);
        worst = code > worst ? code : worst;
    }
    const int code = cz_junit_file_end(arguments, junit);
    return code > worst ? code : worst;
}
