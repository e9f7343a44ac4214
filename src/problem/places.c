/* Places of fields in a hash table, those of records sorted by address. */
#include "problem/places.h"

#include <stdlib.h>

enum { FEWEST_SLOTS = 1024 };

/* ---- fields: a hash table ---- */

/* The slot of a field's address, or the empty one (-1) where it belongs. The number of slots is a
 * power of two. */
static int *slot_of(const CzPlaces *places, const void *address) {
    const size_t last = (size_t)places->n_slot - 1;
    const uint64_t hash = (uint64_t)(uintptr_t)address * UINT64_C(0x9e3779b97f4a7c15);
    size_t at = (size_t)(hash >> 32) & last;
    while (places->slot[at] >= 0 && places->place[places->slot[at]].address != address)
        at = (at + 1) & last;
    return &places->slot[at];
}

/* Of several places with one address the first is found. */
static void enter(CzPlaces *places, int index) {
    int *slot = slot_of(places, places->place[index].address);
    if (*slot < 0)
        *slot = index;
}

static bool grow_slots(CzPlaces *places) {
    const int n_slot = places->n_slot > 0 ? 2 * places->n_slot : FEWEST_SLOTS;
    int *slot = malloc((size_t)n_slot * sizeof *slot);
    if (slot == NULL)
        return false;
    free(places->slot);
    places->slot = slot;
    places->n_slot = n_slot;
    for (int i = 0; i < n_slot; i++)
        slot[i] = -1;
    for (int i = 0; i < places->n_place; i++)
        if (places->place[i].size == 0)
            enter(places, i);
    return true;
}

/* ---- records: sorted by address, each with the one around it ---- */

static int compare_records(const void *a, const void *b) {
    const CzPlacedRecord *first = a, *second = b;
    if (first->start != second->start)
        return first->start < second->start ? -1 : 1;
    if (first->end != second->end)
        return first->end > second->end ? -1 : 1;
    return first->place - second->place;
}

void cz_places_sort(CzPlaces *places) {
    int n_record = 0;
    for (int i = 0; i < places->n_place; i++)
        n_record += places->place[i].size > 0;
    CzPlacedRecord *record = malloc(((size_t)n_record + 1) * sizeof *record);
    if (record == NULL) {
        places->arena->out_of_memory = true;
        return;
    }
    free(places->record);
    places->record = record;
    places->n_record = 0;
    for (int i = 0; i < places->n_place; i++) {
        const uintptr_t start = (uintptr_t)places->place[i].address;
        if (places->place[i].size > 0)
            record[places->n_record++] =
                (CzPlacedRecord){start, start + places->place[i].size, i, -1};
    }
    qsort(record, (size_t)n_record, sizeof *record, compare_records);
    for (int i = 0, around = -1; i < n_record; around = i++) {
        while (around >= 0 && record[around].end <= record[i].start)
            around = record[around].around;
        record[i].around = around;
    }
}

/* The innermost record about an address; NULL when there is none. */
static const CzPlace *innermost(const CzPlaces *places, uintptr_t at) {
    int low = 0, high = places->n_record;
    while (low < high) { /* the last record that begins at or before the address is low - 1 */
        const int middle = low + (high - low) / 2;
        if (places->record[middle].start <= at)
            low = middle + 1;
        else
            high = middle;
    }
    int i = low - 1;
    while (i >= 0 && places->record[i].end <= at)
        i = places->record[i].around;
    return i >= 0 ? &places->place[places->record[i].place] : NULL;
}

/* ---- both ---- */

void cz_places_add(CzPlaces *places, CzPlace place) {
    if (places->n_place == places->n_allocated) {
        const int n = places->n_allocated > 0 ? 2 * places->n_allocated : 1024;
        CzPlace *larger = realloc(places->place, (size_t)n * sizeof *larger);
        if (larger == NULL) {
            places->arena->out_of_memory = true;
            return;
        }
        places->place = larger;
        places->n_allocated = n;
    }
    if (2 * (places->n_place + 1) > places->n_slot && !grow_slots(places)) {
        places->arena->out_of_memory = true;
        return;
    }
    places->place[places->n_place++] = place;
    if (place.size == 0)
        enter(places, places->n_place - 1);
}

const CzPlace *cz_places_find(const CzPlaces *places, const void *field) {
    if (places->n_place == 0)
        return NULL;
    const int at = *slot_of(places, field);
    return at >= 0 ? &places->place[at] : innermost(places, (uintptr_t)field);
}

void cz_places_free(CzPlaces *places) {
    free(places->place);
    free(places->slot);
    free(places->record);
}
