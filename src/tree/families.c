/* Writes families of scenarios out. */
#include "tree/families.h"

#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "base/suggest.h"
#include "base/text.h"
#include "text/range.h"
#include "tree/merge.h"

enum { MAX_MEMBERS = 500, MAX_SCENARIOS = 10000, MAX_SWEPT = 8, LONGEST_MEMBER = 160 };

/* One key of `sweep` with its values. */
typedef struct Swept {
    const CzEntry *entry;
    int n_value;
    const CzNode **value; /* (n_value) */
} Swept;

typedef struct Family {
    CzReader *reader;
    const CzNode *node; /* the scenario as written */
    const CzEntry *sweep;
    int n_swept;
    Swept swept[MAX_SWEPT];
    int n_member;
} Family;

/* ---- values ---- */

/* The values of a range as text nodes. */
static bool spread(Family *family, Swept *swept, const CzRange *range) {
    swept->value =
        cz_arena_allocate(&family->reader->arena, (size_t)range->n, sizeof(const CzNode *));
    for (int i = 0; swept->value != NULL && i < range->n; i++) {
        char number[CZ_NUMBER_TEXT];
        cz_number_print(number, cz_range_value(range, i));
        swept->value[i] = cz_node_text(&family->reader->arena, number, swept->entry->value);
        if (swept->value[i] == NULL)
            return false;
    }
    swept->n_value = range->n;
    return swept->value != NULL;
}

static bool list_values(Family *family, Swept *swept) {
    const CzNode *value = swept->entry->value;
    CzRange range;
    if (value->kind == CZ_NODE_TEXT && !value->quoted && cz_range_parse(value->text, &range))
        return spread(family, swept, &range);
    if (value->kind != CZ_NODE_LIST || value->n_entry == 0) {
        cz_mistake(&family->reader->mistakes, value, swept->entry->trail,
                   "'%s' in sweep needs a list of values, or a range such as 5:40:8",
                   swept->entry->key->text);
        return false;
    }
    swept->value =
        cz_arena_allocate(&family->reader->arena, (size_t)value->n_entry, sizeof(const CzNode *));
    if (swept->value == NULL)
        return false;
    swept->n_value = value->n_entry;
    for (int i = 0; i < value->n_entry; i++)
        swept->value[i] = value->entry[i].value;
    return true;
}

/* Whether a scenario has a key that is also in its sweep, in any unit. */
static bool is_given_twice(Family *family, const CzEntry *swept) {
    for (int i = 0; i < family->node->n_entry; i++) {
        const CzNode *key = family->node->entry[i].key;
        if (!cz_key_same_stem(key->text, swept->key->text))
            continue;
        cz_mistake(&family->reader->mistakes, swept->key, swept->trail,
                   "'%s' is swept and also has a value of its own", swept->key->text);
        return true;
    }
    return false;
}

static bool read_sweep(Family *family) {
    CzReader *reader = family->reader;
    const CzNode *sweep = family->sweep->value;
    if (sweep->kind != CZ_NODE_MAPPING || sweep->n_entry == 0 || sweep->n_entry > MAX_SWEPT) {
        cz_mistake(&reader->mistakes, sweep, family->sweep->trail,
                   "'sweep' needs a mapping of 1 to %d keys of a scenario with a list each",
                   (int)MAX_SWEPT);
        return false;
    }
    family->n_member = 1;
    for (int i = 0; i < sweep->n_entry; i++) {
        Swept *swept = &family->swept[family->n_swept++];
        *swept = (Swept){.entry = &sweep->entry[i]};
        if (cz_text_is_word(swept->entry->key->text, "name family sweep trains")) {
            cz_mistake(&reader->mistakes, swept->entry->key, swept->entry->trail,
                       "'%s' cannot be swept", swept->entry->key->text);
            return false;
        }
        if (is_given_twice(family, swept->entry) || !list_values(family, swept))
            return false;
        family->n_member *= swept->n_value;
        if (family->n_member > MAX_MEMBERS) {
            cz_mistake(&reader->mistakes, family->sweep->key, family->sweep->trail,
                       "a sweep has at most %d members", (int)MAX_MEMBERS);
            return false;
        }
    }
    return true;
}

/* ---- members ---- */

/* The value of a swept key in a member; the last key changes fastest. */
static const CzNode *value_of(const Family *family, int member, int key) {
    for (int i = family->n_swept - 1; i > key; i--)
        member /= family->swept[i].n_value;
    return family->swept[key].value[member % family->swept[key].n_value];
}

/* The family's name, then each value with its unit. */
static void name_member(const Family *family, const char *name, int member,
                        char text[LONGEST_MEMBER]) {
    size_t used = (size_t)snprintf(text, LONGEST_MEMBER, "%.48s", name);
    for (int i = 0; i < family->n_swept && used < LONGEST_MEMBER; i++) {
        const char *key = family->swept[i].entry->key->text;
        const char *unit = key + cz_key_stem_length(key);
        const CzNode *value = value_of(family, member, i);
        used += (size_t)snprintf(text + used, LONGEST_MEMBER - used, "_%.40s%s",
                                 value->kind == CZ_NODE_TEXT ? value->text : "",
                                 unit[0] == '_' ? unit + 1 : "");
    }
}

