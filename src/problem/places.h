/* Places of records and their values in the files, found by address. */
#ifndef CZ_PROBLEM_PLACES_H
#define CZ_PROBLEM_PLACES_H

#include <stdint.h>

#include "text/node.h"
#include "tree/record.h"

/* Place in a file of a record or one of its values. */
typedef struct CzPlace {
    const void *address; /* of the record or field in the input */
    size_t size;         /* of a record [byte]; 0 for a field */
    const CzNode *node;  /* key of a field, mapping of a record */
    const CzNode *value; /* value of a field */
    const CzTrail *trail;
    const CzKey *key; /* of a field */
    const CzUnit *unit;
} CzPlace;

/* The memory of a place, from start to before end, and the record around it: -1 for none. */
typedef struct CzPlaced {
    uintptr_t start, end;
    int place, around;
} CzPlaced;

/* Zero-initialise it and set the arena. */
typedef struct CzPlaces {
    CzArena *arena; /* its out_of_memory is set when memory is short */
    int n_place, n_allocated;
    CzPlace *place;
    int n_placed; /* by address, as of the last cz_places_sort */
    CzPlaced *placed;
} CzPlaces;

void cz_places_add(CzPlaces *places, CzPlace place);

/* Sorts added places for cz_places_find; reading a record does so at its end. */
void cz_places_sort(CzPlaces *places);

void cz_places_free(CzPlaces *places);

/* Place of a field, or of the innermost record around it; NULL when it is not in the input. */
const CzPlace *cz_places_find(const CzPlaces *places, const void *field);

#endif
