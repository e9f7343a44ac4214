/* Tables as data: columns, rows, marks. They are collected first and written as text on a terminal
 * or as HTML on a page; what is in them does not depend on how they are written.
 */
#ifndef CZ_REPORT_TABLE_H
#define CZ_REPORT_TABLE_H

#include "base/arena.h"
#include "report/markup.h"

#include <stdio.h>

/* How a cell is marked: by colour, on a page by a class. CZ_STYLE_SMALL is for remarks. */
typedef enum CzStyle {
    CZ_STYLE_PLAIN,
    CZ_STYLE_GOOD,
    CZ_STYLE_CAREFUL,
    CZ_STYLE_BAD,
    CZ_STYLE_SMALL
} CzStyle;

/* How a share is drawn on a page: to the right of the middle above zero, to the left below. */
typedef struct CzBar {
    const char *class_name, *fill_class; /* fill_class NULL for none */
    double half, middle;                 /* longest way to either side, place of zero */
    const char *below, *above;           /* colours */
} CzBar;

/* A cell: text, or on a page a drawing. */
typedef enum CzDrawing { CZ_DRAWING_NONE, CZ_DRAWING_BAR, CZ_DRAWING_RANGE } CzDrawing;

typedef struct CzReportCell {
    const char *text; /* in the arena */
    CzStyle style;
    CzDrawing drawing;
    const CzBar *bar;
    double share[2]; /* of a bar the first; of a range start and best */
} CzReportCell;

enum { CZ_MOST_COLUMNS = 24 };

typedef struct CzReportTable {
    const char *class_name; /* on a page; NULL for none */
    int n_column;
    struct {
        const char *head; /* NULL: the column is left out */
        bool is_number;   /* to the right */
    } column[CZ_MOST_COLUMNS];
    CzReportCell *cell; /* row after row, those of columns that are left out too (n_cell) */
    int n_cell, room;
    bool failed;   /* no memory */
    CzArena arena; /* of the texts */
} CzReportTable;

/* Starts a table with these heads: one that begins with '>' is above numbers, a column with NULL is
 * left out. Further heads may be added before the first row. */
void cz_table_begin(CzReportTable *table, int n_head, const char *const *head);
void cz_table_head(CzReportTable *table, const char *head);

/* Appends a cell; rows follow each other as they are full. Control characters become '?'; NULL is
 * empty. */
void cz_table_put(CzReportTable *table, const char *text, CzStyle style);
/* Cells that are drawn on a page and empty in text: a bar, nothing for NaN; where the start and the
 * best value of a variable are between its bounds, 0 to 1, NaN for none. */
void cz_table_put_bar(CzReportTable *table, const CzBar *bar, double share);
void cz_table_put_range(CzReportTable *table, double start, double best);

/* Frees a table that is not written. */
void cz_table_free(CzReportTable *table);

/* Writes all rows and frees the table. False without memory: then rows are missing, which the text
 * says too. */
bool cz_table_write_text(CzReportTable *table, bool colour, FILE *stream);
/* The same as HTML, scrolling sideways where it is too wide; without memory the page has failed. */
void cz_table_write_page(CzReportTable *table, CzMarkup *markup);

/* Writes a text in a style on a terminal, control characters as '?'. */
void cz_text_write(const char *text, CzStyle style, bool colour, FILE *stream);

#endif
