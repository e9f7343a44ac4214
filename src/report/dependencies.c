/* Files that a result depends on, as a rule for make. */
#include "crushzone/report.h"
#include "problem/problem.h"
#include "text/node.h"

#include <string.h>
#include <sys/stat.h>

/* Whether a source is a file: standard input and settings of the command line are not. */
static bool is_file(const CzSource *source) {
    struct stat info;
    return stat(source->name, &info) == 0 && S_ISREG(info.st_mode);
}

/* Whether a file is listed before, because several curves may be in one. */
static bool is_listed(const CzSource *first, const CzSource *source) {
    for (; first != source; first = first->next)
        if (strcmp(first->name, source->name) == 0)
            return true;
    return false;
}

/* Writes a path as make reads it: blanks and # behind a backslash, $ twice. */
static void put_path(const char *path, FILE *stream) {
    for (; *path != '\0'; path++) {
        if (strchr(" \t#", *path) != NULL)
            fputc('\\', stream);
        if (*path == '$')
            fputc('$', stream);
        fputc(*path, stream);
    }
}

void cz_report_write_dependencies(const CzProblem *problem, const char *target, FILE *stream) {
    const CzSource *first = cz_problem_first_source(problem);
    put_path(target, stream);
    fputc(':', stream);
    for (const CzSource *source = first; source != NULL; source = source->next)
        if (is_file(source) && !is_listed(first, source)) {
            fputs(" \\\n  ", stream);
            put_path(source->name, stream);
        }
    fputc('\n', stream);
    for (const CzSource *source = first; source != NULL; source = source->next)
        if (is_file(source) && !is_listed(first, source)) {
            put_path(source->name, stream);
            fputs(":\n", stream);
        }
}
