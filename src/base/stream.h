/* Reads streams whole. */
#ifndef CZ_BASE_STREAM_H
#define CZ_BASE_STREAM_H

#include <stddef.h>
#include <stdio.h>

/* Reads a stream to its end, or a little beyond `most` bytes, into a text to be freed that ends in
 * a zero; *n_byte is its length without it. NULL without memory. */
char *cz_stream_read(FILE *stream, size_t most, size_t *n_byte);

#endif
