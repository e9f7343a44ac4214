/* Writes nodes of a tree that no file has. */
#include "tree/write_node.h"

#include "base/number.h"
#include "tree/merge.h"

CzNodeWriter cz_node_writer(CzReader *reader, const char *name) {
    const CzSource *source = cz_sources_add(&reader->sources, name, ".", "", 0);
    return (CzNodeWriter){.arena = &reader->arena,
                          .place = {.source = source, .line = 1, .column = 1}};
}

CzNode *cz_write_node(const CzNodeWriter *writer, CzNodeKind kind, int room) {
    const CzNode *place = &writer->place;
    CzNode *node = cz_arena_allocate(writer->arena, 1, sizeof *node);
    CzEntry *entry = cz_arena_allocate(writer->arena, (size_t)room + 1, sizeof *entry);
    if (node == NULL || entry == NULL)
        return NULL;
    *node = (CzNode){.kind = kind,
                     .source = place->source,
                     .line = place->line,
                     .column = place->column,
                     .entry = entry};
    return node;
}

const CzNode *cz_write_name(const CzNodeWriter *writer, const char *name) {
    return cz_node_name(writer->arena, name, &writer->place);
}

const CzNode *cz_write_number(const CzNodeWriter *writer, double number) {
    char digits[CZ_NUMBER_TEXT];
    return cz_node_text(writer->arena, cz_number_print(digits, number), &writer->place);
}

bool cz_write_entry(const CzNodeWriter *writer, CzNode *mapping, const char *key,
                    const CzNode *value) {
    return mapping != NULL &&
           cz_node_append(writer->arena, mapping, key, &writer->place, value, &cz_no_trail);
}

bool cz_write_item(CzNode *list, const CzNode *item) {
    if (item == NULL)
        return false;
    list->entry[list->n_entry++] = (CzEntry){.value = item, .trail = &cz_no_trail};
    return true;
}
