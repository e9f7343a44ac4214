/* Follows paths. */
#include "tree/path.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "base/suggest.h"
#include "base/text.h"
#include "tree/merge.h"
#include "tree/segments.h"
#include "tree/trains.h"

enum { LONGEST_NAME = CZ_LABEL_SIZE, MAX_MATCHES = 10000, MAX_SET = 20000 };

typedef struct {
    CzReader *reader;
    const CzTree *tree;
    int n_segment;
    CzSegment segment[CZ_MAX_SEGMENTS];
    const CzNode *place; /* of the path */
    const CzPut *put;
    int n_found;
    bool failed;
    const char *train;  /* name of the train in the path, for its vehicles */
    const CzPart *part; /* whose values are set; NULL outside of parts */
    bool in_all_parts;  /* the path names all parts, one after the other */
    const CzTrail *set; /* trail of a value that is set: it belongs to the part, but has no origin
                           in it */
    char at[CZ_PATH_SIZE]; /* concrete path so far */
} Walk;

/* Progress along the path. */
typedef struct {
    const CzRecord *record; /* of the mapping, or of the list's items; NULL: not known */
    const CzRecord *named;  /* of the records of a mapping by name; NULL: it is a record */
    const CzTrail *trail;
    int level;    /* present segment */
    bool is_open; /* beyond a * */
    bool is_list; /* of a list's items */
} Step;

/* A node at the place of a segment, for mistakes. */
static CzNode place_of(const Walk *walk, int level) {
    CzNode place = *walk->place;
    if (level < walk->n_segment)
        place.column += walk->segment[level].offset + place.quoted;
    return place;
}

static bool read_path(Walk *walk, const char *path) {
    walk->n_segment = cz_segments_read(path, walk->segment);
    if (walk->n_segment > 0)
        return true;
    cz_mistake(&walk->reader->mistakes, walk->place, NULL,
               "'%s' is not a path" CZ_HELP
               "paths look like trains.A.vehicles.A1.front.stages[0].force_kN",
               path);
    return false;
}

/* Reports a mistake at a segment; no value is set afterwards. */
__attribute__((format(printf, 3, 4))) static void refuse(Walk *walk, int level, const char *format,
                                                         ...) {
    const CzNode place = place_of(walk, level);
    va_list arguments;
    va_start(arguments, format);
    cz_mistake_list(&walk->reader->mistakes, &place, NULL, format, arguments);
    va_end(arguments);
    walk->failed = true;
}

/* Concrete path so far. */
static const char *here(const Walk *walk) {
    return walk->at[0] != '\0' ? walk->at : "the problem";
}

/* ---- walking ---- */

/* Whether a record of the table has a name: trains and their vehicles are named by paths. */
static bool is_record(const CzRecord *record, const char *name) {
    return record != NULL && strcmp(record->name, name) == 0;
}

static const CzNode *walk_on(Walk *walk, const CzNode *node, Step step);

/* Appends a name, or without one an index, to the concrete path; returns the previous length for
 * cutting it again. */
static size_t enter(Walk *walk, const char *name, int index) {
    const size_t before = strlen(walk->at), room = sizeof walk->at - before;
    if (name == NULL)
        snprintf(walk->at + before, room, "[%d]", index);
    else
        snprintf(walk->at + before, room, "%s%s", before > 0 ? "." : "", name);
    return before;
}

/* Notes one more place that is set; false when there are too many. */
static bool may_put(Walk *walk) {
    walk->n_found++;
    if (++walk->reader->n_set == MAX_SET)
        cz_mistake(&walk->reader->mistakes, walk->place, NULL,
                   "the settings change more than %d values", (int)MAX_SET);
    walk->failed |= walk->reader->n_set >= MAX_SET;
    return !walk->failed;
}

/* A text node with a number at the place of the path's last segment. */
static CzNode *number_node(Walk *walk, const char *text) {
    CzNode *node = cz_arena_allocate(&walk->reader->arena, 1, sizeof *node);
    if (node == NULL)
        return NULL;
    *node = place_of(walk, walk->n_segment - 1);
    node->kind = CZ_NODE_TEXT;
    node->text = text;
    node->quoted = false;
    return node;
}

