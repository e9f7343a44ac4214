/* Titles, rows of units and columns of curve files. */
#include "text/curve_columns.h"

#include <stdio.h>
#include <string.h>

#include "base/suggest.h"

enum { MAX_BELOW_TITLES = 3 };

bool cz_reading_list_lines(CzArena *arena, CzCurveReading *reading) {
    const int n_line = reading->source.n_line;
    reading->next = cz_arena_allocate(arena, (size_t)n_line + 1, sizeof *reading->next);
    if (reading->next == NULL)
        return false;
    reading->next[n_line] = n_line;
    for (int line = n_line - 1; line >= 0; line--) {
        const char *text = reading->source.line[line];
        const bool is_passed_over = cz_line_is_empty(text) || cz_line_comment(text) != NULL;
        reading->next[line] = is_passed_over ? reading->next[line + 1] : line;
    }
    return true;
}

int cz_reading_next(const CzCurveReading *reading, int line) {
    return line < reading->source.n_line ? reading->next[line] : reading->source.n_line;
}

/* Whether both columns are requested by number, so that titles are not required. */
static bool is_by_number(const CzCurveReading *reading) {
    return cz_curve_column_number(&reading->request->column[0]) >= 0 &&
           cz_curve_column_number(&reading->request->column[1]) >= 0;
}

static int numbers_in(const CzCurveReading *reading, const char *line) {
    CzFieldWalk walk = cz_fields_begin(line, reading->separator);
    int n = 0;
    while (cz_fields_next(&walk))
        n += cz_field_is_number(&walk.field);
    return n;
}

/* ---- titles ---- */

enum { LONGEST_UNIT = 8 };

/* Whether a field can be a unit that is not known: one short word. */
static bool is_like_a_unit(const CzField *field) {
    return field->n <= LONGEST_UNIT && memchr(field->text, ' ', field->n) == NULL;
}

/* Whether some fields of a line are units and every other one that is not empty is in brackets, a
 * dash, or where `with_unknown` one short word. */
static bool is_of_units(const CzCurveReading *reading, const char *line, bool with_unknown) {
    CzFieldWalk walk = cz_fields_begin(line, reading->separator);
    int n_unit = 0;
    while (cz_fields_next(&walk)) {
        const CzField *field = &walk.field;
        const bool is_unit = cz_curve_unit_alone(field) != NULL;
        const bool is_bracketed = field->n > 1 && strchr("[(", field->text[0]) != NULL;
        if (field->n > 0 && !is_unit && !is_bracketed && strchr("-%", field->text[0]) == NULL &&
            !(with_unknown && is_like_a_unit(field)))
            return false;
        n_unit += is_unit;
    }
    return n_unit > 0;
}

/* Reads the lines after a line of titles: perhaps units, then points. False when no points
 * follow. */
static bool look_below(CzCurveReading *reading, int line) {
    reading->units = NULL;
    reading->data = line;
    for (int i = 0; i < MAX_BELOW_TITLES; i++) {
        reading->data = cz_reading_next(reading, reading->data + 1);
        if (reading->data == reading->source.n_line)
            return false;
        const char *text = reading->source.line[reading->data];
        if (numbers_in(reading, text) >= 2)
            return true;
        if (reading->units == NULL && is_of_units(reading, text, true)) {
            reading->units = text;
            reading->unit_line = reading->data;
        } else if (is_by_number(reading))
            return false; /* nothing but units is between titles and points */
    }
    return false;
}

/* Accepts a text as titles when it has both columns and points follow; `found` receives the results
 * of cz_curve_column_find. */
static bool try_titles(CzCurveReading *reading, int line, const char *text, int found[2]) {
    if (cz_line_is_empty(text) || numbers_in(reading, text) > 0 || !look_below(reading, line))
        return false;
    int place[2];
    for (int i = 0; i < 2; i++)
        place[i] = cz_curve_column_find(&reading->request->column[i], text, reading->units,
                                        reading->separator);
    const bool has_both = place[0] >= 0 && place[1] >= 0 && place[0] != place[1];
    if (!has_both && is_of_units(reading, text, false))
        return false;
    memcpy(found, place, sizeof place);
    reading->titles = text;
    reading->title_line = line;
    return has_both;
}

