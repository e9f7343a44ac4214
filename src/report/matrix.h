/* The matrix of an evaluation: criteria by scenarios, both from the list of its checks alone. */
#ifndef CZ_REPORT_MATRIX_H
#define CZ_REPORT_MATRIX_H

#include "base/arena.h"
#include "crushzone/evaluate.h"
#include "report/figure.h"
#include "report/table.h"

/* A column: a scenario that was not left out, a family of scenarios, or "design". */
typedef struct CzMatrixColumn {
    const char *name;
    bool is_design;
    CzVerdict verdict;          /* over its checks */
    const CzCheckResult *worst; /* the check that decides it */
} CzMatrixColumn;

typedef struct CzMatrix {
    const CzEvaluation *evaluation;
    int n_column, n_row;
    CzMatrixColumn *column; /* (n_column), the design last */
    const char **row;       /* names of checks, in the order of the list (n_row) */
    int *cell;              /* the check that decides there; -1 for none (n_row x n_column) */
    CzArena arena;
} CzMatrix;

/* False without memory; to be freed in any case. Texts are borrowed from the evaluation. */
bool cz_matrix_build(CzMatrix *matrix, const CzEvaluation *evaluation);
void cz_matrix_free(CzMatrix *matrix);

/* Number of scenarios and families among the columns. A table of fewer than two says no more than
 * the list of checks. */
int cz_matrix_n_scenario(const CzMatrix *matrix);

static inline const CzCheckResult *cz_matrix_check(const CzMatrix *matrix, int row, int column) {
    const int check = matrix->cell[row * matrix->n_column + column];
    return check >= 0 ? &matrix->evaluation->check[check] : NULL;
}

/* The column that decides a row; -1 where no value is known. */
int cz_matrix_deciding(const CzMatrix *matrix, int row);

/* Text of a cell: the margin, "pass" or "FAIL" of a yes or no, "?" where it is not checked, with ~
 * in front where the limit is not confirmed; and its style. */
#define CZ_MATRIX_SIGNS                                                                            \
    "Smallest margins. ~ limit or scenario not confirmed (PROVISIONAL), ? not checked, n/a does "  \
    "not apply, "                                                                                  \
    "empty: not judged there."
enum { CZ_MATRIX_SIZE = CZ_FIGURE_SIZE + 4 };
const char *cz_matrix_text(const CzCheckResult *check, char text[CZ_MATRIX_SIZE]);
CzStyle cz_matrix_style(const CzCheckResult *check);

/* Writes scenarios and matrix as text; nothing for fewer than two scenarios. */
void cz_matrix_write_text(const CzEvaluation *evaluation, CzTerminal *terminal);

#endif
