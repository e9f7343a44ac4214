/* Histories of test folders in ISO-MME. */
#include "text/curve_mme.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "text/curve_number.h"

/* ---- lines "KEY :VALUE" ---- */

/* The value of a line with this key, whose name ends at a colon; false for another line. */
static bool take_value(const char *line, const char *key, CzField *value) {
    const size_t n = strlen(key);
    if (strncasecmp(line, key, n) != 0)
        return false;
    const char *at = line + n + strspn(line + n, " \t");
    if (*at != ':')
        return false;
    at += 1 + strspn(at + 1, " \t");
    size_t end = strlen(at);
    while (end > 0 && isspace((unsigned char)at[end - 1]))
        end--;
    *value = (CzField){at, end, (int)(at - line) + 1};
    return true;
}

/* A value that is not given. */
static bool is_no_value(const CzField *field) {
    return field->n == 0 || (field->n == 7 && strncasecmp(field->text, "NOVALUE", 7) == 0);
}

/* The line of a key in the first n lines, from 0, with its value; -1 when it has none. */
static int find_key(const CzSource *source, int n, const char *key, CzField *value) {
    for (int line = 0; line < n; line++)
        if (take_value(source->line[line], key, value))
            return is_no_value(value) ? -1 : line;
    return -1;
}

/* Number of lines before the values. */
static int n_head(const CzSource *source) {
    int line = 0;
    while (line < source->n_line &&
           (strchr(source->line[line], ':') != NULL || cz_line_is_empty(source->line[line])))
        line++;
    return line;
}

/* ---- a channel ---- */

bool cz_mme_is_channel(const CzSource *source) {
    CzField value;
    const int n = n_head(source);
    return find_key(source, n, "Channel code", &value) >= 0 &&
           (find_key(source, n, "Sampling interval", &value) >= 0 ||
            find_key(source, n, "Reference channel", &value) >= 0);
}

/* Reads a number of the head; a mistake when it has none. */
static bool read_key(const CzCurveReading *reading, int n, const char *key, double *number) {
    CzField value;
    char text[CZ_MAX_FIELD_TEXT];
    const int line = find_key(&reading->source, n, key, &value);
    if (line >= 0 && cz_curve_number_read(value.text, value.n, '.', number))
        return true;
    if (line < 0)
        cz_mistake_at(reading->mistakes, &reading->source, 1, 1, "the channel has no '%s'", key);
    else
        cz_mistake_at(reading->mistakes, &reading->source, line + 1, value.column,
                      "%s: '%.60s' is not a number", key, cz_field_text(&value, text));
    return false;
}

/* Finds the times: those of the first sample and between two of them. */
static bool read_times(const CzCurveReading *reading, int n, double *first, double *interval) {
    CzField value;
    const CzCurveColumn *column = &reading->request->column[0];
    const int line = find_key(&reading->source, n, "Reference channel", &value);
    if (column->dimension != CZ_DIMENSION_TIME && column->dimension != CZ_DIMENSION_NONE) {
        cz_mistake_at(reading->mistakes, &reading->source, 1, 1,
                      "a channel is a history over time, not over the %s", column->name);
        return false;
    }
    if (line >= 0 && (value.n != 8 || strncasecmp(value.text, "implicit", 8) != 0)) {
        cz_mistake_at(reading->mistakes, &reading->source, line + 1, value.column,
                      "the times of this channel are in another channel" CZ_HELP
                      "channels with equidistant samples are read, whose reference channel is "
                      "implicit");
        return false;
    }
    if (!read_key(reading, n, "Sampling interval", interval) ||
        !read_key(reading, n, "Time of first sample", first))
        return false;
    if (*interval > 0.0)
        return true;
    const int at = find_key(&reading->source, n, "Sampling interval", &value);
    cz_mistake_at(reading->mistakes, &reading->source, at + 1, value.column,
                  "the sampling interval must be above 0 s");
    return false;
}

