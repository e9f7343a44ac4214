/* Did-you-mean: the known word that is nearest to a mistyped one. */
#ifndef CZ_BASE_SUGGEST_H
#define CZ_BASE_SUGGEST_H

#include <stdbool.h>

#include "crushzone/status.h"

enum { CZ_LONGEST_SUGGESTED = 96 }; /* longer words are not compared [byte] */

/* The nearest word so far; zero-initialise it, offer every known word, read `best`. */
typedef struct CzSuggestion {
    char best[CZ_LONGEST_SUGGESTED + 1]; /* "" when nothing is near */
    int distance;                        /* edits from the typed word to the best one */
} CzSuggestion;

/* Offers a known word. It is taken, and true returned, when it is nearer than the best so far and
 * near enough to be a slip of the hand: at most a third of its letters, a change of case counting
 * little. */
bool cz_suggest(CzSuggestion *suggestion, const char *typed, const char *known);

/* Puts "did you mean 'best'?" into the help of an error (NULL is allowed) when there is one. */
void cz_suggest_help(const CzSuggestion *suggestion, CzError *error);

#endif
