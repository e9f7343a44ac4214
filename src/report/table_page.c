/* Tables as HTML. */
#include "report/table.h"

#include <math.h>
#include <string.h>

static void write_bar(CzMarkup *markup, const CzBar *bar, double share) {
    const double size = bar->half * fmin(fabs(share), 1);
    cz_markup_write(markup, "<svg class='%s' viewBox='0 0 %.0f 10' aria-hidden='true'><rect",
                    bar->class_name, 2 * bar->middle);
    if (bar->fill_class != NULL)
        cz_markup_write(markup, " class='%s'", bar->fill_class);
    cz_markup_write(markup,
                    " x='%.1f' y='1' width='%.1f' height='8' fill='%s'/>"
                    "<path d='M%.0f 0v10' stroke='currentColor'/></svg>",
                    share < 0 ? bar->middle - size : bar->middle, fmax(size, 0.6),
                    share < 0 ? bar->below : bar->above, bar->middle);
}

static void write_mark(CzMarkup *markup, double at, bool is_best) {
    cz_markup_write(markup,
                    "<circle cx='%.1f' cy='8' r='%d' fill='%s' stroke='%s' stroke-width='2'/>",
                    8 + 104 * fmin(fmax(at, 0), 1), is_best ? 5 : 4, is_best ? "#0072b2" : "none",
                    is_best ? "#0072b2" : "#d55e00");
}

/* Start (a ring) and best (a dot) between the bounds. */
static void write_range(CzMarkup *markup, const double share[2]) {
    cz_markup_write(markup, "<svg class='place' viewBox='0 0 120 16' aria-hidden='true'>"
                            "<path d='M8 8H112M8 3V13M112 3V13' stroke='currentColor'/>");
    for (int i = 0; i < 2; i++)
        if (!isnan(share[i]))
            write_mark(markup, share[i], i == 1);
    cz_markup_write(markup, "</svg>");
}

/* A head, which may be wrapped after the dots of a path. */
static void write_head(CzMarkup *markup, const char *text, bool is_number) {
    cz_markup_write(markup, is_number ? "<th class='number'>" : "<th>");
    while (*text != '\0') {
        char part[CZ_SENTENCE_SIZE];
        const int n = (int)strcspn(text, ".") + (strchr(text, '.') != NULL);
        snprintf(part, sizeof part, "%.*s", n, text);
        text += n;
        cz_markup_write(markup, *text != '\0' ? "%s<wbr/>" : "%s", part);
    }
    cz_markup_write(markup, "</th>");
}

/* `head` is that of the column, in front of the cell on a narrow page; NULL for none. */
static void write_cell(CzMarkup *markup, const CzReportCell *cell, bool is_number,
                       const char *head) {
    static const char *const class_names[][2] = {[CZ_STYLE_PLAIN] = {NULL, "number"},
                                                 [CZ_STYLE_GOOD] = {"pass", "number pass"},
                                                 [CZ_STYLE_CAREFUL] = {"careful", "number careful"},
                                                 [CZ_STYLE_BAD] = {"fail", "number fail"},
                                                 [CZ_STYLE_SMALL] = {"small", "number small"}};
    const char *class_name = class_names[cell->style][is_number];
    cz_markup_write(markup, class_name != NULL ? "<td class='%s'" : "<td", class_name);
    if (cell->id != NULL)
        cz_markup_write(markup, " id='%s'", cell->id);
    if (head != NULL && head[0] != '\0' && cell->text[0] != '\0')
        cz_markup_write(markup, " data-head='%s'", head);
    cz_markup_write(markup, ">");
    if (cell->drawing == CZ_DRAWING_RANGE)
        write_range(markup, cell->share);
    else if (cell->link != NULL && cell->text[0] != '\0')
        cz_markup_write(markup, "<a href='%s'>%s</a>", cell->link, cell->text);
    else if (cell->drawing == CZ_DRAWING_NONE)
        cz_markup_write(markup, "%s", cell->text);
    else if (isfinite(cell->share[0]))
        write_bar(markup, cell->bar, cell->share[0]);
    cz_markup_write(markup, "</td>");
}

/* Whether rows become paragraphs on a narrow page: tables of class `cards`, and those without a
 * class that do not fit there. */
static bool shows_cards(const CzReportTable *table) {
    enum { FEW = 4 }; /* columns that can be read side by side on 400 pixels */
    int n_shown = 0;
    for (int k = 0; k < table->n_column; k++)
        n_shown += table->column[k].head != NULL;
    return table->class_name != NULL ? strstr(table->class_name, "cards") != NULL : n_shown > FEW;
}

/* The first cell of a paragraph is its title, without a head unless it is a number. */
static bool has_head_in_cards(const CzReportTable *table, int column) {
    return column > 0 || table->column[column].is_number;
}

void cz_table_write_page(CzReportTable *table, CzMarkup *markup) {
    const bool is_cards = shows_cards(table);
    const char *class_name = table->class_name != NULL || !is_cards ? table->class_name : "cards";
    markup->failed |= table->arena.out_of_memory;
    cz_markup_write(markup,
                    class_name != NULL ? "<div class='wide'><table class='%s'><tr>"
                                       : "<div class='wide'><table><tr>",
                    class_name);
    for (int k = 0; k < table->n_column; k++)
        if (table->column[k].head != NULL)
            write_head(markup, table->column[k].head, table->column[k].is_number);
    cz_markup_write(markup, "</tr>\n");
    for (int i = 0; i + table->n_column <= table->n_cell; i += table->n_column) {
        cz_markup_write(markup, "<tr>");
        for (int k = 0; k < table->n_column; k++)
            if (table->column[k].head != NULL)
                write_cell(markup, &table->cell[i + k], table->column[k].is_number,
                           is_cards && has_head_in_cards(table, k) ? table->column[k].head : NULL);
        cz_markup_write(markup, "</tr>\n");
    }
    cz_markup_write(markup, "</table></div>\n");
    cz_table_free(table);
}
