/* The JSON documents: the record of each, and the results that it is written from. */
#include "crushzone/report.h"

#include "base/error.h"
#include "base/memory_text.h"
#include "report/options.h"
#include "report/results.h"

#include <stdlib.h>

const CzRecord cz_document_records[CZ_N_REPORT] = {
    [CZ_REPORT_RUN] = CZ_RECORD_SUMMARY,
    [CZ_REPORT_SEARCH] = CZ_RECORD_OUTCOME,
    [CZ_REPORT_SWEEP] = CZ_RECORD_SWEEP,
    [CZ_REPORT_SAMPLE] = CZ_RECORD_SAMPLE,
    [CZ_REPORT_PARETO] = CZ_RECORD_PARETO,
    [CZ_REPORT_CHALLENGE] = CZ_RECORD_CHALLENGE,
    [CZ_REPORT_CORRIDOR] = CZ_RECORD_CORRIDOR,
    [CZ_REPORT_VERIFICATION] = CZ_RECORD_VERIFICATION,
    [CZ_REPORT_BENCHMARK] = CZ_RECORD_BENCHMARK,
    [CZ_REPORT_EXPLANATION] = CZ_RECORD_EXPLANATION,
    [CZ_REPORT_COMPARISON] = CZ_RECORD_COMPARISON,
    [CZ_REPORT_FIT] = CZ_RECORD_FIT,
    [CZ_REPORT_MISTAKES] = CZ_RECORD_MISTAKES,
    [CZ_REPORT_ANSWER] = CZ_RECORD_ANSWER};

/* The YAML text of a law, to be freed; NULL without memory. */
static char *yaml_of(const CzFit *fit) {
    CzMemoryText memory = {0};
    FILE *stream = cz_memory_text_open(&memory);
    if (stream != NULL)
        cz_fit_write_yaml(fit, stream);
    if (stream != NULL && fclose(stream) == 0 && !memory.failed)
        return memory.text;
    cz_memory_text_free(&memory);
    return NULL;
}

/* The YAML of a refused law is left out. */
static CzStatus write_fit(const CzFit *fit, CzResultContext *context, FILE *stream,
                          CzError *error) {
    const CzFitSummary *summary = cz_fit_summary(fit);
    const bool is_written = summary->verdict != CZ_FIT_REFUSED;
    char *yaml = is_written ? yaml_of(fit) : NULL;
    context->yaml = yaml;
    CzStatus status = cz_results_write(CZ_RECORD_FIT, context, summary, stream, error);
    if (status == CZ_OK && is_written && yaml == NULL)
        status = cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for a JSON document");
    free(yaml);
    return status;
}

void cz_report_write_answer(const CzReport *report, FILE *stream) {
    CzResultContext context = {
        .report = report, .problem = report->problem, .evaluation = report->reply->evaluation};
    cz_results_write_line(CZ_RECORD_ANSWER, &context, report->reply, stream);
}

CzStatus cz_report_write_json(const CzReport *report, FILE *stream, CzError *error) {
    const CzReportOptions *options = cz_report_options_of(report);
    const CzVerification *verification = report->verification;
    const CzExplanation *explanation = report->explanation;
    int order[CZ_N_BUDGET];
    CzResultContext context = {.report = report,
                               .problem = report->problem,
                               .options = options,
                               .evaluation = report->evaluation,
                               .wall_s = options->wall_s};
    const void *data = report;
    snprintf(context.format, sizeof context.format, "crushzone.%s",
             cz_report_document_name((int)report->kind));
    switch (report->kind) {
    case CZ_REPORT_RUN:
        data = report->evaluation;
        break;
    case CZ_REPORT_SEARCH:
        context.evaluation = &report->outcome->best_evaluation;
        context.wall_s = report->outcome->wall_s;
        data = report->outcome;
        break;
    case CZ_REPORT_SWEEP:
        context.problem = report->sweep->problem;
        context.wall_s = report->sweep->wall_s;
        data = report->sweep;
        break;
    case CZ_REPORT_SAMPLE:
        context.problem = report->sampling->problem;
        context.wall_s = report->sampling->wall_s;
        data = report->sampling;
        break;
    case CZ_REPORT_CORRIDOR:
        context.problem = report->corridor->problem;
        context.wall_s = report->corridor->wall_s;
        data = report->corridor;
        break;
    case CZ_REPORT_PARETO:
        context.wall_s = report->pareto->wall_s;
        data = report->pareto;
        break;
    case CZ_REPORT_CHALLENGE:
        context.problem = report->challenge->problem;
        context.wall_s = report->challenge->wall_s;
        data = report->challenge;
        break;
    case CZ_REPORT_VERIFICATION:
        context.wall_s = verification->wall_s;
        data = verification;
        break;
    case CZ_REPORT_BENCHMARK:
        context.wall_s = report->benchmark->wall_s;
        data = report->benchmark;
        break;
    case CZ_REPORT_EXPLANATION:
        context.run = explanation->run != NULL ? cz_run_summary(explanation->run) : NULL;
        context.wall_s = explanation->wall_s;
        context.order = order;
        if (context.run != NULL && context.run->budget != NULL)
            context.n_order = cz_budget_order(&context.run->budget[explanation->vehicle], order);
        data = explanation;
        break;
    case CZ_REPORT_FIT:
        return write_fit(report->fit, &context, stream, error);
    case CZ_REPORT_ANSWER:
        cz_report_write_answer(report, stream);
        fputc('\n', stream);
        return fflush(stream) == 0 && !ferror(stream)
                   ? CZ_OK
                   : cz_fail(error, CZ_STATUS_OUTPUT, "the answer cannot be written");
    case CZ_REPORT_COMPARISON:
    case CZ_REPORT_MISTAKES:
    case CZ_N_REPORT:
        break;
    }
    return cz_results_write(cz_document_records[report->kind], &context, data, stream, error);
}