/* A stand-in for the number at the present place, which is added to the matches. */
static const CzNode *marker_at(Walk *walk) {
    CzMatches *matches = walk->put->matches;
    walk->n_found++;
    if (matches->n_match == MAX_MATCHES) {
        if (!walk->failed)
            cz_mistake(&walk->reader->mistakes, walk->place, NULL,
                       "the path names more than %d places", (int)MAX_MATCHES);
        walk->failed = true;
    }
    char(*places)[CZ_PATH_SIZE] = cz_arena_grow(&walk->reader->arena, matches->place,
                                                matches->n_match, sizeof *matches->place);
    CzNode *marker = number_node(walk, "0");
    if (places == NULL || marker == NULL)
        return NULL;
    matches->place = places;
    if (walk->failed)
        return marker;
    memcpy(matches->place[matches->n_match], walk->at, CZ_PATH_SIZE);
    marker->match = ++matches->n_match;
    return marker;
}

/* The value of the setting, or a stand-in. */
static const CzNode *value_to_put(Walk *walk) {
    if (walk->put->kind == CZ_PUT_MARKER)
        return marker_at(walk);
    may_put(walk);
    return walk->put->value;
}

/* The number at an entry, changed by the factor or sum; the entry's key keeps its unit. */
static const CzNode *changed_number(Walk *walk, const char *named, const CzEntry *there) {
    const CzPut *put = walk->put;
    const CzNode *node = there->value;
    const bool is_bare = node->kind == CZ_NODE_TEXT && !node->quoted;
    double number;
    if (is_bare && node->match > 0)
        return node;
    const char *wrong = is_bare ? cz_number_parse(node->text, &number) : "is not a number";
    if (wrong != NULL) {
        refuse(walk, walk->n_segment - 1, "%s cannot be changed by a %s: it %s", walk->at,
               put->kind == CZ_PUT_FACTOR ? "factor" : "sum", wrong);
        return node;
    }
    if (put->kind == CZ_PUT_FACTOR)
        number *= put->number;
    else if (strcmp(named, there->key->text) == 0)
        number += put->number;
    else
        number += put->number * cz_key_unit_si(named) / cz_key_unit_si(there->key->text);
    char text[CZ_NUMBER_TEXT];
    cz_number_print(text, number);
    return number_node(walk, cz_arena_copy_text(&walk->reader->arena, text, strlen(text)));
}

static bool is_change(const Walk *walk) {
    return walk->put->kind == CZ_PUT_FACTOR || walk->put->kind == CZ_PUT_SUM;
}

/* Whether the path ends in the `use` of a record that has one: the setting then replaces the part
 * of the record.
 */
static bool sets_part(const Walk *walk, const CzNode *node, Step step) {
    return step.level == walk->n_segment - 1 &&
           strcmp(walk->segment[step.level].name, "use") == 0 &&
           walk->segment[step.level].kind == CZ_SEGMENT_NAME && cz_node_find(node, "use") != NULL;
}

/* Whether a place is left out: beyond a * among the parts where the key is not written or belongs
 * to a part that this one uses, beyond any other * where there is no number to change. */
static bool is_left_out(Walk *walk, const CzEntry *there, Step step) {
    if (walk->in_all_parts)
        return there == NULL || cz_entry_trail(there, step.trail)->written != walk->part->written;
    if (there != NULL || !is_change(walk))
        return false;
    if (!step.is_open)
        refuse(walk, step.level, "%s has no '%s' that a %s could change", here(walk),
               walk->segment[step.level].name, walk->put->kind == CZ_PUT_FACTOR ? "factor" : "sum");
    return true;
}

/* Puts something at the path's last key. */
static const CzNode *put_value(Walk *walk, const CzNode *mapping, Step step) {
    const char *name = walk->segment[step.level].name;
    const CzNode place = place_of(walk, step.level);
    if (cz_text_is_word(name, "use extends catalogue parts set") &&
        !sets_part(walk, mapping, step)) {
        refuse(walk, step.level, "'%s' cannot be set by a path", name);
        return mapping;
    }
    CzNode *changed = cz_node_copy(&walk->reader->arena, mapping, 1);
    CzEntry *there = changed != NULL ? cz_find_same_stem(changed, name) : NULL;
    if (changed == NULL || is_left_out(walk, there, step))
        return changed != NULL ? mapping : NULL;
    const size_t before = enter(walk, name, 0);
    CzEntry entry = {cz_node_text(&walk->reader->arena, name, &place), NULL,
                     walk->part != NULL ? walk->set : &cz_no_trail};
    if (is_change(walk) && may_put(walk))
        entry = (CzEntry){there->key, changed_number(walk, name, there), there->trail};
    else
        entry.value = value_to_put(walk);
    walk->at[before] = '\0';
    if (entry.key == NULL || entry.value == NULL)
        return NULL;
    *(there != NULL ? there : &changed->entry[changed->n_entry++]) = entry;
    return changed;
}

