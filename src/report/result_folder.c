/* The files of a result folder: summary and checks at the top, histories per scenario; of a sweep,
 * its points; of a sampling, its samples; of a front, its points and their designs; of a challenge,
 * its points and counter-examples; of a corridor, its edges. */
#include "crushzone/report.h"

#include "base/error.h"
#include "evaluate/deciding_run.h"
#include "evaluate/not_covered.h"
#include "optimise/robust_cases.h"
#include "problem/problem.h"
#include "report/challenge_files.h"
#include "report/csv.h"
#include "report/folder.h"
#include "report/iso_mme_folder.h"
#include "report/verdict_words.h"
#include "report/options.h"
#include "report/overlay.h"
#include "report/page.h"
#include "report/page_challenge.h"
#include "report/page_corridor.h"
#include "report/page_sample.h"
#include "report/page_pareto.h"
#include "report/page_sweep.h"
#include "report/runs.h"
#include "report/sample_replay.h"
#include "report/shard.h"
#include "report/temporary.h"
#include "text/node.h"

#include <errno.h>
#include <string.h>

/* Everything from which the files are written. */
typedef struct Results {
    const CzReport *report;
    CzReport run;              /* of a search, the run of its best design */
    const CzProblem *computed; /* problem of the runs: for a search the one with the best values;
                                  NULL when it cannot be read again */
    int scenario;              /* of the file that is written */
    bool is_top;               /* its files are at the top of the folder */
    const char *folder;        /* final path */
    const CzSource *input;     /* the file that is copied */
    int sample;                /* the sample that is written */
    int point;                 /* of a front, whose design is written */
} Results;

typedef enum Content {
    SUMMARY,
    CHECKS,
    RESOLVED,
    RUN_LOG,
    OUTCOME,
    OVERLAY,
    HISTORY,
    JOURNAL,
    INTERFACES,
    CHANNELS,
    INPUT_FILE,
    REPORT,
    SWEEP,
    SWEEP_POINTS,
    SWEEP_REPORT,
    SAMPLE,
    SAMPLES,
    SAMPLE_REPORT,
    SHARD,
    REPLAY,
    CORRIDOR,
    CORRIDOR_POINTS,
    CORRIDOR_REPORT,
    CORRIDOR_FIGURE,
    PARETO,
    PARETO_POINTS,
    PARETO_REPORT,
    FRONT,
    POINT,
    CHALLENGE,
    CHALLENGE_POINTS,
    CHALLENGE_REPORT,
    COUNTER_EXAMPLE,
    COUNTER_EXAMPLES,
    ADDED_SCENARIOS
} Content;

typedef struct File {
    const char *name;
    Content content;
} File;

static void write_notice(const CzError *notice, FILE *stream) {
    if (notice->file[0] != '\0')
        fprintf(stream, "%s:%d:%d: ", notice->file, notice->line, notice->column);
    fprintf(stream, "warning: %s\n", notice->message);
    if (notice->help[0] != '\0')
        fprintf(stream, "  help: %s\n", notice->help);
}

/* The log of the run, without times, so that equal runs have equal logs. */
static void write_log(const Results *results, FILE *stream) {
    const CzProblem *problem = results->run.problem;
    const CzReportOptions *options = cz_report_options_of(results->report);
    const CzOutcome *outcome = results->report->outcome;
    char nlopt[32] = "";
    cz_nlopt_version(nlopt, sizeof nlopt);
    fprintf(stream, "crushzone %s, NLopt %s\n", cz_version(), nlopt);
    fprintf(stream, "problem %s (%s), hash %s\n", cz_problem_title(problem),
            cz_problem_file(problem), cz_problem_hash(problem));
    for (int i = 0; i < options->n_set; i++)
        fprintf(stream, "set %s\n", options->set[i]);
    for (int i = 0; i < cz_problem_n_warning(problem); i++)
        write_notice(cz_problem_warning(problem, i), stream);
    if (outcome != NULL)
        fprintf(stream, "optimise: %s after %ld evaluations: %s\n",
                cz_outcome_text(outcome->status), outcome->n_evaluation, outcome->why_stopped);
    const CzEvaluation *evaluation = results->run.evaluation;
    for (int i = 0; i < evaluation->n_run; i++) {
        const CzRunSummary *run = cz_kept_run(evaluation, i);
        if (run == NULL)
            continue;
        fprintf(stream, "scenario %s: %s, %ld steps, %s%s%s\n", run->scenario,
                run->status == CZ_OK ? "completed" : "FAILED", run->n_step,
                cz_ended_text(run->ended), run->failure[0] != '\0' ? ": " : "", run->failure);
    }
    char remark[CZ_SCREENING_SIZE];
    fprintf(stream, "verdict: %s%s\n", cz_verdict_text(evaluation->verdict),
            cz_screening_remark(evaluation->verdict, evaluation->n_not_covered, remark));
}

