/* Criteria by scenarios: the smallest margin of each. */
#include "report/matrix.h"

#include "report/checks_table.h"
#include "report/verdict_words.h"

#include <math.h>
#include <string.h>

static const char design[] = "design";

/* ---- data ---- */

static int find_column(const CzMatrix *matrix, const char *name) {
    for (int k = 0; k < matrix->n_column; k++)
        if (strcmp(matrix->column[k].name, name) == 0)
            return k;
    return -1;
}

static int find_row(const CzMatrix *matrix, const char *name) {
    for (int i = 0; i < matrix->n_row; i++)
        if (strcmp(matrix->row[i], name) == 0)
            return i;
    return -1;
}

static void add_column(CzMatrix *matrix, const char *name) {
    CzMatrixColumn *column =
        cz_arena_grow(&matrix->arena, matrix->column, matrix->n_column, sizeof *column);
    if (column == NULL)
        return;
    matrix->column = column;
    column[matrix->n_column++] = (CzMatrixColumn){
        .name = name,
        .is_design = strcmp(name, design) == 0,
        .verdict = cz_verdict_in(matrix->evaluation, name),
    };
}

static void add_row(CzMatrix *matrix, const char *name) {
    const char **row = cz_arena_grow(&matrix->arena, matrix->row, matrix->n_row, sizeof *row);
    if (row == NULL)
        return;
    matrix->row = row;
    row[matrix->n_row++] = name;
}

/* Whether the scenario of a check was left out. */
static bool is_left_out(const CzCheckResult *check) {
    return check->has_no_run && check->is_omitted;
}

/* Lists scenarios and criteria in the order of the checks, the design last. */
static void list_names(CzMatrix *matrix) {
    const CzEvaluation *evaluation = matrix->evaluation;
    bool has_design = false;
    for (int i = 0; i < evaluation->n_check && !matrix->arena.out_of_memory; i++) {
        const CzCheckResult *check = &evaluation->check[i];
        const char *name = cz_checks_scenario(check);
        if (is_left_out(check))
            continue;
        has_design |= strcmp(name, design) == 0;
        if (strcmp(name, design) != 0 && find_column(matrix, name) < 0)
            add_column(matrix, name);
        if (find_row(matrix, check->name) < 0)
            add_row(matrix, check->name);
    }
    if (has_design && !matrix->arena.out_of_memory)
        add_column(matrix, design);
}

static void place_check(CzMatrix *matrix, int i) {
    const CzCheckResult *check = &matrix->evaluation->check[i];
    const int at = find_column(matrix, cz_checks_scenario(check));
    int *cell = &matrix->cell[find_row(matrix, check->name) * matrix->n_column + at];
    CzMatrixColumn *column = &matrix->column[at];
    if (*cell < 0 || cz_check_is_worse(check, &matrix->evaluation->check[*cell]))
        *cell = i;
    if (column->worst == NULL || cz_check_is_worse(check, column->worst))
        column->worst = check;
}

bool cz_matrix_build(CzMatrix *matrix, const CzEvaluation *evaluation) {
    *matrix = (CzMatrix){.evaluation = evaluation};
    list_names(matrix);
    const size_t n = (size_t)matrix->n_row * (size_t)matrix->n_column;
    if (n > 0)
        matrix->cell = cz_arena_allocate(&matrix->arena, n, sizeof *matrix->cell);
    if (matrix->arena.out_of_memory)
        return false;
    for (size_t i = 0; i < n; i++)
        matrix->cell[i] = -1;
    for (int i = 0; i < evaluation->n_check; i++)
        if (!is_left_out(&evaluation->check[i]))
            place_check(matrix, i);
    return true;
}

void cz_matrix_free(CzMatrix *matrix) {
    cz_arena_free(&matrix->arena);
}

int cz_matrix_n_scenario(const CzMatrix *matrix) {
    int n = 0;
    for (int k = 0; k < matrix->n_column; k++)
        n += !matrix->column[k].is_design;
    return n;
}

int cz_matrix_deciding(const CzMatrix *matrix, int row) {
    const CzCheckResult *worst = NULL;
    int found = -1;
    for (int k = 0; k < matrix->n_column; k++) {
        const CzCheckResult *check = cz_matrix_check(matrix, row, k);
        if (check == NULL || isnan(check->value) ||
            (worst != NULL && !cz_check_is_worse(check, worst)))
            continue;
        worst = check;
        found = k;
    }
    return found;
}

