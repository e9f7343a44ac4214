/* A force-stroke curve from a file or from points. */
#include "fit/fit.h"

#include <string.h>

#include "base/error.h"

static CzTraceShape shape_of(const CzFitOptions *options) {
    CzTraceShape shape = cz_trace_shape_default();
    shape.flips[0] = options->flips_stroke != 0;
    shape.flips[1] = options->flips_force != 0;
    shape.scale = options->scale;
    shape.zero = (CzTraceZero)options->zero;
    shape.zero_at = options->zero_stroke;
    shape.from = options->from;
    shape.to = options->to;
    shape.flip_help = "--flip stroke, --flip force or --flip both changes signs";
    shape.zero_help =
        "--zero start counts from the first point, --zero STROKE from a stroke of the "
        "file, --zero 0 keeps the file's";
    return shape;
}

/* Converts the points that were read to a trace. */
static CzStatus make_trace(CzFit *fit, const CzSource *source, const CzFitOptions *options,
                           double unit, CzError *error) {
    const CzTraceShape shape = shape_of(options);
    CzMistakes mistakes = {.arena = &fit->arena};
    const bool is_made = cz_trace_make(&mistakes, source, &shape, unit, &fit->trace);
    if (fit->arena.out_of_memory)
        return cz_no_memory(error, "a fit");
    if (!is_made && error != NULL)
        *error = mistakes.mistake[0]->error;
    for (int i = 0; is_made && i < fit->trace.n_note; i++)
        cz_fit_add_note(fit, "%s", fit->trace.note[i]);
    return is_made ? CZ_OK : CZ_STATUS_INPUT;
}

CzStatus cz_fit_read_trace(CzFit *fit, const char *path, const CzFitOptions *options,
                           CzError *error) {
    const CzCurveRequest request = {
        .column = {{.name = "stroke",
                    .dimension = CZ_DIMENSION_LENGTH,
                    .title = options->stroke,
                    .unit = options->stroke_unit,
                    .largest = CZ_LARGEST_STROKE},
                   {.name = "force",
                    .dimension = CZ_DIMENSION_FORCE,
                    .title = options->force,
                    .unit = options->force_unit,
                    .largest = CZ_LARGEST_FORCE}},
        .separator = options->separator,
        .decimal = options->decimal,
        .column_help = "--stroke and --force take the title of a column or its number from 1",
        .unit_help = "give the unit with --stroke-unit or --force-unit",
        .decimal_help = "specify --csv-decimal . or --csv-decimal ,",
    };
    CzCurvePoints points;
    CZ_TRY(cz_curve_points_read_file(&fit->arena, path, &request, &points, error));
    for (int i = 0; i < 2; i++)
        if (points.other_unit[i] != NULL)
            cz_fit_add_note(fit, "the %s is read in %s as requested; the unit in the file is %s",
                            request.column[i].name, request.column[i].unit, points.other_unit[i]);
    fit->trace = (CzTrace){.n = points.n, .x = points.x, .f = points.y, .line = points.line};
    return make_trace(fit, points.source, options, points.unit[0], error);
}

CzStatus cz_fit_take_points(CzFit *fit, int n_point, const double *stroke, const double *force,
                            const CzFitOptions *options, CzError *error) {
    static const CzSource nowhere = {.name = ""};
    CzTrace *trace = &fit->trace;
    if (n_point < 2)
        return cz_fail(error, CZ_STATUS_INPUT,
                       "a curve needs at least two points, but this one has %d", n_point);
    const size_t n = (size_t)n_point;
    trace->x = cz_arena_numbers(&fit->arena, n);
    trace->f = cz_arena_numbers(&fit->arena, n);
    trace->line = cz_arena_allocate(&fit->arena, n, sizeof *trace->line);
    if (trace->x == NULL || trace->f == NULL || trace->line == NULL)
        return cz_no_memory(error, "a fit");
    memcpy(trace->x, stroke, n * sizeof *stroke);
    memcpy(trace->f, force, n * sizeof *force);
    for (trace->n = 0; trace->n < n_point; trace->n++)
        trace->line[trace->n] = trace->n + 1;
    return make_trace(fit, &nowhere, options, 1.0, error);
}
