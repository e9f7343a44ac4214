/* Reads samples.csv again: the samples of other shards, or of a sampling that was interrupted. */
#include "report/sample_rows.h"

#include "base/error.h"
#include "base/number.h"
#include "crushzone/report.h"
#include "report/sample_values.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A file being read. */
typedef struct Rows {
    const char *file;
    FILE *stream;
    char separator, decimal;
    char *line; /* of the size `room` */
    size_t room;
    int number; /* of the line, from 1 */
    char *next; /* of its next field; NULL after the last */
    CzError *error;
} Rows;

static CzStatus fail(const Rows *rows, const char *what) {
    return cz_fail(
        rows->error, CZ_STATUS_INPUT,
        "%.300s:%d: %s" CZ_HELP
        "only samples of the same seed, number of samples and decimal sign can be joined",
        rows->file, rows->number, what);
}

/* Reads the next line; false at the end or without memory, which *status has. */
static bool read_line(Rows *rows, CzStatus *status) {
    size_t n = 0;
    for (int c; (c = fgetc(rows->stream)) != EOF && c != '\n';) {
        if (n + 2 > rows->room) {
            const size_t room = 2 * rows->room + 4096;
            char *more = realloc(rows->line, room);
            if (more == NULL) {
                *status = cz_no_memory(rows->error, "a line of samples.csv");
                return false;
            }
            rows->line = more;
            rows->room = room;
        }
        rows->line[n++] = (char)c;
    }
    if (n == 0)
        return false;
    if (rows->line[n - 1] == '\r')
        n--;
    rows->line[n] = '\0';
    rows->number++;
    rows->next = rows->line;
    return true;
}

/* Cuts the next field off the line, without its quotes; NULL when there is none. */
static char *cut_field(Rows *rows) {
    char *field = rows->next, *to = field, *from = field;
    if (field == NULL)
        return NULL;
    bool in_quotes = *from == '"';
    from += in_quotes;
    for (; *from != '\0' && (in_quotes || *from != rows->separator); from++) {
        if (in_quotes && *from == '"') {
            if (from[1] != '"') {
                in_quotes = false;
                continue;
            }
            from++;
        }
        *to++ = *from;
    }
    rows->next = *from != '\0' ? from + 1 : NULL;
    *to = '\0';
    return field;
}

/* A number of the row; NaN for an empty field, false for one that is not a number. */
static bool cut_number(Rows *rows, double *value) {
    char *field = cut_field(rows);
    *value = NAN;
    if (field == NULL)
        return false;
    char *point = strchr(field, rows->decimal);
    if (point != NULL)
        *point = '.';
    return field[0] == '\0' || cz_number_scan(field, value);
}

/* A margin of the row: a number, or the word for a run that failed. */
static bool cut_margin(Rows *rows, double *margin) {
    if (rows->next != NULL &&
        strncmp(rows->next, CZ_SAMPLE_FAILED, strlen(CZ_SAMPLE_FAILED)) == 0) {
        *margin = -INFINITY;
        return cut_field(rows) != NULL;
    }
    return cut_number(rows, margin);
}

/* Whether the next field is this text. */
static bool cut_text(Rows *rows, const char *text) {
    const char *field = cut_field(rows);
    return field != NULL && strcmp(field, text) == 0;
}

/* Reads the titles, which name every draw and check of the sampling, and finds the separator. */
static CzStatus read_heads(Rows *rows, const CzSampling *sampling) {
    static const char *const heads[CZ_SAMPLE_N_HEAD] = {CZ_SAMPLE_HEADS};
    CzStatus status = CZ_OK;
    if (!read_line(rows, &status) || strlen(rows->line) <= strlen(heads[0]))
        return status != CZ_OK ? status : fail(rows, "it is not a table of samples");
    rows->separator = rows->line[strlen(heads[0])];
    bool is_same = true;
    for (int i = 0; i < CZ_SAMPLE_N_HEAD; i++)
        is_same = is_same && cut_text(rows, heads[i]);
    if (!is_same)
        return fail(rows, "it is not a table of samples");
    for (int d = 0; d < sampling->n_draw; d++)
        is_same = is_same && cut_text(rows, sampling->draw[d].name);
    for (int c = 0; c < sampling->n_check; c++) {
        char name[2 * CZ_LABEL_ROOM + CZ_NAME_ROOM];
        snprintf(name, sizeof name, "%s, %s", sampling->check[c].name, sampling->check[c].scenario);
        is_same = is_same && cut_text(rows, name);
    }
    return is_same ? CZ_OK : fail(rows, "it has samples of other random numbers or checks");
}

static bool cut_word(Rows *rows, int n, const char *(*word)(int), int *index) {
    const char *field = cut_field(rows);
    for (*index = 0; field != NULL && *index < n; ++*index)
        if (strcmp(field, word(*index)) == 0)
            return true;
    return false;
}

static const char *state_word(int index) {
    return cz_sample_state_text((CzSampleState)index);
}

static const char *verdict_word(int index) {
    return cz_verdict_text((CzVerdict)index);
}

