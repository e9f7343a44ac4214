/* Common data of all steps from files to records.
 *
 *   load      files -> one tree: `extends` merged, parts of catalogues gathered
 *   profile   partners and scenarios of the profile added
 *   settings  `set:` and --set applied to the tree
 *   trains    `copy`, `repeat`, `reversed` written out
 *   families  `sweep` of a scenario written out
 *   bind      tree -> typed records, with a place for every value; `use` is replaced by parts
 *   rules     conditions between values
 *
 * Profile, bind and rules are in src/problem, the others in this folder. All of them continue after
 * a mistake, so that one pass reports every mistake. Without memory they return NULL or end early;
 * the arena records that a request failed.
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
    const CzRecord *top;      /* record of a problem file */
    const char *share_folder; /* with catalogue/ and profiles/; NULL for none */
    int n_set;                /* values that settings have changed so far */
    bool has_holes; /* some records could not be read, so absent values may be in the file */
} CzReader;

/* A value under a key, for reading it. */
static inline CzValue cz_reader_value(CzReader *reader, const char *key, const CzNode *node,
                                      const CzTrail *trail) {
    return (CzValue){&reader->mistakes, key, node, trail};
}

#endif
