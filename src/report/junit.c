/* Verdicts as JUnit XML: a suite for each scenario, a case for each check; a suite for a sweep, a
 * case for each point; for samples as for a run, each check over all samples.
 *
 *   passed   the check passes; a provisional pass is named in its system-out
 *   failure  it fails, or a vehicle climbed in the run
 *   error    the run failed or is incomplete, or a file, point or sample could not be judged
 *   skipped  it is not checked, as is every requirement of the profile that is not covered
 *
 * The document has no time and no host, so that equal runs give equal bytes.
 */
#include "crushzone/report.h"

#include "base/error.h"
#include "base/memory_text.h"
#include "evaluate/not_covered.h"
#include "report/checks_table.h"
#include "report/document_lines.h"
#include "report/markup.h"
#include "report/runs.h"
#include "report/verdict_words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct Count {
    int tests, failures, errors, skipped;
} Count;

struct CzJunit {
    CzMemoryText text; /* the suites so far */
    CzMarkup markup;   /* a stream into it */
    Count count;       /* over all suites */
};

CzJunit *cz_junit_begin(void) {
    CzJunit *junit = calloc(1, sizeof *junit);
    if (junit != NULL)
        junit->markup.stream = cz_memory_text_open(&junit->text);
    if (junit != NULL && junit->markup.stream == NULL) {
        free(junit);
        return NULL;
    }
    return junit;
}

void cz_junit_free(CzJunit *junit) {
    if (junit == NULL)
        return;
    fclose(junit->markup.stream);
    cz_memory_text_free(&junit->text);
    free(junit);
}

/* ---- suites ---- */

/* What the suites of a run share. */
typedef struct Suites {
    CzJunit *junit;
    const CzReport *report;
    const char *file;     /* name of the problem file, in class names */
    const char *scenario; /* of a suite of samples */
} Suites;

static void begin_suite(const Suites *suites, const char *name, Count count) {
    Count *all = &suites->junit->count;
    all->tests += count.tests;
    all->failures += count.failures;
    all->errors += count.errors;
    all->skipped += count.skipped;
    cz_markup_write(&suites->junit->markup,
                    "  <testsuite name='%s: %s' tests='%d' failures='%d' errors='%d' "
                    "skipped='%d'>\n",
                    suites->file, name, count.tests, count.failures, count.errors, count.skipped);
}

static void write_property(CzMarkup *markup, const char *name, const char *value) {
    if (value != NULL && value[0] != '\0')
        cz_markup_write(markup, "      <property name='%s' value='%s'/>\n", name, value);
}

static void write_properties(const Suites *suites) {
    CzMarkup *markup = &suites->junit->markup;
    char text[CZ_DOCUMENT_SIZE];
    cz_markup_write(markup, "    <properties>\n");
    for (int i = 0; i < CZ_N_DOCUMENT_LINE; i++)
        write_property(markup, cz_document_title(i),
                       cz_document_text(suites->report->problem, i, text));
    cz_markup_write(markup, "    </properties>\n");
}

static void begin_case(const Suites *suites, const char *scenario, const char *name) {
    cz_markup_write(&suites->junit->markup, "    <testcase classname='%s.%s' name='%s'>",
                    suites->file, scenario, name);
}

static void end_case(const Suites *suites) {
    cz_markup_write(&suites->junit->markup, "</testcase>\n");
}

static void write_run_case(const Suites *suites, const CzRunSummary *run) {
    CzMarkup *markup = &suites->junit->markup;
    begin_case(suites, run->scenario, "run");
    if (run->status != CZ_OK)
        cz_markup_write(markup, "<error type='run' message='%s'/>", run->failure);
    else if (run->ended == CZ_ENDED_INCOMPLETE)
        cz_markup_write(markup,
                        "<error type='run' message='the end criterion was not met within "
                        "simulation.longest_s: %s'/>",
                        run->awaited);
    else if (run->beyond_validity)
        cz_markup_write(markup, "<failure type='validity' message='a vehicle climbed: later "
                                "results are beyond the model'/>");
    end_case(suites);
}

/* Value, limit, margin, place and time of a check, as "value 0.95, limit 0.9091, ...". */
static void describe(const CzCheckResult *check, size_t room, char *text) {
    char value[CZ_CHECK_SIZE], limit[CZ_CHECK_SIZE], number[CZ_FIGURE_SIZE], when[CZ_CHECK_SIZE];
    const bool has_margin = !isnan(check->margin);
    cz_checks_time(check, sizeof when, when);
    snprintf(text, room, "value %s, limit %s%s%s%s%s%s%s%s", cz_checks_value(value, check),
             cz_checks_limit(limit, check), has_margin ? ", margin " : "",
             has_margin ? cz_figure_margin(number, check->margin) : "",
             check->where[0] != '\0' ? ", at " : "", check->where, when[0] != '\0' ? ", " : "",
             when, when[0] != '\0' ? " ms" : "");
}

