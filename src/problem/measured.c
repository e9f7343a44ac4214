/* Measured time histories in CSV files.
 *
 * The first line names the columns; one of them is t_ms or t_s and rises, so what `run` writes as
 * channels.csv can be read as well. Fields are parted by commas or semicolons; blank lines and
 * lines that begin with # are passed over.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "base/suggest.h"
#include "problem/reader.h"

enum { MOST_POINTS = 200000, MOST_NAME = 96 };

/* A file while it is read. */
typedef struct {
    CzReader *reader;
    const CzSource *source;
    int time, value;       /* columns */
    double time_unit;      /* [s] */
    double from, to;       /* window [s] */
    const char *time_name; /* of the column */
    const char *name;      /* of the column of values */
    int n_point;
    double *t, *y; /* (n_point) */
} File;

/* The i-th field of a line: its start, and its length without blanks and quotes; NULL when the
 * line has no such field. */
static const char *field_of(const char *line, int i, size_t *n) {
    const char separator = strchr(line, ';') != NULL ? ';' : ',';
    for (; i > 0; i--) {
        line = strchr(line, separator);
        if (line == NULL)
            return NULL;
        line++;
    }
    const char *end = strchr(line, separator);
    *n = end != NULL ? (size_t)(end - line) : strlen(line);
    while (*n > 0 && strchr(" \t\r\"", *line) != NULL) {
        line++;
        --*n;
    }
    while (*n > 0 && strchr(" \t\r\"", line[*n - 1]) != NULL)
        --*n;
    return line;
}

static bool is_blank(const char *line) {
    return line[strspn(line, " \t\r")] == '\0' || line[0] == '#';
}

static bool is_named(const char *field, size_t n, const char *name) {
    return strlen(name) == n && strncmp(field, name, n) == 0;
}

/* Finds the two columns by their names. */
static bool read_header(File *file, int line) {
    const char *text = file->source->line[line];
    CzSuggestion nearest = {0};
    char best[MOST_NAME] = "", name[MOST_NAME];
    file->time = file->value = -1;
    size_t n = 0;
    for (int i = 0;; i++) {
        const char *field = field_of(text, i, &n);
        if (field == NULL)
            break;
        const bool is_ms = is_named(field, n, "t_ms");
        if (is_ms || is_named(field, n, "t_s")) {
            file->time = i;
            file->time_unit = is_ms ? 1e-3 : 1;
        }
        if (is_named(field, n, file->name))
            file->value = i;
        snprintf(name, sizeof name, "%.*s", (int)(n < MOST_NAME ? n : MOST_NAME - 1), field);
        cz_suggest(&nearest, file->name, name);
        if (nearest.best == name) {
            memcpy(best, name, sizeof best);
            nearest.best = best;
        }
    }
    CzMistakes *mistakes = &file->reader->mistakes;
    if (file->time < 0)
        cz_mistake_at(mistakes, file->source, line + 1, 1,
                      "the first line names no column t_ms or t_s");
    if (file->value < 0) {
        cz_mistake_at(mistakes, file->source, line + 1, 1, "the first line names no column '%.60s'",
                      file->name);
        cz_mistake_suggest(mistakes, nearest.best);
    }
    return file->time >= 0 && file->value >= 0;
}

static bool read_number(File *file, int line, int column, const char *name, double *number) {
    size_t n = 0;
    char text[64];
    const char *field = field_of(file->source->line[line], column, &n);
    CzMistakes *mistakes = &file->reader->mistakes;
    if (field == NULL || n == 0) {
        cz_mistake_at(mistakes, file->source, line + 1, 1, "this line has no value of '%.60s'",
                      name);
        return false;
    }
    snprintf(text, sizeof text, "%.*s", (int)(n < sizeof text ? n : sizeof text - 1), field);
    const char *wrong = cz_number_parse(text, number);
    if (wrong != NULL)
        cz_mistake_at(mistakes, file->source, line + 1, (int)(field - file->source->line[line]) + 1,
                      "%.60s: '%s' %s", name, text, wrong);
    return wrong == NULL;
}

