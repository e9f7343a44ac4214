/* Paths into a problem: trains.A.vehicles.A1.front.stages[0].force_kN, parts.front-zone.gap_mm.
 *
 * Keys and names are parted by points; [2] is an item of a list, counted from 0, [*] or * every
 * item. Putting a value under a path makes new mappings along the path and shares the rest. What a
 * part gives on the way is taken first, so a value can be put beside `use` at any depth. Beyond a *
 * items without the record that the path goes through are passed over.
 */
#ifndef CZ_TREE_PATH_H
#define CZ_TREE_PATH_H

#include "crushzone/names.h"
#include "tree/parts.h"

/* What a path ended in: the concrete path of each match. */
typedef struct CzMatches {
    int n_match;
    char (*place)[CZ_PATH_ROOM]; /* (n_match) */
} CzMatches;

/* Puts a value under a path, which may name several places; with `matches` each place gets a
 * stand-in for a number of its own (problem/find.c). False, with a mistake, when the path names
 * none. */
bool cz_path_put(CzReader *reader, CzTree *tree, const char *path, const CzNode *place,
                 const CzNode *value, CzMatches *matches);

#endif
