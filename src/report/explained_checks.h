/* Explained checks on a terminal. */
#ifndef CZ_REPORT_EXPLAINED_CHECKS_H
#define CZ_REPORT_EXPLAINED_CHECKS_H

#include "crushzone/explain.h"
#include "report/table.h"

void cz_explained_checks_write(const CzExplanation *explanation, CzTerminal *terminal);

#endif
