/* The lines of shard.jsonl: written and read in one order. */
#include "report/shard.h"

#include "crushzone/report.h"
#include "report/options.h"
#include "report/sample_values.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_SHARDS = 1000000 }; /* as many as samples (ours) */

/* ---- writing ---- */

bool cz_shard_is(const CzReport *report) {
    return (report->kind == CZ_REPORT_SAMPLE || report->kind == CZ_REPORT_SWEEP) &&
           cz_report_options_of(report)->shard_word != NULL;
}

static void write_head(const CzShardHead *head, FILE *stream) {
    const struct {
        const char *key, *text;
    } text[] = {{"version", head->version},
                {"command", head->command},
                {"file", head->file},
                {"problem", head->problem}};
    fputs("{\"format\": \"crushzone.shard\"", stream);
    for (size_t i = 0; i < sizeof text / sizeof *text; i++) {
        fprintf(stream, ", \"%s\": ", text[i].key);
        cz_line_write_text(text[i].text, stream);
    }
    fprintf(stream, ", \"shard\": %d, \"of\": %d, \"n\": %d, \"begin\": %d, \"end\": %d",
            head->shard, head->n_shard, head->n, head->begin, head->end);
    cz_line_write_texts("options", head->n_word, head->word, stream);
    fputs("}\n", stream);
}

static void write_key(const char *key, const char *text, FILE *stream) {
    fprintf(stream, ", \"%s\": ", key);
    cz_line_write_text(text != NULL ? text : "", stream);
}

static void write_sample(const CzSampling *sampling, int k, FILE *stream) {
    const CzSample *sample = &sampling->sample[k];
    const size_t n_draw = (size_t)sampling->n_draw, n_check = (size_t)sampling->n_check;
    const size_t row = (size_t)k * n_check;
    fprintf(stream, "{\"sample\": %d", k + 1);
    write_key("state", cz_sample_state_text(sample->state), stream);
    write_key("verdict", cz_verdict_text(sample->verdict), stream);
    fprintf(stream, ", \"beyond_validity\": %d, \"margin\": ", sample->beyond_validity);
    cz_line_write_number(sample->margin, stream);
    fprintf(stream, ", \"check\": %d, ", sample->check);
    cz_line_write_numbers("values", sampling->n_draw, &sampling->value[(size_t)k * n_draw], stream);
    cz_line_write_numbers("margins", sampling->n_check, &sampling->margin[row], stream);
    fputs("\"verdicts\": [", stream);
    for (size_t c = 0; c < n_check; c++) {
        fputs(c > 0 ? ", " : "", stream);
        cz_line_write_text(cz_verdict_text(sampling->verdict[row + c]), stream);
    }
    fputc(']', stream);
    write_key("message", sample->message, stream);
    fputs("}\n", stream);
}

static void write_point(const CzSweep *sweep, int k, FILE *stream) {
    const CzSweepPoint *point = &sweep->point[k];
    fprintf(stream, "{\"point\": %d", k + 1);
    write_key("state", cz_sweep_state_text(point->state), stream);
    write_key("verdict", cz_verdict_text(point->verdict), stream);
    fprintf(stream, ", \"beyond_validity\": %d, \"margin\": ", point->beyond_validity);
    cz_line_write_number(point->margin, stream);
    write_key("check", point->check, stream);
    write_key("scenario", point->scenario, stream);
    write_key("where", point->where, stream);
    fputs(", ", stream);
    cz_line_write_numbers("metrics", sweep->n_metric, point->metric, stream);
    fputs("\"places\": [", stream);
    for (int m = 0; m < sweep->n_metric; m++) {
        fputs(m > 0 ? ", " : "", stream);
        cz_line_write_text(point->metric_where[m], stream);
    }
    fputc(']', stream);
    write_key("message", point->message, stream);
    fputs("}\n", stream);
}

static int write_samples(const CzSampling *sampling, FILE *stream) {
    int n = 0;
    for (int k = sampling->begin; k < sampling->end; k++)
        if (sampling->sample[k].state != CZ_SAMPLE_NOT_RUN) {
            write_sample(sampling, k, stream);
            n++;
        }
    return n;
}

static int write_points(const CzSweep *sweep, FILE *stream) {
    int n = 0;
    for (int k = sweep->begin; k < sweep->end; k++)
        if (sweep->point[k].state != CZ_SWEEP_NOT_RUN) {
            write_point(sweep, k, stream);
            n++;
        }
    return n;
}

