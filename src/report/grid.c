/* Columns of text: widths are counted in characters, so that names in UTF-8 line up. */
#include "report/grid.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_COLUMNS = 12, COLUMN_SPACE = 3 };

typedef struct CzGridCell {
    const char *text; /* in the arena */
    CzStyle style;
} CzGridCell;

static const char *const style_begin[] = {[CZ_STYLE_PLAIN] = "",
                                          [CZ_STYLE_GOOD] = "\033[32m",
                                          [CZ_STYLE_CAREFUL] = "\033[33m",
                                          [CZ_STYLE_BAD] = "\033[1;31m"};

static bool begins_character(char byte) {
    return ((unsigned char)byte & 0xc0) != 0x80;
}

static int width_of(const char *text) {
    int width = 0;
    for (; *text != '\0'; text++)
        width += begins_character(*text);
    return width;
}

void cz_grid_write_text(const char *text, CzStyle style, bool colour, FILE *stream) {
    const bool painted = colour && style != CZ_STYLE_PLAIN;
    if (painted)
        fputs(style_begin[style], stream);
    for (; *text != '\0'; text++)
        fputc((unsigned char)*text < 0x20 || *text == 0x7f ? '?' : *text, stream);
    if (painted)
        fputs("\033[0m", stream);
}

void cz_grid_begin(CzGrid *grid, const char *alignment) {
    memset(grid, 0, sizeof *grid);
    grid->alignment = alignment;
    grid->n_column = (int)strlen(alignment);
}

void cz_grid_put(CzGrid *grid, const char *text, CzStyle style) {
    if (grid->n_cell == grid->room && !grid->failed) {
        const int room = 2 * grid->room + 64;
        CzGridCell *cell = realloc(grid->cell, (size_t)room * sizeof *cell);
        grid->failed = cell == NULL;
        if (!grid->failed) {
            grid->cell = cell;
            grid->room = room;
        }
    }
    if (grid->failed)
        return;
    const char *copy = cz_arena_copy_text(&grid->arena, text, strlen(text));
    grid->failed = copy == NULL;
    if (!grid->failed)
        grid->cell[grid->n_cell++] = (CzGridCell){copy, style};
}

static void write_row(const CzGrid *grid, const CzGridCell *cell, const int *width, bool colour,
                      FILE *stream) {
    int last = grid->n_column - 1;
    while (last > 0 && cell[last].text[0] == '\0')
        last--;
    for (int column = 0; column <= last; column++) {
        if (width[column] == 0)
            continue;
        const int blank = width[column] - width_of(cell[column].text);
        const bool right = grid->alignment[column] == 'r';
        fprintf(stream, "%*s", (column > 0 ? COLUMN_SPACE : 0) + (right ? blank : 0), "");
        cz_grid_write_text(cell[column].text, cell[column].style, colour, stream);
        if (!right && column < last)
            fprintf(stream, "%*s", blank, "");
    }
    fputc('\n', stream);
}

bool cz_grid_write(CzGrid *grid, bool colour, FILE *stream) {
    int width[MAX_COLUMNS] = {0};
    if (grid->failed)
        fputs("no memory for this table\n", stream);
    for (int i = 0; i < grid->n_cell; i++) {
        const int cell_width = width_of(grid->cell[i].text);
        if (cell_width > width[i % grid->n_column])
            width[i % grid->n_column] = cell_width;
    }
    for (int i = 0; i + grid->n_column <= grid->n_cell; i += grid->n_column)
        write_row(grid, &grid->cell[i], width, colour, stream);
    free(grid->cell);
    grid->cell = NULL;
    cz_arena_free(&grid->arena);
    return !grid->failed;
}
