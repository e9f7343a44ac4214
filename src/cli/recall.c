/* Reads result folders: the end of a search from run.log, its evaluated designs from
 * history.csv. */
#include "cli/recall.h"

#include "base/error.h"
#include "cli/messages.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { LONGEST_LINE = 65536, FIRST_VARIABLE = 5 /* columns before those of the variables */ };

static FILE *open_in(const char *folder, const char *name) {
    char path[4096];
    const int n = snprintf(path, sizeof path, "%s/%s", folder, name);
    return n > 0 && (size_t)n < sizeof path ? fopen(path, "r") : NULL;
}

static void close_file(FILE *stream) {
    if (stream != NULL)
        fclose(stream);
}

/* The text after a beginning of a line; NULL for a line that begins otherwise. */
static char *after(char *line, const char *beginning) {
    const size_t n = strlen(beginning);
    return strncmp(line, beginning, n) == 0 ? line + n : NULL;
}

bool cz_recall_exists(const char *folder, const char *name) {
    char path[4096];
    struct stat found;
    const int n = snprintf(path, sizeof path, "%s/%s", folder, name);
    return n > 0 && (size_t)n < sizeof path && stat(path, &found) == 0;
}

bool cz_recall_is_search(const char *folder) {
    return cz_recall_exists(folder, "outcome.json");
}

void cz_recall_problem(const char *folder, char path[4096]) {
    char line[4096];
    FILE *stream = open_in(folder, "optimised.yaml");
    bool is_there = false;
    while (stream != NULL && !is_there && fgets(line, sizeof line, stream) != NULL) {
        char *file = after(line, "extends: \"");
        if (file == NULL)
            continue;
        file[strcspn(file, "\"\r\n")] = '\0';
        is_there = file[0] == '/' ? cz_recall_exists("", file + 1) : cz_recall_exists(folder, file);
    }
    close_file(stream);
    snprintf(path, 4096, "%.4000s/%s", folder, is_there ? "optimised.yaml" : "resolved.yaml");
}

/* ---- log ---- */

/* "feasible after 345 evaluations: no further improvement" */
static void read_end_of_search(char *text, CzRunLog *log) {
    static const char before[] = "evaluations: ";
    const char *why = strstr(text, before);
    for (int i = CZ_OUTCOME_FEASIBLE; i <= CZ_OUTCOME_INTERRUPTED; i++)
        if (after(text, cz_outcome_text((CzOutcomeStatus)i)) != NULL)
            log->status = (CzOutcomeStatus)i;
    log->is_of_search = why != NULL;
    if (why == NULL)
        return;
    why += strlen(before);
    snprintf(log->why_stopped, sizeof log->why_stopped, "%.*s", (int)strcspn(why, "\r\n"), why);
}

CzRunLog cz_recall_log(const char *folder) {
    char line[1024], ours[64];
    CzRunLog log = {0};
    FILE *stream = open_in(folder, "run.log");
    snprintf(ours, sizeof ours, "crushzone %s,", cz_version());
    while (stream != NULL && fgets(line, sizeof line, stream) != NULL) {
        char *search = after(line, "optimise: "), *scenario = after(line, "scenario ");
        char *end = strstr(line, ": ");
        log.is_ours |= after(line, ours) != NULL;
        if (search != NULL)
            read_end_of_search(search, &log);
        else if (scenario != NULL && end != NULL)
            snprintf(log.scenario, sizeof log.scenario, "%.*s", (int)(end - scenario), scenario);
    }
    close_file(stream);
    return log;
}

/* ---- history ---- */

/* Designs that a search evaluated. */
typedef struct History {
    int n_variable;
    long n;
    CzTrial *trial; /* (n) */
    double *x;      /* (n x n_variable) */
} History;

/* Removes the next field from a line and returns it. */
static char *cut_field(char **rest, char separator) {
    char *field = *rest, *end = strchr(field, separator);
    if (end == NULL)
        end = field + strcspn(field, "\r\n");
    *rest = *end != '\0' ? end + 1 : end;
    *end = '\0';
    return field;
}

/* A number with either decimal sign; NaN for an empty field. */
static double cut_number(char **rest, char separator) {
    char *field = cut_field(rest, separator), *comma = strchr(field, ',');
    double value;
    if (comma != NULL)
        *comma = '.';
    return sscanf(field, "%lf", &value) == 1 ? value : NAN;
}

static void read_row(char *line, char separator, History *history) {
    CzTrial *trial = &history->trial[history->n];
    double *x = &history->x[history->n++ * history->n_variable];
    (void)cut_field(&line, separator); /* its number */
    (void)cut_field(&line, separator); /* its phase */
    trial->objective = cut_number(&line, separator);
    trial->violation = cut_number(&line, separator);
    trial->feasible = strcmp(cut_field(&line, separator), "yes") == 0;
    for (int i = 0; i < history->n_variable; i++)
        x[i] = cut_number(&line, separator);
}

/* Finds the separator in the first line; 0 where that has another number of columns. */
static char separator_of(char *line, int n_column) {
    const char *rest = after(line, "evaluation");
    const char separator = rest != NULL ? *rest : '\0';
    bool in_quotes = false; /* a variable's name may contain the separator */
    for (const char *c = line; *c != '\0'; c++) {
        in_quotes ^= *c == '"';
        n_column -= *c == separator && !in_quotes;
    }
    return n_column == 1 ? separator : '\0';
}

static bool read_history(FILE *stream, History *history) {
    char *line = malloc(LONGEST_LINE), separator = '\0';
    size_t n_line = 0;
    while (line != NULL && fgets(line, LONGEST_LINE, stream) != NULL)
        n_line++;
    rewind(stream);
    history->trial = calloc(n_line + 1, sizeof *history->trial);
    history->x = calloc((n_line + 1) * (size_t)history->n_variable, sizeof *history->x);
    if (history->trial != NULL && history->x != NULL && n_line > 1 &&
        fgets(line, LONGEST_LINE, stream) != NULL)
        separator = separator_of(line, FIRST_VARIABLE + history->n_variable);
    while (separator != '\0' && (size_t)history->n + 1 < n_line &&
           fgets(line, LONGEST_LINE, stream) != NULL)
        read_row(line, separator, history);
    free(line);
    return history->n > 0;
}

int cz_recall_outcome(const CzSession *session, const char *folder, CzOutcome **outcome) {
    CzError error = {0};
    History history = {.n_variable = cz_evaluator_n_variable(session->evaluator)};
    const CzRunLog log = cz_recall_log(folder);
    FILE *stream = log.is_of_search ? open_in(folder, "history.csv") : NULL;
    int code = 0;
    *outcome = NULL;
    if (stream == NULL || !read_history(stream, &history)) {
        cz_fail(&error, CZ_STATUS_INPUT,
                "%.200s/%s cannot be read as the history of a search" CZ_HELP
                "for a report of the best design only give a file: -o best.html",
                folder, log.is_of_search ? "history.csv" : "run.log");
        code = cz_print_error(session->arguments, &error);
    } else {
        const CzRecall recall = {.status = log.status,
                                 .why_stopped = log.why_stopped,
                                 .start = history.x,
                                 .n_trial = history.n,
                                 .trial = history.trial,
                                 .trial_x = history.x};
        if (cz_outcome_recall(session->evaluator, &recall, outcome, &error) != CZ_OK)
            code = cz_session_fail(session, &error);
    }
    close_file(stream);
    free(history.trial);
    free(history.x);
    return code;
}
