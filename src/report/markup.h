/* HTML and SVG, written from top to bottom: texts escaped, the same bytes in every locale.
 *
 * The HTML is valid XML too. A full disk shows when the file of the stream is closed.
 */
#ifndef CZ_REPORT_MARKUP_H
#define CZ_REPORT_MARKUP_H

#include "crushzone/names.h"

#include <stdbool.h>
#include <stdio.h>

enum {
    CZ_SENTENCE_SIZE = CZ_MAX_TEXT + 500 /* a sentence with a title or with names in it [byte] */
};

/* Zero-initialise it and set the stream. */
typedef struct CzMarkup {
    FILE *stream;
    bool failed;   /* no memory: the page is incomplete */
    bool is_alone; /* the next figure is a document of its own */
} CzMarkup;

/* Writes markup as it is given, with ' for the quotes of attributes, and values in it:
 *   %s         a text, escaped; control characters become '?'
 *   %d, %ld    a whole number
 *   %.1f       a number with at most so many decimals and no zeros at its end; 0 when not finite
 *   %%         a percent sign */
void cz_markup_write(CzMarkup *markup, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#endif
