/* What all steps from files to records share.
 *
 *   load      files -> one tree: `extends` merged, parts of catalogues gathered
 *   settings  `set:` and --set put into the tree
 *   trains    `copy`, `repeat`, `reversed` written out
 *   families  `sweep` of a scenario written out
 *   bind      tree -> typed records, with a place for every value; `use` is taken on the way
 *   rules     what must hold between values
 *
 * The first four are in this folder, the others in src/problem. All of them go on after a mistake,
 * so that one pass reports every mistake. When memory is short they return NULL or leave; the arena
 * knows that a request failed.
 */
#ifndef CZ_TREE_READER_H
#define CZ_TREE_READER_H

#include "text/source.h"
#include "text/value.h"
#include "tree/record.h"

typedef struct CzReader {
    CzArena arena;
    CzSources sources;
    CzMistakes mistakes, warnings;
    const CzRecord *top;      /* what a problem file holds */
    const char *share_folder; /* with catalogue/ and profiles/; NULL for none */
    int n_set;                /* values that settings have changed so far */
    bool has_holes; /* records could not be read, so what is absent may have been written */
} CzReader;

/* A value under a key, for reading it. */
static inline CzValue cz_reader_value(CzReader *reader, const char *key, const CzNode *node,
                                      const CzTrail *trail) {
    return (CzValue){&reader->mistakes, key, node, trail};
}

#endif
