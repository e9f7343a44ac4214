/* Writes trains out. */
#include "tree/trains.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/suggest.h"
#include "base/text.h"
#include "crushzone/names.h"
#include "tree/merge.h"

/* Space for the name of a copy's vehicle, made of two names. A longer name is rejected like one cut
 * to this length. */
enum { NAME_SIZE = 2 * CZ_MAX_NAME + 2, MAX_REPEATS = 200, DEEPEST_COPY = 8 };

/* One vehicle of a train. */
typedef struct {
    const CzNode *node; /* with its parts inserted */
    const CzTrail *trail;
    const CzNode *name_place;
    char name[NAME_SIZE];
    bool is_turned;
} Vehicle;

typedef struct Train {
    const CzNode *node;
    const CzTrail *trail;
    const char *name; /* NULL when it has none */
    const CzEntry *copy;
    const struct Train *original; /* whose vehicles are copied; NULL while there are none */
    bool is_refused;              /* a mistake was reported about its vehicles */
    int n_vehicle;
    Vehicle *vehicle;
} Train;

typedef struct {
    CzReader *reader;
    const CzTree *tree;
    int n_train;
    Train *train;
    int n_vehicle; /* of all trains */
} Trains;

/* ---- names ---- */

int cz_vehicle_repeat(const CzNode *vehicle) {
    const char *text = cz_node_find_text(vehicle, "repeat");
    const long n = text != NULL ? strtol(text, NULL, 10) : 1;
    return n >= 1 && n <= MAX_REPEATS ? (int)n : 1;
}

/* A name with its number increased by k; the number is the digits at its end. */
static void count_on(char *text, size_t size, const char *name, int k) {
    size_t n = strlen(name);
    while (n > 0 && name[n - 1] >= '0' && name[n - 1] <= '9' && strlen(name) - n < 6)
        n--;
    const int width = (int)(strlen(name) - n);
    const int number = width > 0 ? atoi(name + n) : 1;
    snprintf(text, size, "%.*s%0*d", (int)(n < size ? n : size - 1), name, width, number + k);
}

void cz_vehicle_name(char *text, size_t size, const CzNode *vehicle, const char *train,
                     int position, int k) {
    const char *given = cz_node_find_text(vehicle, "name");
    if (given == NULL)
        snprintf(text, size, "%s%d", train, position + k);
    else if (cz_vehicle_repeat(vehicle) > 1)
        count_on(text, size, given, k);
    else
        snprintf(text, size, "%s", given);
}

/* ---- names to which an overlay can refer ---- */

static const CzNode *name_vehicle(CzArena *arena, const CzNode *vehicle, const char *train,
                                  int position) {
    char text[NAME_SIZE];
    if (vehicle->kind != CZ_NODE_MAPPING || cz_node_find(vehicle, "name") != NULL)
        return vehicle;
    CzNode *named = cz_node_copy(arena, vehicle, 1);
    if (named == NULL)
        return NULL;
    cz_vehicle_name(text, sizeof text, vehicle, train, position, 0);
    const CzNode *name = cz_node_name(arena, text, vehicle);
    return cz_node_append(arena, named, "name", vehicle, name, NULL) ? named : NULL;
}

static const CzNode *name_vehicles(CzArena *arena, const CzNode *train) {
    const char *name = cz_node_find_text(train, "name");
    const CzEntry *vehicles = cz_node_find_list(train, "vehicles");
    if (name == NULL || vehicles == NULL)
        return train;
    CzNode *list = cz_node_copy(arena, vehicles->value, 0);
    if (list == NULL)
        return NULL;
    for (int i = 0, position = 1; i < list->n_entry; i++) {
        position += i > 0 ? cz_vehicle_repeat(list->entry[i - 1].value) : 0;
        list->entry[i].value = name_vehicle(arena, list->entry[i].value, name, position);
        if (list->entry[i].value == NULL)
            return NULL;
    }
    return cz_node_with(arena, train, vehicles, list);
}

