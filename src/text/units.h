/* Dimensions, and the units that end a key: units.def as tables. */
#ifndef CZ_TEXT_UNITS_H
#define CZ_TEXT_UNITS_H

#include <stdbool.h>
#include <stddef.h>

#include "base/gravity.h"

#define CZ_DIMENSION(dimension, text, units) CZ_DIMENSION_##dimension,
typedef enum CzDimension {
#include "text/units.def"
    CZ_N_DIMENSION
} CzDimension;

typedef struct CzUnit {
    CzDimension dimension;
    const char *suffix; /* "" for none */
    const char *symbol; /* for sentences: "kN/m" */
    double si;          /* SI value of one unit */
} CzUnit;

extern const CzUnit cz_units[]; /* those of one dimension are together, the SI one first */
extern const int cz_n_unit;
extern const char *const cz_dimension_text[CZ_N_DIMENSION];

const CzUnit *cz_unit_si(CzDimension dimension);
/* The next unit of the same dimension; NULL after the last. */
const CzUnit *cz_unit_next(const CzUnit *unit);
/* Unit of a dimension by its suffix; NULL when it is not one of its units. */
const CzUnit *cz_unit_find(CzDimension dimension, const char *suffix);
/* Length of a key without the longest unit suffix at its end [byte]. */
size_t cz_key_stem_length(const char *key);
/* SI value of one unit of a key, which is that at its end; 1 when there is none. */
double cz_key_unit_si(const char *key);
/* Whether two keys have the same stem, in whatever units. */
bool cz_key_same_stem(const char *a, const char *b);
/* Writes the spellings of a stem: "stroke_m or stroke_mm". */
void cz_key_spellings(char *text, size_t size, const char *stem, CzDimension dimension);

#endif
