/* Arena: a list of blocks; a block is large enough for the request that did not fit into the last
 * one. */
#include "base/arena.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { ALIGNMENT = 64, SMALLEST_BLOCK = 64 * 1024 };

typedef struct CzArenaBlock CzArenaBlock;
struct CzArenaBlock {
    CzArenaBlock *next;
    size_t used, size; /* [byte], header included */
};

static CzArenaBlock *block_create(CzArenaBlock *next, size_t payload) {
    const size_t needed = payload + ALIGNMENT;
    const size_t size = needed > SMALLEST_BLOCK ? needed : (size_t)SMALLEST_BLOCK;
    CzArenaBlock *block = aligned_alloc(ALIGNMENT, size);
    if (block == NULL)
        return NULL;
    block->next = next;
    block->used = ALIGNMENT;
    block->size = size;
    return block;
}

void *cz_arena_allocate(CzArena *arena, size_t n, size_t size) {
    if (size != 0 && n > (SIZE_MAX - 4 * ALIGNMENT) / size) {
        arena->out_of_memory = true;
        return NULL;
    }
    const size_t payload = (n * size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    if (arena->block == NULL || arena->block->size - arena->block->used < payload) {
        CzArenaBlock *block = block_create(arena->block, payload);
        if (block == NULL) {
            arena->out_of_memory = true;
            return NULL;
        }
        arena->block = block;
    }
    void *memory = (char *)arena->block + arena->block->used;
    arena->block->used += payload;
    memset(memory, 0, payload);
    return memory;
}

void *cz_arena_grow(CzArena *arena, void *items, int n, size_t size) {
    if ((n & (n - 1)) != 0)
        return items;
    void *more = cz_arena_allocate(arena, n == 0 ? 1 : 2 * (size_t)n, size);
    if (more != NULL && n > 0)
        memcpy(more, items, (size_t)n * size);
    return more;
}

char *cz_arena_copy_text(CzArena *arena, const char *text, size_t n) {
    char *copy = cz_arena_allocate(arena, n + 1, 1);
    if (copy != NULL)
        memcpy(copy, text, n);
    return copy;
}

void cz_arena_free(CzArena *arena) {
    while (arena->block != NULL) {
        CzArenaBlock *next = arena->block->next;
        free(arena->block);
        arena->block = next;
    }
}
