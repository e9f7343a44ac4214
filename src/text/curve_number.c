/* The grammar of numbers in curve files. */
#include "text/curve_number.h"

#include <string.h>

#include "base/number.h"

enum { MAX_MARKS = 16, LONGEST = 64 };

/* The parts of a number: digits, with the marks between them. */
typedef struct Parts {
    char digits[LONGEST]; /* sign, digits, and 'e' with the exponent; without marks */
    int n;
    int n_mark;
    char mark[MAX_MARKS]; /* '.', ',' or '\'' for signs that only group digits */
    int at[MAX_MARKS];    /* digits of the mantissa before each */
    int n_mantissa;       /* digits */
    int first;            /* index of the first digit of the mantissa */
    bool has_exponent;
} Parts;

/* Length in bytes of a sign at a place that only groups thousands: apostrophe, blank, no-break
 * blank. */
static size_t group_length(const char *text, size_t n) {
    static const char *const signs[] = {
        "'", " ", "\xc2\xa0", "\xe2\x80\xaf", "\xe2\x80\x89", "\xe2\x80\x99"};
    for (size_t i = 0; i < sizeof signs / sizeof *signs; i++) {
        const size_t length = strlen(signs[i]);
        if (n >= length && memcmp(text, signs[i], length) == 0)
            return length;
    }
    return 0;
}

static bool put(Parts *parts, char c) {
    if (parts->n + 1 >= LONGEST)
        return false;
    parts->digits[parts->n++] = c;
    parts->digits[parts->n] = '\0';
    return true;
}

static bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/* Reads a sign at the start of a text; returns its length in bytes. */
static size_t read_sign(Parts *parts, const char *text, size_t n) {
    static const char minus[] = "\xe2\x88\x92"; /* typographic minus */
    if (n > 0 && (*text == '-' || *text == '+')) {
        put(parts, *text);
        return 1;
    }
    if (n >= 3 && memcmp(text, minus, 3) == 0) {
        put(parts, '-');
        return 3;
    }
    return 0;
}

/* Reads an exponent that ends with the text. */
static bool read_exponent(Parts *parts, const char *text, size_t n) {
    parts->has_exponent = true;
    put(parts, 'e');
    size_t at = 1 + read_sign(parts, text + 1, n - 1);
    if (at == n)
        return false;
    for (; at < n; at++)
        if (!is_digit(text[at]) || !put(parts, text[at]))
            return false;
    return true;
}

static bool split_number(const char *text, size_t n, Parts *parts) {
    *parts = (Parts){.n = 0};
    size_t i = read_sign(parts, text, n);
    parts->first = parts->n;
    while (i < n) {
        const size_t group = group_length(text + i, n - i);
        const bool is_mark = text[i] == '.' || text[i] == ',' || group > 0;
        if (is_digit(text[i])) {
            if (!put(parts, text[i++]))
                return false;
            parts->n_mantissa++;
        } else if (is_mark && parts->n_mark < MAX_MARKS) {
            parts->at[parts->n_mark] = parts->n_mantissa;
            parts->mark[parts->n_mark++] = group > 0 ? '\'' : text[i];
            i += group > 0 ? group : 1;
        } else if (parts->n_mantissa > 0 && strchr("eEdD", text[i]) != NULL) {
            return read_exponent(parts, text + i, n - i);
        } else {
            return false;
        }
    }
    return parts->n_mantissa > 0;
}

/* Whether marks up to the n_group-th can group thousands of the digits in front of `end`. */
static bool groups(const Parts *parts, int n_group, int end) {
    if (n_group == 0)
        return true;
    if (parts->at[0] < 1 || parts->at[0] > 3 || parts->digits[parts->first] == '0')
        return false;
    for (int i = 0; i < n_group; i++) {
        const int next = i + 1 < n_group ? parts->at[i + 1] : end;
        if (parts->mark[i] != parts->mark[0] || next - parts->at[i] != 3)
            return false;
    }
    return !parts->has_exponent;
}

/* Whether the parts are a number with this decimal sign. */
static bool is_number_with(const Parts *parts, char decimal) {
    const int n = parts->n_mark;
    const bool has_decimals = n > 0 && parts->mark[n - 1] == decimal;
    const int n_group = has_decimals ? n - 1 : n;
    const int end = has_decimals ? parts->at[n - 1] : parts->n_mantissa;
    for (int i = 0; i < n_group; i++)
        if (parts->mark[i] == decimal)
            return false;
    return groups(parts, n_group, end);
}

CzDecimalSign cz_curve_number_sign(const char *text, size_t n) {
    Parts parts;
    if (!split_number(text, n, &parts))
        return CZ_SIGN_NO_NUMBER;
    const bool point = is_number_with(&parts, '.'), comma = is_number_with(&parts, ',');
    if (!point && !comma)
        return CZ_SIGN_NO_NUMBER;
    if (point != comma)
        return point ? CZ_SIGN_POINT : CZ_SIGN_COMMA;
    const char last = parts.n_mark > 0 ? parts.mark[parts.n_mark - 1] : '\'';
    return last == '\'' ? CZ_SIGN_SILENT : last == '.' ? CZ_SIGN_OPEN_POINT : CZ_SIGN_OPEN_COMMA;
}

bool cz_curve_number_read(const char *text, size_t n, char decimal, double *value) {
    Parts parts;
    char plain[LONGEST + 1];
    if (!split_number(text, n, &parts) || !is_number_with(&parts, decimal))
        return false;
    const int last = parts.n_mark - 1;
    const bool has_decimals = last >= 0 && parts.mark[last] == decimal;
    const int cut = parts.first + (has_decimals ? parts.at[last] : parts.n_mantissa);
    memcpy(plain, parts.digits, (size_t)cut);
    plain[cut] = '.';
    memcpy(plain + cut + 1, parts.digits + cut, (size_t)(parts.n - cut) + 1);
    return cz_number_scan(plain, value);
}
