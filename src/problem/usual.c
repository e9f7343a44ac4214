/* Usual ranges of numbers. */
#include "problem/usual.h"

#include <math.h>

#include "base/number.h"
#include "problem/keys.h"

/* Prints a number with its unit, if it has one. */
static const char *with_unit(char text[CZ_NUMBER_TEXT + 16], double value, const CzUnit *unit) {
    snprintf(text, CZ_NUMBER_TEXT + 16, "%s%s%s", CZ_SHORT(value),
             unit->symbol[0] != '\0' ? " " : "", unit->symbol);
    return text;
}
#define WITH_UNIT(value, unit) with_unit((char[CZ_NUMBER_TEXT + 16]){0}, value, unit)

/* The record that has a key. */
static const CzRecord *record_of(const CzKey *key) {
    int i = 0;
    while (key < cz_records[i].key || key >= cz_records[i].key + cz_records[i].n_key)
        i++;
    return &cz_records[i];
}

static void warn(CzMistakes *warnings, const CzPlace *place, const CzUsual *range) {
    const CzUnit *unit = cz_unit_find(place->key->dimension, range->unit);
    const double si = *(const double *)place->address;
    const double size = fabs(si) / unit->si, scale = unit->si / place->unit->si;
    if ((range->is_typed && place->unit != unit) || !(size > 0.0) ||
        (size >= range->lo && size <= range->hi))
        return;
    cz_mistake(warnings, place->value, place->trail,
               "%s of this %s is unusual: %s, where %s to %s is usual; check the unit" CZ_HELP
               "the value is used as written; 'crushzone help keys' lists the usual ranges",
               place->key->stem, record_of(place->key)->name,
               WITH_UNIT(si / place->unit->si, place->unit), CZ_SHORT(range->lo * scale),
               WITH_UNIT(range->hi * scale, place->unit));
}

void cz_usual_write(FILE *stream, const CzKey *key) {
    for (int i = 0; i < 2 && key->usual[i].unit != NULL; i++) {
        const CzUsual *range = &key->usual[i];
        fprintf(stream, "%s%s to %s", i == 0 ? "; usually " : ", ", CZ_SHORT(range->lo),
                WITH_UNIT(range->hi, cz_unit_find(key->dimension, range->unit)));
    }
}

void cz_usual_check(CzMistakes *warnings, const CzPlaces *places) {
    for (int k = 0; k < places->n_place; k++) {
        const CzPlace *place = &places->place[k];
        if (place->unit == NULL || place->value->kind != CZ_NODE_TEXT ||
            place->node->source->is_general)
            continue;
        for (int i = 0; i < 2 && place->key->usual[i].unit != NULL; i++)
            warn(warnings, place, &place->key->usual[i]);
    }
}
