/* The journal of a search in its result folder.
 *
 * A search that has no result yet has a folder with its journal, its best design and a marker. A
 * folder with earlier results keeps them until the search has ended: journal and best design are
 * then in the subfolder `unfinished`. The marker is locked as long as the search runs.
 */
#include "base/clock.h"
#include "base/error.h"
#include "report/folder.h"
#include "report/journal.h"
#include "report/overlay.h"
#include "report/temporary.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#define BELOW "unfinished"
#define HISTORY "history.jsonl"
#define BEST "optimised.yaml"

/* Longest time between writing an evaluation and its arrival on the disk (ours). A process that is
 * killed loses nothing that is written; only a power failure does. [s] */
static const double sync_interval = 1;

struct CzJournalFile {
    CzArena arena;
    char folder[PATH_MAX];
    char marker[PATH_MAX];
    char place[PATH_MAX]; /* folder of the journal: the result folder or the one below */
    char path[PATH_MAX];  /* the journal itself */
    char from[PATH_MAX];  /* the journal that is read */
    bool is_whole;        /* the folder has earlier results */
    bool resumes;
    bool is_made; /* this process created the journal */
    int lock;     /* the marker, open and locked; -1 before the folder exists */
    CzJournalText text;
    CzJournalStart start;
    const CzReport *report;
    CzJournal journal;
    FILE *stream;
    double synced; /* time of the last arrival on the disk [s] */
};

/* ---- places ---- */

static CzStatus in_use(const CzJournalFile *file, CzError *error) {
    return cz_fail(error, CZ_STATUS_OUTPUT,
                   "another process is searching in the folder %.300s; choose another one with -o",
                   file->folder);
}

/* Locks the marker of an existing folder, so that only one search uses it. Without locks, as on
 * some network file systems, nothing is refused. */
