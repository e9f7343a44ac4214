/* Columns of text on a terminal: collected first, written once their widths are known. */
#ifndef CZ_REPORT_GRID_H
#define CZ_REPORT_GRID_H

#include "base/arena.h"

#include <stdio.h>

typedef enum CzStyle { CZ_STYLE_PLAIN, CZ_STYLE_GOOD, CZ_STYLE_CAREFUL, CZ_STYLE_BAD } CzStyle;

typedef struct CzGrid {
    const char *alignment; /* one of l and r per column */
    int n_column;
    struct CzGridCell *cell; /* row after row (n_cell) */
    int n_cell, room;
    bool failed;   /* no memory */
    CzArena arena; /* of the texts */
} CzGrid;

/* Starts a grid; `alignment` has one letter per column, l or r, and is borrowed. */
void cz_grid_begin(CzGrid *grid, const char *alignment);

/* Appends a cell; rows follow each other as they are full. Control characters become '?'. */
void cz_grid_put(CzGrid *grid, const char *text, CzStyle style);

/* Writes all rows and frees the grid. False without memory: then rows are missing, which the text
 * says too. */
bool cz_grid_write(CzGrid *grid, bool colour, FILE *stream);

/* Writes a text in a style, control characters as '?'. */
void cz_grid_write_text(const char *text, CzStyle style, bool colour, FILE *stream);

#endif
