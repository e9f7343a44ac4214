/* Curves of devices in files. */
#include "problem/bind_curve_file.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "tree/load.h"

#define JUMP 0.01         /* of the energy that points at one stroke may be worth (ours) */
#define WITHOUT_FORCE 0.2 /* of the mean force: a curve that begins below begins without (ours) */

/* What is being read. */
typedef struct Reading {
    CzReader *reader;
    const CzKey *key;
    const CzNode *node;
    const CzTrail *trail;
    CzTraceShape shape; /* strokes in metres: `unit` of the file is taken out beforehand */
} Reading;

bool cz_curve_file_takes(const char *key) {
    static const char *const keys[] = {"decimal", "zero",   "zero_m",  "zero_mm", "flip",
                                       "scale",   "from_m", "from_mm", "to_m",    "to_mm"};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (strcmp(keys[i], key) == 0)
            return true;
    return false;
}

/* ---- keys ---- */

/* Reads a number under a stem in one of the units of a dimension; `*number` stays without one. */
static bool take_number(const Reading *reading, const char *stem, CzDimension dimension,
                        double lowest, double *number) {
    const size_t n = strlen(stem);
    for (int i = 0; i < reading->node->n_entry; i++) {
        const CzEntry *entry = &reading->node->entry[i];
        const char *text = entry->key->text;
        if (strncmp(text, stem, n) != 0)
            continue;
        const CzUnit *unit = dimension == CZ_DIMENSION_NONE && text[n] == '\0'
                                 ? cz_unit_si(dimension)
                             : text[n] == '_' ? cz_unit_find(dimension, text + n + 1)
                                              : NULL;
        if (unit != NULL)
            return cz_value_number(
                cz_reader_value(reading->reader, text, entry->value, reading->trail), unit, lowest,
                1e6, number);
    }
    return true;
}

/* Reads a word of a few; its number, -1 without the key, -2 with a mistake. */
static int take_word(const Reading *reading, const char *name, int n, const char *const *words) {
    const CzEntry *entry = cz_node_find(reading->node, name);
    char list[80] = "";
    if (entry == NULL)
        return -1;
    const char *text = entry->value->kind == CZ_NODE_TEXT ? entry->value->text : "";
    for (int i = 0; i < n; i++) {
        if (strcmp(words[i], text) == 0)
            return i;
        snprintf(list + strlen(list), sizeof list - strlen(list), "%s%s", i > 0 ? ", " : "",
                 words[i]);
    }
    cz_mistake(&reading->reader->mistakes, entry->value, reading->trail,
               "'%s' of '%s' is one of %s", name, reading->key->stem, list);
    return -2;
}

static bool take_zero(Reading *reading) {
    static const char *const words[] = {"start", "contact"};
    const int word = take_word(reading, "zero", 2, words);
    double at = NAN;
    if (word == -2 || !take_number(reading, "zero", CZ_DIMENSION_LENGTH, -100, &at))
        return false;
    if (word >= 0)
        reading->shape.zero = word == 0 ? CZ_ZERO_AT_START : CZ_ZERO_AT_CONTACT;
    if (isnan(at))
        return true;
    reading->shape.zero = CZ_ZERO_AT_STROKE;
    reading->shape.zero_at = at;
    return true;
}

static bool take_shape(Reading *reading) {
    static const char *const flips[] = {"stroke", "force", "both"};
    CzTraceShape *shape = &reading->shape;
    const int flip = take_word(reading, "flip", 3, flips);
    shape->flips[0] = flip == 0 || flip == 2;
    shape->flips[1] = flip == 1 || flip == 2;
    shape->flip_help = "flip: stroke, flip: force or flip: both beside the file changes signs";
    shape->zero_help = "zero: start beside the file counts from the first point, zero_mm from a "
                       "stroke of the file";
    return flip != -2 && take_zero(reading) &&
           take_number(reading, "scale", CZ_DIMENSION_NONE, 1e-6, &shape->scale) &&
           take_number(reading, "from", CZ_DIMENSION_LENGTH, -100, &shape->from) &&
           take_number(reading, "to", CZ_DIMENSION_LENGTH, -100, &shape->to);
}

/* Which columns, and the decimal sign. */
static bool take_request(const Reading *reading, CzCurveRequest *request) {
    static const char *const decimals[] = {".", ","};
    const CzKey *key = reading->key;
    const CzEntry *columns = cz_node_find(reading->node, "columns");
    const int decimal = take_word(reading, "decimal", 2, decimals);
    *request = (CzCurveRequest){
        .column = {{.name = key->x, .dimension = key->dimension, .largest = CZ_LARGEST_STROKE},
                   {.name = key->y, .dimension = key->y_dimension, .largest = CZ_LARGEST_FORCE}},
        .decimal = decimal >= 0 ? decimals[decimal][0] : '\0',
        .column_help = "columns: [STROKE, FORCE] beside the file names both by title or number",
        .unit_help = "a title ends in its unit, as stroke_mm or \"Load (N)\", or a row of units is "
                     "below the titles",
        .decimal_help = "decimal: '.' or decimal: ',' beside the file says which"};
    if (columns == NULL)
        return decimal != -2;
    const CzNode *list = columns->value;
    const bool is_pair = list->kind == CZ_NODE_LIST && list->n_entry == 2 &&
                         list->entry[0].value->kind == CZ_NODE_TEXT &&
                         list->entry[1].value->kind == CZ_NODE_TEXT;
    if (!is_pair)
        cz_mistake(&reading->reader->mistakes, list, reading->trail,
                   "'columns' of '%s' are the titles or numbers of two columns", key->stem);
    for (int i = 0; is_pair && i < 2; i++)
        request->column[i].title = list->entry[i].value->text;
    return is_pair && decimal != -2;
}

