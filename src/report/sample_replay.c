/* A sample as a problem file: the file of the problem with the sample's scenarios behind its own.
 */
#include "report/sample_replay.h"

#include "base/number.h"
#include "evaluate/cases.h"
#include "evaluate/sampling.h"
#include "report/figure.h"
#include "report/options.h"
#include "report/overlay.h"
#include "report/sample_values.h"

#include <string.h>

bool cz_replay_is_written(const CzSampling *sampling, int sample) {
    bool is_worst = sampling->smallest.worst == sample;
    for (int c = 0; c < sampling->n_check; c++)
        is_worst |= sampling->check[c].margin.worst == sample;
    return is_worst && sampling->sample[sample].state != CZ_SAMPLE_INVALID;
}

void cz_replay_name(int sample, char name[CZ_REPLAY_SIZE]) {
    snprintf(name, CZ_REPLAY_SIZE, "replay/sample-%d.yaml", sample + 1);
}

/* The checks of which the sample is the worst, as a comment. */
static void write_reason(const CzSampling *sampling, int sample, FILE *stream) {
    fprintf(stream, "# Sample %d of %d, seed %ld: the worst of these checks.\n", sample + 1,
            sampling->n_sample, sampling->seed);
    for (int c = 0; c < sampling->n_check; c++) {
        const CzSampledCheck *check = &sampling->check[c];
        char text[CZ_FIGURE_SIZE];
        if (check->margin.worst == sample)
            fprintf(stream, "#   %s, %s: margin %s\n", check->name, check->scenario,
                    cz_figure_margin(text, cz_sample_margin(sampling, sample, c)));
    }
}

bool cz_replay_is_settings(const CzSampling *sampling) {
    for (int d = 0; d < sampling->n_draw; d++)
        for (int i = 0; i < sampling->draw[d].n_path; i++) {
            const char *path = sampling->draw[d].path[i];
            if (sampling->draw[d].effect != CZ_DRAW_VALUE || strstr(path, ".vehicles.") != NULL ||
                strncmp(path, "scenario.", 9) == 0 || strncmp(path, "parts.*", 7) == 0)
                return false;
        }
    return true;
}

void cz_replay_write_command(const CzReport *report, int sample, FILE *stream) {
    const CzSampling *sampling = report->sampling;
    const CzReportOptions *options = cz_report_options_of(report);
    fprintf(stream, "crushzone check %s", cz_problem_file(sampling->problem));
    for (int i = 0; i < options->n_set; i++)
        fprintf(stream, " --set '%s'", options->set[i]);
    for (int d = 0; d < sampling->n_draw; d++)
        for (int i = 0; i < sampling->draw[d].n_path; i++) {
            char number[CZ_NUMBER_TEXT];
            fprintf(stream, " --set '%s=%s'", sampling->draw[d].path[i],
                    cz_number_print(number, cz_sample_value(sampling, sample, d)));
        }
}

void cz_replay_begin_scenarios(const CzProblem *problem, FILE *stream) {
    fputs("scenarios:\n", stream);
    if (cz_problem_n_scenario(problem) == 1) /* a file without scenarios has this one unwritten */
        fprintf(stream, "  - {name: %s}\n", cz_problem_scenario_name(problem, 0));
}

static void begin_scenario(const CzProblem *problem, int scenario, const char *name, FILE *stream) {
    fprintf(stream, "  - name: %s\n    like: %s\n    reserves: false\n    changes:\n", name,
            cz_problem_scenario_name(problem, scenario));
}

static void write_change(const CzCaseChange *change, FILE *stream) {
    static const char *const keys[] = {
        [CZ_CASE_VALUE] = "value", [CZ_CASE_FACTOR] = "factor", [CZ_CASE_ADD] = "add"};
    char number[CZ_NUMBER_TEXT];
    fputs("      - {path: ", stream);
    cz_overlay_write_text(change->path, stream);
    fprintf(stream, ", %s: %s}\n", keys[change->kind], cz_number_print(number, change->number));
}

void cz_replay_write_case(const CzProblem *problem, const CzCase *of, FILE *stream) {
    begin_scenario(problem, of->scenario, of->name, stream);
    for (int i = 0; i < of->n_change; i++)
        write_change(&of->change[i], stream);
}

void cz_replay_write_scenario(const CzProblem *problem, int scenario, const char *name, int n_draw,
                              const CzDraw *draw, const double *value, FILE *stream) {
    begin_scenario(problem, scenario, name, stream);
    for (int d = 0; d < n_draw; d++)
        for (int i = 0; i < draw[d].n_path; i++) {
            const CzCaseChange change = cz_case_change(&draw[d], i, value[d]);
            write_change(&change, stream);
        }
}

void cz_replay_write(const CzReport *report, int sample, const char *folder, FILE *stream) {
    const CzSampling *sampling = report->sampling;
    const CzSamplingParts *parts = sampling->parts;
    const CzProblem *problem = sampling->problem;
    write_reason(sampling, sample, stream);
    if (cz_replay_is_settings(sampling)) {
        fputs("# With the reserves of the design: ", stream);
        cz_replay_write_command(report, sample, stream);
        fputc('\n', stream);
    }
    cz_overlay_write_base(report, problem, folder, "../", stream);
    cz_replay_begin_scenarios(problem, stream);
    for (int j = 0; j < parts->cases.n_scenario; j++) {
        char name[CZ_NAME_SIZE];
        cz_case_name(&parts->cases, j, sample, name);
        cz_replay_write_scenario(
            problem, parts->cases.scenario[j], name, sampling->n_draw, sampling->draw,
            sampling->value + (size_t)sample * (size_t)sampling->n_draw, stream);
    }
}
