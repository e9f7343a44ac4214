/* `sweep`: one or two paths over a range, with a verdict at every point; completed points are kept
 * on the first signal. */
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/messages.h"
#include "cli/progress.h"
#include "cli/shard.h"

#include <stdio.h>

/* Reads the axes of `--vary`; returns the exit code. */
static int read_axes(const CzArguments *arguments, CzSweepAxis axis[CZ_MAX_AXES]) {
    CzError error = {0};
    for (int k = 0; k < arguments->n_vary; k++)
        if (cz_sweep_axis_parse(arguments->vary[k], &axis[k], &error) != CZ_OK)
            return cz_print_error(arguments, &error);
    return 0;
}

static int judge(const CzArguments *arguments, const CzSweep *sweep) {
    if (sweep->is_interrupted)
        return cz_interrupt_code();
    if (sweep->n_shard > 1) /* it is complete, and the whole is judged */
        return 0;
    bool passes = true;
    for (int i = sweep->begin; i < sweep->end; i++) {
        const CzSweepPoint *point = &sweep->point[i];
        if (point->state == CZ_SWEEP_RUN_FAILED) {
            cz_print_note(arguments,
                          "a run failed or is incomplete: do not use its point for a design");
            return cz_status_exit_code(CZ_STATUS_RUN_FAILED);
        }
        passes &= point->state == CZ_SWEEP_DONE && cz_verdict_passes(point->verdict);
    }
    const bool judges = arguments->text[CZ_OPTION_STRICT] != NULL;
    return judges && !passes ? cz_status_exit_code(CZ_STATUS_VIOLATED) : 0;
}

/* Number of points that were run before an interruption. */
static int count_run(const CzSweep *sweep) {
    int n = 0;
    for (int i = 0; i < sweep->n_point; i++)
        n += sweep->point[i].state != CZ_SWEEP_NOT_RUN;
    return n;
}

static int finish(CzSession *session, const CzSweep *sweep) {
    const CzArguments *arguments = session->arguments;
    const char *folder = arguments->text[CZ_OPTION_OUTPUT];
    CzReport report = cz_session_report(session, CZ_REPORT_SWEEP, sweep->wall_s);
    report.sweep = sweep;
    const int code = cz_session_deliver_shard(session, &report);
    if (code != 0)
        return code;
    const int n_run = count_run(sweep);
    char of_all[32] = "";
    if (n_run < sweep->n_point)
        snprintf(of_all, sizeof of_all, " of %d", sweep->n_point);
    cz_print_note(arguments, "%d%s points in %.3g s%s%s", n_run, of_all, sweep->wall_s,
                  folder != NULL ? ", results in " : "", folder != NULL ? folder : "");
    return judge(arguments, sweep);
}

/* Default metrics for one path: those that absorber suppliers show over the speed. */
static const char *const usual_metrics[] = {"elements.stroke_used", "interfaces.peak_force_kN",
                                            "energy.absorbers_kJ", "vehicles.max_wheel_lift_mm"};

/* A sweep of the command line. */
typedef struct Asked {
    CzSweepAxis axis[CZ_MAX_AXES];
    CzShards *shards; /* NULL when no point is known */
} Asked;

static int sweep_file(CzSession *session, void *data) {
    const Asked *asked = data;
    const CzArguments *arguments = session->arguments;
    const CzProblemOptions problem_options = cz_session_problem_options(arguments);
    CzSweepOptions options = cz_sweep_options_default();
    options.n_axis = arguments->n_vary;
    options.axis = asked->axis;
    options.n_metric = arguments->n_metric;
    options.metric = arguments->metric;
    if (arguments->n_metric == 0 && arguments->n_vary == 1) {
        options.n_metric = sizeof usual_metrics / sizeof *usual_metrics;
        options.metric = usual_metrics;
    }
    options.n_check = arguments->n_check;
    options.check = arguments->check;
    options.scenario = arguments->text[CZ_OPTION_SCENARIO];
    options.curves = arguments->text[CZ_OPTION_OUTPUT] != NULL;
    options.shard = arguments->shard;
    options.n_shard = arguments->n_shard;
    options.recall = asked->shards != NULL ? cz_shards_fill_sweep : NULL;
    options.recall_data = asked->shards;
    options.n_job = arguments->n_job;
    options.executor = arguments->executor;
    options.text = session->text;
    options.n_text = session->n_text;
    options.stop = cz_interrupt_flag();
    options.progress = cz_progress_count;
    options.progress_data = (void *)arguments;
    CzSweep *sweep = NULL;
    CzError error = {0};
    int code;
    cz_interrupt_catch();
    if (cz_sweep(session->file, &problem_options, &options, &sweep, &error) == CZ_OK)
        code = finish(session, sweep);
    else
        code = cz_print_error(arguments, &error);
    cz_sweep_free(sweep);
    return code;
}

int cz_sweep_shards(const CzArguments *arguments, CzShards *shards) {
    Asked asked = {.shards = shards};
    const int code = read_axes(arguments, asked.axis);
    return code != 0 ? code : cz_session_study(arguments, sweep_file, &asked);
}

int cz_command_sweep(const CzArguments *arguments) {
    return cz_sweep_shards(arguments, NULL);
}
