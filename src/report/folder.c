/* A folder of result files that is put in place as a whole. */
#define _XOPEN_SOURCE 700 /* realpath */
#include "report/folder.h"

#include "base/error.h"
#include "base/text.h"
#include "crushzone/report.h"
#include "report/temporary.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- checks of an existing folder ---- */

/* The last part of a path. */
static const char *name_of(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

/* Resolves links in a path; false when it does not exist. */
static bool resolve(const char *path, char resolved[PATH_MAX]) {
    char *found = realpath(path, NULL);
    const bool is_there = found != NULL && strlen(found) < PATH_MAX;
    if (is_there)
        snprintf(resolved, PATH_MAX, "%s", found);
    free(found);
    return is_there;
}

bool cz_folder_lists(const char *file) {
    char folder[PATH_MAX], name[PATH_MAX] = "";
    cz_parent_of(file, folder);
    snprintf(name, sizeof name, "%.255s", name_of(file));
    for (int depth = 0; depth < 2; depth++) {
        char above[PATH_MAX], resolved[PATH_MAX], longer[PATH_MAX];
        char *marker = cz_marker_read(folder);
        const bool is_listed = marker != NULL && cz_marker_lists(marker, "", name, '\n');
        free(marker);
        if (is_listed)
            return true;
        if (!resolve(folder, resolved)) /* "." has no name */
            return false;
        snprintf(longer, sizeof longer, "%.255s/%.1000s", name_of(resolved), name);
        memcpy(name, longer, sizeof name);
        cz_parent_of(resolved, above);
        memcpy(folder, above, sizeof folder);
    }
    return false;
}

/* Looks for a file that crushzone did not write, in the folder and the folders in it. */
static bool find_foreign(const char *folder, const char *marker, const char *prefix,
                         char foreign[PATH_MAX]) {
    DIR *entries = opendir(folder);
    bool found = entries == NULL && errno != ENOENT; /* another process has removed it */
    snprintf(foreign, PATH_MAX, "%s", prefix);
    struct dirent *entry;
    while (!found && entries != NULL && (entry = readdir(entries)) != NULL) {
        char path[PATH_MAX], name[PATH_MAX];
        struct stat info;
        const char *own = entry->d_name;
        if (cz_is_temporary(own) || strcmp(own, ".") == 0 || strcmp(own, "..") == 0 ||
            (prefix[0] == '\0' && strcmp(own, CZ_MARKER_NAME) == 0))
            continue;
        snprintf(name, sizeof name, "%.*s%s", 2048, prefix, own);
        const bool is_folder = cz_path_in(path, folder, own, NULL) == CZ_OK &&
                               lstat(path, &info) == 0 && S_ISDIR(info.st_mode);
        found = !cz_marker_lists(marker, "", name, is_folder ? '/' : '\n');
        if (found)
            snprintf(foreign, PATH_MAX, "%s", name);
        else if (is_folder)
            found = find_foreign(path, marker, strcat(name, "/"), foreign);
    }
    if (entries != NULL)
        closedir(entries);
    return found;
}

static bool is_empty_folder(const char *path) {
    DIR *entries = opendir(path);
    int n = 0;
    while (entries != NULL && n < 3 && readdir(entries) != NULL)
        n++;
    if (entries != NULL)
        closedir(entries);
    return n == 2; /* . and .. */
}

/* Removes slashes at the end of a path; fails for a path that cannot be a result folder. */
static CzStatus clean_path(const char *path, char clean[PATH_MAX], CzError *error) {
    enum { SIZE_INSIDE = 256 }; /* for the longest name of a file in it */
    char what[CZ_FAULT_SIZE];
    size_t n = strlen(path), at;
    while (n > 1 && path[n - 1] == '/')
        n--;
    if (n == 0 || n > PATH_MAX - SIZE_INSIDE)
        return cz_fail(error, CZ_STATUS_OUTPUT, "the name of the result folder is %s",
                       n == 0 ? "empty" : "too long");
    if (cz_text_fault(path, n, false, &at, what))
        return cz_fail(error, CZ_STATUS_OUTPUT, "the name of the result folder contains %s", what);
    snprintf(clean, PATH_MAX, "%.*s", (int)n, path);
    const char *name = name_of(clean);
    if (name[0] == '\0' || strcmp(name, ".") == 0 || strcmp(name, "..") == 0)
        return cz_fail(
            error, CZ_STATUS_OUTPUT,
            "the result folder cannot be '%.100s': it is replaced as a whole; choose another name",
            clean);
    return CZ_OK;
}

bool cz_folder_holds(const char *folder, const char *file) {
    char above[PATH_MAX], below[PATH_MAX];
    if (!resolve(folder, above) || !resolve(file, below))
        return false;
    const size_t n = strlen(above);
    return strncmp(above, below, n) == 0 && (below[n] == '/' || below[n] == '\0');
}

/* Reads the marker of a folder, again when another process put a new folder in its place
 * meanwhile; *is_there is whether there is a folder without one. */
static char *read_marker(const char *path, bool *is_there) {
    struct stat before, after;
    char *marker = NULL;
    bool is_new = true;
    *is_there = false;
    while (marker == NULL && is_new) {
        const bool was_there = stat(path, &before) == 0;
        errno = 0;
        marker = cz_marker_read(path);
        const int reason = errno;
        *is_there = stat(path, &after) == 0;
        is_new = *is_there && reason != ENOMEM &&
                 (!was_there || before.st_dev != after.st_dev || before.st_ino != after.st_ino);
        errno = reason;
    }
    return marker;
}

/* Checks that a folder holds only files of crushzone. */
static CzStatus check_content(const char *path, bool replaces_search, CzError *error) {
    char foreign[PATH_MAX];
    bool is_there;
    char *marker = read_marker(path, &is_there);
    if (marker == NULL && errno == ENOMEM)
        return cz_cannot_write(path, errno, error);
    if (marker == NULL && !is_there)
        return CZ_OK; /* another process has removed it */
    if (marker == NULL)
        return cz_fail(error, CZ_STATUS_OUTPUT,
                       "the folder %.200s exists and was not written by crushzone; choose "
                       "another one with -o",
                       path);
    errno = 0;
    const bool has_foreign = find_foreign(path, marker, "", foreign);
    const bool has_memory = !has_foreign || errno != ENOMEM;
    const bool is_search = cz_marker_lists(marker, "", "outcome.json", '\n');
    const bool has_journal =
        cz_marker_lists(marker, "", "history.jsonl", '\n') && !cz_marker_is_whole(marker);
    free(marker);
    if (!has_memory)
        return cz_cannot_write(path, ENOMEM, error);
    if (has_foreign)
        return cz_fail(error, CZ_STATUS_OUTPUT,
                       "the folder %.150s contains %.150s, which crushzone did not write; move it "
                       "or choose another folder with -o",
                       path, foreign);
    const bool has_below = cz_path_in(foreign, path, "unfinished/history.jsonl", NULL) == CZ_OK &&
                           access(foreign, F_OK) == 0;
    if ((is_search || has_journal || has_below) && !replaces_search)
        return cz_fail(error, CZ_STATUS_OUTPUT,
                       "the folder %.150s contains %s; choose another folder with -o, or replace "
                       "it with --force",
                       path,
                       has_journal || has_below ? "a search that has not ended"
                                                : "the result of a search");
    return CZ_OK;
}

/* Checks that an existing folder can be moved: it is not a mount point and does not contain the
 * current folder. rmdir() of a folder that is not empty fails with EBUSY at a mount point; an empty
 * folder is created again. */
static CzStatus check_movable(const char *path, const struct stat *info, CzError *error) {
    if (cz_folder_holds(path, "."))
        return cz_fail(
            error, CZ_STATUS_OUTPUT,
            "the result folder %.200s cannot be replaced: it contains the current folder", path);
    if (rmdir(path) == 0)
        return mkdir(path, info->st_mode & 07777) == 0 || errno == EEXIST
                   ? CZ_OK
                   : cz_cannot_write(path, errno, error);
    if (errno == EBUSY)
        return cz_fail(error, CZ_STATUS_OUTPUT,
                       "the result folder %.200s cannot be replaced: a file system is mounted "
                       "there; choose a folder in it",
                       path);
    /* ENOENT: another process is replacing it. */
    return errno == ENOTEMPTY || errno == EEXIST || errno == ENOENT
               ? CZ_OK
               : cz_cannot_write(path, errno, error);
}

static CzStatus check_target(const char *path, bool replaces_search, CzError *error) {
    struct stat info;
    if (lstat(path, &info) != 0)
        return errno == ENOENT || errno == ENOTDIR ? CZ_OK : cz_cannot_write(path, errno, error);
    if (S_ISLNK(info.st_mode))
        return cz_fail(
            error, CZ_STATUS_OUTPUT,
            "%.200s is a link, which crushzone does not follow; choose another folder with -o",
            path);
    if (!S_ISDIR(info.st_mode))
        return cz_fail(error, CZ_STATUS_OUTPUT,
                       "%.200s exists and is not a folder; choose another one with -o", path);
    if (!is_empty_folder(path))
        CZ_TRY(check_content(path, replaces_search, error));
    return check_movable(path, &info, error);
}

/* Whether the last part of a path is "..". */
static bool steps_up(const char *path) {
    return strcmp(name_of(path), "..") == 0;
}

/* Checks that a folder can be created: a trial folder is created and removed in the nearest folder
 * above that exists. */
static CzStatus check_parents(const char *path, CzError *error) {
    char parent[PATH_MAX], above[PATH_MAX], trial[PATH_MAX];
    struct stat info;
    cz_parent_of(path, parent);
    while (stat(parent, &info) != 0 && errno == ENOENT && strcmp(parent, ".") != 0) {
        if (steps_up(parent)) /* once made, it could lead to a folder that was not checked */
            return cz_fail(
                error, CZ_STATUS_OUTPUT,
                "%.200s cannot be written: '..' leads out of a folder that does not exist", path);
        cz_parent_of(parent, above);
        memcpy(parent, above, sizeof parent);
    }
    if (stat(parent, &info) != 0 && errno != ENOTDIR)
        return cz_cannot_write(path, errno, error);
    if (stat(parent, &info) != 0 || !S_ISDIR(info.st_mode))
        return cz_fail(error, CZ_STATUS_OUTPUT, "%.200s cannot be written: %.200s is not a folder",
                       path, parent);
    int why = cz_temporary_name(parent, trial);
    if (why == 0 && mkdir(trial, 0777) == 0) {
        (void)rmdir(trial);
        return CZ_OK;
    }
    why = why != 0 ? why : errno;
    return cz_fail(error, CZ_STATUS_OUTPUT, "%.200s cannot be written: the folder %.200s: %s", path,
                   parent, strerror(why));
}

/* ---- folders of processes that were killed while replacing one ---- */

/* Folders of a dead process; paths are empty when there is none. */
typedef struct Left {
    const char *name;     /* of the folder that the process was replacing */
    char made[PATH_MAX];  /* the new results, whole */
    char moved[PATH_MAX]; /* the results before them */
} Left;

static void look_at(const char *path, const struct stat *info, void *data) {
    Left *left = data;
    char *marker = NULL;
    if (S_ISDIR(info->st_mode) && info->st_uid == geteuid())
        marker = cz_marker_read(path);
    if (marker != NULL && cz_marker_is_whole(marker)) {
        if (cz_marker_lists(marker, CZ_MARKER_MOVED, left->name, '\n'))
            snprintf(left->moved, PATH_MAX, "%s", path);
        else if (cz_marker_lists(marker, CZ_MARKER_MADE_FOR, left->name, '\n'))
            snprintf(left->made, PATH_MAX, "%s", path);
    }
    free(marker);
}

/* Renames a folder unless a process is using it. */
static bool put_back(const char *from, const char *to) {
    char marker[PATH_MAX];
    if (from[0] == '\0' || cz_path_in(marker, from, CZ_MARKER_NAME, NULL) != CZ_OK)
        return false;
    const int lock = cz_temporary_take(marker);
    const bool is_back = lock >= 0 && rename(from, to) == 0;
    if (lock >= 0)
        close(lock);
    return is_back;
}

bool cz_report_restore_folder(const char *path) {
    char parent[PATH_MAX], clean[PATH_MAX];
    struct stat info;
    if (strlen(path) >= PATH_MAX || lstat(path, &info) == 0)
        return false;
    snprintf(clean, sizeof clean, "%s", path);
    for (size_t n = strlen(clean); n > 1 && clean[n - 1] == '/'; n--)
        clean[n - 1] = '\0';
    Left left = {name_of(clean), "", ""};
    cz_parent_of(clean, parent);
    cz_each_temporary(parent, look_at, &left);
    if (left.made[0] == '\0')
        return put_back(left.moved, clean);
    const bool is_back =
        put_back(left.made, clean); /* fails while the process that created it lives */
    if (is_back && left.moved[0] != '\0')
        cz_remove_listed(left.moved);
    return is_back;
}

CzStatus cz_folder_check(const char *path, bool replaces_search, CzError *error) {
    char clean[PATH_MAX];
    CZ_TRY(clean_path(path, clean, error));
    (void)cz_report_restore_folder(clean);
    CZ_TRY(check_target(clean, replaces_search, error));
    return check_parents(clean, error);
}

/* ---- writing ---- */

void cz_make_parents(const char *path) {
    char parent[PATH_MAX];
    cz_parent_of(path, parent);
    for (char *slash = strchr(parent + 1, '/'); slash != NULL; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        (void)mkdir(parent, 0777); /* a failure shows when the folder itself is created */
        *slash = '/';
    }
    (void)mkdir(parent, 0777);
}

CzStatus cz_folder_begin(CzFolder *folder, const char *path, bool replaces_search, CzError *error) {
    char parent[PATH_MAX];
    memset(folder, 0, sizeof *folder);
    folder->replaces_search = replaces_search;
    CZ_TRY(cz_folder_check(path, replaces_search, error));
    CZ_TRY(clean_path(path, folder->target, error));
    cz_make_parents(folder->target);
    cz_parent_of(folder->target, parent);
    int why = cz_temporary_folder(parent, folder->temporary, &folder->marker);
    if (why != 0) {
        folder->temporary[0] = '\0';
        return cz_cannot_write(folder->target, why, error);
    }
    if (fprintf(folder->marker, "%s%s%s\n", CZ_MARKER_HEAD, CZ_MARKER_MADE_FOR,
                name_of(folder->target)) > 0 &&
        fflush(folder->marker) == 0)
        return CZ_OK;
    why = errno;
    cz_folder_abandon(folder);
    return cz_cannot_write(folder->target, why, error);
}

/* Reports that a file of the folder cannot be written. */
static CzStatus cannot_write(const CzFolder *folder, const char *name, int why, CzError *error) {
    char path[PATH_MAX];
    const bool fits = cz_path_in(path, folder->target, name, NULL) == CZ_OK;
    return cz_cannot_write(fits ? path : name, why, error);
}

/* A file is listed before it is created, because only listed files are removed. */
CzStatus cz_folder_open(CzFolder *folder, const char *name, FILE **stream, CzError *error) {
    char path[PATH_MAX];
    snprintf(folder->file_name, PATH_MAX, "%s", name);
    CZ_TRY(cz_path_in(path, folder->temporary, name, error));
    char *slash = strrchr(name, '/') != NULL ? strrchr(path, '/') : NULL;
    if (slash != NULL) {
        *slash = '\0';
        (void)mkdir(path, 0777);
        *slash = '/';
    }
    if (fprintf(folder->marker, "%s\n", name) < 0 || fflush(folder->marker) != 0)
        return cannot_write(folder, name, errno, error);
    const int descriptor = open(path, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor < 0)
        return cannot_write(folder, name, errno, error);
    folder->file = fdopen(descriptor, "wb");
    if (folder->file == NULL) {
        close(descriptor);
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory to write %.300s", name);
    }
    *stream = folder->file;
    return CZ_OK;
}

/* The errno of the first failure is lost; writing another byte fails for the same reason. */
int cz_stream_close(FILE *stream) {
    int why = 0;
    errno = 0;
    const bool has_failed = ferror(stream) != 0;
    if (fflush(stream) != 0)
        why = errno;
    if (has_failed && why == 0) {
        const long n = write(fileno(stream), "\n", 1);
        why = n < 0 ? errno : EIO;
    }
    if (fclose(stream) != 0 && why == 0)
        why = errno != 0 ? errno : EIO;
    return why;
}

CzStatus cz_folder_close(CzFolder *folder, CzError *error) {
    const int why = cz_stream_close(folder->file);
    folder->file = NULL;
    return why == 0 ? CZ_OK : cannot_write(folder, folder->file_name, why, error);
}

/* Renames an existing folder and reads its marker while there is memory for it; `old` is empty when
 * there was none. */
static CzStatus move_away(CzFolder *folder, char old[PATH_MAX], char **marker, CzError *error) {
    char parent[PATH_MAX];
    struct stat info;
    old[0] = '\0';
    CZ_TRY(check_target(folder->target, folder->replaces_search, error)); /* it may have changed */
    if (lstat(folder->target, &info) != 0)
        return CZ_OK;
    cz_parent_of(folder->target, parent);
    errno = 0;
    free(*marker);
    *marker = cz_marker_read(folder->target);
    int why = *marker == NULL && errno == ENOMEM ? ENOMEM : cz_temporary_name(parent, old);
    if (why == 0) /* so that another process can restore it if this one is killed before the end */
        cz_marker_add(folder->target, CZ_MARKER_MOVED, name_of(folder->target));
    if (why == 0 && rename(folder->target, old) == 0)
        return CZ_OK;
    why = why != 0 ? why : errno;
    old[0] = '\0';
    return why == ENOENT ? CZ_OK : cz_cannot_write(folder->target, why, error);
}

CzStatus cz_folder_finish(CzFolder *folder, CzError *error) {
    enum { MAX_TRIES = 20 };
    char old[PATH_MAX] = "", *marker = NULL;
    CzStatus status = CZ_OK;
    if (fputs(CZ_MARKER_WHOLE, folder->marker) == EOF || fflush(folder->marker) != 0)
        status = cz_cannot_write(folder->target, errno, error);
    int why = status == CZ_OK ? EEXIST : 0;
    for (int attempt = 0; attempt < MAX_TRIES && (why == EEXIST || why == ENOTEMPTY); attempt++) {
        if (old[0] != '\0') /* another process has written its results meanwhile */
            cz_remove_files(old, marker);
        status = move_away(folder, old, &marker, error);
        why = status == CZ_OK && rename(folder->temporary, folder->target) != 0 ? errno : 0;
    }
    if (why != 0)
        status = cz_cannot_write(folder->target, why, error);
    if (status != CZ_OK) {
        if (old[0] != '\0')
            (void)rename(old, folder->target);
        cz_folder_abandon(folder);
        free(marker);
        return status;
    }
    folder->temporary[0] = '\0';
    (void)fclose(folder->marker); /* flushed before; closing releases the lock */
    folder->marker = NULL;
    if (old[0] != '\0')
        cz_remove_files(old, marker);
    free(marker);
    cz_parent_of(folder->target, old);
    cz_temporary_clear(old); /* results of a process that was killed before it put them in place */
    return CZ_OK;
}

void cz_folder_abandon(CzFolder *folder) {
    if (folder->file != NULL)
        fclose(folder->file);
    if (folder->temporary[0] != '\0')
        cz_remove_listed(folder->temporary);
    if (folder->marker != NULL)
        fclose(folder->marker);
    folder->file = folder->marker = NULL;
    folder->temporary[0] = '\0';
}
