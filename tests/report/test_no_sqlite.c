/* The export of a program that was built without SQLite, whose place no_sqlite.c takes. */
#include "support/work_folder.h"

#include "crushzone/report.h"

#include <sys/stat.h>

static void an_export_says_that_sqlite_is_missing(void **state) {
    const char *const folder[] = {"results"};
    CzError error = {0};
    struct stat info;
    (void)state;
    assert_int_equal(enter_work_folder(), 0);
    assert_int_equal(cz_report_export(1, folder, "study.db", &error), CZ_STATUS_INPUT);
    assert_string_equal(error.message, "this program was built without SQLite");
    assert_non_null(strstr(error.help, "libsqlite3-dev"));
    assert_int_not_equal(stat("study.db", &info), 0); /* and leaves no file */
    assert_int_equal(leave_work_folder(), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(an_export_says_that_sqlite_is_missing)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
