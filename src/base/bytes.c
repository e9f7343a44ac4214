/* Values as bytes, and back. */
#include "base/bytes.h"

#include <stdlib.h>
#include <string.h>

void cz_put(CzMemoryText *bytes, const void *item, size_t n, size_t size) {
    if (n > 0)
        (void)cz_memory_text_add(bytes, item, n * size); /* `failed` reports it */
}

void cz_put_int(CzMemoryText *bytes, int value) {
    cz_put(bytes, &value, 1, sizeof value);
}

void cz_put_numbers(CzMemoryText *bytes, const double *number, size_t n) {
    cz_put(bytes, number, n, sizeof *number);
}

void cz_put_text(CzMemoryText *bytes, const char *text) {
    const int n = text != NULL ? (int)strlen(text) : -1;
    cz_put_int(bytes, n);
    cz_put(bytes, text, text != NULL ? (size_t)n : 0, 1);
}

void cz_get(CzReading *reading, void *item, size_t n, size_t size) {
    reading->has_ended |= n * size > reading->n_left;
    if (n == 0 || size == 0)
        return;
    if (reading->has_ended) {
        memset(item, 0, n * size);
        return;
    }
    memcpy(item, reading->next, n * size);
    reading->next += n * size;
    reading->n_left -= n * size;
}

int cz_get_int(CzReading *reading) {
    int value;
    cz_get(reading, &value, 1, sizeof value);
    return value;
}

void cz_get_numbers(CzReading *reading, double *number, size_t n) {
    cz_get(reading, number, n, sizeof *number);
}

void *cz_get_items(CzReading *reading, CzArena *arena, int n, size_t size) {
    reading->has_ended |= n < 0 || (size_t)n > reading->n_left / size;
    void *item = reading->has_ended ? NULL : cz_arena_allocate(arena, (size_t)n + 1, size);
    if (item != NULL)
        cz_get(reading, item, (size_t)n, size);
    return item;
}

char *cz_get_own_text(CzReading *reading) {
    const int n = cz_get_int(reading);
    if (n < 0)
        return NULL;
    reading->has_ended |= (size_t)n > reading->n_left;
    char *text = reading->has_ended ? NULL : calloc((size_t)n + 1, 1);
    if (text != NULL)
        cz_get(reading, text, (size_t)n, 1);
    reading->has_ended |= text == NULL;
    return text;
}

const char *cz_get_text(CzReading *reading, CzArena *arena) {
    const int n = cz_get_int(reading);
    return n < 0 ? NULL : cz_get_items(reading, arena, n, 1); /* allocated with a zero behind it */
}

void cz_put_texts(CzMemoryText *bytes, int n, const char *const *text) {
    cz_put_int(bytes, n);
    for (int i = 0; i < n; i++)
        cz_put_text(bytes, text[i]);
}

const char **cz_get_texts(CzReading *reading, CzArena *arena, int *n) {
    *n = cz_get_int(reading);
    reading->has_ended |= *n < 0 || (size_t)*n > reading->n_left;
    const char **text =
        reading->has_ended ? NULL : cz_arena_allocate(arena, (size_t)*n + 1, sizeof *text);
    for (int i = 0; text != NULL && i < *n; i++)
        text[i] = cz_get_text(reading, arena);
    return text;
}
