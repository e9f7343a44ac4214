/* Histories in ISO-MME: structure of the files, codes, and values that are read to the same bits.
 */
#include "support/work_folder.h"

#include "crushzone/report.h"
#include "report/iso_mme.h"
#include "text/curve_file.h"
#include "text/units.h"

#include <ctype.h>

static CzProblem *problem;
static CzEvaluator *evaluator;
static CzEvaluation evaluation;

/* Two trains of two vehicles each, full cars among them, in a short run. */
static int run_collision(void **state) {
    static const char *const set[] = {"simulation.duration_ms=60"};
    CzProblemOptions options = cz_problem_options_default();
    CzError error = {0};
    (void)state;
    if (enter_work_folder() != 0)
        return -1;
    options.set = set;
    options.n_set = 1;
    options.share_folder = CZ_SOURCE_FOLDER "/problems";
    if (cz_problem_read(CZ_SOURCE_FOLDER "/problems/first-collision.yaml", &options, &problem,
                        &error) != CZ_OK ||
        cz_evaluator_build(problem, NULL, &evaluator, &error) != CZ_OK ||
        cz_evaluate(evaluator, 1, NULL, true, &evaluation, &error) != CZ_OK)
        fail_msg("%s", error.message);
    const CzReportOptions written = {.csv_separator = ',', .csv_decimal = '.', .iso_mme = true};
    const CzReport report = {.kind = CZ_REPORT_RUN,
                             .options = &written,
                             .problem = problem,
                             .evaluator = evaluator,
                             .evaluation = &evaluation};
    if (cz_report_write_folder(&report, "out", &error) != CZ_OK)
        fail_msg("%s", error.message);
    return 0;
}

static int end_collision(void **state) {
    (void)state;
    cz_evaluation_free(&evaluation);
    cz_evaluator_free(evaluator);
    cz_problem_free(problem);
    return leave_work_folder();
}

/* Reads a channel by the name of its column. */
static CzStatus read_channel(CzArena *arena, const char *name, CzCurvePoints *points,
                             CzError *error) {
    const CzUnit *unit = cz_curve_unit_of_title(name, NULL);
    const CzCurveRequest request = {
        .column = {{.name = "time", .dimension = CZ_DIMENSION_TIME},
                   {.name = "value", .dimension = unit->dimension, .title = name}}};
    return cz_curve_points_read_file(arena, "out/iso-mme/collision.mme", &request, points, error);
}

static void values_are_read_to_the_same_bits(void **state) {
    const CzRun *run = evaluation.run[0];
    const CzRunSummary *summary = cz_run_summary(run);
    const double *time = cz_run_channel(run, CZ_CHANNEL_TIME, 0);
    int n_value = 0;
    (void)state;
    for (int i = 1; i < cz_run_n_column(run); i++) {
        const CzColumn column = cz_run_column(run, i);
        const CzChannelInfo *info = cz_channel_info(column.channel);
        char name[CZ_CHANNEL_SIZE];
        cz_channel_name(info, column.place, cz_run_place_name(summary, info->at, column.place),
                        name);
        const double unit = cz_curve_unit_of_title(name, NULL)->si;
        const double *value = cz_run_channel(run, column.channel, column.place);
        CzArena arena = {0};
        CzCurvePoints points;
        CzError error = {0};
        const CzStatus status = read_channel(&arena, name, &points, &error);
        int n_given = 0;
        for (int k = 0; k < cz_run_n_sample(run); k++)
            n_given += !isnan(value[k]);
        if (n_given < 2) { /* a history that has nowhere a value cannot be read */
            assert_int_equal(status, CZ_STATUS_INPUT);
            cz_arena_free(&arena);
            continue;
        }
        if (status != CZ_OK)
            fail_msg("%s: %s:%d: %s", name, error.file, error.line, error.message);
        assert_int_equal(points.n, n_given);
        for (int k = 0, n = 0; k < cz_run_n_sample(run); k++) {
            const double si = value[k] * unit;
            if (isnan(value[k]))
                continue;
            assert_memory_equal(&points.y[n], &si, sizeof si);
            assert_near(points.x[n], time[k] / 1e3, ROUNDING_OF_A_FORMULA, 0);
            n++;
            n_value++;
        }
        cz_arena_free(&arena);
    }
    assert_true(n_value > 1000);
}

static void every_channel_has_a_code_of_its_own(void **state) {
    CzArena arena = {0};
    CzScene *scene;
    int n_scene;
    CzError error = {0};
    (void)state;
    assert_int_equal(cz_scenes_build(problem, &arena, &n_scene, &scene, &error), CZ_OK);
    const CzIsoMme mme = {
        .problem = problem, .run = evaluation.run[0], .scene = &scene[0], .test = "collision"};
    const int n = cz_iso_mme_n_channel(&mme);
    char(*code)[CZ_ISO_MME_CODE] = calloc((size_t)n, sizeof *code);
    assert_non_null(code);
    for (int i = 0; i < n; i++) {
        cz_iso_mme_code(&mme, i, code[i]);
        assert_int_equal(strlen(code[i]), 16);
        for (const char *c = code[i]; *c != '\0'; c++)
            assert_true(isdigit((unsigned char)*c) || isupper((unsigned char)*c));
        for (int k = 0; k < i; k++)
            if (strcmp(code[i], code[k]) == 0)
                fail_msg("%s is the code of two channels", code[i]);
    }
    assert_string_equal(code[0], "10VEHCCG0001DSX0");
    free(code);
    cz_arena_free(&arena);
}

/* Every line of the heads is "KEY :VALUE" with the colon in column 29, as viewers expect it. */
static void heads_have_keys_and_values(void **state) {
    static const char *const files[] = {"out/iso-mme/collision.mme",
                                        "out/iso-mme/Channel/collision.chn",
                                        "out/iso-mme/Channel/collision.001"};
    (void)state;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        char line[400];
        FILE *file = fopen(files[i], "r");
        assert_non_null(file);
        for (int n = 0; n < 11 && fgets(line, sizeof line, file) != NULL; n++)
            if (strlen(line) < 30 || line[28] != ':')
                fail_msg("%s: %s", files[i], line);
        fclose(file);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(values_are_read_to_the_same_bits),
                                       cmocka_unit_test(every_channel_has_a_code_of_its_own),
                                       cmocka_unit_test(heads_have_keys_and_values)};
    return cmocka_run_group_tests(tests, run_collision, end_collision);
}
