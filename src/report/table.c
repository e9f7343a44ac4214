/* Tables as data, and as text: widths are counted in characters, so that names in UTF-8 line up. */
#include "report/table.h"

#include <stdlib.h>
#include <string.h>

enum { COLUMN_SPACE = 3 };

static const char *const style_begin[] = {[CZ_STYLE_PLAIN] = "",
                                          [CZ_STYLE_GOOD] = "\033[32m",
                                          [CZ_STYLE_CAREFUL] = "\033[33m",
                                          [CZ_STYLE_BAD] = "\033[1;31m",
                                          [CZ_STYLE_SMALL] = ""};

void cz_text_write(const char *text, CzStyle style, bool colour, FILE *stream) {
    const bool painted = colour && style_begin[style][0] != '\0';
    if (painted)
        fputs(style_begin[style], stream);
    for (; *text != '\0'; text++)
        fputc((unsigned char)*text < 0x20 || *text == 0x7f ? '?' : *text, stream);
    if (painted)
        fputs("\033[0m", stream);
}

/* ---- data ---- */

static const char *keep(CzReportTable *table, const char *text) {
    const char *copy = cz_arena_copy_text(&table->arena, text, strlen(text));
    table->failed |= copy == NULL;
    return copy != NULL ? copy : "";
}

void cz_table_head(CzReportTable *table, const char *head) {
    if (table->n_column == CZ_MOST_COLUMNS)
        return;
    const bool is_number = head != NULL && head[0] == '>';
    table->column[table->n_column].head = head != NULL ? keep(table, head + is_number) : NULL;
    table->column[table->n_column++].is_number = is_number;
}

void cz_table_begin(CzReportTable *table, int n_head, const char *const *head) {
    memset(table, 0, sizeof *table);
    for (int i = 0; i < n_head; i++)
        cz_table_head(table, head[i]);
}

static void put(CzReportTable *table, CzReportCell cell) {
    if (table->n_cell == table->room && !table->failed) {
        const int room = 2 * table->room + 64;
        CzReportCell *grown = realloc(table->cell, (size_t)room * sizeof *grown);
        table->failed = grown == NULL;
        if (!table->failed) {
            table->cell = grown;
            table->room = room;
        }
    }
    if (!table->failed)
        table->cell[table->n_cell++] = cell;
}

void cz_table_put(CzReportTable *table, const char *text, CzStyle style) {
    put(table, (CzReportCell){.text = keep(table, text != NULL ? text : ""), .style = style});
}

void cz_table_put_bar(CzReportTable *table, const CzBar *bar, double share) {
    put(table, (CzReportCell){.text = "", .drawing = CZ_DRAWING_BAR, .bar = bar, .share = {share}});
}

void cz_table_put_range(CzReportTable *table, double start, double best) {
    put(table, (CzReportCell){.text = "", .drawing = CZ_DRAWING_RANGE, .share = {start, best}});
}

void cz_table_free(CzReportTable *table) {
    free(table->cell);
    table->cell = NULL;
    cz_arena_free(&table->arena);
}

/* ---- text ---- */

static bool begins_character(char byte) {
    return ((unsigned char)byte & 0xc0) != 0x80;
}

static int width_of(const char *text) {
    int width = 0;
    for (; *text != '\0'; text++)
        width += begins_character(*text);
    return width;
}

/* Writes a row without the blanks at its end. */
static void write_row(const CzReportTable *table, const CzReportCell *cell, const int *width,
                      bool colour, FILE *stream) {
    int last = table->n_column - 1;
    while (last > 0 && (table->column[last].head == NULL || cell[last].text[0] == '\0'))
        last--;
    for (int column = 0; column <= last; column++) {
        if (width[column] == 0)
            continue;
        const int blank = width[column] - width_of(cell[column].text);
        const bool right = table->column[column].is_number;
        fprintf(stream, "%*s", (column > 0 ? COLUMN_SPACE : 0) + (right ? blank : 0), "");
        cz_text_write(cell[column].text, cell[column].style, colour, stream);
        if (!right && column < last)
            fprintf(stream, "%*s", blank, "");
    }
    fputc('\n', stream);
}

bool cz_table_write_text(CzReportTable *table, bool colour, FILE *stream) {
    CzReportCell head[CZ_MOST_COLUMNS];
    int width[CZ_MOST_COLUMNS] = {0};
    if (table->failed)
        fputs("no memory for this table\n", stream);
    for (int column = 0; column < table->n_column; column++) {
        const char *text = table->column[column].head;
        head[column] = (CzReportCell){.text = text != NULL ? text : ""};
        width[column] = width_of(head[column].text);
    }
    for (int i = 0; i < table->n_cell; i++) {
        const int column = i % table->n_column, cell_width = width_of(table->cell[i].text);
        if (table->column[column].head != NULL && cell_width > width[column])
            width[column] = cell_width;
    }
    write_row(table, head, width, colour, stream);
    for (int i = 0; i + table->n_column <= table->n_cell; i += table->n_column)
        write_row(table, &table->cell[i], width, colour, stream);
    cz_table_free(table);
    return !table->failed;
}