/* ---- text ---- */

const char *cz_matrix_text(const CzCheckResult *check, char text[CZ_MATRIX_SIZE]) {
    char margin[CZ_FIGURE_SIZE];
    if (check == NULL)
        return "";
    if (check->verdict == CZ_VERDICT_NOT_CHECKED)
        return "?";
    if (cz_checks_does_not_apply(check))
        return "n/a";
    const bool is_yes = isnan(check->margin);
    snprintf(text, CZ_MATRIX_SIZE, "%s%s%s", check->verdict == CZ_VERDICT_PROVISIONAL ? "~" : "",
             !is_yes                             ? cz_figure_margin(margin, check->margin)
             : cz_verdict_passes(check->verdict) ? "pass"
                                                 : "FAIL",
             check->beyond_validity ? "*" : "");
    return text;
}

CzStyle cz_matrix_style(const CzCheckResult *check) {
    return check == NULL || cz_checks_does_not_apply(check) ? CZ_STYLE_PLAIN
                                                            : cz_verdict_style(check->verdict);
}

/* A line for each column: its number, verdict and deciding check. */
static void write_scenarios(const CzMatrix *matrix, CzTerminal *terminal) {
    CzReportTable table;
    cz_table_begin(&table, ">;scenario;verdict;>smallest margin;by;where");
    for (int k = 0; k < matrix->n_column; k++) {
        const CzMatrixColumn *column = &matrix->column[k];
        char text[CZ_MATRIX_SIZE];
        cz_table_put_format(&table, "%d", k + 1);
        cz_table_put(&table, column->name);
        cz_table_put_styled(&table, cz_verdict_word(column->verdict),
                            cz_verdict_style(column->verdict));
        cz_table_put(&table, cz_matrix_text(column->worst, text));
        cz_table_put(&table,
                     column->worst->has_no_run ? "run failed or incomplete" : column->worst->name);
        cz_table_put(&table, column->worst->where);
    }
    cz_table_write_text(&table, terminal);
}

/* The columns from `first` up to `end`. */
static void write_columns(const CzMatrix *matrix, int first, int end, CzTerminal *terminal) {
    CzReportTable table;
    char head[16], text[CZ_MATRIX_SIZE];
    cz_table_begin(&table, "criterion");
    for (int k = first; k < end; k++) {
        snprintf(head, sizeof head, ">%d", k + 1);
        cz_table_head(&table, head);
    }
    for (int i = 0; i < matrix->n_row; i++) {
        cz_table_put(&table, matrix->row[i]);
        for (int k = first; k < end; k++) {
            const CzCheckResult *check = cz_matrix_check(matrix, i, k);
            cz_table_put_styled(&table, cz_matrix_text(check, text), cz_matrix_style(check));
        }
    }
    cz_table_write_text(&table, terminal);
    fputc('\n', terminal->stream);
}

/* Number of columns side by side: beside the longest name on a line of 160 characters, beside names
 * wrapped to a third of a narrower terminal. */
static int columns_across(const CzMatrix *matrix, int width) {
    enum { MAX_ACROSS = 10, EACH = 11 }; /* a margin and the space in front of it */
    int name = 0;
    for (int i = 0; i < matrix->n_row; i++)
        name = (int)strlen(matrix->row[i]) > name ? (int)strlen(matrix->row[i]) : name;
    if (width == 0)
        return MAX_ACROSS;
    const int n = (width - (name < width / 3 ? name : width / 3)) / EACH;
    return n < 1 ? 1 : n < MAX_ACROSS ? n : MAX_ACROSS;
}

void cz_matrix_write_text(const CzEvaluation *evaluation, CzTerminal *terminal) {
    CzMatrix matrix;
    terminal->failed |= !cz_matrix_build(&matrix, evaluation);
    if (!terminal->failed && cz_matrix_n_scenario(&matrix) > 1) {
        write_scenarios(&matrix, terminal);
        fputc('\n', terminal->stream);
        const int across = columns_across(&matrix, terminal->width);
        for (int k = 0; k < matrix.n_column; k += across)
            write_columns(&matrix, k, k + across < matrix.n_column ? k + across : matrix.n_column,
                          terminal);
        fputs(CZ_MATRIX_SIGNS "\n\n", terminal->stream);
    }
    cz_matrix_free(&matrix);
}
