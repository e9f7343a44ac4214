/* The matrix of criteria and scenarios, and the figures that decide. */
#include "report/page.h"

#include "report/checks_table.h"
#include "report/matrix.h"
#include "report/page_deciding.h"
#include "report/verdict_words.h"

#include <string.h>

/* ---- matrix ---- */

/* Columns of a table, which the last one with the deciding figures follows. */
typedef struct Columns {
    int begin, end;
    bool has_figures;
} Columns;

/* Verdict of each scenario, with a link to its report. */
static void put_verdicts(CzReportTable *table, const CzPage *page, const Columns *columns) {
    cz_table_put(table, "verdict");
    for (int k = columns->begin; k < columns->end; k++) {
        const CzMatrixColumn *column = &page->matrix->column[k];
        char address[CZ_ADDRESS_SIZE];
        cz_table_put_styled(table, cz_verdict_word(column->verdict),
                            cz_verdict_style(column->verdict));
        if (!column->is_design) {
            cz_page_address(page, column->worst->scenario, address);
            cz_table_link(table, address);
        }
    }
    if (columns->has_figures)
        cz_table_put(table, "");
}

/* The figure that decides a row. */
static void put_figure(CzReportTable *table, const CzPage *page, int row) {
    char text[CZ_SENTENCE_SIZE], address[32];
    const int at = page->deciding->of_row[row];
    if (at < 0) {
        cz_table_put(table, "");
        return;
    }
    const CzDecidingFigure *figure = &page->deciding->figure[at];
    cz_chart_title(figure->page, figure->chart, figure->index, sizeof text, text);
    cz_table_put(table, text);
    snprintf(address, sizeof address, "#deciding-%d", at + 1);
    cz_table_link(table, address);
}

static void put_row(CzReportTable *table, const CzPage *page, const Columns *columns, int row) {
    const CzMatrix *matrix = page->matrix;
    cz_table_put(table, matrix->row[row]);
    for (int k = columns->begin; k < columns->end; k++) {
        const CzCheckResult *check = cz_matrix_check(matrix, row, k);
        char text[CZ_MATRIX_SIZE], address[32];
        cz_table_put_styled(table, cz_matrix_text(check, text), cz_matrix_style(check));
        if (check == NULL || check->has_no_run) /* one line for all of the scenario */
            continue;
        snprintf(address, sizeof address, "#check-%d",
                 matrix->cell[row * matrix->n_column + k] + 1);
        cz_table_link(table, address);
    }
    if (columns->has_figures)
        put_figure(table, page, row);
}

static void write_columns(CzPage *page, const Columns *columns) {
    const CzMatrix *matrix = page->matrix;
    CzReportTable table;
    cz_table_begin(&table, "criterion");
    table.class_name = "matrix cards";
    for (int k = columns->begin; k < columns->end; k++) {
        char head[CZ_LABEL_SIZE];
        snprintf(head, sizeof head, ">%.*s", (int)sizeof head - 2, matrix->column[k].name);
        cz_table_head(&table, head);
    }
    if (columns->has_figures)
        cz_table_head(&table, "deciding figure");
    put_verdicts(&table, page, columns);
    for (int row = 0; row < matrix->n_row; row++)
        put_row(&table, page, columns, row);
    cz_table_write_page(&table, &page->markup);
}

void cz_page_write_matrix(CzPage *page) {
    enum { MAX_ACROSS = 16 }; /* more are in further tables */
    if (!cz_page_has_matrix(page))
        return;
    const int n_column = page->matrix->n_column;
    cz_markup_write(&page->markup, "<section id='matrix'>\n<h2>Criteria and scenarios</h2>\n"
                                   "<p>" CZ_MATRIX_SIGNS " A verdict leads to the report of its "
                                   "scenario, a margin to its check.</p>\n");
    for (int k = 0; k < n_column; k += MAX_ACROSS) {
        Columns columns = {.begin = k, .end = k + MAX_ACROSS};
        columns.end = columns.end < n_column ? columns.end : n_column;
        columns.has_figures = page->deciding != NULL && columns.end == n_column;
        write_columns(page, &columns);
    }
    cz_markup_write(&page->markup, "</section>\n");
}

bool cz_page_has_matrix(const CzPage *page) {
    return page->matrix != NULL && cz_matrix_n_scenario(page->matrix) > 1;
}

/* ---- figures ---- */

/* Title, scenario and the criteria that a figure decides. */
static void write_caption(CzPage *page, int at) {
    const CzDecidingFigure *figure = &page->deciding->figure[at];
    CzMarkup *markup = &page->markup;
    char title[CZ_SENTENCE_SIZE];
    const char *between = ": ";
    cz_chart_title(figure->page, figure->chart, figure->index, sizeof title, title);
    cz_markup_write(markup, "<figcaption>%s, %s", title, figure->page->summary->scenario);
    for (int row = 0; row < page->matrix->n_row; row++)
        if (page->deciding->of_row[row] == at) {
            cz_markup_write(markup, "%s%s", between, page->matrix->row[row]);
            between = "; ";
        }
    cz_markup_write(markup, "</figcaption>\n");
}

void cz_page_write_deciding(CzPage *page) {
    CzMarkup *markup = &page->markup;
    if (page->deciding == NULL || page->deciding->n_figure == 0)
        return;
    cz_markup_write(markup, "<section id='deciding'>\n<h2>Figures that decide</h2>\n<p>Each "
                            "criterion in the scenario of its smallest margin.</p>"
                            "<div class='figures'>\n");
    for (int i = 0; i < page->deciding->n_figure; i++) {
        const CzDecidingFigure *figure = &page->deciding->figure[i];
        cz_markup_write(markup, "<figure id='deciding-%d'>", i + 1);
        write_caption(page, i);
        cz_chart_write(figure->page, figure->chart, figure->index, markup);
        cz_markup_write(markup, "</figure>\n");
    }
    cz_markup_write(markup, "</div></section>\n");
}
