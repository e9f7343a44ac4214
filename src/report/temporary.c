/* Temporary files and folders: names, locks, removal of those of dead processes. */
#include "report/temporary.h"

#include "base/error.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

static const char prefix[] = ".crushzone-";
enum { N_SIGN = 16, MAX_TRIES = 100, MAX_MARKER = 1 << 26 /* [byte] */ };

void cz_parent_of(const char *path, char parent[PATH_MAX]) {
    snprintf(parent, PATH_MAX, "%s", path);
    char *slash = strrchr(parent, '/');
    if (slash == NULL)
        snprintf(parent, PATH_MAX, ".");
    else
        slash[slash == parent ? 1 : 0] = '\0';
}

CzStatus cz_path_in(char path[PATH_MAX], const char *folder, const char *name, CzError *error) {
    const int n = strcmp(folder, ".") == 0 ? snprintf(path, PATH_MAX, "%s", name)
                                           : snprintf(path, PATH_MAX, "%s/%s", folder, name);
    return n > 0 && n < PATH_MAX ? CZ_OK : cz_cannot_write(name, ENAMETOOLONG, error);
}

CzStatus cz_cannot_write(const char *path, int why, CzError *error) {
    if (why == ENOMEM)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory to write %.300s", path);
    return cz_fail(error, CZ_STATUS_OUTPUT, "%.300s cannot be written: %s", path, strerror(why));
}

/* ---- names ---- */

/* Chooses sixteen characters that differ between processes and from call to call. */
static void choose_name(char name[sizeof prefix + N_SIGN], int attempt) {
    struct timespec now = {0, 0};
    (void)clock_gettime(CLOCK_REALTIME, &now);
    uint64_t bits = (uint64_t)now.tv_sec * UINT64_C(1000000000) + (uint64_t)now.tv_nsec;
    bits ^= (uint64_t)getpid() << 40 ^ (uint64_t)(uintptr_t)name << 20 ^ (uint64_t)attempt;
    bits = (bits ^ bits >> 31) * UINT64_C(0x9e3779b97f4a7c15);
    bits = (bits ^ bits >> 29) * UINT64_C(0xbf58476d1ce4e5b9);
    snprintf(name, sizeof prefix + N_SIGN, "%s%016llx", prefix, (unsigned long long)bits);
}

bool cz_is_temporary(const char *name) {
    const size_t n = sizeof prefix - 1;
    return strncmp(name, prefix, n) == 0 && strlen(name) == n + N_SIGN &&
           strspn(name + n, "0123456789abcdef") == N_SIGN;
}

int cz_temporary_name(const char *folder, char path[PATH_MAX]) {
    struct stat info;
    char name[sizeof prefix + N_SIGN];
    for (int attempt = 0; attempt < MAX_TRIES; attempt++) {
        choose_name(name, attempt);
        if (cz_path_in(path, folder, name, NULL) != CZ_OK)
            return ENAMETOOLONG;
        if (lstat(path, &info) != 0)
            return errno == ENOENT ? 0 : errno;
    }
    return EEXIST;
}

/* ---- markers ---- */

