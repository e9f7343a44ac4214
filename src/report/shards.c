/* Shards read from their result folders. */
#include "crushzone/shards.h"

#include "base/arena.h"
#include "base/error.h"
#include "report/shard.h"
#include "report/temporary.h"

#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* ---- one file ---- */

/* The file of a shard being read, line by line. */
typedef struct Lines {
    char name[PATH_MAX];
    FILE *stream;
    char *line;
    size_t room;
    long number;    /* of the line, from 1 */
    bool no_memory; /* the file or a line could not be read for lack of it */
} Lines;

static CzStatus open_lines(const char *folder, Lines *lines, CzError *error) {
    *lines = (Lines){0};
    CZ_TRY(cz_path_in(lines->name, folder, CZ_SHARD_FILE, error));
    lines->stream = fopen(lines->name, "rb");
    lines->no_memory = lines->stream == NULL && errno == ENOMEM;
    return CZ_OK;
}

static void close_lines(Lines *lines) {
    if (lines->stream != NULL)
        fclose(lines->stream);
    free(lines->line);
}

/* Reads the next complete line, without its end. */
static bool next_line(Lines *lines) {
    errno = 0;
    const ssize_t n = getline(&lines->line, &lines->room, lines->stream);
    lines->no_memory = n < 0 && errno == ENOMEM;
    if (n <= 0 || lines->line[n - 1] != '\n')
        return false;
    lines->line[n - 1] = '\0';
    lines->number++;
    return true;
}

static CzStatus damaged(const Lines *lines, const CzArena *arena, CzError *error) {
    if (arena->out_of_memory || lines->no_memory)
        return cz_no_memory(error, "the shards");
    return cz_fail(error, CZ_STATUS_INPUT, "line %ld of %.300s cannot be read as one of a shard",
                   lines->number, lines->name);
}

/* ---- what is there ---- */

/* Whether a folder should have a shard, but was not written or copied to its end. */
static bool is_half_written(const char *folder) {
    struct stat info;
    if (stat(folder, &info) != 0)
        return errno == ENOENT;
    char *marker = cz_marker_read(folder);
    const bool is = marker != NULL && cz_marker_lists(marker, "", CZ_SHARD_FILE, '\n');
    free(marker);
    return is;
}

/* Adds a folder to a list of texts. */
static CzStatus keep_folder(CzShards *shards, const char *folder, const char ***list, int *n,
                            CzError *error) {
    *list = cz_arena_grow(shards->arena, *list, *n, sizeof **list);
    const char *copy = cz_arena_copy_text(shards->arena, folder, strlen(folder));
    if (*list == NULL || copy == NULL)
        return cz_no_memory(error, "the shards");
    (*list)[(*n)++] = copy;
    return CZ_OK;
}

static CzStatus keep_due(CzShards *shards, const CzShardDue *due, CzError *error) {
    shards->due = cz_arena_grow(shards->arena, shards->due, shards->n_due, sizeof *shards->due);
    if (shards->due == NULL)
        return cz_no_memory(error, "the shards");
    shards->due[shards->n_due++] = *due;
    return CZ_OK;
}

/* Counts the lines between the head and the last one, which has their number. */
static int count_rows(Lines *lines, bool *is_whole) {
    int n = 0, n_said = -1;
    *is_whole = false;
    while (next_line(lines)) {
        if (sscanf(lines->line, "{\"rows\": %9d}", &n_said) == 1)
            *is_whole = n_said == n;
        else
            n++;
    }
    return n;
}

