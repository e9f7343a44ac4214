/* Text that grows in memory. The only file that defines a stream (fopencookie, which glibc and musl
 * have). */
#define _GNU_SOURCE
#include "base/memory_text.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>

bool cz_memory_text_add(CzMemoryText *memory, const char *bytes, size_t n) {
    if (memory->n + n + 1 > memory->room) {
        const size_t room = 2 * memory->room + n + 4096;
        char *text = realloc(memory->text, room);
        if (text == NULL) {
            memory->failed = true;
            return false;
        }
        memory->text = text;
        memory->room = room;
    }
    memcpy(memory->text + memory->n, bytes, n);
    memory->n += n;
    memory->text[memory->n] = '\0';
    return true;
}

static ssize_t write_bytes(void *cookie, const char *bytes, size_t n) {
    CzMemoryText *memory = cookie;
    if (cz_memory_text_add(memory, bytes, n))
        return (ssize_t)n;
    errno = ENOMEM;
    return 0;
}

FILE *cz_memory_text_open(CzMemoryText *memory) {
    const cookie_io_functions_t functions = {.write = write_bytes};
    return cz_memory_text_add(memory, "", 0) ? fopencookie(memory, "w", functions) : NULL;
}

void cz_memory_text_free(CzMemoryText *memory) {
    free(memory->text);
    *memory = (CzMemoryText){0};
}
