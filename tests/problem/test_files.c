/* Files that are not problem files: each gives a message and no crash. */
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

static void a_missing_file_is_reported(void **state) {
    (void)state;
    check_refused("no-such-file.yaml", "cannot read 'no-such-file.yaml': the file does not exist");
}

static void a_folder_is_reported(void **state) {
    (void)state;
    check_refused("/", "cannot read '/': it is a folder");
}

static void a_device_is_reported(void **state) {
    (void)state;
    check_refused("/dev/zero", "cannot read '/dev/zero': it is not a regular file");
}

static void an_empty_file_is_reported(void **state) {
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

static void a_file_of_20_megabytes_is_reported(void **state) {
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

static void a_file_without_permission_is_reported(void **state) {
    char path[] = "/tmp/crushzone-locked-XXXXXX";
    char sentence[100];
    const int file = mkstemp(path);
    (void)state;
    assert_true(file >= 0);
    assert_int_equal(write(file, "schema: 1\n", 10), 10);
    close(file);
    chmod(path, 0);
    snprintf(sentence, sizeof sentence, "cannot read '%s': permission is denied", path);
    if (geteuid() != 0) /* root can read every file */
        check_refused(path, sentence);
    unlink(path);
}

static void invalid_utf_8_is_reported_with_its_place(void **state) {
    (void)state;
    check_text_refused("title: a\nb: \xff\xfe\n", 15, 2, 4,
                       "the file contains byte 0xff, which is not valid UTF-8");
    check_text_refused("a: \xc3\xa4\xe4\n", 7, 1, 5,
                       "the file contains byte 0xe4, which is not valid UTF-8");
    check_text_refused("a: b\0c", 6, 1, 5, "the file contains the control character U+0000");
    check_text_refused("\x7f"
                       "ELF\x02\x01",
                       6, 1, 1, "the file contains the control character U+007F");
    check_text_refused("a: \xed\xa0\x80\n", 7, 1, 4,
                       "the file contains byte 0xed, which is not valid UTF-8");
}

static void a_byte_order_mark_is_ignored(void **state) {
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

/* Every line end of YAML is one in messages, otherwise their excerpt shows another line. */
static void lines_are_counted_as_in_yaml(void **state) {
    static const char *const ends[] = {"\n", "\r\n", "\r"};
    (void)state;
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++) {
        char text[80];
        CzProblem *problem = NULL;
        CzError error = {0};
        snprintf(text, sizeof text, "extends: rigid.yaml%stitel: x%s", ends[i], ends[i]);
        assert_int_equal(cz_problem_read_text(text, strlen(text), "lines.yaml", GOOD_FOLDER, NULL,
                                              &problem, &error),
                         CZ_STATUS_INPUT);
        assert_int_equal(error.line, 2);
        assert_string_equal(cz_problem_source_line(problem, &error), "titel: x");
        cz_problem_free(problem);
    }
}

/* They end a line for YAML and are invisible, so a comment could contain a key. */
static void other_separators_of_lines_are_refused(void **state) {
    static const char *const ends[] = {"\xc2\x85", "\xe2\x80\xa8", "\xe2\x80\xa9"};
    static const char *const told[] = {"the file contains the control character U+0085",
                                       "the file contains the line separator U+2028",
                                       "the file contains the line separator U+2029"};
    (void)state;
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++) {
        char text[80];
        CzProblem *problem = NULL;
        CzError error = {0};
        snprintf(text, sizeof text, "extends: rigid.yaml # %stitle: x\n", ends[i]);
        assert_int_equal(cz_problem_read_text(text, strlen(text), "lines.yaml", GOOD_FOLDER, NULL,
                                              &problem, &error),
                         CZ_STATUS_INPUT);
        assert_int_equal(error.line, 1);
        assert_string_equal(error.message, told[i]);
        cz_problem_free(problem);
    }
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

/* A text of n copies of a piece between a head and a tail. */
static void check_long_text_refused(const char *begin, const char *piece, int n, const char *end,
                                    const char *sentence) {
    const size_t n_piece = strlen(piece);
    const size_t n_byte = strlen(begin) + (size_t)n * n_piece + strlen(end);
    char *text = malloc(n_byte + 1);
    CzProblem *problem = NULL;
    CzError error = {0};
    assert_non_null(text);
    strcpy(text, begin);
    for (int i = 0; i < n; i++)
        memcpy(text + strlen(begin) + (size_t)i * n_piece, piece, n_piece);
    strcpy(text + strlen(begin) + (size_t)n * n_piece, end);
    assert_int_equal(
        cz_problem_read_text(text, n_byte, "text", GOOD_FOLDER, NULL, &problem, &error),
        CZ_STATUS_INPUT);
    assert_string_equal(error.message, sentence);
    cz_problem_free(problem);
    free(text);
}

static void files_that_would_take_very_long_are_reported(void **state) {
    (void)state;
    check_long_text_refused("a: [", "1,", 30000, "1]", "a list has more than 20000 items");
    check_long_text_refused("a:\n", "- [1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1]\n", 15000, "",
                            "the file has more than 250000 values");
    char *keys = malloc(3000 * 12);
    assert_non_null(keys);
    keys[0] = '\0';
    for (int i = 0, n = 0; i < 2500; i++)
        n += sprintf(keys + n, "k%d: 1\n", i);
    check_long_text_refused(keys, "", 0, "", "a mapping has more than 2000 keys");
    free(keys);
}

static void a_curve_of_very_many_lines_is_reported(void **state) {
    char path[] = "/tmp/crushzone-curve-XXXXXX";
    char text[300];
    const int descriptor = mkstemp(path);
    CzProblem *problem = NULL;
    (void)state;
    assert_true(descriptor >= 0);
    FILE *file = fdopen(descriptor, "w");
    assert_non_null(file);
    fputs("stroke_mm,force_kN\n", file);
    for (int i = 0; i < 1000000; i++)
        fputs("0,1\n", file);
    fclose(file);
    snprintf(text, sizeof text,
             "extends: rigid.yaml\n"
             "parts: {bumper: {stages: null, curve: {file: %s, basis: static}}}\n",
             path);
    assert_int_equal(read_text(text, &problem), CZ_STATUS_INPUT);
    assert_string_equal(cz_problem_mistake(problem, 0)->message,
                        "a curve has at most 1000000 lines");
    cz_problem_free(problem);
    unlink(path);
}

static void an_invalid_setting_is_reported_with_its_place(void **state) {
    static const char *const set[] = {"trains.A.speed_km_h=30", "trains.A.speed_km_h",
                                      "trains.A.speed_km_h=fast", "=3", "trains.A.sped_km_h=3"};
    CzProblemOptions options = cz_problem_options_default();
    CzProblem *problem = NULL;
    (void)state;
    options.set = set;
    options.n_set = 5;
    assert_int_equal(cz_problem_read(GOOD_FOLDER "/rigid.yaml", &options, &problem, NULL),
                     CZ_STATUS_INPUT);
    static const struct {
        int line, column;
        const char *message;
    } told[] = {{2, 1, "'trains.A.speed_km_h' is not path=value"},
                {3, 21, "speed_km_h: 'fast' is not a number"},
                {4, 1, "'=3' is not path=value"},
                {5, 10, "unknown key 'sped_km_h' in train"}};
    assert_int_equal(cz_problem_n_mistake(problem), 4);
    for (int i = 0; i < 4; i++) {
        const CzError *error = cz_problem_mistake(problem, i);
        assert_string_equal(error->file, "--set");
        assert_int_equal(error->line, told[i].line);
        assert_int_equal(error->column, told[i].column);
        assert_string_equal(error->message, told[i].message);
        assert_string_equal(cz_problem_source_line(problem, error), set[told[i].line - 1]);
    }
    cz_problem_free(problem);
}

/* A host program's locale, with a decimal comma where the system has one. */
static void the_locale_of_the_host_changes_nothing(void **state) {
    static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8",
                                        "nl_NL.UTF-8"};
    bool is_set = false;
    (void)state;
    for (int i = 0; i < 5 && !is_set; i++)
        is_set = setlocale(LC_ALL, names[i]) != NULL;
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
    if (!is_set) {
        print_message("no locale with a decimal comma; package locales has them\n");
        skip();
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_missing_file_is_reported),
        cmocka_unit_test(a_folder_is_reported),
        cmocka_unit_test(a_device_is_reported),
        cmocka_unit_test(an_empty_file_is_reported),
        cmocka_unit_test(a_file_of_20_megabytes_is_reported),
        cmocka_unit_test(a_file_without_permission_is_reported),
        cmocka_unit_test(invalid_utf_8_is_reported_with_its_place),
        cmocka_unit_test(a_byte_order_mark_is_ignored),
        cmocka_unit_test(lines_may_end_as_on_windows),
        cmocka_unit_test(lines_are_counted_as_in_yaml),
        cmocka_unit_test(other_separators_of_lines_are_refused),
        cmocka_unit_test(very_many_mistakes_are_counted),
        cmocka_unit_test(files_that_would_take_very_long_are_reported),
        cmocka_unit_test(a_curve_of_very_many_lines_is_reported),
        cmocka_unit_test(an_invalid_setting_is_reported_with_its_place),
        cmocka_unit_test(the_locale_of_the_host_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
