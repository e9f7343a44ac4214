/* The reader of curve files: numbers, separators, titles, units, and invalid files. */
#include "support/check.h"

#include <stdlib.h>

#include "text/curve_file.h"
#include "text/curve_number.h"
#include "problem/trace.h"

static const CzCurveRequest wanted = {
    .column = {{.name = "stroke", .dimension = CZ_DIMENSION_LENGTH, .largest = CZ_LARGEST_STROKE},
               {.name = "force", .dimension = CZ_DIMENSION_FORCE, .largest = CZ_LARGEST_FORCE}}};

static void a_number_limits_the_meaning_of_its_signs(void **state) {
    static const struct {
        const char *text;
        CzDecimalSign sign;
        double point, comma; /* NaN: not a number with that decimal sign */
    } numbers[] = {{"12", CZ_SIGN_SILENT, 12, 12},
                   {"-7", CZ_SIGN_SILENT, -7, -7},
                   {"\xe2\x88\x92"
                    "7",
                    CZ_SIGN_SILENT, -7, -7},
                   {"007", CZ_SIGN_SILENT, 7, 7},
                   {"1.5", CZ_SIGN_POINT, 1.5, NAN},
                   {"1,5", CZ_SIGN_COMMA, NAN, 1.5},
                   {".5", CZ_SIGN_POINT, 0.5, NAN},
                   {",5", CZ_SIGN_COMMA, NAN, 0.5},
                   {"5,", CZ_SIGN_COMMA, NAN, 5},
                   {"1.050", CZ_SIGN_OPEN_POINT, 1.05, 1050},
                   {"1,050", CZ_SIGN_OPEN_COMMA, 1050, 1.05},
                   {"-1,050", CZ_SIGN_OPEN_COMMA, -1050, -1.05},
                   {"0,050", CZ_SIGN_COMMA, NAN, 0.05},
                   {"1050,123", CZ_SIGN_COMMA, NAN, 1050.123},
                   {"1,050.5", CZ_SIGN_POINT, 1050.5, NAN},
                   {"1.050,5", CZ_SIGN_COMMA, NAN, 1050.5},
                   {"1,050,000", CZ_SIGN_POINT, 1050000, NAN},
                   {"1.050.000", CZ_SIGN_COMMA, NAN, 1050000},
                   {"1'050.25", CZ_SIGN_POINT, 1050.25, NAN},
                   {"1 050", CZ_SIGN_SILENT, 1050, 1050},
                   {"1\xc2\xa0"
                    "050,5",
                    CZ_SIGN_COMMA, NAN, 1050.5},
                   {"1.5e3", CZ_SIGN_POINT, 1500, NAN},
                   {"1,050E+03", CZ_SIGN_COMMA, NAN, 1050},
                   {"2D-2", CZ_SIGN_SILENT, 0.02, 0.02},
                   {"12.05.2024", CZ_SIGN_NO_NUMBER, NAN, NAN},
                   {"1,05,000", CZ_SIGN_NO_NUMBER, NAN, NAN},
                   {"12:30", CZ_SIGN_NO_NUMBER, NAN, NAN},
                   {"1 2", CZ_SIGN_NO_NUMBER, NAN, NAN},
                   {"5 kN", CZ_SIGN_NO_NUMBER, NAN, NAN},
                   {"1e", CZ_SIGN_NO_NUMBER, NAN, NAN},
                   {"-", CZ_SIGN_NO_NUMBER, NAN, NAN},
                   {"", CZ_SIGN_NO_NUMBER, NAN, NAN},
                   {"nan", CZ_SIGN_NO_NUMBER, NAN, NAN},
                   {"0x10", CZ_SIGN_NO_NUMBER, NAN, NAN}};
    (void)state;
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        const char *text = numbers[i].text;
        if (cz_curve_number_sign(text, strlen(text)) != numbers[i].sign)
            fail_msg("'%s'", text);
        for (int k = 0; k < 2; k++) {
            const double expected = k == 0 ? numbers[i].point : numbers[i].comma;
            double value = NAN;
            const bool is_one = cz_curve_number_read(text, strlen(text), ".,"[k], &value);
            if (is_one == isnan(expected))
                fail_msg("'%s' with '%c'", text, ".,"[k]);
            if (is_one)
                assert_near(value, expected, ROUNDING_OF_A_VALUE, 0);
        }
    }
}

