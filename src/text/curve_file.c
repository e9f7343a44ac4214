/* Curve files: the decimal sign, and the points. */
#include "text/curve_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "text/curve_dyna.h"
#include "text/curve_mme.h"
#include "text/curve_number.h"

enum { MAX_LINES = 1000000 };

/* ---- the decimal sign ---- */

/* Numbers that decide the decimal sign, or leave it open: the first of each kind. */
typedef struct Evidence {
    int line[CZ_SIGN_OPEN_COMMA + 1]; /* counted from 1; 0: none */
    CzField field[CZ_SIGN_OPEN_COMMA + 1];
} Evidence;

/* Evidence in the requested columns, or in all others. */
static Evidence collect(const CzCurveReading *reading, bool of_wanted) {
    Evidence evidence = {0};
    for (int line = cz_reading_next(reading, reading->data); line < reading->source.n_line;
         line = cz_reading_next(reading, line + 1)) {
        CzFieldWalk walk = cz_fields_begin(reading->source.line[line], reading->separator);
        while (cz_fields_next(&walk)) {
            const CzDecimalSign sign = cz_curve_number_sign(walk.field.text, walk.field.n);
            if ((cz_reading_column(reading, walk.n - 1) >= 0) != of_wanted ||
                evidence.line[sign] != 0)
                continue;
            evidence.line[sign] = line + 1;
            evidence.field[sign] = walk.field;
        }
    }
    return evidence;
}

/* Writes a number with a given decimal sign as a plain one, for a message. */
static void print_reading(const CzField *field, char decimal, char text[CZ_MAX_FIELD_TEXT]) {
    double value = 0.0;
    cz_curve_number_read(field->text, field->n, decimal, &value);
    snprintf(text, CZ_MAX_FIELD_TEXT, "%.10g", value);
    for (char *c = text; *c != '\0'; c++)
        *c = *c == ',' ? '.' : *c;
}

static bool refuse_open(const CzCurveReading *reading, const Evidence *evidence,
                        CzDecimalSign sign) {
    char text[CZ_MAX_FIELD_TEXT], point[CZ_MAX_FIELD_TEXT], comma[CZ_MAX_FIELD_TEXT];
    const CzField *field = &evidence->field[sign];
    print_reading(field, '.', point);
    print_reading(field, ',', comma);
    cz_mistake_at(reading->mistakes, &reading->source, evidence->line[sign], field->column,
                  "'%s' may be %s or %s: no number of the file shows the decimal sign" CZ_HELP
                  "%s%s'.' reads %s, ',' reads %s",
                  cz_field_text(field, text), point, comma,
                  reading->request->decimal_help != NULL ? reading->request->decimal_help : "",
                  reading->request->decimal_help != NULL ? ": " : "", point, comma);
    return false;
}

static bool refuse_both(const CzCurveReading *reading, const Evidence *evidence) {
    char point[CZ_MAX_FIELD_TEXT], comma[CZ_MAX_FIELD_TEXT];
    const bool comma_is_later = evidence->line[CZ_SIGN_COMMA] > evidence->line[CZ_SIGN_POINT];
    const CzDecimalSign later = comma_is_later ? CZ_SIGN_COMMA : CZ_SIGN_POINT;
    cz_mistake_at(
        reading->mistakes, &reading->source, evidence->line[later], evidence->field[later].column,
        "numbers have two decimal signs: '%s' in line %d and '%s' in line %d",
        cz_field_text(&evidence->field[CZ_SIGN_POINT], point), evidence->line[CZ_SIGN_POINT],
        cz_field_text(&evidence->field[CZ_SIGN_COMMA], comma), evidence->line[CZ_SIGN_COMMA]);
    return false;
}

/* Whether with a decimal sign all numbers are within the plausible range. */
static bool is_possible(const CzCurveReading *reading, char decimal) {
    for (int line = cz_reading_next(reading, reading->data); line < reading->source.n_line;
         line = cz_reading_next(reading, line + 1)) {
        CzFieldWalk walk = cz_fields_begin(reading->source.line[line], reading->separator);
        while (cz_fields_next(&walk)) {
            double value;
            const int i = cz_reading_column(reading, walk.n - 1);
            if (i >= 0 && reading->request->column[i].largest > 0.0 &&
                cz_curve_number_read(walk.field.text, walk.field.n, decimal, &value) &&
                fabs(value) * reading->points->unit[i] > reading->request->column[i].largest)
                return false;
        }
    }
    return true;
}

