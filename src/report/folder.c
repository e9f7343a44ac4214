/* A folder of result files that appears whole or not at all. */
#include "report/folder.h"

#include "base/error.h"

#include <dirent.h>
#include <errno.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char marker_name[] = ".crushzone";
static const char marker_head[] = "crushzone results\n";
enum { MARKER_ROOM = 1 << 20 }; /* no marker of ours is larger [byte] */

static bool join(char path[PATH_MAX], const char *folder, const char *name) {
    const int n = snprintf(path, PATH_MAX, "%s/%s", folder, name);
    return n > 0 && n < PATH_MAX;
}

/* Reads the marker of a folder: the lines after its head, freed by the caller; NULL when the folder
 * is not ours. */
static char *read_marker(const char *folder) {
    char path[PATH_MAX];
    FILE *stream = join(path, folder, marker_name) ? fopen(path, "rb") : NULL;
    char *text = stream != NULL ? malloc(MARKER_ROOM) : NULL;
    const size_t n = text != NULL ? fread(text, 1, MARKER_ROOM - 1, stream) : 0;
    if (stream != NULL)
        fclose(stream);
    const size_t n_head = sizeof marker_head - 1;
    if (n < n_head || memcmp(text, marker_head, n_head) != 0) {
        free(text);
        return NULL;
    }
    text[n] = '\0';
    memmove(text, text + n_head, n - n_head + 1);
    return text;
}

/* Whether the marker lists a file, or a file inside it when it is a folder. */
static bool lists(const char *marker, const char *name, bool is_folder) {
    const size_t n = strlen(name);
    for (const char *line = marker; line != NULL && *line != '\0';) {
        if (strncmp(line, name, n) == 0 && line[n] == (is_folder ? '/' : '\n'))
            return true;
        line = strchr(line, '\n');
        line = line != NULL ? line + 1 : NULL;
    }
    return false;
}

/* Looks for an entry that we did not write, at most one folder deep. */
static bool find_foreign(const char *folder, const char *marker, const char *prefix,
                         char foreign[PATH_MAX]) {
    DIR *entries = opendir(folder);
    bool found = entries == NULL;
    snprintf(foreign, PATH_MAX, "%s", prefix);
    struct dirent *entry;
    while (!found && (entry = readdir(entries)) != NULL) {
        char path[PATH_MAX], name[PATH_MAX];
        struct stat info;
        const char *own = entry->d_name;
        if (strcmp(own, ".") == 0 || strcmp(own, "..") == 0 ||
            (prefix[0] == '\0' && strcmp(own, marker_name) == 0))
            continue;
        snprintf(name, sizeof name, "%.*s%s", 2048, prefix, own);
        const bool is_folder =
            join(path, folder, own) && lstat(path, &info) == 0 && S_ISDIR(info.st_mode);
        found = !lists(marker, name, is_folder);
        if (found)
            snprintf(foreign, PATH_MAX, "%s", name);
        else if (is_folder)
            found = find_foreign(path, marker, strcat(name, "/"), foreign);
    }
    if (entries != NULL)
        closedir(entries);
    return found;
}

