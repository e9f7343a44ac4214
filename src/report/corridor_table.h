/* A corridor as tables and sentences, for the terminal and the page. */
#ifndef CZ_REPORT_CORRIDOR_TABLE_H
#define CZ_REPORT_CORRIDOR_TABLE_H

#include "crushzone/corridor.h"
#include "report/table.h"

enum { CZ_CORRIDOR_SENTENCE = 600 };

/* Sentences without their full stop: the result, the device, and what was tried. */
void cz_corridor_result_sentence(const CzCorridor *corridor, char text[CZ_CORRIDOR_SENTENCE]);
void cz_corridor_device_sentence(const CzCorridor *corridor, char text[CZ_CORRIDOR_SENTENCE]);
void cz_corridor_tried_sentence(const CzCorridor *corridor, char text[CZ_CORRIDOR_SENTENCE]);

/* Forces of both edges over the stroke; and what limits them. */
void cz_corridor_begin_points(CzReportTable *table, const CzCorridor *corridor);
void cz_corridor_begin_edges(CzReportTable *table, const CzCorridor *corridor);
/* Why the run of the curve beyond an edge failed, or the rule that it violates; NULL otherwise. */
const char *cz_corridor_message(const CzCorridor *corridor, int edge);

#endif
