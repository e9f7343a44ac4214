/* Text that grows in memory, and a stream into it.
 *
 * open_memstream drops output for which there is no memory, and neither the stream nor closing it
 * reports that. Here a failure is stored.
 */
#ifndef CZ_BASE_MEMORY_TEXT_H
#define CZ_BASE_MEMORY_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Zero-initialise it. */
typedef struct CzMemoryText {
    char *text;  /* ended by a zero; NULL until text is added or a stream is opened */
    size_t n;    /* [byte] */
    size_t room; /* [byte] */
    bool failed; /* part of the text is missing */
} CzMemoryText;

/* Appends n bytes; false without memory. */
bool cz_memory_text_add(CzMemoryText *memory, const char *bytes, size_t n);

/* A stream into the text, which must outlive it; NULL without memory. The text is complete after
 * fflush or fclose. */
FILE *cz_memory_text_open(CzMemoryText *memory);

void cz_memory_text_free(CzMemoryText *memory);

#endif
