/* Curves by points. */
#include "problem/bind_table.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "problem/bind_curve_file.h"
#include "problem/reduce_curve.h"

/* A curve while it is read. */
typedef struct {
    CzReader *reader;
    const CzKey *key; /* of the table */
    const CzTrail *trail;
    const CzUnit *x_unit, *y_unit;
    CzTrace points; /* in SI units of the table; those of this file are in no file's line */
} Curve;

static bool make_room(Curve *curve, int n_point) {
    curve->points.x =
        cz_arena_allocate(&curve->reader->arena, (size_t)n_point, sizeof *curve->points.x);
    curve->points.f =
        cz_arena_allocate(&curve->reader->arena, (size_t)n_point, sizeof *curve->points.f);
    return curve->points.x != NULL && curve->points.f != NULL;
}

/* Unit of a column whose name must be stem_unit; a mistake when it is another. */
static const CzUnit *column_unit(Curve *curve, const char *name, const CzNode *place,
                                 const char *stem, CzDimension dimension) {
    const size_t n = strlen(stem);
    char spellings[120];
    const CzUnit *unit = NULL;
    if (strncmp(name, stem, n) == 0 && name[n] == '_')
        unit = cz_unit_find(dimension, name + n + 1);
    if (unit != NULL)
        return unit;
    cz_key_spellings(spellings, sizeof spellings, stem, dimension);
    cz_mistake(&curve->reader->mistakes, place, curve->trail, "column '%.60s' of '%s' must be %s",
               name, curve->key->stem, spellings);
    return NULL;
}

/* Takes one number of a point. */
static bool take_number(Curve *curve, const char *stem, const CzUnit *unit, CzDimension dimension,
                        const CzNode *value, double *number) {
    char name[64];
    snprintf(name, sizeof name, "%s_%s", stem, unit->suffix);
    return cz_value_number(cz_reader_value(curve->reader, name, value, curve->trail), unit, 0,
                           dimension == CZ_DIMENSION_LENGTH ? 20 : 1e9, number);
}

/* Takes one point; false when it is none. */
static bool take_point(Curve *curve, const CzNode *x, const CzNode *y) {
    const int at = curve->points.n;
    const bool has_x = take_number(curve, curve->key->x, curve->x_unit, curve->key->dimension, x,
                                   &curve->points.x[at]);
    const bool has_y = take_number(curve, curve->key->y, curve->y_unit, curve->key->y_dimension, y,
                                   &curve->points.f[at]);
    if (!has_x || !has_y)
        return false;
    if (at > 0 && curve->points.x[at] <= curve->points.x[at - 1]) {
        cz_mistake(
            &curve->reader->mistakes, x, curve->trail,
            "'%s' must rise from point to point, but %.40s does not lie beyond the point before",
            curve->key->x, x->text);
        return false;
    }
    curve->points.n++;
    return true;
}

/* ---- points in the file ---- */

static bool read_columns(Curve *curve, const CzNode *node) {
    const CzEntry *columns = cz_node_find(node, "columns");
    if (columns == NULL || columns->value->kind != CZ_NODE_LIST || columns->value->n_entry != 2 ||
        columns->value->entry[0].value->kind != CZ_NODE_TEXT ||
        columns->value->entry[1].value->kind != CZ_NODE_TEXT) {
        cz_mistake(&curve->reader->mistakes, columns != NULL ? columns->value : node, curve->trail,
                   "'%s' needs 'columns', the names of its two columns" CZ_HELP
                   "for example columns: [%s_mm, %s_kN]",
                   curve->key->stem, curve->key->x, curve->key->y);
        return false;
    }
    const CzNode *x = columns->value->entry[0].value, *y = columns->value->entry[1].value;
    curve->x_unit = column_unit(curve, x->text, x, curve->key->x, curve->key->dimension);
    curve->y_unit = column_unit(curve, y->text, y, curve->key->y, curve->key->y_dimension);
    return curve->x_unit != NULL && curve->y_unit != NULL;
}

static bool read_points(Curve *curve, const CzNode *node) {
    const CzEntry *points = cz_node_find(node, "points");
    if (points == NULL || points->value->kind != CZ_NODE_LIST || points->value->n_entry < 2) {
        cz_mistake(&curve->reader->mistakes, points != NULL ? points->value : node, curve->trail,
                   "'%s' needs 'points', a list of two points or more", curve->key->stem);
        return false;
    }
    if (!make_room(curve, points->value->n_entry))
        return false;
    bool all_good = true;
    for (int i = 0; i < points->value->n_entry; i++) {
        const CzNode *point = points->value->entry[i].value;
        if (point->kind == CZ_NODE_LIST && point->n_entry == 2) {
            all_good &= take_point(curve, point->entry[0].value, point->entry[1].value);
            continue;
        }
        cz_mistake(&curve->reader->mistakes, point, curve->trail,
                   "a point has two numbers, [%s, %s]", curve->key->x, curve->key->y);
        all_good = false;
    }
    return all_good;
}

/* ---- the table ---- */

