/* A curve from a CSV file: which columns, in which units, line by line. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"
#include "fit/trace.h"
#include "problem/keys.h"
#include "problem/source.h"

enum { MOST_LINES = 1000000, LONGEST_FIELD = 200 };

/* One of the two columns. */
typedef struct Column {
    const char *stem; /* "stroke" or "force" */
    CzDimension dimension;
    const char *wanted; /* title or number; NULL: by the stem */
    const char *unit_text;
    int index; /* counted from 0 */
    const CzUnit *unit;
} Column;

typedef struct Reader {
    CzArena *arena;
    const CzFitOptions *options;
    CzMistakes *mistakes;
    const CzSource *source;
    Column column[2];
    int n_field; /* of every line, as in the first */
    CzTrace *trace;
} Reader;

/* ---- fields ---- */

typedef struct Field {
    char text[LONGEST_FIELD + 1];
    int column; /* in the line, counted from 1 */
} Field;

static char separator_of(const Reader *reader, const char *line) {
    if (reader->options->separator != 0)
        return reader->options->separator;
    return strchr(line, ';') != NULL ? ';' : ',';
}

/* End of the field that begins at `at`: the next separator outside quotes. */
static const char *field_end(const char *at, char separator) {
    bool in_quotes = false;
    for (; *at != '\0' && (in_quotes || *at != separator); at++)
        in_quotes ^= *at == '"';
    return at;
}

static int count_fields(const char *line, char separator) {
    int n = 1;
    for (const char *at = field_end(line, separator); *at != '\0';
         at = field_end(at + 1, separator))
        n++;
    return n;
}

/* The index-th field of a line, without spaces and quotes around it. */
static Field take_field(const Reader *reader, const char *line, int index) {
    const char separator = separator_of(reader, line);
    const char *start = line, *end = field_end(start, separator);
    for (int i = 0; i < index && *end != '\0'; i++) {
        start = end + 1;
        end = field_end(start, separator);
    }
    while (start < end && (*start == ' ' || *start == '\t' || *start == '"'))
        start++;
    while (end > start && strchr(" \t\r\"", end[-1]) != NULL)
        end--;
    Field field = {.column = (int)(start - line) + 1};
    const size_t n = (size_t)(end - start) < LONGEST_FIELD ? (size_t)(end - start) : LONGEST_FIELD;
    memcpy(field.text, start, n);
    return field;
}

/* Reads a number with the file's decimal sign; NULL or what is wrong. */
static const char *parse(const Reader *reader, const Field *field, double *value) {
    char text[LONGEST_FIELD + 1];
    memcpy(text, field->text, sizeof text);
    char *comma = reader->options->decimal == ',' ? strchr(text, ',') : NULL;
    if (comma != NULL)
        *comma = '.';
    return cz_number_parse(text, value);
}

static bool is_blank(const char *line) {
    return line[strspn(line, " \t\r")] == '\0' || line[0] == '#';
}

/* ---- columns ---- */

/* Unit in a title: behind the last '_' of stem_unit, or in brackets. */
static const CzUnit *unit_in(const Column *column, const char *text) {
    char unit[16] = "", title[LONGEST_FIELD + 1];
    snprintf(title, sizeof title, "%s", text);
    for (char *c = title; *c != '\0'; c++) /* km/h is km_h in keys */
        *c = *c == '/' ? '_' : *c;
    const size_t n = strlen(column->stem);
    const char *open = strpbrk(title, "[("), *close = open != NULL ? strpbrk(open, "])") : NULL;
    const CzUnit *found = NULL; /* a unit may have a '_' of its own: the longest counts */
    for (const char *at = strchr(title, '_'); at != NULL && found == NULL; at = strchr(at + 1, '_'))
        found = cz_unit_find(column->dimension, at + 1);
    if (strncmp(title, column->stem, n) == 0 && title[n] == '_')
        snprintf(unit, sizeof unit, "%.15s", title + n + 1);
    else if (close != NULL)
        snprintf(unit, sizeof unit, "%.*s", (int)(close - open - 1), open + 1);
    else if (found != NULL)
        return found;
    return cz_unit_find(column->dimension, unit);
}

static bool matches(const Column *column, const char *title) {
    const size_t n = strlen(column->stem);
    if (column->wanted != NULL)
        return strcmp(title, column->wanted) == 0;
    if (strncmp(title, column->stem, n) != 0)
        return false;
    return title[n] == '\0' || title[n] == '_' || title[n] == ' ';
}

/* Number of a column that was asked for by its number, -1 for a title. */
static int index_wanted(const Column *column) {
    char *end = NULL;
    const long number = column->wanted != NULL ? strtol(column->wanted, &end, 10) : 0;
    return end != NULL && *end == '\0' && number >= 1 && number < 10000 ? (int)number - 1 : -1;
}

