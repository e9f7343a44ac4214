/* Curves of LS-DYNA keyword files. */
#include "text/curve_dyna.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "text/curve_number.h"

enum { CARD_FIELD = 10, POINT_FIELD = 20, N_CARD_FIELD = 6, MAX_CURVES = 1000 };

/* A curve of the file. Lines are counted from 0. */
typedef struct Definition {
    int keyword, card, end; /* line of the keyword, of the first card, and behind the curve */
    char title[CZ_MAX_FIELD_TEXT]; /* empty when it has none */
    char number[CZ_MAX_FIELD_TEXT];
} Definition;

/* ---- lines ---- */

static bool is_comment(const char *line) {
    return line[0] == '$';
}

/* Whether a line is the keyword, or begins with it; upper and lower case are one. */
static bool is_keyword(const char *line, const char *keyword, bool begins) {
    const size_t n = strlen(keyword);
    return strncasecmp(line, keyword, n) == 0 &&
           (begins || line[n + strspn(line + n, " \t")] == '\0');
}

static bool is_curve(const char *line) {
    return is_keyword(line, "*DEFINE_CURVE", false) ||
           is_keyword(line, "*DEFINE_CURVE_TITLE", false);
}

bool cz_dyna_is(const CzSource *source) {
    for (int line = 0; line < source->n_line; line++)
        if (is_keyword(source->line[line], "*DEFINE_CURVE", true))
            return true;
    return false;
}

/* The next line, not before `line`, that is not a comment. */
static int next_card(const CzSource *source, int line, int end) {
    while (line < end && is_comment(source->line[line]))
        line++;
    return line;
}

/* The field of a card: of a fixed width, or between commas where the line has one. False behind the
 * last one. */
static bool take_field(const char *line, int index, int width, CzField *field) {
    if (strchr(line, ',') != NULL)
        return cz_field_take(line, ',', index, field);
    const size_t n = strlen(line), begin = (size_t)(index * width);
    const size_t first = begin < n ? begin : n;
    *field = (CzField){line + first, 0, (int)first + 1};
    if (first == n)
        return false;
    field->n = n - first < (size_t)width ? n - first : (size_t)width;
    for (; field->n > 0 && isspace((unsigned char)*field->text); field->n--) {
        field->text++;
        field->column++;
    }
    while (field->n > 0 && isspace((unsigned char)field->text[field->n - 1]))
        field->n--;
    return true;
}

static void copy_trimmed(char text[CZ_MAX_FIELD_TEXT], const char *line) {
    const size_t blank = strspn(line, " \t");
    size_t n = strlen(line + blank);
    while (n > 0 && isspace((unsigned char)line[blank + n - 1]))
        n--;
    cz_field_text(&(CzField){line + blank, n, 1}, text);
}

/* ---- the curves of the file ---- */

static Definition definition_at(const CzSource *source, int keyword) {
    Definition made = {.keyword = keyword, .end = keyword + 1};
    CzField field;
    while (made.end < source->n_line && source->line[made.end][0] != '*')
        made.end++;
    made.card = next_card(source, keyword + 1, made.end);
    if (is_keyword(source->line[keyword], "*DEFINE_CURVE_TITLE", false) && made.card < made.end) {
        copy_trimmed(made.title, source->line[made.card]);
        made.card = next_card(source, made.card + 1, made.end);
    }
    if (made.card < made.end && take_field(source->line[made.card], 0, CARD_FIELD, &field))
        cz_field_text(&field, made.number);
    return made;
}

/* The next curve, not before `line`; false when there is none. */
static bool next_definition(const CzSource *source, int line, Definition *definition) {
    while (line < source->n_line && !is_curve(source->line[line]))
        line++;
    if (line < source->n_line)
        *definition = definition_at(source, line);
    return line < source->n_line;
}

/* Whether a curve is requested: by its title, or by its number as "lcid 12", either with a unit
 * behind it. */
