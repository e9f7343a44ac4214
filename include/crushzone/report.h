/* Results as text and files: pure functions from const structs to a stream or a folder.
 *
 * The same input gives the same bytes: values that differ from run to run (time, host, threads) are
 * only under `run_info` of the JSON documents. Numbers have a decimal point in every locale.
 */
#ifndef CRUSHZONE_REPORT_H
#define CRUSHZONE_REPORT_H

#include <stdio.h>

#include "crushzone/benchmark.h"
#include "crushzone/challenge.h"
#include "crushzone/corridor.h"
#include "crushzone/explain.h"
#include "crushzone/fit.h"
#include "crushzone/optimise.h"
#include "crushzone/robust.h"
#include "crushzone/sample.h"
#include "crushzone/shards.h"
#include "crushzone/pareto.h"
#include "crushzone/sweep.h"
#include "crushzone/verify.h"

CZ_BEGIN_DECLARATIONS

/* How results are written. */
typedef struct CzReportOptions {
    char csv_separator;     /* between the fields of a CSV file */
    char csv_decimal;       /* decimal sign of CSV files */
    int n_job;              /* threads, for run_info; 0 when unknown */
    double setup_s;         /* reading and building, for run_info; NaN when unknown */
    double wall_s;          /* simulating, for run_info; NaN when unknown */
    const char *const *set; /* "path=value" texts that the problem was read with, so that an optimum
                               contains them too; (n_set) */
    int n_set;
    const char *command; /* command of the program that reproduces the report, such as "optimise";
                            NULL: "run" */
    const char *const *word; /* further arguments that results depend on, such as "--scenario" and
                                its name (n_word) */
    int n_word;
    const char *text;    /* text of a problem that was not read from a file; NULL otherwise */
    size_t n_text;       /* [byte] */
    const char *journal; /* file with the journal of the search, copied into the folder; NULL when
                            there is none */
    bool iso_mme;        /* a result folder also has the histories of each run in ISO-MME */
    const char *const *shard_word; /* of a shard: options of the command line that results depend
                                      on, for shard.jsonl (n_shard_word); NULL of a whole run */
    int n_shard_word;
    int text_width;       /* characters of a line of a terminal, which wider tables wrap their cells
                             to fit; 0: any */
    bool replaces_search; /* a result folder with the result of a search may be replaced by another
                             result */
} CzReportOptions;
CZ_API CzReportOptions cz_report_options_default(void);

/* Version of the library, such as "0.1.0". */
CZ_API const char *cz_version(void);

/* A run for pages and figures: an evaluation with kept runs, and its problem. */
typedef struct CzReportRun {
    const char *label; /* such as the name of its folder */
    const CzProblem *problem;
    const CzEvaluation *evaluation;
    int scenario; /* scenario of the figures; -1: the one with the smallest margin */
} CzReportRun;

/* Kinds of results; each has a JSON document. */
typedef enum CzReportKind {
    CZ_REPORT_RUN,          /* problem, evaluation */
    CZ_REPORT_SEARCH,       /* problem, evaluator, outcome */
    CZ_REPORT_SWEEP,        /* sweep */
    CZ_REPORT_SAMPLE,       /* problem, sampling */
    CZ_REPORT_CORRIDOR,     /* corridor */
    CZ_REPORT_PARETO,       /* problem, pareto */
    CZ_REPORT_CHALLENGE,    /* problem, challenge */
    CZ_REPORT_VERIFICATION, /* problem, verification */
    CZ_REPORT_BENCHMARK,    /* problem, benchmark */
    CZ_REPORT_EXPLANATION,  /* problem, explanation */
    CZ_REPORT_COMPARISON,   /* runs that are compared with the first one */
    CZ_REPORT_FIT,          /* fit */
    CZ_REPORT_MISTAKES,     /* mistake */
    CZ_REPORT_ANSWER,       /* problem, evaluator, reply */
    CZ_N_REPORT
} CzReportKind;

/* A value and its derivatives by the design variables. */
typedef struct CzSlope {
    const char *of;   /* "objective", the name of a constraint, or a metric */
    double value;     /* in its unit; NaN when it is not known */
    const double *by; /* per unit of each variable (n_variable) */
} CzSlope;

/* Results that an answer contains beside verdict, objective and smallest margin. */
enum { CZ_REPLY_CHECKS = 1, CZ_REPLY_CONSTRAINTS = 2 };

