/* The rounds of a robust search, and how its design holds in samples, as tables and sentences. */
#ifndef CZ_REPORT_ROBUST_TABLE_H
#define CZ_REPORT_ROBUST_TABLE_H

#include "crushzone/robust.h"
#include "report/table.h"

/* One line a round. */
void cz_robust_begin_rounds(CzReportTable *table, const CzRobust *robust);

/* The checks by the samples: nominal margin, required statistic, failing samples; `order` as by
 * cz_sample_order, at most `most` lines besides those that fail. */
void cz_robust_begin_checks(CzReportTable *table, const CzRobust *robust, const int *order,
                            int most);

/* Sentence without its full stop about the adversary; empty without an envelope. */
enum { CZ_ROBUST_SENTENCE = 300 };
void cz_robust_challenge_sentence(const CzRobust *robust, char text[CZ_ROBUST_SENTENCE]);

/* All of it on a terminal. */
void cz_robust_write_table(const CzRobust *robust, CzTerminal *terminal);

/* The same as a section of the page of the search. */
void cz_robust_write_page(const CzRobust *robust, CzMarkup *markup);

#endif
