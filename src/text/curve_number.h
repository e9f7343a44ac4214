/* Numbers of curve files: their decimal sign and their thousands separator.
 *
 * A single "1,050" may be 1.05 or 1050. A number decides when its sign cannot group thousands (not
 * followed by three digits, a leading zero, an exponent) or cannot be the decimal sign (it appears
 * twice, or before the other sign). If a number leaves it open, others of the file decide.
 */
#ifndef CZ_TEXT_CURVE_NUMBER_H
#define CZ_TEXT_CURVE_NUMBER_H

#include <stdbool.h>
#include <stddef.h>

/* Evidence of a text for the decimal sign. */
typedef enum {
    CZ_SIGN_NO_NUMBER, /* not a number with either sign */
    CZ_SIGN_SILENT,    /* a number without such a sign */
    CZ_SIGN_POINT,     /* a number whose decimal sign can only be a point */
    CZ_SIGN_COMMA,
    CZ_SIGN_OPEN_POINT, /* a number with one point that may be decimal or group thousands */
    CZ_SIGN_OPEN_COMMA
} CzDecimalSign;

CzDecimalSign cz_curve_number_sign(const char *text, size_t n);

/* Reads a number with a decimal sign, '.' or ','; the other sign, blanks and apostrophes may group
 * thousands. False when it is not a number, or not finite. */
bool cz_curve_number_read(const char *text, size_t n, char decimal, double *value);

#endif
