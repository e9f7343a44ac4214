/* The reader of curve files on channels and test folders in ISO-MME. */
#include "support/work_folder.h"

#include <sys/stat.h>

#include "text/curve_file.h"

#define HEAD                                                                                       \
    "Channel code                :10VEHCCG0001VEX0\n"                                              \
    "Name of the channel         :v_A1\n"
#define SAMPLED                                                                                    \
    "Sampling interval           :1e-4\n"                                                          \
    "Time of first sample        :-0.0002\n"
#define UNIT "Unit                        :m/s\n"
#define VALUES "1.5\nNOVALUE\n-2\n.25\n"

static CzCurveRequest over(const char *quantity, CzDimension dimension, const char *title) {
    return (CzCurveRequest){
        .column = {{.name = "time", .dimension = CZ_DIMENSION_TIME, .title = "1"},
                   {.name = quantity, .dimension = dimension, .title = title}}};
}

static CzStatus read_text(CzArena *arena, const char *text, const CzCurveRequest *request,
                          CzCurvePoints *points, CzError *error) {
    *error = (CzError){0};
    return cz_curve_points_read_memory(arena, "test.001", text, strlen(text), request, points,
                                       error);
}

static void values_are_at_their_times(void **state) {
    static const char *const texts[] = {
        HEAD UNIT SAMPLED VALUES,
        HEAD SAMPLED "Unit :km/h\r\nNumber of samples :4\r\n5.4\r\nNOVALUE\r\n-7.2\r\n.9\r\n\r\n",
        HEAD "Reference channel :implicit\n" UNIT SAMPLED "\n" VALUES};
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        static const double x[] = {-2e-4, 0, 1e-4}, v[] = {1.5, -2, 0.25};
        const CzCurveRequest request = over("speed", CZ_DIMENSION_SPEED, "2");
        CzArena arena = {0};
        CzCurvePoints points;
        CzError error;
        if (read_text(&arena, texts[i], &request, &points, &error) != CZ_OK)
            fail_msg("file %zu: line %d: %s", i, error.line, error.message);
        assert_int_equal(points.n, 3);
        assert_string_equal(points.title[1], "v_A1");
        for (int k = 0; k < 3; k++) {
            assert_near(points.x[k], x[k], ROUNDING_OF_A_FORMULA, 1e-18); /* 0 is a difference */
            assert_near(points.y[k], v[k], ROUNDING_OF_A_FORMULA, 0);
        }
        cz_arena_free(&arena);
    }
}

static void a_mistake_is_reported_at_its_place(void **state) {
    static const struct {
        const char *text;
        int line, column;
        const char *sentence;
    } files[] = {
        {HEAD UNIT SAMPLED "1\ntwo\n3\n", 7, 1, "the value 'two' is not a number"},
        {HEAD UNIT SAMPLED "1\n", 7, 1, "a history needs at least two values, but this channel"},
        {HEAD UNIT SAMPLED "Number of samples :5\n" VALUES, 6, 20,
         "the number of samples does not agree with the 4 values"},
        {HEAD UNIT "Sampling interval :1e-4\n" VALUES, 1, 1, "has no 'Time of first sample'"},
        {HEAD UNIT "Time of first sample :0\nReference channel :implicit\n" VALUES, 1, 1,
         "has no 'Sampling interval'"},
        {HEAD UNIT "Time of first sample :0\nSampling interval :0\n" VALUES, 5, 20,
         "the sampling interval must be above 0 s"},
        {HEAD UNIT "Time of first sample :0\nSampling interval :slow\n" VALUES, 5, 20,
         "Sampling interval: 'slow' is not a number"},
        {HEAD UNIT "Reference channel :explicit\n" SAMPLED VALUES, 4, 20,
         "the times of this channel are in another channel"},
        {HEAD SAMPLED "Unit :kN\n" VALUES, 5, 7,
         "'kN' is not a unit of the speed, which takes m/s"},
        {HEAD SAMPLED VALUES, 1, 1, "the channel has no unit of the speed, such as m/s"}};
    (void)state;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        const CzCurveRequest request = over("speed", CZ_DIMENSION_SPEED, NULL);
        CzArena arena = {0};
        CzCurvePoints points;
        CzError error;
        assert_int_equal(read_text(&arena, files[i].text, &request, &points, &error),
                         CZ_STATUS_INPUT);
        if (strstr(error.message, files[i].sentence) == NULL || error.line != files[i].line ||
            error.column != files[i].column)
            fail_msg("file %zu: %d:%d: %s", i, error.line, error.column, error.message);
        cz_arena_free(&arena);
    }
}

static void a_force_over_a_stroke_is_no_channel(void **state) {
    const CzCurveRequest request = {.column = {{.name = "stroke", .dimension = CZ_DIMENSION_LENGTH},
                                               {.name = "force", .dimension = CZ_DIMENSION_FORCE}}};
    CzArena arena = {0};
    CzCurvePoints points;
    CzError error;
    (void)state;
    assert_int_equal(read_text(&arena, HEAD UNIT SAMPLED VALUES, &request, &points, &error),
                     CZ_STATUS_INPUT);
    assert_non_null(strstr(error.message, "a channel is a history over time, not over the stroke"));
    cz_arena_free(&arena);
}

