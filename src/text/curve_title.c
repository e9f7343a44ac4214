/* Finds columns and their units. */
#include "text/curve_title.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/gravity.h"

/* ---- units ---- */

static const CzUnit units[] = {
#define CZ_CURVE_UNIT(dimension, spelling, si) {CZ_DIMENSION_##dimension, spelling, spelling, si},
#include "text/curve_units.def"
#undef CZ_CURVE_UNIT
};

enum { N_UNIT = sizeof units / sizeof units[0] };

const CzUnit *cz_curve_unit_find(CzDimension dimension, const char *spelling) {
    for (int i = 0; i < N_UNIT; i++)
        if ((dimension == CZ_N_DIMENSION || units[i].dimension == dimension) &&
            strcmp(units[i].suffix, spelling) == 0)
            return &units[i];
    return NULL;
}

/* Copies a part of a title without the blanks and brackets around it. */
static void copy_bare(const char *start, size_t n, char text[CZ_MAX_FIELD_TEXT]) {
    while (n > 0 && strchr(" \t[(\"", start[0]) != NULL) {
        start++;
        n--;
    }
    while (n > 0 && strchr(" \t])\"", start[n - 1]) != NULL)
        n--;
    snprintf(text, CZ_MAX_FIELD_TEXT, "%.*s", (int)(n < CZ_MAX_FIELD_TEXT ? n : 0), start);
}

const CzUnit *cz_curve_unit_of_title(const char *title, size_t *n_title) {
    char rest[CZ_MAX_FIELD_TEXT];
    for (const char *at = strpbrk(title, "_[( /,:"); at != NULL; at = strpbrk(at + 1, "_[( /,:")) {
        copy_bare(at + 1, strlen(at + 1), rest);
        const CzUnit *unit = cz_curve_unit_find(CZ_N_DIMENSION, rest);
        if (unit == NULL)
            continue; /* the first match is the longest unit */
        size_t n = (size_t)(at - title);
        while (n > 0 && strchr(" _/,:", title[n - 1]) != NULL)
            n--;
        if (n_title != NULL)
            *n_title = n;
        return unit;
    }
    if (n_title != NULL)
        *n_title = strlen(title);
    return NULL;
}

const CzUnit *cz_curve_unit_alone(const CzField *field) {
    char text[CZ_MAX_FIELD_TEXT];
    copy_bare(field->text, field->n, text);
    return cz_curve_unit_find(CZ_N_DIMENSION, text);
}

/* Whether a unit is earlier in the list with another spelling. */
static bool is_listed(int unit) {
    for (int i = 0; i < unit; i++)
        if (units[i].dimension == units[unit].dimension && units[i].si == units[unit].si)
            return true;
    return false;
}

void cz_curve_unit_list(CzDimension dimension, char *text, size_t size) {
    size_t n = 0;
    text[0] = '\0';
    for (int i = 0; i < N_UNIT; i++) {
        if (units[i].dimension != dimension || is_listed(i) || n + 1 >= size)
            continue;
        n += (size_t)snprintf(text + n, size - n, "%s%s", n > 0 ? ", " : "", units[i].suffix);
    }
}

/* ---- columns ---- */

int cz_curve_column_number(const CzCurveColumn *column) {
    char *end = NULL;
    const long number = column->title != NULL ? strtol(column->title, &end, 10) : 0;
    return end != NULL && *end == '\0' && number >= 1 && number < 10000 ? (int)number - 1 : -1;
}

/* Other words for a quantity, without case. */
static const struct {
    const char *name, *word;
} words[] = {
    {"stroke", "travel"},       {"stroke", "displacement"}, {"stroke", "extension"},
    {"stroke", "compression"},  {"stroke", "crosshead"},    {"stroke", "position"},
    {"stroke", "deflection"},   {"stroke", "shortening"},   {"stroke", "deformation"},
    {"stroke", "closure"},      {"stroke", "hub"},          {"stroke", "weg"},
    {"stroke", "standardweg"},  {"stroke", "verformung"},   {"stroke", "course"},
    {"stroke", "deplacement"},  {"force", "load"},          {"force", "kraft"},
    {"force", "standardkraft"}, {"force", "effort"},        {"time", "t"},
    {"time", "zeit"},           {"time", "temps"},          {"speed", "velocity"},
};

/* Rank of a title for a requested quantity; the smallest one is selected. */
typedef enum Rank { EXACT, ALMOST, NAMED, CALLED, IN_UNIT, NOT } Rank;

static bool begins_with(const char *title, const char *word) {
    const size_t n = strlen(word);
    return strncasecmp(title, word, n) == 0 &&
           (title[n] == '\0' || strchr("_ [(/,:", title[n]) != NULL);
}

static Rank rank_by_name(const CzCurveColumn *column, const char *title) {
    if (begins_with(title, column->name))
        return NAMED;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(words[i].name, column->name) == 0 && begins_with(title, words[i].word))
            return CALLED;
    return NOT;
}

/* Rank for a requested title: identical, in another case, or without its unit. */
static Rank rank_of_title(const char *wanted, const char *title) {
    size_t n = 0;
    cz_curve_unit_of_title(title, &n);
    if (strcmp(title, wanted) == 0)
        return EXACT;
    const bool is_bare = strlen(wanted) == n && strncasecmp(title, wanted, n) == 0;
    return strcasecmp(title, wanted) == 0 || is_bare ? ALMOST : NOT;
}

static Rank rank_of(const CzCurveColumn *column, const CzField *title, const CzField *below) {
    char text[CZ_MAX_FIELD_TEXT];
    cz_field_text(title, text);
    if (column->title != NULL)
        return rank_of_title(column->title, text);
    const CzUnit *unit = cz_curve_unit_of_title(text, NULL);
    if (unit == NULL && below != NULL)
        unit = cz_curve_unit_alone(below);
    if (unit == NULL && title->n > 1) /* "N" may be a number of cycles, "s" a stroke */
        unit = cz_curve_unit_alone(title);
    if (unit != NULL && unit->dimension != column->dimension)
        return NOT; /* "Extension rate (mm/s)" is not a stroke */
    const Rank by_name = rank_by_name(column, text);
    return by_name == NOT && unit != NULL ? IN_UNIT : by_name;
}

int cz_curve_column_find(const CzCurveColumn *column, const char *titles, const char *units_line,
                         char separator) {
    CzFieldWalk walk = cz_fields_begin(titles, separator), below = {0};
    Rank best = NOT;
    int found = -1;
    if (cz_curve_column_number(column) >= 0)
        return cz_curve_column_number(column) < cz_fields_count(titles, separator).all
                   ? cz_curve_column_number(column)
                   : -1;
    if (units_line != NULL)
        below = cz_fields_begin(units_line, separator);
    while (cz_fields_next(&walk)) {
        const CzField *unit = cz_fields_next(&below) ? &below.field : NULL;
        const Rank rank = rank_of(column, &walk.field, unit);
        if (rank == best && best != NOT)
            found = -2;
        if (rank < best) {
            best = rank;
            found = walk.n - 1;
        }
    }
    return found;
}
