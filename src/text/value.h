/* Text nodes as numbers, counts, flags and texts. A value stays text until its type is known, so
 * NO, 012 or 1:30 are never converted to another value. */
#ifndef CZ_TEXT_VALUE_H
#define CZ_TEXT_VALUE_H

#include "text/mistakes.h"
#include "text/units.h"

/* A value with its key, for messages. */
typedef struct CzValue {
    CzMistakes *mistakes;
    const char *key;
    const CzNode *node;
    const CzTrail *trail;
} CzValue;

/* Whether the node has a value; adds a mistake when not. */
bool cz_value_exists(CzValue value);

/* A number in a unit between two limits [SI]; NaN and false with a mistake when it is not a number.
 * A stand-in for a number leaves `number` unchanged. */
bool cz_value_number(CzValue value, const CzUnit *unit, double lo, double hi, double *number);

/* A whole number between two limits; false with a mistake when it is not. */
bool cz_value_count(CzValue value, double lo, double hi, int *count);

/* true or false; false with a mistake when it is neither. */
bool cz_value_flag(CzValue value, bool *flag);

/* A text; NULL with a mistake when there is none. */
const char *cz_value_text(CzValue value);

#endif
