/* Usual ranges of numbers. */
#include "problem/usual.h"

#include <math.h>

#include "base/number.h"
#include "problem/keys.h"

typedef struct {
    CzRecordId record;
    const char *stem, *unit;
    double lo, hi; /* [unit] */
    bool is_typed; /* only for numbers that are typed in the unit */
} Usual;

static const Usual usual[] = {
#define CZ_USUAL(type, stem, unit, lo, hi) {CZ_RECORD_##type, #stem, #unit, lo, hi, false},
#define CZ_USUAL_IN(type, stem, unit, lo, hi) {CZ_RECORD_##type, #stem, #unit, lo, hi, true},
#include "problem/usual.def"
#undef CZ_USUAL
#undef CZ_USUAL_IN
};
enum { N_USUAL = sizeof usual / sizeof usual[0] };

/* Prints a number with its unit, if it has one. */
static const char *with_unit(char text[CZ_NUMBER_TEXT + 16], double value, const CzUnit *unit) {
    snprintf(text, CZ_NUMBER_TEXT + 16, "%s%s%s", CZ_SHORT(value),
             unit->symbol[0] != '\0' ? " " : "", unit->symbol);
    return text;
}
#define WITH_UNIT(value, unit) with_unit((char[CZ_NUMBER_TEXT + 16]){0}, value, unit)

static void warn(CzMistakes *warnings, const CzPlace *place, const Usual *range,
                 const CzUnit *unit) {
    const double si = *(const double *)place->address;
    const double size = fabs(si) / unit->si, scale = unit->si / place->unit->si;
    if (!(size > 0.0) || (size >= range->lo && size <= range->hi))
        return;
    cz_mistake(warnings, place->value, place->trail,
               "%s of this %s is unusual: %s, where %s to %s is usual; check the unit" CZ_HELP
               "the value is used as written; 'crushzone help keys' lists the usual ranges",
               place->key->stem, cz_records[range->record].name,
               WITH_UNIT(si / place->unit->si, place->unit), CZ_SHORT(range->lo * scale),
               WITH_UNIT(range->hi * scale, place->unit));
}

void cz_usual_write(FILE *stream, const CzKey *key) {
    const char *before = "; usually ";
    for (int i = 0; i < N_USUAL; i++) {
        const Usual *range = &usual[i];
        if (cz_record_key(&cz_records[range->record], range->stem) != key)
            continue;
        const CzUnit *unit = cz_unit_find(key->dimension, range->unit);
        fprintf(stream, "%s%s to %s", before, CZ_SHORT(range->lo), WITH_UNIT(range->hi, unit));
        before = ", ";
    }
}

void cz_usual_check(CzMistakes *warnings, const CzPlaces *places) {
    for (int i = 0; i < N_USUAL; i++) {
        const Usual *range = &usual[i];
        const CzKey *key = cz_record_key(&cz_records[range->record], range->stem);
        const CzUnit *unit = cz_unit_find(key->dimension, range->unit);
        for (int k = 0; k < places->n_place; k++) {
            const CzPlace *place = &places->place[k];
            if (place->size == 0 && place->key == key && place->unit != NULL &&
                place->value->kind == CZ_NODE_TEXT && (!range->is_typed || place->unit == unit))
                warn(warnings, place, range, unit);
        }
    }
}
