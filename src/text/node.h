/* A file as a tree of nodes: texts, lists and mappings, each with its place.
 *
 * Values stay text until the table of keys says what they are. Trees are never changed after they
 * were built: merging and settings make new mappings that share what they keep, so one node can
 * hang in several trees. All nodes lie in the reader's arena.
 */
#ifndef CZ_TEXT_NODE_H
#define CZ_TEXT_NODE_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"

/* Where text came from: a file, standard input, a setting of the command line. */
typedef struct CzSource {
    const char *name;   /* for messages */
    const char *folder; /* relative paths start here */
    bool is_general;    /* it has more than one problem needs: a catalogue, a resolved problem */
    int order;          /* order of reading, for sorting messages */
    int n_line;
    const char *const *line; /* each ended by a zero (n_line) */
    struct CzSource *next;
} CzSource;

typedef enum { CZ_NODE_TEXT, CZ_NODE_LIST, CZ_NODE_MAPPING } CzNodeKind;

typedef struct CzNode CzNode;

/* How a node got where it hangs: through a part, or not (`part` NULL). */
typedef struct CzTrail {
    const char *part;           /* name of the part */
    const CzNode *written;      /* the part's name where the part is written */
    const CzNode *used;         /* the value of `use`; NULL while a setting changes the part */
    const struct CzTrail *from; /* trail of the place that used it */
} CzTrail;

/* An entry of a mapping, or an item of a list (`key` NULL). */
typedef struct CzEntry {
    const CzNode *key;
    const CzNode *value;
    const CzTrail *trail; /* NULL: that of the mapping or list */
} CzEntry;

struct CzNode {
    CzNodeKind kind;
    bool quoted;      /* text in quotes or a block of text: never a number, a flag or null */
    int line, column; /* counted from 1 */
    const CzSource *source;
    const char *text; /* of a text node */
    int n_entry;
    CzEntry *entry;  /* of a list or mapping (n_entry) */
    bool is_refused; /* a mistake was reported about it already: it is passed over */
    bool is_partial; /* a mapping that lost what it builds on: keys may be missing */
    int match;       /* > 0: a stand-in for a number, at the match-th place of a path
                        (problem/find.c) */
};

/* Entry of a mapping by its key; NULL when there is none or the node is no mapping. */
const CzEntry *cz_node_find(const CzNode *mapping, const char *key);

/* The same when the entry's value is a list; NULL otherwise. */
const CzEntry *cz_node_find_list(const CzNode *mapping, const char *key);

/* Text of a mapping's entry; NULL when there is none or it is no text. */
const char *cz_node_find_text(const CzNode *mapping, const char *key);

/* A text node at the place of another; NULL without memory. */
const CzNode *cz_node_text(CzArena *arena, const char *text, const CzNode *place);

/* The same of a name, which is a text whatever it looks like: null, true, 12. */
const CzNode *cz_node_name(CzArena *arena, const char *name, const CzNode *place);

/* Copy of a list or mapping with room for n_more entries beyond its own; the entries' nodes are
 * shared. NULL without memory. */
CzNode *cz_node_copy(CzArena *arena, const CzNode *node, int n_more);

/* Copy of a list or mapping with another value in one of its entries; NULL without memory, and when
 * the value is NULL for lack of it. */
const CzNode *cz_node_with(CzArena *arena, const CzNode *node, const CzEntry *entry,
                           const CzNode *value);

/* Copy of a mapping without the keys that are listed, blanks between them, with room for n_more
 * entries. NULL without memory. */
CzNode *cz_node_without(CzArena *arena, const CzNode *mapping, const char *keys, int n_more);

/* Appends an entry to a copy that has room for it, its key at a place. False without memory, and
 * when the value is NULL for lack of it. */
bool cz_node_append(CzArena *arena, CzNode *mapping, const char *key, const CzNode *place,
                    const CzNode *value, const CzTrail *trail);

/* Whether a node is one of the words for nothing: null, Null, NULL or ~, not in quotes. */
bool cz_node_is_null(const CzNode *node);

/* What a node is, for sentences: "a text", "a list", "a mapping". */
const char *cz_node_what(const CzNode *node);

#endif
