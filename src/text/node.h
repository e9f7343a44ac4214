/* A file as a tree of nodes: texts, lists and mappings, each with its place.
 *
 * Values stay text until the table of keys defines their type. Trees are never changed after they
 * were built: merging and settings create new mappings that share unchanged nodes, so one node can
 * belong to several trees. All nodes are in the reader's arena.
 */
#ifndef CZ_TEXT_NODE_H
#define CZ_TEXT_NODE_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"

/* Origin of a text: a file, standard input, a setting of the command line. */
typedef struct CzSource {
    const char *name;   /* for messages */
    const char *folder; /* relative paths start here */
    bool is_general; /* it contains more than one problem requires: a catalogue, a resolved problem
                      */
    int order;       /* order of reading, for sorting messages */
    int n_line;
    const char *const *line; /* each ended by a zero (n_line) */
    struct CzSource *next;
} CzSource;

typedef enum { CZ_NODE_TEXT, CZ_NODE_LIST, CZ_NODE_MAPPING } CzNodeKind;

typedef struct CzNode CzNode;

/* Origin of a node at its place: through a part, or not (`part` NULL). */
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
    bool is_refused; /* a mistake about it has been reported, so it is skipped */
    bool is_partial; /* a mapping whose base or part is missing, so that keys may be missing */
    bool is_removal; /* a null that removed a key beside a `use`, and that of the part too if any */
    int match;       /* > 0: a stand-in for a number, at the match-th place of a path
                        (problem/find.c) */
};

/* Entry of a mapping by its key; NULL when there is none or the node is not a mapping. */
const CzEntry *cz_node_find(const CzNode *mapping, const char *key);

/* The same when the entry's value is a list; NULL otherwise. */
const CzEntry *cz_node_find_list(const CzNode *mapping, const char *key);

/* Text of a mapping's entry; NULL when there is none or it is not text. */
const char *cz_node_find_text(const CzNode *mapping, const char *key);

/* A text node at the place of another; NULL without memory. */
const CzNode *cz_node_text(CzArena *arena, const char *text, const CzNode *place);

/* The same for a name, which is always text: null, true, 12. */
const CzNode *cz_node_name(CzArena *arena, const char *name, const CzNode *place);

/* Copy of a list or mapping with room for n_more entries beyond its own; the entries' nodes are
 * shared. NULL without memory. */
CzNode *cz_node_copy(CzArena *arena, const CzNode *node, int n_more);

/* Copy of a list or mapping with another value in one of its entries; NULL without memory, also
 * when that is the reason for a NULL value. */
const CzNode *cz_node_with(CzArena *arena, const CzNode *node, const CzEntry *entry,
                           const CzNode *value);

/* Copy of a mapping without the listed keys, which are separated by blanks, with room for n_more
 * entries. NULL without memory. */
CzNode *cz_node_without(CzArena *arena, const CzNode *mapping, const char *keys, int n_more);

/* Appends an entry to a copy with room for it; `place` is that of its key. False without memory,
 * also when that is the reason for a NULL value. */
bool cz_node_append(CzArena *arena, CzNode *mapping, const char *key, const CzNode *place,
                    const CzNode *value, const CzTrail *trail);

/* Whether a node is one of the words for nothing: null, Null, NULL or ~, not in quotes. */
bool cz_node_is_null(const CzNode *node);

/* Kind of a node, for sentences: "a text", "a list", "a mapping". */
const char *cz_node_what(const CzNode *node);

#endif
