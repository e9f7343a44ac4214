/* Tables for a terminal, one function for each kind of results. */
#ifndef CZ_REPORT_TABLES_H
#define CZ_REPORT_TABLES_H

#include "crushzone/report.h"
#include "report/table.h"

void cz_run_write_table(const CzReport *report, CzTerminal *terminal);
void cz_outcome_write_table(const CzReport *report, CzTerminal *terminal);
void cz_challenge_write_table(const CzReport *report, CzTerminal *terminal);
void cz_sample_write_table(const CzReport *report, CzTerminal *terminal);
void cz_sweep_write_table(const CzReport *report, CzTerminal *terminal);
void cz_corridor_write_table(const CzReport *report, CzTerminal *terminal);
void cz_pareto_write_table(const CzReport *report, CzTerminal *terminal);
void cz_verification_write_table(const CzReport *report, CzTerminal *terminal);
void cz_benchmark_write_table(const CzReport *report, CzTerminal *terminal);
void cz_explanation_write_table(const CzReport *report, CzTerminal *terminal);
void cz_comparison_write_table(const CzReport *report, CzTerminal *terminal);

#endif
