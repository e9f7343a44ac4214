/* Result folders: complete or absent, our own replaced, all others unchanged; the overlay. */
#define _XOPEN_SOURCE 700 /* realpath, mkdtemp, popen */
#include "support/check.h"

#include "report/stand_in.h"

#include <limits.h>
#include <sys/resource.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

/* Each test works in an empty folder of its own. */
static char start_folder[PATH_MAX], work_folder[64];

static int enter_work_folder(void **state) {
    (void)state;
    snprintf(work_folder, sizeof work_folder, "/tmp/cz-folder-XXXXXX");
    return getcwd(start_folder, sizeof start_folder) == NULL || mkdtemp(work_folder) == NULL ||
           chdir(work_folder) != 0;
}

static int leave_work_folder(void **state) {
    (void)state;
    char command[128];
    snprintf(command, sizeof command, "rm -rf %s", work_folder);
    return chdir(start_folder) != 0 || system(command) != 0;
}

static bool is_there(const char *path) {
    struct stat info;
    return lstat(path, &info) == 0;
}

static void put(const char *path, const char *text) {
    FILE *stream = fopen(path, "w");
    assert_non_null(stream);
    fputs(text, stream);
    fclose(stream);
}

static char *content(const char *path) {
    FILE *stream = fopen(path, "r");
    if (stream == NULL)
        print_error("no file %s\n", path);
    assert_non_null(stream);
    char *text = calloc(1, 1 << 16);
    assert_true(fread(text, 1, (1 << 16) - 1, stream) > 0);
    fclose(stream);
    return text;
}

static int n_entries(void) { /* of the work folder, temporary names included */
    FILE *stream = popen("ls -A | wc -l", "r");
    int n = -1;
    assert_int_equal(fscanf(stream, "%d", &n), 1);
    pclose(stream);
    return n;
}

static CzStatus write_run(const StandIn *s, const char *folder, CzError *error) {
    const CzReport report = stand_in_run(s);
    return cz_report_write_folder(&report, folder, error);
}

static void one_scenario_has_no_subfolder(void **state) {
    (void)state;
    StandIn s;
    CzError error = {0};
    stand_in_fill(&s);
    assert_int_equal(write_run(&s, "results/deep/out", &error), CZ_OK);
    static const char *const names[] = {"summary.json",         "checks.csv",    "interfaces.csv",
                                        "channels.csv",         "resolved.yaml", "run.log",
                                        "profiles/limits.yaml", "report.html"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char path[128];
        snprintf(path, sizeof path, "results/deep/out/%s", names[i]);
        assert_true(is_there(path));
    }
    assert_int_equal(n_entries(), 1);
}

static void several_scenarios_have_a_folder_each(void **state) {
    (void)state;
    StandIn s;
    CzError error = {0};
    stand_in_fill(&s);
    s.evaluation.n_run = 2;
    assert_int_equal(write_run(&s, "out", &error), CZ_OK);
    assert_true(is_there("out/summary.json"));
    assert_true(is_there("out/36/channels.csv"));
    assert_true(is_there("out/report.html"));
    assert_true(is_there("out/36/report.html"));
    assert_true(is_there("out/18_low/report.html"));
    assert_true(is_there("out/36/interfaces.csv"));
    assert_true(is_there("out/18_low/channels.csv")); /* a slash in a name opens no folder */
    assert_false(is_there("out/channels.csv"));
}

static void our_own_folder_is_replaced_as_a_whole(void **state) {
    (void)state;
    StandIn s;
    CzError error = {0};
    stand_in_fill(&s);
    s.evaluation.n_run = 2;
    assert_int_equal(write_run(&s, "out/", &error), CZ_OK);
    s.evaluation.n_run = 1;
    assert_int_equal(write_run(&s, "out", &error), CZ_OK);
    assert_true(is_there("out/channels.csv"));
    assert_false(is_there("out/36"));
    assert_int_equal(n_entries(), 1);
}

