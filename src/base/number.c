/* Numbers as text: the thread's locale is the C locale while a number is read or written. */
#include "base/number.h"

#include <locale.h>
#include <ctype.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

typedef struct {
    locale_t c, before;
} LocaleGuard;

static LocaleGuard locale_enter(void) {
    LocaleGuard guard = {newlocale(LC_ALL_MASK, "C", (locale_t)0), (locale_t)0};
    if (guard.c != (locale_t)0)
        guard.before = uselocale(guard.c);
    return guard;
}

static void locale_leave(LocaleGuard guard) {
    if (guard.c == (locale_t)0)
        return;
    uselocale(guard.before);
    freelocale(guard.c);
}

static bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

static const char *skip_digits(const char *text) {
    while (is_digit(*text))
        text++;
    return text;
}

/* End of the longest decimal number at the start of a text, or NULL when there is none. */
static const char *decimal_end(const char *text) {
    const char *at = text + (*text == '+' || *text == '-');
    const char *whole = at;
    at = skip_digits(at);
    size_t n_digit = (size_t)(at - whole);
    if (*at == '.') {
        const char *fraction = skip_digits(at + 1);
        n_digit += (size_t)(fraction - (at + 1));
        at = fraction;
    }
    if (n_digit == 0)
        return NULL;
    if (*at == 'e' || *at == 'E') {
        const char *exponent = at + 1 + (at[1] == '+' || at[1] == '-');
        if (is_digit(*exponent))
            at = skip_digits(exponent);
    }
    return at;
}

static bool is_word(const char *text, const char *const *words) {
    const char *bare = text + (*text == '+' || *text == '-');
    for (int i = 0; words[i] != NULL; i++)
        if (strcasecmp(bare, words[i]) == 0)
            return true;
    return false;
}

/* Whether a text consists of groups of three digits, each after the character of the first:
 * ,000,000.
 */
static bool groups_digits(const char *text) {
    const char *at = text;
    while (*at == text[0] && is_digit(at[1]) && is_digit(at[2]) && is_digit(at[3]))
        at += 4;
    return *at == '\0' && at > text;
}

/* Reason why a text is not a decimal number. */
static const char *what_is_wrong(const char *text, const char *end) {
    static const char *const not_finite[] = {".nan", "nan", ".inf", "inf", "infinity", NULL};
    const char *bare = text + (*text == '+' || *text == '-');
    if (is_word(text, not_finite))
        return "is not a finite number";
    if (bare[0] == '0' && (bare[1] == 'x' || bare[1] == 'X' || bare[1] == 'o'))
        return "is not a decimal number";
    if (strncmp(text, "\xe2\x88\x92", 3) == 0 || strncmp(text, "\xe2\x80\x93", 3) == 0)
        return "is not a number: its minus sign is not the character '-'";
    if (end == NULL)
        return "is not a number";
    if (*end == '_')
        return "is not a number: digits are not grouped with '_'";
    if (*end == ',' && groups_digits(end))
        return "is not a number: digits are not grouped, and the decimal sign is a point";
    if (strchr("' .", *end) != NULL && groups_digits(end))
        return "is not a number: digits are not grouped";
    if (*end == '%')
        return "is not a number: write a share as 0.3, not as 30%";
    if (strncmp(end, "\xc2\xa0", 2) == 0)
        return "is not a number: a no-break space follows it (U+00A0)";
    if (*end == ',')
        return "is not a number: the decimal sign is a point";
    if (*end == ':')
        return "is not a number: it contains ':'";
    end += strspn(end, " ");
    if (*end == '\0')
        return "is not a number: a space follows it";
    if (*end == '#' || strncmp(end, "//", 2) == 0)
        return "is not a number: a comment begins with a space and '#'";
    const char *operand = end + 1 + strspn(end + 1, " ");
    if (strchr("+*/^", *end) != NULL && is_digit(*operand))
        return "is not a number: formulas are not computed; write the result";
    if (ispunct((unsigned char)*end) && *end != '/')
        return "is not a number: another character follows it";
    return "is not a number: the unit belongs to the key, not to the value";
}

const char *cz_number_parse(const char *text, double *value) {
    const char *end = decimal_end(text);
    if (end == NULL || *end != '\0')
        return what_is_wrong(text, end);
    const char *bare = text + (*text == '+' || *text == '-');
    if (bare[0] == '0' && is_digit(bare[1]))
        return "begins with a zero; remove it";
    const LocaleGuard guard = locale_enter();
    *value = strtod(text, NULL);
    locale_leave(guard);
    return isfinite(*value) ? NULL : "is too large for a number";
}

bool cz_number_scan(const char *text, double *value) {
    const char *end = decimal_end(text);
    if (end == NULL || *end != '\0')
        return false;
    const LocaleGuard guard = locale_enter();
    *value = strtod(text, NULL);
    locale_leave(guard);
    return isfinite(*value);
}

/* Writes `digits` significant digits, without an exponent for numbers of usual size. */
static void print_digits(char text[CZ_NUMBER_TEXT], int digits, double value) {
    snprintf(text, CZ_NUMBER_TEXT, "%.*e", digits - 1, value);
    const char *exponent = strchr(text, 'e');
    const int power = exponent != NULL ? atoi(exponent + 1) : 0;
    if (exponent == NULL)
        return;
    if (power < -5 || power > 15) {
        if (digits == 1) /* YAML 1.1 reads 1e+20 as text, 1.0e+20 as a number */
            snprintf(text, CZ_NUMBER_TEXT, "%.1e", value);
        return;
    }
    const int n_decimal = digits - 1 - power;
    snprintf(text, CZ_NUMBER_TEXT, "%.*f", n_decimal > 0 ? n_decimal : 0, value);
}

/* Fewest significant digits that may read back to the same bits. Every decimal number of up to 15
 * digits is the same when it is printed with 15, so its zeros at the end need not be written; below
 * the normal numbers this fails.
 */
static int fewest_digits(double value) {
    char text[CZ_NUMBER_TEXT];
    if (!isfinite(value) || fabs(value) < DBL_MIN)
        return 1;
    snprintf(text, sizeof text, "%.*e", DBL_DIG - 1, value);
    if (strtod(text, NULL) != value)
        return DBL_DIG + 1;
    const char *end = strchr(text, 'e');
    int digits = DBL_DIG;
    while (digits > 1 && end[digits - DBL_DIG - 1] == '0')
        digits--;
    return digits;
}

const char *cz_number_print(char text[CZ_NUMBER_TEXT], double value) {
    const LocaleGuard guard = locale_enter();
    for (int digits = fewest_digits(value); digits <= DBL_DIG + 2; digits++) {
        print_digits(text, digits, value);
        if (!isfinite(value) || strtod(text, NULL) == value)
            break;
    }
    locale_leave(guard);
    return text;
}

const char *cz_number_print_exact(char text[CZ_NUMBER_TEXT], double value) {
    const LocaleGuard guard = locale_enter();
    snprintf(text, CZ_NUMBER_TEXT, "%.15g", value);
    if (isfinite(value) && strtod(text, NULL) != value)
        snprintf(text, CZ_NUMBER_TEXT, "%.17g", value);
    locale_leave(guard);
    return text;
}

const char *cz_number_print_short(char text[CZ_NUMBER_TEXT], double value) {
    const LocaleGuard guard = locale_enter();
    snprintf(text, CZ_NUMBER_TEXT, "%.6g", value);
    locale_leave(guard);
    return text;
}
