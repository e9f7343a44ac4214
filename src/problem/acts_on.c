/* Which keys act on which models of vehicles. */
#include "problem/acts_on.h"

#include <stdio.h>
#include <string.h>

typedef enum { FULL, MOVING } Models;

static const struct {
    CzRecordId record;
    const char *stem;
    Models models;
} restricted[] = {
#define CZ_ACTS_ON(type, stem, models) {CZ_RECORD_##type, #stem, models},
#include "problem/acts_on.def"
#undef CZ_ACTS_ON
};
enum { N_RESTRICTED = sizeof restricted / sizeof restricted[0], LONGEST_LIST = 320 };

bool cz_key_acts_on(const CzKey *key, CzVehicleModel model) {
    for (int i = 0; i < N_RESTRICTED && model != CZ_MODEL_FULL; i++) {
        const CzRecord *record = &cz_records[restricted[i].record];
        const bool is_of_record = key >= record->key && key < record->key + record->n_key;
        if (is_of_record && strcmp(key->stem, restricted[i].stem) == 0)
            return model == CZ_MODEL_RIGID && restricted[i].models == MOVING;
    }
    return true;
}

void cz_acts_on_write(FILE *stream, const CzKey *key) {
    if (!cz_key_acts_on(key, CZ_MODEL_RIGID))
        fputs("; of full vehicles only", stream);
    else if (!cz_key_acts_on(key, CZ_MODEL_FIXED))
        fputs("; not of fixed vehicles", stream);
}

const CzVehicle *cz_vehicle_of(const CzProblem *problem, const void *address) {
    const uintptr_t at = (uintptr_t)address, start = (uintptr_t)problem->vehicle;
    const size_t n_byte = (size_t)problem->n_vehicle * sizeof(CzVehicle);
    return at >= start && at - start < n_byte ? &problem->vehicle[(at - start) / sizeof(CzVehicle)]
                                              : NULL;
}

bool cz_field_acts(const CzProblem *problem, const CzKey *key, const void *field) {
    const CzVehicle *vehicle = cz_vehicle_of(problem, field);
    return vehicle == NULL || !vehicle->given ||
           cz_key_acts_on(key, (CzVehicleModel)vehicle->model);
}

/* Start of the record that holds a written field which does nothing; NULL for any other place. */
static const char *idle_record(const CzProblem *problem, const CzPlace *place) {
    if (place->size != 0 || place->key == NULL ||
        cz_field_acts(problem, place->key, place->address))
        return NULL;
    return (const char *)place->address - place->key->offset;
}

/* One warning for the fields of one record, at the first of them. A vehicle's places are together,
 * up to `end`. */
static void warn(CzProblem *problem, int first, int end) {
    CzReader *reader = &problem->reader;
    const CzPlace *place = problem->places.place;
    const char *record = idle_record(problem, &place[first]);
    char list[LONGEST_LIST] = "";
    for (int i = first; i < end; i++) {
        const size_t n = strlen(list);
        if (idle_record(problem, &place[i]) == record)
            snprintf(list + n, sizeof list - n, "%s%s", n > 0 ? ", " : "", place[i].key->stem);
    }
    const int model = cz_vehicle_of(problem, record)->model;
    cz_mistake(&reader->warnings, place[first].node, place[first].trail,
               "no effect on model: %s: %s", cz_word_sets[CZ_WORDS_MODEL].word[model].word, list);
}

/* Warns of the places of one vehicle. */
static void check_vehicle(CzProblem *problem, int begin, int end) {
    const CzPlace *place = problem->places.place;
    for (int i = begin; i < end; i++) {
        const char *record = idle_record(problem, &place[i]);
        bool is_first = record != NULL;
        for (int k = begin; k < i && is_first; k++)
            is_first = idle_record(problem, &place[k]) != record;
        if (is_first)
            warn(problem, i, end);
    }
}

void cz_acts_on_check(CzProblem *problem) {
    const CzPlaces *places = &problem->places;
    int begin = 0;
    while (begin < places->n_place) {
        const CzVehicle *vehicle = cz_vehicle_of(problem, places->place[begin].address);
        int end = begin + 1;
        while (end < places->n_place &&
               cz_vehicle_of(problem, places->place[end].address) == vehicle)
            end++;
        if (vehicle != NULL && vehicle->given && vehicle->model != CZ_MODEL_FULL)
            check_vehicle(problem, begin, end);
        begin = end;
    }
}