/* ---- points ---- */

static double area_of(const CzTrace *trace) {
    return cz_trace_work(trace, 0, trace->n - 1);
}

/* Where the force jumps most at one stroke. */
typedef struct Jump {
    double x, from, to;
    int line;
} Jump;

/* One point for all at one stroke: at 0 the last one, elsewhere their mean. */
static Jump merge_points(CzTrace *trace) {
    Jump jump = {.line = trace->line[0]};
    int n = 0;
    for (int first = 0, end = 0; first < trace->n; first = end) {
        double sum = 0.0;
        for (end = first; end < trace->n && trace->x[end] == trace->x[first]; end++)
            sum += trace->f[end];
        const double from = trace->f[first], to = trace->f[end - 1];
        if (trace->x[first] > 0.0 && fabs(to - from) > fabs(jump.to - jump.from))
            jump = (Jump){trace->x[first], from, to, trace->line[end - 1]};
        trace->x[n] = trace->x[first];
        trace->f[n] = trace->x[first] == 0.0 ? to : sum / (end - first);
        trace->line[n++] = trace->line[first];
    }
    trace->n = trace->n_loading = n;
    return jump;
}

/* The loading alone, its strokes rising from 0. A jump of the force cannot be kept. */
static bool keep_loading(const Reading *reading, const CzSource *source, CzTrace *trace) {
    CzMistakes *mistakes = &reading->reader->mistakes;
    if (trace->unloads)
        cz_mistake(&reading->reader->warnings, reading->node, reading->trail,
                   "the unloading of '%s' is not used: the unloading of a device follows from its "
                   "stiffness",
                   reading->key->stem);
    trace->n = trace->n_loading;
    double *raised = cz_arena_allocate(&reading->reader->arena, (size_t)trace->n, sizeof *raised);
    if (raised == NULL || !cz_trace_raise(&reading->reader->arena, trace->x, trace->n, raised))
        return false;
    trace->x = raised;
    const double energy = area_of(trace);
    const double mean = energy / trace->x[trace->n - 1];
    if (trace->x[0] > 0.0) { /* less than a hundredth of the stroke */
        trace->x[0] = 0.0;
        trace->f[0] = trace->f[0] > WITHOUT_FORCE * mean ? trace->f[0] : 0.0;
    }
    const double before = area_of(trace);
    const Jump jump = merge_points(trace);
    if (trace->n >= 2 && fabs(area_of(trace) - before) <= JUMP * before)
        return true;
    cz_mistake_at(mistakes, source, jump.line, 1,
                  "the force jumps from %s to %s kN at one stroke, %s mm" CZ_HELP
                  "a curve of a device has one force at a stroke: give the second point a stroke "
                  "that is a little larger, or use stages",
                  CZ_SHORT(1e-3 * jump.from), CZ_SHORT(1e-3 * jump.to), CZ_SHORT(1e3 * jump.x));
    return false;
}

bool cz_bind_curve_file(CzReader *reader, const CzKey *key, const CzNode *node,
                        const CzTrail *trail, CzTrace *trace) {
    Reading reading = {.reader = reader,
                       .key = key,
                       .node = node,
                       .trail = trail,
                       .shape = cz_trace_shape_default()};
    const CzNode *named = cz_node_find(node, "file")->value;
    const char *name = cz_value_text(cz_reader_value(reader, "file", named, trail));
    const char *path = name != NULL ? cz_load_locate(reader, name, named, "catalogue") : NULL;
    CzCurveRequest request;
    CzCurvePoints points;
    if (path == NULL || !take_shape(&reading) || !take_request(&reading, &request) ||
        !cz_curve_points_read(&reader->sources, &reader->mistakes, path, named, &request, &points))
        return false;
    *trace = (CzTrace){.n = points.n, .x = points.x, .f = points.y, .line = points.line};
    const bool is_made =
        cz_trace_make(&reader->mistakes, points.source, &reading.shape, 1.0, trace);
    for (int i = 0; is_made && i < trace->n_note; i++)
        cz_mistake(&reader->warnings, named, trail, "'%s': %s", key->stem, trace->note[i]);
    return is_made && keep_loading(&reading, points.source, trace);
}
