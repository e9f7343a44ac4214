/* Variables whose values are a list of sizes. A search varies the place in the list, from 0, so
 * that sizes are whole numbers; values between two sizes are interpolated. */
#ifndef CZ_EVALUATE_LISTED_H
#define CZ_EVALUATE_LISTED_H

#include "crushzone/evaluate.h"

/* The value at a place of the list, and the place of a value between its first and its last one. */
double cz_listed_value(const CzVariableInfo *variable, double place);
double cz_listed_place(const CzVariableInfo *variable, double value);

/* Range of a numerical variable in a search, from a start: its bounds and increment, or the places
 * of its list; and its value for a number of the search. */
typedef struct CzSearchRange {
    double min, max, start, step;
} CzSearchRange;
CzSearchRange cz_search_range(const CzVariableInfo *variable, double start);
double cz_search_value(const CzVariableInfo *variable, double number);

/* Whether a value is one in which the variable is available: on its increment, or in its list. */
bool cz_variable_has(const CzVariableInfo *variable, double value);

#endif