/* A copy of a file that was read, so that the folder can be moved and run again. */
static void write_input(const CzSource *input, FILE *stream) {
    for (int i = 0; i < input->n_line; i++)
        fprintf(stream, "%s\n", input->line[i]);
}

/* Copies the journal of the search. */
static CzStatus write_journal(const CzReport *report, FILE *stream, CzError *error) {
    const char *path = cz_report_options_of(report)->journal;
    char block[1 << 14];
    FILE *journal = fopen(path, "r");
    if (journal == NULL)
        return cz_cannot_write(path, errno, error);
    for (size_t n; (n = fread(block, 1, sizeof block, journal)) > 0;)
        (void)fwrite(block, 1, n, stream);
    const bool is_read = ferror(journal) == 0;
    fclose(journal);
    return is_read ? CZ_OK : cz_fail(error, CZ_STATUS_OUTPUT, "%.300s cannot be read", path);
}

/* The design of a point of a front, as changes to the file. */
static CzStatus write_point(const Results *results, FILE *stream, CzError *error) {
    const CzPareto *pareto = results->report->pareto;
    const CzParetoPoint *point = &pareto->point[results->point];
    CzOutcome outcome = {.n_variable = pareto->n_variable, .best = point->x};
    CzReport report = *results->report;
    report.outcome = &outcome;
    report.evaluator = pareto->evaluator;
    int n_not_covered;
    cz_not_covered(report.problem, &n_not_covered);
    fprintf(stream, "# Point %d of %d: %s. Verdict of its checks: %s.\n", results->point + 1,
            pareto->n_point,
            point->violation <= 0 ? cz_pareto_state_text(point->state) : "IT VIOLATES A CONSTRAINT",
            cz_verdict_words(point->verdict, n_not_covered));
    return cz_overlay_write_design(&report, results->folder, stream, error);
}

/* The best design of a search against scatter with the scenarios that it had in the end. */
static void write_added(const CzRobust *robust, FILE *stream) {
    fputs("# The best design with the scenarios that the search added: samples at the required\n"
          "# statistics, and weak points.\n"
          "extends: optimised.yaml\n",
          stream);
    cz_replay_begin_scenarios(robust->designed, stream);
    for (int i = 0; i < robust->added->n; i++)
        cz_replay_write_case(robust->problem, &robust->added->list[i], stream);
}

static CzStatus write_report(const Results *results, FILE *stream, CzError *error) {
    const bool is_search = results->report->outcome != NULL && results->is_top;
    CzReport report = is_search ? *results->report : results->run;
    report.problem = results->computed;
    return is_search
               ? cz_page_write_outcome(&report, stream, error)
               : cz_page_write_run(&report, results->scenario, results->is_top, stream, error);
}

