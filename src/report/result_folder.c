/* The files of a result folder: summary and checks on top, histories per scenario. */
#include "crushzone/report.h"

#include "base/error.h"
#include "text/node.h"
#include "problem/problem.h"
#include "report/csv.h"
#include "report/folder.h"
#include "report/overlay.h"
#include "report/page.h"
#include "report/runs.h"

#include <string.h>

/* Everything that the files are made of. `outcome` and `evaluator` are NULL for a run. */
typedef struct Results {
    const CzProblem *problem;
    const CzEvaluator *evaluator;
    const CzOutcome *outcome;
    const CzEvaluation *evaluation;
    const CzReportOptions *options;
    const CzProblem *computed; /* what the runs were computed from: of a search, the problem with
                                  the best values; NULL when it cannot be read again */
    int scenario;              /* at hand */
    bool has_report;           /* the figures' problem could be read */
    bool is_top;               /* its files are at the top of the folder */
    const CzRun *run;          /* of the scenario at hand */
    const char *folder;        /* final path */
    const CzSource *input;     /* file to copy, at hand */
} Results;

typedef CzStatus (*Writer)(const Results *results, FILE *stream, CzError *error);

static CzStatus write_summary(const Results *results, FILE *stream, CzError *error) {
    return cz_report_write_summary(results->problem, results->evaluation, results->options, stream,
                                   error);
}

static CzStatus write_outcome(const Results *results, FILE *stream, CzError *error) {
    return cz_report_write_outcome(results->problem, results->evaluator, results->outcome,
                                   results->options, stream, error);
}

static CzStatus write_overlay(const Results *results, FILE *stream, CzError *error) {
    return cz_report_write_overlay(results->problem, results->evaluator, results->outcome,
                                   results->options, results->folder, stream, error);
}

static CzStatus write_checks(const Results *results, FILE *stream, CzError *error) {
    (void)error; /* a full disk shows when the file is closed */
    cz_csv_write_checks(results->evaluation, results->options, stream);
    return CZ_OK;
}

static CzStatus write_history(const Results *results, FILE *stream, CzError *error) {
    (void)error;
    cz_csv_write_history(results->evaluator, results->outcome, results->options, stream);
    return CZ_OK;
}

static CzStatus write_interfaces(const Results *results, FILE *stream, CzError *error) {
    (void)error;
    cz_csv_write_interfaces(cz_run_summary(results->run), results->options, stream);
    return CZ_OK;
}

static CzStatus write_channels(const Results *results, FILE *stream, CzError *error) {
    (void)error;
    cz_csv_write_channels(results->run, results->options, stream);
    return CZ_OK;
}

/* The problem that gives these results when it is run alone: of a search, with the best values. */
static CzStatus write_resolved(const Results *results, FILE *stream, CzError *error) {
    if (results->outcome == NULL) {
        return cz_problem_write_resolved_there(results->problem, stream, error);
    }
    return cz_overlay_write_resolved(results->problem, results->evaluator, results->outcome,
                                     results->options, stream, error);
}

/* A file as it was read, so that the folder runs by itself wherever it is. */
static CzStatus write_input(const Results *results, FILE *stream, CzError *error) {
    (void)error;
    for (int i = 0; i < results->input->n_line; i++)
        fprintf(stream, "%s\n", results->input->line[i]);
    return CZ_OK;
}

static void write_notice(const CzError *notice, FILE *stream) {
    if (notice->file[0] != '\0')
        fprintf(stream, "%s:%d:%d: ", notice->file, notice->line, notice->column);
    fprintf(stream, "warning: %s\n", notice->message);
    if (notice->help[0] != '\0')
        fprintf(stream, "  help: %s\n", notice->help);
}

