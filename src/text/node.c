/* Trees of nodes: finding and copying. */
#include "text/node.h"

#include <string.h>

#include "base/text.h"

const CzEntry *cz_node_find(const CzNode *mapping, const char *key) {
    if (mapping == NULL || mapping->kind != CZ_NODE_MAPPING)
        return NULL;
    for (int i = 0; i < mapping->n_entry; i++)
        if (strcmp(mapping->entry[i].key->text, key) == 0)
            return &mapping->entry[i];
    return NULL;
}

const CzEntry *cz_node_find_list(const CzNode *mapping, const char *key) {
    const CzEntry *entry = cz_node_find(mapping, key);
    return entry != NULL && entry->value->kind == CZ_NODE_LIST ? entry : NULL;
}

const char *cz_node_find_text(const CzNode *mapping, const char *key) {
    const CzEntry *entry = cz_node_find(mapping, key);
    return entry != NULL && entry->value->kind == CZ_NODE_TEXT ? entry->value->text : NULL;
}

const CzNode *cz_node_text(CzArena *arena, const char *text, const CzNode *place) {
    CzNode *node = cz_arena_allocate(arena, 1, sizeof *node);
    if (node == NULL)
        return NULL;
    node->kind = CZ_NODE_TEXT;
    node->source = place->source;
    node->line = place->line;
    node->column = place->column;
    node->text = cz_arena_copy_text(arena, text, strlen(text));
    return node->text != NULL ? node : NULL;
}

const CzNode *cz_node_name(CzArena *arena, const char *name, const CzNode *place) {
    const CzNode *text = cz_node_text(arena, name, place);
    CzNode *node = text != NULL ? cz_arena_allocate(arena, 1, sizeof *node) : NULL;
    if (node == NULL)
        return NULL;
    *node = *text;
    node->quoted = true;
    node->is_refused = place->is_refused;
    return node;
}

CzNode *cz_node_copy(CzArena *arena, const CzNode *node, int n_more) {
    CzNode *copy = cz_arena_allocate(arena, 1, sizeof *copy);
    if (copy == NULL)
        return NULL;
    *copy = *node;
    copy->entry = cz_arena_allocate(arena, (size_t)(node->n_entry + n_more), sizeof *copy->entry);
    if (copy->entry == NULL)
        return NULL;
    if (node->n_entry > 0)
        memcpy(copy->entry, node->entry, (size_t)node->n_entry * sizeof *copy->entry);
    return copy;
}

const CzNode *cz_node_with(CzArena *arena, const CzNode *node, const CzEntry *entry,
                           const CzNode *value) {
    CzNode *copy = value != NULL ? cz_node_copy(arena, node, 0) : NULL;
    if (copy != NULL)
        copy->entry[entry - node->entry].value = value;
    return copy;
}

CzNode *cz_node_without(CzArena *arena, const CzNode *mapping, const char *keys, int n_more) {
    CzNode *copy = cz_node_copy(arena, mapping, n_more);
    if (copy == NULL)
        return NULL;
    copy->n_entry = 0;
    for (int i = 0; i < mapping->n_entry; i++)
        if (!cz_text_is_word(mapping->entry[i].key->text, keys))
            copy->entry[copy->n_entry++] = mapping->entry[i];
    return copy;
}

bool cz_node_append(CzArena *arena, CzNode *mapping, const char *key, const CzNode *place,
                    const CzNode *value, const CzTrail *trail) {
    const CzEntry entry = {cz_node_text(arena, key, place), value, trail};
    mapping->entry[mapping->n_entry++] = entry;
    return entry.key != NULL && value != NULL;
}

bool cz_node_is_null(const CzNode *node) {
    return node->kind == CZ_NODE_TEXT && !node->quoted &&
           cz_text_is_word(node->text, "null Null NULL ~");
}

const char *cz_node_what(const CzNode *node) {
    static const char *const what[] = {"a text", "a list", "a mapping"};
    return what[node->kind];
}
