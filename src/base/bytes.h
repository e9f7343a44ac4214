/* Values as bytes for another process of the same program, and back.
 *
 * Bytes are appended to a CzMemoryText, whose flag `failed` reports lack of memory. Numbers have
 * the layout of the machine.
 */
#ifndef CZ_BASE_BYTES_H
#define CZ_BASE_BYTES_H

#include "base/arena.h"
#include "base/memory_text.h"

/* Appends n items of a size. */
void cz_put(CzMemoryText *bytes, const void *item, size_t n, size_t size);
void cz_put_int(CzMemoryText *bytes, int value);
void cz_put_numbers(CzMemoryText *bytes, const double *number, size_t n);
void cz_put_text(CzMemoryText *bytes, const char *text); /* NULL is allowed */

/* Bytes that are read from their beginning. Borrowed. */
typedef struct CzReading {
    const char *next;
    size_t n_left;  /* [byte] */
    bool has_ended; /* more was asked for than there is, or no memory: those values are 0 */
} CzReading;

void cz_get(CzReading *reading, void *item, size_t n, size_t size);
int cz_get_int(CzReading *reading);
void cz_get_numbers(CzReading *reading, double *number, size_t n);
/* A text in the arena; NULL where NULL was put, and without memory. */
const char *cz_get_text(CzReading *reading, CzArena *arena);
/* Texts of a list in the arena, *n of them; NULL as above. */
void cz_put_texts(CzMemoryText *bytes, int n, const char *const *text);
const char **cz_get_texts(CzReading *reading, CzArena *arena, int *n);
/* A text to be freed. */
char *cz_get_own_text(CzReading *reading);
/* n items of a size in the arena; NULL without memory, and where there are not as many. */
void *cz_get_items(CzReading *reading, CzArena *arena, int n, size_t size);

#endif
