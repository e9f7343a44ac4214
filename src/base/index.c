/* Index of names: a hash table with open addressing. */
#include "base/index.h"

#include <stdint.h>
#include <string.h>

enum { MIN_SLOTS = 16 };

typedef struct CzIndexSlot {
    const char *text; /* NULL: empty */
    size_t n;
    int number;
} CzIndexSlot;

/* FNV-1a. */
static uint64_t hash_of(const char *text, size_t n) {
    uint64_t hash = UINT64_C(14695981039346656037);
    for (size_t i = 0; i < n; i++)
        hash = (hash ^ (unsigned char)text[i]) * UINT64_C(1099511628211);
    return hash ^ (hash >> 32);
}

/* The slot of a text, or the empty one where it belongs. The number of slots is a power of two. */
static CzIndexSlot *slot_of(const CzIndex *index, const char *text, size_t n) {
    const size_t last = (size_t)index->n_slot - 1;
    size_t at = (size_t)hash_of(text, n) & last;
    while (index->slot[at].text != NULL &&
           (index->slot[at].n != n || memcmp(index->slot[at].text, text, n) != 0))
        at = (at + 1) & last;
    return &index->slot[at];
}

int cz_index_find(const CzIndex *index, const char *text, size_t n) {
    if (index->n_entry == 0)
        return -1;
    const CzIndexSlot *slot = slot_of(index, text, n);
    return slot->text != NULL ? slot->number : -1;
}

static bool grow(CzIndex *index) {
    const CzIndex old = *index;
    const int n_slot = old.n_slot > 0 ? 2 * old.n_slot : MIN_SLOTS;
    CzIndexSlot *slot = cz_arena_allocate(old.arena, (size_t)n_slot, sizeof *slot);
    if (slot == NULL)
        return false;
    index->slot = slot;
    index->n_slot = n_slot;
    for (int i = 0; i < old.n_slot; i++)
        if (old.slot[i].text != NULL)
            *slot_of(index, old.slot[i].text, old.slot[i].n) = old.slot[i];
    return true;
}

bool cz_index_add(CzIndex *index, const char *text, size_t n, int number) {
    if (2 * (index->n_entry + 1) > index->n_slot && !grow(index))
        return false;
    *slot_of(index, text, n) = (CzIndexSlot){text, n, number};
    index->n_entry++;
    return true;
}
