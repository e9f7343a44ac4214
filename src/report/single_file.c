/* Single files that are put in place as a whole. */
#include "base/error.h"
#include "crushzone/report.h"
#include "text/node.h"
#include "problem/problem.h"
#include "report/folder.h"
#include "report/temporary.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Whether a path is a device that is written to directly: a pipe, a terminal, /dev/null. */
static bool is_device(const char *path) {
    struct stat info;
    return stat(path, &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode);
}

/* Whether two paths lead to one file. */
static bool is_same_file(const char *path, const char *other) {
    struct stat first, second;
    return stat(path, &first) == 0 && stat(other, &second) == 0 && S_ISREG(first.st_mode) &&
           first.st_dev == second.st_dev && first.st_ino == second.st_ino;
}

/* Finds the folder of a file to write. */
static CzStatus find_folder(const char *path, char folder[PATH_MAX], CzError *error) {
    struct stat info;
    if (path[0] == '\0')
        return cz_fail(error, CZ_STATUS_OUTPUT, "the name of the file to write is empty");
    if (strlen(path) >= PATH_MAX)
        return cz_cannot_write(path, ENAMETOOLONG, error);
    if (lstat(path, &info) != 0 && errno != ENOENT)
        return cz_cannot_write(path, errno, error);
    if (path[strlen(path) - 1] == '/' || (stat(path, &info) == 0 && S_ISDIR(info.st_mode)))
        return cz_cannot_write(path, EISDIR, error);
    cz_parent_of(path, folder);
    return CZ_OK;
}

/* Whether a path is the page of the result folder that a problem was read from. */
static bool is_own_page(const CzProblem *problem, const char *path) {
    char folder[PATH_MAX], own[PATH_MAX];
    const CzSource *source = problem != NULL ? cz_problem_first_source(problem) : NULL;
    const char *slash = strrchr(path, '/');
    struct stat first, second;
    if (source == NULL || strcmp(slash != NULL ? slash + 1 : path, "report.html") != 0)
        return false;
    cz_parent_of(path, folder);
    cz_parent_of(source->name, own);
    return stat(folder, &first) == 0 && stat(own, &second) == 0 && first.st_dev == second.st_dev &&
           first.st_ino == second.st_ino;
}

CzStatus cz_report_check_file(const CzProblem *problem, const char *path, bool is_page,
                              CzError *error) {
    char folder[PATH_MAX], temporary[PATH_MAX];
    FILE *stream = NULL;
    if (strcmp(path, "-") == 0 || is_device(path))
        return CZ_OK;
    CZ_TRY(find_folder(path, folder, error));
    const CzSource *source = problem != NULL ? cz_problem_first_source(problem) : NULL;
    for (; source != NULL; source = source->next)
        if (is_same_file(path, source->name))
            return cz_fail(error, CZ_STATUS_OUTPUT,
                           "%.200s is read and would be replaced by what is written; choose "
                           "another file",
                           path);
    if (cz_folder_lists(path) && !(is_page && is_own_page(problem, path)))
        return cz_fail(error, CZ_STATUS_OUTPUT,
                       "%.200s is a result of crushzone and would be replaced; choose another file",
                       path);
    const int why = cz_temporary_file(folder, temporary, &stream);
    if (why != 0)
        return cz_cannot_write(path, why, error);
    (void)unlink(temporary);
    fclose(stream);
    return CZ_OK;
}

static CzStatus write_device(const char *path, CzReportWriter *write, const void *data,
                             CzError *error) {
    FILE *stream = fopen(path, "w");
    if (stream == NULL)
        return cz_cannot_write(path, errno, error);
    const CzStatus status = write(data, stream, error);
    const int why = cz_stream_close(stream);
    return status == CZ_OK && why != 0 ? cz_cannot_write(path, why, error) : status;
}

CzStatus cz_report_write_file(const char *path, CzReportWriter *write, const void *data,
                              CzError *error) {
    char folder[PATH_MAX], temporary[PATH_MAX];
    FILE *stream = NULL;
    if (is_device(path))
        return write_device(path, write, data, error);
    CZ_TRY(find_folder(path, folder, error));
    int why = cz_temporary_file(folder, temporary, &stream);
    if (why != 0)
        return cz_cannot_write(path, why, error);
    const CzStatus status = write(data, stream, error);
    /* Closing the stream releases the lock, so the file is renamed before. */
    why = fflush(stream) != 0 || ferror(stream) ? -1 : 0;
    if (status == CZ_OK && why == 0 && rename(temporary, path) != 0)
        why = errno;
    else if (status == CZ_OK && why == 0)
        temporary[0] = '\0';
    const int closing = cz_stream_close(stream);
    why = why == -1 || why == 0 ? closing : why;
    if (temporary[0] != '\0')
        (void)unlink(temporary);
    return (status == CZ_OK || status == CZ_STATUS_OUTPUT) && why != 0
               ? cz_cannot_write(path, why, error)
               : status;
}
