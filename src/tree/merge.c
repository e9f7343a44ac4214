/* Merges one tree over another. */
#include "tree/merge.h"

#include <string.h>

#include "base/index.h"
#include "base/text.h"
#include "text/units.h"

const CzTrail cz_no_trail = {0};

const CzTrail *cz_entry_trail(const CzEntry *entry, const CzTrail *outer) {
    return entry->trail != NULL ? entry->trail : outer;
}

/* A record with its own `use`, and a curve with its own points, replace those of the base. */
static bool replaces(const CzNode *node) {
    return cz_node_find(node, "use") != NULL || cz_node_find(node, "points") != NULL ||
           cz_node_find(node, "file") != NULL;
}

CzEntry *cz_find_same_stem(CzNode *mapping, const char *key) {
    for (int i = 0; i < mapping->n_entry; i++)
        if (cz_key_same_stem(mapping->entry[i].key->text, key))
            return &mapping->entry[i];
    return NULL;
}

const CzNode *cz_inherit(CzArena *arena, const CzNode *mapping, const CzNode *base,
                         const char *but) {
    CzNode *whole = cz_node_copy(arena, mapping, base->n_entry);
    for (int i = 0; whole != NULL && i < base->n_entry; i++) {
        const char *key = base->entry[i].key->text;
        if (!cz_text_is_word(key, but) && cz_find_same_stem(whole, key) == NULL)
            whole->entry[whole->n_entry++] = base->entry[i];
    }
    return whole;
}

/* Indexes the items of a list by name; of several with the same name the first. */
static bool index_names(CzIndex *index, const CzNode *list) {
    for (int i = 0; i < list->n_entry; i++) {
        const char *name = cz_node_find_text(list->entry[i].value, "name");
        const size_t n = name != NULL ? strlen(name) : 0;
        if (name != NULL && cz_index_find(index, name, n) < 0 && !cz_index_add(index, name, n, i))
            return false;
    }
    return true;
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

/* Merges one entry over the same entry of the base, or appends it. */
static bool merge_entry(CzArena *arena, CzNode *merged, CzEntry *like, const CzEntry *over,
                        const CzTrail *over_trail, bool by_name) {
    const CzTrail *trail = cz_entry_trail(over, over_trail);
    if (like == NULL && over->value->is_removal) /* the part does not have the key */
        return true;
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

/* Removes an entry that is null in `over`. Beside a `use`, which is merged later, the null stays,
 * because the part may have the key, too. */
static bool remove_entry(CzArena *arena, CzNode *merged, CzEntry *like, const CzEntry *over,
                         const CzTrail *over_trail) {
    if (cz_node_find(merged, "use") == NULL) {
        *like = merged->entry[--merged->n_entry];
        return true;
    }
    CzNode *removal = cz_node_copy(arena, over->value, 0);
    if (removal == NULL)
        return false;
    removal->is_removal = true;
    *like = (CzEntry){over->key, removal, cz_entry_trail(over, over_trail)};
    return true;
}

static const CzNode *merge_mappings(CzArena *arena, const CzNode *base, const CzTrail *base_trail,
                                    const CzNode *over, const CzTrail *over_trail, bool by_name) {
    CzNode *merged = copy_base(arena, base, base_trail, over);
    for (int i = 0; merged != NULL && i < over->n_entry; i++) {
        const CzEntry *entry = &over->entry[i];
        CzEntry *like = cz_find_same_stem(merged, entry->key->text);
        const bool is_removed = like != NULL && cz_node_is_null(entry->value);
        if (is_removed ? !remove_entry(arena, merged, like, entry, over_trail)
                       : !merge_entry(arena, merged, like, entry, over_trail, by_name))
            return NULL;
    }
    return merged;
}

static const CzNode *merge_lists(CzArena *arena, const CzNode *base, const CzTrail *base_trail,
                                 const CzNode *over, const CzTrail *over_trail) {
    CzNode *merged = copy_base(arena, base, base_trail, over);
    CzIndex known = {.arena = arena};
    if (merged == NULL || !index_names(&known, base))
        return NULL;
    for (int i = 0; i < over->n_entry; i++) {
        const char *name = cz_node_find_text(over->entry[i].value, "name");
        const int at = cz_index_find(&known, name, strlen(name));
        if (!merge_entry(arena, merged, at >= 0 ? &merged->entry[at] : NULL, &over->entry[i],
                         over_trail, true))
            return NULL;
        if (at < 0 && !cz_index_add(&known, name, strlen(name), merged->n_entry - 1))
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
    CzNode *alone = cz_node_copy(arena, over, 0); /* the base is not a mapping */
    if (alone != NULL)
        alone->is_partial = true;
    return alone;
}
