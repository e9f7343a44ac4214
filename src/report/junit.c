/* Verdicts as JUnit XML: a suite for each scenario, a case for each check.
 *
 *   passed   the check passes; a provisional pass is named in its system-out
 *   failure  it fails, or a vehicle climbed in the run
 *   error    the run failed or is incomplete, or a file could not be judged
 *   skipped  it is not checked, as is every requirement of the profile that is not covered
 *
 * The document has no time and no host, so that equal runs give equal bytes.
 */
#include "crushzone/report.h"

#include "base/error.h"
#include "base/memory_text.h"
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
    const char *file; /* name of the problem file, in class names */
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
    char text[CZ_DOCUMENT_ROOM];
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
    char value[CZ_CHECK_ROOM], limit[CZ_CHECK_ROOM], number[CZ_FIGURE_ROOM], when[CZ_CHECK_ROOM];
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
    char text[3 * CZ_CHECK_ROOM + CZ_WHERE_ROOM], source[2 * CZ_SENTENCE_ROOM];
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

/* Runs without checks, and requirements that are not covered: what no check speaks for. */
static void write_not_covered(const Suites *suites) {
    static const char name[] = "not covered";
    const CzEvaluation *evaluation = suites->report->evaluation;
    const int n = evaluation->n_not_covered + (evaluation->n_check == 0);
    if (n == 0)
        return;
    begin_suite(suites, name, (Count){.tests = n, .skipped = n});
    write_properties(suites);
    for (int i = 0; i < n; i++) {
        const bool is_listed = i < evaluation->n_not_covered;
        begin_case(suites, name, is_listed ? evaluation->not_covered[i] : "checks");
        cz_markup_write(&suites->junit->markup, "<skipped message='NOT CHECKED: %s'/>",
                        is_listed ? "not covered by this program, to be shown by other means"
                                  : "there is no check");
        end_case(suites);
    }
    cz_markup_write(&suites->junit->markup, "  </testsuite>\n");
}

void cz_junit_add(CzJunit *junit, const CzReport *report) {
    const CzEvaluation *evaluation = report->evaluation;
    const Suites suites = {junit, report, cz_problem_file(report->problem)};
    for (int i = 0; i < evaluation->n_run; i++)
        if (cz_kept_run(evaluation, i) != NULL)
            write_suite(&suites, cz_kept_run(evaluation, i)->scenario);
    for (int i = 0; i < evaluation->n_check; i++)
        if (begins_scenario(evaluation, i) &&
            run_of(evaluation, evaluation->check[i].scenario) == NULL)
            write_suite(&suites, evaluation->check[i].scenario);
    write_not_covered(&suites);
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
