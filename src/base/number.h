/* Numbers as text with a decimal point, in every locale of the host program. */
#ifndef CZ_BASE_NUMBER_H
#define CZ_BASE_NUMBER_H

#include <stdbool.h>

enum { CZ_NUMBER_TEXT = 32 }; /* size of the longest number that cz_number_print writes [byte] */

/* Reads a whole text as a decimal number: sign, digits with a point, exponent. On success *value is
 * finite and NULL is returned; otherwise the end of a sentence that begins with the text, such as
 * "is not finite". */
const char *cz_number_parse(const char *text, double *value);

/* Reads a decimal number as machines write it: leading zeros are allowed. False when the text is
 * not a number, or too large for one. */
bool cz_number_scan(const char *text, double *value);

/* Writes the shortest text that reads back to the same bits; NaN and infinities are written as
 * "nan", "inf", "-inf". Returns `text`. */
const char *cz_number_print(char text[CZ_NUMBER_TEXT], double value);

/* The same at once, with 15 or 17 significant digits: for long lists of numbers. */
const char *cz_number_print_exact(char text[CZ_NUMBER_TEXT], double value);

/* Writes a number for a sentence: at most six significant digits. Returns `text`. */
const char *cz_number_print_short(char text[CZ_NUMBER_TEXT], double value);

/* The same for an argument of a sentence; the text is valid until the end of the block. */
#define CZ_SHORT(value) cz_number_print_short((char[CZ_NUMBER_TEXT]){0}, (value))

#endif
