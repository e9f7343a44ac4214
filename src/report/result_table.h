/* Results as columns and cells of tables. */
#ifndef CZ_REPORT_RESULT_TABLE_H
#define CZ_REPORT_RESULT_TABLE_H

#include "report/results.h"
#include "report/table.h"

/* Adds a column of numbers with the result's heading. */
void cz_table_head_of(CzReportTable *table, const CzResult *result);

/* Appends a number of a record, marked when it may be of the time beyond model validity. */
void cz_table_put_result(CzReportTable *table, const CzResult *result, CzResultContext *context,
                         const void *record, bool is_marked);

#endif
