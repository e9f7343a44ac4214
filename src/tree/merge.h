/* Merges one tree over another. */
#ifndef CZ_TREE_MERGE_H
#define CZ_TREE_MERGE_H

#include "text/node.h"

extern const CzTrail cz_no_trail;

/* The trail of an entry in a mapping or list that has the trail `outer`. */
const CzTrail *cz_entry_trail(const CzEntry *entry, const CzTrail *outer);

/* The entry of a mapping under a key, in any unit; NULL when there is none. */
CzEntry *cz_find_same_stem(CzNode *mapping, const char *key);

/* A mapping with the entries of another one of which it has no entry in any unit, but for the
 * listed keys. NULL without memory. */
const CzNode *cz_inherit(CzArena *arena, const CzNode *mapping, const CzNode *base,
                         const char *but);

/* `over` merged over `base`. With by_name, lists of named records merge by name. */
const CzNode *cz_merge(CzArena *arena, const CzNode *base, const CzTrail *base_trail,
                       const CzNode *over, const CzTrail *over_trail, bool by_name);

#endif