static bool is_wanted(const Definition *definition, const char *wanted) {
    static const char word[] = "lcid ";
    size_t n;
    (void)cz_curve_unit_of_title(wanted, &n);
    const size_t n_whole = strlen(wanted), n_word = sizeof word - 1;
    if (definition->title[0] != '\0' &&
        (strcmp(definition->title, wanted) == 0 ||
         (strlen(definition->title) == n && strncmp(definition->title, wanted, n) == 0)))
        return true;
    if (strncasecmp(wanted, word, n_word) != 0)
        return false;
    const char *number = definition->number;
    return strcmp(number, wanted + n_word) == 0 ||
           (n < n_whole && n > n_word && strlen(number) == n - n_word &&
            strncmp(number, wanted + n_word, n - n_word) == 0);
}

/* Writes "lcid 1 'tube', lcid 2". */
static void list_curves(const CzSource *source, char *text, size_t size) {
    Definition definition = {0};
    size_t n = 0;
    text[0] = '\0';
    while (next_definition(source, definition.end, &definition) && n + 60 < size) {
        const bool has_title = definition.title[0] != '\0';
        n += (size_t)snprintf(text + n, size - n, "%slcid %.10s%s%.30s%s", n > 0 ? ", " : "",
                              definition.number, has_title ? " '" : "", definition.title,
                              has_title ? "'" : "");
    }
}

static bool refuse_all(const CzCurveReading *reading) {
    int line = 0;
    while (!is_keyword(reading->source.line[line], "*DEFINE_CURVE", true))
        line++;
    cz_mistake_at(reading->mistakes, &reading->source, line + 1, 1,
                  "'%.60s' is not read; curves are *DEFINE_CURVE and *DEFINE_CURVE_TITLE with "
                  "fields of normal width, or with commas",
                  reading->source.line[line]);
    return false;
}

/* Finds the curve that is requested, or the only one. */
static bool find_definition(const CzCurveReading *reading, Definition *definition) {
    const CzSource *source = &reading->source;
    const CzCurveColumn *column = &reading->request->column[1];
    const char *wanted = cz_curve_column_number(column) >= 0 ? NULL : column->title;
    Definition at = {0};
    int n = 0, n_wanted = 0;
    for (; next_definition(source, at.end, &at); n++) {
        const bool takes = wanted != NULL && is_wanted(&at, wanted);
        n_wanted += takes;
        if (takes || n == 0)
            *definition = at;
    }
    if (n == 0)
        return refuse_all(reading);
    /* The only curve has the title that a request gives it: a title with a unit. */
    if (n_wanted == 1 || (n_wanted == 0 && n == 1 &&
                          (wanted == NULL || cz_curve_unit_of_title(wanted, NULL) != NULL)))
        return true;
    char list[300];
    list_curves(source, list, sizeof list);
    if (wanted == NULL)
        cz_mistake_at(reading->mistakes, source, definition->keyword + 1, 1,
                      "this file has %d curves: %s; one must be named as the column of the %s", n,
                      list, column->name);
    else
        cz_mistake_at(reading->mistakes, source, definition->keyword + 1, 1,
                      "%s curve is '%.60s'; the curves are %s",
                      n_wanted > 1 ? "more than one" : "no", wanted, list);
    cz_mistake_help(reading->mistakes, reading->request->column_help);
    return false;
}

/* ---- cards ---- */

/* Reads a field that is a number; a blank one keeps the value. */
static bool read_number(const CzCurveReading *reading, int line, const CzField *field,
                        const char *name, double *value) {
    char text[CZ_MAX_FIELD_TEXT];
    if (field->n == 0 || cz_curve_number_read(field->text, field->n, '.', value))
        return true;
    const bool has_blank = memchr(field->text, ' ', field->n) != NULL;
    cz_mistake_at(reading->mistakes, &reading->source, line + 1, field->column,
                  "%s: '%.60s' is not a number%s", name, cz_field_text(field, text),
                  has_blank ? CZ_HELP "fields have a fixed width, 10 characters in the first card "
                                      "and 20 in the others, or commas between them"
                            : "");
    return false;
}