/* What was done, without times: the log of the same run is the same. */
static CzStatus write_log(const Results *results, FILE *stream, CzError *error) {
    (void)error;
    char nlopt[32] = "";
    cz_nlopt_version(nlopt, sizeof nlopt);
    fprintf(stream, "crushzone %s, NLopt %s\n", cz_version(), nlopt);
    fprintf(stream, "problem %s (%s), hash %s\n", cz_problem_title(results->problem),
            cz_problem_file(results->problem), cz_problem_hash(results->problem));
    for (int i = 0; i < results->options->n_set; i++)
        fprintf(stream, "set %s\n", results->options->set[i]);
    for (int i = 0; i < cz_problem_n_warning(results->problem); i++)
        write_notice(cz_problem_warning(results->problem, i), stream);
    if (results->outcome != NULL)
        fprintf(stream, "optimise: %s after %ld evaluations: %s\n",
                cz_outcome_text(results->outcome->status), results->outcome->n_evaluation,
                results->outcome->why_stopped);
    const CzEvaluation *evaluation = results->evaluation;
    for (int i = 0; i < evaluation->n_run; i++) {
        const CzRunSummary *run = cz_kept_run(evaluation, i);
        if (run == NULL)
            continue;
        fprintf(stream, "scenario %s: %s, %ld steps, %s%s%s\n", run->scenario,
                run->status == CZ_OK ? "completed" : "FAILED", run->n_step,
                cz_ended_text(run->ended), run->failure[0] != '\0' ? ": " : "", run->failure);
    }
    fprintf(stream, "verdict: %s\n", cz_verdict_text(evaluation->verdict));
    return CZ_OK;
}

static CzStatus write_report(const Results *results, FILE *stream, CzError *error) {
    if (results->outcome != NULL && results->is_top)
        return cz_page_write_outcome(results->computed, results->evaluator, results->outcome,
                                     results->options, stream, error);
    return cz_page_write_run(results->computed, results->evaluation, results->scenario,
                             results->is_top, results->options, stream, error);
}

static CzStatus write_file(CzFolder *folder, const char *name, Writer writer,
                           const Results *results, CzError *error) {
    FILE *stream = NULL;
    CzStatus status = cz_folder_open(folder, name, &stream, error);
    if (status != CZ_OK)
        return status;
    status = writer(results, stream, error);
    /* What could not be written is reported with the name of the file. */
    const bool tells = status == CZ_OK || status == CZ_STATUS_OUTPUT;
    const CzStatus closed = cz_folder_close(folder, tells ? error : NULL);
    return status != CZ_OK ? status : closed;
}

static CzStatus write_run(CzFolder *folder, Results *results, int i, CzError *error) {
    const bool several = cz_n_kept_run(results->evaluation) > 1;
    char scenario[CZ_NAME_ROOM], name[CZ_NAME_ROOM + 32];
    results->scenario = i;
    results->is_top = false;
    results->run = results->evaluation->run[i];
    cz_page_folder_name(cz_run_summary(results->run)->scenario, scenario);
    snprintf(name, sizeof name, "%s%s%s", several ? scenario : "", several ? "/" : "",
             "interfaces.csv");
    CzStatus status = write_file(folder, name, write_interfaces, results, error);
    snprintf(name, sizeof name, "%s%s%s", several ? scenario : "", several ? "/" : "",
             "channels.csv");
    if (status == CZ_OK)
        status = write_file(folder, name, write_channels, results, error);
    snprintf(name, sizeof name, "%s/report.html", scenario);
    return status == CZ_OK && several && results->has_report
               ? write_file(folder, name, write_report, results, error)
               : status;
}

/* Profiles are in the folder as they are searched for beside a problem file. */
static CzStatus write_profiles(CzFolder *folder, Results *results, CzError *error) {
    CzStatus status = CZ_OK;
    for (const CzSource *source = cz_problem_first_source(results->problem);
         source != NULL && status == CZ_OK; source = source->next) {
        const char *file = strrchr(source->name, '/');
        char name[160];
        static const char above[] = "profiles";
        const size_t n = sizeof above - 1;
        if (file == NULL || (size_t)(file - source->name) < n || strncmp(file - n, above, n) != 0)
            continue;
        snprintf(name, sizeof name, "%s%.140s", above, file);
        results->input = source;
        status = write_file(folder, name, write_input, results, error);
    }
    return status;
}

/* Time histories that a fit follows, as resolved.yaml names them. */
static CzStatus write_measured(CzFolder *folder, Results *results, CzError *error) {
    CzStatus status = CZ_OK;
    char name[256];
    for (int number = 1; status == CZ_OK; number++) {
        results->input = cz_problem_measured_file(results->problem, number, sizeof name, name);
        if (results->input == NULL)
            break;
        status = write_file(folder, name, write_input, results, error);
    }
    return status;
}