/* Removes the files that a marker lists, the marker, and the folders that are empty then. */
static void remove_listed(const char *folder, char *marker) {
    char path[PATH_MAX];
    for (int pass = 0; pass < 2; pass++) /* files, then the folders around them */
        for (char *line = marker; *line != '\0';) {
            const size_t n = strcspn(line, "\n");
            const size_t n_folder = strcspn(line, "/");
            const bool plain = line[0] != '/' && strncmp(line, "../", 3) != 0;
            const int shown = (int)(pass == 0 ? n : n_folder);
            if (plain && (pass == 0 || n_folder < n) &&
                snprintf(path, sizeof path, "%s/%.*s", folder, shown, line) < PATH_MAX)
                (void)(pass == 0 ? unlink(path) : rmdir(path));
            line += n + (line[n] == '\n');
        }
    if (join(path, folder, marker_name))
        (void)unlink(path);
    (void)rmdir(folder);
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

/* The folder above a path, "." for a plain name. */
static void parent_of(const char *path, char parent[PATH_MAX]) {
    snprintf(parent, PATH_MAX, "%s", path);
    char *slash = strrchr(parent, '/');
    if (slash == NULL)
        snprintf(parent, PATH_MAX, ".");
    else
        slash[slash == parent ? 1 : 0] = '\0';
}

/* Whether a folder can be made there: the nearest folder above that exists can be written. */
static CzStatus check_parents(const char *path, CzError *error) {
    char parent[PATH_MAX], above[PATH_MAX];
    struct stat info;
    parent_of(path, parent);
    while (stat(parent, &info) != 0 && errno == ENOENT && strcmp(parent, ".") != 0) {
        parent_of(parent, above);
        memcpy(parent, above, sizeof parent);
    }
    if (stat(parent, &info) != 0 || !S_ISDIR(info.st_mode))
        return cz_fail(error, CZ_STATUS_OUTPUT, "%.200s cannot be written: %.200s is no folder",
                       path, parent);
    if (access(parent, W_OK | X_OK) != 0)
        return cz_fail(error, CZ_STATUS_OUTPUT,
                       "%.200s cannot be written: the folder %.200s is not writable", path, parent);
    return CZ_OK;
}

/* The path without slashes at its end. */
static CzStatus clean_path(const char *path, char clean[PATH_MAX], CzError *error) {
    size_t n = strlen(path);
    while (n > 1 && path[n - 1] == '/')
        n--;
    if (n == 0 || n > PATH_MAX - 64)
        return cz_fail(error, CZ_STATUS_OUTPUT, "the name of the result folder is %s",
                       n == 0 ? "empty" : "too long");
    snprintf(clean, PATH_MAX, "%.*s", (int)n, path);
    return CZ_OK;
}

CzStatus cz_folder_check(const char *path, CzError *error) {
    char clean[PATH_MAX], foreign[PATH_MAX];
    struct stat info;
    CZ_TRY(clean_path(path, clean, error));
    if (lstat(clean, &info) != 0)
        return check_parents(clean, error);
    if (!S_ISDIR(info.st_mode))
        return cz_fail(error, CZ_STATUS_OUTPUT,
                       "%.200s is there already and is no folder; choose another one with -o",
                       clean);
    if (is_empty_folder(clean))
        return check_parents(clean, error);
    char *marker = read_marker(clean);
    if (marker == NULL)
        return cz_fail(error, CZ_STATUS_OUTPUT,
                       "the folder %.200s is there already and crushzone did not write it; choose "
                       "another one with -o",
                       clean);
    const bool has_foreign = find_foreign(clean, marker, "", foreign);
    free(marker);
    if (has_foreign)
        return cz_fail(error, CZ_STATUS_OUTPUT,
                       "the folder %.150s holds %.150s, which crushzone did not write; move it "
                       "away or choose another folder with -o",
                       clean, foreign);
    return check_parents(clean, error);
}

/* Makes the folders above a path. */
static void make_parents(const char *path) {
    char parent[PATH_MAX];
    parent_of(path, parent);
    for (char *slash = strchr(parent + 1, '/'); slash != NULL; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        (void)mkdir(parent, 0777); /* what is missing shows when the folder itself is made */
        *slash = '/';
    }
    (void)mkdir(parent, 0777);
}

static CzStatus cannot_write(const char *path, CzError *error) {
    return cz_fail(error, CZ_STATUS_OUTPUT, "%.300s cannot be written: %s", path, strerror(errno));
}

CzStatus cz_folder_begin(CzFolder *folder, const char *path, CzError *error) {
    memset(folder, 0, sizeof *folder);
    CZ_TRY(cz_folder_check(path, error));
    CZ_TRY(clean_path(path, folder->target, error));
    make_parents(folder->target);
    snprintf(folder->temporary, PATH_MAX, "%.*s.partial-%ld", PATH_MAX - 64, folder->target,
             (long)getpid());
    if (mkdir(folder->temporary, 0777) != 0) {
        const CzStatus status = cannot_write(folder->temporary, error);
        folder->temporary[0] = '\0';
        return status;
    }
    char marker[PATH_MAX];
    folder->marker = join(marker, folder->temporary, marker_name) ? fopen(marker, "wb") : NULL;
    if (folder->marker == NULL || fputs(marker_head, folder->marker) == EOF) {
        const CzStatus status = cannot_write(folder->temporary, error);
        cz_folder_abandon(folder);
        return status;
    }
    return CZ_OK;
}

CzStatus cz_folder_open(CzFolder *folder, const char *name, FILE **stream, CzError *error) {
    char path[PATH_MAX];
    snprintf(folder->file_name, PATH_MAX, "%s", name);
    if (!join(path, folder->temporary, name)) {
        errno = ENAMETOOLONG;
        return cannot_write(name, error);
    }
    char *slash = strrchr(name, '/') != NULL ? strrchr(path, '/') : NULL;
    if (slash != NULL) {
        *slash = '\0';
        (void)mkdir(path, 0777);
        *slash = '/';
    }
    folder->file = fopen(path, "wbx");
    if (folder->file == NULL || fprintf(folder->marker, "%s\n", name) < 0 ||
        fflush(folder->marker) != 0) {
        const CzStatus status = cannot_write(name, error);
        (void)unlink(path); /* the marker may not list it */
        return status;
    }
    *stream = folder->file;
    return CZ_OK;
}

CzStatus cz_folder_close(CzFolder *folder, CzError *error) {
    errno = 0;
    const bool flushed = fflush(folder->file) == 0 && !ferror(folder->file);
    const int flush_errno = errno;
    const bool closed = fclose(folder->file) == 0;
    folder->file = NULL;
    if (flushed && closed)
        return CZ_OK;
    if (!flushed)
        errno = flush_errno != 0 ? flush_errno : EIO;
    return cannot_write(folder->file_name, error);
}

CzStatus cz_folder_finish(CzFolder *folder, CzError *error) {
    char old[PATH_MAX];
    const bool flushed = fclose(folder->marker) == 0;
    folder->marker = NULL;
    snprintf(old, sizeof old, "%.*s.old-%ld", PATH_MAX - 64, folder->target, (long)getpid());
    const bool was_there = flushed && rename(folder->target, old) == 0;
    if (!flushed || rename(folder->temporary, folder->target) != 0) {
        const CzStatus status = cannot_write(folder->target, error);
        if (was_there)
            (void)rename(old, folder->target);
        cz_folder_abandon(folder);
        return status;
    }
    folder->temporary[0] = '\0';
    char *marker = was_there ? read_marker(old) : NULL;
    if (marker != NULL)
        remove_listed(old, marker);
    else if (was_there)
        (void)rmdir(old); /* it was empty */
    free(marker);
    return CZ_OK;
}

void cz_folder_abandon(CzFolder *folder) {
    if (folder->file != NULL)
        fclose(folder->file);
    if (folder->marker != NULL)
        fclose(folder->marker);
    folder->file = folder->marker = NULL;
    if (folder->temporary[0] == '\0')
        return;
    char *marker = read_marker(folder->temporary);
    char nothing[] = "";
    remove_listed(folder->temporary, marker != NULL ? marker : nothing);
    free(marker);
    folder->temporary[0] = '\0';
}