const CzNode *cz_trains_name_vehicles(CzArena *arena, const CzNode *root) {
    const CzEntry *trains = cz_node_find_list(root, "trains");
    if (trains == NULL)
        return root;
    CzNode *list = cz_node_copy(arena, trains->value, 0);
    for (int i = 0; list != NULL && i < list->n_entry; i++) {
        list->entry[i].value = name_vehicles(arena, list->entry[i].value);
        if (list->entry[i].value == NULL)
            return NULL;
    }
    return cz_node_with(arena, root, trains, list);
}

/* ---- vehicles of one train ---- */

static bool read_reversed(CzReader *reader, const CzNode *node, const CzTrail *trail) {
    bool is_reversed = false;
    const CzEntry *entry = cz_node_find(node, "reversed");
    if (entry != NULL)
        cz_value_flag(
            cz_reader_value(reader, "reversed", entry->value, cz_entry_trail(entry, trail)),
            &is_reversed);
    return is_reversed;
}

static int read_repeat(CzReader *reader, const CzNode *node, const CzTrail *trail) {
    int n_repeat = 1;
    const CzEntry *entry = cz_node_find(node, "repeat");
    if (entry != NULL && !cz_value_count(cz_reader_value(reader, "repeat", entry->value,
                                                         cz_entry_trail(entry, trail)),
                                         1, MAX_REPEATS, &n_repeat))
        n_repeat = 1;
    return n_repeat;
}

/* Memory for the vehicles of a train; false when there are too many. */
static bool make_room(Trains *trains, Train *train, int n_vehicle, const CzNode *place) {
    if (trains->n_vehicle + n_vehicle > CZ_MAX_VEHICLES) {
        cz_mistake(&trains->reader->mistakes, place, NULL, "the trains have more than %d vehicles",
                   (int)CZ_MAX_VEHICLES);
        train->is_refused = true;
        return false;
    }
    trains->n_vehicle += n_vehicle;
    train->vehicle = cz_arena_allocate(&trains->reader->arena, (size_t)n_vehicle, sizeof(Vehicle));
    return train->vehicle != NULL;
}

static void list_vehicles(Trains *trains, Train *train, const CzEntry *list) {
    CzReader *reader = trains->reader;
    const CzTrail *list_trail = cz_entry_trail(list, train->trail);
    CzNode *taken = cz_node_copy(&reader->arena, list->value, 0);
    int n_vehicle = 0;
    for (int i = 0; taken != NULL && i < taken->n_entry; i++) {
        CzEntry *entry = &taken->entry[i];
        entry->trail = cz_entry_trail(entry, list_trail);
        entry->value = cz_take_part(reader, trains->tree, entry->value, entry->trail);
        if (entry->value == NULL)
            return;
        n_vehicle += read_repeat(reader, entry->value, entry->trail);
    }
    if (taken == NULL || !make_room(trains, train, n_vehicle, list->key))
        return;
    for (int i = 0; i < taken->n_entry; i++) {
        const CzNode *node = taken->entry[i].value;
        const bool is_turned = read_reversed(reader, node, taken->entry[i].trail);
        const int n_repeat = cz_vehicle_repeat(node), position = train->n_vehicle + 1;
        const CzEntry *named = cz_node_find(node, "name");
        for (int k = 0; k < n_repeat && train->n_vehicle < n_vehicle; k++) {
            Vehicle *vehicle = &train->vehicle[train->n_vehicle++];
            *vehicle =
                (Vehicle){.node = node, .trail = taken->entry[i].trail, .is_turned = is_turned};
            vehicle->name_place = named != NULL ? named->value : node;
            cz_vehicle_name(vehicle->name, sizeof vehicle->name, node,
                            train->name != NULL ? train->name : "", position, k);
        }
    }
}

static void turn_round(Train *train) {
    for (int i = 0, k = train->n_vehicle - 1; i < k; i++, k--) {
        const Vehicle first = train->vehicle[i];
        train->vehicle[i] = train->vehicle[k];
        train->vehicle[k] = first;
    }
    for (int i = 0; i < train->n_vehicle; i++)
        train->vehicle[i].is_turned = !train->vehicle[i].is_turned;
}