static void an_empty_folder_is_used(void **state) {
    (void)state;
    StandIn s;
    CzError error = {0};
    stand_in_fill(&s);
    assert_int_equal(mkdir("out", 0777), 0);
    assert_int_equal(write_run(&s, "out", &error), CZ_OK);
    assert_true(is_there("out/summary.json"));
    assert_int_equal(n_entries(), 1);
}

static void refuses(const StandIn *s, const char *folder, const char *sentence) {
    CzError error = {0};
    assert_int_equal(cz_report_check_folder(NULL, folder, false, &error), CZ_STATUS_OUTPUT);
    assert_int_equal(write_run(s, folder, &error), CZ_STATUS_OUTPUT);
    if (strstr(error.message, sentence) == NULL)
        print_error("%s\n", error.message);
    assert_non_null(strstr(error.message, sentence));
}

static void a_folder_with_other_files_is_left_unchanged(void **state) {
    (void)state;
    StandIn s;
    CzError error = {0};
    stand_in_fill(&s);
    assert_int_equal(mkdir("thesis", 0777), 0);
    put("thesis/chapter", "1");
    refuses(&s, "thesis", "was not written by crushzone");
    assert_true(is_there("thesis/chapter"));

    assert_int_equal(write_run(&s, "out", &error), CZ_OK);
    put("out/notes.txt", "mine");
    refuses(&s, "out", "contains notes.txt, which crushzone did not write");
    assert_true(is_there("out/notes.txt"));

    put("file", "x");
    refuses(&s, "file", "is not a folder");
    refuses(&s, "file/out", "is not a folder");
    assert_int_equal(symlink("thesis", "link"), 0);
    refuses(&s, "link", "is a link");
    refuses(&s, "", "empty");
    assert_int_equal(n_entries(), 4);
}

static void a_marker_cannot_make_us_remove_other_files(void **state) {
    (void)state;
    StandIn s;
    CzError error = {0};
    stand_in_fill(&s);
    put("precious", "x");
    assert_int_equal(mkdir("out", 0777), 0);
    put("out/.crushzone", "crushzone results\n../precious\n/etc/passwd\n");
    assert_int_equal(write_run(&s, "out", &error), CZ_OK);
    assert_true(is_there("precious"));
}

/* The disk is full after a few blocks: nothing is left behind, and the old folder stays. */
static void a_full_disk_leaves_no_half_folder(void **state) {
    (void)state;
    StandIn s;
    CzError error = {0};
    stand_in_fill(&s);
    assert_int_equal(write_run(&s, "out", &error), CZ_OK);
    char *before = content("out/summary.json");

    struct rlimit limit, tight = {.rlim_cur = 2000, .rlim_max = RLIM_INFINITY};
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
    tight.rlim_max = limit.rlim_max;
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &tight);
    const CzStatus status = write_run(&s, "out", &error), fresh = write_run(&s, "new", NULL);
    setrlimit(RLIMIT_FSIZE, &limit);

    assert_int_equal(status, CZ_STATUS_OUTPUT);
    assert_int_equal(fresh, CZ_STATUS_OUTPUT);
    assert_non_null(strstr(error.message, "summary.json cannot be written: "));
    char *after = content("out/summary.json");
    assert_string_equal(before, after);
    assert_int_equal(n_entries(), 1);
    free(before);
    free(after);
}

static void the_log_has_all_warnings_and_no_times(void **state) {
    (void)state;
    StandIn s;
    CzError error = {0};
    stand_in_fill(&s);
    assert_int_equal(write_run(&s, "out", &error), CZ_OK);
    char *text = content("out/run.log");
    assert_non_null(strstr(text, "two.yaml:3:7: warning: mind the gap"));
    assert_non_null(strstr(text, "hash 0123456789abcdef"));
    assert_non_null(strstr(text, "scenario 36: completed, 6200 steps, end criterion met\n"));
    assert_non_null(strstr(text, "verdict: fail\n"));
    free(text);
}

