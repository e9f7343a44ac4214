/* The file of --junit: refused before anything is computed, written when all is judged. */
#include "cli/junit_file.h"

#include "base/error.h"
#include "cli/messages.h"

#include <string.h>

/* Whether the file can be written, and what is in it is judged. */
static CzStatus check_file(const CzArguments *arguments, const char *path, CzError *error) {
    if (strcmp(path, "-") == 0)
        return cz_fail(error, CZ_STATUS_INPUT,
                       "--junit writes a file; standard output has the tables");
    if (arguments->n_shard > 1)
        return cz_fail(error, CZ_STATUS_INPUT,
                       "a shard is not judged: give --junit to crushzone merge");
    return cz_report_check_file(NULL, path, false, error);
}

int cz_junit_file_begin(const CzArguments *arguments, CzJunit **junit) {
    const char *path = arguments->text[CZ_OPTION_JUNIT];
    CzError error = {0};
    *junit = NULL;
    if (path == NULL)
        return 0;
    if (check_file(arguments, path, &error) == CZ_OK && (*junit = cz_junit_begin()) == NULL)
        (void)cz_no_memory(&error, "the JUnit document");
    return *junit != NULL ? 0 : cz_print_error(arguments, &error);
}

int cz_junit_file_end(const CzArguments *arguments, CzJunit *junit) {
    const char *path = arguments->text[CZ_OPTION_JUNIT];
    CzError error = {0};
    if (junit == NULL)
        return 0;
    const CzStatus status = cz_report_write_file(path, cz_junit_write, junit, &error);
    cz_junit_free(junit);
    if (status != CZ_OK)
        return cz_print_error(arguments, &error);
    cz_print_note(arguments, "verdicts in %s", path);
    return 0;
}

void cz_junit_file_add_unjudged(CzJunit *junit, const char *file) {
    if (junit != NULL)
        cz_junit_add_error(junit, file, "it could not be judged; standard error has the reason");
}
