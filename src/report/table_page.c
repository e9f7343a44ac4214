/* Tables as HTML. */
#include "report/table.h"

#include <math.h>
#include <string.h>

static void write_bar(CzMarkup *markup, const CzBar *bar, double share) {
    const double size = bar->half * fmin(fabs(share), 1);
    cz_markup_open_class(markup, "svg", bar->class_name);
    cz_markup_format(markup, "viewBox", "0 0 %g 10", 2 * bar->middle);
    cz_markup_attribute(markup, "aria-hidden", "true");
    cz_markup_open(markup, "rect");
    if (bar->fill_class != NULL)
        cz_markup_attribute(markup, "class", bar->fill_class);
    cz_markup_number(markup, "x", 1, share < 0 ? bar->middle - size : bar->middle);
    cz_markup_attribute(markup, "y", "1");
    cz_markup_number(markup, "width", 1, fmax(size, 0.6));
    cz_markup_attributes(markup, "height", "8", "fill", share < 0 ? bar->below : bar->above, NULL);
    cz_markup_close(markup);
    cz_markup_open(markup, "path");
    cz_markup_format(markup, "d", "M%g 0v10", bar->middle);
    cz_markup_attribute(markup, "stroke", "currentColor");
    cz_markup_close(markup);
    cz_markup_close(markup);
}

static void write_mark(CzMarkup *markup, double at, bool is_best) {
    cz_markup_shape(markup, "circle", "cx", (const double[]){8 + 104 * fmin(fmax(at, 0), 1)}, "cy",
                    "8", "r", is_best ? "5" : "4", "fill", is_best ? "#0072b2" : "none", "stroke",
                    is_best ? "#0072b2" : "#d55e00", "stroke-width", "2", NULL);
}

/* Start (a ring) and best (a dot) between the bounds. */
static void write_range(CzMarkup *markup, const double share[2]) {
    cz_markup_open(markup, "svg");
    cz_markup_attributes(markup, "class", "place", "viewBox", "0 0 120 16", "aria-hidden", "true",
                         NULL);
    cz_markup_open(markup, "path");
    cz_markup_attributes(markup, "d", "M8 8H112M8 3V13M112 3V13", "stroke", "currentColor", NULL);
    cz_markup_close(markup);
    for (int i = 0; i < 2; i++)
        if (!isnan(share[i]))
            write_mark(markup, share[i], i == 1);
    cz_markup_close(markup);
}

/* A head, which may be broken behind the dots of a path. */
static void write_head(CzMarkup *markup, const char *text, bool is_number) {
    cz_markup_open(markup, "th");
    if (is_number)
        cz_markup_attribute(markup, "class", "number");
    while (*text != '\0') {
        char part[CZ_SENTENCE_ROOM];
        const int n = (int)strcspn(text, ".") + (strchr(text, '.') != NULL);
        snprintf(part, sizeof part, "%.*s", n, text);
        cz_markup_text(markup, part);
        text += n;
        if (*text != '\0') {
            cz_markup_open(markup, "wbr");
            cz_markup_close(markup);
        }
    }
    cz_markup_close(markup);
}

static void write_cell(CzMarkup *markup, const CzReportCell *cell, bool is_number) {
    static const char *const class_names[][2] = {[CZ_STYLE_PLAIN] = {NULL, "number"},
                                                 [CZ_STYLE_GOOD] = {"pass", "number pass"},
                                                 [CZ_STYLE_CAREFUL] = {"careful", "number careful"},
                                                 [CZ_STYLE_BAD] = {"fail", "number fail"},
                                                 [CZ_STYLE_SMALL] = {"small", "number small"}};
    const char *class_name = class_names[cell->style][is_number];
    cz_markup_open(markup, "td");
    if (class_name != NULL)
        cz_markup_attribute(markup, "class", class_name);
    if (cell->drawing == CZ_DRAWING_RANGE)
        write_range(markup, cell->share);
    else if (cell->drawing == CZ_DRAWING_NONE)
        cz_markup_text(markup, cell->text);
    else if (isfinite(cell->share[0]))
        write_bar(markup, cell->bar, cell->share[0]);
    cz_markup_close(markup);
}

void cz_table_write_page(CzReportTable *table, CzMarkup *markup) {
    markup->failed |= table->failed;
    cz_markup_open_class(markup, "div", "wide");
    cz_markup_open(markup, "table");
    if (table->class_name != NULL)
        cz_markup_attribute(markup, "class", table->class_name);
    cz_markup_open(markup, "tr");
    for (int k = 0; k < table->n_column; k++)
        if (table->column[k].head != NULL)
            write_head(markup, table->column[k].head, table->column[k].is_number);
    cz_markup_end(markup);
    for (int i = 0; i + table->n_column <= table->n_cell; i += table->n_column) {
        cz_markup_open(markup, "tr");
        for (int k = 0; k < table->n_column; k++)
            if (table->column[k].head != NULL)
                write_cell(markup, &table->cell[i + k], table->column[k].is_number);
        cz_markup_end(markup);
    }
    cz_markup_close(markup);
    cz_markup_end(markup);
    cz_table_free(table);
}
