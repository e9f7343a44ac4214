/* Collects settings, and applies them by rank. */
#include "tree/settings.h"

#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "text/units.h"

/* Text of all settings of the options, one per line. NULL without memory. */
static char *join_lines(int n_set, const char *const *set, size_t *n_byte) {
    size_t n = 1;
    for (int i = 0; i < n_set; i++)
        n += strlen(set[i]) + 1;
    char *text = malloc(n);
    *n_byte = 0;
    for (int i = 0; text != NULL && i < n_set; i++) {
        const size_t n_line = strlen(set[i]);
        memcpy(text + *n_byte, set[i], n_line);
        for (size_t k = 0; k < n_line; k++)
            if (text[*n_byte + k] == '\n')
                text[*n_byte + k] = ' ';
        *n_byte += n_line;
        text[(*n_byte)++] = '\n';
    }
    return text;
}

/* The n characters from `text` as a value: in quotes they stay text. */
static const CzNode *text_of(CzReader *reader, const char *text, size_t n, const CzNode *place) {
    const bool is_quoted = n >= 2 && (text[0] == '"' || text[0] == '\'') && text[n - 1] == text[0];
    CzNode *node = cz_arena_allocate(&reader->arena, 1, sizeof *node);
    if (node == NULL)
        return NULL;
    *node = *place;
    node->quoted = is_quoted;
    char *copy = cz_arena_copy_text(&reader->arena, text + is_quoted, n - 2 * (size_t)is_quoted);
    if (copy != NULL)
        (void)cz_text_one_line(copy, strlen(copy));
    node->text = copy;
    return copy != NULL ? node : NULL;
}

/* A list of n characters, as "[a, 'b, c']", without brackets in its texts. */
static const CzNode *list_of(CzReader *reader, const char *text, size_t n, const CzNode *place) {
    CzNode empty = *place;
    empty.kind = CZ_NODE_LIST;
    CzNode *list = cz_node_copy(&reader->arena, &empty, (int)n);
    for (size_t at = 1; list != NULL && at + 1 < n;) {
        const size_t begin = at + strspn(text + at, " ");
        const bool is_quoted = text[begin] == '"' || text[begin] == '\'';
        const char *close = is_quoted ? memchr(text + begin + 1, text[begin], n - begin - 1) : NULL;
        size_t length =
            close != NULL ? (size_t)(close - text) - begin + 1 : strcspn(text + begin, ",]");
        CzNode there = *place;
        there.column += (int)begin;
        at = begin + length;
        at += strcspn(text + at, ",]") + 1;
        while (length > 0 && text[begin + length - 1] == ' ')
            length--;
        const CzNode *item = text_of(reader, text + begin, length, &there);
        if (item == NULL)
            return NULL;
        list->entry[list->n_entry++] = (CzEntry){.value = item};
    }
    return list;
}

/* A value as typed: a text, or a list of texts. */
static const CzNode *value_of(CzReader *reader, const char *text, const CzNode *place) {
    const size_t n = strlen(text);
    const bool is_list = n >= 2 && text[0] == '[' && strcspn(text + 1, "[]{}") == n - 2;
    return (is_list && text[n - 1] == ']' ? list_of : text_of)(reader, text, n, place);
}

/* Cuts "path=value". */
static bool read_setting(CzReader *reader, const CzSource *source, int line, CzSetting *setting) {
    const char *text = source->line[line];
    const char *equals = strchr(text, '=');
    if (equals == NULL || equals == text || equals[1] == '\0') {
        cz_mistake_at(&reader->mistakes, source, line + 1, 1, "'%s' is not path=value", text);
        return false;
    }
    const CzNode place = {.source = source, .line = line + 1, .column = 1};
    CzNode value_place = place;
    value_place.column = (int)(equals - text) + 2;
    setting->path = cz_arena_copy_text(&reader->arena, text, (size_t)(equals - text));
    if (setting->path != NULL)
        setting->place = cz_node_text(&reader->arena, setting->path, &place);
    setting->put.value = value_of(reader, equals + 1, &value_place);
    return setting->path != NULL && setting->place != NULL && setting->put.value != NULL;
}

int cz_settings_gather_options(CzReader *reader, const char *folder, int n_set,
                               const char *const *set, CzSetting *setting) {
    size_t n_byte = 0;
    char *text = join_lines(n_set, set, &n_byte);
    const CzSource *source =
        text != NULL ? cz_sources_add(&reader->sources, "--set", folder, text, n_byte) : NULL;
    int n_setting = 0;
    if (text == NULL)
        reader->arena.out_of_memory = true;
    if (source != NULL && cz_source_is_text(&reader->mistakes, source, text, n_byte))
        for (int i = 0; i < n_set; i++)
            n_setting += read_setting(reader, source, i, &setting[n_setting]);
    free(text);
    return n_setting;
}

/* Rejects a value that the record `set` has twice, in two units, because only the later one would
 * have an effect. */
static void refuse_twice(CzReader *reader, const CzNode *own, int i) {
    for (int k = 0; k < i; k++)
        if (cz_key_same_stem(own->entry[k].key->text, own->entry[i].key->text)) {
            cz_mistake(&reader->mistakes, own->entry[i].key, NULL,
                       "one value is set twice, as '%.120s' and as '%.120s'",
                       own->entry[k].key->text, own->entry[i].key->text);
            return;
        }
}

