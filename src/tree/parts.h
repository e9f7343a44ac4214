/* A tree with its parts: finding them, the depth to which they use one another, inserting them. */
#ifndef CZ_TREE_PARTS_H
#define CZ_TREE_PARTS_H

#include "base/index.h"
#include "tree/reader.h"

enum { CZ_MAX_NESTED = 40 }; /* parts that use one another */

typedef struct CzPart {
    const char *name;
    const CzNode *written; /* the part's name where it is written */
    const CzNode *node;    /* a mapping */
    int depth;             /* nesting depth of the parts that it uses: 0 without any */
} CzPart;

/* Content of a problem, in nodes. */
typedef struct CzTree {
    const CzNode *root;
    int n_part;
    CzPart *part;     /* (n_part) */
    CzIndex by_name;  /* of the parts */
    bool lacks_parts; /* a catalogue could not be read, so missing parts are not reported again
                       */
} CzTree;

/* The part whose name is the first n bytes of a text; NULL when there is none. */
CzPart *cz_tree_part(const CzTree *tree, const char *name, size_t n);

/* Finds the nesting depth of parts, each part once; reports circles and chains that are too deep.
 */
void cz_parts_measure(CzReader *reader, CzTree *tree);

/* A mapping with its `use` replaced by the part; the node itself when it has none. NULL without
 * memory. */
const CzNode *cz_take_part(CzReader *reader, const CzTree *tree, const CzNode *node,
                           const CzTrail *trail);

/* The same for all mappings inside, at any depth. */
const CzNode *cz_parts_write_out(CzReader *reader, const CzTree *tree, const CzNode *node,
                                 const CzTrail *trail);

#endif
