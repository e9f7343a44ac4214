/* Reading measured time histories. */
#include "problem/reading.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "text/curve_file.h"
#include "tree/load.h"

/* The requested column of values, in the unit at the end of the channel's name. */
static CzCurveColumn column_of(const CzMatch *match) {
    const CzUnit *unit =
        match->channel != NULL ? cz_curve_unit_of_title(match->channel, NULL) : NULL;
    const char *wanted = match->column != NULL ? match->column : match->channel;
    return (CzCurveColumn){.name = unit != NULL ? cz_dimension_text[unit->dimension] : wanted,
                           .title = wanted,
                           .dimension = unit != NULL ? unit->dimension : CZ_DIMENSION_NONE,
                           .without = unit != NULL ? unit->si : 1.0,
                           .in = unit != NULL ? unit->si : 1.0};
}

/* Keeps the points within the window of the match; times must rise. */
static bool keep_window(CzReader *reader, const CzMatch *match, CzCurvePoints *points) {
    const double from = isnan(match->from) ? -INFINITY : match->from;
    const double to = isnan(match->to) ? INFINITY : match->to;
    double last = -INFINITY;
    int n = 0;
    for (int i = 0; i < points->n; i++) {
        if (!(points->x[i] > last)) {
            cz_mistake_at(&reader->mistakes, points->source, points->line[i], 1,
                          "the time must increase from line to line, but does not here");
            return false;
        }
        last = points->x[i];
        if (last < from || last > to)
            continue;
        points->x[n] = points->x[i];
        points->line[n] = points->line[i];
        points->y[n++] = points->y[i];
    }
    points->n = n;
    if (n > 0 && points->x[0] < 0.0) {
        cz_mistake_at(&reader->mistakes, points->source, points->line[0], 1,
                      "the times begin before the first contact, which is at 0: no run has a value "
                      "there");
        cz_mistake_help(&reader->mistakes, "from_ms: 0 in the match omits earlier times");
        return false;
    }
    if (n >= 2)
        return true;
    cz_mistake_at(&reader->mistakes, points->source, 1, 1,
                  "a time history needs two points or more within its window, but there %s %d",
                  n == 1 ? "is" : "are", n);
    return false;
}

static void read_measured(CzProblem *problem, const CzMatch *match, CzMeasured *measured) {
    CzReader *reader = &problem->reader;
    const CzPlace *named = cz_places_find(&problem->places, &match->file);
    const char *name = match->column != NULL ? match->column : match->channel;
    const char *path = cz_load_locate(reader, match->file, named->value, NULL);
    if (path == NULL || name == NULL)
        return;
    const CzCurveRequest request = {
        .column = {{.name = "time", .dimension = CZ_DIMENSION_TIME}, column_of(match)},
        .column_help = "`column` of the match names the column of the values; times are in a "
                       "column t_ms, t_s or "
                       "\"Time (s)\"",
        .unit_help = "a title ends in its unit, as t_ms, or a row of units is below the titles"};
    CzCurvePoints points;
    if (cz_curve_points_read(&reader->sources, &reader->mistakes, path, named->value, &request,
                             &points) &&
        keep_window(reader, match, &points))
        *measured = (CzMeasured){
            .n_point = points.n, .time = points.x, .value = points.y, .source = points.source};
}

/* Numbers the files in the order of their first matches. */
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
    problem->measured = cz_arena_allocate(&problem->reader.arena, (size_t)optimise->n_match,
                                          sizeof *problem->measured);
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