static bool read_basis(Curve *curve, const CzNode *node, CzTable *table) {
    const CzEntry *basis = cz_node_find(node, "basis");
    if (basis != NULL && basis->value->kind == CZ_NODE_TEXT) {
        table->basis =
            strcmp(basis->value->text, "dynamic") == 0 ? CZ_BASIS_DYNAMIC : CZ_BASIS_STATIC;
        if (strcmp(basis->value->text, "dynamic") == 0 || strcmp(basis->value->text, "static") == 0)
            return true;
    }
    cz_mistake(&curve->reader->mistakes, basis != NULL ? basis->value : node, curve->trail,
               "'%s' needs 'basis': static or dynamic" CZ_HELP
               "a dynamic curve was measured at speed and already contains the rise with the rate",
               curve->key->stem);
    return false;
}

/* What the strokes of the curve are. */
static bool read_strokes(Curve *curve, const CzNode *node, CzTable *table) {
    const CzEntry *strokes = cz_node_find(node, "strokes");
    table->strokes = CZ_STROKES_UNSAID;
    if (strokes == NULL)
        return true;
    const char *text = strokes->value->kind == CZ_NODE_TEXT ? strokes->value->text : "";
    if (strcmp(text, "plastic") == 0)
        table->strokes = CZ_STROKES_PLASTIC;
    else if (strcmp(text, "total") == 0)
        table->strokes = CZ_STROKES_TOTAL;
    else
        cz_mistake(&curve->reader->mistakes, strokes->value, curve->trail,
                   "'strokes' of '%s' must be plastic or total", curve->key->stem);
    return table->strokes != CZ_STROKES_UNSAID;
}

/* Keys of a curve by points here, and of one in a file. */
static void check_keys(Curve *curve, const CzNode *node, bool has_file) {
    static const char *const here[] = {"columns", "points", "file", "basis", "strokes", NULL};
    for (int i = 0; i < node->n_entry; i++) {
        const char *key = node->entry[i].key->text;
        bool is_known = has_file && cz_curve_file_takes(key);
        for (int k = 0; here[k] != NULL; k++)
            is_known |= strcmp(key, here[k]) == 0;
        if (is_known)
            continue;
        cz_mistake(&curve->reader->mistakes, node->entry[i].key, curve->trail,
                   "unknown key '%s' in '%s'; it takes columns, points, file, basis, strokes%s",
                   key, curve->key->stem,
                   has_file ? ", decimal, zero, zero_mm, flip, scale, from_mm, to_mm" : "");
    }
}

static void reduce(Curve *curve, const CzNode *node, CzTable *table) {
    const int n_before = curve->points.n;
    double largest = 0.0;
    CzCurveChange change;
    for (int i = 0; i < n_before; i++)
        largest = fmax(largest, curve->points.f[i]);
    if (!cz_reduce_curve(&curve->reader->arena, curve->points.x, curve->points.f, &curve->points.n,
                         CZ_MAX_CURVE_POINTS, &change))
        return;
    if (curve->points.n < n_before)
        cz_mistake(
            &curve->reader->warnings, node, curve->trail,
            "'%s' was reduced from %d to %d points: energy %s kJ as before, force differs by up "
            "to %s kN",
            curve->key->stem, n_before, curve->points.n, CZ_SHORT(change.area / 1e3),
            CZ_SHORT(change.largest_difference <= 1e-12 * largest
                         ? 0.0 /* what rounding leaves of it */
                         : change.largest_difference / 1e3));
    table->n_point = curve->points.n;
    memcpy(table->x, curve->points.x, (size_t)curve->points.n * sizeof table->x[0]);
    memcpy(table->y, curve->points.f, (size_t)curve->points.n * sizeof table->y[0]);
    table->given = true;
}

static void read_table(CzReader *reader, const CzKey *key, const CzNode *node, const CzTrail *trail,
                       CzTable *table) {
    Curve curve = {.reader = reader, .key = key, .trail = trail};
    if (node->kind != CZ_NODE_MAPPING) {
        cz_mistake(&reader->mistakes, node, trail,
                   "'%s' needs {columns, points, basis} or {file, basis}", key->stem);
        return;
    }
    const CzEntry *file = cz_node_find(node, "file");
    check_keys(&curve, node, file != NULL);
    const bool has_basis = read_basis(&curve, node, table) && read_strokes(&curve, node, table);
    bool is_read = false;
    if (file != NULL && cz_node_find(node, "points") != NULL)
        cz_mistake(&reader->mistakes, file->key, trail,
                   "'%s' has points here or in a file, not both", key->stem);
    else if (file != NULL)
        is_read = cz_bind_curve_file(reader, key, node, trail, &curve.points);
    else
        is_read = read_columns(&curve, node) && read_points(&curve, node);
    if (is_read && has_basis)
        reduce(&curve, node, table);
}

void cz_bind_table(CzReader *reader, const CzReadCurve **curves, const CzKey *key,
                   const CzNode *node, const CzTrail *trail, CzTable *table) {
    const CzReadCurve *curve = *curves;
    while (curve != NULL && (curve->node != node || curve->key != key))
        curve = curve->before;
    if (curve == NULL) {
        CzReadCurve *read = cz_arena_allocate(&reader->arena, 1, sizeof *read);
        if (read == NULL)
            return;
        *read = (CzReadCurve){.node = node, .key = key, .before = *curves};
        read_table(reader, key, node, trail, &read->table);
        curve = *curves = read;
    }
    *table = curve->table;
}
