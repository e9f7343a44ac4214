/* `bench`: how long the scenarios of a problem take. */
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/messages.h"
#include "cli/progress.h"
#include "cli/session.h"

static int answer(const CzSession *session, const CzBenchmark *benchmark) {
    const CzArguments *arguments = session->arguments;
    CzReportOptions options = cz_session_report_options(session, benchmark->wall_s);
    options.n_job = 1; /* whatever number of processors there is */
    const CzReport report = {.kind = CZ_REPORT_BENCHMARK,
                             .options = &options,
                             .problem = session->problem,
                             .benchmark = benchmark};
    const int code = cz_print_results(arguments, &report);
    if (code != 0)
        return code;
    cz_tell(arguments, "read in %.2g s, timed in %.2g s, on one thread", session->setup_s,
            benchmark->wall_s);
    return benchmark->status == CZ_OK ? 0 : cz_status_exit_code(benchmark->status);
}

int cz_command_bench(const CzArguments *arguments) {
    CzError error = {0};
    CzSession session;
    CzBenchmark *benchmark = NULL;
    int code = cz_session_begin(&session, arguments, arguments->operand[0]);
    if (code == 0) {
        CzBenchmarkOptions options = cz_benchmark_options_default();
        options.stop = cz_interrupt_flag();
        options.progress = cz_progress_count;
        options.progress_data = (void *)arguments;
        if (arguments->rounds > 0)
            options.n_round = (int)arguments->rounds;
        cz_interrupt_catch();
        const CzStatus status = cz_benchmark(session.evaluator, &options, &benchmark, &error);
        if (status == CZ_OK)
            code = answer(&session, benchmark);
        else if (status == CZ_STATUS_INTERRUPTED)
            code = (cz_tell_error(arguments, &error), 128 + cz_interrupt_signal());
        else
            code = cz_session_fail(&session, &error);
    }
    cz_benchmark_free(benchmark);
    cz_session_end(&session);
    return code;
}
