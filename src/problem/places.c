/* Places sorted by address, each with the record around it. */
#include "problem/places.h"

#include <stdlib.h>

/* Outer before inner, records before fields; several places of one field stay in their order. */
static int compare_places(const void *a, const void *b) {
    const CzPlaced *first = a, *second = b;
    if (first->start != second->start)
        return first->start < second->start ? -1 : 1;
    if (first->end != second->end)
        return first->end > second->end ? -1 : 1;
    return first->place - second->place;
}

void cz_places_sort(CzPlaces *places) {
    const int n = places->n_place;
    CzPlaced *placed = realloc(places->placed, ((size_t)n + 1) * sizeof *placed);
    if (placed == NULL) {
        places->arena->out_of_memory = true;
        return;
    }
    for (int i = 0; i < n; i++) {
        const uintptr_t start = (uintptr_t)places->place[i].address;
        placed[i] = (CzPlaced){start, start + places->place[i].size, i, -1};
    }
    qsort(placed, (size_t)n, sizeof *placed, compare_places);
    for (int i = 0, around = -1; i < n; i++) {
        while (around >= 0 && placed[around].end <= placed[i].start)
            around = placed[around].around;
        placed[i].around = around;
        around = placed[i].end > placed[i].start ? i : around;
    }
    places->placed = placed;
    places->n_placed = n;
}

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
    places->place[places->n_place++] = place;
}

const CzPlace *cz_places_find(const CzPlaces *places, const void *field) {
    const uintptr_t at = (uintptr_t)field;
    const CzPlaced *placed = places->placed;
    int low = 0, high = places->n_placed;
    while (low < high) { /* first place after the address, or field at it */
        const int middle = low + (high - low) / 2;
        const bool is_before =
            placed[middle].start < at || (placed[middle].start == at && placed[middle].end > at);
        low = is_before ? middle + 1 : low;
        high = is_before ? high : middle;
    }
    if (low < places->n_placed && placed[low].start == at)
        return &places->place[placed[low].place];
    int i = low - 1; /* else the innermost record around it */
    while (i >= 0 && placed[i].end <= at)
        i = placed[i].around;
    return i >= 0 ? &places->place[placed[i].place] : NULL;
}

void cz_places_free(CzPlaces *places) {
    free(places->place);
    free(places->placed);
}