static void a_search_writes_its_outcome_and_the_optimum(void **state) {
    (void)state;
    StandIn s;
    CzError error = {0};
    stand_in_fill(&s);
    assert_int_equal(mkdir("problems", 0777), 0);
    put("problems/two.yaml", "schema: 1\n");
    stand_in_file = "problems/two.yaml";
    const char *const set[] = {"trains.A.speed_km_h=20", "trains.A.speed_km_h=36", "title=a: b",
                               "trains.A.vehicles.A1.front.coupler.tube.stages[0].force_kN=1"};
    CzReportOptions options = cz_report_options_default();
    options.set = set;
    options.n_set = 4;
    CzReport report = stand_in_search(&s);
    report.options = &options;
    assert_int_equal(cz_report_write_folder(&report, "results/best", &error), CZ_OK);
    char *text = content("results/best/optimised.yaml");
    assert_string_equal(strchr(text, '\n') + 1,
                        "extends: \"../../problems/two.yaml\"\n"
                        "set:\n"
                        "  \"trains.A.speed_km_h\": 36\n"
                        "  \"title\": \"a: b\"\n"
                        "  \"trains.A.vehicles.A1.front.coupler.tube.stages[0].force_kN\": 900\n"
                        "  \"trains.A.vehicles.A1.front.coupler.tube.stages[0].stroke_m\": "
                        "0.12345678901234568\n");
    free(text);
    text = content("results/best/history.csv");
    assert_string_equal(text,
                        "evaluation,phase,objective,violation,feasible,tube force,tube stroke\r\n"
                        "1,screen,,,no,700,250\r\n2,polish,1.5,0,yes,900,123.5\r\n");
    free(text);
    assert_true(is_there("results/best/outcome.json"));
    assert_true(is_there("results/best/summary.json"));
    text = content("results/best/resolved.yaml");
    assert_string_equal(text, "schema: 1 # 4 settings\n");
    free(text);
    stand_in_file = "two \"trains\".yaml";
}

static void a_problem_from_standard_input_is_written_out_completely(void **state) {
    (void)state;
    StandIn s;
    CzError error = {0};
    stand_in_fill(&s);
    CzReportOptions options = cz_report_options_default();
    options.text = "schema: 1\n";
    options.n_text = strlen(options.text);
    CzReport report = stand_in_search(&s);
    report.options = &options;
    assert_int_equal(cz_report_write_folder(&report, "out", &error), CZ_OK);
    char *text = content("out/optimised.yaml");
    assert_null(strstr(text, "extends"));
    assert_non_null(strstr(text, "\nschema: 1 # 2 settings\n"));
    free(text);
}

static void the_best_values_survive_a_problem_that_cannot_be_read_again(void **state) {
    (void)state;
    StandIn s;
    CzError error = {0};
    stand_in_fill(&s);
    CzReportOptions options = cz_report_options_default();
    options.text = "broken";
    CzReport report = stand_in_search(&s);
    report.options = &options;
    assert_int_equal(cz_report_write_folder(&report, "out", &error), CZ_OK);
    char *text = content("out/optimised.yaml");
    assert_non_null(strstr(text, "cannot be read again (it is broken)"));
    assert_non_null(strstr(text, "[0].force_kN\": 900\n"));
    free(text);
}

#define in_work_folder(test)                                                                       \
    cmocka_unit_test_setup_teardown(test, enter_work_folder, leave_work_folder)

int main(void) {
    const struct CMUnitTest tests[] = {
        in_work_folder(one_scenario_has_no_subfolder),
        in_work_folder(several_scenarios_have_a_folder_each),
        in_work_folder(our_own_folder_is_replaced_as_a_whole),
        in_work_folder(an_empty_folder_is_used),
        in_work_folder(a_folder_with_other_files_is_left_unchanged),
        in_work_folder(a_marker_cannot_make_us_remove_other_files),
        in_work_folder(a_full_disk_leaves_no_half_folder),
        in_work_folder(the_log_has_all_warnings_and_no_times),
        in_work_folder(a_search_writes_its_outcome_and_the_optimum),
        in_work_folder(a_problem_from_standard_input_is_written_out_completely),
        in_work_folder(the_best_values_survive_a_problem_that_cannot_be_read_again),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