static bool find_decimal(CzCurveReading *reading) {
    reading->decimal = reading->request->decimal;
    if (reading->decimal != '\0')
        return true;
    const Evidence own = collect(reading, true);
    const bool point = own.line[CZ_SIGN_POINT] != 0, comma = own.line[CZ_SIGN_COMMA] != 0;
    const bool is_open = own.line[CZ_SIGN_OPEN_POINT] != 0 || own.line[CZ_SIGN_OPEN_COMMA] != 0;
    reading->decimal = comma ? ',' : '.';
    if (point && comma)
        return refuse_both(reading, &own);
    if (point || comma || !is_open)
        return true;

    /* The other columns may show it; where commas separate the fields, the decimal sign is a
     * point. */
    const Evidence others = collect(reading, false);
    const bool point_there = others.line[CZ_SIGN_POINT] != 0;
    const bool comma_there = others.line[CZ_SIGN_COMMA] != 0;
    reading->decimal = comma_there ? ',' : '.';
    if (point_there != comma_there)
        return true;
    const bool as_point = is_possible(reading, '.'), as_comma = is_possible(reading, ',');
    reading->decimal = as_comma ? ',' : '.';
    if (as_point != as_comma)
        return true;
    if (own.line[CZ_SIGN_OPEN_COMMA] != 0)
        return refuse_open(reading, &own, CZ_SIGN_OPEN_COMMA);
    reading->decimal = '.';
    return reading->separator == ',' || refuse_open(reading, &own, CZ_SIGN_OPEN_POINT);
}

/* ---- points ---- */

static bool is_not_finite(const char *text) {
    static const char *const words[] = {"nan",    "inf",  "infinity", "1.#qnan",
                                        "1.#inf", "#n/a", "#num!"};
    text += *text == '-' || *text == '+';
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcasecmp(text, words[i]) == 0)
            return true;
    return false;
}

static void refuse_number(const CzCurveReading *reading, int line, int i, const CzField *field) {
    char text[CZ_MAX_FIELD_TEXT];
    double value;
    const char *name = reading->request->column[i].title != NULL ? reading->request->column[i].title
                                                                 : reading->request->column[i].name;
    const char other = reading->decimal == '.' ? ',' : '.';
    const bool is_other = cz_curve_number_read(field->text, field->n, other, &value);
    const bool is_one = cz_curve_number_sign(field->text, field->n) != CZ_SIGN_NO_NUMBER;
    cz_field_text(field, text);
    if (field->n == 0)
        cz_mistake_at(reading->mistakes, &reading->source, line + 1, field->column,
                      "this line has no value of the %.60s", name);
    else
        cz_mistake_at(reading->mistakes, &reading->source, line + 1, field->column,
                      "%.60s: '%.60s' %s", name, text,
                      is_not_finite(text)                   ? "is not a finite number"
                      : is_other && reading->decimal == '.' ? "is not a number with a decimal point"
                      : is_other                            ? "is not a number with a decimal comma"
                      : is_one                              ? "is too large for a number"
                                                            : "is not a number");
    if (is_other)
        cz_mistake_help(reading->mistakes, reading->request->decimal_help);
}

/* A line with too many or too few fields: with decimal commas between commas both readings are
 * reported. */
static void refuse_count(const CzCurveReading *reading, int line, int n) {
    char other[60] = "the first point has";
    if (reading->titles != NULL)
        snprintf(other, sizeof other, "the titles in line %d have", reading->title_line + 1);
    cz_mistake_at(reading->mistakes, &reading->source, line + 1, 1,
                  "this line has %d %s, %s %d" CZ_HELP "%s", n, n == 1 ? "column" : "columns",
                  other, reading->n_field[0],
                  reading->separator == ',' && n > reading->n_field[0]
                      ? "commas separate columns here: numbers with decimal commas or grouped "
                        "thousands need quotes around them, or ';' between the columns"
                      : "a line that is neither a point nor a line of titles is skipped when it "
                        "begins with '#'");
}

