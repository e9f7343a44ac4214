/* Parts: finding them, the depth to which they use one another, and `use` with the keys next to
 * it. */
#include "tree/parts.h"

#include <string.h>

#include "base/suggest.h"
#include "tree/merge.h"

CzPart *cz_tree_part(const CzTree *tree, const char *name, size_t n) {
    const int at = cz_index_find(&tree->by_name, name, n);
    return at >= 0 ? &tree->part[at] : NULL;
}

/* ---- depth of nested parts ---- */

typedef enum { NOT_MEASURED, BEING_MEASURED, MEASURED } Progress;

typedef struct {
    CzReader *reader;
    CzTree *tree;
    Progress *progress; /* (n_part) */
} Measuring;

static int measure_part(Measuring *measuring, CzPart *part, int level);

/* The deepest chain of parts that begins below a node. */
static int measure_node(Measuring *measuring, const CzNode *node, int level) {
    int deepest = 0;
    for (int i = 0; node->kind != CZ_NODE_TEXT && i < node->n_entry; i++) {
        const CzEntry *entry = &node->entry[i];
        const CzNode *value = entry->value;
        const bool uses = entry->key != NULL && strcmp(entry->key->text, "use") == 0 &&
                          value->kind == CZ_NODE_TEXT;
        CzPart *part =
            uses ? cz_tree_part(measuring->tree, value->text, strlen(value->text)) : NULL;
        CzMistakes *mistakes = &measuring->reader->mistakes;
        int here = uses ? 0 : measure_node(measuring, value, level);
        if (part != NULL && measuring->progress[part - measuring->tree->part] == BEING_MEASURED)
            cz_mistake(mistakes, value, NULL, "part '%s' uses itself", part->name);
        else if (part != NULL) /* the first level that is too deep counts, but is not followed */
            here = 1 + (level <= CZ_MAX_NESTED ? measure_part(measuring, part, level + 1) : 0);
        if (part != NULL && (here == CZ_MAX_NESTED + 1 || level > CZ_MAX_NESTED))
            cz_mistake(mistakes, value, NULL, "more than %d parts use one another in a chain",
                       (int)CZ_MAX_NESTED);
        deepest = here > deepest ? here : deepest;
    }
    return deepest;
}

static int measure_part(Measuring *measuring, CzPart *part, int level) {
    Progress *progress = &measuring->progress[part - measuring->tree->part];
    if (*progress == MEASURED)
        return part->depth;
    *progress = BEING_MEASURED;
    part->depth = measure_node(measuring, part->node, level);
    *progress = MEASURED;
    return part->depth;
}

void cz_parts_measure(CzReader *reader, CzTree *tree) {
    Measuring measuring = {reader, tree, NULL};
    measuring.progress =
        cz_arena_allocate(&reader->arena, (size_t)tree->n_part, sizeof *measuring.progress);
    for (int i = 0; measuring.progress != NULL && i < tree->n_part; i++)
        measure_part(&measuring, &tree->part[i], 0);
}

/* ---- taking one ---- */

static const CzPart *find_part(CzReader *reader, const CzTree *tree, const CzNode *used,
                               const CzTrail *trail) {
    const CzPart *part = cz_tree_part(tree, used->text, strlen(used->text));
    if (part != NULL)
        return part;
    if (tree->lacks_parts)
        return NULL;
    CzSuggestion suggestion = {0};
    cz_mistake(&reader->mistakes, used, trail,
               "there is no part '%s'" CZ_HELP
               "parts belong under 'parts:' or in the files of 'catalogue:'",
               used->text);
    for (int i = 0; reader->mistakes.last != NULL && i < tree->n_part; i++)
        cz_suggest(&suggestion, used->text, tree->part[i].name);
    cz_mistake_suggest(&reader->mistakes, &suggestion);
    return NULL;
}

/* Whether a part may be used here: it does not contain itself and is not nested too deeply. Both
 * were reported for the parts as written; a setting can cause new cases. */
static bool may_use(CzReader *reader, const CzPart *part, const CzNode *used,
                    const CzTrail *use_trail) {
    int n_part = 0;
    for (const CzTrail *trail = use_trail; trail != NULL && trail->part != NULL;
         trail = trail->from) {
        n_part++;
        if (strcmp(trail->part, part->name) != 0)
            continue;
        cz_mistake(&reader->mistakes, used, use_trail, "part '%s' uses itself", part->name);
        return false;
    }
    if (n_part <= CZ_MAX_NESTED)
        return true;
    cz_mistake(&reader->mistakes, used, use_trail, "more than %d parts use one another in a chain",
               (int)CZ_MAX_NESTED);
    return false;
}

const CzNode *cz_take_part(CzReader *reader, const CzTree *tree, const CzNode *node,
                           const CzTrail *trail) {
    const CzEntry *use = cz_node_find(node, "use");
    if (use == NULL)
        return node;
    const CzTrail *use_trail = cz_entry_trail(use, trail);
    CzNode *rest = cz_node_without(&reader->arena, node, "use", 0);
    CzTrail *part_trail = cz_arena_allocate(&reader->arena, 1, sizeof *part_trail);
    if (rest == NULL || part_trail == NULL)
        return NULL;
    const char *name = cz_value_text(cz_reader_value(reader, "use", use->value, use_trail));
    const CzPart *part = name != NULL ? find_part(reader, tree, use->value, use_trail) : NULL;
    if (part == NULL || !may_use(reader, part, use->value, use_trail)) {
        rest->is_partial = reader->has_holes = true;
        return rest;
    }
    *part_trail = (CzTrail){part->name, part->written, use->value, use_trail};
    const CzNode *base = cz_take_part(reader, tree, part->node, part_trail);
    return base != NULL ? cz_merge(&reader->arena, base, part_trail, rest, trail, false) : NULL;
}

const CzNode *cz_parts_write_out(CzReader *reader, const CzTree *tree, const CzNode *node,
                                 const CzTrail *trail) {
    const CzNode *taken = cz_take_part(reader, tree, node, trail);
    if (taken == NULL || taken->kind == CZ_NODE_TEXT)
        return taken;
    CzNode *whole = cz_node_copy(&reader->arena, taken, 0);
    for (int i = 0; whole != NULL && i < whole->n_entry; i++) {
        CzEntry *entry = &whole->entry[i];
        entry->trail = cz_entry_trail(entry, trail);
        entry->value = cz_parts_write_out(reader, tree, entry->value, entry->trail);
        if (entry->value == NULL)
            return NULL;
    }
    return whole;
}