static bool find_column(Reader *reader, Column *column, int line, bool has_titles) {
    const char *text = reader->source->line[line];
    char spellings[120];
    cz_key_spellings(spellings, sizeof spellings, column->stem, column->dimension);
    column->index = index_wanted(column);
    for (int i = 0; column->index < 0 && has_titles && i < reader->n_field; i++)
        if (matches(column, take_field(reader, text, i).text))
            column->index = i;
    if (column->index < 0 || column->index >= reader->n_field) {
        cz_mistake_at(reader->mistakes, reader->source, line + 1, 1,
                      column->wanted != NULL ? "there is no column '%.60s' among the %d of the file"
                                             : "no column is named %s (of %d)",
                      column->wanted != NULL ? column->wanted : spellings, reader->n_field);
        if (reader->trace->is_of_force)
            cz_mistake_help(reader->mistakes, "--%s TITLE or --%s NUMBER says which column it is",
                            column->stem, column->stem);
        return false;
    }
    const Field title = take_field(reader, text, column->index);
    column->unit = column->unit_text != NULL ? cz_unit_find(column->dimension, column->unit_text)
                   : has_titles              ? unit_in(column, title.text)
                                             : NULL;
    if (column->unit != NULL)
        return true;
    cz_mistake_at(reader->mistakes, reader->source, line + 1, title.column,
                  column->unit_text != NULL ? "'%.60s' is no unit of a %s"
                                            : "the unit of column '%.60s', the %s, is not known",
                  column->unit_text != NULL ? column->unit_text : title.text, column->stem);
    if (reader->trace->is_of_force)
        cz_mistake_help(reader->mistakes, "columns are named %s, or --%s-unit says the unit",
                        spellings, column->stem);
    else
        cz_mistake_help(reader->mistakes, "its title ends in a unit, such as %s", spellings);
    return false;
}

/* Takes the first line: titles, or numbers when the options say what they are. */
static bool take_titles(Reader *reader, int line, bool *has_titles) {
    double number;
    const char *text = reader->source->line[line];
    reader->n_field = count_fields(text, separator_of(reader, text));
    if (reader->n_field < 2) {
        cz_mistake_at(reader->mistakes, reader->source, line + 1, 1,
                      "a curve has two columns, stroke and force, but this line has one");
        return false;
    }
    const Field first = take_field(reader, text, 0);
    *has_titles = parse(reader, &first, &number) != NULL;
    return find_column(reader, &reader->column[0], line, *has_titles) &&
           find_column(reader, &reader->column[1], line, *has_titles);
}

/* ---- points ---- */

static void take_point(Reader *reader, int line) {
    const char *text = reader->source->line[line];
    const int n_field = count_fields(text, separator_of(reader, text));
    double value[2] = {0.0, 0.0};
    if (n_field != reader->n_field) {
        cz_mistake_at(reader->mistakes, reader->source, line + 1, 1,
                      "this line has %d columns, the first one has %d", n_field, reader->n_field);
        cz_mistake_help(reader->mistakes,
                        "with decimal commas: --csv-decimal ',', and ';' between the columns");
        return;
    }
    for (int i = 0; i < 2; i++) {
        const Field field = take_field(reader, text, reader->column[i].index);
        const char *wrong = parse(reader, &field, &value[i]);
        if (wrong != NULL) {
            cz_mistake_at(reader->mistakes, reader->source, line + 1, field.column,
                          "%s: '%.60s' %s", reader->column[i].stem, field.text, wrong);
            if (strchr(field.text, ',') != NULL)
                cz_mistake_help(reader->mistakes, "--csv-decimal ',' reads decimal commas");
            return;
        }
        value[i] *= reader->column[i].unit->si;
    }
    CzTrace *trace = reader->trace;
    trace->x[trace->n] = value[0];
    trace->f[trace->n] = value[1];
    trace->line[trace->n++] = line + 1;
}

static void take_lines(Reader *reader) {
    bool has_any = false, has_titles = false;
    for (int line = 0; line < reader->source->n_line; line++) {
        if (is_blank(reader->source->line[line]))
            continue;
        if (!has_any && !take_titles(reader, line, &has_titles))
            return;
        if (has_any || !has_titles)
            take_point(reader, line);
        has_any = true;
    }
    if (reader->mistakes->n_mistake == 0 && reader->trace->n < 2)
        cz_mistake_at(reader->mistakes, reader->source, reader->source->n_line, 1,
                      "a curve has two points or more, but this file has %d", reader->trace->n);
}

static bool make_room(CzArena *arena, int n, CzTrace *trace) {
    trace->x = cz_arena_allocate(arena, (size_t)n, sizeof *trace->x);
    trace->f = cz_arena_allocate(arena, (size_t)n, sizeof *trace->f);
    trace->line = cz_arena_allocate(arena, (size_t)n, sizeof *trace->line);
    return trace->x != NULL && trace->f != NULL && trace->line != NULL;
}

