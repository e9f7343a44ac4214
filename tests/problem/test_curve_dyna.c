/* The reader of curve files on LS-DYNA keyword files, and on two columns without titles. */
#include "support/check.h"

#include "text/curve_file.h"
#include "problem/trace.h"

static CzCurveRequest wanted_by(const char *stroke, const char *force) {
    return (CzCurveRequest){.column = {{.name = "stroke",
                                        .dimension = CZ_DIMENSION_LENGTH,
                                        .title = stroke,
                                        .largest = CZ_LARGEST_STROKE},
                                       {.name = "force",
                                        .dimension = CZ_DIMENSION_FORCE,
                                        .title = force,
                                        .largest = CZ_LARGEST_FORCE}}};
}

static CzStatus read(CzArena *arena, const char *text, const CzCurveRequest *request,
                     CzCurvePoints *points, CzError *error) {
    *error = (CzError){0};
    return cz_curve_points_read_memory(arena, "test.k", text, strlen(text), request, points, error);
}

/* Two curves in one model; the second one is of another device. */
#define MODEL                                                                                      \
    "*KEYWORD\n"                                                                                   \
    "*PART\n"                                                                                      \
    "anything, at all\n"                                                                           \
    "*DEFINE_CURVE_TITLE\n"                                                                        \
    "tube\n"                                                                                       \
    "$#    lcid      sidr       sfa       sfo      offa      offo\n"                               \
    "        12         0     1e-3       2.0                 0.0\n"                                \
    "$#                a1                  o1\n"                                                   \
    "                   0                 0.0\n"                                                   \
    "              1500.0               1.5D2\n"                                                   \
    "             3.00E+5              525.25\n"                                                   \
    "*define_curve\n"                                                                              \
    "7\n"                                                                                          \
    "0,0\n"                                                                                        \
    "1,1\n"                                                                                        \
    "*END\n"

static void a_curve_is_read_with_its_scale_and_offset(void **state) {
    static const struct {
        const char *text, *stroke, *force;
    } files[] = {
        {MODEL, "stroke_mm", "tube (kN)"},
        {MODEL, "Travel [mm]", "lcid 12_kN"},
        {"*DEFINE_CURVE\n$# stroke_mm, force_kN\n1,,,2\n0,0\n1.5,150\n300,525.25\n", NULL, NULL},
        {"$ a model\n*DEFINE_CURVE\r\n         1\r\n$ s_m  F_MN\r\n0,-.0005\r\n", NULL, NULL},
        {"*DEFINE_CURVE\n$  stroke_mm  force_kN\n"
         "         1         0        .5         2         1      -.25\n"
         "                -1.0                0.25\n"
         "                   2              150.25\n\n"
         "                 599               525.5\n",
         "1", "2"},
        {"0 0\n1.5 300\n300 1050.5\n", "stroke_mm", "force_kN"},
        {"# of a program\n0,0\n1.5,300\n300,1050.5\n", "s (mm)", "F (kN)"},
        {"0;0\n1,5;300\n300;1050,5\n", "x_mm", "y_kN"}};
    (void)state;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        static const double x[] = {0, 0.0015, 0.3}, f[] = {0, 3e5, 1.0505e6};
        CzArena arena = {0};
        CzCurvePoints points;
        CzError error;
        const CzCurveRequest request = wanted_by(files[i].stroke, files[i].force);
        const CzStatus status = read(&arena, files[i].text, &request, &points, &error);
        if (i == 3) { /* one point is no curve */
            assert_int_equal(status, CZ_STATUS_INPUT);
            assert_int_equal(error.line, 2);
            cz_arena_free(&arena);
            continue;
        }
        if (status != CZ_OK)
            fail_msg("file %zu: line %d: %s (%s)", i, error.line, error.message, error.help);
        assert_int_equal(points.n, 3);
        for (int k = 0; k < 3; k++) {
            assert_near(points.x[k], x[k], ROUNDING_OF_A_FORMULA, 0);
            assert_near(points.y[k], f[k], ROUNDING_OF_A_FORMULA, 0);
        }
        cz_arena_free(&arena);
    }
}