/* Writes what a file contains; a full disk shows when the file is closed. */
static CzStatus write_content(const Results *results, Content content, FILE *stream,
                              CzError *error) {
    const CzReport *report = results->report;
    const CzReportOptions *options = cz_report_options_of(report);
    const CzEvaluation *evaluation = results->run.evaluation;
    switch (content) {
    case SUMMARY:
        return cz_report_write_json(&results->run, stream, error);
    case OUTCOME:
    case SWEEP:
    case SAMPLE:
    case CORRIDOR:
    case PARETO:
    case CHALLENGE:
        return cz_report_write_json(report, stream, error);
    case OVERLAY:
        return cz_overlay_write(report, results->folder, stream, error);
    case RESOLVED: /* the problem that gives these results when it is run alone */
        if (report->outcome != NULL)
            return cz_overlay_write_resolved(report, stream, error);
        cz_problem_write_resolved_in_folder(report->problem, stream);
        return CZ_OK;
    case REPORT:
        return write_report(results, stream, error);
    case SWEEP_REPORT:
        return cz_page_write_sweep(report->sweep, stream, error);
    case SAMPLE_REPORT:
        return cz_page_write_sample(report, stream, error);
    case REPLAY:
        cz_replay_write(report, results->sample, results->folder, stream);
        break;
    case CHALLENGE_REPORT:
        return cz_page_write_challenge(report, stream, error);
    case COUNTER_EXAMPLE:
    case COUNTER_EXAMPLES:
        cz_challenge_write_file(report, content == COUNTER_EXAMPLES, results->folder, stream);
        break;
    case ADDED_SCENARIOS:
        write_added(report->robust, stream);
        break;
    case CHALLENGE_POINTS:
        cz_csv_write_challenge(report, stream);
        break;
    case SAMPLES:
        cz_csv_write_samples(report, stream);
        break;
    case SHARD:
        cz_shard_write(report, stream);
        break;
    case CORRIDOR_REPORT:
        return cz_page_write_corridor(report, stream, error);
    case CORRIDOR_FIGURE:
        return cz_report_write_corridor(report->corridor, stream, error);
    case CORRIDOR_POINTS:
        cz_csv_write_corridor(report, stream);
        break;
    case PARETO_REPORT:
        return cz_page_write_pareto(report->pareto, report->problem, stream, error);
    case FRONT:
        return cz_report_write_front(report->pareto, stream, error);
    case POINT:
        return write_point(results, stream, error);
    case PARETO_POINTS:
        cz_csv_write_pareto(report, stream);
        break;
    case SWEEP_POINTS:
        cz_csv_write_sweep(report, stream);
        break;
    case CHECKS:
        cz_csv_write_checks(evaluation, options, stream);
        break;
    case HISTORY:
        cz_csv_write_history(report, stream);
        break;
    case JOURNAL:
        return write_journal(report, stream, error);
    case INTERFACES:
        cz_csv_write_interfaces(cz_kept_run(evaluation, results->scenario), options, stream);
        break;
    case CHANNELS:
        cz_csv_write_channels(evaluation->run[results->scenario], options, stream);
        break;
    case RUN_LOG:
        write_log(results, stream);
        break;
    case INPUT_FILE:
        write_input(results->input, stream);
        break;
    }
    return CZ_OK;
}

static CzStatus write_file(CzFolder *folder, const char *name, Content content,
                           const Results *results, CzError *error) {
    FILE *stream = NULL;
    CZ_TRY(cz_folder_open(folder, name, &stream, error));
    const CzStatus status = write_content(results, content, stream, error);
    /* A failure of writing is reported with the name of the file. */
    const bool reports = status == CZ_OK || status == CZ_STATUS_OUTPUT;
    const CzStatus closed = cz_folder_close(folder, reports ? error : NULL);
    return status != CZ_OK ? status : closed;
}

static CzStatus write_files(CzFolder *folder, int n, const File *file, const Results *results,
                            CzError *error) {
    for (int i = 0; i < n; i++)
        CZ_TRY(write_file(folder, file[i].name, file[i].content, results, error));
    return CZ_OK;
}

/* The files of a scenario, in a folder of its own where there are several. */
static CzStatus write_run(CzFolder *folder, Results *results, int i, CzError *error) {
    static const File files[] = {
        {"interfaces.csv", INTERFACES}, {"channels.csv", CHANNELS}, {"report.html", REPORT}};
    const bool several = cz_n_kept_run(results->run.evaluation) > 1;
    char scenario[CZ_NAME_SIZE], name[CZ_NAME_SIZE + 32];
    results->scenario = i;
    results->is_top = false;
    cz_page_folder_name(cz_kept_run(results->run.evaluation, i)->scenario, scenario);
    for (int k = 0; k < (several && results->computed != NULL ? 3 : 2); k++) {
        snprintf(name, sizeof name, "%s%s%s", several ? scenario : "", several ? "/" : "",
                 files[k].name);
        CZ_TRY(write_file(folder, name, files[k].content, results, error));
    }
    snprintf(name, sizeof name, "%s%s", several ? scenario : "", several ? "/" : "");
    return cz_report_options_of(results->report)->iso_mme
               ? cz_iso_mme_write_folder(folder, &results->run, i, name, error)
               : CZ_OK;
}

