/* Did-you-mean: the known word that is nearest to a mistyped one. */
#ifndef CZ_BASE_SUGGEST_H
#define CZ_BASE_SUGGEST_H

#include <stdbool.h>
#include <stddef.h>

#include "crushzone/status.h"

enum { CZ_LONGEST_SUGGESTED = 96 }; /* longer words are not compared [byte] */

/* The nearest word so far; zero-initialise it, offer every known word, read `best`. */
typedef struct CzSuggestion {
    char best[CZ_LONGEST_SUGGESTED + 1]; /* "" when nothing is near */
    int distance;                        /* edits from the typed word to the best one */
} CzSuggestion;

/* Offers a known word. It is kept, and true returned, when it is nearer than the best so far and
 * near enough to be a typing error: at most a third of its letters differ, a change of case
 * counting less. */
bool cz_suggest(CzSuggestion *suggestion, const char *typed, const char *known);

/* Number of a name among those of n items, each `size` bytes with a `const char *` at an offset
 * that may be NULL; -1 when no item has it, and then the nearest name. */
int cz_find_name(const char *name, const void *items, int n, size_t size, size_t offset,
                 CzSuggestion *nearest);

/* The same for an array of texts, and for structs with a member `name`. */
#define CZ_FIND_TEXT(text, texts, n, nearest)                                                      \
    cz_find_name(text, texts, n, sizeof(const char *), 0, nearest)
#define CZ_FIND_NAMED(text, type, items, n, nearest)                                               \
    cz_find_name(text, items, n, sizeof(type), offsetof(type, name), nearest)

/* Puts "did you mean 'best'?" into the help of an error (NULL is allowed) when there is one. */
void cz_suggest_help(const CzSuggestion *suggestion, CzError *error);

#endif
