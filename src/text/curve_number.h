/* Numbers of curve files: which sign parts decimals, which one groups thousands.
 *
 * A single "1,050" may be 1.05 or 1050. A number decides when its sign cannot group thousands (not
 * three digits behind it, a leading zero, an exponent) or cannot part decimals (it appears twice,
 * or in front of the other sign). What one number leaves open, the others of the file decide.
 */
#ifndef CZ_TEXT_CURVE_NUMBER_H
#define CZ_TEXT_CURVE_NUMBER_H

#include <stdbool.h>
#include <stddef.h>

/* What a text says about the decimal sign. */
typedef enum {
    CZ_SIGN_NO_NUMBER, /* it is no number under either sign */
    CZ_SIGN_SILENT,    /* a number without such a sign */
    CZ_SIGN_POINT,     /* a number whose decimal sign can only be a point */
    CZ_SIGN_COMMA,
    CZ_SIGN_OPEN_POINT, /* a number with one point that may part decimals or group thousands */
    CZ_SIGN_OPEN_COMMA
} CzDecimalSign;

CzDecimalSign cz_curve_number_sign(const char *text, size_t n);

/* Reads a number with a decimal sign, '.' or ','; the other sign, blanks and apostrophes may group
 * thousands. False when it is none, or not finite. */
bool cz_curve_number_read(const char *text, size_t n, char decimal, double *value);

#endif
