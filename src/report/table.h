/* Tables as data: columns, rows, styles. They are collected first, then written as text on a
 * terminal or as HTML on a page. */
#ifndef CZ_REPORT_TABLE_H
#define CZ_REPORT_TABLE_H

#include "base/arena.h"
#include "report/markup.h"

#include <stdio.h>

/* Style of a cell: a colour, on a page a class. CZ_STYLE_SMALL is for remarks. */
typedef enum CzStyle {
    CZ_STYLE_PLAIN,
    CZ_STYLE_GOOD,
    CZ_STYLE_CAREFUL,
    CZ_STYLE_BAD,
    CZ_STYLE_SMALL
} CzStyle;

/* A bar on a page: to the right of the middle for positive shares, to the left for negative ones.
 */
typedef struct CzBar {
    const char *class_name, *fill_class; /* fill_class NULL for none */
    double half, middle;                 /* largest length to either side, place of zero */
    const char *below, *above;           /* colours */
} CzBar;

/* A cell: text, or on a page a drawing. */
typedef enum CzDrawing { CZ_DRAWING_NONE, CZ_DRAWING_BAR, CZ_DRAWING_RANGE } CzDrawing;

typedef struct CzReportCell {
    const char *text; /* in the arena */
    const char *link; /* on a page: an address; NULL for none */
    const char *id;   /* on a page: its name for links; NULL for none */
    CzStyle style;
    CzDrawing drawing;
    const CzBar *bar;
    double share[2]; /* of a bar the first; of a range start and best */
} CzReportCell;

enum { CZ_MAX_COLUMNS = 24 };

typedef struct CzReportTable {
    const char *class_name; /* on a page; NULL for none. A table of class `cards`, or of more than
                               four columns and no class, shows on a narrow page each row as a
                               paragraph with the heads in front of its cells */
    int n_column;
    struct {
        const char *head; /* NULL: the column is left out */
        bool is_number;   /* to the right */
    } column[CZ_MAX_COLUMNS];
    CzReportCell *cell; /* row after row, those of columns that are left out too (n_cell) */
    int n_cell;
    CzArena arena; /* of texts and cells */
} CzReportTable;

/* Starts a table with the heads of a text, semicolons between them; NULL: none yet. A head that
 * begins with '>' is above numbers. Further heads may be added before the first row; a column whose
 * head is NULL is left out. */
void cz_table_begin(CzReportTable *table, const char *heads);
void cz_table_head(CzReportTable *table, const char *head);

/* Appends a cell; after the last column it begins a new row. Control characters become '?'; NULL is
 * empty. */
void cz_table_put(CzReportTable *table, const char *text);
void cz_table_put_styled(CzReportTable *table, const char *text, CzStyle style);
void cz_table_put_format(CzReportTable *table, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* Cells that are drawn on a page and empty in text: a bar, nothing for NaN; where the start and the
 * best value of a variable are between its bounds, 0 to 1, NaN for none. */
void cz_table_put_bar(CzReportTable *table, const CzBar *bar, double share);
void cz_table_put_range(CzReportTable *table, double start, double best);

/* Makes the last cell a link, or gives it the name "STEM-NUMBER" for links. */
void cz_table_link(CzReportTable *table, const char *address);
void cz_table_anchor(CzReportTable *table, const char *stem, int number);

/* Frees a table that is not written. */
void cz_table_free(CzReportTable *table);

/* Zero-initialise it and set the first three members. */
typedef struct CzTerminal {
    FILE *stream;
    bool colour; /* escape codes are allowed */
    int width;   /* characters of a line, into which cells of a wider table are wrapped; 0: any */
    bool failed; /* no memory for a table: rows are missing, and the text reports it */
} CzTerminal;

/* Writes a text in a style: control characters become '?', line ends at the end of the format stay.
 */
void cz_terminal_print(CzTerminal *terminal, CzStyle style, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Writes all rows and frees the table. */
void cz_table_write_text(CzReportTable *table, CzTerminal *terminal);
/* The same as HTML, scrolling sideways where it is too wide; without memory the page has failed. */
void cz_table_write_page(CzReportTable *table, CzMarkup *markup);

#endif