/* Reads one line; an empty line of a table is skipped. */
static void read_point(CzCurveReading *reading, int line) {
    if (!cz_reading_has_whole_quotes(reading, line))
        return;
    CzFieldWalk walk = cz_fields_begin(reading->source.line[line], reading->separator);
    CzField wanted[2] = {{.text = "", .column = 1}, {.text = "", .column = 1}};
    int filled = 0;
    while (cz_fields_next(&walk)) {
        for (int i = 0; i < 2; i++)
            if (walk.n - 1 == reading->index[i])
                wanted[i] = walk.field;
        filled = walk.field.n > 0 ? walk.n : filled;
    }
    if (reading->n_field[0] == 0) {
        reading->n_field[0] = walk.n;
        reading->n_field[1] = filled;
    }
    if (filled > reading->n_field[0] || walk.n < reading->n_field[1]) {
        refuse_count(reading, line, walk.n);
        return;
    }
    if (wanted[0].n == 0 && wanted[1].n == 0 && filled > 0)
        return; /* a row with values in other columns only */
    double value[2];
    for (int i = 0; i < 2; i++)
        if (!cz_curve_number_read(wanted[i].text, wanted[i].n, reading->decimal, &value[i])) {
            refuse_number(reading, line, i, &wanted[i]);
            return;
        }
    CzCurvePoints *points = reading->points;
    points->x[points->n] = value[0] * points->unit[0];
    points->y[points->n] = value[1] * points->unit[1];
    points->line[points->n++] = line + 1;
}

static bool read_all_points(CzCurveReading *reading) {
    const int before = reading->mistakes->n_mistake, n_line = reading->source.n_line;
    if (reading->titles != NULL) {
        const CzFieldCount count = cz_fields_count(reading->titles, reading->separator);
        /* Columns after the last one of the first point may have titles and be empty. Where blanks
         * separate the fields an empty one cannot be detected, and later fields would take its
         * place. */
        const int line = cz_reading_next(reading, reading->data);
        const int n_first = cz_fields_count(reading->source.line[line], reading->separator).all;
        reading->n_field[0] = count.all;
        reading->n_field[1] =
            reading->separator != ' ' && n_first < count.filled ? n_first : count.filled;
    }
    for (int line = cz_reading_next(reading, reading->data); line < n_line;
         line = cz_reading_next(reading, line + 1))
        read_point(reading, line);
    if (reading->mistakes->n_mistake > before)
        return false;
    if (reading->points->n >= 2)
        return true;
    cz_mistake_at(reading->mistakes, &reading->source, n_line, 1,
                  "a curve needs at least two points, but this file has %d", reading->points->n);
    return false;
}

/* ---- the whole file ---- */

static bool make_room(CzArena *arena, int n, CzCurvePoints *points) {
    points->x = cz_arena_allocate(arena, (size_t)n, sizeof *points->x);
    points->y = cz_arena_allocate(arena, (size_t)n, sizeof *points->y);
    points->line = cz_arena_allocate(arena, (size_t)n, sizeof *points->line);
    return points->x != NULL && points->y != NULL && points->line != NULL;
}

/* Finds lines and separator. */
static bool begin(CzArena *arena, const char *text, size_t n_byte, CzCurveReading *reading) {
    if (!cz_curve_lines(arena, reading->mistakes, text, n_byte, &reading->source))
        return false;
    if (reading->source.n_line > MAX_LINES) {
        cz_mistake_at(reading->mistakes, &reading->source, MAX_LINES, 1,
                      "a curve has at most %d lines", (int)MAX_LINES);
        return false;
    }
    if (!cz_reading_list_lines(arena, reading))
        return false;
    const char announced = cz_line_announced_separator(reading->source.line[0]);
    reading->first = announced != '\0';
    if (reading->separator == '\0')
        reading->separator = announced;
    if (reading->separator == '\0')
        reading->separator = cz_fields_separator(&reading->source);
    return true;
}

/* Reads the text of `source`, whose lines become those of the converted text: UTF-8, whatever the
 * encoding of the file. */