/* An answer to one request of a design loop, all borrowed. It is a description when it has neither
 * an error nor an evaluation. */
typedef struct CzReply {
    bool has_id;
    long id;                        /* of the request */
    CzError error;                  /* reason why there is no answer; CZ_OK for none */
    const CzEvaluation *evaluation; /* of a design */
    unsigned parts;                 /* a sum of CZ_REPLY_... */
    int n_slope;
    const CzSlope *slope; /* of a gradient (n_slope) */
} CzReply;

/* An input that differs between compared runs. Values are as resolved problems have them. */
typedef struct CzInputDifference {
    const char *path; /* of its first place, such as trains.A.vehicles.A1.front.stages[0].force, or
                         of a record that some runs lack */
    int n_place;      /* places that have the value from one line of a file */
    const char *unit; /* of the numbers; "" for none */
    const char *const *value;  /* text, a number in SI; "given" for a record; NULL: the run lacks it
                                  (n_run) */
    const double *number;      /* in the unit; NaN for a text (n_run) */
    const char *const *origin; /* file and line, and part; "default" when it is not in a file, ""
                                  where it is lacking (n_run) */
} CzInputDifference;

/* A number of the compared scenario that differs. */
typedef struct CzNumberDifference {
    const char *path; /* such as interfaces.A4-B1.peak_force_kN */
    const char *unit;
    const double *value; /* NaN where it is not known or the run lacks it (n_run) */
} CzNumberDifference;

/* A train or vehicle that has another name in a run than in the first one, at the same place.
 * Paths, texts and tables have the name of the first run. Borrowed from the problems. */
typedef struct CzComparedName {
    int run; /* from 0, at least 1 */
    const char *first, *other;
} CzComparedName;

/* Differences of compared runs. Open; texts and arrays belong to it. */
typedef struct CzComparison {
    int n_run;
    int n_name;
    CzComparedName *name; /* run by run (n_name) */
    int n_input, n_same_input;
    CzInputDifference *input; /* (n_input) */
    int n_number, n_same_number;
    CzNumberDifference *number; /* (n_number) */
} CzComparison;

/* Results to write, all borrowed. Only the members of its kind are set. */
typedef struct CzReport {
    CzReportKind kind;
    const CzReportOptions *options; /* NULL: the default ones */
    const CzProblem *problem;
    const CzEvaluation *evaluation;
    const CzEvaluator *evaluator;
    const CzOutcome *outcome;
    const CzRobust *robust; /* of a search against scatter, which has the outcome; else NULL */
    const CzSweep *sweep;
    const CzSampling *sampling;
    const CzCorridor *corridor;
    const CzPareto *pareto;
    const CzChallenge *challenge;
    const CzVerification *verification;
    const CzBenchmark *benchmark;
    const CzExplanation *explanation;
    const CzReportRun *compared;    /* (n_compared) */
    int n_compared;                 /* at most CZ_MAX_COMPARED */
    const CzComparison *comparison; /* of these runs; NULL: differences of inputs are not written */
    const CzFit *fit;
    const CzError *const *mistake; /* (n_mistake) */
    int n_mistake;
    const CzReply *reply;
} CzReport;

enum { CZ_MAX_COMPARED = 8 };

/* Finds the differences of the compared runs of a report: of their inputs, and of all numbers of
 * the compared scenario. Freed by the caller, before the runs. Status: CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_comparison_make(const CzReport *report, CzComparison **comparison,
                                                 CzError *error);
CZ_API void cz_comparison_free(CzComparison *comparison);

/* The JSON document; an answer is one line. Statuses: CZ_STATUS_OUTPUT when the stream fails,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_report_write_json(const CzReport *report, FILE *stream,
                                                   CzError *error);

/* An answer alone, without the end of its line, for a list of answers. */
CZ_API void cz_report_write_answer(const CzReport *report, FILE *stream);

/* Tables for a terminal, of all but fits and mistakes: the worst member of a family of scenarios;
 * before and after a search, violated constraints, and the new values as YAML; the points of a
 * sweep over one path or the map over two; the checks of a sampling; the weak points of a
 * challenge; the values with the largest changes of a verification; the differences of a
 * comparison. `colour` allows escape codes. Status: CZ_STATUS_NO_MEMORY when rows are missing,
 * which the text also reports. */
