/* Paths into a problem: trains.A.vehicles.A1.front.stages[0].force_kN, parts.front-zone.gap_mm.
 *
 * Keys and names are separated by points; [2] is an item of a list, counted from 0, [*] or * every
 * item. Setting a value at a path creates new mappings along the path and shares the rest. Parts
 * along the path are inserted first, so a value can be set next to `use` at any depth. After a *
 * items without the record that the path names are skipped.
 */
#ifndef CZ_TREE_PATH_H
#define CZ_TREE_PATH_H

#include "crushzone/names.h"
#include "tree/parts.h"

/* The concrete path of each match. */
typedef struct CzMatches {
    int n_match;
    char (*place)[CZ_PATH_ROOM]; /* (n_match) */
} CzMatches;

/* Sets a value at a path, which may name several places; with `matches` each place receives its own
 * stand-in for a number (problem/find.c). False, with a mistake, when the path names none. */
bool cz_path_put(CzReader *reader, CzTree *tree, const char *path, const CzNode *place,
                 const CzNode *value, CzMatches *matches);

#endif
