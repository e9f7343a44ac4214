/* A search read back from its result folder: how it ended from run.log, what it looked at from
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

/* What was read, growing line by line. */
typedef struct History {
    int n_variable;
    long n, room;
    CzTrial *trial;
    double *x;      /* (room x n_variable) */
    char separator; /* of the file */
    CzOutcomeStatus status;
    char why[160];
} History;

static FILE *open_in(const char *folder, const char *name, const char **path, char room[4096]) {
    snprintf(room, 4096, "%.4000s/%s", folder, name);
    *path = room;
    return fopen(room, "r");
}

bool cz_recall_is_search(const char *folder) {
    char path[4096];
    struct stat found;
    snprintf(path, sizeof path, "%.4000s/outcome.json", folder);
    return stat(path, &found) == 0;
}

void cz_recall_problem(const char *folder, char path[4096]) {
    char line[4096], target[8192];
    static const char before[] = "extends: \"";
    const char *overlay;
    struct stat found;
    FILE *stream = open_in(folder, "optimised.yaml", &overlay, path);
    bool is_there = false;
    while (stream != NULL && !is_there && fgets(line, sizeof line, stream) != NULL) {
        if (strncmp(line, before, strlen(before)) != 0)
            continue;
        char *file = line + strlen(before);
        file[strcspn(file, "\"\r\n")] = '\0';
        snprintf(target, sizeof target, "%s%s%s", file[0] == '/' ? "" : folder,
                 file[0] == '/' ? "" : "/", file);
        is_there = stat(target, &found) == 0;
    }
    if (stream != NULL)
        fclose(stream);
    if (!is_there)
        snprintf(path, 4096, "%.4000s/resolved.yaml", folder);
}

/* "optimise: feasible after 345 evaluations: no further improvement" */
static bool read_log(FILE *stream, History *history) {
    char line[1024];
    static const char before[] = "optimise: ";
    while (fgets(line, sizeof line, stream) != NULL) {
        if (strncmp(line, before, strlen(before)) != 0)
            continue;
        const char *word = line + strlen(before), *why = strstr(word, "evaluations: ");
        for (int i = CZ_OUTCOME_FEASIBLE; i <= CZ_OUTCOME_INTERRUPTED; i++)
            if (strncmp(word, cz_outcome_text((CzOutcomeStatus)i),
                        strlen(cz_outcome_text((CzOutcomeStatus)i))) == 0)
                history->status = (CzOutcomeStatus)i;
        if (why != NULL)
            snprintf(history->why, sizeof history->why, "%.*s",
                     (int)strcspn(why + strlen("evaluations: "), "\r\n"),
                     why + strlen("evaluations: "));
        return why != NULL;
    }
    return false;
}

/* Takes the next field off a line. */
static char *take_field(char **rest, char separator) {
    char *field = *rest, *end = strchr(field, separator);
    if (end == NULL)
        end = field + strcspn(field, "\r\n");
    *rest = *end != '\0' ? end + 1 : end;
    *end = '\0';
    return field;
}

/* A number with either decimal sign; NaN for an empty field. */
static double number_of(char *field) {
    char *comma = strchr(field, ',');
    double value;
    if (comma != NULL)
        *comma = '.';
    return sscanf(field, "%lf", &value) == 1 ? value : NAN;
}

static bool grow(History *history) {
    if (history->n < history->room)
        return true;
    const long room = 2 * history->room + 256;
    CzTrial *trial = realloc(history->trial, (size_t)room * sizeof *trial);
    if (trial != NULL)
        history->trial = trial;
    double *x = realloc(history->x, (size_t)room * (size_t)history->n_variable * sizeof *x);
    if (x != NULL)
        history->x = x;
    history->room = trial != NULL && x != NULL ? room : history->room;
    return trial != NULL && x != NULL;
}

static bool read_row(char *line, History *history) {
    if (!grow(history))
        return false;
    char *rest = line;
    CzTrial *trial = &history->trial[history->n];
    take_field(&rest, history->separator); /* its number */
    take_field(&rest, history->separator); /* its phase */
    trial->phase = NULL;
    trial->objective = number_of(take_field(&rest, history->separator));
    trial->violation = number_of(take_field(&rest, history->separator));
    trial->feasible = strcmp(take_field(&rest, history->separator), "yes") == 0;
    for (int i = 0; i < history->n_variable; i++)
        history->x[history->n * history->n_variable + i] =
            number_of(take_field(&rest, history->separator));
    history->n++;
    return true;
}

static bool read_history(FILE *stream, History *history) {
    char *line = malloc(LONGEST_LINE);
    bool fits = line != NULL && fgets(line, LONGEST_LINE, stream) != NULL;
    static const char first[] = "evaluation";
    if (fits) { /* the first line reports the separator and how many columns there are */
        history->separator = strncmp(line, first, strlen(first)) == 0 ? line[strlen(first)] : '\0';
        int n_column = 1;
        bool in_quotes = false; /* a variable's name may hold the separator */
        for (const char *c = line; *c != '\0'; c++) {
            in_quotes ^= *c == '"';
            n_column += *c == history->separator && !in_quotes;
        }
        fits = history->separator != '\0' && n_column == FIRST_VARIABLE + history->n_variable;
    }
    while (fits && fgets(line, LONGEST_LINE, stream) != NULL)
        fits = read_row(line, history);
    free(line);
    return fits && history->n > 0;
}

int cz_recall_outcome(const CzResult *result, const char *folder, CzOutcome **outcome) {
    char room[4096];
    const char *path;
    CzError error = {0};
    History history = {.n_variable = cz_evaluator_n_variable(result->session.evaluator)};
    *outcome = NULL;
    FILE *stream = open_in(folder, "run.log", &path, room);
    bool fits = stream != NULL && read_log(stream, &history);
    if (stream != NULL)
        fclose(stream);
    stream = fits ? open_in(folder, "history.csv", &path, room) : NULL;
    fits = stream != NULL && read_history(stream, &history);
    if (stream != NULL)
        fclose(stream);
    int code;
    if (!fits) {
        cz_fail(&error, CZ_STATUS_INPUT,
                "%.200s cannot be read as the history of a search" CZ_HELP
                "for a report of the best design only give a file: -o best.html",
                path);
        code = cz_tell_error(&result->arguments, &error);
    } else {
        const CzRecall recall = {.status = history.status,
                                 .why_stopped = history.why,
                                 .start = history.x,
                                 .n_trial = history.n,
                                 .trial = history.trial,
                                 .trial_x = history.x};
        code = cz_outcome_recall(result->session.evaluator, &recall, outcome, &error) == CZ_OK
                   ? 0
                   : cz_session_fail(&result->session, &error);
    }
    free(history.trial);
    free(history.x);
    return code;
}
