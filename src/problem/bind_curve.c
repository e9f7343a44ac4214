/* Curves of devices, by points or in files. */
#include "problem/bind_curve.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "base/text.h"
#include "problem/reduce_curve.h"
#include "problem/trace.h"
#include "tree/load.h"

#define JUMP 0.01 /* largest energy of points at one stroke, as a share of the total (ours) */
#define WITHOUT_FORCE 0.2 /* of the mean force: a smaller first force counts as zero (ours) */

/* A curve while it is read. */
typedef struct Curve {
    CzReader *reader;
    const CzKey *key; /* of the curve */
    const CzNode *node;
    const CzTrail *trail;
    CzTrace points; /* [SI]; those in the problem file itself have no lines */
} Curve;

/* Reports a mistake about the curve; false. */
__attribute__((format(printf, 3, 4))) static bool refuse(const Curve *curve, const CzNode *place,
                                                         const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    cz_mistake_list(&curve->reader->mistakes, place, curve->trail, format, arguments);
    va_end(arguments);
    return false;
}

/* The value of a key, or the curve itself without the key. */
static const CzNode *place_of(const Curve *curve, const char *name) {
    const CzEntry *entry = cz_node_find(curve->node, name);
    return entry != NULL ? entry->value : curve->node;
}

/* Number of the word under a key; -1 without the key, -2 for another word. */
static int find_word(const Curve *curve, const char *name, int n, const char *const *words) {
    const CzEntry *entry = cz_node_find(curve->node, name);
    if (entry == NULL)
        return -1;
    for (int i = 0; i < n && entry->value->kind == CZ_NODE_TEXT; i++)
        if (strcmp(words[i], entry->value->text) == 0)
            return i;
    return -2;
}

/* The titles of two columns; NULL when there are none. */
static const CzNode *find_columns(const Curve *curve) {
    const CzEntry *columns = cz_node_find_list(curve->node, "columns");
    const bool is_pair = columns != NULL && columns->value->n_entry == 2 &&
                         columns->value->entry[0].value->kind == CZ_NODE_TEXT &&
                         columns->value->entry[1].value->kind == CZ_NODE_TEXT;
    return is_pair ? columns->value : NULL;
}

/* ---- points in the problem file ---- */

/* One column: its values are x or y of the curve. */
typedef struct Column {
    const char *stem;
    CzDimension dimension;
    const CzUnit *unit;
} Column;

/* Finds the unit of a column whose title must be stem_unit. */
static bool find_unit(const Curve *curve, const CzNode *title, Column *column) {
    const size_t n = strlen(column->stem);
    char spellings[120];
    if (strncmp(title->text, column->stem, n) == 0 && title->text[n] == '_')
        column->unit = cz_unit_find(column->dimension, title->text + n + 1);
    if (column->unit != NULL)
        return true;
    cz_key_spellings(spellings, sizeof spellings, column->stem, column->dimension);
    return refuse(curve, title, "column '%.60s' of '%s' must be %s", title->text, curve->key->stem,
                  spellings);
}

static bool read_columns(const Curve *curve, Column column[2]) {
    const CzNode *titles = find_columns(curve);
    if (titles == NULL)
        return refuse(curve, place_of(curve, "columns"),
                      "'%s' needs 'columns', the names of its two columns" CZ_HELP
                      "for example columns: [%s_mm, %s_kN]",
                      curve->key->stem, column[0].stem, column[1].stem);
    const bool has_x = find_unit(curve, titles->entry[0].value, &column[0]);
    return find_unit(curve, titles->entry[1].value, &column[1]) && has_x;
}

static bool read_number(const Curve *curve, const Column *column, const CzNode *value,
                        double *number) {
    char name[64];
    snprintf(name, sizeof name, "%s_%s", column->stem, column->unit->suffix);
    return cz_value_number(cz_reader_value(curve->reader, name, value, curve->trail), column->unit,
                           0, column->dimension == CZ_DIMENSION_LENGTH ? 20 : 1e9, number);
}