/* Names of a copy: `names` are those of the original along +x. */
static void rename_vehicles(Train *train, const Train *original) {
    const size_t n = strlen(original->name);
    bool all_lettered = true;
    for (int i = 0; i < original->n_vehicle; i++)
        all_lettered &= strncmp(original->vehicle[i].name, original->name, n) == 0;
    for (int i = 0; i < train->n_vehicle; i++) {
        Vehicle *vehicle = &train->vehicle[i];
        char own[NAME_SIZE];
        memcpy(own, vehicle->name, sizeof own);
        const char *rest = all_lettered ? original->vehicle[i].name + n : own;
        snprintf(vehicle->name, sizeof vehicle->name, "%.48s%s%.48s", train->name,
                 all_lettered ? "" : "-", rest);
    }
}

static Train *find_original(Trains *trains, const Train *train) {
    CzReader *reader = trains->reader;
    const CzTrail *trail = cz_entry_trail(train->copy, train->trail);
    const char *name = cz_value_text(cz_reader_value(reader, "copy", train->copy->value, trail));
    CzSuggestion suggestion = {0};
    for (int i = 0; name != NULL && i < trains->n_train; i++) {
        Train *other = &trains->train[i];
        if (other->name == NULL || other == train)
            continue;
        if (strcmp(other->name, name) == 0)
            return other;
        cz_suggest(&suggestion, name, other->name);
    }
    if (name != NULL && train->name != NULL && strcmp(name, train->name) == 0) {
        cz_mistake(&reader->mistakes, train->copy->value, trail, "train '%s' copies itself", name);
    } else if (name != NULL) {
        cz_mistake(&reader->mistakes, train->copy->value, trail, "there is no train '%s' to copy",
                   name);
        cz_mistake_suggest(&reader->mistakes, &suggestion);
    }
    return NULL;
}

static void write_out_train(Trains *trains, Train *train, int depth);

static void copy_vehicles(Trains *trains, Train *train, int depth) {
    const CzTrail *trail = cz_entry_trail(train->copy, train->trail);
    Train *original = find_original(trains, train);
    if (original == NULL || train->name == NULL)
        return;
    if (depth == DEEPEST_COPY) {
        cz_mistake(&trains->reader->mistakes, train->copy->value, trail,
                   "the trains copy one another in a circle");
        return;
    }
    write_out_train(trains, original, depth + 1);
    if (original->n_vehicle == 0 ||
        !make_room(trains, train, original->n_vehicle, train->copy->key))
        return;
    train->original = original;
    train->n_vehicle = original->n_vehicle;
    memcpy(train->vehicle, original->vehicle, (size_t)train->n_vehicle * sizeof(Vehicle));
}

static void write_out_train(Trains *trains, Train *train, int depth) {
    CzReader *reader = trains->reader;
    const CzEntry *list = cz_node_find(train->node, "vehicles");
    if (train->n_vehicle > 0) /* done already, for a copy */
        return;
    if (train->copy != NULL && list != NULL) {
        cz_mistake(&reader->mistakes, list->key, cz_entry_trail(list, train->trail),
                   "a train has 'vehicles' or copies another, not both");
        train->is_refused = true;
        return;
    }
    if (train->copy != NULL)
        copy_vehicles(trains, train, depth);
    else if (list != NULL && list->value->kind == CZ_NODE_LIST)
        list_vehicles(trains, train, list);
    if (read_reversed(reader, train->node, train->trail))
        turn_round(train);
    if (train->original != NULL)
        rename_vehicles(train, train->original);
}

/* ---- nodes ---- */

static const char *turned_key(const char *key) {
    if (strcmp(key, "front") == 0)
        return "rear";
    return strcmp(key, "rear") == 0 ? "front" : key;
}

/* The mapping of one vehicle: its name, then its keys, front and rear swapped when it is
 * reversed. */
