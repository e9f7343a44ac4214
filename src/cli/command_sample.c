/* `sample`: the scatter of `uncertainty:` is drawn and judged; completed samples are kept on the
 * first signal. */
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/messages.h"
#include "cli/progress.h"
#include "cli/shard.h"

#include <stdio.h>

static int judge(const CzArguments *arguments, const CzSampling *sampling) {
    if (sampling->is_interrupted)
        return cz_interrupt_code();
    if (sampling->n_failed > 0)
        cz_print_note(arguments, "%d samples gave no result, and count as failing",
                      sampling->n_failed);
    if (sampling->n_failed > 0 && sampling->n_shard == 1)
        return cz_status_exit_code(CZ_STATUS_RUN_FAILED);
    /* a shard is complete, and the whole is judged */
    if (cz_verdict_passes(sampling->judgement) || sampling->n_shard > 1)
        return 0;
    return cz_status_exit_code(CZ_STATUS_VIOLATED);
}

static int finish(CzSession *session, const CzSampling *sampling) {
    const CzArguments *arguments = session->arguments;
    const char *folder = arguments->text[CZ_OPTION_OUTPUT];
    CzReport report = cz_session_report(session, CZ_REPORT_SAMPLE, sampling->wall_s);
    report.sampling = sampling;
    const int code = cz_session_deliver_shard(session, &report);
    if (code != 0)
        return code;
    cz_print_note(arguments, "%d of %d samples in %.3g s%s%s", sampling->n_run, sampling->n_sample,
                  sampling->wall_s, folder != NULL ? ", results in " : "",
                  folder != NULL ? folder : "");
    return judge(arguments, sampling);
}

static int sample_file(CzSession *session, void *data) {
    CzShards *shards = data;
    const CzArguments *arguments = session->arguments;
    const CzProblemOptions problem_options = cz_session_problem_options(arguments);
    CzSampleOptions options = cz_sample_options_default();
    options.n_sample = (int)arguments->n_sample;
    options.seed = arguments->seed;
    options.shard = arguments->shard;
    options.n_shard = arguments->n_shard;
    options.n_job = arguments->n_job;
    options.executor = arguments->executor;
    options.text = session->text;
    options.n_text = session->n_text;
    options.stop = cz_interrupt_flag();
    options.progress = cz_progress_count;
    options.progress_data = (void *)arguments;
    options.recall = shards != NULL ? cz_shards_fill_samples : NULL;
    options.recall_data = shards;
    CzSampling *sampling = NULL;
    CzError error = {0};
    int code;
    cz_interrupt_catch();
    if (cz_sample(session->file, &problem_options, &options, &sampling, &error) == CZ_OK)
        code = finish(session, sampling);
    else
        code = cz_session_fail(session, &error);
    cz_sampling_free(sampling);
    return code;
}

int cz_sample_shards(const CzArguments *arguments, CzShards *shards) {
    return cz_session_study(arguments, sample_file, shards);
}

int cz_command_sample(const CzArguments *arguments) {
    return cz_sample_shards(arguments, NULL);
}