/* Reads the head of a shard and counts its rows. */
static CzStatus read_part(CzShards *shards, const char *folder, Lines *lines, CzError *error) {
    CzShardHead head = {0};
    bool is_whole;
    if (lines->no_memory)
        return damaged(lines, shards->arena, error);
    if (lines->stream == NULL && !is_half_written(folder))
        return cz_fail(error, CZ_STATUS_INPUT,
                       "%.300s is not the folder of a shard" CZ_HELP
                       "sample and sweep write shards with --shard I/N -o DIR",
                       folder);
    const bool is_begun = lines->stream != NULL && next_line(lines);
    if (lines->no_memory)
        return damaged(lines, shards->arena, error);
    if (!is_begun)
        return keep_folder(shards, folder, &shards->unreadable, &shards->n_unreadable, error);
    CzLineCursor cursor = {.at = lines->line, .arena = shards->arena};
    if (!cz_shard_read_head(&cursor, &head))
        return damaged(lines, shards->arena, error);
    shards->head = cz_arena_grow(shards->arena, shards->head, shards->n_part, sizeof *shards->head);
    if (shards->head == NULL)
        return cz_no_memory(error, "the shards");
    shards->head[shards->n_part] = head;
    CZ_TRY(keep_folder(shards, folder, &shards->folder, &shards->n_part, error));
    const int n_of = head.end - head.begin, n_row = count_rows(lines, &is_whole);
    if (lines->no_memory)
        return damaged(lines, shards->arena, error);
    if (is_whole && n_row == n_of)
        return CZ_OK;
    const CzShardDue due = {.shard = head.shard,
                            .folder = shards->folder[shards->n_part - 1],
                            .n_row = n_row < n_of ? n_row : n_of,
                            .n_of = n_of};
    return keep_due(shards, &due, error);
}

/* ---- differences ---- */

/* The options of a shard as one text. */
static void join_words(const CzShardHead *head, size_t room, char *text) {
    snprintf(text, room, "%s", head->n_word > 0 ? "" : "none");
    for (int i = 0; i < head->n_word; i++) {
        const size_t n = strlen(text);
        snprintf(text + n, room - n, "%s%s", i > 0 ? " " : "", head->word[i]);
    }
}

/* Reports the first difference between a shard and the first one. */
static CzStatus compare(const CzShards *shards, int part, CzError *error) {
    const CzShardHead *theirs = &shards->head[part], *ours = &shards->head[0];
    const char *their_folder = shards->folder[part], *our_folder = shards->folder[0];
    char their_words[160], our_words[160];
    join_words(theirs, sizeof their_words, their_words);
    join_words(ours, sizeof our_words, our_words);
    bool same_words = theirs->n_word == ours->n_word;
    for (int i = 0; i < ours->n_word && same_words; i++)
        same_words = strcmp(theirs->word[i], ours->word[i]) == 0;
    const struct {
        const char *what, *theirs, *ours;
        bool is_same;
    } text[] = {
        {"version of crushzone", theirs->version, ours->version,
         strcmp(theirs->version, ours->version) == 0},
        {"command", theirs->command, ours->command, strcmp(theirs->command, ours->command) == 0},
        {"list of options", their_words, our_words, same_words},
        {"problem file, by its content,", theirs->file, ours->file,
         strcmp(theirs->problem, ours->problem) == 0}};
    for (size_t i = 0; i < sizeof text / sizeof *text; i++)
        if (!text[i].is_same)
            return cz_fail(error, CZ_STATUS_INPUT,
                           "%.80s and %.80s are not shards of one run: the %s is %.150s, in "
                           "%.80s %.150s",
                           our_folder, their_folder, text[i].what, text[i].ours, their_folder,
                           text[i].theirs);
    if (theirs->n_shard != ours->n_shard || theirs->n != ours->n)
        return cz_fail(error, CZ_STATUS_INPUT,
                       "%.80s and %.80s are not shards of one run: it has %d shards of %d runs, in "
                       "%.80s %d of %d",
                       our_folder, their_folder, ours->n_shard, ours->n, their_folder,
                       theirs->n_shard, theirs->n);
    return CZ_OK;
}

static CzStatus compare_all(const CzShards *shards, CzError *error) {
    for (int k = 1; k < shards->n_part; k++)
        CZ_TRY(compare(shards, k, error));
    for (int k = 1; k < shards->n_part; k++)
        for (int i = 0; i < k; i++)
            if (shards->head[i].shard == shards->head[k].shard)
                return cz_fail(error, CZ_STATUS_INPUT, "%.150s and %.150s are both shard %d of %d",
                               shards->folder[i], shards->folder[k], shards->head[k].shard,
                               shards->head[k].n_shard);
    return CZ_OK;
}

/* ---- all shards ---- */

static int by_number(const void *a, const void *b) {
    return ((const CzShardDue *)a)->shard - ((const CzShardDue *)b)->shard;
}

