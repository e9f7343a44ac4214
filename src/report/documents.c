/* The JSON documents: the record of each, and the results that it is written from. */
#include "crushzone/report.h"

#include "base/error.h"
#include "base/memory_text.h"
#include "report/compare.h"
#include "report/results.h"

#include <math.h>
#include <stdlib.h>

CzStatus cz_report_write_summary(const CzProblem *problem, const CzEvaluation *evaluation,
                                 const CzReportOptions *options, FILE *stream, CzError *error) {
    CzResultContext context = {.format = "crushzone.summary",
                               .problem = problem,
                               .options = options,
                               .evaluation = evaluation,
                               .wall_s = options != NULL ? options->wall_s : NAN};
    return cz_results_write(CZ_RECORD_SUMMARY, &context, evaluation, stream, error);
}

CzStatus cz_report_write_outcome(const CzProblem *problem, const CzEvaluator *evaluator,
                                 const CzOutcome *outcome, const CzReportOptions *options,
                                 FILE *stream, CzError *error) {
    CzResultContext context = {.format = "crushzone.outcome",
                               .problem = problem,
                               .options = options,
                               .evaluation = &outcome->best_evaluation,
                               .evaluator = evaluator,
                               .outcome = outcome,
                               .verification = outcome->verification,
                               .wall_s = outcome->wall_s};
    return cz_results_write(CZ_RECORD_OUTCOME, &context, outcome, stream, error);
}

CzStatus cz_report_write_verification(const CzProblem *problem, const CzVerification *verification,
                                      const CzReportOptions *options, FILE *stream,
                                      CzError *error) {
    CzResultContext context = {.format = "crushzone.verification",
                               .problem = problem,
                               .options = options,
                               .verification = verification};
    for (int method = 0; method < CZ_N_VERIFY_METHOD; method++)
        context.wall_s += verification->wall_s[method];
    return cz_results_write(CZ_RECORD_VERIFICATION, &context, verification, stream, error);
}

CzStatus cz_report_write_benchmark(const CzProblem *problem, const CzBenchmark *benchmark,
                                   const CzReportOptions *options, FILE *stream, CzError *error) {
    CzResultContext context = {.format = "crushzone.benchmark",
                               .problem = problem,
                               .options = options,
                               .wall_s = benchmark->wall_s};
    return cz_results_write(CZ_RECORD_BENCHMARK, &context, benchmark, stream, error);
}

CzStatus cz_report_write_sweep(const CzSweep *sweep, const CzReportOptions *options, FILE *stream,
                               CzError *error) {
    CzResultContext context = {.format = "crushzone.sweep",
                               .problem = sweep->problem,
                               .options = options,
                               .sweep = sweep,
                               .wall_s = sweep->wall_s};
    return cz_results_write(CZ_RECORD_SWEEP, &context, sweep, stream, error);
}

CzStatus cz_report_write_explanation(const CzProblem *problem, const CzExplanation *explanation,
                                     const CzReportOptions *options, FILE *stream, CzError *error) {
    const CzRunSummary *run = cz_run_summary(explanation->run);
    int order[CZ_N_BUDGET];
    CzResultContext context = {.format = "crushzone.explanation",
                               .problem = problem,
                               .options = options,
                               .explanation = explanation,
                               .run = run,
                               .order = order,
                               .wall_s = explanation->wall_s};
    if (run->budget != NULL)
        context.n_order = cz_budget_order(&run->budget[explanation->vehicle], order);
    return cz_results_write(CZ_RECORD_EXPLANATION, &context, explanation, stream, error);
}

CzStatus cz_report_write_comparison_json(int n, const CzReportRun *run, FILE *stream,
                                         CzError *error) {
    CzResultContext context = {.format = "crushzone.comparison",
                               .n_compared = n < CZ_MOST_COMPARED ? n : CZ_MOST_COMPARED,
                               .compared = run};
    return cz_results_write(CZ_RECORD_COMPARISON, &context, &context, stream, error);
}

CzStatus cz_report_write_mistakes(int n_mistake, const CzError *const *mistake, FILE *stream,
                                  CzError *error) {
    CzResultContext context = {.n_mistake = n_mistake, .mistake = mistake};
    return cz_results_write(CZ_RECORD_MISTAKES, &context, &context, stream, error);
}

/* The YAML text, to be freed; NULL without memory. */
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

CzStatus cz_report_write_fit(const CzFit *fit, FILE *stream, CzError *error) {
    const bool is_written = cz_fit_summary(fit)->verdict != CZ_FIT_REFUSED;
    char *yaml = is_written ? yaml_of(fit) : NULL;
    CzResultContext context = {.format = "crushzone.fit", .fit = fit, .yaml = yaml};
    const bool has_memory = yaml != NULL || !is_written;
    const CzStatus status =
        cz_results_write(CZ_RECORD_FIT, &context, cz_fit_summary(fit), stream, error);
    free(yaml);
    return has_memory || status != CZ_OK
               ? status
               : cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for a JSON document");
}