static CzStatus write_all(CzFolder *folder, Results *results, CzError *error) {
    static const struct {
        const char *name;
        Writer writer;
        bool of_search;
    } files[] = {
        {"summary.json", write_summary, false},   {"checks.csv", write_checks, false},
        {"resolved.yaml", write_resolved, false}, {"run.log", write_log, false},
        {"outcome.json", write_outcome, true},    {"optimised.yaml", write_overlay, true},
        {"history.csv", write_history, true},
    };
    CzStatus status = CZ_OK;
    for (size_t i = 0; i < sizeof files / sizeof *files && status == CZ_OK; i++)
        if (!files[i].of_search || results->outcome != NULL)
            status = write_file(folder, files[i].name, files[i].writer, results, error);
    if (status == CZ_OK)
        status = write_profiles(folder, results, error);
    if (status == CZ_OK)
        status = write_measured(folder, results, error);
    for (int i = 0; i < results->evaluation->n_run && status == CZ_OK; i++)
        if (cz_kept_run(results->evaluation, i) != NULL)
            status = write_run(folder, results, i, error);
    results->scenario = cz_page_deciding(results->evaluation);
    results->is_top = true;
    if (status == CZ_OK && results->scenario >= 0 && results->has_report)
        status = write_file(folder, "report.html", write_report, results, error);
    return status;
}

static CzStatus write_folder(Results *results, CzError *error) {
    CzFolder folder;
    CzStatus status =
        cz_folder_begin(&folder, results->folder, results->options->replaces_search, error);
    if (status != CZ_OK)
        return status;
    status = write_all(&folder, results, error);
    if (status == CZ_OK)
        return cz_folder_finish(&folder, error);
    cz_folder_abandon(&folder);
    return status;
}

CzStatus cz_report_check_folder(const CzProblem *problem, const char *folder,
                                const CzReportOptions *options, CzError *error) {
    CZ_TRY(cz_folder_check(folder, options != NULL && options->replaces_search, error));
    const CzSource *source = problem != NULL ? cz_problem_first_source(problem) : NULL;
    for (; source != NULL; source = source->next)
        if (cz_folder_holds(folder, source->name))
            return cz_fail(error, CZ_STATUS_OUTPUT,
                           "the result folder %.150s holds %.150s, which this problem is read from "
                           "and which would be replaced with it; choose another folder with -o",
                           folder, source->name);
    return CZ_OK;
}

CzStatus cz_report_write_folder(const CzProblem *problem, const CzEvaluation *evaluation,
                                const CzReportOptions *options, const char *folder,
                                CzError *error) {
    const CzReportOptions absent = cz_report_options_default();
    Results results = {.problem = problem,
                       .computed = problem,
                       .has_report = true,
                       .evaluation = evaluation,
                       .options = options != NULL ? options : &absent,
                       .folder = folder};
    return write_folder(&results, error);
}

CzStatus cz_report_write_outcome_folder(const CzProblem *problem, const CzEvaluator *evaluator,
                                        const CzOutcome *outcome, const CzReportOptions *options,
                                        const char *folder, CzError *error) {
    CzReportOptions own = options != NULL ? *options : cz_report_options_default();
    own.replaces_search = true; /* a search replaces a search */
    Results results = {.problem = problem,
                       .evaluator = evaluator,
                       .outcome = outcome,
                       .evaluation = &outcome->best_evaluation,
                       .options = &own,
                       .folder = folder};
    CzProblem *best = NULL;
    CzError mistake = {0}; /* such as a file that has changed meanwhile: then there is no report */
    const CzStatus read =
        cz_overlay_read_best(problem, evaluator, outcome, results.options, &best, &mistake);
    results.has_report = read == CZ_OK;
    results.computed = best;
    const CzStatus status = write_folder(&results, error);
    cz_problem_free(best);
    if (status == CZ_OK &&
        read == CZ_STATUS_NO_MEMORY) /* the best design is kept, and it is reported */
        return cz_fail(error, read,
                       "no memory for the report of %.300s; crushzone report %.100s "
                       "writes it",
                       folder, folder);
    return status;
}
