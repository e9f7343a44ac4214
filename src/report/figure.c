/* Numbers for people: the C library's formats, with the locale's decimal sign turned into a point.
 */
#include "report/figure.h"

#include <ctype.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/* A decimal sign is whatever is neither a digit, a sign nor a letter; it may be several bytes. */
static bool is_decimal_sign(char c) {
    return !isdigit((unsigned char)c) && c != '+' && c != '-' && (c < 'a' || c > 'z');
}

static const char *with_point(char text[CZ_FIGURE_ROOM]) {
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

const char *cz_figure_digits(char text[CZ_FIGURE_ROOM], int digits, double value) {
    snprintf(text, CZ_FIGURE_ROOM, "%.*g", digits, value);
    return with_point(text);
}

const char *cz_figure_fixed(char text[CZ_FIGURE_ROOM], int decimals, double value) {
    if (!(fabs(value) < 1e15))
        return cz_figure_digits(text, 15, value);
    snprintf(text, CZ_FIGURE_ROOM, "%.*f", decimals, value);
    return with_point(text);
}

const char *cz_figure_plain(char text[CZ_FIGURE_ROOM], double value) {
    if (!isfinite(value)) {
        snprintf(text, CZ_FIGURE_ROOM, "-");
        return text;
    }
    const double size = fabs(value);
    if (value == 0)
        return cz_figure_fixed(text, 0, 0);
    if (size < 0.01)
        return cz_figure_digits(text, 2, value);
    return cz_figure_fixed(text, size < 10 ? 2 : size < 100 ? 1 : 0, value);
}

/* A size in per cent: whole from ten on, else two digits. */
static void percent_digits(char text[CZ_FIGURE_ROOM], double percent) {
    if (percent >= 9.95)
        cz_figure_fixed(text, 0, percent);
    else
        cz_figure_digits(text, 2, percent);
}

const char *cz_figure_percent(char text[CZ_FIGURE_ROOM], double share) {
    if (!isfinite(share)) {
        snprintf(text, CZ_FIGURE_ROOM, "-");
        return text;
    }
    char number[CZ_FIGURE_ROOM];
    percent_digits(number, 100 * fabs(share));
    snprintf(text, CZ_FIGURE_ROOM, "%s%.40s %%", share < 0 ? "-" : "", number);
    return text;
}

const char *cz_figure_margin(char text[CZ_FIGURE_ROOM], double share) {
    if (!isfinite(share)) {
        snprintf(text, CZ_FIGURE_ROOM, "-");
        return text;
    }
    char number[CZ_FIGURE_ROOM];
    percent_digits(number, 100 * fabs(share));
    snprintf(text, CZ_FIGURE_ROOM, "%c%.40s %%", share < 0 ? '-' : '+', number);
    return text;
}

const char *cz_figure_change(char text[CZ_FIGURE_ROOM], double change) {
    char number[CZ_FIGURE_ROOM];
    if (!isfinite(change))
        return strcpy(text, "-");
    snprintf(text, CZ_FIGURE_ROOM, "%.40s %%", cz_figure_digits(number, 2, 100.0 * change));
    return text;
}