/* Reads one point; false when it is not a point. */
static bool read_point(Curve *curve, const Column column[2], const CzNode *point) {
    CzTrace *points = &curve->points;
    const int at = points->n;
    if (point->kind != CZ_NODE_LIST || point->n_entry != 2)
        return refuse(curve, point, "a point has two numbers, [%s, %s]", column[0].stem,
                      column[1].stem);
    const CzNode *x = point->entry[0].value;
    const bool has_x = read_number(curve, &column[0], x, &points->x[at]);
    if (!read_number(curve, &column[1], point->entry[1].value, &points->f[at]) || !has_x)
        return false;
    if (at > 0 && points->x[at] <= points->x[at - 1])
        return refuse(
            curve, x,
            "'%s' must increase from point to point, but %.40s is not above the point before",
            column[0].stem, x->text);
    points->n++;
    return true;
}

static bool read_points(Curve *curve) {
    const CzKey *key = curve->key;
    Column column[2] = {{key->x, key->dimension, NULL}, {key->y, key->y_dimension, NULL}};
    if (!read_columns(curve, column))
        return false;
    const CzEntry *list = cz_node_find_list(curve->node, "points");
    if (list == NULL || list->value->n_entry < 2)
        return refuse(curve, place_of(curve, "points"),
                      "'%s' needs 'points', a list of two points or more", key->stem);
    const size_t n = (size_t)list->value->n_entry;
    curve->points.x = cz_arena_numbers(&curve->reader->arena, n);
    curve->points.f = cz_arena_numbers(&curve->reader->arena, n);
    bool all_good = curve->points.x != NULL && curve->points.f != NULL;
    for (size_t i = 0; curve->points.f != NULL && curve->points.x != NULL && i < n; i++)
        all_good &= read_point(curve, column, list->value->entry[i].value);
    return all_good;
}

/* ---- points in a file ---- */

/* Reads a number under a stem in one of the units of a dimension; `*number` is unchanged when it is
 * not given. */
static bool read_setting(const Curve *curve, const char *stem, CzDimension dimension, double lowest,
                         double *number) {
    const size_t n = strlen(stem);
    for (int i = 0; i < curve->node->n_entry; i++) {
        const CzEntry *entry = &curve->node->entry[i];
        const char *text = entry->key->text;
        if (strncmp(text, stem, n) != 0)
            continue;
        const CzUnit *unit = dimension == CZ_DIMENSION_NONE && text[n] == '\0'
                                 ? cz_unit_si(dimension)
                             : text[n] == '_' ? cz_unit_find(dimension, text + n + 1)
                                              : NULL;
        if (unit != NULL)
            return cz_value_number(cz_reader_value(curve->reader, text, entry->value, curve->trail),
                                   unit, lowest, 1e6, number);
    }
    return true;
}

/* Reads one of a few words: its number, or -1 when it is absent. */
static bool read_word(const Curve *curve, const char *name, int n, const char *const *words,
                      int *word) {
    char list[80] = "";
    *word = find_word(curve, name, n, words);
    for (int i = 0; i < n; i++)
        snprintf(list + strlen(list), sizeof list - strlen(list), "%s%s", i > 0 ? ", " : "",
                 words[i]);
    return *word >= -1 || refuse(curve, place_of(curve, name), "'%s' of '%s' is one of %s", name,
                                 curve->key->stem, list);
}

static bool read_zero(const Curve *curve, CzTraceShape *shape) {
    static const char *const words[] = {"start", "contact"};
    static const CzTraceZero zeros[] = {CZ_ZERO_AT_START, CZ_ZERO_AT_CONTACT};
    int word;
    double at = NAN;
    if (!read_word(curve, "zero", 2, words, &word) ||
        !read_setting(curve, "zero", CZ_DIMENSION_LENGTH, -100, &at))
        return false;
    if (word >= 0)
        shape->zero = zeros[word];
    if (isnan(at))
        return true;
    shape->zero = CZ_ZERO_AT_STROKE;
    shape->zero_at = at;
    return true;
}

/* Reads signs, zero and part of the curve. */
static bool read_shape(const Curve *curve, CzTraceShape *shape) {
    static const char *const words[] = {"stroke", "force", "both"};
    int flip;
    *shape = cz_trace_shape_default();
    shape->flip_help = "flip: stroke, flip: force or flip: both beside the file changes signs";
    shape->zero_help = "zero: start beside the file counts from the first point, zero_mm from a "
                       "stroke of the file";
    if (!read_word(curve, "flip", 3, words, &flip))
        return false;
    shape->flips[0] = flip == 0 || flip == 2;
    shape->flips[1] = flip == 1 || flip == 2;
    return read_zero(curve, shape) &&
           read_setting(curve, "scale", CZ_DIMENSION_NONE, 1e-6, &shape->scale) &&
           read_setting(curve, "from", CZ_DIMENSION_LENGTH, -100, &shape->from) &&
           read_setting(curve, "to", CZ_DIMENSION_LENGTH, -100, &shape->to);
}

