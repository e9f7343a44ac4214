/* Arena: many allocations, one free. */
#ifndef CZ_BASE_ARENA_H
#define CZ_BASE_ARENA_H

#include <stdbool.h>
#include <stddef.h>

/* Zero-initialise it before use. */
typedef struct CzArena {
    struct CzArenaBlock *block; /* newest block, NULL when empty */
    bool out_of_memory;         /* a request has failed */
} CzArena;

/* Zeroed memory for n items, aligned to 64 bytes; NULL when there is none. */
void *cz_arena_allocate(CzArena *arena, size_t n, size_t size);

/* Zeroed memory for n numbers; NULL when there is none. */
static inline double *cz_arena_numbers(CzArena *arena, size_t n) {
    return cz_arena_allocate(arena, n, sizeof(double));
}

/* An array with space for one more than its n items, which may have moved. It doubles at powers of
 * two, so all n items must have been added by this function. NULL when there is no memory. */
void *cz_arena_grow(CzArena *arena, void *items, int n, size_t size);

/* Copy of a text of n bytes, ended by a zero; NULL when there is no memory. */
char *cz_arena_copy_text(CzArena *arena, const char *text, size_t n);

/* Frees everything; valid for an empty and for a half-filled arena. */
void cz_arena_free(CzArena *arena);

#endif
