/* Combines files to one tree: the base files of `extends`, the parts of `catalogue`. */
#include "tree/load.h"

#include <stdlib.h>
#include <string.h>

#include "base/suggest.h"
#include "base/text.h"
#include "crushzone/names.h"
#include "text/yaml.h"
#include "tree/merge.h"
#include "tree/trains.h"

enum { DEEPEST_CHAIN = 16 };

typedef struct {
    CzReader *reader;
    CzTree tree;            /* so far without root: all parts of catalogues */
    const char *loaded[64]; /* paths of the catalogues read */
    int n_loaded;
} Loader;

const CzNode *cz_load_file(CzReader *reader, const char *path, const CzNode *place) {
    char *text = NULL;
    size_t n_byte = 0;
    const CzSource *source =
        cz_sources_read(&reader->sources, &reader->mistakes, path, place, &text, &n_byte);
    const CzNode *top = NULL;
    if (source != NULL && cz_source_is_text(&reader->mistakes, source, text, n_byte))
        top = cz_yaml_document(&reader->mistakes, source, text, n_byte);
    free(text);
    return top;
}

const char *cz_load_locate(CzReader *reader, const char *name, const CzNode *place,
                           const char *subfolder) {
    const char *beside = cz_path_join(&reader->arena, place->source->folder, name);
    const char *in_share = NULL, *in_subfolder = NULL;
    if (reader->share_folder != NULL) {
        in_share = cz_path_join(&reader->arena, reader->share_folder, name);
        if (subfolder != NULL)
            in_subfolder = cz_path_join(&reader->arena, reader->share_folder, subfolder);
        if (in_subfolder != NULL)
            in_subfolder = cz_path_join(&reader->arena, in_subfolder, name);
    }
    const char *const candidates[] = {beside, in_subfolder, in_share};
    for (int i = 0; i < 3; i++)
        if (candidates[i] != NULL && cz_path_exists(candidates[i]))
            return candidates[i];
    const bool is_searched = in_share != NULL && name[0] != '/';
    cz_mistake(&reader->mistakes, place, NULL, "there is no file '%s'" CZ_HELP "%s%s%s", beside,
               is_searched ? "searched for beside the file that names it and in '" : "",
               is_searched ? reader->share_folder : "", is_searched ? "'" : "");
    return NULL;
}

/* ---- parts ---- */

static void add_part(Loader *loader, const CzEntry *entry) {
    const char *name = entry->key->text;
    CzTree *tree = &loader->tree;
    CzPart *part = cz_arena_grow(&loader->reader->arena, tree->part, tree->n_part, sizeof *part);
    if (part == NULL)
        return;
    tree->part = part;
    if (cz_index_add(&tree->by_name, name, strlen(name), tree->n_part))
        part[tree->n_part++] = (CzPart){name, entry->key, entry->value, 0};
}

static bool is_part(CzReader *reader, const CzEntry *entry) {
    if (strlen(entry->key->text) > CZ_MAX_LABEL)
        cz_mistake(&reader->mistakes, entry->key, NULL, "the name of a part has more than %d bytes",
                   (int)CZ_MAX_LABEL);
    if (entry->value->kind == CZ_NODE_MAPPING)
        return true;
    cz_mistake(&reader->mistakes, entry->value, NULL, "part '%s' must be a mapping, but this is %s",
               entry->key->text, cz_node_what(entry->value));
    return false;
}

/* Parts of a catalogue; a name may be in one catalogue only. */
static void gather_catalogue_parts(Loader *loader, const CzNode *parts) {
    for (int i = 0; i < parts->n_entry; i++) {
        const CzEntry *entry = &parts->entry[i];
        const CzPart *first =
            cz_tree_part(&loader->tree, entry->key->text, strlen(entry->key->text));
        if (first != NULL)
            cz_mistake(&loader->reader->mistakes, entry->key, NULL,
                       "part '%s' is in another catalogue too (%s:%d)", entry->key->text,
                       first->written->source->name, first->written->line);
        else if (is_part(loader->reader, entry))
            add_part(loader, entry);
    }
}

/* Parts of the problem file itself, merged over those of catalogues. */
static void gather_own_parts(Loader *loader, const CzNode *parts) {
    for (int i = 0; i < parts->n_entry; i++) {
        const CzEntry *entry = &parts->entry[i];
        CzPart *first = cz_tree_part(&loader->tree, entry->key->text, strlen(entry->key->text));
        if (!is_part(loader->reader, entry))
            continue;
        if (first == NULL) {
            add_part(loader, entry);
            continue;
        }
        const CzNode *merged =
            cz_merge(&loader->reader->arena, first->node, NULL, entry->value, NULL, false);
        if (merged != NULL)
            *first = (CzPart){first->name, entry->key, merged, 0};
    }
}

/* ---- catalogues ---- */

