/* Every rule that can reject a problem file has a file in tests/problem/bad that breaks it.
 * Comments at the file's end give the expected report:
 *
 *   # expect: [file:]line:column: sentence
 *   # help: hint of the mistake above
 *
 * All mistakes of a file must be listed, in their order, and nothing else. */
#include "support/check.h"

#include <dirent.h>
#include <stdbool.h>
#include <unistd.h>

#include "crushzone/problem.h"

enum { MAX_FILES = 500, MAX_LINES = 100, LONGEST_LINE = 1200 };

typedef struct {
    int n_line;
    char line[MAX_LINES][LONGEST_LINE];
} Story;

static void tell(Story *story, const char *line) {
    assert_in_range(story->n_line, 0, MAX_LINES - 1);
    snprintf(story->line[story->n_line++], LONGEST_LINE, "%s", line);
}

static void read_expected(const char *path, Story *story) {
    char line[LONGEST_LINE];
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file) != NULL) {
        line[strcspn(line, "\n")] = '\0';
        if (strncmp(line, "# expect: ", 10) == 0 || strncmp(line, "# help: ", 8) == 0)
            tell(story, line);
    }
    fclose(file);
}

static void read_told(const char *path, Story *story) {
    char line[LONGEST_LINE];
    CzProblemOptions options = cz_problem_options_default();
    CzProblem *problem = NULL;
    CzError first = {0};
    options.share_folder = "problems";
    assert_int_equal(cz_problem_read(path, &options, &problem, &first), CZ_STATUS_INPUT);
    assert_non_null(problem);
    assert_string_equal(first.message, cz_problem_mistake(problem, 0)->message);
    for (int i = 0; i < cz_problem_n_mistake(problem); i++) {
        const CzError *error = cz_problem_mistake(problem, i);
        const bool is_own = strcmp(error->file, path) == 0;
        assert_int_equal(error->status, CZ_STATUS_INPUT);
        assert_non_null(cz_problem_source_line(problem, error));
        snprintf(line, sizeof line, "# expect: %s%s%d:%d: %s", is_own ? "" : error->file,
                 is_own ? "" : ":", error->line, error->column, error->message);
        tell(story, line);
        snprintf(line, sizeof line, "# help: %s", error->help);
        if (error->help[0] != '\0')
            tell(story, line);
    }
    cz_problem_free(problem);
}

static void bad_file_gets_the_expected_report(void **state) {
    static Story expected, told;
    const char *path = *state;
    expected.n_line = told.n_line = 0;
    read_expected(path, &expected);
    read_told(path, &told);
    assert_true(expected.n_line > 0);
    for (int i = 0; i < expected.n_line && i < told.n_line; i++)
        assert_string_equal(told.line[i], expected.line[i]);
    for (int i = expected.n_line; i < told.n_line; i++)
        fail_msg("not expected: %s", told.line[i]);
    for (int i = told.n_line; i < expected.n_line; i++)
        fail_msg("not told: %s", expected.line[i]);
}

static int compare_names(const void *a, const void *b) {
    return strcmp(((const struct CMUnitTest *)a)->name, ((const struct CMUnitTest *)b)->name);
}

/* Catalogues named in bad files are not problem files themselves. */
static bool is_problem_file(const char *name) {
    const char *end = strstr(name, ".yaml");
    return end != NULL && end[5] == '\0' && strstr(name, "-catalogue.yaml") == NULL;
}

int main(void) {
    static struct CMUnitTest tests[MAX_FILES];
    size_t n_test = 0;
    if (chdir(CZ_SOURCE_FOLDER "/tests/problem/bad") != 0)
        return 1;
    DIR *folder = opendir(".");
    if (folder == NULL)
        return 1;
    for (struct dirent *file = readdir(folder); file != NULL; file = readdir(folder)) {
        if (!is_problem_file(file->d_name) || n_test == MAX_FILES)
            continue;
        char *name = strdup(file->d_name);
        tests[n_test++] =
            (struct CMUnitTest){name, bad_file_gets_the_expected_report, NULL, NULL, name};
    }
    closedir(folder);
    qsort(tests, n_test, sizeof tests[0], compare_names);
    const int n_failed =
        n_test < 50 ? 1 : _cmocka_run_group_tests("bad files", tests, n_test, NULL, NULL);
    for (size_t i = 0; i < n_test; i++)
        free(tests[i].initial_state);
    return n_failed;
}
