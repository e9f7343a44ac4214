/* The tables of units, and the stems of keys that end in a unit. */
#include "text/units.h"

#include <stdio.h>
#include <string.h>

#define CZ_DIMENSION(dimension, text, units) units
#define CZ_UNIT(dimension, suffix, symbol, si) {CZ_DIMENSION_##dimension, suffix, symbol, si},
const CzUnit cz_units[] = {
#include "text/units.def"
};
const int cz_n_unit = sizeof cz_units / sizeof cz_units[0];

#define CZ_DIMENSION(dimension, text, units) text,
const char *const cz_dimension_text[CZ_N_DIMENSION] = {
#include "text/units.def"
};

const CzUnit *cz_unit_si(CzDimension dimension) {
    int unit = 0;
    while (cz_units[unit].dimension != dimension)
        unit++;
    return &cz_units[unit];
}

const CzUnit *cz_unit_next(const CzUnit *unit) {
    const bool is_last = unit + 1 == cz_units + cz_n_unit || unit[1].dimension != unit->dimension;
    return is_last ? NULL : unit + 1;
}

const CzUnit *cz_unit_find(CzDimension dimension, const char *suffix) {
    const CzUnit *unit = cz_unit_si(dimension);
    while (unit != NULL && strcmp(unit->suffix, suffix) != 0)
        unit = cz_unit_next(unit);
    return unit;
}

/* The first unit with a suffix, in any dimension; NULL when there is none. */
static const CzUnit *unit_with(const char *suffix) {
    for (int i = 0; i < cz_n_unit; i++)
        if (cz_units[i].suffix[0] != '\0' && strcmp(cz_units[i].suffix, suffix) == 0)
            return &cz_units[i];
    return NULL;
}

size_t cz_key_stem_length(const char *key) {
    const size_t n = strlen(key);
    for (const char *at = strchr(key, '_'); at != NULL; at = strchr(at + 1, '_'))
        if (at > key && unit_with(at + 1) != NULL)
            return (size_t)(at - key); /* the first match is the longest suffix */
    return n;
}

double cz_key_unit_si(const char *key) {
    const char *end = key + cz_key_stem_length(key);
    return end[0] == '_' ? unit_with(end + 1)->si : 1;
}

bool cz_key_same_stem(const char *a, const char *b) {
    const size_t n = cz_key_stem_length(a);
    return n == cz_key_stem_length(b) && memcmp(a, b, n) == 0 && (a[n] == '\0') == (b[n] == '\0');
}

void cz_key_spellings(char *text, size_t size, const char *stem, CzDimension dimension) {
    const char *before = "";
    size_t n = 0;
    text[0] = '\0';
    for (const CzUnit *unit = cz_unit_si(dimension); unit != NULL; unit = cz_unit_next(unit)) {
        const int more = snprintf(text + n, size - n, "%s%s%s%s", before, stem,
                                  unit->suffix[0] != '\0' ? "_" : "", unit->suffix);
        n = n + (size_t)more < size ? n + (size_t)more : size - 1;
        const CzUnit *next = cz_unit_next(unit);
        before = next != NULL && cz_unit_next(next) != NULL ? ", " : " or ";
    }
}
