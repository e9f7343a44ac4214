/* Places: the interfaces, elements, vehicles, sections and ends that a metric may be read at. */
#ifndef CZ_EVALUATE_PLACE_H
#define CZ_EVALUATE_PLACE_H

#include "evaluate/metric.h"

/* Whether a text matches a pattern in which `*` represents any text and `?` for any letter. */
bool cz_matches(const char *pattern, const char *text);

/* Walks the places of a level that a selector picks. `visit` gets each in a fixed order. Returns
 * how many there were. */
typedef void (*CzPlaceVisitor)(const CzPlace *place, void *data);
int cz_places_visit(const CzSubject *subject, CzLevel level, const char *selector,
                    CzPlaceVisitor visit, void *data);

/* How many places the selector picks in a scene as written, before any run. */
int cz_places_count(const CzScene *scene, CzLevel level, const char *selector);

#endif
