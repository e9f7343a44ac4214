/* Warns of numbers that are allowed but unusual: a car of 38 kg, 25 m/s for 25 km/h.
 *
 * Zero and absent values are never unusual; signs do not count.
 */
#ifndef CZ_PROBLEM_USUAL_H
#define CZ_PROBLEM_USUAL_H

#include <stdio.h>

#include "problem/places.h"
#include "text/mistakes.h"

/* Warns of numbers outside of their usual range. */
void cz_usual_check(CzMistakes *warnings, const CzPlaces *places);

/* Writes the usual range of a key after its range; nothing when it has none. */
void cz_usual_write(FILE *stream, const CzKey *key);

#endif