static void a_mistake_is_reported_at_its_place(void **state) {
    static const struct {
        const char *text, *stroke, *force;
        int line, column;
        const char *sentence;
    } files[] = {
        {MODEL, "s_mm", "F_kN", 4, 1, "no curve is 'F_kN'; the curves are lcid 12 'tube', lcid 7"},
        {MODEL, NULL, NULL, 4, 1, "this file has 2 curves: lcid 12 'tube', lcid 7; one must be"},
        {"*DEFINE_CURVE\n1\n0,0\n1,1\n", NULL, NULL, 1, 1,
         "the unit of the stroke is missing or unknown"},
        {"*DEFINE_CURVE\n1\n0,0\n1,1\n", "s_mm", "F_t", 1, 1, "no curve is 'F_t'"},
        {"*DEFINE_CURVE\n1\n0,0\n1,1\n", "t_s", "F_kN", 1, 1, "is not a unit of the stroke"},
        {"*DEFINE_CURVE\n*END\n", "s_mm", "F_kN", 1, 1, "this curve has no card with its number"},
        {"*DEFINE_CURVE\n1, 0, one\n0,0\n1,1\n", "s_mm", "F_kN", 2, 7, "SFA: 'one' is not a"},
        {"*DEFINE_CURVE\n1\n0,0\n1,1 kN\n", "s_mm", "F_kN", 4, 3, "ordinate: '1 kN' is not a"},
        {"*DEFINE_CURVE\n1\n  0.0 0.0           5.0\n", "s_mm", "F_kN", 3, 3,
         "abscissa: '0.0 0.0' is not a number"},
        {"*DEFINE_CURVE\n1\n0,0\n1\n", "s_mm", "F_kN", 4, 2, "this point has no ordinate"},
        {"*DEFINE_CURVE\n1\n0,0\n,1\n", "s_mm", "F_kN", 4, 1, "this point has no abscissa"},
        {"*DEFINE_CURVE\n1\n0,0\n1,1,1\n", "s_mm", "F_kN", 4, 5, "this line has more"},
        {"*DEFINE_CURVE_SMOOTH\n1\n0,0\n1,1\n", "s_mm", "F_kN", 1, 1,
         "'*DEFINE_CURVE_SMOOTH' is not read"},
        {"*DEFINE_CURVE+\n1\n0,0\n1,1\n", "s_mm", "F_kN", 1, 1, "'*DEFINE_CURVE+' is not read"},
        {"0 0 1\n1 1 1\n", "s_mm", "F_kN", 1, 1, "no line of titles above names the column"},
        {"0 0\n1 1\n", "s_mm", "F_mm", 1, 1, "is not a unit of the force"},
        {"0 0\n1 1\n", "stroke", "force", 1, 1, "no line of titles above names the column"}};
    (void)state;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        CzArena arena = {0};
        CzCurvePoints points;
        CzError error;
        const CzCurveRequest request = wanted_by(files[i].stroke, files[i].force);
        assert_int_equal(read(&arena, files[i].text, &request, &points, &error), CZ_STATUS_INPUT);
        if (strstr(error.message, files[i].sentence) == NULL || error.line != files[i].line ||
            error.column != files[i].column)
            fail_msg("file %zu: %d:%d: %s", i, error.line, error.column, error.message);
        cz_arena_free(&arena);
    }
}

static void fields_without_commas_have_a_help(void **state) {
    CzArena arena = {0};
    CzCurvePoints points;
    CzError error;
    const CzCurveRequest request = wanted_by("s_mm", "F_kN");
    (void)state;
    assert_int_equal(
        read(&arena, "*DEFINE_CURVE\n1\n  0.0 0.0           5.0\n", &request, &points, &error),
        CZ_STATUS_INPUT);
    assert_non_null(strstr(error.help, "20 in the others"));
    cz_arena_free(&arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_curve_is_read_with_its_scale_and_offset),
                                       cmocka_unit_test(a_mistake_is_reported_at_its_place),
                                       cmocka_unit_test(fields_without_commas_have_a_help)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