static const CzNode *vehicle_node(CzReader *reader, const Vehicle *vehicle) {
    CzArena *arena = &reader->arena;
    if (vehicle->node->kind != CZ_NODE_MAPPING)
        return vehicle->node;
    CzNode *node = cz_node_copy(arena, vehicle->node, 1);
    if (node == NULL)
        return NULL;
    const CzNode *place = vehicle->name_place;
    node->n_entry = 0;
    if (!cz_node_append(arena, node, "name", place, cz_node_name(arena, vehicle->name, place),
                        vehicle->trail))
        return NULL;
    for (int i = 0; i < vehicle->node->n_entry; i++) {
        CzEntry entry = vehicle->node->entry[i];
        if (cz_text_is_word(entry.key->text, "repeat reversed name"))
            continue;
        const char *key = vehicle->is_turned ? turned_key(entry.key->text) : entry.key->text;
        if (key != entry.key->text)
            entry.key = cz_node_text(arena, key, entry.key);
        if (entry.key == NULL)
            return NULL;
        node->entry[node->n_entry++] = entry;
    }
    return node;
}

/* The list of a train's vehicles, or a node that is skipped because its mistake was reported. */
static const CzNode *vehicles_node(CzReader *reader, const Train *train, const CzNode *place) {
    CzNode *list = cz_arena_allocate(&reader->arena, 1, sizeof *list);
    CzEntry *entry = cz_arena_allocate(&reader->arena, (size_t)train->n_vehicle, sizeof *entry);
    if (list == NULL || entry == NULL)
        return NULL;
    *list = *place;
    list->kind = train->n_vehicle > 0 ? CZ_NODE_LIST : CZ_NODE_TEXT;
    list->is_refused = train->n_vehicle == 0;
    list->n_entry = train->n_vehicle;
    list->entry = entry;
    for (int i = 0; i < train->n_vehicle; i++) {
        entry[i].value = vehicle_node(reader, &train->vehicle[i]);
        entry[i].trail = train->vehicle[i].trail;
        if (entry[i].value == NULL)
            return NULL;
    }
    return list;
}

/* The mapping of one train without the keys that were written out. */
static const CzNode *train_node(CzReader *reader, const Train *train) {
    const CzEntry *own = cz_node_find(train->node, "vehicles");
    const bool is_copy = own == NULL && train->copy != NULL;
    const bool is_written_out = train->n_vehicle > 0 || train->is_refused || is_copy;
    if (train->node->kind != CZ_NODE_MAPPING)
        return train->node;
    CzNode *node = cz_node_without(&reader->arena, train->node,
                                   is_written_out ? "copy reversed vehicles" : "copy reversed", 1);
    if (node == NULL || !is_written_out)
        return node; /* a list without vehicles is reported when the records are read */
    const CzNode *place = own != NULL ? own->key : train->copy->key;
    return cz_node_append(&reader->arena, node, "vehicles", place,
                          vehicles_node(reader, train, place), train->trail)
               ? node
               : NULL;
}

const CzNode *cz_trains_write_out(CzReader *reader, const CzTree *tree) {
    const CzEntry *entry = cz_node_find_list(tree->root, "trains");
    if (entry == NULL)
        return tree->root;
    Trains trains = {.reader = reader, .tree = tree, .n_train = entry->value->n_entry};
    trains.train = cz_arena_allocate(&reader->arena, (size_t)trains.n_train, sizeof(Train));
    CzNode *list = cz_node_copy(&reader->arena, entry->value, 0);
    if (trains.train == NULL || list == NULL)
        return NULL;
    const CzTrail *list_trail = cz_entry_trail(entry, &cz_no_trail);
    for (int i = 0; i < trains.n_train; i++) {
        Train *train = &trains.train[i];
        train->trail = cz_entry_trail(&list->entry[i], list_trail);
        train->node = cz_take_part(reader, tree, list->entry[i].value, train->trail);
        if (train->node == NULL)
            return NULL;
        train->name = cz_node_find_text(train->node, "name");
        train->copy = cz_node_find(train->node, "copy");
    }
    for (int i = 0; i < trains.n_train; i++)
        write_out_train(&trains, &trains.train[i], 0);
    for (int i = 0; i < trains.n_train; i++) {
        list->entry[i].value = train_node(reader, &trains.train[i]);
        if (list->entry[i].value == NULL)
            return NULL;
    }
    return cz_node_with(&reader->arena, tree->root, entry, list);
}
