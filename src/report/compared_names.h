/* Trains and vehicles of compared runs that have other names at the same place. */
#ifndef CZ_REPORT_COMPARED_NAMES_H
#define CZ_REPORT_COMPARED_NAMES_H

#include "base/arena.h"
#include "crushzone/report.h"

/* A path or text of a run with the names of the first one; the text itself where it has none of the
 * others. NULL without memory. `comparison` may be NULL. */
const char *cz_compared_names_in(const CzComparison *comparison, int run, const char *text,
                                 CzArena *arena);

/* Whether a name of a run, such as M1-M2, is that of the first one, A1-A2. */
bool cz_compared_names_match(const CzComparison *comparison, int run, const char *own,
                             const char *first);

/* A sentence about the n-th run: "trains and vehicles of RUN are paired by their place: M is A, M1
 * is A1"; false when it has none. */
bool cz_compared_names_sentence(const CzReport *report, int run, size_t room, char *text);

#endif