/* Reads the file into lines; nothing but mistakes when it is no text. */
static bool read_lines(Reader *reader, CzSources *sources, const char *path) {
    char *text = NULL;
    size_t n_byte = 0;
    reader->source = cz_sources_read(sources, reader->mistakes, path, NULL, &text, &n_byte);
    const bool is_text =
        reader->source != NULL && cz_source_is_text(reader->mistakes, reader->source, text, n_byte);
    free(text);
    return is_text;
}

static void read_source(Reader *reader, CzSources *sources, const char *path) {
    if (!read_lines(reader, sources, path))
        return;
    if (reader->source->n_line > MOST_LINES)
        cz_mistake_at(reader->mistakes, reader->source, MOST_LINES, 1,
                      "a curve has at most %d lines", (int)MOST_LINES);
    else if (make_room(reader->arena, reader->source->n_line, reader->trace))
        take_lines(reader);
}

/* What the reading ends with. */
static CzStatus finish(Reader *reader, const char *path, CzError *error) {
    if (reader->arena->out_of_memory)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the curve of '%s'", path);
    cz_mistakes_finish(reader->mistakes);
    if (reader->mistakes->n_mistake == 0)
        return CZ_OK;
    if (error != NULL)
        *error = reader->mistakes->mistake[0]->error;
    return CZ_STATUS_INPUT;
}

static CzStatus read_trace(Reader *reader, const char *path, CzError *error) {
    CzMistakes mistakes = {.arena = reader->arena};
    CzSources sources = {.arena = reader->arena, .hash = CZ_HASH_START};
    reader->mistakes = &mistakes;
    read_source(reader, &sources, path);
    return finish(reader, path, error);
}

CzStatus cz_trace_read(CzArena *arena, const char *path, const CzFitOptions *options,
                       CzTrace *trace, CzError *error) {
    Reader reader = {
        .arena = arena,
        .options = options,
        .column = {{"stroke", CZ_DIMENSION_LENGTH, options->stroke, options->stroke_unit, -1, NULL},
                   {"force", CZ_DIMENSION_FORCE, options->force, options->force_unit, -1, NULL}},
        .trace = trace,
    };
    trace->is_of_force = true;
    CZ_TRY(read_trace(&reader, path, error));
    return cz_trace_check(trace, reader.source->name, error);
}

/* The dimension of a quantity's name; without one a curve has none. */
static CzDimension dimension_named(const char *quantity) {
    CzDimension dimension = 0;
    while (dimension < CZ_N_DIMENSION && strcmp(cz_dimension_text[dimension], quantity) != 0)
        dimension++;
    return dimension < CZ_N_DIMENSION ? dimension : CZ_DIMENSION_NONE;
}

CzStatus cz_trace_read_columns(CzArena *arena, const char *path, const CzCurveColumns *columns,
                               CzTrace *trace, CzError *error) {
    const CzFitOptions options = {.separator = columns->separator, .decimal = columns->decimal};
    Reader reader = {
        .arena = arena,
        .options = &options,
        .column = {{columns->x_quantity, dimension_named(columns->x_quantity), columns->x, NULL, -1,
                    NULL},
                   {columns->y_quantity, dimension_named(columns->y_quantity), columns->y, NULL, -1,
                    NULL}},
        .trace = trace,
    };
    return read_trace(&reader, path, error);
}

/* ---- titles ---- */

/* The fields of a line as texts behind their pointers, in one block; NULL without memory. */
static char **fields_of(const Reader *reader, const char *line, int n) {
    size_t n_byte = 0;
    for (int i = 0; i < n; i++)
        n_byte += strlen(take_field(reader, line, i).text) + 1;
    char **field = malloc((size_t)n * sizeof *field + n_byte);
    char *text = field != NULL ? (char *)(field + n) : NULL;
    for (int i = 0; field != NULL && i < n; i++) {
        const Field taken = take_field(reader, line, i);
        field[i] = strcpy(text, taken.text);
        text += strlen(taken.text) + 1;
    }
    return field;
}

CzStatus cz_curve_titles(const char *path, char separator, int *n, char ***title, CzError *error) {
    const CzFitOptions options = {.separator = separator, .decimal = '.'};
    CzArena arena = {0};
    CzMistakes mistakes = {.arena = &arena};
    CzSources sources = {.arena = &arena, .hash = CZ_HASH_START};
    Reader reader = {.arena = &arena, .options = &options, .mistakes = &mistakes};
    *n = 0;
    *title = NULL;
    int first = 0;
    if (read_lines(&reader, &sources, path)) {
        while (first < reader.source->n_line && is_blank(reader.source->line[first]))
            first++;
        if (first == reader.source->n_line)
            cz_mistake_at(&mistakes, reader.source, first, 1, "this file has no line of titles");
    }
    CzStatus status = finish(&reader, path, error);
    if (status == CZ_OK) {
        const char *line = reader.source->line[first];
        *n = count_fields(line, separator_of(&reader, line));
        *title = fields_of(&reader, line, *n);
        if (*title == NULL)
            status = cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the titles of '%s'", path);
    }
    cz_arena_free(&arena);
    return status;
}
