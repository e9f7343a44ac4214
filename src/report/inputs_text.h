/* The resolved problem on a page: different cars once, and a table of the defaults. */
#ifndef CZ_REPORT_INPUTS_TEXT_H
#define CZ_REPORT_INPUTS_TEXT_H

#include "crushzone/problem.h"
#include "report/markup.h"

typedef struct CzInputsText {
    char *text;  /* the resolved problem */
    char **line; /* its lines (n_line) */
    int n_line;
    const char *folder; /* of the problem file, left out of the names of files; borrowed */
} CzInputsText;

/* Status: CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_inputs_text_begin(CzInputsText *inputs, const CzProblem *problem,
                                            CzError *error);
void cz_inputs_text_free(CzInputsText *inputs);

/* The text of the problem; of equal cars the first, and the names of the others. */
void cz_inputs_text_write(const CzInputsText *inputs, CzMarkup *markup);
/* A table of the defaults used, once per key and value. */
void cz_inputs_text_write_defaults(const CzInputsText *inputs, CzMarkup *markup);

#endif
