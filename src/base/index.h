/* Index of names: finds the number of a text in a time that does not depend on their number.
 */
#ifndef CZ_BASE_INDEX_H
#define CZ_BASE_INDEX_H

#include "base/arena.h"

/* Open addressing, at most half full. Zero-initialise it and set the arena. Texts are borrowed. */
typedef struct CzIndex {
    CzArena *arena;
    int n_entry, n_slot;
    struct CzIndexSlot *slot; /* (n_slot) */
} CzIndex;

/* Number of the n bytes of a text; -1 when the index does not have it. */
int cz_index_find(const CzIndex *index, const char *text, size_t n);

/* Adds a text of n bytes that is not there yet. False without memory. */
bool cz_index_add(CzIndex *index, const char *text, size_t n, int number);

#endif