/* Profile, clause, source and confidence of a limit. */
static void describe_source(const CzCheckResult *check, size_t room, char *text) {
    const struct {
        const char *word, *text;
    } parts[] = {{"", check->profile},
                 {"", check->clause},
                 {"", check->source},
                 {"confidence ", check->confidence}};
    size_t used = 0;
    text[0] = '\0';
    for (size_t i = 0; i < sizeof parts / sizeof *parts && used < room; i++)
        if (parts[i].text != NULL && parts[i].text[0] != '\0')
            used += (size_t)snprintf(text + used, room - used, "%s%s%s", used > 0 ? "; " : "",
                                     parts[i].word, parts[i].text);
}

static void write_check(const Suites *suites, const CzCheckResult *check) {
    CzMarkup *markup = &suites->junit->markup;
    char text[3 * CZ_CHECK_SIZE + CZ_WHERE_SIZE], source[2 * CZ_SENTENCE_SIZE];
    const char *why = check->why != NULL ? check->why : "";
    describe(check, sizeof text, text);
    describe_source(check, sizeof source, source);
    begin_case(suites, check->scenario, check->name);
    switch (check->verdict) {
    case CZ_VERDICT_FAIL:
        cz_markup_write(markup, "<failure type='limit' message='%s'>%s%s%s</failure>", text, why,
                        why[0] != '\0' ? "; " : "", source);
        break;
    case CZ_VERDICT_NOT_CHECKED:
        cz_markup_write(markup, "<skipped message='NOT CHECKED: %s'/>", why);
        break;
    case CZ_VERDICT_PROVISIONAL:
    case CZ_VERDICT_PASS:
        cz_markup_write(markup, "<system-out>%s: %s; %s</system-out>",
                        cz_verdict_word(check->verdict), isnan(check->value) ? why : text, source);
    }
    end_case(suites);
}

/* The run of a scenario that was kept; NULL for none. */
static const CzRunSummary *run_of(const CzEvaluation *evaluation, const char *scenario) {
    const int found = cz_find_kept_run(evaluation, scenario);
    return found >= 0 ? cz_kept_run(evaluation, found) : NULL;
}

static Count count_suite(const CzEvaluation *evaluation, const char *scenario) {
    const CzRunSummary *run = run_of(evaluation, scenario);
    Count count = {0};
    if (run != NULL) {
        const bool has_result = run->status == CZ_OK && run->ended != CZ_ENDED_INCOMPLETE;
        count.tests++;
        count.errors += !has_result;
        count.failures += has_result && run->beyond_validity;
    }
    for (int i = 0; i < evaluation->n_check; i++) {
        const CzCheckResult *check = &evaluation->check[i];
        if (strcmp(check->scenario, scenario) != 0)
            continue;
        count.tests++;
        count.failures += check->verdict == CZ_VERDICT_FAIL;
        count.skipped += check->verdict == CZ_VERDICT_NOT_CHECKED;
    }
    return count;
}

static void write_suite(const Suites *suites, const char *scenario) {
    const CzEvaluation *evaluation = suites->report->evaluation;
    const CzRunSummary *run = run_of(evaluation, scenario);
    begin_suite(suites, scenario, count_suite(evaluation, scenario));
    write_properties(suites);
    if (run != NULL)
        write_run_case(suites, run);
    for (int i = 0; i < evaluation->n_check; i++)
        if (strcmp(evaluation->check[i].scenario, scenario) == 0)
            write_check(suites, &evaluation->check[i]);
    cz_markup_write(&suites->junit->markup, "  </testsuite>\n");
}

/* Whether check i is the first of its scenario. */
static bool begins_scenario(const CzEvaluation *evaluation, int i) {
    for (int k = 0; k < i; k++)
        if (strcmp(evaluation->check[k].scenario, evaluation->check[i].scenario) == 0)
            return false;
    return true;
}

/* Requirements of the profile that are not covered, and a run without checks. */
static void write_not_covered(const Suites *suites, bool has_checks) {
    static const char name[] = "not covered";
    int n_listed;
    const char *const *requirement = cz_not_covered(suites->report->problem, &n_listed);
    const int n = n_listed + !has_checks;
    if (n == 0)
        return;
    begin_suite(suites, name, (Count){.tests = n, .skipped = n});
    write_properties(suites);
    for (int i = 0; i < n; i++) {
        const bool is_listed = i < n_listed;
        begin_case(suites, name, is_listed ? requirement[i] : "checks");
        cz_markup_write(&suites->junit->markup, "<skipped message='NOT CHECKED: %s'/>",
                        is_listed ? "not covered by this program, to be shown by other means"
                                  : "there is no check");
        end_case(suites);
    }
    cz_markup_write(&suites->junit->markup, "  </testsuite>\n");
}

