/* Lines of JSON whose keys are written and read in a fixed order, so that reading is fast: those of
 * journals and of shards. */
#ifndef CZ_REPORT_LINES_H
#define CZ_REPORT_LINES_H

#include <stdbool.h>
#include <stdio.h>

#include "base/arena.h"

/* ---- writing: a text with its quotes, a list with its key and a comma before or behind it ---- */

void cz_line_write_text(const char *text, FILE *stream);
void cz_line_write_texts(const char *key, int n, const char *const *text, FILE *stream);
/* A number to the last bit. JSON has no infinities, which are texts, and no NaN, which is null. */
void cz_line_write_number(double value, FILE *stream);
void cz_line_write_numbers(const char *key, int n, const double *value, FILE *stream);

/* ---- reading: each function removes what it reads ---- */

/* A place in a line; `failed` after the first text that is not as it is written. */
typedef struct CzLineCursor {
    char *at;
    bool failed;
    CzArena *arena; /* of texts and numbers */
} CzLineCursor;

/* This text itself. */
void cz_line_expect(CzLineCursor *cursor, const char *text);
/* A text with its quotes; undoes its escapes. */
const char *cz_line_text(CzLineCursor *cursor);
/* A number up to the sign that follows it. */
double cz_line_number(CzLineCursor *cursor);
/* A whole number behind a text. */
long cz_line_integer(CzLineCursor *cursor, const char *before);
/* A list behind a text; *n is its length. */
const double *cz_line_numbers(CzLineCursor *cursor, const char *before, int *n);
const char *const *cz_line_texts(CzLineCursor *cursor, const char *before, int *n);

#endif