char *cz_marker_read(const char *folder) {
    char path[PATH_MAX];
    char *text = NULL;
    int descriptor = -1;
    size_t n = 0;
    if (cz_path_in(path, folder, CZ_MARKER_NAME, NULL) == CZ_OK)
        descriptor = open(path, O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
    struct stat info;
    if (descriptor >= 0 && fstat(descriptor, &info) == 0 && S_ISREG(info.st_mode) &&
        info.st_size < MAX_MARKER)
        text = malloc((size_t)info.st_size + 1);
    while (text != NULL && n < (size_t)info.st_size) {
        const ssize_t n_read = read(descriptor, text + n, (size_t)info.st_size - n);
        if (n_read <= 0)
            break;
        n += (size_t)n_read;
    }
    if (descriptor >= 0)
        close(descriptor);
    const size_t n_head = sizeof CZ_MARKER_HEAD - 1;
    if (n < n_head || memcmp(text, CZ_MARKER_HEAD, n_head) != 0) {
        free(text);
        return NULL;
    }
    text[n] = '\0';
    memmove(text, text + n_head, n - n_head + 1);
    return text;
}

/* Whether a line of a marker is a path inside the folder. */
static bool is_inside(const char *line, size_t n) {
    for (const char *c = line; c < line + n; c++) {
        const bool begins = c == line || c[-1] == '/';
        if (begins && c[0] == '.' && c[1] == '.' && (c + 2 == line + n || c[2] == '/'))
            return false;
    }
    return n > 0 && line[0] != '/' && line[0] != '#';
}

static const char given_up[] = "# given up";

bool cz_marker_is_whole(const char *marker) {
    return (strncmp(marker, CZ_MARKER_WHOLE, sizeof CZ_MARKER_WHOLE - 1) == 0 ||
            strstr(marker, "\n" CZ_MARKER_WHOLE) != NULL) &&
           strstr(marker, given_up) == NULL;
}

bool cz_marker_lists(const char *marker, const char *what, const char *name, char end) {
    const size_t n_what = strlen(what), n_name = strlen(name);
    for (const char *line = marker; line != NULL && *line != '\0';) {
        if (strncmp(line, what, n_what) == 0 && strncmp(line + n_what, name, n_name) == 0 &&
            line[n_what + n_name] == end)
            return true;
        line = strchr(line, '\n');
        line = line != NULL ? line + 1 : NULL;
    }
    return false;
}

void cz_marker_add(const char *folder, const char *what, const char *name) {
    char path[PATH_MAX], line[PATH_MAX];
    const int n = snprintf(line, sizeof line, "%s%s\n", what, name);
    if (n >= (int)sizeof line || cz_path_in(path, folder, CZ_MARKER_NAME, NULL) != CZ_OK)
        return;
    const int descriptor = open(path, O_WRONLY | O_APPEND | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0)
        return;
    (void)!write(descriptor, line, (size_t)n);
    close(descriptor);
}

void cz_each_temporary(const char *folder, CzLook *look, void *data) {
    DIR *entries = opendir(folder);
    struct dirent *entry;
    char path[PATH_MAX];
    struct stat info;
    while (entries != NULL && (entry = readdir(entries)) != NULL)
        if (cz_is_temporary(entry->d_name) &&
            cz_path_in(path, folder, entry->d_name, NULL) == CZ_OK && lstat(path, &info) == 0)
            look(path, &info, data);
    if (entries != NULL)
        closedir(entries);
}

static void remove_file(const char *path, const struct stat *info, void *data) {
    (void)info;
    (void)data;
    (void)unlink(path);
}

enum { MAX_DEPTH = 3 }; /* folders around a file, as SCENARIO/iso-mme/Channel */

/* Length of the outermost folders of a name of n bytes, as many as `depth`; 0 when it is in fewer.
 */
static size_t folder_length(const char *name, size_t n, int depth) {
    for (size_t i = 0; i < n; i++)
        if (name[i] == '/' && --depth == 0)
            return i;
    return 0;
}

void cz_remove_files(const char *folder, const char *marker) {
    char path[PATH_MAX];
    cz_marker_add(folder, given_up,
                  ""); /* if this process is killed, another one removes the rest */
    cz_each_temporary(folder, remove_file, NULL);
    /* Files, then the folders around them, innermost first. */
    for (int depth = MAX_DEPTH; depth >= 0 && marker != NULL; depth--)
        for (const char *line = marker; *line != '\0';) {
            const size_t n = strcspn(line, "\n");
            const size_t shown = depth == MAX_DEPTH ? n : folder_length(line, n, depth + 1);
            if (is_inside(line, n) && shown > 0 &&
                snprintf(path, sizeof path, "%s/%.*s", folder, (int)shown, line) < PATH_MAX)
                (void)(depth == MAX_DEPTH ? unlink(path) : rmdir(path));
            line += n + (line[n] == '\n');
        }
    if (cz_path_in(path, folder, CZ_MARKER_NAME, NULL) == CZ_OK)
        (void)unlink(path);
    (void)rmdir(folder);
}

void cz_remove_listed(const char *folder) {
    char *marker = cz_marker_read(folder);
    cz_remove_files(folder, marker);
    free(marker);
}

/* ---- leftovers ---- */

/* Whether a path still leads to the open file. */
static bool is_still(const char *path, int descriptor) {
    struct stat named, opened;
    return lstat(path, &named) == 0 && fstat(descriptor, &opened) == 0 &&
           named.st_dev == opened.st_dev && named.st_ino == opened.st_ino;
}

int cz_temporary_take(const char *path) {
    const int descriptor = open(path, O_RDWR | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
    if (descriptor >= 0 && flock(descriptor, LOCK_EX | LOCK_NB) == 0 && is_still(path, descriptor))
        return descriptor;
    if (descriptor >= 0)
        close(descriptor);
    return -1;
}

static void clear_file(const char *path) {
    const int descriptor = cz_temporary_take(path);
    if (descriptor < 0)
        return;
    (void)unlink(path);
    close(descriptor);
}

/* Whether the folder that replaced this one exists. */
static bool is_replaced(const char *folder, const char *marker) {
    char parent[PATH_MAX], path[PATH_MAX], name[NAME_MAX + 1];
    struct stat info;
    const char *line = strstr(marker, "\n" CZ_MARKER_MOVED);
    if (line == NULL || sscanf(line + sizeof CZ_MARKER_MOVED, "%255[^\n]", name) != 1)
        return false;
    cz_parent_of(folder, parent);
    return cz_path_in(path, parent, name, NULL) == CZ_OK && lstat(path, &info) == 0;
}

/* Whether the folder that this one was to replace has newer results. */
static bool is_outdated(const char *folder, const char *marker) {
    char parent[PATH_MAX], path[PATH_MAX], name[NAME_MAX + 1];
    struct stat own, other;
    const size_t n = sizeof CZ_MARKER_MADE_FOR - 1;
    if (strncmp(marker, CZ_MARKER_MADE_FOR, n) != 0 || sscanf(marker + n, "%255[^\n]", name) != 1)
        return false;
    if (cz_path_in(path, folder, CZ_MARKER_NAME, NULL) != CZ_OK || lstat(path, &own) != 0)
        return false;
    cz_parent_of(folder, parent);
    if (cz_path_in(path, parent, name, NULL) != CZ_OK)
        return false;
    char *theirs = cz_marker_read(path);
    const bool is_whole = theirs != NULL && cz_marker_is_whole(theirs);
    free(theirs);
    snprintf(parent, sizeof parent, "%s", path);
    return is_whole && cz_path_in(path, parent, CZ_MARKER_NAME, NULL) == CZ_OK &&
           lstat(path, &other) == 0 &&
           (other.st_mtim.tv_sec > own.st_mtim.tv_sec ||
            (other.st_mtim.tv_sec == own.st_mtim.tv_sec &&
             other.st_mtim.tv_nsec > own.st_mtim.tv_nsec));
}

/* A complete folder contains results: it is kept unless another one has taken its place, or its
 * place has newer ones. */
static void clear_folder(const char *path) {
    char marker_path[PATH_MAX];
    if (cz_path_in(marker_path, path, CZ_MARKER_NAME, NULL) != CZ_OK)
        return;
    const int descriptor = cz_temporary_take(marker_path);
    if (descriptor < 0) {
        (void)rmdir(
            path); /* the process was killed before it created the marker, or is trying again */
        return;
    }
    char *marker = cz_marker_read(path);
    if (marker == NULL || !cz_marker_is_whole(marker) || is_replaced(path, marker) ||
        is_outdated(path, marker))
        cz_remove_listed(path);
    free(marker);
    close(descriptor);
}

/* Removes a temporary file or folder of a dead process of this user. */
static void clear(const char *path, const struct stat *info, void *data) {
    (void)data;
    if (info->st_uid != geteuid())
        return;
    if (S_ISREG(info->st_mode))
        clear_file(path);
    else if (S_ISDIR(info->st_mode))
        clear_folder(path);
}

void cz_temporary_clear(const char *folder) {
    cz_each_temporary(folder, clear, NULL);
}

/* ---- creation ---- */

/* Creates a new file and locks it. On a system without locks nothing is removed later. EAGAIN:
 * another process removed it before it was locked. */
static int make_locked(const char *path, FILE **stream) {
    const int descriptor = open(path, O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor < 0)
        return errno;
    const bool is_taken = flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    int why = is_taken || !is_still(path, descriptor) ? EAGAIN : 0;
    *stream = why == 0 ? fdopen(descriptor, "wb") : NULL;
    if (*stream != NULL)
        return 0;
    why = why != 0 ? why : ENOMEM;
    if (why == ENOMEM)
        (void)unlink(path);
    close(descriptor);
    return why;
}

int cz_temporary_file(const char *folder, char path[PATH_MAX], FILE **stream) {
    int why = EAGAIN;
    cz_temporary_clear(folder);
    for (int attempt = 0; attempt < MAX_TRIES && (why == EAGAIN || why == EEXIST); attempt++) {
        why = cz_temporary_name(folder, path);
        if (why == 0)
            why = make_locked(path, stream);
    }
    return why;
}

int cz_temporary_folder(const char *folder, char path[PATH_MAX], FILE **marker) {
    char marker_path[PATH_MAX];
    int why = EAGAIN;
    cz_temporary_clear(folder);
    for (int attempt = 0; attempt < MAX_TRIES; attempt++) {
        why = cz_temporary_name(folder, path);
        if (why != 0 || cz_path_in(marker_path, path, CZ_MARKER_NAME, NULL) != CZ_OK)
            return why != 0 ? why : ENAMETOOLONG;
        if (mkdir(path, 0777) != 0) {
            why = errno;
        } else {
            why = make_locked(marker_path, marker);
            if (why != 0)
                (void)rmdir(path);
        }
        if (why != EAGAIN && why != EEXIST && (why != ENOENT || attempt > 2))
            return why;
    }
    return why;
}
