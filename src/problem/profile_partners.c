/* Finds or makes the trains with which scenarios of a profile collide. */
#include "problem/profile_partners.h"

#include <string.h>

#include "base/suggest.h"
#include "tree/load.h"
#include "tree/merge.h"
#include "tree/write_node.h"

/* ---- trains of the problem ---- */

/* Memory for the trains of a problem and all partners of the profile, one of them identical. */
static CzNode *make_room(CzReader *reader, const CzNode *trains, const CzNode *profile) {
    const CzEntry *partners = cz_node_find_list(profile, "partners");
    return cz_node_copy(&reader->arena, trains,
                        1 + (partners != NULL ? partners->value->n_entry : 0));
}

bool cz_partners_begin(CzReader *reader, const CzTree *tree, const CzNode *profile,
                       CzPartners *partners) {
    *partners = (CzPartners){.reader = reader, .profile = profile};
    const CzEntry *trains = cz_node_find_list(tree->root, "trains");
    if (trains == NULL || trains->value->n_entry == 0)
        return false;
    const CzTrail *trail = cz_entry_trail(trains, &cz_no_trail);
    CzNode *own = cz_node_copy(&reader->arena, trains->value, 0);
    for (int i = 0; own != NULL && i < own->n_entry; i++) {
        CzEntry *entry = &own->entry[i];
        entry->value = cz_take_part(reader, tree, entry->value, cz_entry_trail(entry, trail));
        if (entry->value == NULL)
            return false;
    }
    if (own == NULL)
        return false;
    partners->own = own;
    partners->moving = cz_node_find_text(own->entry[0].value, "name");
    partners->trains = make_room(reader, trains->value, profile);
    return partners->moving != NULL && partners->trains != NULL;
}

static const CzNode *find_train(const CzNode *list, const char *name) {
    for (int i = 0; i < list->n_entry; i++) {
        const char *known = cz_node_find_text(list->entry[i].value, "name");
        if (known != NULL && strcmp(known, name) == 0)
            return list->entry[i].value;
    }
    return NULL;
}

/* ---- the identical train ---- */

/* The problem's second train when it is a copy of the first. */
static const CzNode *own_copy(const CzPartners *partners) {
    const CzNode *second = partners->own->n_entry > 1 ? partners->own->entry[1].value : NULL;
    const char *copied = second != NULL ? cz_node_find_text(second, "copy") : NULL;
    return copied != NULL && strcmp(copied, partners->moving) == 0 ? second : NULL;
}

/* A name that no train of the problem has. */
static const char *free_name(const CzPartners *partners) {
    static const char *const names[] = {"B", "partner", "identical-train", "other"};
    enum { N_NAME = sizeof names / sizeof *names };
    for (int i = 0; i < N_NAME - 1; i++)
        if (find_train(partners->own, names[i]) == NULL)
            return names[i];
    return names[N_NAME - 1];
}

static bool put(const CzNodeWriter *writer, CzNode *mapping, const char *key, const char *value) {
    return cz_write_entry(writer, mapping, key, cz_node_text(writer->arena, value, &writer->place));
}

/* A copy of the moving train that faces it and stands; its scenarios set the brake. */
static const CzNode *make_copy(CzPartners *partners, const CzNode *place) {
    const CzNodeWriter writer = {.arena = &partners->reader->arena, .place = *place};
    CzNode *brake = cz_write_node(&writer, CZ_NODE_MAPPING, 2);
    CzNode *train = cz_write_node(&writer, CZ_NODE_MAPPING, 5);
    if (!put(&writer, brake, "ratio", "0") || !put(&writer, brake, "axle_share", "1") ||
        !put(&writer, train, "name", free_name(partners)) ||
        !put(&writer, train, "copy", partners->moving) ||
        !put(&writer, train, "reversed", "true") || !put(&writer, train, "speed_m_s", "0") ||
        !cz_write_entry(&writer, train, "brake", brake))
        return NULL;
    cz_write_item(partners->trains, train);
    return train;
}

static const CzNode *take_identical(CzPartners *partners, const CzNode *place) {
    const CzNode *train = partners->identical != NULL
                              ? find_train(partners->trains, partners->identical)
                              : own_copy(partners);
    if (train == NULL)
        train = make_copy(partners, place);
    partners->identical = train != NULL ? cz_node_find_text(train, "name") : NULL;
    return partners->identical != NULL ? train : NULL;
}

/* ---- partners of the profile ---- */

static const CzNode *report_none(const CzPartners *partners, const CzNode *list,
                                 const CzNode *named) {
    CzMistakes *mistakes = &partners->reader->mistakes;
    CzSuggestion nearest = {0};
    cz_suggest(&nearest, named->text, "identical");
    for (int i = 0; list != NULL && i < list->n_entry; i++) {
        const char *known = cz_node_find_text(list->entry[i].value, "name");
        if (known != NULL)
            cz_suggest(&nearest, named->text, known);
    }
    cz_mistake(mistakes, named, NULL, "the profile has no partner '%.48s'", named->text);
    cz_mistake_suggest(mistakes, &nearest);
    return NULL;
}

const CzNode *cz_partners_take(CzPartners *partners, const CzNode *named) {
    CzReader *reader = partners->reader;
    if (strcmp(named->text, "identical") == 0)
        return take_identical(partners, named);
    const CzNode *train = find_train(partners->own, named->text);
    if (train == NULL)
        train = find_train(partners->trains, named->text);
    if (train != NULL)
        return train;
    const CzEntry *list = cz_node_find_list(partners->profile, "partners");
    train = list != NULL ? find_train(list->value, named->text) : NULL;
    if (train == NULL)
        return report_none(partners, list != NULL ? list->value : NULL, named);
    if (!partners->has_parts)
        partners->parts = cz_load_parts(reader, partners->profile);
    partners->has_parts = true;
    train = cz_parts_write_out(reader, &partners->parts, train, &cz_no_trail);
    cz_write_item(partners->trains, train);
    return train;
}