/* Looks for titles among the lines, then among the comments. Without titles the last line that
 * resembles titles remains in `file`. */
static bool find_titles(CzCurveReading *reading, bool in_comments, int found[2]) {
    for (int line = reading->first; line < reading->source.n_line; line++) {
        const char *text = reading->source.line[line], *comment = cz_line_comment(text);
        if (cz_line_is_empty(text) || (comment != NULL) != in_comments)
            continue;
        if (try_titles(reading, line, in_comments ? comment : text, found))
            return true;
        if (is_by_number(reading) && !in_comments && numbers_in(reading, text) >= 2)
            return false; /* points without titles */
    }
    return false;
}

/* Writes "'Time', 'Extension', 'Load'". */
static void list_titles(const CzCurveReading *reading, char *text, size_t size) {
    CzFieldWalk walk = cz_fields_begin(reading->titles, reading->separator);
    size_t n = 0;
    text[0] = '\0';
    while (cz_fields_next(&walk) && n + 40 < size)
        n += (size_t)snprintf(text + n, size - n, "%s'%.*s'", n > 0 ? ", " : "",
                              (int)(walk.field.n < 30 ? walk.field.n : 30), walk.field.text);
}

bool cz_reading_has_whole_quotes(const CzCurveReading *reading, int line) {
    const char *text = reading->source.line[line];
    int n = 0, column = 1, last = 1;
    for (; *text != '\0'; text++) {
        n += *text == '"';
        last = *text == '"' ? column : last;
        column += ((unsigned char)*text & 0xc0) != 0x80;
    }
    if (n % 2 == 0)
        return true;
    cz_mistake_at(reading->mistakes, &reading->source, line + 1, last,
                  "the quotation mark here is not closed");
    return false;
}

/* Suggests the title that is nearest to a mistyped one; false when none is near. */
static bool suggest(const CzCurveReading *reading, const char *typed) {
    char title[CZ_MAX_FIELD_TEXT];
    CzSuggestion nearest = {0};
    CzFieldWalk walk = cz_fields_begin(reading->titles, reading->separator);
    while (cz_fields_next(&walk))
        cz_suggest(&nearest, typed, cz_field_text(&walk.field, title));
    cz_mistake_suggest(reading->mistakes, &nearest);
    return nearest.best[0] != '\0';
}

/* Reports a column that is missing, or found more than once. */
static bool refuse_titles(const CzCurveReading *reading, const int found[2]) {
    const CzCurveColumn *column = reading->request->column;
    const int i = found[0] < 0 ? 0 : 1;
    if (!cz_reading_has_whole_quotes(reading, reading->title_line))
        return false;
    char titles[240], wanted[96];
    list_titles(reading, titles, sizeof titles);
    snprintf(wanted, sizeof wanted, "%s%.60s%s", column[i].title != NULL ? "'" : "the ",
             column[i].title != NULL ? column[i].title : column[i].name,
             column[i].title != NULL ? "'" : "");
    if (found[0] == found[1] && found[0] >= 0)
        cz_mistake_at(reading->mistakes, &reading->source, reading->title_line + 1, 1,
                      "one column is taken for both %s and %s; the titles are %s", column[0].name,
                      column[1].name, titles);
    else
        cz_mistake_at(reading->mistakes, &reading->source, reading->title_line + 1, 1,
                      found[i] == -2 ? "more than one column may be %s; the titles are %s"
                                     : "no column is %s; the titles are %s",
                      wanted, titles);
    if (column[i].title == NULL || found[i] != -1 || !suggest(reading, column[i].title))
        cz_mistake_help(reading->mistakes, reading->request->column_help);
    return false;
}

/* Whether a file without titles has two columns, and both requested titles end in units: then they
 * are the titles of these columns. */