CZ_MUST_CHECK CZ_API CzStatus cz_report_write_table(const CzReport *report, bool colour,
                                                    FILE *stream, CzError *error);

/* The report of a run, a search or a comparison as one HTML page without external content. The same
 * results give the same bytes. The problem of a search is that of its best design. Statuses:
 * CZ_STATUS_INPUT when no run was kept, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_report_write_page(const CzReport *report, FILE *stream,
                                                   CzError *error);

/* The figure of a corridor as an SVG document. Status: CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_report_write_corridor(const CzCorridor *corridor, FILE *stream,
                                                       CzError *error);

/* The figure of a front as an SVG document. Status: CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_report_write_front(const CzPareto *pareto, FILE *stream,
                                                    CzError *error);

/* The whole result folder of a run, a search, a sweep, a sampling, a front or a challenge: to a
 * temporary name first, renamed at the end; replaces only a folder of our own. Needs runs that were
 * kept. Statuses: CZ_STATUS_OUTPUT, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_report_write_folder(const CzReport *report, const char *folder,
                                                     CzError *error);

/* Writes an SVG figure of the law over its curve; its title marks a doubtful or refused law.
 * Statuses: CZ_OK, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_report_write_fit_figure(const CzFit *fit, FILE *stream,
                                                         CzError *error);

/* JSON documents by name, such as "summary"; NULL beyond the last. */
CZ_API const char *cz_report_document_name(int index);
/* The JSON schema of a document. Status: CZ_STATUS_INPUT when there is none of that name. */
CZ_MUST_CHECK CZ_API CzStatus cz_report_write_document_schema(const char *document, FILE *stream,
                                                              CzError *error);
/* All results with unit, type and meaning, in Markdown. */
CZ_API void cz_report_write_results_page(FILE *stream);

/* Figures of a run (charts.def), by name; NULL beyond the last. */
CZ_API const char *cz_report_chart_name(int index);
/* Options of a figure. Texts are borrowed. */
typedef struct CzChartOptions {
    const char *what;     /* name of the figure */
    const char *at;       /* interface or car of the figure; NULL: the colliding interface, the car
                             with the largest mean deceleration; no meaning for figures of the whole
                             run */
    const char *measured; /* CSV file with curves to overlay, in any of the units of the axes; NULL
                             for none. The first column is the abscissa */
    const char *column;   /* of the values: titles or numbers from 1, with commas between them;
                             NULL: the second, of panels all. Over panels a title begins as a
                             channel does: F_, v_, x_, d_ */
    char csv_separator;   /* 0: found from the lines */
    char csv_decimal;     /* 0: found from the numbers */
} CzChartOptions;
CZ_API CzChartOptions cz_chart_options_default(void);

/* One figure as an SVG document. Statuses: CZ_STATUS_INPUT, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_report_write_chart(const CzReportRun *run,
                                                    const CzChartOptions *options, FILE *stream,
                                                    CzError *error);

/* One figure with the curves of all points of a sweep as an SVG document: "fd", "force" or
 * "velocity". Statuses: CZ_STATUS_INPUT for another name, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_report_write_sweep_chart(const CzSweep *sweep, const char *what,
                                                          FILE *stream, CzError *error);

/* The two ends of the colliding interface from the side, to scale, as an SVG document: heights,
 * gaps, and the strokes beside the available length. Statuses: CZ_STATUS_INPUT,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_report_write_elevation(const CzProblem *problem, int scenario,
                                                        FILE *stream, CzError *error);

/* Whether a result folder can be written, before anything is computed: there is none, or one
 * written by crushzone without other files, without the result of a search unless that may be
 * replaced, and without a file that the problem was read from (NULL: of no problem). Status:
 * CZ_STATUS_OUTPUT. */
CZ_MUST_CHECK CZ_API CzStatus cz_report_check_folder(const CzProblem *problem, const char *folder,
                                                     bool replaces_search, CzError *error);

/* Restores a result folder, the old one or the new one, that a process left under a hidden name
 * when it was killed while replacing it; whether it did. Nothing is done if the folder exists. */
CZ_API bool cz_report_restore_folder(const char *folder);

/* Writes a single file completely or not at all: to a temporary name first, renamed at the end. A
 * link is replaced and not followed; a pipe or a device is written to. `write` writes the content
 * to a stream. cz_report_check_file reports beforehand whether that can be, and refuses to replace
 * a file that the problem was read from (NULL: of no problem) or that belongs to a result folder;
 * with is_page the page of the folder that the problem was read from may be replaced. Statuses:
 * CZ_STATUS_OUTPUT, those of `write`. */
