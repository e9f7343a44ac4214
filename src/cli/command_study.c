/* `explain`, `verify` and `bench`: commands that simulate a problem many times. */
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/messages.h"
#include "cli/progress.h"
#include "cli/session.h"

/* Reports a study that was not completed; returns its exit code. */
static int end_early(const CzSession *session, CzStatus status, const CzError *error) {
    if (status != CZ_STATUS_INTERRUPTED)
        return cz_session_fail(session, error);
    (void)cz_print_error(session->arguments, error);
    return cz_interrupt_code();
}

/* ---- explain: checks and overrides, and changes that help ---- */

static int explain(CzSession *session) {
    const CzArguments *arguments = session->arguments;
    CzExplainOptions options = cz_explain_options_default();
    CzExplanation *explanation = NULL;
    CzError error = {0};
    options.n_check = arguments->n_check;
    options.check = arguments->check;
    options.stop = cz_interrupt_flag();
    options.progress = cz_progress_count;
    options.progress_data = (void *)arguments;
    const CzStatus status = cz_explain(session->evaluator, &options, &explanation, &error);
    if (status != CZ_OK)
        return end_early(session, status, &error);
    CzReport report = cz_session_report(session, CZ_REPORT_EXPLANATION, explanation->wall_s);
    report.explanation = explanation;
    const int code = cz_print_results(arguments, &report);
    if (code == 0)
        cz_print_note(arguments, "%ld collisions in %.3g s", explanation->n_run,
                      explanation->wall_s);
    cz_explanation_free(explanation);
    return code;
}

/* ---- verify: results with a halved time step and by two other solvers ---- */

static int judge(const CzArguments *arguments, const CzVerification *verification) {
    for (int method = 0; method < CZ_N_VERIFY_METHOD; method++)
        if (verification->is_done[method] && arguments->text[CZ_OPTION_VERBOSE] != NULL)
            cz_print_note(arguments, "%s: %.3g s", cz_verify_method_text((CzVerifyMethod)method),
                          verification->run_s[method]);
    if (verification->status != CZ_OK)
        return cz_status_exit_code(CZ_STATUS_RUN_FAILED);
    return verification->verdict == CZ_VERDICT_PASS ? 0 : cz_status_exit_code(CZ_STATUS_VIOLATED);
}

static int verify(CzSession *session) {
    CzVerifyOptions options = cz_verify_options_default();
    CzVerification *verification = NULL;
    CzError error = {0};
    options.stop = cz_interrupt_flag();
    const CzStatus status =
        cz_verify(session->evaluator, NULL, NULL, &options, &verification, &error);
    if (status == CZ_STATUS_INTERRUPTED)
        return cz_interrupt_code();
    if (status != CZ_OK)
        return cz_session_fail(session, &error);
    CzReport report = cz_session_report(session, CZ_REPORT_VERIFICATION, 0);
    report.verification = verification;
    int code = cz_print_results(session->arguments, &report);
    if (code == 0)
        code = judge(session->arguments, verification);
    cz_verification_free(verification);
    return code;
}

/* ---- bench: computing times of the scenarios ---- */

static int bench(CzSession *session) {
    const CzArguments *arguments = session->arguments;
    CzBenchmarkOptions options = cz_benchmark_options_default();
    CzBenchmark *benchmark = NULL;
    CzError error = {0};
    options.stop = cz_interrupt_flag();
    options.progress = cz_progress_count;
    options.progress_data = (void *)arguments;
    if (arguments->rounds > 0)
        options.n_round = (int)arguments->rounds;
    const CzStatus status = cz_benchmark(session->evaluator, &options, &benchmark, &error);
    if (status != CZ_OK)
        return end_early(session, status, &error);
    CzReport report = cz_session_report(session, CZ_REPORT_BENCHMARK, benchmark->wall_s);
    report.benchmark = benchmark;
    session->options.n_job = 1; /* for any number of processors */
    int code = cz_print_results(arguments, &report);
    if (code == 0) {
        cz_print_note(arguments, "read in %.2g s, timed in %.2g s, on one thread", session->setup_s,
                      benchmark->wall_s);
        code = cz_status_exit_code(benchmark->status);
    }
    cz_benchmark_free(benchmark);
    return code;
}

int cz_command_study(const CzArguments *arguments) {
    CzSession session;
    int code = cz_session_begin(&session, arguments, arguments->operand[0]);
    if (code == 0) {
        cz_interrupt_catch();
        code = arguments->command == CZ_COMMAND_EXPLAIN  ? explain(&session)
               : arguments->command == CZ_COMMAND_VERIFY ? verify(&session)
                                                         : bench(&session);
    }
    cz_session_end(&session);
    return code;
}