static bool read_points(CzMistakes *mistakes, CzSource *source, const char *text, size_t n_byte,
                        const CzCurveRequest *request, CzCurvePoints *points) {
    CzArena *arena = mistakes->arena;
    CzCurveReading reading = {.mistakes = mistakes,
                              .source = *source,
                              .request = request,
                              .points = points,
                              .separator = request->separator};
    *points = (CzCurvePoints){.source = source};
    const bool has_begun = begin(arena, text, n_byte, &reading);
    source->line = reading.source.line;
    source->n_line = reading.source.n_line;
    if (has_begun && cz_dyna_is(&reading.source))
        return make_room(arena, reading.source.n_line, points) && cz_dyna_read(&reading);
    if (has_begun && cz_mme_is_channel(&reading.source))
        return make_room(arena, reading.source.n_line, points) && cz_mme_read_channel(&reading);
    return has_begun && cz_reading_find_columns(&reading) && cz_reading_find_unit(&reading, 0) &&
           cz_reading_find_unit(&reading, 1) && find_decimal(&reading) &&
           make_room(arena, reading.source.n_line, points) && read_all_points(&reading);
}

bool cz_curve_points_read(CzSources *sources, CzMistakes *mistakes, const char *path,
                          const CzNode *place, const CzCurveRequest *request,
                          CzCurvePoints *points) {
    char *text = NULL;
    size_t n_byte = 0;
    if (cz_mme_is_test(path))
        path = cz_mme_find_channel(sources, mistakes, path, place, request);
    if (path == NULL)
        return false;
    CzSource *source = cz_sources_read(sources, mistakes, path, place, &text, &n_byte);
    const bool is_read =
        source != NULL && read_points(mistakes, source, text, n_byte, request, points);
    free(text);
    return is_read;
}

static CzStatus finish(CzMistakes *mistakes, const char *name, CzError *error) {
    cz_mistakes_finish(mistakes);
    return cz_mistakes_status(mistakes, name, error);
}

CzStatus cz_curve_points_read_memory(CzArena *arena, const char *name, const char *text,
                                     size_t n_byte, const CzCurveRequest *request,
                                     CzCurvePoints *points, CzError *error) {
    CzMistakes mistakes = {.arena = arena};
    CzSources sources = {.arena = arena, .hash = CZ_HASH_START};
    CzSource *source = cz_sources_add(&sources, name, ".", "", 0);
    if (source != NULL)
        read_points(&mistakes, source, text, n_byte, request, points);
    return finish(&mistakes, name, error);
}

CzStatus cz_curve_points_read_file(CzArena *arena, const char *path, const CzCurveRequest *request,
                                   CzCurvePoints *points, CzError *error) {
    CzMistakes mistakes = {.arena = arena};
    CzSources sources = {.arena = arena, .hash = CZ_HASH_START};
    cz_curve_points_read(&sources, &mistakes, path, NULL, request, points);
    return finish(&mistakes, path, error);
}

CzStatus cz_curve_titles_read(CzArena *arena, const char *path, char *separator,
                              const char **titles, CzError *error) {
    static const CzCurveRequest any = {.column = {{.title = "1"}, {.title = "2"}}};
    CzMistakes mistakes = {.arena = arena};
    CzSources sources = {.arena = arena, .hash = CZ_HASH_START};
    char *text = NULL;
    size_t n_byte = 0;
    if (cz_mme_is_test(path)) {
        *separator = '\t';
        *titles = cz_mme_titles(&sources, &mistakes, path);
        return finish(&mistakes, path, error);
    }
    const CzSource *source = cz_sources_read(&sources, &mistakes, path, NULL, &text, &n_byte);
    CzCurveReading reading = {.mistakes = &mistakes, .request = &any, .separator = *separator};
    if (source != NULL)
        reading.source = *source;
    if (source != NULL && begin(arena, text, n_byte, &reading) && !cz_reading_find_titles(&reading))
        cz_mistake_at(&mistakes, &reading.source, 1, 1,
                      "this file has no line of titles with two columns of numbers below it");
    *separator = reading.separator;
    *titles = reading.titles;
    free(text);
    return finish(&mistakes, path, error);
}