typedef CzStatus CzReportWriter(const void *data, FILE *stream, CzError *error);
CZ_MUST_CHECK CZ_API CzStatus cz_report_check_file(const CzProblem *problem, const char *path,
                                                   bool is_page, CzError *error);
CZ_MUST_CHECK CZ_API CzStatus cz_report_write_file(const char *path, CzReportWriter *write,
                                                   const void *data, CzError *error);

/* Verdicts as JUnit XML, which the servers of continuous integration read: a suite for each
 * scenario, a case for each check; of a sweep a case for each point; of samples a case for each
 * check over all of them. What is not checked is skipped, never passed (docs/report.md). */
typedef struct CzJunit CzJunit;

/* NULL without memory. */
CZ_API CzJunit *cz_junit_begin(void);
/* Adds the suites of a run, a sweep or samples, or those of a file that could not be judged, with
 * the reason. */
CZ_API void cz_junit_add(CzJunit *junit, const CzReport *report);
CZ_API void cz_junit_add_error(CzJunit *junit, const char *file, const char *why);
/* Writes a CzJunit as a document; a CzReportWriter. Status: CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_junit_write(const void *junit, FILE *stream, CzError *error);
CZ_API void cz_junit_free(CzJunit *junit);

/* Writes the tables and documents of result folders into an SQLite database, completely or not at
 * all; an existing file is replaced (docs/exchange.md). Statuses: CZ_STATUS_INPUT for a folder that
 * is not a result folder, and in a library that was built without SQLite; CZ_STATUS_OUTPUT,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_report_export(int n_folder, const char *const *folder,
                                               const char *path, CzError *error);

/* A rule for make: `target` depends on every file that the problem was read from, such as base
 * files, catalogues, curves and profiles. Each of them is a target without a rule too, so that make
 * goes on when one is removed. */
CZ_API void cz_report_write_dependencies(const CzProblem *problem, const char *target,
                                         FILE *stream);

/* The journal of a search in its result folder: history.jsonl has every evaluation, one line each,
 * written before the next begins; optimised.yaml is the best design so far. They are in the
 * subfolder `unfinished` as long as the folder has earlier results. With them a search that was
 * killed, interrupted or has ended is continued. */
typedef struct CzJournalFile CzJournalFile;

/* The beginning of the search that a journal is of. Texts are borrowed. */
typedef struct CzJournalHead {
    const char *algorithm;
    long seed, evaluations, width;
    const char *const *set; /* settings of the command line (n_set) */
    int n_set;
    const char *const *word; /* as in CzReportOptions (n_word) */
    int n_word;
    long n_answer;
    bool was_torn; /* its last line was incomplete and is left out */
} CzJournalHead;

/* Opens the journal of a folder and keeps other processes from it; with `resumes` reads it, else
 * refuses a folder with a search that has not ended. Ended by cz_journal_end. Statuses:
 * CZ_STATUS_INPUT for a folder without a journal, or one that cannot be read; CZ_STATUS_OUTPUT,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_journal_open(const char *folder, bool resumes,
                                              CzJournalFile **file, CzError *error);

/* Whether a search, of this or another process, has the journal of a folder open. */
CZ_API bool cz_journal_is_open(const char *folder);

/* Its head; NULL when it does not resume a search. */
CZ_API const CzJournalHead *cz_journal_head(const CzJournalFile *file);

/* Begins the journal of a search with these settled options and sets their `journal`, so that they
 * are valid as long as the file is open. The report of the search is borrowed. Refuses with
 * CZ_STATUS_INPUT the journal of another version, problem, algorithm, seed or width, or of a higher
 * limit; with a lower limit the search may ask for other designs. Statuses also CZ_STATUS_OUTPUT,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_journal_begin(CzJournalFile *file, const CzReport *report,
                                               CzOptimiseOptions *options, CzError *error);

/* Path of the journal, for CzReportOptions.journal. */
CZ_API const char *cz_journal_path(const CzJournalFile *file);

/* Closes the journal; with `removes` the files of a search that was not resumed are removed, as
 * after one without any successful run. */
CZ_API void cz_journal_end(CzJournalFile *file, bool removes);

CZ_END_DECLARATIONS
#endif
