/* Reads streams whole. */
#include "base/stream.h"

#include <stdlib.h>

char *cz_stream_read(FILE *stream, size_t most, size_t *n_byte) {
    size_t size = 64 * 1024;
    char *text = malloc(size);
    *n_byte = 0;
    while (text != NULL) {
        *n_byte += fread(text + *n_byte, 1, size - *n_byte - 1, stream);
        if (*n_byte + 1 < size || *n_byte > most)
            break;
        size *= 2;
        char *larger = realloc(text, size);
        if (larger == NULL)
            free(text);
        text = larger;
    }
    if (text != NULL)
        text[*n_byte] = '\0';
    return text;
}
