/* Lines and fields of curve files.
 *
 * Text may be UTF-8, UTF-16 with its mark, or in the Western code page of older machines; lines end
 * in LF, CR LF or CR. Fields are separated by ';', tabs, ',' or runs of blanks; quotes protect a
 * field.
 */
#ifndef CZ_TEXT_CURVE_FIELDS_H
#define CZ_TEXT_CURVE_FIELDS_H

#include "text/source.h"

enum { CZ_MAX_FIELD_TEXT = 128 }; /* of a field that is kept as text, with its end [byte] */

/* Splits a text into lines. `source` has name, folder and order; its lines are in the arena. A
 * mistake is added when the content is not text. False in that case, and without memory. */
bool cz_curve_lines(CzArena *arena, CzMistakes *mistakes, const char *text, size_t n_byte,
                    CzSource *source);

/* A field of a line, without blanks and quotes around it. */
typedef struct CzField {
    const char *text; /* in the line (n) */
    size_t n;
    int column; /* character of the line, counted from 1 */
} CzField;

/* Iterates over the fields of a line; the separator is ' ' for blanks. */
typedef struct CzFieldWalk {
    CzField field;  /* present field */
    int n;          /* fields so far, that one included */
    const char *at; /* NULL: no further field */
    char separator;
    const char *counted; /* characters of the line have been counted up to here */
    int n_character;
} CzFieldWalk;

CzFieldWalk cz_fields_begin(const char *line, char separator);
bool cz_fields_next(CzFieldWalk *walk);

/* The index-th field from 0; false when the line has none. */
bool cz_field_take(const char *line, char separator, int index, CzField *field);

/* Number of fields of a line, and of those up to the last one that is not empty. */
typedef struct CzFieldCount {
    int all, filled;
} CzFieldCount;
CzFieldCount cz_fields_count(const char *line, char separator);

/* Whether a field is a number with either decimal sign. */
bool cz_field_is_number(const CzField *field);

/* Copies a field as text, cut where it is too long. */
const char *cz_field_text(const CzField *field, char text[CZ_MAX_FIELD_TEXT]);

/* Whether a line has only blanks and separators. */
bool cz_line_is_empty(const char *line);

/* The text after the sign of a comment, '#', '%' or '//'; NULL when the line is not a comment. */
const char *cz_line_comment(const char *line);

/* The separator that `sep=;` in the first line announces; 0 without such a line. */
char cz_line_announced_separator(const char *line);

/* The separator by which most lines have two numbers or more, in the same number of fields; ','
 * when no line has. */
char cz_fields_separator(const CzSource *source);

#endif