/* Finds the unit of the values. */
static bool read_unit(const CzCurveReading *reading, int n) {
    const CzCurveColumn *column = &reading->request->column[1];
    CzCurvePoints *points = reading->points;
    CzField value = {.text = "", .column = 1};
    char text[CZ_MAX_FIELD_TEXT], list[120];
    const int line = find_key(&reading->source, n, "Unit", &value);
    const CzUnit *own =
        line >= 0 ? cz_curve_unit_find(CZ_N_DIMENSION, cz_field_text(&value, text)) : NULL;
    const CzUnit *unit = own;
    double si = line < 0 ? column->without : 0.0;
    points->unit[1] = 1.0;
    if (column->dimension == CZ_DIMENSION_NONE)
        return true;
    if (column->unit != NULL)
        unit = cz_curve_unit_find(column->dimension, column->unit);
    if (unit != NULL && own != NULL && unit->si != own->si)
        points->other_unit[1] = own->suffix;
    if (unit != NULL && unit->dimension == column->dimension)
        si = unit->si;
    points->unit[1] = column->in > 0.0 ? si / column->in : si;
    if (si > 0.0)
        return true;
    cz_curve_unit_list(column->dimension, list, sizeof list);
    if (line >= 0)
        cz_mistake_at(reading->mistakes, &reading->source, line + 1, value.column,
                      "'%.60s' is not a unit of the %s, which takes %s", text, column->name, list);
    else
        cz_mistake_at(reading->mistakes, &reading->source, 1, 1,
                      "the channel has no unit of the %s, such as %s", column->name, list);
    cz_mistake_help(reading->mistakes, reading->request->unit_help);
    return false;
}

/* Reads the values behind the head. */
static bool read_values(CzCurveReading *reading, int n, double first, double interval) {
    const CzSource *source = &reading->source;
    CzCurvePoints *points = reading->points;
    int n_sample = 0;
    for (int line = n; line < source->n_line; line++) {
        CzField field;
        char text[CZ_MAX_FIELD_TEXT];
        double value;
        if (cz_line_is_empty(source->line[line]))
            continue;
        (void)cz_field_take(source->line[line], '\t', 0, &field); /* every line has one */
        const int k = n_sample++;
        if (is_no_value(&field))
            continue;
        if (!cz_curve_number_read(field.text, field.n, '.', &value)) {
            cz_mistake_at(reading->mistakes, source, line + 1, field.column,
                          "the value '%.60s' is not a number", cz_field_text(&field, text));
            return false;
        }
        points->x[points->n] = (first + k * interval) * points->unit[0];
        points->y[points->n] = value * points->unit[1];
        points->line[points->n++] = line + 1;
    }
    CzField field;
    double n_stated = n_sample;
    const int line = find_key(source, n, "Number of samples", &field);
    if (line >= 0 && (!cz_curve_number_read(field.text, field.n, '.', &n_stated) ||
                      n_stated != (double)n_sample)) {
        cz_mistake_at(reading->mistakes, source, line + 1, field.column,
                      "the number of samples does not agree with the %d values of the file",
                      n_sample);
        return false;
    }
    if (points->n >= 2)
        return true;
    cz_mistake_at(reading->mistakes, source, source->n_line, 1,
                  "a history needs at least two values, but this channel has %d", points->n);
    return false;
}

bool cz_mme_read_channel(CzCurveReading *reading) {
    const int n = n_head(&reading->source);
    const double in = reading->request->column[0].in;
    double first, interval;
    CzField name;
    reading->points->unit[0] = in > 0.0 ? 1.0 / in : 1.0;
    if (!read_times(reading, n, &first, &interval) || !read_unit(reading, n))
        return false;
    snprintf(reading->points->title[0], CZ_MAX_FIELD_TEXT, "time");
    if (find_key(&reading->source, n, "Name of the channel", &name) >= 0)
        cz_field_text(&name, reading->points->title[1]);
    return read_values(reading, n, first, interval);
}

/* ---- the test ---- */

bool cz_mme_is_test(const char *path) {
    const size_t n = strlen(path);
    return n > 4 && strcasecmp(path + n - 4, ".mme") == 0;
}