void cz_shard_write(const CzReport *report, FILE *stream) {
    const CzReportOptions *options = cz_report_options_of(report);
    const CzSampling *sampling = report->sampling;
    const CzSweep *sweep = report->sweep;
    const bool samples = report->kind == CZ_REPORT_SAMPLE;
    const CzProblem *problem = samples ? sampling->problem : sweep->problem;
    const CzShardHead head = {.version = cz_version(),
                              .command = samples ? "sample" : "sweep",
                              .file = cz_problem_file(problem),
                              .problem = cz_problem_hash(problem),
                              .shard = samples ? sampling->shard : sweep->shard,
                              .n_shard = samples ? sampling->n_shard : sweep->n_shard,
                              .n = samples ? sampling->n_sample : sweep->n_point,
                              .begin = samples ? sampling->begin : sweep->begin,
                              .end = samples ? sampling->end : sweep->end,
                              .word = options->shard_word,
                              .n_word = options->n_shard_word};
    write_head(&head, stream);
    const int n = samples ? write_samples(sampling, stream) : write_points(sweep, stream);
    fprintf(stream, "{\"rows\": %d}\n", n);
}

/* ---- reading ---- */

static const char *read_key(CzLineCursor *cursor, const char *key) {
    cz_line_expect(cursor, ", \"");
    cz_line_expect(cursor, key);
    cz_line_expect(cursor, "\": ");
    return cz_line_text(cursor);
}

/* A whole number within bounds. */
static int read_whole(CzLineCursor *cursor, const char *before, long lo, long hi) {
    const long value = cz_line_integer(cursor, before);
    cursor->failed |= value < lo || value > hi;
    return cursor->failed ? (int)lo : (int)value;
}

bool cz_shard_read_head(CzLineCursor *cursor, CzShardHead *head) {
    static const char format[] = "{\"format\": \"crushzone.shard\"";
    const long most = 1000000000;
    cz_line_expect(cursor, format);
    head->version = read_key(cursor, "version");
    head->command = read_key(cursor, "command");
    head->file = read_key(cursor, "file");
    head->problem = read_key(cursor, "problem");
    head->shard = read_whole(cursor, ", \"shard\": ", 1, MAX_SHARDS);
    head->n_shard = read_whole(cursor, ", \"of\": ", head->shard, MAX_SHARDS);
    head->n = read_whole(cursor, ", \"n\": ", 1, most);
    head->begin = read_whole(cursor, ", \"begin\": ", 0, head->n);
    head->end = read_whole(cursor, ", \"end\": ", head->begin, head->n);
    head->word = cz_line_texts(cursor, ", \"options\": [", &head->n_word);
    cz_line_expect(cursor, "}");
    return !cursor->failed && *cursor->at == '\0';
}

static const char *state_of_sample(int index) {
    return cz_sample_state_text((CzSampleState)index);
}

static const char *state_of_point(int index) {
    return cz_sweep_state_text((CzSweepState)index);
}

static const char *verdict_of(int index) {
    return cz_verdict_text((CzVerdict)index);
}

/* The index of a text among n words. */
static int find_word(CzLineCursor *cursor, const char *text, int n, const char *(*word)(int)) {
    for (int i = 0; i < n && !cursor->failed; i++)
        if (strcmp(text, word(i)) == 0)
            return i;
    cursor->failed = true;
    return 0;
}

static CzVerdict read_verdict(CzLineCursor *cursor, const char *text) {
    return (CzVerdict)find_word(cursor, text, CZ_VERDICT_NOT_CHECKED + 1, verdict_of);
}

/* The front of a line, which is that of samples and points. */
typedef struct Front {
    int state;
    CzVerdict verdict;
    bool beyond_validity;
    double margin;
} Front;

static Front read_front(CzLineCursor *cursor, const char *before, int k, int n_state,
                        const char *(*state)(int)) {
    Front front;
    (void)read_whole(cursor, before, k + 1L, k + 1L);
    front.state = find_word(cursor, read_key(cursor, "state"), n_state, state);
    front.verdict = read_verdict(cursor, read_key(cursor, "verdict"));
    front.beyond_validity = read_whole(cursor, ", \"beyond_validity\": ", 0, 1) != 0;
    cz_line_expect(cursor, ", \"margin\": ");
    front.margin = cz_line_number(cursor);
    return front;
}