static void add_run(const Suites *suites) {
    const CzEvaluation *evaluation = suites->report->evaluation;
    for (int i = 0; i < evaluation->n_run; i++)
        if (cz_kept_run(evaluation, i) != NULL)
            write_suite(suites, cz_kept_run(evaluation, i)->scenario);
    for (int i = 0; i < evaluation->n_check; i++)
        if (begins_scenario(evaluation, i) &&
            run_of(evaluation, evaluation->check[i].scenario) == NULL)
            write_suite(suites, evaluation->check[i].scenario);
    write_not_covered(suites, evaluation->n_check > 0);
}

/* ---- studies: cases with one outcome each ---- */

/* What a case of a study has in it. */
typedef enum Outcome { PASSED, FAILED, WITHOUT_RESULT, SKIPPED } Outcome;

typedef struct Case {
    Outcome outcome;
    char name[2 * CZ_PATH_SIZE + 64];
    char text[CZ_SENTENCE_SIZE + 3 * CZ_PLACE_SIZE];
} Case;

/* Fills the i-th case of a suite; false to leave it out. */
typedef bool FillCase(const Suites *suites, int i, Case *its);

static void write_cases(const Suites *suites, const char *name, int n, FillCase *fill) {
    static const char *const tags[] = {[PASSED] = "<system-out>%s</system-out>",
                                       [FAILED] = "<failure type='limit' message='%s'/>",
                                       [WITHOUT_RESULT] = "<error type='run' message='%s'/>",
                                       [SKIPPED] = "<skipped message='NOT CHECKED: %s'/>"};
    Count count = {0};
    Case its;
    for (int i = 0; i < n; i++) {
        if (!fill(suites, i, &its))
            continue;
        count.tests++;
        count.failures += its.outcome == FAILED;
        count.errors += its.outcome == WITHOUT_RESULT;
        count.skipped += its.outcome == SKIPPED;
    }
    if (count.tests == 0)
        return;
    begin_suite(suites, name, count);
    write_properties(suites);
    for (int i = 0; i < n; i++) {
        if (!fill(suites, i, &its))
            continue;
        begin_case(suites, name, its.name);
        cz_markup_write(&suites->junit->markup, tags[its.outcome], its.text);
        end_case(suites);
    }
    cz_markup_write(&suites->junit->markup, "  </testsuite>\n");
}

static Outcome outcome_of(CzVerdict verdict) {
    return verdict == CZ_VERDICT_FAIL          ? FAILED
           : verdict == CZ_VERDICT_NOT_CHECKED ? SKIPPED
                                               : PASSED;
}

/* ---- sweeps ---- */

/* The verdict of a point and what decides it. */
static void describe_point(const CzSweepPoint *point, Case *its) {
    char margin[CZ_FIGURE_SIZE];
    const bool has_margin = !isnan(point->margin);
    if (point->message[0] != '\0' || point->check[0] == '\0')
        snprintf(its->text, sizeof its->text, "%s",
                 point->message[0] != '\0' ? point->message : "no check could be made");
    else
        snprintf(its->text, sizeof its->text, "%s: %s%s%s in %s%s%s",
                 cz_verdict_word(point->verdict), point->check,
                 point->where[0] != '\0' ? " at " : "", point->where, point->scenario,
                 has_margin ? ", margin " : "",
                 has_margin ? cz_figure_margin(margin, point->margin) : "");
}

static bool fill_point(const Suites *suites, int i, Case *its) {
    const CzSweep *sweep = suites->report->sweep;
    const CzSweepPoint *point = &sweep->point[i];
    char number[CZ_FIGURE_SIZE];
    int n = 0;
    for (int k = 0; k < sweep->n_axis && n < (int)sizeof its->name; k++)
        n += snprintf(its->name + n, sizeof its->name - (size_t)n, "%s%s = %s", k > 0 ? ", " : "",
                      sweep->axis[k].path, cz_figure_digits(number, 6, point->value[k]));
    its->outcome = point->state == CZ_SWEEP_DONE      ? outcome_of(point->verdict)
                   : point->state == CZ_SWEEP_NOT_RUN ? SKIPPED
                                                      : WITHOUT_RESULT;
    if (point->state == CZ_SWEEP_NOT_RUN)
        snprintf(its->text, sizeof its->text, "the sweep was interrupted");
    else
        describe_point(point, its);
    return true;
}

/* ---- samples ---- */

/* Number of samples in which a check could not be made. */
static int count_unchecked(const CzSampling *sampling, int c) {
    int n = 0;
    for (int k = 0; k < sampling->n_sample; k++)
        n += sampling->sample[k].state == CZ_SAMPLE_DONE &&
             sampling->verdict[k * sampling->n_check + c] == CZ_VERDICT_NOT_CHECKED;
    return n;
}

