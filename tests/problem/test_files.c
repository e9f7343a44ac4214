/* Files that are no problem files at all: each gives a sentence, none a crash. */
#include "problem/read_problem.h"

#include <locale.h>
#include <sys/stat.h>
#include <unistd.h>

static void check_refused(const char *path, const char *sentence) {
    CzProblem *problem = NULL;
    CzError error = {0};
    assert_int_equal(cz_problem_read(path, NULL, &problem, &error), CZ_STATUS_INPUT);
    assert_non_null(problem);
    assert_int_equal(cz_problem_n_mistake(problem), 1);
    assert_string_equal(error.message, sentence);
    cz_problem_free(problem);
}

static void check_text_refused(const char *text, size_t n_byte, int line, int column,
                               const char *sentence) {
    CzProblem *problem = NULL;
    CzError error = {0};
    assert_int_equal(cz_problem_read_text(text, n_byte, "text", ".", NULL, &problem, &error),
                     CZ_STATUS_INPUT);
    assert_string_equal(error.message, sentence);
    assert_string_equal(error.file, "text");
    assert_int_equal(error.line, line);
    assert_int_equal(error.column, column);
    cz_problem_free(problem);
}

static void a_missing_file_is_told(void **state) {
    (void)state;
    check_refused("no-such-file.yaml", "cannot read 'no-such-file.yaml': there is no such file");
}

static void a_folder_is_told(void **state) {
    (void)state;
    check_refused("/", "cannot read '/': it is a folder");
}

static void a_device_is_told(void **state) {
    (void)state;
    check_refused("/dev/zero", "cannot read '/dev/zero': it is not a regular file");
}

static void an_empty_file_is_told(void **state) {
    char path[] = "/tmp/crushzone-empty-XXXXXX";
    char sentence[100];
    const int file = mkstemp(path);
    (void)state;
    assert_true(file >= 0);
    close(file);
    snprintf(sentence, sizeof sentence, "cannot read '%s': it is empty", path);
    check_refused(path, sentence);
    unlink(path);
    check_text_refused("", 0, 0, 0, "cannot read 'text': it is empty");
}

static void a_file_of_20_megabytes_is_told(void **state) {
    char path[] = "/tmp/crushzone-large-XXXXXX";
    char sentence[100];
    const int file = mkstemp(path);
    (void)state;
    assert_true(file >= 0);
    assert_int_equal(ftruncate(file, 20 * 1000 * 1000), 0);
    close(file);
    snprintf(sentence, sizeof sentence, "cannot read '%s': it is larger than 16 MiB", path);
    check_refused(path, sentence);
    unlink(path);
}

static void a_file_without_permission_is_told(void **state) {
    char path[] = "/tmp/crushzone-locked-XXXXXX";
    char sentence[100];
    const int file = mkstemp(path);
    (void)state;
    assert_true(file >= 0);
    assert_int_equal(write(file, "schema: 1\n", 10), 10);
    close(file);
    chmod(path, 0);
    snprintf(sentence, sizeof sentence, "cannot read '%s': permission is denied", path);
    if (geteuid() != 0) /* nothing is locked to root */
        check_refused(path, sentence);
    unlink(path);
}

static void bytes_that_are_no_text_are_told_with_their_place(void **state) {
    (void)state;
    check_text_refused("title: a\nb: \xff\xfe\n", 15, 2, 4,
                       "the file is not UTF-8 text: byte 0xff begins no character");
    check_text_refused("a: \xc3\xa4\xe4\n", 7, 1, 5,
                       "the file is not UTF-8 text: byte 0xe4 begins no character");
    check_text_refused("a: b\0c", 6, 1, 5,
                       "the file is not text: it holds the control character 0x00");
    check_text_refused("\x7f"
                       "ELF\x02\x01",
                       6, 1, 1, "the file is not text: it holds the control character 0x7f");
    check_text_refused("a: \xed\xa0\x80\n", 7, 1, 4,
                       "the file is not UTF-8 text: byte 0xed begins no character");
}

