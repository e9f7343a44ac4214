/* A sweep as a page. */
#ifndef CZ_REPORT_PAGE_SWEEP_H
#define CZ_REPORT_PAGE_SWEEP_H

#include <stdio.h>

#include "crushzone/sweep.h"
#include "report/figure.h"
#include "report/table.h"

/* Whether a point went beyond model validity. */
static inline bool cz_sweep_is_beyond(const CzSweep *sweep) {
    for (int i = 0; i < sweep->n_point; i++)
        if (sweep->point[i].beyond_validity)
            return true;
    return false;
}

/* Explanations of the signs of a map, and of results beyond model validity. */
#define CZ_MAP_SIGNS "+ pass   ~ provisional   X FAIL   ? not checked   ! run failed   - invalid"
#define CZ_SWEEP_BEYOND                                                                            \
    "Override: some points went beyond model validity (" CZ_FIGURE_MARK_MEANS ")."

/* Writes the page. Status: CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_page_write_sweep(const CzSweep *sweep, FILE *stream, CzError *error);

/* Word of a point, sign and colour in a map, style in a table. */
typedef struct CzPointStyle {
    const char *word, *sign, *colour;
    CzStyle style;
} CzPointStyle;
CzPointStyle cz_point_style(const CzSweepPoint *point);

/* Sentence, without its full stop, on the scenarios that a value does not reach, from the index-th
 * on; returns how many it names or counts. */
int cz_sweep_unreached_sentence(const CzSweep *sweep, int index, char text[CZ_SENTENCE_SIZE]);

/* The table of all points. */
void cz_sweep_begin_points(CzReportTable *table, const CzSweep *sweep, bool on_page);

#endif
