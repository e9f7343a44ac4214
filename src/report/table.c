/* Tables as data, and as text: widths are counted in characters, so that names in UTF-8 line up. */
#include "report/table.h"

#include <stdarg.h>
#include <string.h>

enum { COLUMN_SPACE = 3 };

static const char *const style_begin[] = {[CZ_STYLE_PLAIN] = "",
                                          [CZ_STYLE_GOOD] = "\033[32m",
                                          [CZ_STYLE_CAREFUL] = "\033[33m",
                                          [CZ_STYLE_BAD] = "\033[1;31m",
                                          [CZ_STYLE_SMALL] = ""};

static void write_styled(CzTerminal *terminal, const char *text, size_t n, CzStyle style) {
    const bool painted = terminal->colour && style_begin[style][0] != '\0';
    if (painted)
        fputs(style_begin[style], terminal->stream);
    for (const char *end = text + n; text < end; text++)
        fputc((unsigned char)*text < 0x20 || *text == 0x7f ? '?' : *text, terminal->stream);
    if (painted)
        fputs("\033[0m", terminal->stream);
}

void cz_terminal_print(CzTerminal *terminal, CzStyle style, const char *format, ...) {
    enum { TEXT_SIZE = 4 * CZ_SENTENCE_SIZE };
    char text[TEXT_SIZE];
    const char *end = format + strlen(format);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    while (end > format && end[-1] == '\n')
        end--;
    const size_t n = strlen(text), n_end = strlen(end);
    write_styled(terminal, text, n >= n_end ? n - n_end : 0, style);
    fputs(end, terminal->stream);
}

/* ---- data ---- */

static const char *keep(CzReportTable *table, const char *text) {
    const char *copy = cz_arena_copy_text(&table->arena, text, strlen(text));
    return copy != NULL ? copy : "";
}

void cz_table_head(CzReportTable *table, const char *head) {
    if (table->n_column == CZ_MAX_COLUMNS)
        return;
    const bool is_number = head != NULL && head[0] == '>';
    table->column[table->n_column].head = head != NULL ? keep(table, head + is_number) : NULL;
    table->column[table->n_column++].is_number = is_number;
}

void cz_table_begin(CzReportTable *table, const char *heads) {
    memset(table, 0, sizeof *table);
    while (heads != NULL) {
        char head[CZ_LABEL_SIZE];
        const size_t n = strcspn(heads, ";");
        snprintf(head, sizeof head, "%.*s", (int)n, heads);
        cz_table_head(table, head);
        heads = heads[n] != '\0' ? heads + n + 1 : NULL;
    }
}

static void put(CzReportTable *table, CzReportCell cell) {
    CzArena *arena = &table->arena;
    CzReportCell *grown = arena->out_of_memory ? NULL
                                               : cz_arena_grow(arena, table->cell, table->n_cell,
                                                               sizeof *table->cell);
    if (grown == NULL)
        return;
    table->cell = grown;
    table->cell[table->n_cell++] = cell;
}

void cz_table_put_styled(CzReportTable *table, const char *text, CzStyle style) {
    put(table, (CzReportCell){.text = keep(table, text != NULL ? text : ""), .style = style});
}

void cz_table_put(CzReportTable *table, const char *text) {
    cz_table_put_styled(table, text, CZ_STYLE_PLAIN);
}