/* Writes profiles to the subfolder in which they are searched next to a problem file. */
static CzStatus write_profiles(CzFolder *folder, Results *results, CzError *error) {
    for (const CzSource *source = cz_problem_first_source(results->run.problem); source != NULL;
         source = source->next) {
        const char *file = strrchr(source->name, '/');
        char name[160];
        static const char above[] = "profiles";
        const size_t n = sizeof above - 1;
        if (file == NULL || (size_t)(file - source->name) < n || strncmp(file - n, above, n) != 0)
            continue;
        snprintf(name, sizeof name, "%s%.140s", above, file);
        results->input = source;
        CZ_TRY(write_file(folder, name, INPUT_FILE, results, error));
    }
    return CZ_OK;
}

/* Measured time histories of a fit, under the names in resolved.yaml. */
static CzStatus write_measured(CzFolder *folder, Results *results, CzError *error) {
    char name[256];
    for (int number = 1;; number++) {
        results->input = cz_problem_measured_file(results->run.problem, number, sizeof name, name);
        if (results->input == NULL)
            return CZ_OK;
        CZ_TRY(write_file(folder, name, INPUT_FILE, results, error));
    }
}

/* The files of a sampling; its worst samples as problem files, where the problem is in a file. */
static CzStatus write_sampling(CzFolder *folder, Results *results, CzError *error) {
    static const File files[] = {
        {"sample.json", SAMPLE}, {"samples.csv", SAMPLES}, {"report.html", SAMPLE_REPORT}};
    const CzSampling *sampling = results->report->sampling;
    CZ_TRY(write_files(folder, 3, files, results, error));
    if (cz_report_options_of(results->report)->text != NULL)
        return CZ_OK;
    for (int k = 0; k < sampling->n_sample; k++) {
        char name[CZ_REPLAY_SIZE];
        if (!cz_replay_is_written(sampling, k))
            continue;
        results->sample = k;
        cz_replay_name(k, name);
        CZ_TRY(write_file(folder, name, REPLAY, results, error));
    }
    return CZ_OK;
}

static CzStatus write_front(CzFolder *folder, Results *results, CzError *error) {
    static const File files[] = {{"pareto.json", PARETO},
                                 {"pareto.csv", PARETO_POINTS},
                                 {"report.html", PARETO_REPORT},
                                 {"front.svg", FRONT}};
    const CzPareto *pareto = results->report->pareto;
    CZ_TRY(write_files(folder, 4, files, results, error));
    if (cz_report_options_of(results->report)->journal != NULL)
        CZ_TRY(write_file(folder, "history.jsonl", JOURNAL, results, error));
    for (int i = 0; i < pareto->n_point; i++) {
        char name[32];
        snprintf(name, sizeof name, "point-%02d.yaml", i + 1);
        results->point = i;
        if (pareto->point[i].x != NULL)
            CZ_TRY(write_file(folder, name, POINT, results, error));
    }
    return CZ_OK;
}

/* The files of a challenge; counter-examples where there is one and the problem is in a file. */
static CzStatus write_challenge(CzFolder *folder, const Results *results, CzError *error) {
    static const File files[] = {{"challenge.json", CHALLENGE},
                                 {"challenge.csv", CHALLENGE_POINTS},
                                 {"report.html", CHALLENGE_REPORT},
                                 {CZ_COUNTER_EXAMPLE, COUNTER_EXAMPLE},
                                 {CZ_COUNTER_EXAMPLES, COUNTER_EXAMPLES}};
    return write_files(folder, cz_challenge_has_files(results->report) ? 5 : 3, files, results,
                       error);
}

/* The samples of the best design of a search against scatter. */
static CzStatus write_samples_of(CzFolder *folder, const Results *results, CzError *error) {
    static const File files[] = {
        {"sample.json", SAMPLE}, {"samples.csv", SAMPLES}, {"samples.html", SAMPLE_REPORT}};
    static const File added = {"with-added-scenarios.yaml", ADDED_SCENARIOS};
    const CzRobust *robust = results->report->robust;
    const CzReport report = {.kind = CZ_REPORT_SAMPLE,
                             .options = results->report->options,
                             .problem = robust->designed,
                             .sampling = robust->sampling};
    Results of_samples = *results;
    of_samples.report = &report;
    CZ_TRY(write_files(folder, 3, files, &of_samples, error));
    const bool has_file = cz_report_options_of(results->report)->text == NULL;
    return has_file && robust->added->n > 0 ? write_files(folder, 1, &added, results, error)
                                            : CZ_OK;
}