static void fill_check(const CzSampling *sampling, int c, Case *its) {
    const CzSampledCheck *check = &sampling->check[c];
    const int n_unchecked = count_unchecked(sampling, c);
    char margin[CZ_FIGURE_SIZE];
    int n = snprintf(its->text, sizeof its->text, "%d of %d samples fail", check->n_fail,
                     sampling->n_run);
    if (!isnan(check->required))
        n += snprintf(its->text + n, sizeof its->text - (size_t)n, "; judged by the %s: %s",
                      sampling->judged_by, cz_figure_margin(margin, check->required));
    if (check->margin.worst >= 0)
        n += snprintf(its->text + n, sizeof its->text - (size_t)n, "; worst sample %d with %s",
                      check->margin.worst + 1, cz_figure_margin(margin, check->margin.least));
    if (n_unchecked > 0)
        snprintf(its->text + n, sizeof its->text - (size_t)n, "; not checked in %d samples",
                 n_unchecked);
    its->outcome = !check->is_satisfied                      ? FAILED
                   : n_unchecked > 0 || sampling->n_run == 0 ? SKIPPED
                                                             : PASSED;
    snprintf(its->name, sizeof its->name, "%s", check->name);
}

/* A check of the scenario of the suite. */
static bool fill_sampled_check(const Suites *suites, int c, Case *its) {
    const CzSampling *sampling = suites->report->sampling;
    if (strcmp(sampling->check[c].scenario, suites->scenario) != 0)
        return false;
    fill_check(sampling, c, its);
    return true;
}

/* The samples as a whole: the nominal design, and whether all gave a result. */
static bool fill_samples(const Suites *suites, int i, Case *its) {
    const CzSampling *sampling = suites->report->sampling;
    const CzVerdict verdict = sampling->nominal.verdict;
    if (i == 0) {
        its->outcome = outcome_of(verdict);
        snprintf(its->name, sizeof its->name, "nominal design");
        snprintf(its->text, sizeof its->text, "verdict %s", cz_verdict_word(verdict));
        return true;
    }
    snprintf(its->name, sizeof its->name, "results");
    its->outcome = sampling->n_failed > 0                 ? WITHOUT_RESULT
                   : sampling->n_run < sampling->n_sample ? SKIPPED
                                                          : PASSED;
    snprintf(its->text, sizeof its->text, "%d of %d samples were run, %d of them without a result",
             sampling->n_run, sampling->n_sample, sampling->n_failed);
    return true;
}

static void add_samples(Suites *suites) {
    const CzSampling *sampling = suites->report->sampling;
    write_cases(suites, "samples", 2, fill_samples);
    for (int c = 0; c < sampling->n_check; c++) {
        bool is_first = true;
        for (int k = 0; k < c; k++)
            is_first &= strcmp(sampling->check[k].scenario, sampling->check[c].scenario) != 0;
        suites->scenario = sampling->check[c].scenario;
        if (is_first)
            write_cases(suites, suites->scenario, sampling->n_check, fill_sampled_check);
    }
    write_not_covered(suites, sampling->n_check > 0);
}

/* ---- files ---- */

void cz_junit_add(CzJunit *junit, const CzReport *report) {
    Suites suites = {.junit = junit, .report = report, .file = cz_problem_file(report->problem)};
    if (report->kind == CZ_REPORT_SAMPLE) {
        add_samples(&suites);
    } else if (report->kind == CZ_REPORT_SWEEP) {
        write_cases(&suites, "sweep", report->sweep->n_point, fill_point);
        write_not_covered(&suites, true);
    } else {
        add_run(&suites);
    }
}

void cz_junit_add_error(CzJunit *junit, const char *file, const char *why) {
    const Suites suites = {.junit = junit, .file = file};
    begin_suite(&suites, "problem file", (Count){.tests = 1, .errors = 1});
    begin_case(&suites, "problem file", "judged");
    cz_markup_write(&junit->markup, "<error type='file' message='%s'/>", why);
    end_case(&suites);
    cz_markup_write(&junit->markup, "  </testsuite>\n");
}

CzStatus cz_junit_write(const void *data, FILE *stream, CzError *error) {
    const CzJunit *junit = data;
    CzMarkup markup = {.stream = stream};
    if (fflush(junit->markup.stream) != 0 || junit->text.failed)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the JUnit document");
    cz_markup_write(&markup,
                    "<?xml version='1.0' encoding='UTF-8'?>\n<testsuites name='crushzone %s' "
                    "tests='%d' failures='%d' errors='%d' skipped='%d'>\n",
                    cz_version(), junit->count.tests, junit->count.failures, junit->count.errors,
                    junit->count.skipped);
    fwrite(junit->text.text, 1, junit->text.n, stream);
    fputs("</testsuites>\n", stream);
    return CZ_OK;
}