/* Adds the shards that no folder has. */
static CzStatus list_missing(CzShards *shards, CzError *error) {
    const int n_shard = shards->head[0].n_shard;
    bool *is_there = cz_arena_allocate(shards->arena, (size_t)n_shard + 1, sizeof *is_there);
    if (is_there == NULL)
        return cz_no_memory(error, "the shards");
    for (int k = 0; k < shards->n_part; k++)
        is_there[shards->head[k].shard] = true;
    for (int shard = 1; shard <= n_shard; shard++)
        if (!is_there[shard])
            CZ_TRY(keep_due(shards, &(CzShardDue){.shard = shard}, error));
    if (shards->n_due > 0)
        qsort(shards->due, (size_t)shards->n_due, sizeof *shards->due, by_number);
    return CZ_OK;
}

static CzStatus read_all(CzShards *shards, int n, const char *const *folder, CzError *error) {
    for (int i = 0; i < n; i++) {
        Lines lines;
        CZ_TRY(open_lines(folder[i], &lines, error));
        const CzStatus status = read_part(shards, folder[i], &lines, error);
        close_lines(&lines);
        if (status != CZ_OK)
            return status;
    }
    if (shards->n_part == 0)
        return cz_fail(error, CZ_STATUS_INPUT, "%.300s has no shard that can be read",
                       shards->unreadable[0]);
    CZ_TRY(compare_all(shards, error));
    return list_missing(shards, error);
}

CzStatus cz_shards_read(int n, const char *const *folder, CzShards **shards, CzError *error) {
    CzShards *made = calloc(1, sizeof *made);
    if (made != NULL)
        made->arena = calloc(1, sizeof *made->arena);
    CzStatus status = cz_no_memory(error, "the shards");
    if (made != NULL && made->arena != NULL)
        status = read_all(made, n, folder, error);
    *shards = status == CZ_OK ? made : NULL;
    if (status != CZ_OK)
        cz_shards_free(made);
    return status;
}

void cz_shards_free(CzShards *shards) {
    if (shards == NULL)
        return;
    if (shards->arena != NULL)
        cz_arena_free(shards->arena);
    free(shards->arena);
    free(shards);
}

/* ---- results ---- */

/* Where the results of a shard go: one of the two. */
typedef struct Target {
    CzSampling *sampling;
    CzSweep *sweep;
} Target;

/* Reads a row, whose memory is freed at once, because there may be a million. */
static bool read_row(char *line, int k, const Target *target, CzArena *arena) {
    CzLineCursor cursor = {.at = line, .arena = arena};
    return target->sampling != NULL ? cz_shard_read_sample(&cursor, k, target->sampling)
                                    : cz_shard_read_point(&cursor, k, target->sweep);
}

static CzStatus fill_part(const CzShards *shards, int part, const Target *target, CzError *error) {
    const CzShardHead *head = &shards->head[part];
    Lines lines;
    CZ_TRY(open_lines(shards->folder[part], &lines, error));
    CzStatus status = CZ_OK;
    const bool is_begun = lines.stream != NULL && next_line(&lines);
    if (lines.no_memory)
        status = damaged(&lines, shards->arena, error);
    else if (!is_begun)
        status = cz_fail(error, CZ_STATUS_INPUT, "%.300s cannot be read any more", lines.name);
    for (int k = head->begin; k < head->end && status == CZ_OK; k++) {
        CzArena arena = {0};
        if (!next_line(&lines) || !read_row(lines.line, k, target, &arena))
            status = damaged(&lines, &arena, error);
        cz_arena_free(&arena);
    }
    close_lines(&lines);
    return status;
}

/* Fills the results of all shards that are complete. */
static CzStatus fill(const CzShards *shards, const CzProblem *problem, int n, const Target *target,
                     CzError *error) {
    const CzShardHead *head = &shards->head[0];
    if (strcmp(head->problem, cz_problem_hash(problem)) != 0 || head->n != n)
        return cz_fail(error, CZ_STATUS_INPUT,
                       "%.200s has changed since %.150s was run" CZ_HELP
                       "run all shards again, or restore the file",
                       head->file, shards->folder[0]);
    for (int part = 0; part < shards->n_part; part++)
        CZ_TRY(fill_part(shards, part, target, error));
    return CZ_OK;
}

CzStatus cz_shards_fill_samples(CzSampling *sampling, void *shards, CzError *error) {
    const Target target = {.sampling = sampling};
    return fill(shards, sampling->problem, sampling->n_sample, &target, error);
}

CzStatus cz_shards_fill_sweep(CzSweep *sweep, void *shards, CzError *error) {
    const Target target = {.sweep = sweep};
    return fill(shards, sweep->problem, sweep->n_point, &target, error);
}