static CzStatus write_all(CzFolder *folder, Results *results, CzError *error) {
    static const File files[] = {{"summary.json", SUMMARY},   {"checks.csv", CHECKS},
                                 {"resolved.yaml", RESOLVED}, {"run.log", RUN_LOG},
                                 {"outcome.json", OUTCOME},   {"optimised.yaml", OVERLAY},
                                 {"history.csv", HISTORY}};
    static const File of_sweep[] = {
        {"sweep.json", SWEEP}, {"sweep.csv", SWEEP_POINTS}, {"report.html", SWEEP_REPORT}};
    static const File of_corridor[] = {{"corridor.json", CORRIDOR},
                                       {"corridor.csv", CORRIDOR_POINTS},
                                       {"report.html", CORRIDOR_REPORT},
                                       {"corridor.svg", CORRIDOR_FIGURE}};
    if (cz_shard_is(results->report))
        CZ_TRY(write_file(folder, CZ_SHARD_FILE, SHARD, results, error));
    if (results->report->kind == CZ_REPORT_SWEEP)
        return write_files(folder, 3, of_sweep, results, error);
    if (results->report->kind == CZ_REPORT_SAMPLE)
        return write_sampling(folder, results, error);
    if (results->report->kind == CZ_REPORT_CORRIDOR)
        return write_files(folder, 4, of_corridor, results, error);
    if (results->report->kind == CZ_REPORT_PARETO)
        return write_front(folder, results, error);
    if (results->report->kind == CZ_REPORT_CHALLENGE)
        return write_challenge(folder, results, error);
    CZ_TRY(write_files(folder, results->report->outcome != NULL ? 7 : 4, files, results, error));
    if (results->report->outcome != NULL && cz_report_options_of(results->report)->journal != NULL)
        CZ_TRY(write_file(folder, "history.jsonl", JOURNAL, results, error));
    if (results->report->robust != NULL)
        CZ_TRY(write_samples_of(folder, results, error));
    CZ_TRY(write_profiles(folder, results, error));
    CZ_TRY(write_measured(folder, results, error));
    for (int i = 0; i < results->run.evaluation->n_run; i++)
        if (cz_kept_run(results->run.evaluation, i) != NULL)
            CZ_TRY(write_run(folder, results, i, error));
    results->scenario = cz_deciding_run(results->run.evaluation);
    results->is_top = true;
    return results->scenario >= 0 && results->computed != NULL
               ? write_file(folder, "report.html", REPORT, results, error)
               : CZ_OK;
}

static CzStatus write_folder(Results *results, CzError *error) {
    const bool replaces_search = results->report->kind == CZ_REPORT_SEARCH ||
                                 cz_report_options_of(results->report)->replaces_search;
    CzFolder folder;
    CZ_TRY(cz_folder_begin(&folder, results->folder, replaces_search, error));
    const CzStatus status = write_all(&folder, results, error);
    if (status == CZ_OK)
        return cz_folder_finish(&folder, error);
    cz_folder_abandon(&folder);
    return status;
}

CzStatus cz_report_check_folder(const CzProblem *problem, const char *folder, bool replaces_search,
                                CzError *error) {
    CZ_TRY(cz_folder_check(folder, replaces_search, error));
    const CzSource *source = problem != NULL ? cz_problem_first_source(problem) : NULL;
    for (; source != NULL; source = source->next)
        if (cz_folder_holds(folder, source->name))
            return cz_fail(error, CZ_STATUS_OUTPUT,
                           "the result folder %.150s contains %.150s, which this problem is read "
                           "from and which would be replaced; choose another folder with -o",
                           folder, source->name);
    return CZ_OK;
}

CzStatus cz_report_write_folder(const CzReport *report, const char *folder, CzError *error) {
    Results results = {
        .report = report, .run = *report, .computed = report->problem, .folder = folder};
    if (report->kind != CZ_REPORT_SEARCH)
        return write_folder(&results, error);
    CzProblem *best = NULL;
    CzError mistake = {0}; /* a file may have changed meanwhile: then there is no report */
    const CzStatus read = cz_overlay_read_best(report, &best, &mistake);
    results.run.kind = CZ_REPORT_RUN;
    results.run.evaluation = &report->outcome->best_evaluation;
    results.computed = read == CZ_OK ? best : NULL;
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