/* Reads a text as a curve; the message is empty when it is valid. */
static CzStatus read(CzArena *arena, const char *text, size_t n_byte, CzCurvePoints *points,
                     CzError *error) {
    *error = (CzError){0};
    return cz_curve_points_read_memory(arena, "test", text, n_byte, &wanted, points, error);
}

static void a_curve_is_read_in_every_notation(void **state) {
    static const char *const texts[] = {
        "stroke_mm,force_kN\n0,0\n1.5,300\n300,1050.5\n",
        "sep=;\nstroke_mm;force_kN\n0;0\n1,5;300\n300;1050,5\n",
        "Weg [mm]\tKraft [N]\r\n0\t0\r\n1,5\t300.000\r\n300\t1.050.500\r\n",
        "Time,Extension,Load\n(s),(mm),(N)\n0,0,0\n1,1.5,300000\n2,300,1050500\n",
        "a test,12\nof,10,20\n\nExtension (cm);Load (daN)\n0;0\n0.15;30000\n30;105050\n",
        "\"stroke (mm)\",\"force (kN)\"\n\"0\",\"0\"\n\"1,5\",\"300\"\n\"300\",\"1 050,5\"\n",
        "  stroke   force\n   (m)    (MN)\n 0.0     0.0\n 0.0015  0.3\n 0.3     1.0505\n",
        "stroke_mm;force_kN;\n0;0;\n1.5;300;\n300;1050.5;\n;;\n",
        "Speed (mm/s),s (mm),F (kN)\n0,0,0\n9,1.5,300\n9,300,1050.5\n",
        "mm;kN\n0;0\n1.5;300\n300;1050.5",
        ("Samples\t20\t20\t\nX\tstroke (mm)\tforce (kN)\tComment\n0\t0\t0\n1\t1.5\t300\n"
         "2\t300\t1050.5\n"),
        "t;stroke_mm;force_kN;Comment\n0;0;0\n1;1.5;300\n2;300;1050.5\n",
        "% stroke_mm force_kN\n0 0\n1.5 3e2\n3.0E+02 1.0505E+03\n"};
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        static const double x[] = {0, 0.0015, 0.3}, f[] = {0, 3e5, 1.0505e6};
        CzArena arena = {0};
        CzCurvePoints points;
        CzError error;
        if (read(&arena, texts[i], strlen(texts[i]), &points, &error) != CZ_OK)
            fail_msg("%s: %s", texts[i], error.message);
        assert_int_equal(points.n, 3);
        for (int k = 0; k < 3; k++) {
            assert_near(points.x[k], x[k], ROUNDING_OF_A_FORMULA, 0);
            assert_near(points.y[k], f[k], ROUNDING_OF_A_FORMULA, 0);
        }
        cz_arena_free(&arena);
    }
}