/* Whether a node is a value or a list of values. */
static bool is_settable(const CzNode *node) {
    bool is = node->kind != CZ_NODE_MAPPING;
    for (int i = 0; is && node->kind == CZ_NODE_LIST && i < node->n_entry; i++)
        is = node->entry[i].value->kind == CZ_NODE_TEXT;
    return is;
}

const CzSetting *cz_settings_gather(CzReader *reader, const CzNode *root, int n_set,
                                    const char *const *set, int *n_setting) {
    const CzEntry *own = cz_node_find(root, "set");
    const int n_own = own != NULL && own->value->kind == CZ_NODE_MAPPING ? own->value->n_entry : 0;
    CzSetting *setting =
        cz_arena_allocate(&reader->arena, (size_t)(n_own + n_set), sizeof *setting);
    *n_setting = 0;
    if (setting == NULL)
        return NULL;
    if (own != NULL && own->value->kind != CZ_NODE_MAPPING)
        cz_mistake(&reader->mistakes, own->value, NULL,
                   "'set' needs a mapping of paths to values, but this is %s",
                   cz_node_what(own->value));
    for (int i = 0; i < n_own; i++) {
        const CzEntry *entry = &own->value->entry[i];
        refuse_twice(reader, own->value, i);
        if (is_settable(entry->value))
            setting[(*n_setting)++] =
                (CzSetting){entry->key->text, entry->key, {.value = entry->value}, false};
        else
            cz_mistake(&reader->mistakes, entry->value, NULL,
                       "'%s' is set to %s; it needs a value or a list of values", entry->key->text,
                       cz_node_what(entry->value));
    }
    if (n_set > 0)
        *n_setting += cz_settings_gather_options(reader, reader->sources.first->folder, n_set, set,
                                                 &setting[*n_setting]);
    return setting;
}

/* ---- their order ---- */

enum { LAST_RANK = 48, EVERY_RANK = -1 };

/* Rank by which a setting is applied: 0 for parts without nested parts, higher with the nesting
 * depth of a part, LAST_RANK outside of parts; a setting of all parts is applied with each. */
static int rank_of(const CzTree *tree, const char *path) {
    if (strncmp(path, "parts.", 6) != 0)
        return LAST_RANK;
    const char *name = path + 6;
    if (strncmp(name, "*.", 2) == 0)
        return EVERY_RANK;
    const CzPart *part = cz_tree_part(tree, name, strcspn(name, ".["));
    const int depth = part != NULL ? part->depth : 0;
    return depth < LAST_RANK ? depth : LAST_RANK - 1;
}

static void refuse_without_place(CzReader *reader, const CzSetting *setting) {
    cz_mistake(&reader->mistakes, setting->place, NULL, "'%s' names no place of this problem",
               setting->path);
}

/* Applies the settings to a tree with parts of its own; `rank` and `n_put` are scratch
 * (n_setting). */
static void apply(CzReader *reader, CzTree *tree, const CzSetting *setting, int n_setting,
                  int *rank, int *n_put) {
    for (int i = 0; i < n_setting; i++) {
        rank[i] = setting[i].is_late ? LAST_RANK + 1 : rank_of(tree, setting[i].path);
        n_put[i] = 0;
    }
    for (int at = 0; at <= LAST_RANK; at++)
        for (int i = 0; i < n_setting; i++) {
            if (rank[i] != at && (rank[i] != EVERY_RANK || n_put[i] < 0))
                continue;
            const int n =
                cz_path_put(reader, tree, setting[i].path, setting[i].place, &setting[i].put, at);
            n_put[i] = n < 0 ? n : n_put[i] + n;
        }
    for (int i = 0; i < n_setting; i++)
        if (n_put[i] == 0 && !setting[i].is_late)
            refuse_without_place(reader, &setting[i]);
}

CzTree cz_settings_apply_first(CzReader *reader, const CzTree *tree, const CzSetting *setting,
                               int n_setting, const char *beginning) {
    CzTree changed = *tree;
    for (int i = 0; i < n_setting; i++)
        if (strncmp(setting[i].path, beginning, strlen(beginning)) == 0)
            (void)cz_path_put(reader, &changed, setting[i].path, setting[i].place, &setting[i].put,
                              0);
    return changed;
}

CzTree cz_settings_apply(CzReader *reader, const CzTree *tree, const CzSetting *setting,
                         int n_setting) {
    CzTree changed = *tree;
    changed.part = cz_arena_allocate(&reader->arena, (size_t)tree->n_part, sizeof *changed.part);
    if (cz_node_find(tree->root, "set") != NULL)
        changed.root = cz_node_without(&reader->arena, tree->root, "set", 0);
    if (changed.part == NULL || changed.root == NULL)
        return *tree;
    if (tree->n_part > 0)
        memcpy(changed.part, tree->part, (size_t)tree->n_part * sizeof *changed.part);
    int *scratch = cz_arena_allocate(&reader->arena, 2 * (size_t)n_setting, sizeof *scratch);
    if (scratch == NULL)
        return *tree;
    apply(reader, &changed, setting, n_setting, scratch, scratch + n_setting);
    return changed;
}

void cz_settings_apply_late(CzReader *reader, CzTree *tree, const CzSetting *setting,
                            int n_setting) {
    for (int i = 0; i < n_setting; i++)
        if (setting[i].is_late &&
            cz_path_put(reader, tree, setting[i].path, setting[i].place, &setting[i].put, 0) == 0)
            refuse_without_place(reader, &setting[i]);
}