/* The mapping of one member; NULL without memory. */
static const CzNode *member_node(const Family *family, const CzEntry *name, int member) {
    CzArena *arena = &family->reader->arena;
    CzNode *node = cz_node_without(arena, family->node, "name sweep", family->n_swept + 2);
    if (node == NULL)
        return NULL;
    const CzNode *named = name->value;
    char text[LONGEST_MEMBER];
    name_member(family, named->text, member, text);
    if (!cz_node_append(arena, node, "name", named, cz_node_name(arena, text, named), NULL))
        return NULL;
    if (cz_node_find(family->node, "family") == NULL &&
        !cz_node_append(arena, node, "family", named, cz_node_name(arena, named->text, named),
                        NULL))
        return NULL;
    for (int i = 0; i < family->n_swept; i++) {
        node->entry[node->n_entry] = *family->swept[i].entry;
        node->entry[node->n_entry++].value = value_of(family, member, i);
    }
    return node;
}

/* The list of scenarios being built. */
typedef struct Scenarios {
    CzReader *reader;
    const CzTree *tree;
    int n;
    CzEntry *entry; /* (n) */
    bool is_full;   /* there are too many, which was reported */
} Scenarios;

/* Whether n more scenarios are allowed. */
static bool may_add(Scenarios *scenarios, int n, const CzNode *place) {
    scenarios->is_full = scenarios->n + n > MAX_SCENARIOS;
    if (scenarios->is_full)
        cz_mistake(&scenarios->reader->mistakes, place, NULL,
                   "the problem has more than %d scenarios, including members of sweeps",
                   (int)MAX_SCENARIOS);
    return !scenarios->is_full;
}

/* The earlier scenario that one is like; NULL, with a mistake, when there is none. */
static const CzNode *find_like(const Scenarios *scenarios, const CzNode *like) {
    CzReader *reader = scenarios->reader;
    const char *name = cz_value_text(cz_reader_value(reader, "like", like, NULL));
    CzSuggestion suggestion = {0};
    for (int i = 0; name != NULL && i < scenarios->n; i++) {
        const char *known = cz_node_find_text(scenarios->entry[i].value, "name");
        if (known != NULL && strcmp(known, name) == 0)
            return scenarios->entry[i].value;
        if (known != NULL)
            cz_suggest(&suggestion, name, known);
    }
    if (name != NULL) {
        cz_mistake(&reader->mistakes, like, NULL, "there is no earlier scenario '%.48s'", name);
        cz_mistake_suggest(&reader->mistakes, &suggestion);
    }
    return NULL;
}

/* A scenario with the values of the one that it is like, where it has none of its own; NULL without
 * memory. */
static const CzNode *take_like(const Scenarios *scenarios, const CzNode *scenario) {
    const CzEntry *like = cz_node_find(scenario, "like");
    const CzNode *base = like != NULL ? find_like(scenarios, like->value) : NULL;
    if (base == NULL)
        return scenario;
    return cz_inherit(&scenarios->reader->arena, scenario, base, "name family like");
}

/* Appends the members of a scenario, or the scenario itself when it has no sweep that can be
 * written out. */
static bool append_scenario(Scenarios *scenarios, const CzEntry *entry) {
    CzReader *reader = scenarios->reader;
    const CzNode *scenario = cz_take_part(reader, scenarios->tree, entry->value, entry->trail);
    if (scenario != NULL && scenario->kind == CZ_NODE_MAPPING)
        scenario = take_like(scenarios, scenario);
    if (scenario == NULL)
        return false;
    Family family = {.reader = reader, .node = scenario, .sweep = cz_node_find(scenario, "sweep")};
    const CzEntry *name = cz_node_find(scenario, "name");
    const bool is_family = family.sweep != NULL && name != NULL &&
                           name->value->kind == CZ_NODE_TEXT && read_sweep(&family);
    const int n = is_family ? family.n_member : 1;
    if (!may_add(scenarios, n, family.sweep != NULL ? family.sweep->key : scenario))
        return false;
    for (int i = 0; i < n; i++) {
        CzEntry *all = cz_arena_grow(&reader->arena, scenarios->entry, scenarios->n, sizeof *all);
        if (all == NULL)
            return false;
        scenarios->entry = all;
        CzEntry *item = &all[scenarios->n++];
        *item = *entry;
        if (is_family)
            item->value = member_node(&family, name, i);
        else if (family.sweep != NULL) /* its mistake was reported */
            item->value = cz_node_without(&reader->arena, scenario, "sweep", 0);
        else
            item->value = scenario;
        if (item->value == NULL)
            return false;
    }
    return true;
}

const CzNode *cz_families_write_out(CzReader *reader, const CzTree *tree) {
    const CzEntry *entry = cz_node_find_list(tree->root, "scenarios");
    Scenarios scenarios = {.reader = reader, .tree = tree};
    if (entry == NULL)
        return tree->root;
    CzNode *list = cz_node_copy(&reader->arena, entry->value, 0);
    if (list == NULL)
        return NULL;
    for (int i = 0; i < list->n_entry && !scenarios.is_full; i++)
        if (!append_scenario(&scenarios, &list->entry[i]) && !scenarios.is_full)
            return NULL;
    list->n_entry = scenarios.n;
    list->entry = scenarios.entry;
    return cz_node_with(&reader->arena, tree->root, entry, list);
}
