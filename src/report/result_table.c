/* Results as columns and cells of tables. */
#include "report/result_table.h"

#include <stdio.h>

void cz_table_head_of(CzReportTable *table, const CzResult *result) {
    char head[64];
    snprintf(head, sizeof head, ">%s", result->heading);
    cz_table_head(table, head);
}

void cz_table_put_result(CzReportTable *table, const CzResult *result, CzResultContext *context,
                         const void *record, bool is_marked) {
    char text[CZ_FIGURE_ROOM];
    cz_result_text(text, result, context, record);
    cz_table_put(table, cz_figure_mark(text, is_marked));
}
