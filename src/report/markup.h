/* HTML and SVG, written from top to bottom: escaped, well-formed, the same bytes in every locale.
 *
 * The HTML is valid XML too. A start tag accepts attributes until the first text or child. A full
 * disk shows when the file of the stream is closed.
 */
#ifndef CZ_REPORT_MARKUP_H
#define CZ_REPORT_MARKUP_H

#include "crushzone/names.h"

#include <stdbool.h>
#include <stdio.h>

enum {
    CZ_MARKUP_DEPTH = 32,
    CZ_SENTENCE_ROOM = CZ_MOST_TEXT + 500 /* a sentence with a title or with names in it [byte] */
};

/* Zero-initialise it and set the stream. */
typedef struct CzMarkup {
    FILE *stream;
    bool failed; /* no memory: the page is incomplete */
    bool in_tag; /* attributes may follow */
    int depth;
    const char *element[CZ_MARKUP_DEPTH]; /* those that are open, outermost first; borrowed */
} CzMarkup;

/* Opens an element inside the one that is open; `element` lives until it is closed. */
void cz_markup_open(CzMarkup *markup, const char *element);
/* The same with an attribute `class`. */
void cz_markup_open_class(CzMarkup *markup, const char *element, const char *class_name);
/* Closes the element that was opened last; the same with a line end. */
void cz_markup_close(CzMarkup *markup);
void cz_markup_end(CzMarkup *markup);

/* Attributes of the element that was opened last. Numbers get at most `decimals` places and no
 * zeros at their end. */
void cz_markup_attribute(CzMarkup *markup, const char *name, const char *value);
void cz_markup_number(CzMarkup *markup, const char *name, int decimals, double value);
/* Several at once: names with a blank between them and a value for each; pairs of name and value up
 * to a NULL. */
void cz_markup_numbers(CzMarkup *markup, int decimals, const char *names, const double *value);
void cz_markup_attributes(CzMarkup *markup, ...) __attribute__((sentinel));
void cz_markup_format(CzMarkup *markup, const char *name, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Text inside the element; control characters become '?'. */
void cz_markup_text(CzMarkup *markup, const char *text);
/* A line end, for readers of the source. */
void cz_markup_line(CzMarkup *markup);
/* Bytes as they are: a script, a style sheet. */
void cz_markup_raw(CzMarkup *markup, const char *text);

/* An element with nothing but text, also as printf makes it, and one of a class. */
void cz_markup_element(CzMarkup *markup, const char *element, const char *text);
void cz_markup_say(CzMarkup *markup, const char *element, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void cz_markup_classed(CzMarkup *markup, const char *element, const char *class_name,
                       const char *text);

/* A number as in an attribute: at most `decimals` places, "0" and not "-0". */
void cz_markup_write_number(FILE *stream, int decimals, double value);

/* An element of a figure without content: numbers as cz_markup_numbers, then pairs of name and
 * value up to a NULL. */
void cz_markup_shape(CzMarkup *markup, const char *element, const char *names, const double *value,
                     ...) __attribute__((sentinel));

/* Width of a text in a sans-serif font [font size]; an estimate on the large side. */
double cz_text_width(const char *text);

#endif