/* Reads one line; keeps the point when it lies within the window. */
static bool read_point(File *file, int line, double *last) {
    double t, y;
    if (!read_number(file, line, file->time, file->time_name, &t) ||
        !read_number(file, line, file->value, file->name, &y))
        return false;
    t *= file->time_unit;
    if (!(t > *last)) {
        cz_mistake_at(&file->reader->mistakes, file->source, line + 1, 1,
                      "time must rise from line to line, but does not here");
        return false;
    }
    *last = t;
    if (t < file->from || t > file->to)
        return true;
    file->t[file->n_point] = t;
    file->y[file->n_point++] = y;
    return true;
}

static bool read_lines(File *file) {
    const int n_line = file->source->n_line;
    file->t = cz_reader_allocate(file->reader, (size_t)n_line, sizeof *file->t);
    file->y = cz_reader_allocate(file->reader, (size_t)n_line, sizeof *file->y);
    if (file->t == NULL || file->y == NULL)
        return false;
    bool has_header = false;
    double last = -INFINITY;
    for (int line = 0; line < n_line; line++) {
        if (is_blank(file->source->line[line]))
            continue;
        if (!(has_header ? read_point(file, line, &last) : read_header(file, line)))
            return false;
        has_header = true;
    }
    if (file->n_point >= 2)
        return true;
    cz_mistake_at(&file->reader->mistakes, file->source, 1, 1,
                  "a time history needs two points or more within its window, but there %s %d",
                  file->n_point == 1 ? "is" : "are", file->n_point);
    return false;
}

static void read_measured(CzProblem *problem, const CzMatch *match, CzMeasured *measured) {
    CzReader *reader = &problem->reader;
    const CzPlace *named = cz_places_find(&reader->places, &match->file);
    const char *name = match->column != NULL ? match->column : match->channel;
    const char *path = cz_load_locate(reader, match->file, named->value, NULL);
    if (path == NULL || name == NULL)
        return;
    char *text = NULL;
    size_t n_byte = 0;
    File file = {.reader = reader,
                 .time_name = "time",
                 .name = name,
                 .from = isnan(match->from) ? -INFINITY : match->from,
                 .to = isnan(match->to) ? INFINITY : match->to};
    file.source =
        cz_sources_read(&reader->sources, &reader->mistakes, path, named->value, &text, &n_byte);
    const bool is_text =
        file.source != NULL && cz_source_is_text(&reader->mistakes, file.source, text, n_byte);
    free(text);
    if (is_text && file.source->n_line > MOST_POINTS)
        cz_mistake_at(&reader->mistakes, file.source, MOST_POINTS, 1,
                      "a time history has at most %d lines", (int)MOST_POINTS);
    else if (is_text && read_lines(&file))
        *measured = (CzMeasured){
            .n_point = file.n_point, .time = file.t, .value = file.y, .source = file.source};
}

/* The first match of a file gives it its number. */
static void number_files(CzProblem *problem) {
    int n = 0;
    for (int i = 0; i < problem->input.optimise.n_match; i++) {
        CzMeasured *measured = &problem->measured[i];
        for (int k = 0; k < i && measured->source != NULL; k++)
            if (problem->measured[k].source != NULL &&
                strcmp(problem->measured[k].source->name, measured->source->name) == 0)
                measured->number = problem->measured[k].number;
        if (measured->source != NULL && measured->number == 0)
            measured->number = ++n;
    }
}

void cz_measured_read(CzProblem *problem) {
    const CzOptimise *optimise = &problem->input.optimise;
    if (!optimise->given || optimise->n_match == 0)
        return;
    problem->measured =
        cz_reader_allocate(&problem->reader, (size_t)optimise->n_match, sizeof *problem->measured);
    for (int i = 0; problem->measured != NULL && i < optimise->n_match; i++)
        if (optimise->match[i].file != NULL)
            read_measured(problem, &optimise->match[i], &problem->measured[i]);
    if (problem->measured != NULL)
        number_files(problem);
}

const CzMeasured *cz_problem_measured(const CzProblem *problem, int match) {
    return &problem->measured[match];
}

const CzSource *cz_problem_measured_file(const CzProblem *problem, int number, size_t room,
                                         char *name) {
    const int n_match = problem->measured != NULL ? problem->input.optimise.n_match : 0;
    for (int i = 0; i < n_match; i++) {
        const CzSource *source = problem->measured[i].source;
        if (source == NULL || problem->measured[i].number != number)
            continue;
        const char *slash = strrchr(source->name, '/');
        snprintf(name, room, "measured/%d-%s", number, slash != NULL ? slash + 1 : source->name);
        return source;
    }
    return NULL;
}
