/* Laying one tree over another: `extends`, and `use` with what is written beside it. */
#include <string.h>

#include "base/suggest.h"
#include "problem/reader.h"

const CzTrail cz_no_trail = {0};

const CzTrail *cz_entry_trail(const CzEntry *entry, const CzTrail *outer) {
    return entry->trail != NULL ? entry->trail : outer;
}

/* The word null lets go what the base has. */
static bool is_null(const CzNode *node) {
    return node->kind == CZ_NODE_TEXT && !node->quoted && strcmp(node->text, "null") == 0;
}

/* A record that takes a part of its own and a curve with points of its own replace the base's. */
static bool replaces(const CzNode *node) {
    return cz_node_find(node, "use") != NULL || cz_node_find(node, "points") != NULL ||
           cz_node_find(node, "file") != NULL;
}

static CzEntry *find_same_stem(CzNode *mapping, const char *key) {
    for (int i = 0; i < mapping->n_entry; i++)
        if (cz_key_same_stem(mapping->entry[i].key->text, key))
            return &mapping->entry[i];
    return NULL;
}

static CzEntry *find_named(CzNode *list, const char *name) {
    for (int i = 0; i < list->n_entry; i++) {
        const char *other = cz_node_find_text(list->entry[i].value, "name");
        if (other != NULL && strcmp(other, name) == 0)
            return &list->entry[i];
    }
    return NULL;
}

static bool all_named(const CzNode *list) {
    for (int i = 0; i < list->n_entry; i++)
        if (cz_node_find_text(list->entry[i].value, "name") == NULL)
            return false;
    return list->n_entry > 0;
}

/* A copy of `base` with room for the entries of `over`, its trails written out. */
static CzNode *copy_base(CzArena *arena, const CzNode *base, const CzTrail *base_trail,
                         const CzNode *over) {
    CzNode *merged = cz_node_copy(arena, base, over->n_entry);
    if (merged == NULL)
        return NULL;
    for (int i = 0; i < merged->n_entry; i++)
        merged->entry[i].trail = cz_entry_trail(&merged->entry[i], base_trail);
    merged->source = over->source;
    merged->line = over->line;
    merged->column = over->column;
    return merged;
}

/* Lays one entry over its like in the base, or appends it. */
static bool merge_entry(CzArena *arena, CzNode *merged, CzEntry *like, const CzEntry *over,
                        const CzTrail *over_trail, bool by_name) {
    const CzTrail *trail = cz_entry_trail(over, over_trail);
    if (like == NULL) {
        merged->entry[merged->n_entry] = *over;
        merged->entry[merged->n_entry++].trail = trail;
        return true;
    }
    like->value = cz_merge(arena, like->value, like->trail, over->value, trail, by_name);
    like->key = over->key;
    like->trail = trail;
    return like->value != NULL;
}

static const CzNode *merge_mappings(CzArena *arena, const CzNode *base, const CzTrail *base_trail,
                                    const CzNode *over, const CzTrail *over_trail, bool by_name) {
    CzNode *merged = copy_base(arena, base, base_trail, over);
    for (int i = 0; merged != NULL && i < over->n_entry; i++) {
        CzEntry *like = find_same_stem(merged, over->entry[i].key->text);
        if (like != NULL && is_null(over->entry[i].value))
            *like = merged->entry[--merged->n_entry];
        else if (!merge_entry(arena, merged, like, &over->entry[i], over_trail, by_name))
            return NULL;
    }
    return merged;
}

static const CzNode *merge_lists(CzArena *arena, const CzNode *base, const CzTrail *base_trail,
                                 const CzNode *over, const CzTrail *over_trail) {
    CzNode *merged = copy_base(arena, base, base_trail, over);
    for (int i = 0; merged != NULL && i < over->n_entry; i++) {
        CzEntry *like = find_named(merged, cz_node_find_text(over->entry[i].value, "name"));
        if (!merge_entry(arena, merged, like, &over->entry[i], over_trail, true))
            return NULL;
    }
    return merged;
}

const CzNode *cz_merge(CzArena *arena, const CzNode *base, const CzTrail *base_trail,
                       const CzNode *over, const CzTrail *over_trail, bool by_name) {
    if (base->kind == CZ_NODE_MAPPING && over->kind == CZ_NODE_MAPPING && !replaces(over))
        return merge_mappings(arena, base, base_trail, over, over_trail, by_name);
    if (by_name && base->kind == CZ_NODE_LIST && over->kind == CZ_NODE_LIST && all_named(over))
        return merge_lists(arena, base, base_trail, over, over_trail);
    if (base->kind == CZ_NODE_MAPPING || over->kind != CZ_NODE_MAPPING || replaces(over))
        return over;
    CzNode *alone = cz_node_copy(arena, over, 0); /* the base should have been a mapping too */
    if (alone != NULL)
        alone->is_partial = true;
    return alone;
}

static const CzPart *find_part(CzReader *reader, const CzTree *tree, const CzNode *used,
                               const CzTrail *trail) {
    for (int i = 0; i < tree->n_part; i++)
        if (strcmp(tree->part[i].name, used->text) == 0)
            return &tree->part[i];
    CzSuggestion suggestion = {0};
    for (int i = 0; i < tree->n_part; i++)
        cz_suggest(&suggestion, used->text, tree->part[i].name);
    cz_mistake(&reader->mistakes, used, trail, "there is no part '%s'", used->text);
    cz_mistake_suggest(&reader->mistakes, suggestion.best);
    if (suggestion.best == NULL)
        cz_mistake_help(&reader->mistakes,
                        "parts stand under 'parts:' or in the files of 'catalogue:'");
    return NULL;
}

static bool is_on_trail(const CzTrail *trail, const char *part) {
    for (; trail != NULL && trail->part != NULL; trail = trail->from)
        if (strcmp(trail->part, part) == 0)
            return true;
    return false;
}

const CzNode *cz_take_part(CzReader *reader, const CzTree *tree, const CzNode *node,
                           const CzTrail *trail) {
    const CzEntry *use = cz_node_find(node, "use");
    if (use == NULL)
        return node;
    const CzTrail *use_trail = cz_entry_trail(use, trail);
    CzNode *rest = cz_node_without(&reader->arena, node, "use");
    CzTrail *part_trail = cz_reader_allocate(reader, 1, sizeof *part_trail);
    if (rest == NULL || part_trail == NULL)
        return NULL;
    const char *name = cz_bind_text(reader, "use", use->value, use_trail);
    const CzPart *part = name != NULL ? find_part(reader, tree, use->value, use_trail) : NULL;
    const bool is_circle = part != NULL && is_on_trail(use_trail, name);
    if (is_circle)
        cz_mistake(&reader->mistakes, use->value, use_trail, "part '%s' uses itself", name);
    if (part == NULL || is_circle) {
        rest->is_partial = reader->has_holes = true;
        return rest;
    }
    *part_trail = (CzTrail){part->name, part->written, use->value, use_trail};
    const CzNode *base = cz_take_part(reader, tree, part->node, part_trail);
    return base != NULL ? cz_merge(&reader->arena, base, part_trail, rest, trail, false) : NULL;
}
