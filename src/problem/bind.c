/* Converts trees to typed records by the table of keys. */
#include "problem/bind.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/suggest.h"
#include "problem/strokes.h"
#include "tree/merge.h"

enum { MAX_KEYS = 64 };

/* The record being read. */
typedef struct {
    const CzRecord *record;
    const CzNode *node;
    const CzTrail *trail;
    char *memory;
    const CzNode *seen[MAX_KEYS]; /* key as typed, NULL as long as it has not been found (n_key) */
    bool meant[MAX_KEYS];         /* a mistyped key was found in its place (n_key) */
} Record;

static void bind_record(CzBinder binder, const CzRecord *of, const CzNode *node,
                        const CzTrail *trail, void *memory);

/* ---- records that are absent ---- */

static void fill_absent(const CzKey *key, char *memory) {
    switch (key->kind) {
    case CZ_KEY_NUMBER:
        *(double *)(memory + key->offset) = key->absent;
        break;
    case CZ_KEY_COUNT:
    case CZ_KEY_CHOICE:
        *(int *)(memory + key->offset) = (int)key->absent;
        break;
    case CZ_KEY_FLAG:
        *(bool *)(memory + key->offset) = key->absent != 0;
        break;
    case CZ_KEY_CHILD:
        cz_bind_absent(key->child, memory + key->offset);
        break;
    default: /* texts, tables and lists are empty: zero */
        break;
    }
}

void cz_bind_absent(const CzRecord *record, void *record_memory) {
    for (int i = 0; i < record->n_key; i++)
        fill_absent(&record->key[i], record_memory);
}

/* ---- wrong keys ---- */

/* The nearest key of a record. */
static const CzKey *nearest_key(const CzRecord *record, const char *typed,
                                CzSuggestion *suggestion) {
    const CzKey *nearest = NULL;
    char spelled[CZ_LONGEST_SUGGESTED];
    for (int i = 0; i < record->n_key; i++) {
        const CzKey *key = &record->key[i];
        const bool is_number = key->kind == CZ_KEY_NUMBER;
        for (const CzUnit *unit = cz_unit_si(is_number ? key->dimension : CZ_DIMENSION_NONE);
             unit != NULL; unit = cz_unit_next(unit)) {
            snprintf(spelled, sizeof spelled, "%s%s%s", key->stem,
                     unit->suffix[0] != '\0' ? "_" : "", unit->suffix);
            if (cz_suggest(suggestion, typed, spelled))
                nearest = key;
        }
    }
    return nearest;
}

/* The longest stem of a number with which a key begins, when only its unit is wrong. */
static const CzKey *key_of_stem(const CzRecord *record, const char *typed) {
    const CzKey *best = NULL;
    for (int i = 0; i < record->n_key; i++) {
        const CzKey *key = &record->key[i];
        const size_t n = strlen(key->stem);
        if (key->kind != CZ_KEY_NUMBER || strncmp(key->stem, typed, n) != 0)
            continue;
        const bool is_bare = typed[n] == '\0';
        const bool is_unit = typed[n] == '_' && strlen(typed + n + 1) <= 8;
        if ((is_bare || is_unit) && (best == NULL || n > strlen(best->stem)))
            best = key;
    }
    return best;
}

static const CzReuseKey *find_reuse_key(const char *typed) {
    for (int i = 0; i < cz_n_reuse_key; i++)
        if (strcmp(cz_reuse_keys[i].key, typed) == 0)
            return &cz_reuse_keys[i];
    return NULL;
}

/* Reports a number whose key has no unit, or a wrong one. */
static void report_unit(CzBinder binder, const Record *record, const CzNode *typed,
                        const CzKey *key, const CzTrail *trail) {
    char spellings[200], wrong[80] = " takes no unit";
    const char *suffix = typed->text + strlen(key->stem);
    cz_key_spellings(spellings, sizeof spellings, key->stem, key->dimension);
    if (key->dimension != CZ_DIMENSION_NONE && *suffix == '\0')
        snprintf(wrong, sizeof wrong, " needs a unit");
    else if (key->dimension != CZ_DIMENSION_NONE)
        snprintf(wrong, sizeof wrong, ": '%s' is not a unit of %s", suffix + 1,
                 cz_dimension_text[key->dimension]);
    cz_mistake(&binder.reader->mistakes, typed, trail, "key '%s' in %s%s" CZ_HELP "write %s",
               typed->text, record->record->name, wrong, spellings);
}