/* Reads the columns and the decimal sign. */
static bool read_request(const Curve *curve, CzCurveRequest *request) {
    static const char *const decimals[] = {".", ","};
    const CzKey *key = curve->key;
    int decimal;
    const bool has_decimal = read_word(curve, "decimal", 2, decimals, &decimal);
    *request = (CzCurveRequest){
        .column = {{.name = key->x, .dimension = key->dimension, .largest = CZ_LARGEST_STROKE},
                   {.name = key->y, .dimension = key->y_dimension, .largest = CZ_LARGEST_FORCE}},
        .decimal = decimal >= 0 ? decimals[decimal][0] : '\0',
        .column_help = "columns: [STROKE, FORCE] beside the file names both by title or number",
        .unit_help = "a title ends in its unit, as stroke_mm or \"Load (N)\", or a row of units is "
                     "below the titles",
        .decimal_help = "give decimal: '.' or decimal: ',' beside the file"};
    if (cz_node_find(curve->node, "columns") == NULL)
        return has_decimal;
    const CzNode *titles = find_columns(curve);
    if (titles == NULL)
        return refuse(curve, place_of(curve, "columns"),
                      "'columns' of '%s' are the titles or numbers of two columns", key->stem);
    for (int i = 0; i < 2; i++)
        request->column[i].title = titles->entry[i].value->text;
    return has_decimal;
}

static double area_of(const CzTrace *trace) {
    return cz_work(trace->x, trace->f, 0, trace->n - 1);
}

/* The largest jump of the force at one stroke. */
typedef struct Jump {
    double x, from, to;
    int line;
} Jump;

/* Replaces points at one stroke by one point: at 0 the last one, elsewhere their mean. */
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

/* Keeps the loading alone, with strokes rising from 0. A jump of the force cannot be kept. */
static bool keep_loading(Curve *curve, const CzSource *source) {
    CzReader *reader = curve->reader;
    CzTrace *trace = &curve->points;
    if (trace->unloads)
        cz_mistake(&reader->warnings, curve->node, curve->trail,
                   "the unloading of '%s' is not used: the unloading of a device follows from its "
                   "stiffness",
                   curve->key->stem);
    trace->n = trace->n_loading;
    double *raised = cz_arena_numbers(&reader->arena, (size_t)trace->n);
    if (raised == NULL || !cz_trace_raise(&reader->arena, trace->x, trace->n, raised))
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
    cz_mistake_at(&reader->mistakes, source, jump.line, 1,
                  "the force jumps from %s to %s kN at one stroke, %s mm" CZ_HELP
                  "a curve of a device has one force at a stroke: give the second point a stroke "
                  "that is a little larger, or use stages",
                  CZ_SHORT(1e-3 * jump.from), CZ_SHORT(1e-3 * jump.to), CZ_SHORT(1e3 * jump.x));
    return false;
}

static bool read_file(Curve *curve, const CzNode *named) {
    CzReader *reader = curve->reader;
    const char *name = cz_value_text(cz_reader_value(reader, "file", named, curve->trail));
    const char *path = name != NULL ? cz_load_locate(reader, name, named, "catalogue") : NULL;
    CzTraceShape shape;
    CzCurveRequest request;
    CzCurvePoints points;
    if (path == NULL || !read_shape(curve, &shape) || !read_request(curve, &request) ||
        !cz_curve_points_read(&reader->sources, &reader->mistakes, path, named, &request, &points))
        return false;
    CzTrace *trace = &curve->points;
    *trace = (CzTrace){.n = points.n, .x = points.x, .f = points.y, .line = points.line};
    if (!cz_trace_make(&reader->mistakes, points.source, &shape, 1.0, trace))
        return false;
    for (int i = 0; i < trace->n_note; i++)
        cz_mistake(&reader->warnings, named, curve->trail, "'%s': %s", curve->key->stem,
                   trace->note[i]);
    return keep_loading(curve, points.source);
}

/* ---- the curve ---- */

