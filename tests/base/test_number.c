/* Numbers as text, and did-you-mean. */
#include "support/check.h"

#include "base/number.h"
#include "base/suggest.h"

#include <ctype.h>

static void good_numbers_are_read_to_the_nearest_double(void **state) {
    (void)state;
    static const struct {
        const char *text;
        double value;
    } known[] = {{"0", 0},
                 {"-0.5", -0.5},
                 {"+3", 3},
                 {".5", 0.5},
                 {"5.", 5},
                 {"1e3", 1e3},
                 {"1E-3", 1e-3},
                 {"0.1", 0.1},
                 {"0e0", 0},
                 {"1e308", 1e308},
                 {"4.9e-324", 5e-324},
                 {"9007199254740993", 9007199254740992.0}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        double value = -1;
        assert_null(cz_number_parse(known[i].text, &value));
        assert_memory_equal(&value, &known[i].value, sizeof value);
    }
}

static void text_that_is_not_a_number_is_refused_with_a_reason(void **state) {
    (void)state;
    static const char *const bad[] = {"",      "-",     "abc", "1_000", "012",   "-01",
                                      "1:30",  ".nan",  "NaN", "inf",   "-.Inf", "0x10",
                                      "0o7",   "12 kN", "1,5", "1e999", "1e",    ".",
                                      "1.2.3", "--1",   "1 ",  " 1",    "1e+",   "e5"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        double value;
        const char *reason = cz_number_parse(bad[i], &value);
        assert_non_null(reason);
        assert_true(strncmp(reason, "is ", 3) == 0 || strncmp(reason, "begins ", 7) == 0);
    }
}

static void written_numbers_read_back_to_the_same_bits(void **state) {
    (void)state;
    const double values[] = {0,
                             1,
                             -1,
                             0.1,
                             1 / 3.0,
                             38700,
                             1e9,
                             1e-7,
                             2.5e-6,
                             1e22,
                             -1e-300,
                             1.7976931348623157e308,
                             5e-324,
                             2.2222222222222223,
                             123456789.123};
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
        char text[CZ_NUMBER_TEXT];
        double value;
        assert_null(cz_number_parse(cz_number_print(text, values[i]), &value));
        assert_memory_equal(&value, &values[i], sizeof value);
    }
}

/* Significant digits of a text, without zeros at the ends. */
static int count_digits(const char *text) {
    int n = 0, n_zero = 0;
    for (; *text != '\0' && *text != 'e'; text++) {
        if (!isdigit((unsigned char)*text))
            continue;
        n_zero = *text == '0' ? n_zero + 1 : 0;
        n += n > 0 || *text != '0';
    }
    return n - n_zero;
}

static void no_number_has_more_digits_than_it_needs(void **state) {
    (void)state;
    unsigned long bits = 1;
    for (int i = 0; i < 20000; i++) {
        double value;
        char text[CZ_NUMBER_TEXT], shorter[CZ_NUMBER_TEXT];
        bits = bits * 6364136223846793005UL + 1442695040888963407UL;
        memcpy(&value, &bits, sizeof value);
        if (!isfinite(value))
            continue;
        if (i % 2 == 0) /* of few digits */
            value = round(1e4 * ldexp(value, -ilogb(value))) / 1e5;
        const int n = count_digits(cz_number_print(text, value));
        assert_true(strtod(text, NULL) == value);
        snprintf(shorter, sizeof shorter, "%.*e", n > 1 ? n - 2 : 0, value);
        assert_true(n <= 1 || strtod(shorter, NULL) != value);
    }
}

static void written_numbers_have_a_readable_form(void **state) {
    (void)state;
    char text[CZ_NUMBER_TEXT];
    assert_string_equal(cz_number_print(text, 38700), "38700");
    assert_string_equal(cz_number_print(text, 0.05), "0.05");
    assert_string_equal(cz_number_print(text, 1e9), "1000000000");
    assert_string_equal(cz_number_print(text, 1e20), "1.0e+20");
    assert_string_equal(cz_number_print(text, 0.00001), "0.00001");
    assert_string_equal(cz_number_print(text, NAN), "nan");
    assert_string_equal(cz_number_print_short(text, 57.29577951), "57.2958");
}

static const char *suggest(const char *typed, int n_known, const char *const *known) {
    CzSuggestion suggestion = {0};
    const char *best = NULL;
    for (int i = 0; i < n_known; i++)
        if (cz_suggest(&suggestion, typed, known[i]))
            best = known[i];
    return best;
}

static void the_nearest_word_is_suggested(void **state) {
    (void)state;
    static const char *const known[] = {"force_N", "force_kN", "force_MN", "stroke_mm", "gap"};
    assert_string_equal(suggest("forse_kN", 5, known), "force_kN");
    assert_string_equal(suggest("force_KN", 5, known), "force_kN");
    assert_string_equal(suggest("stroke", 5, known), "stroke_mm");
    assert_string_equal(suggest("gpa", 5, known), "gap");
    assert_string_equal(suggest("gap", 5, known), "gap");
}

static void a_word_that_resembles_none_gets_no_suggestion(void **state) {
    (void)state;
    static const char *const known[] = {"force_N", "gap", "x"};
    assert_null(suggest("weather", 3, known));
    assert_null(suggest("", 3, known));
    assert_null(suggest("y", 3, known));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(good_numbers_are_read_to_the_nearest_double),
        cmocka_unit_test(text_that_is_not_a_number_is_refused_with_a_reason),
        cmocka_unit_test(written_numbers_read_back_to_the_same_bits),
        cmocka_unit_test(no_number_has_more_digits_than_it_needs),
        cmocka_unit_test(written_numbers_have_a_readable_form),
        cmocka_unit_test(the_nearest_word_is_suggested),
        cmocka_unit_test(a_word_that_resembles_none_gets_no_suggestion),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