/* Suggests the keys for reuse that are allowed in a record. */
static void suggest_reuse(CzSuggestion *suggestion, const CzRecord *record, const char *typed) {
    for (int i = 0; i < cz_n_reuse_key; i++)
        if (cz_reuse_keys[i].record[0] == '\0' ||
            strcmp(cz_reuse_keys[i].record, record->name) == 0)
            cz_suggest(suggestion, typed, cz_reuse_keys[i].key);
}

/* Names the inner record to which a key belongs, when it is one level too far out. */
static void help_inwards(char help[160], const CzRecord *record, const char *typed) {
    for (int i = 0; i < record->n_key && help[0] == '\0'; i++) {
        const CzKey *key = &record->key[i];
        const CzUnit *unit = NULL;
        const bool is_list = key->kind == CZ_KEY_STAGES || key->kind == CZ_KEY_LIST;
        if ((key->kind == CZ_KEY_CHILD || is_list) &&
            cz_record_match(key->child, typed, &unit) != NULL)
            snprintf(help, 160, "it belongs to '%s', one level further in: %s: %s{%s: ...}%s",
                     key->stem, key->stem, is_list ? "[" : "", typed, is_list ? "]" : "");
    }
}

/* Reports a key that the record does not have; returns the intended key when that is clear. */
static const CzKey *report_unknown(CzBinder binder, const Record *record, const CzNode *typed,
                                   const CzTrail *trail) {
    char help[160] = "";
    CzMistakes *mistakes = &binder.reader->mistakes;
    CzSuggestion suggestion = {0};
    const CzKey *near = nearest_key(record->record, typed->text, &suggestion);
    const CzKey *stem = key_of_stem(record->record, typed->text);
    const CzReuseKey *reuse = find_reuse_key(typed->text);
    if (stem != NULL && (near == NULL || near == stem)) {
        report_unit(binder, record, typed, stem, trail);
        return stem;
    }
    if (reuse != NULL && reuse->record[0] != '\0')
        snprintf(help, sizeof help, "'%s' belongs to a %s", typed->text, reuse->record);
    else if (near == NULL)
        suggest_reuse(&suggestion, record->record, typed->text);
    if (suggestion.best[0] == '\0')
        help_inwards(help, record->record, typed->text);
    cz_mistake(mistakes, typed, trail, "unknown key '%s' in %s" CZ_HELP "%s", typed->text,
               record->record->name, help);
    if (help[0] == '\0')
        cz_mistake_suggest(mistakes, &suggestion);
    return reuse == NULL ? near : NULL;
}

static void report_missing(CzBinder binder, const Record *record, const CzKey *key) {
    char spellings[200] = "";
    const bool is_vehicle = record->record == &cz_records[CZ_RECORD_CzVehicle];
    const bool is_full = key->presence == CZ_PRESENCE_REQUIRED_FULL;
    const bool has_unit = key->kind == CZ_KEY_NUMBER && key->dimension != CZ_DIMENSION_NONE;
    if (has_unit)
        cz_key_spellings(spellings, sizeof spellings, key->stem, key->dimension);
    cz_mistake(&binder.reader->mistakes, record->node, record->trail,
               "%s%s%s lacks '%s': %s" CZ_HELP "%s%s", is_full && is_vehicle ? "full " : "",
               record->record->name, is_full && !is_vehicle ? " of a full vehicle" : "", key->stem,
               key->doc, has_unit ? "write " : "", spellings);
}

static bool is_list(CzBinder binder, const CzNode *key, const CzNode *value, const CzTrail *trail) {
    if (value->kind == CZ_NODE_LIST)
        return true;
    cz_mistake(&binder.reader->mistakes, value, trail,
               "'%s' needs a list, but this is %s" CZ_HELP
               "begin each item with '-', or write [first, second]",
               key->text, cz_node_what(value));
    binder.reader->has_holes = true;
    return false;
}

/* ---- values of one key ---- */