static CzStatus lock_marker(CzJournalFile *file, CzError *error) {
    file->lock = open(file->marker, O_RDWR | O_NOFOLLOW | O_CLOEXEC);
    const bool is_there = file->lock >= 0 || errno != ENOENT;
    if (file->lock < 0)
        return is_there ? cz_cannot_write(file->marker, errno, error) : CZ_OK;
    return flock(file->lock, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK ? in_use(file, error)
                                                                             : CZ_OK;
}

/* Whether a journal has an evaluation. */
static CzStatus look_into(const char *path, bool *has_any, CzError *error) {
    FILE *stream = fopen(path, "r");
    int n_line = 0;
    *has_any = false;
    if (stream == NULL)
        return errno == ENOENT ? CZ_OK : cz_cannot_write(path, errno, error);
    for (int byte; n_line < 2 && (byte = fgetc(stream)) != EOF;)
        n_line += byte == '\n';
    fclose(stream);
    *has_any = n_line == 2;
    return CZ_OK;
}

/* Chooses the folder of the journal, and finds the one to read. */
static CzStatus find_place(CzJournalFile *file, CzError *error) {
    struct stat info;
    errno = 0;
    char *marker = cz_marker_read(file->folder);
    if (marker == NULL && errno == ENOMEM)
        return cz_cannot_write(file->folder, errno, error);
    file->is_whole = marker != NULL && cz_marker_is_whole(marker);
    free(marker);
    if (file->is_whole)
        CZ_TRY(cz_path_in(file->place, file->folder, BELOW, error));
    else
        snprintf(file->place, sizeof file->place, "%s", file->folder);
    CZ_TRY(cz_path_in(file->path, file->place, HISTORY, error));
    snprintf(file->from, sizeof file->from, "%s", file->path);
    if (file->is_whole && lstat(file->path, &info) != 0)
        return cz_path_in(file->from, file->folder, HISTORY, error);
    return CZ_OK;
}

static CzStatus read_journal(CzJournalFile *file, CzError *error) {
    FILE *stream = fopen(file->from, "r");
    if (stream == NULL && errno == ENOMEM)
        return cz_no_memory(error, "the journal");
    if (stream == NULL)
        return cz_fail(error, CZ_STATUS_INPUT,
                       "%.200s has no search that can be resumed: %.200s cannot be read: %s",
                       file->folder, file->from, strerror(errno));
    const CzStatus status = cz_journal_read(file->from, stream, &file->arena, &file->text, error);
    fclose(stream);
    return status;
}

static CzStatus open_folder(CzJournalFile *file, const char *folder, CzError *error) {
    size_t n = strlen(folder);
    while (n > 1 && folder[n - 1] == '/')
        n--;
    if (n >= PATH_MAX)
        return cz_cannot_write(folder, ENAMETOOLONG, error);
    snprintf(file->folder, sizeof file->folder, "%.*s", (int)n, folder);
    CZ_TRY(cz_path_in(file->marker, file->folder, CZ_MARKER_NAME, error));
    (void)cz_report_restore_folder(file->folder);
    CZ_TRY(lock_marker(file, error));
    CZ_TRY(find_place(file, error));
    if (file->resumes)
        return read_journal(file, error);
    bool has_any;
    CZ_TRY(look_into(file->path, &has_any, error));
    if (!has_any)
        return CZ_OK;
    return cz_fail(error, CZ_STATUS_OUTPUT,
                   "the folder %.150s contains a search that has not ended" CZ_HELP
                   "go on with --resume %.150s, choose another folder with -o, or remove it",
                   file->folder, file->folder);
}

CzStatus cz_journal_open(const char *folder, bool resumes, CzJournalFile **file, CzError *error) {
    *file = calloc(1, sizeof **file);
    if (*file == NULL)
        return cz_no_memory(error, "the journal");
    (*file)->resumes = resumes;
    (*file)->lock = -1;
    const CzStatus status = open_folder(*file, folder, error);
    if (status == CZ_OK)
        return CZ_OK;
    cz_journal_end(*file, false);
    *file = NULL;
    return status;
}

bool cz_journal_is_open(const char *folder) {
    char marker[PATH_MAX];
    char *lines = cz_marker_read(folder);
    const bool is_of_search =
        lines != NULL &&
        (!cz_marker_is_whole(lines) || cz_marker_lists(lines, "", BELOW "/" HISTORY, '\n'));
    free(lines);
    if (!is_of_search || cz_path_in(marker, folder, CZ_MARKER_NAME, NULL) != CZ_OK)
        return false;
    const int descriptor = open(marker, O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
    const bool is_open =
        descriptor >= 0 && flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (descriptor >= 0)
        close(descriptor);
    return is_open;
}

const CzJournalHead *cz_journal_head(const CzJournalFile *file) {
    return file->resumes ? &file->text.start.head : NULL;
}

const char *cz_journal_path(const CzJournalFile *file) {
    return file->path;
}

/* ---- the best design ---- */

typedef struct Best {
    const CzReport *report;
    const char *place;
    long n_evaluation;
    double violation;
} Best;

static CzStatus write_best(const void *data, FILE *stream, CzError *error) {
    const Best *best = data;
    fprintf(stream, "# The best design of %ld evaluations of a search that has not ended: it %s.\n",
            best->n_evaluation,
            best->violation <= 0 ? "satisfies every constraint but is not verified"
                                 : "VIOLATES A CONSTRAINT");
    CZ_TRY(cz_overlay_write_design(best->report, best->place, stream, error));
    if (fflush(stream) == 0)
        (void)fsync(fileno(stream)); /* as far as the disk can */
    return CZ_OK;
}

static CzStatus keep_best(const CzJournalFile *file, const CzNews *news, CzError *error) {
    char path[PATH_MAX];
    CzOutcome outcome = {.n_variable = file->start.n_variable, .best = (double *)news->best};
    CzReport report = *file->report;
    report.outcome = &outcome;
    const Best best = {&report, file->place, news->n_evaluation, news->best_violation};
    CZ_TRY(cz_path_in(path, file->place, BEST, error));
    return cz_report_write_file(path, write_best, &best, error);
}

/* ---- evaluations ---- */

/* Passes what is written to the system, and to the disk when the interval is over. */
static CzStatus flush(CzJournalFile *file, CzError *error) {
    const double now = cz_clock();
    if (fflush(file->stream) != 0)
        return cz_cannot_write(file->path, errno, error);
    if (now - file->synced < sync_interval)
        return CZ_OK;
    file->synced = now;
    if (fsync(fileno(file->stream)) == 0 || errno == EINVAL) /* not a file of a disk */
        return CZ_OK;
    return cz_cannot_write(file->path, errno, error);
}

static CzStatus keep(const CzNews *news, void *data, CzError *error) {
    CzJournalFile *file = data;
    for (int i = 0; i < news->n; i++)
        cz_journal_write_entry(&file->start, news, i, file->stream);
    CzStatus status = flush(file, error);
    if (status == CZ_OK && news->best != NULL && file->report->kind == CZ_REPORT_SEARCH)
        status = keep_best(file, news, error);
    if (status == CZ_STATUS_OUTPUT && error != NULL)
        cz_error_help(error, "continue the search with --resume %.200s", file->folder);
    return status;
}

/* ---- the beginning ---- */

/* The options of a search as one text. */
static void join_words(const CzJournalHead *head, size_t room, char *text) {
    text[0] = '\0';
    for (int i = 0; i < head->n_word; i++) {
        const size_t n = strlen(text);
        snprintf(text + n, room - n, "%s%s", i > 0 ? " " : "", head->word[i]);
    }
}

/* Reports the first difference between the search of the journal and this one. */
static CzStatus compare(const CzJournalFile *file, CzError *error) {
    const CzJournalStart *theirs = &file->text.start, *ours = &file->start;
    char their_words[400] = "", our_words[400] = "";
    if (file->report->kind == CZ_REPORT_PARETO) { /* the order of its searches depends on them */
        join_words(&theirs->head, sizeof their_words, their_words);
        join_words(&ours->head, sizeof our_words, our_words);
    }
    const struct {
        const char *what, *theirs, *ours;
    } text[] = {{"command", theirs->command, ours->command},
                {"version of crushzone", theirs->version, ours->version},
                {"version of NLopt", theirs->nlopt, ours->nlopt},
                {"problem, with its settings,", theirs->problem, ours->problem},
                {"algorithm", theirs->head.algorithm, ours->head.algorithm},
                {"list of options", their_words, our_words}};
    const struct {
        const char *what;
        long theirs, ours;
    } number[] = {{"seed", theirs->head.seed, ours->head.seed},
                  {"width", theirs->head.width, ours->head.width},
                  {"number of variables", theirs->n_variable, ours->n_variable},
                  {"number of constraints", theirs->n_constraint, ours->n_constraint},
                  {"number of details", theirs->n_detail, ours->n_detail}};
    static const char is_another[] = "%.200s is the journal of another search: its ";
    char begin[sizeof is_another + 200];
    snprintf(begin, sizeof begin, is_another, file->from);
    for (size_t i = 0; i < sizeof text / sizeof *text; i++)
        if (strcmp(text[i].theirs, text[i].ours) != 0)
            return cz_fail(error, CZ_STATUS_INPUT, "%s%s is %.120s, here it is %.120s", begin,
                           text[i].what, text[i].theirs, text[i].ours);
    for (size_t i = 0; i < sizeof number / sizeof *number; i++)
        if (number[i].theirs != number[i].ours)
            return cz_fail(error, CZ_STATUS_INPUT, "%s%s is %ld, here it is %ld", begin,
                           number[i].what, number[i].theirs, number[i].ours);
    if (theirs->head.evaluations > ours->head.evaluations)
        return cz_fail(error, CZ_STATUS_INPUT,
                       "%slimit is %ld evaluations, which can only be raised, not lowered to %ld",
                       begin, theirs->head.evaluations, ours->head.evaluations);
    return CZ_OK;
}

/* Creates the result folder with a marker that is locked and lists the files; as a whole, by its
 * final name. */
static CzStatus make_folder(CzJournalFile *file, CzError *error) {
    char parent[PATH_MAX], made[PATH_MAX];
    FILE *marker = NULL;
    cz_parent_of(file->folder, parent);
    cz_make_parents(file->folder);
    int why = cz_temporary_folder(parent, made, &marker);
    if (why != 0)
        return cz_cannot_write(file->folder, why, error);
    if (fputs(CZ_MARKER_HEAD HISTORY "\n" BEST "\n", marker) == EOF || fflush(marker) != 0 ||
        rename(made, file->folder) != 0)
        why = errno;
    if (why == 0)
        file->lock = dup(fileno(marker)); /* of the same lock */
    else
        cz_remove_listed(made);
    fclose(marker);
    if (why == ENOTEMPTY || why == EEXIST)
        return in_use(file, error);
    return why == 0 ? CZ_OK : cz_cannot_write(file->folder, why, error);
}

/* Creates the folder below and lists its files in the marker of the earlier results. */
static CzStatus make_below(const CzJournalFile *file, CzError *error) {
    static const char *const listed[] = {BELOW "/" HISTORY, BELOW "/" BEST};
    char *marker = cz_marker_read(file->folder);
    for (int i = 0; i < 2; i++)
        if (marker == NULL || !cz_marker_lists(marker, "", listed[i], '\n'))
            cz_marker_add(file->folder, "", listed[i]);
    free(marker);
    if (mkdir(file->place, 0777) != 0 && errno != EEXIST)
        return cz_cannot_write(file->place, errno, error);
    return CZ_OK;
}

/* Copies the evaluations of the journal that was read. */
static bool copy_earlier(const CzJournalFile *file, FILE *stream) {
    char block[1 << 14];
    long left = file->text.n_whole - file->text.n_head;
    FILE *earlier = fopen(file->from, "r");
    bool is_read = earlier != NULL && fseek(earlier, file->text.n_head, SEEK_SET) == 0;
    while (left > 0 && is_read) {
        const size_t most = left < (long)sizeof block ? (size_t)left : sizeof block;
        const size_t n = fread(block, 1, most, earlier);
        is_read = n > 0;
        (void)fwrite(block, 1, n, stream);
        left -= (long)n;
    }
    if (earlier != NULL)
        fclose(earlier);
    return is_read;
}

/* Writes the head, and the evaluations of the journal that was read. */
static CzStatus write_beginning(const void *data, FILE *stream, CzError *error) {
    const CzJournalFile *file = data;
    CZ_TRY(cz_journal_write_head(&file->start, file->report, stream, error));
    if (file->resumes && !copy_earlier(file, stream))
        return cz_fail(error, CZ_STATUS_OUTPUT, "%.300s cannot be copied", file->from);
    if (fflush(stream) == 0)
        (void)fsync(fileno(stream));
    return CZ_OK;
}

/* Opens the journal to continue it: the same one without its torn line, or a new one. */
static CzStatus open_journal(CzJournalFile *file, CzError *error) {
    const bool is_same = file->resumes && strcmp(file->from, file->path) == 0 &&
                         file->text.start.head.evaluations == file->start.head.evaluations;
    file->is_made = !file->resumes;
    cz_temporary_clear(file->place);
    if (!is_same)
        CZ_TRY(cz_report_write_file(file->path, write_beginning, file, error));
    const int descriptor = open(file->path, O_WRONLY | O_APPEND | O_NOFOLLOW | O_CLOEXEC);
    if (descriptor < 0)
        return cz_cannot_write(file->path, errno, error);
    if (is_same && ftruncate(descriptor, file->text.n_whole) != 0) {
        const int why = errno;
        close(descriptor);
        return cz_cannot_write(file->path, why, error);
    }
    file->stream = fdopen(descriptor, "ab");
    if (file->stream == NULL) {
        close(descriptor);
        return cz_no_memory(error, "the journal");
    }
    return CZ_OK;
}

CzStatus cz_journal_begin(CzJournalFile *file, const CzReport *report, CzOptimiseOptions *options,
                          CzError *error) {
    CzJournalStart *start = &file->start;
    const CzJournalStart *theirs = &file->text.start;
    file->report = report;
    if (!cz_journal_start(report, options, &file->arena, start))
        return cz_no_memory(error, "the journal");
    if (file->resumes)
        CZ_TRY(compare(file, error));
    start->n_earlier = start->head.evaluations > theirs->head.evaluations ? theirs->head.n_answer
                                                                          : theirs->n_earlier;
    if (file->lock < 0)
        CZ_TRY(make_folder(file, error));
    else if (file->is_whole)
        CZ_TRY(make_below(file, error));
    CZ_TRY(open_journal(file, error));
    file->synced = cz_clock();
    file->journal = (CzJournal){.n_answer = theirs->head.n_answer,
                                .answer = file->text.answer,
                                .n_earlier = file->resumes ? start->n_earlier : 0,
                                .keep = keep,
                                .keep_data = file};
    options->journal = &file->journal;
    return CZ_OK;
}

void cz_journal_end(CzJournalFile *file, bool removes) {
    if (file == NULL)
        return;
    char best[PATH_MAX];
    if (file->stream != NULL)
        fclose(file->stream);
    if (removes && file->is_made && !file->is_whole) {
        cz_remove_listed(file->folder);
    } else if (removes && file->is_made) {
        (void)unlink(file->path);
        if (cz_path_in(best, file->place, BEST, NULL) == CZ_OK)
            (void)unlink(best);
        (void)rmdir(file->place);
    }
    if (file->lock >= 0)
        close(file->lock); /* releases it */
    cz_arena_free(&file->arena);
    free(file);
}