static bool needs_nothing(const CzRecord *record) {
    for (int i = 0; i < record->n_key; i++)
        if (record->key[i].presence <= CZ_PRESENCE_REQUIRED_FULL)
            return false;
    return true;
}

/* The step from a mapping to a record or list inside, without its trail. */
static Step inwards(Step step, const char *name) {
    const CzKey *key = step.record != NULL ? cz_record_key(step.record, name) : NULL;
    const CzRecord *inside = key != NULL ? key->child : step.named;
    const bool is_named = key != NULL && key->kind == CZ_KEY_NAMED;
    return (Step){.record = is_named ? NULL : inside,
                  .named = is_named ? inside : NULL,
                  .level = step.level + 1,
                  .is_open = step.is_open,
                  .is_list = key != NULL && key->kind != CZ_KEY_CHILD && !is_named};
}

/* Whether a record that is not in the file may begin with the value that is set. */
static bool may_be_added(const Step *step) {
    return step->named != NULL ||
           (step->record != NULL && !step->is_list && needs_nothing(step->record));
}

static void report_unknown(Walk *walk, const CzNode *mapping, Step step) {
    const char *name = walk->segment[step.level].name;
    CzSuggestion suggestion = {0};
    walk->failed = true;
    if (mapping->is_partial) /* a missing part is reported where it is used */
        return;
    for (int i = 0; i < mapping->n_entry; i++)
        cz_suggest(&suggestion, name, mapping->entry[i].key->text);
    for (int i = 0; step.record != NULL && i < step.record->n_key; i++)
        if (step.record->key[i].kind >= CZ_KEY_CHILD)
            cz_suggest(&suggestion, name, step.record->key[i].stem);
    refuse(walk, step.level, "there is no '%s' in %s", name, here(walk));
    if (strcmp(suggestion.best, name) != 0) /* else it is a key that is not in the mapping */
        cz_mistake_suggest(&walk->reader->mistakes, &suggestion);
}

/* Whether a train copies another one, so that it has no vehicles of its own to change. */
static bool is_copied(Walk *walk, const CzNode *mapping, Step step) {
    const char *copied = cz_node_find_text(mapping, "copy");
    if (!is_record(step.record, "train") || copied == NULL ||
        strcmp(walk->segment[step.level].name, "vehicles") != 0)
        return false;
    if (step.is_open)
        return true;
    refuse(walk, step.level,
           "%s copies train '%s' and has no vehicles of its own" CZ_HELP
           "trains.%s.vehicles names those of both trains",
           walk->at, copied, copied);
    return true;
}

static const CzNode *walk_mapping(Walk *walk, const CzNode *mapping, Step step) {
    const CzSegment *segment = &walk->segment[step.level];
    if (segment->kind != CZ_SEGMENT_NAME) {
        refuse(walk, step.level, "%s is not a list: a key must follow", here(walk));
        return mapping;
    }
    if (step.level == walk->n_segment - 1)
        return put_value(walk, mapping, step);
    if (is_copied(walk, mapping, step))
        return mapping;
    const CzEntry *entry = cz_node_find(mapping, segment->name);
    Step next = inwards(step, segment->name);
    const bool is_new = entry == NULL;
    if (is_new && step.is_open)
        return mapping;
    if (is_new && (walk->put->kind != CZ_PUT_VALUE || !may_be_added(&next))) {
        report_unknown(walk, mapping, step);
        return mapping;
    }
    CzArena *arena = &walk->reader->arena;
    CzNode *changed = cz_node_copy(arena, mapping, 1);
    const CzNode place = place_of(walk, step.level);
    CzNode empty = place;
    empty.kind = CZ_NODE_MAPPING;
    empty.n_entry = 0;
    if (changed == NULL ||
        (is_new && !cz_node_append(arena, changed, segment->name, &place, &empty, &cz_no_trail)))
        return NULL;
    const int at = is_new ? changed->n_entry - 1 : (int)(entry - mapping->entry);
    if (is_record(step.record, "train"))
        walk->train = cz_node_find_text(mapping, "name");
    const size_t before = enter(walk, segment->name, 0);
    next.trail = cz_entry_trail(&changed->entry[at], step.trail);
    changed->entry[at].value = walk_on(walk, changed->entry[at].value, next);
    walk->at[before] = '\0';
    if (changed->entry[at].value == &empty) /* no value was set */
        changed->n_entry--;
    return changed->entry[at].value != NULL ? changed : NULL;
}