static bool takes_names(const CzCurveReading *reading) {
    const char *line = reading->source.line[reading->data];
    for (int i = 0; i < 2; i++) {
        const CzCurveColumn *column = &reading->request->column[i];
        if (column->title == NULL || cz_curve_column_number(column) >= 0 ||
            cz_curve_unit_of_title(column->title, NULL) == NULL)
            return false;
    }
    return cz_fields_count(line, reading->separator).filled == 2;
}

/* A file without titles: both columns are given by their numbers, with their units, or the two
 * columns of the file by titles that end in units. */
static bool begin_without_titles(CzCurveReading *reading) {
    const CzCurveColumn *column = reading->request->column;
    const int n_line = reading->source.n_line;
    reading->titles = reading->units = NULL;
    reading->data = cz_reading_next(reading, reading->first);
    while (reading->data < n_line && numbers_in(reading, reading->source.line[reading->data]) < 2)
        reading->data = cz_reading_next(reading, reading->data + 1);
    for (int i = 0; i < 2; i++)
        reading->index[i] = cz_curve_column_number(&column[i]);
    reading->names_columns = reading->data < n_line && takes_names(reading);
    for (int i = 0; i < 2 && reading->names_columns; i++)
        reading->index[i] = i;
    if (reading->data == n_line)
        cz_mistake_at(reading->mistakes, &reading->source, 1, 1,
                      "no line of this file has two numbers; a curve is two columns of them");
    else if (!is_by_number(reading) && !reading->names_columns)
        cz_mistake_at(reading->mistakes, &reading->source, reading->data + 1, 1,
                      "no line of titles above names the column of the %s",
                      column[reading->index[0] < 0 ? 0 : 1].name);
    else
        return true;
    cz_mistake_help(reading->mistakes,
                    reading->data < n_line ? reading->request->column_help : NULL);
    return false;
}

/* ---- units ---- */

/* Information in the file on the unit of a column. */
typedef struct Units {
    CzField field, below; /* the title, and the field of the row of units */
    char title[CZ_MAX_FIELD_TEXT];
    const CzUnit *in_title, *in_row;
    bool has_unknown; /* the row of units has a field here that is not a unit */
} Units;

static Units units_of(const CzCurveReading *reading, int i) {
    Units units = {.field = {.text = "", .column = 1}, .below = {.text = "", .column = 1}};
    const int index = reading->index[i];
    if (reading->titles != NULL &&
        cz_field_take(reading->titles, reading->separator, index, &units.field))
        units.in_title = cz_curve_unit_of_title(cz_field_text(&units.field, units.title), NULL);
    const char *named = reading->names_columns ? reading->request->column[i].title : NULL;
    if (named != NULL && cz_curve_column_number(&reading->request->column[i]) < 0) {
        snprintf(units.title, sizeof units.title, "%s", named);
        units.in_title = cz_curve_unit_of_title(named, NULL);
    }
    if (reading->units != NULL &&
        cz_field_take(reading->units, reading->separator, index, &units.below))
        units.in_row = cz_curve_unit_alone(&units.below);
    units.has_unknown =
        units.in_row == NULL && units.below.n > 0 && strchr("-1", units.below.text[0]) == NULL;
    if (units.in_title == NULL && units.in_row == NULL && units.field.n > 1)
        units.in_title = cz_curve_unit_alone(&units.field);
    return units;
}