static void check_catalogue_keys(CzReader *reader, const CzNode *top) {
    static const char *const known[] = {"schema", "title", "catalogue", "parts"};
    for (int i = 0; i < top->n_entry; i++) {
        CzSuggestion suggestion = {0};
        if (CZ_FIND_TEXT(top->entry[i].key->text, known, 4, &suggestion) >= 0)
            continue;
        cz_mistake(&reader->mistakes, top->entry[i].key, NULL, "unknown key '%s' in a catalogue",
                   top->entry[i].key->text);
        cz_mistake_suggest(&reader->mistakes, &suggestion);
    }
}

static const CzNode *expect(CzReader *reader, const CzNode *top, const char *key, CzNodeKind kind) {
    const CzEntry *entry = cz_node_find(top, key);
    if (entry == NULL || entry->value->kind == kind)
        return entry != NULL ? entry->value : NULL;
    cz_mistake(&reader->mistakes, entry->value, NULL, "'%s' needs %s, but this is %s", key,
               kind == CZ_NODE_LIST ? "a list" : "a mapping", cz_node_what(entry->value));
    return NULL;
}

static void load_catalogues(Loader *loader, const CzNode *top);

static void load_catalogue(Loader *loader, const CzNode *named) {
    CzReader *reader = loader->reader;
    const char *name = cz_value_text(cz_reader_value(reader, "catalogue", named, NULL));
    const char *path = name != NULL ? cz_load_locate(reader, name, named, "catalogue") : NULL;
    loader->tree.lacks_parts |= path == NULL;
    if (path == NULL || cz_text_is_among(path, loader->n_loaded, loader->loaded))
        return;
    if (loader->n_loaded == (int)(sizeof loader->loaded / sizeof loader->loaded[0])) {
        cz_mistake(&reader->mistakes, named, NULL, "more than %d catalogues are named",
                   loader->n_loaded);
        return;
    }
    loader->loaded[loader->n_loaded++] = path;
    const CzNode *top = cz_load_file(reader, path, named);
    loader->tree.lacks_parts |= top == NULL;
    if (top == NULL)
        return;
    for (CzSource *source = reader->sources.first; source != NULL; source = source->next)
        source->is_general |= source == top->source;
    check_catalogue_keys(reader, top);
    load_catalogues(loader, top);
    const CzNode *parts = expect(reader, top, "parts", CZ_NODE_MAPPING);
    if (parts != NULL)
        gather_catalogue_parts(loader, parts);
}

static void load_catalogues(Loader *loader, const CzNode *top) {
    const CzNode *list = expect(loader->reader, top, "catalogue", CZ_NODE_LIST);
    for (int i = 0; list != NULL && i < list->n_entry; i++)
        load_catalogue(loader, list->entry[i].value);
}

/* ---- base files ---- */

/* The file merged over its base files; `chain` contains the paths of the files that led to it. */
static const CzNode *load_bases(Loader *loader, const CzNode *top, const char **chain,
                                int n_chain) {
    CzReader *reader = loader->reader;
    const CzEntry *extends = cz_node_find(top, "extends");
    const char *name = extends != NULL
                           ? cz_value_text(cz_reader_value(reader, "extends", extends->value, NULL))
                           : NULL;
    const char *path = name != NULL ? cz_load_locate(reader, name, extends->value, NULL) : NULL;
    for (int i = 0; path != NULL && i < n_chain; i++)
        if (strcmp(chain[i], path) == 0) {
            cz_mistake(&reader->mistakes, extends->value, NULL, "'%s' extends itself", path);
            path = NULL;
        }
    if (path != NULL && n_chain == DEEPEST_CHAIN) {
        cz_mistake(&reader->mistakes, extends->value, NULL, "more than %d files extend one another",
                   n_chain);
        path = NULL;
    }
    const CzNode *base = NULL;
    if (path != NULL) {
        chain[n_chain] = path;
        base = cz_load_file(reader, path, extends->value);
    }
    if (base != NULL)
        base = load_bases(loader, base, chain, n_chain + 1);
    load_catalogues(loader, top);
    if (extends != NULL && base == NULL)
        return NULL;
    if (extends == NULL)
        return top;
    base = cz_trains_name_vehicles(&reader->arena, base);
    return base != NULL ? cz_merge(&reader->arena, base, NULL, top, NULL, true) : NULL;
}

CzTree cz_load_parts(CzReader *reader, const CzNode *top) {
    Loader loader = {.reader = reader, .tree.by_name.arena = &reader->arena};
    load_catalogues(&loader, top);
    cz_parts_measure(reader, &loader.tree);
    return loader.tree;
}

CzTree cz_load_tree(CzReader *reader, const CzNode *top) {
    Loader loader = {.reader = reader, .tree.by_name.arena = &reader->arena};
    const char *chain[DEEPEST_CHAIN + 1] = {top->source->name};
    const CzNode *root = load_bases(&loader, top, chain, 1);
    const CzNode *parts = root != NULL ? expect(reader, root, "parts", CZ_NODE_MAPPING) : NULL;
    if (parts != NULL)
        gather_own_parts(&loader, parts);
    if (root != NULL)
        root = cz_node_without(&reader->arena, root, "extends catalogue parts", 0);
    loader.tree.root = root;
    cz_parts_measure(reader, &loader.tree);
    return loader.tree;
}