/* ---- the folder of a test ---- */

static void write_text(const char *path, const char *text) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

/* Makes a test of four channels. */
static int make_test(void **state) {
    (void)state;
    if (enter_work_folder() != 0 || mkdir("mme", 0777) != 0 || mkdir("mme/Channel", 0777) != 0)
        return -1;
    write_text("mme/crash.mme", "Data format edition number :1.6\n");
    write_text("mme/Channel/crash.chn",
               "Number of channels          :4\n"
               "Name of channel 001         :10VEHCCG0001VEX0 / v_A1\n"
               "Name of channel 002         :20VEHCCG0001VEX0 / v_B1\n"
               "Name of channel 003         :001INT000001FOX0 / F_A1-B1_N\n"
               "Name of channel 004         :10VEHCCG0001ACX0\n");
    write_text("mme/Channel/crash.001", HEAD UNIT SAMPLED VALUES);
    write_text("mme/Channel/crash.002", HEAD UNIT SAMPLED "7\n8\n");
    write_text("mme/Channel/crash.003", HEAD "Unit :N\n" SAMPLED "1000\n2000\n");
    write_text("mme/empty.mme", "Data format edition number :1.6\n");
    return 0;
}

static int remove_test(void **state) {
    (void)state;
    return leave_work_folder();
}

static void a_channel_is_found_by_name_code_number_or_quantity(void **state) {
    static const struct {
        const char *quantity;
        CzDimension dimension;
        const char *title;
        double first; /* value [SI] */
    } requests[] = {{"speed", CZ_DIMENSION_SPEED, "v_A1", 1.5},
                    {"speed", CZ_DIMENSION_SPEED, "v_B1_m_s", 7},
                    {"speed", CZ_DIMENSION_SPEED, "3", 7},
                    {"speed", CZ_DIMENSION_SPEED, "2???????????VE??", 7},
                    {"force", CZ_DIMENSION_FORCE, "F_A1-B1_kN", 1000},
                    {"force", CZ_DIMENSION_FORCE, NULL, 1000}};
    (void)state;
    for (size_t i = 0; i < sizeof requests / sizeof *requests; i++) {
        const CzCurveRequest request =
            over(requests[i].quantity, requests[i].dimension, requests[i].title);
        CzArena arena = {0};
        CzCurvePoints points;
        CzError error = {0};
        if (cz_curve_points_read_file(&arena, "mme/crash.mme", &request, &points, &error) != CZ_OK)
            fail_msg("request %zu: %s:%d: %s", i, error.file, error.line, error.message);
        assert_near(points.y[0], requests[i].first, ROUNDING_OF_A_VALUE, 0);
        cz_arena_free(&arena);
    }
}

static void another_request_is_refused(void **state) {
    static const struct {
        const char *file, *title, *sentence;
    } requests[] = {
        {"mme/crash.mme", "v_C1",
         "no channel of this test is 'v_C1': v_A1, v_B1, F_A1-B1_N, 10VEH"},
        {"mme/crash.mme", NULL, "more than one channel of this test is a speed"},
        {"mme/crash.mme", "??VEHC??????VEX?", "more than one channel of this test is '??VEHC"},
        {"mme/crash.mme", "5", "cannot read 'mme/Channel/crash.004'"},
        {"mme/crash.mme", "6", "no channel of this test is '6'"},
        {"mme/empty.mme", NULL, "has no list of channels"},
        {"mme/none.mme", NULL, "has no list of channels"}};
    (void)state;
    for (size_t i = 0; i < sizeof requests / sizeof *requests; i++) {
        const CzCurveRequest request = over("speed", CZ_DIMENSION_SPEED, requests[i].title);
        CzArena arena = {0};
        CzCurvePoints points;
        CzError error = {0};
        assert_int_equal(
            cz_curve_points_read_file(&arena, requests[i].file, &request, &points, &error),
            CZ_STATUS_INPUT);
        if (strstr(error.message, requests[i].sentence) == NULL)
            fail_msg("request %zu: %s", i, error.message);
        cz_arena_free(&arena);
    }
}

static void the_titles_of_a_test_are_time_and_names(void **state) {
    CzArena arena = {0};
    CzError error = {0};
    char separator = 0;
    const char *titles = NULL;
    (void)state;
    assert_int_equal(cz_curve_titles_read(&arena, "mme/crash.mme", &separator, &titles, &error),
                     CZ_OK);
    assert_string_equal(titles, "t_s\tv_A1\tv_B1\tF_A1-B1_N\t10VEHCCG0001ACX0");
    assert_int_equal(separator, '\t');
    cz_arena_free(&arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_at_their_times),
        cmocka_unit_test(a_mistake_is_reported_at_its_place),
        cmocka_unit_test(a_force_over_a_stroke_is_no_channel),
        cmocka_unit_test(a_channel_is_found_by_name_code_number_or_quantity),
        cmocka_unit_test(another_request_is_refused),
        cmocka_unit_test(the_titles_of_a_test_are_time_and_names)};
    return cmocka_run_group_tests(tests, make_test, remove_test);
}
