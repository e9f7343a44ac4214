/* A sweep as a page. */
#ifndef CZ_REPORT_PAGE_SWEEP_H
#define CZ_REPORT_PAGE_SWEEP_H

#include <stdio.h>

#include "crushzone/sweep.h"

/* Whether something climbed at one of the points. */
static inline bool cz_sweep_is_beyond(const CzSweep *sweep) {
    for (int i = 0; i < sweep->n_point; i++)
        if (sweep->point[i].beyond_validity)
            return true;
    return false;
}

/* Writes the page. Status: CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_page_write_sweep(const CzSweep *sweep, FILE *stream, CzError *error);

#endif
