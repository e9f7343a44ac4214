/* Numbers as text: formats of the C library, with a decimal point in every locale. */
#include "report/figure.h"

#include <ctype.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

/* The decimal sign of a locale: no digit, sign or letter; it may have several bytes. */
static bool is_decimal_sign(char c) {
    return !isdigit((unsigned char)c) && c != '+' && c != '-' && (c < 'a' || c > 'z');
}

double cz_figure_quantity(double value) {
    const double leftover = 1e-9;
    return fabs(value) < leftover ? 0 : value;
}

double cz_figure_exact(double value) {
    return value == 0 ? 0 : value;
}

/* Removes the sign of a zero. */
static void unsign_zero(char *text) {
    if (text[0] == '-' && text[strspn(text, "-0.")] == '\0')
        memmove(text, text + 1, strlen(text));
}

static const char *with_point(char text[CZ_FIGURE_SIZE]) {
    char *sign = text;
    while (*sign != '\0' && !is_decimal_sign(*sign))
        sign++;
    if (*sign == '\0')
        return text;
    char *rest = sign;
    while (*rest != '\0' && is_decimal_sign(*rest))
        rest++;
    *sign = '.';
    memmove(sign + 1, rest, strlen(rest) + 1);
    return text;
}

/* ---- digits without the library ---------------------------------------------------------------
 */

/* Numbers of usual size, as %.*g writes them. With a power of ten that is a number exactly, the
 * digits are one product away, and only near a tie does its rounding decide: those are left to the
 * library, as is what it writes with an exponent. Long tables are half their time in its general
 * way. */
enum { MAX_QUICK_DIGITS = 12 };
#define SMALLEST_QUICK 1e-4 /* smaller ones have an exponent */
#define NEAR_A_TIE 1e-3     /* a product below 1e12 is off by 6e-5 at most */

static const double power_of_ten[] = {1e0, 1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7, 1e8,
                                      1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16};

/* Power of ten of the first digit. */
static int magnitude(double size) {
    int power = 0;
    while (size >= power_of_ten[power + 1])
        power++;
    while (power <= 0 && size * power_of_ten[-power] < 1.0)
        power--;
    return power;
}

/* Writes the digits of n, the first of which has a given power of ten, without zeros at the end of
 * the fraction. */
static void place_digits(char *text, uint64_t n, int n_digit, int power) {
    for (; n % 10 == 0 && n_digit > 1; n_digit--)
        n /= 10;
    char digit[MAX_QUICK_DIGITS];
    for (int i = n_digit - 1; i >= 0; i--, n /= 10)
        digit[i] = (char)('0' + n % 10);
    int at = 0;
    if (power < 0)
        *text++ = '0';
    for (; at <= power; at++)
        *text++ = at < n_digit ? digit[at] : '0';
    if (at < n_digit)
        *text++ = '.';
    for (int zero = power + 1; zero < 0; zero++)
        *text++ = '0';
    for (; at < n_digit; at++)
        *text++ = digit[at];
    *text = '\0';
}

static bool write_quickly(char *text, int digits, double value) {
    const double size = fabs(value);
    if (digits > MAX_QUICK_DIGITS || !(size >= SMALLEST_QUICK && size < power_of_ten[digits]))
        return false;
    int power = magnitude(size);
    const double scaled = size * power_of_ten[digits - 1 - power];
    const double whole = floor(scaled), rest = scaled - whole;
    uint64_t n = (uint64_t)whole + (rest > 0.5);
    if (n >= (uint64_t)power_of_ten[digits]) {
        n /= 10;
        power++;
    }
    if (fabs(rest - 0.5) < NEAR_A_TIE || power >= digits)
        return false;
    if (value < 0.0)
        *text++ = '-';
    place_digits(text, n, digits, power);
    return true;
}

const char *cz_figure_digits(char text[CZ_FIGURE_SIZE], int digits, double value) {
    if (write_quickly(text, digits, value))
        return text;
    snprintf(text, CZ_FIGURE_SIZE, "%.*g", digits, value);
    with_point(text);
    unsign_zero(text);
    return text;
}

const char *cz_figure_fixed(char text[CZ_FIGURE_SIZE], int decimals, double value) {
    if (!(fabs(value) < 1e15))
        return cz_figure_digits(text, 15, value);
    snprintf(text, CZ_FIGURE_SIZE, "%.*f", decimals, value);
    with_point(text);
    unsign_zero(text);
    return text;
}

const char *cz_figure_plain(char text[CZ_FIGURE_SIZE], double value) {
    if (!isfinite(value)) {
        snprintf(text, CZ_FIGURE_SIZE, "-");
        return text;
    }
    value = cz_figure_quantity(value);
    const double size = fabs(value);
    if (value == 0)
        return cz_figure_fixed(text, 0, 0);
    if (size < 0.01)
        return cz_figure_digits(text, 2, value);
    return cz_figure_fixed(text, size < 10 ? 2 : size < 100 ? 1 : 0, value);
}

/* A percentage with `plus` before it unless it is negative; with two digits, or with `is_whole`
 * without decimals from ten on. */
static const char *write_percent(char text[CZ_FIGURE_SIZE], const char *plus, bool is_whole,
                                 double percent) {
    const double most = 999, size = fabs(cz_figure_quantity(percent));
    char number[CZ_FIGURE_SIZE];
    if (isnan(percent)) {
        snprintf(text, CZ_FIGURE_SIZE, "-");
        return text;
    }
    if (size >= most + 0.5) {
        snprintf(text, CZ_FIGURE_SIZE, percent < 0 ? "< -999 %%" : "> 999 %%");
        return text;
    }
    if (is_whole && size >= 9.95)
        cz_figure_fixed(number, 0, size);
    else
        cz_figure_digits(number, 2, size);
    snprintf(text, CZ_FIGURE_SIZE, "%s%.40s %%", size > 0 && percent < 0 ? "-" : plus, number);
    return text;
}

const char *cz_figure_percent(char text[CZ_FIGURE_SIZE], double share) {
    return write_percent(text, "", true, 100 * share);
}

const char *cz_figure_margin(char text[CZ_FIGURE_SIZE], double share) {
    return write_percent(text, "+", true, 100 * share);
}

const char *cz_figure_change(char text[CZ_FIGURE_SIZE], double change) {
    return write_percent(text, "", false, 100 * change);
}

const char *cz_figure_mark(char text[CZ_FIGURE_SIZE], bool beyond_validity) {
    const size_t n = strlen(text);
    if (beyond_validity && strcmp(text, "-") != 0 && n + 2 <= CZ_FIGURE_SIZE)
        memcpy(text + n, "*", 2);
    return text;
}
