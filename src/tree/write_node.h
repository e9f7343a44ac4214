/* Writes nodes of a tree that no file has: made scenarios, partners, stages, variables. */
#ifndef CZ_TREE_WRITE_NODE_H
#define CZ_TREE_WRITE_NODE_H

#include "tree/reader.h"

/* Memory of the nodes, and the place at which mistakes about them are reported. */
typedef struct CzNodeWriter {
    CzArena *arena;
    CzNode place;
} CzNodeWriter;

/* A writer whose nodes are in a source of that name, which no file is; its place has no source
 * without memory. */
CzNodeWriter cz_node_writer(CzReader *reader, const char *name);

/* A list or mapping with room for entries; NULL without memory. */
CzNode *cz_write_node(const CzNodeWriter *writer, CzNodeKind kind, int room);

/* A name, or a number; NULL without memory. */
const CzNode *cz_write_name(const CzNodeWriter *writer, const char *name);
const CzNode *cz_write_number(const CzNodeWriter *writer, double number);

/* Puts a value under a key of a mapping with room for it. False without memory, also when that is
 * the reason for a NULL mapping or value. */
bool cz_write_entry(const CzNodeWriter *writer, CzNode *mapping, const char *key,
                    const CzNode *value);

/* Adds an item to a list with room for it. False, without a change, for a NULL item. */
bool cz_write_item(CzNode *list, const CzNode *item);

#endif