static void add_place(CzBinder binder, const void *address, const CzEntry *entry,
                      const CzTrail *trail, const CzKey *key, const CzUnit *unit) {
    cz_places_add(binder.places, (CzPlace){.address = address,
                                           .node = entry->key != NULL ? entry->key : entry->value,
                                           .value = entry->value,
                                           .trail = trail,
                                           .key = key,
                                           .unit = unit});
}

/* One word of a set; a mistyped word is read as the intended one. */
static bool bind_choice(CzValue value, const CzWordSet *set, int *choice) {
    char words[160] = "";
    size_t n = 0;
    CzSuggestion suggestion = {0};
    if (!cz_value_exists(value))
        return false;
    for (int i = 0; i < set->n_word; i++) {
        const char *before = i == 0 ? "" : i + 1 < set->n_word ? ", " : " or ";
        n += (size_t)snprintf(words + n, sizeof words - n, "%s%s", before, set->word[i].word);
        n = n < sizeof words ? n : sizeof words - 1;
        if (cz_suggest(&suggestion, value.node->text, set->word[i].word))
            *choice = i;
    }
    if (strcmp(suggestion.best, value.node->text) == 0)
        return true;
    cz_mistake(value.mistakes, value.node, value.trail, "%s: '%.60s' is not %s", value.key,
               value.node->text, words);
    cz_mistake_suggest(value.mistakes, &suggestion);
    return false;
}

/* Reads the items of a list of records, which are stored by pointer, or of a list of stages, which
 * are stored by value.
 */
static void bind_list(CzBinder binder, const Record *record, const CzKey *key, const CzEntry *entry,
                      const CzTrail *trail) {
    const CzNode *list = entry->value;
    const bool is_stages = key->kind == CZ_KEY_STAGES;
    if (!is_list(binder, entry->key, list, trail))
        return;
    const bool is_too_long = is_stages && list->n_entry > CZ_MAX_STAGES;
    if (is_too_long)
        cz_mistake(&binder.reader->mistakes, list, trail,
                   "'%s' has %d stages; at most %d are allowed", key->stem, list->n_entry,
                   (int)CZ_MAX_STAGES);
    else if (list->n_entry == 0 && (is_stages || key->presence == CZ_PRESENCE_REQUIRED))
        cz_mistake(&binder.reader->mistakes, list, trail,
                   is_stages ? "'%s' has no stage" : "'%s' is empty", key->stem);
    if (is_too_long || list->n_entry == 0) {
        binder.reader->has_holes = true;
        return;
    }
    char *items = record->memory + key->offset;
    if (!is_stages) {
        char **pointer = (char **)(void *)items;
        if (*pointer == NULL) /* trains and vehicles have memory already */
            *pointer =
                cz_arena_allocate(&binder.reader->arena, (size_t)list->n_entry, key->child->size);
        items = *pointer;
    }
    for (int i = 0; items != NULL && i < list->n_entry; i++)
        bind_record(binder, key->child, list->entry[i].value,
                    cz_entry_trail(&list->entry[i], trail), items + (size_t)i * key->child->size);
    *(int *)(void *)(record->memory + key->n_offset) = items != NULL ? list->n_entry : 0;
}

/* A record with its key as its first value, `name`; NULL without memory. */
static const CzNode *name_record(CzArena *arena, const CzEntry *entry, const CzTrail *trail) {
    const CzNode *node = entry->value;
    if (node->kind != CZ_NODE_MAPPING)
        return node;
    CzNode *named = cz_node_copy(arena, node, 1);
    if (named == NULL)
        return NULL;
    const CzNode *name = cz_node_name(arena, entry->key->text, entry->key);
    return cz_node_append(arena, named, "name", entry->key, name, trail) ? named : NULL;
}

/* Reads records by name as a list of records with names. */
static void bind_named(CzBinder binder, const Record *record, const CzKey *key,
                       const CzEntry *entry, const CzTrail *trail) {
    CzReader *reader = binder.reader;
    const CzNode *mapping = cz_take_part(reader, binder.tree, entry->value, trail);
    if (mapping == NULL)
        return;
    if (mapping->kind != CZ_NODE_MAPPING) {
        cz_mistake(&reader->mistakes, mapping, trail,
                   "'%s' needs a record for each name, {NAME: {...}}, but this is %s", key->stem,
                   cz_node_what(mapping));
        reader->has_holes = true;
        return;
    }
    CzNode *list = cz_node_copy(&reader->arena, mapping, 0);
    for (int i = 0; list != NULL && i < list->n_entry; i++) {
        CzEntry *item = &list->entry[i];
        item->trail = cz_entry_trail(item, trail);
        item->value = name_record(&reader->arena, item, item->trail);
        item->key = NULL;
        if (item->value == NULL)
            return;
    }
    if (list == NULL)
        return;
    list->kind = CZ_NODE_LIST;
    CzEntry listed = *entry;
    listed.value = list;
    bind_list(binder, record, key, &listed, trail);
}

