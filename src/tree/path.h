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
    char (*place)[CZ_PATH_SIZE]; /* (n_match) */
} CzMatches;

/* What is put at a place: one of these. */
typedef enum CzPutKind {
    CZ_PUT_VALUE,  /* `value` */
    CZ_PUT_FACTOR, /* the number there times `number` */
    CZ_PUT_SUM,    /* the number there plus `number`, which is in the unit of the path's key */
    CZ_PUT_MARKER  /* a stand-in for a number (problem/find.c); `matches` receives the place */
} CzPutKind;

typedef struct CzPut {
    CzPutKind kind;
    const CzNode *value;
    double number;
    CzMatches *matches;
} CzPut;

/* Puts something at a path, which may name several places, and returns their number; -1 after a
 * mistake or without memory. A path that begins with `parts.*` names every part in which the rest
 * is written, here those of this nesting depth. */
int cz_path_put(CzReader *reader, CzTree *tree, const char *path, const CzNode *place,
                const CzPut *put, int depth);

#endif