static bool read_basis(const Curve *curve, CzTable *table) {
    static const char *const words[] = {"static", "dynamic"};
    const int word = find_word(curve, "basis", 2, words);
    table->basis = word == 1 ? CZ_BASIS_DYNAMIC : CZ_BASIS_STATIC;
    return word >= 0 ||
           refuse(curve, place_of(curve, "basis"),
                  "'%s' needs 'basis': static or dynamic" CZ_HELP
                  "a dynamic curve was measured at speed and already contains the rise with the "
                  "rate",
                  curve->key->stem);
}

/* Reads whether the strokes of the curve are total or plastic. */
static bool read_strokes(const Curve *curve, CzTable *table) {
    static const char *const words[] = {"plastic", "total"};
    const int word = find_word(curve, "strokes", 2, words);
    table->strokes = word == 0   ? CZ_STROKES_PLASTIC
                     : word == 1 ? CZ_STROKES_TOTAL
                                 : CZ_STROKES_UNSAID;
    return word >= -1 || refuse(curve, place_of(curve, "strokes"),
                                "'strokes' of '%s' must be plastic or total", curve->key->stem);
}

/* Keys of a curve by points in the problem file, and of one in a file. */
static void check_keys(const Curve *curve, bool has_file) {
    for (int i = 0; i < curve->node->n_entry; i++) {
        const CzNode *key = curve->node->entry[i].key;
        if (!cz_text_is_word(key->text, "columns points file basis strokes") &&
            !(has_file && cz_text_is_word(key->text, "decimal zero zero_m zero_mm flip scale "
                                                     "from_m from_mm to_m to_mm")))
            refuse(curve, key,
                   "unknown key '%s' in '%s'; it takes columns, points, file, basis, strokes%s",
                   key->text, curve->key->stem,
                   has_file ? ", decimal, zero, zero_mm, flip, scale, from_mm, to_mm" : "");
    }
}

static void reduce(Curve *curve, CzTable *table) {
    CzTrace *points = &curve->points;
    const int n_before = points->n;
    double largest = 0.0;
    CzCurveChange change;
    for (int i = 0; i < n_before; i++)
        largest = fmax(largest, points->f[i]);
    if (!cz_reduce_curve(&curve->reader->arena, points->x, points->f, &points->n,
                         CZ_MAX_CURVE_POINTS, &change))
        return;
    if (points->n < n_before)
        cz_mistake(
            &curve->reader->warnings, curve->node, curve->trail,
            "'%s' was reduced from %d to %d points: energy %s kJ as before, force differs by up "
            "to %s kN",
            curve->key->stem, n_before, points->n, CZ_SHORT(change.area / 1e3),
            CZ_SHORT(change.largest_difference <= 1e-12 * largest
                         ? 0.0 /* zero but for rounding */
                         : change.largest_difference / 1e3));
    table->n_point = points->n;
    memcpy(table->x, points->x, (size_t)points->n * sizeof table->x[0]);
    memcpy(table->y, points->f, (size_t)points->n * sizeof table->y[0]);
    table->given = true;
}

static void read_curve(Curve *curve, CzTable *table) {
    const CzEntry *file = cz_node_find(curve->node, "file");
    if (curve->node->kind != CZ_NODE_MAPPING) {
        refuse(curve, curve->node, "'%s' needs {columns, points, basis} or {file, basis}",
               curve->key->stem);
        return;
    }
    check_keys(curve, file != NULL);
    const bool has_basis = read_basis(curve, table) && read_strokes(curve, table);
    bool is_read = false;
    if (file != NULL && cz_node_find(curve->node, "points") != NULL)
        refuse(curve, file->key, "'%s' has points here or in a file, not both", curve->key->stem);
    else
        is_read = file != NULL ? read_file(curve, file->value) : read_points(curve);
    if (is_read && has_basis)
        reduce(curve, table);
}

void cz_bind_curve(CzReader *reader, const CzReadCurve **curves, const CzKey *key,
                   const CzNode *node, const CzTrail *trail, CzTable *table) {
    const CzReadCurve *known = *curves;
    while (known != NULL && (known->node != node || known->key != key))
        known = known->before;
    if (known == NULL) {
        CzReadCurve *read = cz_arena_allocate(&reader->arena, 1, sizeof *read);
        if (read == NULL)
            return;
        *read = (CzReadCurve){.node = node, .key = key, .before = *curves};
        Curve curve = {.reader = reader, .key = key, .node = node, .trail = trail};
        read_curve(&curve, &read->table);
        known = *curves = read;
    }
    *table = known->table;
}