/* An entry of the list of channels. */
typedef struct Entry {
    int line; /* counted from 0 */
    char number[8];
    char code[CZ_MME_CODE + 1];
    char name[CZ_MAX_FIELD_TEXT]; /* the code when it has none */
} Entry;

/* The list of channels of a test. */
typedef struct Index {
    const CzSource *source;
    char stem[4096]; /* path of the channel files up to the dot of their numbers */
} Index;

/* Reads an entry; false for another line. */
static bool take_entry(const char *line, Entry *entry) {
    static const char key[] = "Name of channel ";
    char whole[sizeof key + sizeof entry->number];
    CzField value;
    if (strncasecmp(line, key, sizeof key - 1) != 0)
        return false;
    const size_t n = strspn(line + sizeof key - 1, "0123456789");
    if (n == 0 || n >= sizeof entry->number)
        return false;
    snprintf(entry->number, sizeof entry->number, "%.*s", (int)n, line + sizeof key - 1);
    snprintf(whole, sizeof whole, "%s%s", key, entry->number);
    if (!take_value(line, whole, &value) || is_no_value(&value))
        return false;
    const size_t n_code = strcspn(value.text, " /\t");
    snprintf(entry->code, sizeof entry->code, "%.*s", (int)n_code, value.text);
    const char *slash = memchr(value.text, '/', value.n);
    CzField name = {entry->code, strlen(entry->code), 1};
    if (slash != NULL && slash + 1 < value.text + value.n) {
        const char *start = slash + 1 + strspn(slash + 1, " \t");
        name = (CzField){start, (size_t)(value.text + value.n - start), 1};
    }
    cz_field_text(&name, entry->name);
    return true;
}

static bool next_entry(const Index *index, int line, Entry *entry) {
    for (; line < index->source->n_line; line++)
        if (take_entry(index->source->line[line], entry)) {
            entry->line = line;
            return true;
        }
    return false;
}

/* Reads the list of channels, beside the test or in its folder Channel. */
static bool read_index(CzSources *sources, CzMistakes *mistakes, const char *path,
                       const CzNode *place, Index *index) {
    static const char *const folders[] = {"Channel/", "CHANNEL/", "channel/", ""};
    static const char *const ends[] = {".chn", ".CHN"};
    const char *slash = strrchr(path, '/');
    const char *file = slash != NULL ? slash + 1 : path;
    const int n_folder = (int)(file - path), n_file = (int)strlen(file) - 4;
    for (size_t i = 0; i < 8; i++) {
        char list[4096 + 8];
        if (snprintf(index->stem, sizeof index->stem, "%.*s%s%.*s", n_folder, path, folders[i / 2],
                     n_file, file) >= (int)sizeof index->stem)
            break;
        snprintf(list, sizeof list, "%s%s", index->stem, ends[i % 2]);
        if (!cz_path_exists(list))
            continue;
        char *text = NULL;
        size_t n_byte = 0;
        CzSource *source = cz_sources_read(sources, mistakes, list, place, &text, &n_byte);
        index->source = source;
        const bool is_read =
            source != NULL && cz_curve_lines(mistakes->arena, mistakes, text, n_byte, source);
        free(text);
        return is_read;
    }
    const CzSource itself = {.name = path};
    cz_mistake(mistakes, place != NULL ? place : &(CzNode){.source = &itself}, NULL,
               "'%.200s' has no list of channels %.100s.chn in its folder Channel", path, file);
    return false;
}

/* Whether a code fits a pattern: '?' on either side is any character. */
static bool fits_code(const char *code, const char *pattern) {
    if (strlen(code) != CZ_MME_CODE || strlen(pattern) != CZ_MME_CODE)
        return false;
    for (int i = 0; i < CZ_MME_CODE; i++)
        if (code[i] != pattern[i] && code[i] != '?' && pattern[i] != '?')
            return false;
    return true;
}

