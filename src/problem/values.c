/* The values of a resolved problem: its text, read again as a tree, with the origins that stand in
 * the comments behind the values. */
#include "problem/values.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory_text.h"
#include "base/number.h"
#include "problem/reading.h"
#include "text/yaml.h"

typedef struct Lister {
    CzArena *arena;
    int n;
    CzProblemValue *value;
} Lister;

static const char *copy(Lister *lister, const char *text, size_t n) {
    return cz_arena_copy_text(lister->arena, text, n);
}

/* The comment behind a value, which gives its origin; empty when there is none. */
static const char *comment_of(const CzNode *node) {
    const char *line = node->line >= 1 && node->line <= node->source->n_line
                           ? node->source->line[node->line - 1]
                           : "";
    const char *comment = strstr(line, " # ");
    return comment != NULL ? comment + 3 : "";
}

/* The key in an origin such as "a.yaml:3, force_kN: 1100, part p", of that stem, up to its colon;
 * NULL when the value was typed in SI. */
static const char *typed_key(const char *origin, const char *stem, size_t n_stem) {
    for (const char *at = strstr(origin, ", "); at != NULL; at = strstr(at + 2, ", "))
        if (strncmp(at + 2, stem, n_stem) == 0 && at[2 + n_stem] == '_')
            return at + 2;
    return NULL;
}

/* An origin without the typed key, whose unit the list has, and with the part alone that has the
 * value, without those that use it. */
static const char *place_of(Lister *lister, const char *origin, const char *typed) {
    static const char before[] = ", part ";
    char text[2 * CZ_PATH_SIZE];
    const char *part = strstr(origin, before);
    const size_t n_place = typed != NULL  ? (size_t)(typed - 2 - origin)
                           : part != NULL ? (size_t)(part - origin)
                                          : strlen(origin);
    const size_t n_part =
        part != NULL ? strcspn(part + sizeof before - 1, ",") + sizeof before - 1 : 0;
    snprintf(text, sizeof text, "%.*s%.*s", (int)n_place, origin, (int)n_part,
             part != NULL ? part : "");
    return copy(lister, text, strlen(text));
}

static void add_value(Lister *lister, const char *path, const CzNode *key, const char *text) {
    CzProblemValue *value =
        cz_arena_grow(lister->arena, lister->value, lister->n, sizeof *lister->value);
    if (value == NULL)
        return;
    lister->value = value;
    value += lister->n++;
    const char *origin = comment_of(key), *name = key->text != NULL ? key->text : "";
    const size_t n_stem = cz_key_stem_length(name);
    const char *typed = typed_key(origin, name, n_stem);
    char full[CZ_PATH_SIZE] = "";
    snprintf(full, sizeof full, "%.*s", typed != NULL ? (int)strcspn(typed, ":") : 0,
             typed != NULL ? typed : "");
    const char *unit_key = typed != NULL ? full : name;
    const char *unit = strlen(unit_key) > n_stem ? unit_key + n_stem + 1 : "";
    *value = (CzProblemValue){.path = copy(lister, path, strlen(path)),
                              .text = copy(lister, text, strlen(text)),
                              .unit = copy(lister, unit, strlen(unit)),
                              .number = NAN,
                              .origin = place_of(lister, origin, typed)};
    if (cz_number_parse(text, &value->number) != NULL)
        value->number = NAN;
    else if (typed != NULL)
        value->number /= cz_key_unit_si(full);
}

/* The texts of a list of texts, such as [a, b] or a point of a curve. */
static void add_list(Lister *lister, const char *path, const CzNode *key, const CzNode *list) {
    char text[CZ_PATH_SIZE] = "";
    size_t n = 0;
    for (int i = 0; i < list->n_entry && n < sizeof text; i++)
        n += (size_t)snprintf(text + n, sizeof text - n, "%s%s", i > 0 ? ", " : "",
                              list->entry[i].value->text);
    add_value(lister, path, key, text);
}

static bool is_list_of_texts(const CzNode *node) {
    bool is = node->kind == CZ_NODE_LIST && node->n_entry > 0;
    for (int i = 0; is && i < node->n_entry; i++)
        is = node->entry[i].value->kind == CZ_NODE_TEXT;
    return is;
}

static void list_node(Lister *lister, const CzNode *node, const char *path) {
    for (int i = 0; i < node->n_entry; i++) {
        const CzEntry *entry = &node->entry[i];
        const char *before = path[0] != '\0' ? "." : "";
        const char *name = cz_node_find_text(entry->value, "name");
        char inside[2 * CZ_PATH_SIZE];
        if (entry->key != NULL)
            snprintf(inside, sizeof inside, "%s%s%.*s", path, before,
                     (int)cz_key_stem_length(entry->key->text), entry->key->text);
        else if (name != NULL)
            snprintf(inside, sizeof inside, "%s%s%s", path, before, name);
        else
            snprintf(inside, sizeof inside, "%s[%d]", path, i);
        const CzNode *key = entry->key != NULL ? entry->key : entry->value;
        if (entry->value->kind == CZ_NODE_TEXT)
            add_value(lister, inside, key, entry->value->text);
        else if (is_list_of_texts(entry->value))
            add_list(lister, inside, key, entry->value);
        else
            list_node(lister, entry->value, inside);
    }
}

/* The resolved text: that of the file where it is resolved; to be freed, NULL without memory. */
static char *resolved_text(const CzProblem *problem) {
    const CzSource *first = problem->reader.sources.first;
    CzMemoryText memory = {0};
    FILE *stream = cz_memory_text_open(&memory);
    if (stream == NULL)
        return NULL;
    if (first->n_line > 0 && strstr(first->line[0], CZ_RESOLVED_MARK) != NULL)
        for (int i = 0; i < first->n_line; i++)
            fprintf(stream, "%s\n", first->line[i]);
    else
        cz_problem_write_resolved(problem, stream);
    if (fclose(stream) == 0 && !memory.failed)
        return memory.text;
    cz_memory_text_free(&memory);
    return NULL;
}

CzStatus cz_problem_list_values(const CzProblem *problem, CzArena *arena, int *n,
                                CzProblemValue **value, CzError *error) {
    Lister lister = {.arena = arena};
    CzSources sources = {.arena = arena, .hash = CZ_HASH_START};
    CzMistakes mistakes = {.arena = arena};
    char *text = resolved_text(problem);
    const CzSource *source =
        text != NULL ? cz_sources_add(&sources, "resolved", ".", text, strlen(text)) : NULL;
    const CzNode *top =
        source != NULL ? cz_yaml_document(&mistakes, source, text, strlen(text)) : NULL;
    if (top != NULL)
        list_node(&lister, top, "");
    free(text);
    *n = lister.n;
    *value = lister.value;
    return top != NULL && !arena->out_of_memory ? CZ_OK : cz_no_memory(error, "the values");
}

const char *cz_problem_unit_symbol(const char *unit) {
    for (int i = 0; i < cz_n_unit; i++)
        if (strcmp(cz_units[i].suffix, unit) == 0)
            return cz_units[i].symbol;
    return unit;
}

double cz_problem_value_in(const CzProblemValue *value, const char *unit) {
    char own[40], other[40];
    snprintf(own, sizeof own, "x%s%.30s", value->unit[0] != '\0' ? "_" : "", value->unit);
    snprintf(other, sizeof other, "x%s%.30s", unit[0] != '\0' ? "_" : "", unit);
    return value->number * cz_key_unit_si(own) / cz_key_unit_si(other);
}
