/* Files as text: reading with limits, lines for messages, a hash over all that was read. */
#ifndef CZ_TEXT_SOURCE_H
#define CZ_TEXT_SOURCE_H

#include <stdint.h>

#include "text/mistakes.h"

enum { CZ_MAX_BYTES = 16 * 1024 * 1024 }; /* of one file */

/* All sources of a problem. Zero-initialise it and set arena and hash. */
typedef struct CzSources {
    CzArena *arena;
    CzSource *first, *last;
    int n_source;
    uint64_t hash; /* FNV-1a over names and bytes of all that was read; begin with CZ_HASH_START */
} CzSources;

#define CZ_HASH_START UINT64_C(14695981039346656037)

/* Adds bytes and a separator to the hash. */
void cz_sources_hash(CzSources *sources, const char *bytes, size_t n_byte);

/* Adds a text as a source. NULL without memory. */
CzSource *cz_sources_add(CzSources *sources, const char *name, const char *folder, const char *text,
                         size_t n_byte);

/* Reads a file ("-" is standard input) and adds it. *text is allocated with malloc and freed by the
 * caller. When it cannot be read, a mistake is added at `place` (NULL: at the file itself), *text
 * is NULL, and so is the result. */
CzSource *cz_sources_read(CzSources *sources, CzMistakes *mistakes, const char *path,
                          const CzNode *place, char **text, size_t *n_byte);

/* Splits a text into the lines of a source; the text ends in a zero and is cut in place; with
 * `is_yaml` at all line ends of YAML, else at LF, CR and both. False without memory. */
bool cz_source_cut(CzArena *arena, CzSource *source, char *text, size_t n_byte, bool is_yaml);

/* Bytes of the byte order mark that some editors put before UTF-8 text; 0 when there is none. */
size_t cz_source_mark(const char *text, size_t n_byte);

/* Whether the bytes are UTF-8. */
bool cz_source_is_utf8(const char *text, size_t n_byte);

/* Whether a file, comments included, has only characters allowed in texts (base/text.h); otherwise
 * adds a mistake at the first other one. */
bool cz_source_is_text(CzMistakes *mistakes, const CzSource *source, const char *text,
                       size_t n_byte);

/* Path of a file that another file names: relative to `folder` unless it begins with '/'. NULL
 * without memory. */
const char *cz_path_join(CzArena *arena, const char *folder, const char *path);

/* Whether a path exists. */
bool cz_path_exists(const char *path);

#endif
