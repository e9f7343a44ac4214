/* The results of a problem as text: the summary of its scenarios, or of its search, without times
 * and paths; or the refusal of the reader. */
#ifndef CZ_TESTS_PROBLEM_ANSWER_H
#define CZ_TESTS_PROBLEM_ANSWER_H

#include "support/check.h"

#include "base/error.h"
#include "crushzone/evaluate.h"
#include "crushzone/optimise.h"
#include "crushzone/report.h"

typedef struct {
    char *text; /* the summary without run_info; NULL when the reader refuses */
    char refusal[512];
    int n_warning;
    char warnings[65536];
} Answer;

static inline void answer_free(Answer *answer) {
    free(answer->text);
    answer->text = NULL;
}

/* Removes everything from one text up to another. */
static void cut(char *text, const char *from, const char *to) {
    for (char *at = strstr(text, from); at != NULL; at = strstr(at, from)) {
        const char *end = strstr(at + strlen(from), to);
        assert_non_null(end);
        memmove(at, end, strlen(end) + 1);
    }
}

/* The document of a search where there is one. */
static CzStatus write_answer(const CzProblem *problem, CzEvaluator *evaluator,
                             const CzEvaluation *evaluation, FILE *stream, CzError *error) {
    CzReport report = {.kind = CZ_REPORT_RUN, .problem = problem, .evaluation = evaluation};
    if (cz_evaluator_n_variable(evaluator) == 0)
        return cz_report_write_json(&report, stream, error);
    CzOptimiseOptions options = cz_optimise_options_default();
    CzOutcome *outcome = NULL;
    CZ_TRY(cz_optimise(evaluator, &options, &outcome, error));
    report.kind = CZ_REPORT_SEARCH;
    report.evaluator = evaluator;
    report.outcome = outcome;
    const CzStatus status = cz_report_write_json(&report, stream, error);
    cz_outcome_free(outcome);
    return status;
}

static char *summary_of(const CzProblem *problem, const char *scenario) {
    CzEvaluator *evaluator = NULL;
    CzEvaluation evaluation;
    CzError error = {0};
    CzEvaluatorOptions options = cz_evaluator_options_default();
    options.n_job = 1;
    char *text = NULL;
    size_t n = 0;
    if (cz_evaluator_build(problem, &options, &evaluator, &error) != CZ_OK)
        return NULL;
    const int n_scenario = scenario != NULL; /* 0: all of them */
    if (cz_evaluator_set_scenarios(evaluator, n_scenario, &scenario, &error) == CZ_OK &&
        cz_evaluate(evaluator, 1, NULL, true, &evaluation, &error) == CZ_OK) {
        FILE *stream = open_memstream(&text, &n);
        assert_non_null(stream);
        const CzStatus status = write_answer(problem, evaluator, &evaluation, stream, &error);
        fclose(stream);
        if (status != CZ_OK)
            text[0] = '\0'; /* refused */
        cut(text, "\"run_info\"", "}");
        cut(text, "\"hash\"", "\n");
        cut(text, "\"warnings\"", "]");
        cz_evaluation_free(&evaluation);
    }
    cz_evaluator_free(evaluator);
    return text;
}

/* The answer of all scenarios, or of one alone. */
static Answer answer_in(const char *text, const char *scenario) {
    Answer answer = {0};
    CzProblem *problem = NULL;
    CzError error = {0};
    CzProblemOptions options = cz_problem_options_default();
    options.share_folder = "problems";
    const CzStatus status =
        cz_problem_read_text(text, strlen(text), "key.yaml", ".", &options, &problem, &error);
    answer.n_warning = status == CZ_OK ? cz_problem_n_warning(problem) : 0;
    for (int i = 0; i < answer.n_warning; i++) {
        const size_t n = strlen(answer.warnings);
        snprintf(answer.warnings + n, sizeof answer.warnings - n, "%s\n",
                 cz_problem_warning(problem, i)->message);
    }
    if (status == CZ_OK)
        answer.text = summary_of(problem, scenario);
    if (answer.text == NULL)
        snprintf(answer.refusal, sizeof answer.refusal, "%s", error.message);
    cz_problem_free(problem);
    return answer;
}

static Answer answer_of(const char *text) {
    return answer_in(text, NULL);
}

#endif
