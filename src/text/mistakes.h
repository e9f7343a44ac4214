/* All mistakes of a problem file, collected in one pass. */
#ifndef CZ_TEXT_MISTAKES_H
#define CZ_TEXT_MISTAKES_H

#include "base/error.h"
#include "base/suggest.h"
#include "text/node.h"

enum { CZ_MAX_MISTAKES = 100 }; /* further ones are only counted */

typedef struct CzMistake {
    CzError error;
    int order;    /* of the source, for sorting */
    int n_stated; /* bytes of the message before the trail, for comparing */
} CzMistake;

/* Zero-initialise it and set the arena. */
typedef struct CzMistakes {
    CzArena *arena;
    CzMistake *mistake[CZ_MAX_MISTAKES + 1]; /* one more for the number of those left out */
    int n_mistake;
    int n_left_out;
    CzMistake *last; /* the one added last; NULL when it was known before or left out */
} CzMistakes;

/* Adds a mistake at the place of a node, in a sentence with its hint behind CZ_HELP. When the node
 * came through a part, the sentence names it. The same sentence at the same place is kept once. */
void cz_mistake(CzMistakes *mistakes, const CzNode *place, const CzTrail *trail, const char *format,
                ...) __attribute__((format(printf, 4, 5)));

/* The same with its arguments as a list. Only source, line and column of the place's node are
 * used. */
void cz_mistake_list(CzMistakes *mistakes, const CzNode *place, const CzTrail *trail,
                     const char *format, va_list arguments);

/* Adds one at a line and column of a source (0: the source as a whole). */
void cz_mistake_at(CzMistakes *mistakes, const CzSource *source, int line, int column,
                   const char *format, ...) __attribute__((format(printf, 5, 6)));

/* Adds a hint to the last mistake, unless it is NULL, or the mistake was known before or left
 * out. */
void cz_mistake_help(CzMistakes *mistakes, const char *help);

/* Adds a hint "did you mean 'best'?" when there is a best word. */
void cz_mistake_suggest(CzMistakes *mistakes, const CzSuggestion *suggestion);

/* Sorts the mistakes by file, line and column, and adds one with the number of those left out. */
void cz_mistakes_finish(CzMistakes *mistakes);

/* Status of reading `what`: CZ_OK without mistakes, CZ_STATUS_INPUT with the first one,
 * CZ_STATUS_NO_MEMORY. */
CzStatus cz_mistakes_status(const CzMistakes *mistakes, const char *what, CzError *error);

/* Sets file, line and column of a node in an error. */
void cz_error_place(CzError *error, const CzNode *place);

#endif