/* The message at the end of a line. */
static const char *read_message(CzLineCursor *cursor) {
    const char *message = read_key(cursor, "message");
    cz_line_expect(cursor, "}");
    cursor->failed |= *cursor->at != '\0';
    return message;
}

/* Values of the draws, which must be those of this sample. */
static void read_values(CzLineCursor *cursor, int k, const CzSampling *sampling) {
    int n;
    const double *value = cz_line_numbers(cursor, "\"values\": [", &n);
    cursor->failed |= n != sampling->n_draw;
    for (int d = 0; d < n && !cursor->failed; d++)
        cursor->failed = !(value[d] == cz_sample_value(sampling, k, d));
}

/* Margins and verdicts of the checks. */
static void read_checks(CzLineCursor *cursor, int k, CzSampling *sampling) {
    const size_t row = (size_t)k * (size_t)sampling->n_check;
    int n_margin, n_verdict;
    const double *margin = cz_line_numbers(cursor, "\"margins\": [", &n_margin);
    const char *const *verdict = cz_line_texts(cursor, "\"verdicts\": [", &n_verdict);
    cursor->failed |= n_margin != sampling->n_check || n_verdict != sampling->n_check;
    for (int c = 0; c < sampling->n_check && !cursor->failed; c++) {
        sampling->margin[row + (size_t)c] = margin[c];
        sampling->verdict[row + (size_t)c] = read_verdict(cursor, verdict[c]);
    }
}

bool cz_shard_read_sample(CzLineCursor *cursor, int k, CzSampling *sampling) {
    const Front front = read_front(cursor, "{\"sample\": ", k, CZ_SAMPLE_NOT_RUN, state_of_sample);
    CzSample read = {.state = (CzSampleState)front.state,
                     .verdict = front.verdict,
                     .beyond_validity = front.beyond_validity,
                     .margin = front.margin};
    read.check = read_whole(cursor, ", \"check\": ", -1, sampling->n_check - 1L);
    cz_line_expect(cursor, ", ");
    read_values(cursor, k, sampling);
    read_checks(cursor, k, sampling);
    const char *message = read_message(cursor);
    if (cursor->failed)
        return false;
    if (message[0] != '\0') {
        read.message = malloc(strlen(message) + 1);
        cursor->arena->out_of_memory |= read.message == NULL;
        if (read.message == NULL)
            return false;
        memcpy(read.message, message, strlen(message) + 1);
    }
    free(sampling->sample[k].message);
    sampling->sample[k] = read;
    return true;
}

/* A text into an array of `room` bytes. */
static void keep_text(CzLineCursor *cursor, const char *text, size_t room, char *kept) {
    cursor->failed |= strlen(text) >= room;
    if (!cursor->failed)
        memcpy(kept, text, strlen(text) + 1);
}

bool cz_shard_read_point(CzLineCursor *cursor, int k, CzSweep *sweep) {
    CzSweepPoint *point = &sweep->point[k];
    CzSweepPoint read = *point;
    int n_metric, n_place;
    const Front front = read_front(cursor, "{\"point\": ", k, CZ_SWEEP_NOT_RUN, state_of_point);
    read.state = (CzSweepState)front.state;
    read.verdict = front.verdict;
    read.beyond_validity = front.beyond_validity;
    read.margin = front.margin;
    keep_text(cursor, read_key(cursor, "check"), sizeof read.check, read.check);
    keep_text(cursor, read_key(cursor, "scenario"), sizeof read.scenario, read.scenario);
    keep_text(cursor, read_key(cursor, "where"), sizeof read.where, read.where);
    const double *metric = cz_line_numbers(cursor, ", \"metrics\": [", &n_metric);
    const char *const *place = cz_line_texts(cursor, "\"places\": [", &n_place);
    cursor->failed |= n_metric != sweep->n_metric || n_place != sweep->n_metric;
    for (int m = 0; m < sweep->n_metric && !cursor->failed; m++) {
        read.metric[m] = metric[m];
        keep_text(cursor, place[m], sizeof read.metric_where[m], read.metric_where[m]);
    }
    keep_text(cursor, read_message(cursor), sizeof read.message, read.message);
    if (!cursor->failed)
        *point = read;
    return !cursor->failed;
}
