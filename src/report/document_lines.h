/* What a report is filed under: project, author, revision and date of the file, program, file and
 * hash, profile with edition and category. */
#ifndef CZ_REPORT_DOCUMENT_LINES_H
#define CZ_REPORT_DOCUMENT_LINES_H

#include "crushzone/problem.h"

enum { CZ_DOCUMENT_SIZE = 512, CZ_N_DOCUMENT_LINE = 8 };

const char *cz_document_title(int line);

/* NULL where the problem has none; else in `text` or in the problem. */
const char *cz_document_text(const CzProblem *problem, int line, char text[CZ_DOCUMENT_SIZE]);

#endif