static void bind_texts(CzBinder binder, const Record *record, const CzKey *key,
                       const CzEntry *entry, const CzTrail *trail) {
    const CzNode *list = entry->value;
    if (!is_list(binder, entry->key, list, trail))
        return;
    const char **text =
        cz_arena_allocate(&binder.reader->arena, (size_t)list->n_entry, sizeof *text);
    for (int i = 0; text != NULL && i < list->n_entry; i++) {
        text[i] = cz_value_text(cz_reader_value(binder.reader, key->stem, list->entry[i].value,
                                                cz_entry_trail(&list->entry[i], trail)));
        if (text[i] == NULL)
            return;
        add_place(binder, &text[i], &list->entry[i], trail, key, NULL);
    }
    *(CzTexts *)(void *)(record->memory + key->offset) =
        (CzTexts){text != NULL ? list->n_entry : 0, text};
}

static void bind_value(CzBinder binder, const Record *record, const CzKey *key, const CzUnit *unit,
                       const CzEntry *entry) {
    CzReader *reader = binder.reader;
    const CzTrail *trail = cz_entry_trail(entry, record->trail);
    void *field = record->memory + key->offset;
    CzValue value = cz_reader_value(reader, key->stem, entry->value, trail);
    switch (key->kind) {
    case CZ_KEY_NUMBER:
        value.key = entry->key->text;
        cz_value_number(value, unit, key->lo, key->hi, field);
        break;
    case CZ_KEY_COUNT:
        if (!cz_value_count(value, key->lo, key->hi, field) &&
            record->record == &cz_records[CZ_RECORD_CzInput])
            cz_mistake_help(&reader->mistakes, "this program reads version 1 of the format");
        break;
    case CZ_KEY_CHOICE:
        if (!bind_choice(value, key->words, field))
            reader->has_holes = true; /* the intended word might require fewer keys */
        break;
    case CZ_KEY_FLAG:
        cz_value_flag(value, field);
        break;
    case CZ_KEY_TEXT:
        *(const char **)field = cz_value_text(value);
        break;
    case CZ_KEY_CHILD:
        bind_record(binder, key->child, entry->value, trail, field);
        break;
    case CZ_KEY_TABLE: {
        const CzNode *node = cz_take_part(reader, binder.tree, entry->value, trail);
        if (node != NULL)
            cz_bind_curve(reader, binder.curves, key, node, trail, field);
        break;
    }
    case CZ_KEY_STAGES:
    case CZ_KEY_LIST:
        bind_list(binder, record, key, entry, trail);
        break;
    case CZ_KEY_NAMED:
        bind_named(binder, record, key, entry, trail);
        break;
    case CZ_KEY_TEXTS:
        bind_texts(binder, record, key, entry, trail);
        break;
    }
    add_place(binder, field, entry, trail, key, unit);
}

/* Uses the word under a mistyped key as if the key were right, which avoids consequential
 * mistakes. */
static void use_intended_word(const Record *record, const CzKey *key, const CzNode *value) {
    const int word = value->kind == CZ_NODE_TEXT ? cz_word_nearest(key->words, value->text) : -1;
    if (word >= 0)
        *(int *)(void *)(record->memory + key->offset) = word;
}