/* ---- items of lists ---- */

/* Name of an item in a path: its own, or for a vehicle the counted one. */
static const char *name_of_item(Walk *walk, const CzNode *item, const CzRecord *record,
                                int position, char *text, size_t size) {
    if (is_record(record, "vehicle") && walk->train != NULL) {
        cz_vehicle_name(text, size, item, walk->train, position, 0);
        return text;
    }
    return cz_node_find_text(item, "name");
}

static void report_no_item(Walk *walk, const CzNode *list, Step step) {
    const CzSegment *segment = &walk->segment[step.level];
    if (segment->kind == CZ_SEGMENT_INDEX) {
        refuse(walk, step.level, "%s has %d items, counted from 0; there is no [%d]", walk->at,
               list->n_entry, segment->index);
        return;
    }
    CzSuggestion suggestion = {0};
    char text[LONGEST_NAME];
    for (int i = 0, position = 1; i < list->n_entry; i++) {
        const CzNode *item = list->entry[i].value;
        const int n_repeat = is_record(step.record, "vehicle") ? cz_vehicle_repeat(item) : 1;
        for (int k = 1; k < n_repeat && walk->train != NULL; k++) {
            cz_vehicle_name(text, sizeof text, item, walk->train, position, k);
            if (strcmp(text, segment->name) == 0) {
                cz_vehicle_name(text, sizeof text, item, walk->train, position, 0);
                refuse(walk, step.level,
                       "vehicle '%s' is '%s' repeated and has no values of its own" CZ_HELP
                       "'%s' names all %d of them",
                       segment->name, text, text, n_repeat);
                return;
            }
        }
        const char *name = name_of_item(walk, item, step.record, position, text, sizeof text);
        if (name != NULL)
            cz_suggest(&suggestion, segment->name, name);
        position += n_repeat;
    }
    refuse(walk, step.level, "there is no '%s' in %s", segment->name, walk->at);
    cz_mistake_suggest(&walk->reader->mistakes, &suggestion);
}

/* Continues in one item, or replaces it by the value when the path ends there. */
static const CzNode *walk_item(Walk *walk, const CzNode *item, Step step) {
    if (step.level + 1 < walk->n_segment) {
        step.level++;
        return walk_on(walk, item, step);
    }
    if (item->kind == CZ_NODE_TEXT && !is_change(walk))
        return value_to_put(walk);
    refuse(walk, step.level, "%s is %s: a key must follow", walk->at, cz_node_what(item));
    return item;
}

static const CzNode *walk_list(Walk *walk, const CzNode *list, Step step) {
    const CzSegment *segment = &walk->segment[step.level];
    CzNode *changed = cz_node_copy(&walk->reader->arena, list, 0);
    bool is_found = segment->kind == CZ_SEGMENT_ALL;
    for (int i = 0, position = 1; changed != NULL && i < list->n_entry; i++) {
        char text[LONGEST_NAME];
        const CzTrail *trail = cz_entry_trail(&list->entry[i], step.trail);
        const CzNode *item = cz_take_part(walk->reader, walk->tree, list->entry[i].value, trail);
        if (item == NULL)
            return NULL;
        const char *name = name_of_item(walk, item, step.record, position, text, sizeof text);
        position += is_record(step.record, "vehicle") ? cz_vehicle_repeat(item) : 1;
        if (segment->kind == CZ_SEGMENT_NAME && (name == NULL || strcmp(name, segment->name) != 0))
            continue;
        if (segment->kind == CZ_SEGMENT_INDEX && segment->index != i)
            continue;
        is_found = true;
        const size_t before = enter(walk, name, i);
        const Step next = {.record = step.record,
                           .trail = trail,
                           .level = step.level,
                           .is_open = step.is_open || segment->kind == CZ_SEGMENT_ALL};
        changed->entry[i].value = walk_item(walk, item, next);
        walk->at[before] = '\0';
        if (changed->entry[i].value == NULL)
            return NULL;
    }
    if (!is_found)
        report_no_item(walk, list, step);
    return changed;
}