/* Reports a mistake about the unit of a column at its place: in the title or in the row below. */
static bool refuse_unit(const CzCurveReading *reading, const CzCurveColumn *column,
                        const Units *units) {
    char list[120], below[CZ_MAX_FIELD_TEXT], sentence[CZ_MAX_FIELD_TEXT + 200];
    const CzUnit *unit = units->in_title != NULL ? units->in_title : units->in_row;
    const bool is_in_row =
        column->unit == NULL && units->in_title == NULL && (unit != NULL || units->has_unknown);
    cz_curve_unit_list(column->dimension, list, sizeof list);
    if (column->unit != NULL)
        snprintf(sentence, sizeof sentence, "'%.60s' is not a unit of the %s, which takes %s",
                 column->unit, column->name, list);
    else if (units->in_title != NULL && units->in_row != NULL &&
             unit->dimension == column->dimension)
        snprintf(sentence, sizeof sentence,
                 "the %s has two units: %s in its title '%.60s' and %s in the row below",
                 column->name, unit->suffix, units->title, units->in_row->suffix);
    else if (unit != NULL)
        snprintf(sentence, sizeof sentence,
                 "the unit of column '%.60s', %s, is not a unit of the %s, which takes %s",
                 units->title, unit->suffix, column->name, list);
    else if (units->has_unknown)
        snprintf(sentence, sizeof sentence,
                 "'%.60s' in the row of units is not a unit of the %s, which takes %s",
                 cz_field_text(&units->below, below), column->name, list);
    else if (units->title[0] != '\0')
        snprintf(sentence, sizeof sentence,
                 "the unit of column '%.60s', the %s, is missing or unknown", units->title,
                 column->name);
    else
        snprintf(sentence, sizeof sentence, "the unit of the %s is missing or unknown",
                 column->name);
    const int line = is_in_row                 ? reading->unit_line
                     : reading->titles != NULL ? reading->title_line
                                               : reading->data;
    cz_mistake_at(reading->mistakes, &reading->source, line + 1,
                  is_in_row ? units->below.column : units->field.column, "%s", sentence);
    cz_mistake_help(reading->mistakes, reading->request->unit_help);
    return false;
}

/* Whether a title ends in brackets around a text that can only be a unit: short, no blank and no
 * digit except an exponent, unlike "(car 1)" or "(A1)". */
static bool ends_like_a_unit(const char *title) {
    const size_t n = strlen(title);
    if (n < 3 || (title[n - 1] != ']' && title[n - 1] != ')'))
        return false;
    const char *open = strrchr(title, title[n - 1] == ']' ? '[' : '(');
    if (open == NULL)
        return false;
    const size_t inside = n - (size_t)(open - title) - 2;
    const bool has_digit = strcspn(open, "013456789") < strlen(open);
    return inside > 0 && inside <= 6 && !has_digit && strchr(open, ' ') == NULL;
}

bool cz_reading_find_unit(CzCurveReading *reading, int i) {
    const CzCurveColumn *column = &reading->request->column[i];
    const Units units = units_of(reading, i);
    const CzUnit *unit = units.in_title != NULL ? units.in_title : units.in_row;
    const bool differs =
        units.in_title != NULL && units.in_row != NULL && units.in_title->si != units.in_row->si;
    double si = column->without;
    if (column->dimension == CZ_DIMENSION_NONE) {
        reading->points->unit[i] = 1.0;
        return true;
    }
    snprintf(reading->points->title[i], sizeof reading->points->title[i], "%s", units.title);
    if (column->unit != NULL) {
        const CzUnit *own = unit;
        unit = cz_curve_unit_find(column->dimension, column->unit);
        if (own != NULL && unit != NULL && own->si != unit->si)
            reading->points->other_unit[i] = own->suffix;
    } else if (differs)
        return refuse_unit(reading, column, &units);
    if (unit != NULL && unit->dimension == column->dimension)
        si = unit->si;
    else if (unit != NULL || !(si > 0.0) ||
             (column->unit == NULL && (units.has_unknown || ends_like_a_unit(units.title))))
        return refuse_unit(reading, column, &units);
    reading->points->unit[i] = column->in > 0.0 ? si / column->in : si;
    return true;
}

bool cz_reading_find_columns(CzCurveReading *reading) {
    int found[2], in_comment[2];
    if (find_titles(reading, false, found) || reading->titles != NULL) {
        memcpy(reading->index, found, sizeof found);
        return (found[0] >= 0 && found[1] >= 0 && found[0] != found[1]) ||
               refuse_titles(reading, found);
    }
    if (find_titles(reading, true, in_comment)) {
        memcpy(reading->index, in_comment, sizeof in_comment);
        return true;
    }
    return begin_without_titles(reading);
}

bool cz_reading_find_titles(CzCurveReading *reading) {
    int found[2];
    return find_titles(reading, false, found) || find_titles(reading, true, found);
}