/* Finds the key that an entry names and reads its value. */
static void bind_entry(CzBinder binder, Record *record, const CzEntry *entry) {
    const CzUnit *unit = NULL;
    const CzTrail *trail = cz_entry_trail(entry, record->trail);
    if (entry->key->is_refused)
        return;
    const CzKey *key = cz_record_match(record->record, entry->key->text, &unit);
    if (key == NULL) {
        key = report_unknown(binder, record, entry->key, trail);
        if (key == NULL)
            return;
        record->meant[key - record->record->key] = true;
        binder.reader->has_holes |= key->kind >= CZ_KEY_CHILD;
        if (key->kind == CZ_KEY_NUMBER) /* an unread value violates no rule */
            *(double *)(void *)(record->memory + key->offset) = NAN;
        if (key->kind == CZ_KEY_CHOICE)
            use_intended_word(record, key, entry->value);
        add_place(binder, record->memory + key->offset, entry, trail, key, NULL);
        return;
    }
    const CzNode **seen = &record->seen[key - record->record->key];
    if (*seen != NULL) {
        cz_mistake(&binder.reader->mistakes, entry->key, trail,
                   "'%s' is given twice, as '%s' and as '%s'", key->stem, (*seen)->text,
                   entry->key->text);
        return;
    }
    *seen = entry->key;
    if (entry->value->is_refused)
        binder.reader->has_holes = true;
    else
        bind_value(binder, record, key, unit, entry);
}

/* The model that a vehicle declares, also under a mistyped key; NULL when it declares none. */
static const char *find_model(const CzNode *node) {
    const CzRecord *record = &cz_records[CZ_RECORD_CzVehicle];
    const CzKey *model = cz_record_key(record, "model");
    for (int i = 0; i < node->n_entry; i++) {
        const CzEntry *entry = &node->entry[i];
        const CzUnit *unit = NULL;
        CzSuggestion suggestion = {0};
        const CzKey *key = cz_record_match(record, entry->key->text, &unit);
        if (key == NULL)
            key = nearest_key(record, entry->key->text, &suggestion);
        if (key == model && entry->value->kind == CZ_NODE_TEXT)
            return entry->value->text;
    }
    return NULL;
}

/* Whether a vehicle is full, or is mistyped as something near it. */
static bool is_full_vehicle(const CzNode *node) {
    const char *model = find_model(node);
    return model == NULL || cz_word_nearest(&cz_word_sets[CZ_WORDS_MODEL], model) == CZ_MODEL_FULL;
}

static void bind_record(CzBinder binder, const CzRecord *of, const CzNode *node,
                        const CzTrail *trail, void *memory) {
    Record record = {.record = of, .trail = trail, .memory = memory};
    cz_bind_absent(of, memory);
    if (node->kind != CZ_NODE_MAPPING) {
        const bool may_be_part = node->kind == CZ_NODE_TEXT && node->text[0] != '\0';
        cz_mistake(&binder.reader->mistakes, node, trail,
                   "%s needs keys with values, but this is %s" CZ_HELP "%s%.80s%s", of->name,
                   cz_node_what(node), may_be_part ? "a part is taken with {use: " : "",
                   may_be_part ? node->text : "", may_be_part ? "}" : "");
        binder.reader->has_holes = true;
        return;
    }
    record.node = cz_take_part(binder.reader, binder.tree, node, trail);
    if (record.node == NULL)
        return;
    binder.is_partial |= record.node->is_partial;
    binder.reader->has_holes |= record.node->is_partial;
    if (of == &cz_records[CZ_RECORD_CzVehicle])
        binder.is_full = is_full_vehicle(record.node);
    *(bool *)memory = true; /* `given` is the first member of every record */
    cz_places_add(binder.places, (CzPlace){.address = memory,
                                           .size = record.record->size,
                                           .node = record.node,
                                           .trail = trail});
    for (int i = 0; i < record.node->n_entry; i++)
        bind_entry(binder, &record, &record.node->entry[i]);
    for (int i = 0; i < record.record->n_key; i++) {
        const CzKey *key = &record.record->key[i];
        const bool is_needed = key->presence == CZ_PRESENCE_REQUIRED ||
                               (key->presence == CZ_PRESENCE_REQUIRED_FULL && binder.is_full);
        if (is_needed && record.seen[i] == NULL && !record.meant[i] && !binder.is_partial)
            report_missing(binder, &record, key);
    }
    cz_bind_strokes(binder.reader, of, record.node, trail, memory);
}

void cz_bind_record(CzBinder binder, const CzRecord *record, const CzNode *node,
                    const CzTrail *trail, void *record_memory) {
    bind_record(binder, record, node, trail, record_memory);
    cz_places_sort(binder.places);
}