/* Scale and offset of both axes, from the first card. */
static bool read_card(const CzCurveReading *reading, const Definition *definition, double scale[2],
                      double offset[2]) {
    static const char *const names[N_CARD_FIELD] = {"LCID", "SIDR", "SFA", "SFO", "OFFA", "OFFO"};
    double value[N_CARD_FIELD] = {0};
    bool is_read = true;
    if (definition->card >= definition->end) {
        cz_mistake_at(reading->mistakes, &reading->source, definition->keyword + 1, 1,
                      "this curve has no card with its number");
        return false;
    }
    for (int i = 0; i < N_CARD_FIELD; i++) {
        CzField field;
        if (take_field(reading->source.line[definition->card], i, CARD_FIELD, &field))
            is_read &= read_number(reading, definition->card, &field, names[i], &value[i]);
    }
    for (int i = 0; i < 2; i++) {
        scale[i] = value[2 + i] != 0.0 ? value[2 + i] : 1.0;
        offset[i] = value[4 + i];
    }
    return is_read;
}

/* Reads one point. */
static bool read_point(CzCurveReading *reading, int line, const double scale[2],
                       const double offset[2]) {
    static const char *const names[2] = {"abscissa", "ordinate"};
    const char *text = reading->source.line[line];
    CzCurvePoints *points = reading->points;
    double value[2];
    CzField field;
    for (int i = 0; i < 2; i++) {
        const bool has_value = take_field(text, i, POINT_FIELD, &field) && field.n > 0;
        if (!has_value)
            cz_mistake_at(reading->mistakes, &reading->source, line + 1, field.column,
                          "this point has no %s", names[i]);
        if (!has_value || !read_number(reading, line, &field, names[i], &value[i]))
            return false;
    }
    if (take_field(text, 2, POINT_FIELD, &field) && field.n > 0) {
        cz_mistake_at(reading->mistakes, &reading->source, line + 1, field.column,
                      "a point is an abscissa and an ordinate, but this line has more");
        return false;
    }
    points->x[points->n] = scale[0] * (value[0] + offset[0]) * points->unit[0];
    points->y[points->n] = scale[1] * (value[1] + offset[1]) * points->unit[1];
    points->line[points->n++] = line + 1;
    return true;
}

static bool read_points(CzCurveReading *reading, const Definition *definition) {
    double scale[2], offset[2];
    if (!read_card(reading, definition, scale, offset))
        return false;
    const CzSource *source = &reading->source;
    bool is_read = true;
    for (int line = definition->card + 1; line < definition->end; line++)
        if (!is_comment(source->line[line]) && !cz_line_is_empty(source->line[line]))
            is_read &= read_point(reading, line, scale, offset);
    if (is_read && reading->points->n < 2)
        cz_mistake_at(reading->mistakes, source, definition->keyword + 1, 1,
                      "a curve needs at least two points, but this one has %d", reading->points->n);
    return is_read && reading->points->n >= 2;
}

/* ---- titles and units ---- */

/* Takes a comment of the curve as titles when it has two columns that end in units. */
static void find_titles(CzCurveReading *reading, const Definition *definition) {
    for (int line = definition->keyword; line < definition->end; line++) {
        const char *text = reading->source.line[line];
        if (!is_comment(text))
            continue;
        text += 1 + (text[1] == '#');
        const char separator = strchr(text, ',') != NULL ? ',' : ' ';
        char title[CZ_MAX_FIELD_TEXT];
        CzField field;
        bool has_units = cz_fields_count(text, separator).filled == 2;
        for (int i = 0; i < 2 && has_units; i++)
            has_units = cz_field_take(text, separator, i, &field) &&
                        cz_curve_unit_of_title(cz_field_text(&field, title), NULL) != NULL;
        if (!has_units)
            continue;
        reading->titles = text;
        reading->title_line = line;
        reading->separator = separator;
        return;
    }
}

bool cz_dyna_read(CzCurveReading *reading) {
    Definition definition = {0};
    if (!find_definition(reading, &definition))
        return false;
    reading->index[0] = 0;
    reading->index[1] = 1;
    reading->data = definition.keyword;
    find_titles(reading, &definition);
    reading->names_columns = reading->titles == NULL;
    if (!cz_reading_find_unit(reading, 0) || !cz_reading_find_unit(reading, 1) ||
        !read_points(reading, &definition))
        return false;
    if (definition.title[0] != '\0')
        memcpy(reading->points->title[1], definition.title, sizeof definition.title);
    return true;
}