static void a_byte_order_mark_is_passed_over(void **state) {
    (void)state;
    CzProblem *problem = read_good_text("\xef\xbb\xbf"
                                        "extends: rigid.yaml\n");
    assert_string_equal(cz_problem_title(problem), "Two rigid cars");
    cz_problem_free(problem);
}

static void lines_may_end_as_on_windows(void **state) {
    (void)state;
    CzProblem *problem = NULL;
    CzError error = {0};
    const char *text = "extends: rigid.yaml\r\ntitel: x\r\n";
    assert_int_equal(
        cz_problem_read_text(text, strlen(text), "text", GOOD_FOLDER, NULL, &problem, &error),
        CZ_STATUS_INPUT);
    assert_int_equal(error.line, 2);
    assert_string_equal(cz_problem_source_line(problem, &error), "titel: x");
    assert_string_equal(error.help, "did you mean 'title'?");
    cz_problem_free(problem);
}

static void very_many_mistakes_are_counted(void **state) {
    char text[8000] = "extends: rigid.yaml\n";
    CzProblem *problem = NULL;
    (void)state;
    for (int i = 0; i < 300; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text), "unknown%d: 1\n", i);
    assert_int_equal(read_text(text, &problem), CZ_STATUS_INPUT);
    assert_int_equal(cz_problem_n_mistake(problem), 101);
    assert_string_equal(cz_problem_mistake(problem, 100)->message,
                        "200 more mistakes are not shown");
    cz_problem_free(problem);
}

static void a_file_of_very_many_values_is_told(void **state) {
    const size_t n_byte = 2 * 1000 * 1000;
    char *text = malloc(n_byte + 1);
    CzProblem *problem = NULL;
    (void)state;
    assert_non_null(text);
    memcpy(text, "a: [[1", 6);
    for (size_t i = 6; i < n_byte; i += 2)
        memcpy(text + i, (i / 2) % 10000 == 0 ? "],[1" : ",1", 2);
    assert_int_equal(cz_problem_read_text(text, n_byte, "text", ".", NULL, &problem, NULL),
                     CZ_STATUS_INPUT);
    cz_problem_free(problem);
    free(text);
}

/* A host program's locale, with a decimal comma where the system has one. */
static void the_locale_of_the_host_changes_nothing(void **state) {
    static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8",
                                        "nl_NL.UTF-8"};
    bool is_set = false;
    (void)state;
    for (int i = 0; i < 5 && !is_set; i++)
        is_set = setlocale(LC_ALL, names[i]) != NULL;
    if (!is_set)
        print_message("no locale with a decimal comma is installed; skipped\n");
    static const char *const set[] = {"trains.A.speed_km_h=30.5"};
    CzProblem *problem = read_good("rigid.yaml", 1, set);
    assert_near(cz_problem_input(problem)->trains[0].speed, 30.5 / 3.6, 1e-15, 0);
    char *text = NULL;
    size_t n_byte = 0;
    FILE *stream = open_memstream(&text, &n_byte);
    cz_problem_write_resolved(problem, stream);
    fclose(stream);
    assert_non_null(strstr(text, "face_gap_m: 0.5 "));
    free(text);
    cz_problem_free(problem);
    setlocale(LC_ALL, "C");
    if (!is_set)
        skip();
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_missing_file_is_told),
        cmocka_unit_test(a_folder_is_told),
        cmocka_unit_test(a_device_is_told),
        cmocka_unit_test(an_empty_file_is_told),
        cmocka_unit_test(a_file_of_20_megabytes_is_told),
        cmocka_unit_test(a_file_without_permission_is_told),
        cmocka_unit_test(bytes_that_are_no_text_are_told_with_their_place),
        cmocka_unit_test(a_byte_order_mark_is_passed_over),
        cmocka_unit_test(lines_may_end_as_on_windows),
        cmocka_unit_test(very_many_mistakes_are_counted),
        cmocka_unit_test(a_file_of_very_many_values_is_told),
        cmocka_unit_test(the_locale_of_the_host_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
