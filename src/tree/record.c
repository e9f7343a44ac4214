/* Looks up keys in the tables. */
#include "tree/record.h"

#include <string.h>

#include "base/suggest.h"

int cz_word_nearest(const CzWordSet *set, const char *typed) {
    CzSuggestion suggestion = {0};
    int nearest = -1;
    for (int i = 0; i < set->n_word; i++)
        if (cz_suggest(&suggestion, typed, set->word[i].word))
            nearest = i;
    return nearest;
}

const CzKey *cz_record_key(const CzRecord *record, const char *stem) {
    for (int i = 0; i < record->n_key; i++)
        if (strcmp(record->key[i].stem, stem) == 0)
            return &record->key[i];
    return NULL;
}

const CzKey *cz_record_match(const CzRecord *record, const char *typed, const CzUnit **unit) {
    for (int i = 0; i < record->n_key; i++) {
        const CzKey *key = &record->key[i];
        const size_t n = strlen(key->stem);
        *unit = NULL;
        if (strncmp(key->stem, typed, n) != 0)
            continue;
        if (key->kind == CZ_KEY_NUMBER && typed[n] == '_')
            *unit = cz_unit_find(key->dimension, typed + n + 1);
        else if (key->kind == CZ_KEY_NUMBER && typed[n] == '\0')
            *unit = cz_unit_find(key->dimension, "");
        if (*unit != NULL || (key->kind != CZ_KEY_NUMBER && typed[n] == '\0'))
            return key;
    }
    *unit = NULL;
    return NULL;
}