static const CzNode *walk_on(Walk *walk, const CzNode *node, Step step) {
    if (!walk->failed && sets_part(walk, node, step))
        return put_value(walk, node, step);
    const CzNode *taken = cz_take_part(walk->reader, walk->tree, node, step.trail);
    if (taken == NULL || walk->failed)
        return taken;
    if (taken->kind == CZ_NODE_MAPPING)
        return walk_mapping(walk, taken, step);
    if (taken->kind == CZ_NODE_LIST)
        return walk_list(walk, taken, step);
    refuse(walk, step.level, "%s is a value: no key can follow", walk->at);
    return taken;
}

/* ---- the top ---- */

/* Continues in one part. */
static bool walk_part(Walk *walk, CzPart *part, bool is_open) {
    CzTrail *trail = cz_arena_allocate(&walk->reader->arena, 2, sizeof *trail);
    if (trail == NULL)
        return false;
    trail[0] = (CzTrail){part->name, part->written, NULL, &cz_no_trail};
    trail[1] = (CzTrail){.written = part->written};
    walk->part = part;
    walk->set = &trail[1];
    snprintf(walk->at, sizeof walk->at, "parts.%s", part->name);
    const CzNode *changed =
        walk_on(walk, part->node, (Step){.trail = trail, .level = 2, .is_open = is_open});
    if (changed != NULL)
        part->node = changed;
    return changed != NULL;
}

/* Continues in all parts of a depth. */
static bool walk_parts(Walk *walk, CzTree *tree, int depth) {
    for (int i = 0; i < tree->n_part && !walk->failed; i++) {
        CzPart *part = &tree->part[i];
        walk->in_all_parts = true;
        if (part->depth == depth && part->node->kind == CZ_NODE_MAPPING &&
            !walk_part(walk, part, true))
            return false;
    }
    return true;
}

static bool put_into_parts(Walk *walk, CzTree *tree, int depth) {
    const CzSegment *segment = &walk->segment[1];
    if (walk->n_segment > 2 && segment->kind == CZ_SEGMENT_ALL)
        return walk_parts(walk, tree, depth);
    const bool names = walk->n_segment > 2 && segment->kind == CZ_SEGMENT_NAME;
    CzPart *part = names ? cz_tree_part(tree, segment->name, strlen(segment->name)) : NULL;
    if (part != NULL)
        return walk_part(walk, part, false);
    CzSuggestion suggestion = {0};
    for (int i = 0; names && i < tree->n_part; i++)
        cz_suggest(&suggestion, segment->name, tree->part[i].name);
    walk->failed = true;
    if (names && tree->lacks_parts)
        return true;
    if (names)
        refuse(walk, 1, "there is no part '%s'", segment->name);
    else
        refuse(walk, walk->n_segment > 1 ? 1 : 0,
               "'parts' is followed by the name of a part and one of its keys");
    cz_mistake_suggest(&walk->reader->mistakes, &suggestion);
    return true;
}

int cz_path_put(CzReader *reader, CzTree *tree, const char *path, const CzNode *place,
                const CzPut *put, int depth) {
    Walk walk = {.reader = reader, .tree = tree, .place = place, .put = put};
    if (!read_path(&walk, path))
        return -1;
    bool has_memory;
    if (walk.segment[0].kind == CZ_SEGMENT_NAME && strcmp(walk.segment[0].name, "parts") == 0) {
        has_memory = put_into_parts(&walk, tree, depth);
    } else {
        const Step top = {.record = reader->top, .trail = &cz_no_trail};
        const CzNode *root = walk_on(&walk, tree->root, top);
        has_memory = root != NULL;
        tree->root = has_memory ? root : tree->root;
    }
    return has_memory && !walk.failed ? walk.n_found : -1;
}