/* Whether a channel has the requested name; a unit at the end of either does not count. */
static bool has_name(const Entry *entry, const char *wanted) {
    size_t n, n_wanted;
    (void)cz_curve_unit_of_title(entry->name, &n);
    (void)cz_curve_unit_of_title(wanted, &n_wanted);
    return n == n_wanted && strncmp(entry->name, wanted, n) == 0;
}

/* Whether a channel is of a dimension, by its code. */
static bool is_of_dimension(const Entry *entry, CzDimension dimension) {
    static const struct {
        const char *code;
        CzDimension dimension;
    } dimensions[] = {
#define CZ_MME_DIMENSION(code, dimension, unit) {code, CZ_DIMENSION_##dimension},
#include "text/mme_dimensions.def"
#undef CZ_MME_DIMENSION
    };
    for (size_t i = 0; i < sizeof dimensions / sizeof *dimensions; i++)
        if (strlen(entry->code) == CZ_MME_CODE &&
            strncmp(entry->code + 12, dimensions[i].code, 2) == 0)
            return dimensions[i].dimension == dimension;
    return false;
}

/* Writes "F_A1-B1, v_A1". */
static void list_names(const Index *index, char *text, size_t size) {
    Entry entry;
    size_t n = 0;
    text[0] = '\0';
    for (int line = 0; next_entry(index, line, &entry) && n + 40 < size; line = entry.line + 1)
        n += (size_t)snprintf(text + n, size - n, "%s%.30s", n > 0 ? ", " : "", entry.name);
}

static void refuse_request(CzMistakes *mistakes, const Index *index, const CzCurveRequest *request,
                           int n_found) {
    const CzCurveColumn *column = &request->column[1];
    char names[300];
    list_names(index, names, sizeof names);
    cz_mistake_at(mistakes, index->source, 1, 1, "%s channel of this test is %s%.60s%s: %s",
                  n_found > 1 ? "more than one" : "no", column->title != NULL ? "'" : "a ",
                  column->title != NULL ? column->title : column->name,
                  column->title != NULL ? "'" : "", names);
    cz_mistake_help(mistakes, request->column_help);
}

const char *cz_mme_find_channel(CzSources *sources, CzMistakes *mistakes, const char *path,
                                const CzNode *place, const CzCurveRequest *request) {
    const CzCurveColumn *column = &request->column[1];
    const int number = cz_curve_column_number(column);
    Index index;
    Entry entry, found = {0};
    int n = 1, n_found = 0; /* the time is column 0 */
    if (!read_index(sources, mistakes, path, place, &index))
        return NULL;
    for (int line = 0; next_entry(&index, line, &entry); line = entry.line + 1, n++) {
        const bool fits = number >= 0             ? n == number
                          : column->title != NULL ? has_name(&entry, column->title) ||
                                                        fits_code(entry.code, column->title)
                                                  : is_of_dimension(&entry, column->dimension);
        if (fits)
            found = entry;
        n_found += fits;
    }
    if (n_found != 1) {
        refuse_request(mistakes, &index, request, n_found);
        return NULL;
    }
    char file[sizeof index.stem + sizeof found.number + 1];
    snprintf(file, sizeof file, "%s.%s", index.stem, found.number);
    return cz_arena_copy_text(mistakes->arena, file, strlen(file));
}

const char *cz_mme_titles(CzSources *sources, CzMistakes *mistakes, const char *path) {
    Index index;
    Entry entry;
    if (!read_index(sources, mistakes, path, NULL, &index))
        return NULL;
    size_t size = sizeof "t_s";
    for (int line = 0; next_entry(&index, line, &entry); line = entry.line + 1)
        size += strlen(entry.name) + 1;
    char *titles = cz_arena_allocate(mistakes->arena, size, 1);
    if (titles == NULL)
        return NULL;
    size_t n = (size_t)snprintf(titles, size, "t_s");
    for (int line = 0; next_entry(&index, line, &entry); line = entry.line + 1)
        n += (size_t)snprintf(titles + n, size - n, "\t%s", entry.name);
    return titles;
}