static void an_ambiguous_file_is_refused(void **state) {
    static const struct {
        const char *text;
        int line, column;
        const char *sentence;
    } files[] = {
        {"stroke_mm;force_kN\n0;0\n5;1,050\n", 3, 3, "'1,050' may be 1050 or 1.05"},
        {"stroke_mm;force_N\n0;0\n5;950\n10;1.050\n", 4, 4, "'1.050' may be 1.05 or 1050"},
        {"stroke_mm,force_kN\n0,5,10,2\n", 2, 1,
         "this line has 4 columns, the titles in line 1 have 2"},
        {"stroke_mm;force_kN\n0.5;1\n1;1,5\n", 3, 3, "numbers have two decimal signs"},
        {"s (mm);d (mm);F (kN)\n0;0;0\n1;1;1\n", 1, 1, "more than one column may be the stroke"},
        {"stroke_mm;force_kN\nmm;N\n0;0\n1;1\n", 1, 11, "the force has two units: kN in its title"},
        {"stroke;force\nmm;stone\n0;0\n1;1\n", 2, 4,
         "'stone' in the row of units is not a unit of the force, which takes kN, N"},
        {"stroke;force\ninches;kN\n0;0\n1;1\n", 2, 1, "'inches' in the row of units is not a unit"},
        {"stroke_mm;F\n0;0\n1;1\n", 1, 1, "no column is the force; the titles are"},
        {"stroke_mm;force_Nm\n0;0\n1;1\n", 1, 11, "the unit of column 'force_Nm', the force"},
        {"stroke_mm;\xe4\xe4;force_Nm\n0;0;0\n1;1;1\n", 1, 14, "the unit of column 'force_Nm'"},
        {"stroke_mm;force_kN\n0;0\n1;5 kN\n", 3, 3, "force: '5 kN' is not a number"},
        {"0;0\n1;1\n", 1, 1, "no line of titles above names the column of the stroke"},
        {"stroke_mm;force_kN\n0;0\nstroke_mm;force_kN\n0;0\n", 3, 1, "is not a number"},
        {"stroke_mm,force_kN\n0,0\n1,\"500\n2,600\n", 3, 3,
         "the quotation mark here is not closed"},
        {"Stroke (\"),Force (kN)\n0,0\n1,5\n", 1, 9, "the quotation mark here is not closed"},
        {"# a test\nmm;kN\n1;2\nX;Weg (mm);Kraft (kN)\n0;0;0\n", 4, 1,
         "the titles in line 2 have 2"},
        {"stroke_mm force_kN comment\n0 0\n1 1\n", 2, 1, "this line has 2 columns"},
        {"stroke_mm;force_kN;comment\n0;0;x\n1;1\n", 3, 1, "this line has 2 columns"},
        {"stroke_mm;force_kN\n0;0\n\x01;1\n", 3, 1, "the file contains the control character"}};
    (void)state;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        CzArena arena = {0};
        CzCurvePoints points;
        CzError error;
        assert_int_equal(read(&arena, files[i].text, strlen(files[i].text), &points, &error),
                         CZ_STATUS_INPUT);
        if (strstr(error.message, files[i].sentence) == NULL || error.line != files[i].line ||
            error.column != files[i].column)
            fail_msg("%d:%d: %s", error.line, error.column, error.message);
        cz_arena_free(&arena);
    }
}

/* A stroke of 463.5 m is impossible, so the point is the decimal sign. */
static void an_impossible_size_decides_the_decimal_sign(void **state) {
    static const char text[] = "stroke_mm;force_kN\n0;0\n4.500;791.606\n463.500;693.100\n";
    CzArena arena = {0};
    CzCurvePoints points;
    CzError error;
    (void)state;
    assert_int_equal(read(&arena, text, strlen(text), &points, &error), CZ_OK);
    assert_near(points.x[2], 0.4635, 1e-14, 0);
    cz_arena_free(&arena);
}

/* Bytes are changed, dropped and doubled at random: the reader accepts or refuses. */
static void any_text_is_accepted_or_refused(void **state) {
    static const char seed_text[] = "sep=;\nTest \"a\";1,5\n\nWeg [mm];Kraft (N)\n(mm);N;\n"
                                    "0;\"1.050\";\n1,5;2.100\n# end\n3e0\t4;5\n-1'000;7\r8;9\n";
    static const char bytes[] = ";,\t \"'.#[]()0e-\n\r\xef\xbb\xbf\xff\xfe\x00\x1a";
    unsigned state_of = 1;
    (void)state;
    for (int trial = 0; trial < 20000; trial++) {
        char text[256];
        size_t n = sizeof seed_text - 1;
        memcpy(text, seed_text, n);
        for (int change = 0; change < 1 + trial % 7; change++) {
            state_of = state_of * 1664525U + 1013904223U;
            const size_t at = (state_of >> 8) % n;
            const unsigned kind = (state_of >> 4) % 3;
            if (kind == 0)
                text[at] = bytes[(state_of >> 16) % sizeof bytes];
            else if (kind == 1 && n > 20)
                memmove(text + at, text + at + 1, --n - at);
            else if (n + n - at < sizeof text) {
                memmove(text + n, text + at, n - at);
                n += n - at;
            }
        }
        char *copy = malloc(n); /* so that reading beyond the end is detected */
        memcpy(copy, text, n);
        CzArena arena = {0};
        CzCurvePoints points;
        CzError error;
        const CzStatus status = read(&arena, copy, n, &points, &error);
        assert_true(status == CZ_OK || (status == CZ_STATUS_INPUT && error.message[0] != '\0'));
        assert_true(status != CZ_OK || points.n >= 2);
        cz_arena_free(&arena);
        free(copy);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_number_limits_the_meaning_of_its_signs),
        cmocka_unit_test(a_curve_is_read_in_every_notation),
        cmocka_unit_test(an_ambiguous_file_is_refused),
        cmocka_unit_test(an_impossible_size_decides_the_decimal_sign),
        cmocka_unit_test(any_text_is_accepted_or_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
