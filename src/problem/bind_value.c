/* Texts to numbers, counts, flags, words. A value stays text until the table says what it is, so
 * NO, 012 or 1:30 never turn into something else. */
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "crushzone/names.h"
#include "problem/reader.h"

/* A value at the edge of its range may miss it by rounding in the change of units. */
static const double ROUNDING = 1e-12;

/* Whether a node holds a value at all. */
static bool is_value(CzReader *reader, const char *key, const CzNode *value, const CzTrail *trail) {
    if (value->kind != CZ_NODE_TEXT) {
        cz_mistake(&reader->mistakes, value, trail, "'%s' needs one value, but this is %s", key,
                   cz_node_what(value));
        return false;
    }
    const bool is_null = strcmp(value->text, "~") == 0 || strcmp(value->text, "null") == 0;
    if (!value->quoted && (value->text[0] == '\0' || is_null)) {
        cz_mistake(&reader->mistakes, value, trail, "'%s' has no value", key);
        return false;
    }
    return true;
}

/* Whether a node holds a value without quotes. */
static bool is_bare(CzReader *reader, const char *key, const char *what, const CzNode *value,
                    const CzTrail *trail) {
    if (!is_value(reader, key, value, trail))
        return false;
    if (value->quoted)
        cz_mistake(&reader->mistakes, value, trail,
                   "'%s' needs %s, but \"%.60s\" is text in quotes", key, what, value->text);
    return !value->quoted;
}

static bool is_in_range(CzReader *reader, const CzKey *key, const CzUnit *unit,
                        const char *key_text, const CzNode *value, const CzTrail *trail,
                        double si) {
    char limit[CZ_NUMBER_TEXT];
    const bool is_low = si < key->lo - ROUNDING * fabs(key->lo);
    const bool is_high = si > key->hi + ROUNDING * fabs(key->hi);
    if (!is_low && !is_high)
        return true;
    cz_number_print_short(limit, (is_low ? key->lo : key->hi) / unit->si);
    cz_mistake(&reader->mistakes, value, trail, "%s: %.60s is %s allowed %s%s%s", key_text,
               value->text, is_low ? "below the smallest" : "above the largest", limit,
               unit->suffix[0] != '\0' ? " " : "", unit->suffix);
    return false;
}

bool cz_bind_number(CzReader *reader, const CzKey *key, const CzUnit *unit, const CzNode *key_node,
                    const CzNode *value, const CzTrail *trail, double *number) {
    double typed;
    if (value->match > 0) /* stands for any number */
        return true;
    *number = NAN; /* what is no number breaks no rule */
    if (!is_bare(reader, key_node->text, "a number", value, trail))
        return false;
    const char *wrong = cz_number_parse(value->text, &typed);
    if (wrong != NULL) {
        cz_mistake(&reader->mistakes, value, trail, "%s: '%.60s' %s", key_node->text, value->text,
                   wrong);
        return false;
    }
    const double si = typed * unit->si;
    if (!is_in_range(reader, key, unit, key_node->text, value, trail, si))
        return false;
    *number = si;
    return true;
}

bool cz_bind_count(CzReader *reader, const CzKey *key, const CzNode *value, const CzTrail *trail,
                   int *count) {
    static const CzUnit none = {CZ_DIMENSION_NONE, "", 1};
    double typed;
    if (!is_bare(reader, key->stem, "a whole number", value, trail))
        return false;
    const char *wrong = cz_number_parse(value->text, &typed);
    if (wrong == NULL && (typed != floor(typed) || strpbrk(value->text, ".eE") != NULL))
        wrong = "is not a whole number";
    if (wrong != NULL) {
        cz_mistake(&reader->mistakes, value, trail, "%s: '%.60s' %s", key->stem, value->text,
                   wrong);
        return false;
    }
    if (!is_in_range(reader, key, &none, key->stem, value, trail, typed))
        return false;
    *count = (int)typed;
    return true;
}

bool cz_bind_flag(CzReader *reader, const char *key, const CzNode *value, const CzTrail *trail,
                  bool *flag) {
    if (!is_bare(reader, key, "true or false", value, trail))
        return false;
    const bool is_true = strcmp(value->text, "true") == 0;
    if (!is_true && strcmp(value->text, "false") != 0) {
        cz_mistake(&reader->mistakes, value, trail, "%s: '%.60s' is neither true nor false", key,
                   value->text);
        return false;
    }
    *flag = is_true;
    return true;
}

bool cz_bind_choice(CzReader *reader, const CzKey *key, const CzNode *value, const CzTrail *trail,
                    int *choice) {
    const CzWordSet *set = &cz_word_sets[key->words];
    char words[160] = "";
    size_t n = 0;
    if (!is_value(reader, key->stem, value, trail))
        return false;
    const int nearest = cz_word_nearest(set, value->text);
    if (nearest >= 0) /* a mistyped word is taken for the one that was meant */
        *choice = nearest;
    if (nearest >= 0 && strcmp(set->word[nearest].word, value->text) == 0)
        return true;
    for (int i = 0; i < set->n_word; i++) {
        const char *before = i == 0 ? "" : i + 1 < set->n_word ? ", " : " or ";
        n += (size_t)snprintf(words + n, sizeof words - n, "%s%s", before, set->word[i].word);
        n = n < sizeof words ? n : sizeof words - 1;
    }
    cz_mistake(&reader->mistakes, value, trail, "%s: '%.60s' is not %s", key->stem, value->text,
               words);
    cz_mistake_suggest(&reader->mistakes, nearest >= 0 ? set->word[nearest].word : NULL);
    return false;
}

const char *cz_bind_text(CzReader *reader, const char *key, const CzNode *value,
                         const CzTrail *trail) {
    if (!is_value(reader, key, value, trail))
        return NULL;
    if (value->text[strspn(value->text, " ")] == '\0') {
        cz_mistake(&reader->mistakes, value, trail, "'%s' is an empty text", key);
        return NULL;
    }
    if (strlen(value->text) > CZ_MOST_TEXT)
        cz_mistake(&reader->mistakes, value, trail, "'%s' has more than %d letters", key,
                   (int)CZ_MOST_TEXT);
    return value->text;
}