/* The check of a name and a scenario; -1 for none. */
static int find_check(const CzSampling *sampling, const char *name, const char *scenario) {
    for (int c = 0; c < sampling->n_check; c++)
        if (strcmp(sampling->check[c].name, name) == 0 &&
            strcmp(sampling->check[c].scenario, scenario) == 0)
            return c;
    return -1;
}

/* Reads the fields of a check in one sample. */
static bool read_check(Rows *rows, const CzSampledCheck *check, double *margin,
                       CzVerdict *verdict) {
    *margin = NAN;
    *verdict = CZ_VERDICT_NOT_CHECKED;
    if (!check->is_flag) {
        if (!cut_margin(rows, margin))
            return false;
        if (!isnan(*margin))
            *verdict = *margin < 0 ? CZ_VERDICT_FAIL : CZ_VERDICT_PASS;
        return true;
    }
    const char *field = cut_field(rows);
    if (field == NULL)
        return false;
    if (field[0] != '\0')
        *verdict = strcmp(field, CZ_SAMPLE_FAILS) == 0 ? CZ_VERDICT_FAIL : CZ_VERDICT_PASS;
    return true;
}

/* Reads the columns in front of a row; *kept is its sample. */
static bool read_front(Rows *rows, const CzSampling *sampling, CzSample *read, int *kept) {
    double number;
    int state, verdict;
    if (!cut_number(rows, &number) || !(number >= 1) || !(number <= sampling->n_sample) ||
        !cut_word(rows, CZ_SAMPLE_NOT_RUN, state_word, &state) ||
        !cut_word(rows, CZ_VERDICT_NOT_CHECKED + 1, verdict_word, &verdict))
        return false;
    *kept = (int)number - 1;
    read->state = (CzSampleState)state;
    read->verdict = (CzVerdict)verdict;
    read->beyond_validity = cut_text(rows, "yes");
    if (!cut_margin(rows, &read->margin))
        return false;
    const char *name = cut_field(rows), *scenario = cut_field(rows);
    read->check = name != NULL && scenario != NULL ? find_check(sampling, name, scenario) : -1;
    return scenario != NULL;
}

/* Reads one sample. Its values must be those that the sampling draws. */
static CzStatus read_row(Rows *rows, CzSampling *sampling) {
    CzSample read = {.check = -1};
    int k = 0;
    if (!read_front(rows, sampling, &read, &k))
        return fail(rows, "it is not a row of a sample");
    for (int d = 0; d < sampling->n_draw; d++) {
        double value;
        if (!cut_number(rows, &value) || !(value == cz_sample_value(sampling, k, d)))
            return fail(rows, "its values are those of another sample");
    }
    const size_t row = (size_t)k * (size_t)sampling->n_check;
    for (int c = 0; c < sampling->n_check; c++)
        if (!read_check(rows, &sampling->check[c], &sampling->margin[row + (size_t)c],
                        &sampling->verdict[row + (size_t)c]))
            return fail(rows, "it is not a row of a sample");
    const char *message = cut_field(rows);
    if (message == NULL || rows->next != NULL)
        return fail(rows, "it is not a row of a sample");
    if (message[0] != '\0') {
        read.message = malloc(strlen(message) + 1);
        if (read.message == NULL)
            return cz_no_memory(rows->error, "the samples");
        memcpy(read.message, message, strlen(message) + 1);
    }
    free(sampling->sample[k].message);
    sampling->sample[k] = read;
    return CZ_OK;
}

/* Whether a file contains a text of at most 200 bytes; false too where it cannot be read. */
static bool file_contains(const char *file, const char *text) {
    char window[512] = "";
    size_t n = 0;
    FILE *stream = fopen(file, "rb");
    bool found = false;
    for (int c; stream != NULL && !found && (c = fgetc(stream)) != EOF;) {
        if (n == sizeof window - 1) { /* keep the end, in which the text may have begun */
            n = strlen(text) - 1;
            memmove(window, window + sizeof window - 1 - n, n);
        }
        window[n++] = (char)c;
        window[n] = '\0';
        found = n >= strlen(text) && strcmp(window + n - strlen(text), text) == 0;
    }
    if (stream != NULL)
        fclose(stream);
    return found;
}

CzStatus cz_report_read_samples(const char *folder, const CzReportOptions *options,
                                CzSampling *sampling, CzError *error) {
    char file[4096], hash[64];
    snprintf(file, sizeof file, "%.4000s/sample.json", folder);
    snprintf(hash, sizeof hash, "\"hash\": \"%.20s\"", cz_problem_hash(sampling->problem));
    if (!file_contains(file, hash))
        return cz_fail(error, CZ_STATUS_INPUT,
                       "%.300s has no samples of this problem with these settings", folder);
    snprintf(file, sizeof file, "%.4000s/samples.csv", folder);
    Rows rows = {
        .file = file, .stream = fopen(file, "rb"), .decimal = options->csv_decimal, .error = error};
    if (rows.stream == NULL)
        return cz_fail(error, CZ_STATUS_INPUT, "%.300s cannot be read: %s", file, strerror(errno));
    CzStatus status = read_heads(&rows, sampling);
    while (status == CZ_OK && read_line(&rows, &status))
        status = read_row(&rows, sampling);
    free(rows.line);
    fclose(rows.stream);
    return status;
}