void cz_table_put_format(CzReportTable *table, const char *format, ...) {
    char text[CZ_SENTENCE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    cz_table_put(table, text);
}

void cz_table_put_bar(CzReportTable *table, const CzBar *bar, double share) {
    put(table, (CzReportCell){.text = "", .drawing = CZ_DRAWING_BAR, .bar = bar, .share = {share}});
}

void cz_table_put_range(CzReportTable *table, double start, double best) {
    put(table, (CzReportCell){.text = "", .drawing = CZ_DRAWING_RANGE, .share = {start, best}});
}

/* The last cell; NULL without memory. */
static CzReportCell *last_cell(const CzReportTable *table) {
    return table->arena.out_of_memory || table->n_cell == 0 ? NULL
                                                            : &table->cell[table->n_cell - 1];
}

void cz_table_link(CzReportTable *table, const char *address) {
    const char *link = keep(table, address);
    if (last_cell(table) != NULL)
        last_cell(table)->link = link;
}

void cz_table_anchor(CzReportTable *table, const char *stem, int number) {
    char id[CZ_LABEL_SIZE];
    snprintf(id, sizeof id, "%s-%d", stem, number);
    const char *kept = keep(table, id);
    if (last_cell(table) != NULL)
        last_cell(table)->id = kept;
}

void cz_table_free(CzReportTable *table) {
    cz_arena_free(&table->arena);
}

/* ---- text ---- */

static bool begins_character(char byte) {
    return ((unsigned char)byte & 0xc0) != 0x80;
}

static int width_of_part(const char *text, size_t n) {
    int width = 0;
    for (const char *end = text + n; text < end; text++)
        width += begins_character(*text);
    return width;
}

static int width_of(const char *text) {
    return width_of_part(text, strlen(text));
}

/* Layout of a table on a terminal. */
typedef struct Layout {
    int space; /* between columns */
    int width[CZ_MAX_COLUMNS];
} Layout;

/* Bytes of a text that fit into a width: up to its last blank there, else of a long word up to its
 * last hyphen, stop or slash. */
static size_t fitting_part(const char *text, int width) {
    size_t n = 0, blank = 0, joint = 0;
    int seen = 0;
    for (; text[n] != '\0'; n++) {
        seen += begins_character(text[n]);
        if (text[n] == ' ' && seen <= width + 1)
            blank = n;
        if (seen > width)
            return blank > 0 ? blank : joint > 0 ? joint : n;
        if (n > 0 && strchr("-./", text[n]) != NULL)
            joint = n + 1;
    }
    return n;
}

/* Width below which a cell is not narrowed: that of its longest word, a number with its unit. */
static int narrowest(const char *text, bool is_number) {
    enum { LONG_WORD = 10, LONG_NUMBER = 24 }; /* beyond these, words are divided */
    int longest = 0, word = 0;
    for (; *text != '\0'; text++) {
        word = *text == ' ' && !is_number ? 0 : word + begins_character(*text);
        longest = word > longest ? word : longest;
    }
    const int most = is_number ? LONG_NUMBER : LONG_WORD;
    return longest < most ? longest : most;
}

static void widen(int *width, int other) {
    *width = other > *width ? other : *width;
}

static int total_width(const CzReportTable *table, const Layout *layout) {
    int total = -layout->space;
    for (int column = 0; column < table->n_column; column++)
        total += layout->width[column] > 0 ? layout->width[column] + layout->space : 0;
    return total;
}

/* Brings a table that is wider than the terminal closer together, then narrows its widest column,
 * and so on, until it fits or no column can be narrowed. */
static void narrow(const CzReportTable *table, const int *least, int most, Layout *layout) {
    if (total_width(table, layout) > most)
        layout->space = 1;
    while (total_width(table, layout) > most) {
        int widest = -1;
        for (int column = 0; column < table->n_column; column++)
            if (layout->width[column] > least[column] &&
                (widest < 0 || layout->width[column] > layout->width[widest]))
                widest = column;
        if (widest < 0)
            return;
        layout->width[widest]--;
    }
}

static Layout lay_out(const CzReportTable *table, const CzReportCell *head, int most) {
    Layout layout = {.space = COLUMN_SPACE};
    int least[CZ_MAX_COLUMNS] = {0};
    for (int i = -table->n_column; i < table->n_cell; i++) {
        const int column = (i + table->n_column) % table->n_column;
        const char *text = i < 0 ? head[column].text : table->cell[i].text;
        if (table->column[column].head == NULL)
            continue;
        widen(&layout.width[column], width_of(text));
        widen(&least[column], narrowest(text, table->column[column].is_number));
    }
    if (most > 0)
        narrow(table, least, most, &layout);
    return layout;
}

/* Writes one line of a row without trailing blanks, and moves on in the texts of its cells; returns
 * whether one of them goes on. */
static bool write_line(const CzReportTable *table, const CzReportCell *cell, const Layout *layout,
                       const char **rest, CzTerminal *terminal) {
    int last = table->n_column - 1;
    bool goes_on = false;
    while (last > 0 && (layout->width[last] == 0 || rest[last][0] == '\0'))
        last--;
    for (int column = 0; column <= last; column++) {
        if (layout->width[column] == 0)
            continue;
        const size_t n = fitting_part(rest[column], layout->width[column]);
        const int blank = layout->width[column] - width_of_part(rest[column], n);
        const bool right = table->column[column].is_number;
        fprintf(terminal->stream, "%*s", (column > 0 ? layout->space : 0) + (right ? blank : 0),
                "");
        write_styled(terminal, rest[column], n, cell[column].style);
        if (!right && column < last)
            fprintf(terminal->stream, "%*s", blank, "");
        rest[column] += n + strspn(rest[column] + n, " ");
        goes_on |= rest[column][0] != '\0';
    }
    fputc('\n', terminal->stream);
    return goes_on;
}

static void write_row(const CzReportTable *table, const CzReportCell *cell, const Layout *layout,
                      CzTerminal *terminal) {
    const char *rest[CZ_MAX_COLUMNS];
    for (int column = 0; column < table->n_column; column++)
        rest[column] = cell[column].text;
    while (write_line(table, cell, layout, rest, terminal)) {
    }
}

void cz_table_write_text(CzReportTable *table, CzTerminal *terminal) {
    CzReportCell head[CZ_MAX_COLUMNS];
    terminal->failed |= table->arena.out_of_memory;
    if (table->arena.out_of_memory)
        fputs("no memory for this table\n", terminal->stream);
    for (int column = 0; column < table->n_column; column++) {
        const char *text = table->column[column].head;
        head[column] = (CzReportCell){.text = text != NULL ? text : ""};
    }
    const Layout layout = lay_out(table, head, terminal->width);
    write_row(table, head, &layout, terminal);
    for (int i = 0; i + table->n_column <= table->n_cell; i += table->n_column)
        write_row(table, &table->cell[i], &layout, terminal);
    cz_table_free(table);
}
