/* Curves by points: {columns, points, basis} in the file, or {file, basis} in a CSV file.
 *
 * A curve of more points than a table holds loses the points that matter least (reduce_curve.h).
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "problem/reader.h"
#include "problem/reduce_curve.h"

enum { MOST_POINTS = 20000 };

/* A curve while it is read. */
typedef struct {
    CzReader *reader;
    const CzKey *key; /* of the table */
    const CzTrail *trail;
    const CzUnit *x_unit, *y_unit;
    int n_point;
    double *x, *y;        /* [SI] (n_point) */
    const CzNode **place; /* of each point (n_point) */
} Curve;

static bool make_room(Curve *curve, int n_point) {
    curve->x = cz_reader_allocate(curve->reader, (size_t)n_point, sizeof *curve->x);
    curve->y = cz_reader_allocate(curve->reader, (size_t)n_point, sizeof *curve->y);
    curve->place = cz_reader_allocate(curve->reader, (size_t)n_point, sizeof *curve->place);
    return curve->x != NULL && curve->y != NULL && curve->place != NULL;
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
    const CzKey key = {.kind = CZ_KEY_NUMBER,
                       .stem = stem,
                       .dimension = dimension,
                       .lo = 0,
                       .hi = dimension == CZ_DIMENSION_LENGTH ? 20 : 1e9};
    char name[64];
    snprintf(name, sizeof name, "%s_%s", stem, unit->suffix);
    const CzNode *key_node = cz_node_text(&curve->reader->arena, name, value);
    if (key_node == NULL)
        return false;
    return cz_bind_number(curve->reader, &key, unit, key_node, value, curve->trail, number);
}

/* Takes one point; false when it is none. */
static bool take_point(Curve *curve, const CzNode *x, const CzNode *y) {
    const int at = curve->n_point;
    const bool has_x =
        take_number(curve, curve->key->x, curve->x_unit, curve->key->dimension, x, &curve->x[at]);
    const bool has_y =
        take_number(curve, curve->key->y, curve->y_unit, curve->key->y_dimension, y, &curve->y[at]);
    if (!has_x || !has_y)
        return false;
    if (at > 0 && curve->x[at] <= curve->x[at - 1]) {
        cz_mistake(
            &curve->reader->mistakes, x, curve->trail,
            "'%s' must rise from point to point, but %.40s does not lie beyond the point before",
            curve->key->x, x->text);
        return false;
    }
    curve->place[at] = x;
    curve->n_point++;
    return true;
}

/* ---- points in the file ---- */

static bool read_columns(Curve *curve, const CzNode *node) {
    const CzEntry *columns = cz_node_find(node, "columns");
    if (columns == NULL || columns->value->kind != CZ_NODE_LIST || columns->value->n_entry != 2 ||
        columns->value->entry[0].value->kind != CZ_NODE_TEXT ||
        columns->value->entry[1].value->kind != CZ_NODE_TEXT) {
        cz_mistake(&curve->reader->mistakes, columns != NULL ? columns->value : node, curve->trail,
                   "'%s' needs 'columns', the names of its two columns", curve->key->stem);
        cz_mistake_help(&curve->reader->mistakes, "for example columns: [%s_mm, %s_kN]",
                        curve->key->x, curve->key->y);
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

/* ---- points in a CSV file ---- */

/* Cuts a line of two fields at the first ';' or ','; a mistake when it has not two. */
static bool cut_fields(Curve *curve, const CzSource *source, int line, const CzNode *fields[2]) {
    const char *text = source->line[line];
    const char separator = strchr(text, ';') != NULL ? ';' : ',';
    const char *cut = strchr(text, separator);
    const char *start[2] = {text, cut != NULL ? cut + 1 : text};
    const char *end[2] = {cut, text + strlen(text)};
    if (cut == NULL || strchr(cut + 1, separator) != NULL) {
        cz_mistake_at(&curve->reader->mistakes, source, line + 1, 1,
                      "a line has two columns, but this one has not");
        return false;
    }
    for (int i = 0; i < 2; i++) {
        while (*start[i] == ' ' || *start[i] == '\t' || *start[i] == '"')
            start[i]++;
        while (end[i] > start[i] && strchr(" \t\r\"", end[i][-1]) != NULL)
            end[i]--;
        CzNode *node = cz_reader_allocate(curve->reader, 1, sizeof *node);
        if (node == NULL)
            return false;
        node->source = source;
        node->line = line + 1;
        node->column = (int)(start[i] - text) + 1;
        node->text =
            cz_arena_copy_text(&curve->reader->arena, start[i], (size_t)(end[i] - start[i]));
        if (node->text == NULL)
            return false;
        fields[i] = node;
    }
    return true;
}

static bool is_blank(const char *line) {
    return line[strspn(line, " \t\r")] == '\0' || line[0] == '#';
}

static bool read_csv_lines(Curve *curve, const CzSource *source) {
    const CzNode *field[2];
    bool all_good = true, has_header = false;
    if (!make_room(curve, source->n_line))
        return false;
    for (int line = 0; line < source->n_line; line++) {
        if (is_blank(source->line[line]))
            continue;
        if (!cut_fields(curve, source, line, field)) {
            all_good = false;
            if (!has_header)
                return false;
        } else if (has_header) {
            all_good &= take_point(curve, field[0], field[1]);
        } else {
            has_header = true;
            curve->x_unit =
                column_unit(curve, field[0]->text, field[0], curve->key->x, curve->key->dimension);
            curve->y_unit = column_unit(curve, field[1]->text, field[1], curve->key->y,
                                        curve->key->y_dimension);
            if (curve->x_unit == NULL || curve->y_unit == NULL)
                return false;
        }
    }
    if (all_good && curve->n_point < 2) {
        cz_mistake_at(&curve->reader->mistakes, source, 1, 1, "the curve needs two points or more");
        return false;
    }
    return all_good;
}

static bool read_csv(Curve *curve, const CzNode *named) {
    CzReader *reader = curve->reader;
    const char *name = cz_bind_text(reader, "file", named, curve->trail);
    const char *path = name != NULL ? cz_load_locate(reader, name, named, "catalogue") : NULL;
    char *text = NULL;
    size_t n_byte = 0;
    if (path == NULL)
        return false;
    const CzSource *source =
        cz_sources_read(&reader->sources, &reader->mistakes, path, named, &text, &n_byte);
    bool is_read = source != NULL && cz_source_is_text(&reader->mistakes, source, text, n_byte);
    free(text);
    if (is_read && source->n_line > MOST_POINTS) {
        cz_mistake_at(&reader->mistakes, source, MOST_POINTS, 1, "a curve has at most %d lines",
                      (int)MOST_POINTS);
        is_read = false;
    }
    return is_read && read_csv_lines(curve, source);
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
               "'%s' needs 'basis': static or dynamic", curve->key->stem);
    cz_mistake_help(
        &curve->reader->mistakes,
        "a dynamic curve was measured at speed and already holds the rise with the rate");
    return false;
}

static void check_keys(Curve *curve, const CzNode *node) {
    static const char *const known[] = {"columns", "points", "file", "basis"};
    for (int i = 0; i < node->n_entry; i++) {
        bool is_known = false;
        for (int k = 0; k < 4; k++)
            is_known |= strcmp(node->entry[i].key->text, known[k]) == 0;
        if (!is_known)
            cz_mistake(&curve->reader->mistakes, node->entry[i].key, curve->trail,
                       "unknown key '%s' in '%s'; it takes columns, points, file, basis",
                       node->entry[i].key->text, curve->key->stem);
    }
}

static void reduce(Curve *curve, const CzNode *node, CzTable *table) {
    char energy[CZ_NUMBER_TEXT], force[CZ_NUMBER_TEXT];
    const int n_before = curve->n_point;
    int *scratch = cz_reader_allocate(curve->reader, (size_t)n_before, sizeof *scratch);
    if (scratch == NULL)
        return;
    const CzCurveChange change =
        cz_reduce_curve(curve->x, curve->y, &curve->n_point, CZ_MAX_CURVE_POINTS, scratch);
    if (curve->n_point < n_before)
        cz_mistake(
            &curve->reader->warnings, node, curve->trail,
            "'%s' was reduced from %d to %d points: energy %s kJ as before, force differs by up "
            "to %s kN",
            curve->key->stem, n_before, curve->n_point,
            cz_number_print_short(energy, change.area / 1e3),
            cz_number_print_short(force, change.largest_difference / 1e3));
    table->n_point = curve->n_point;
    memcpy(table->x, curve->x, (size_t)curve->n_point * sizeof table->x[0]);
    memcpy(table->y, curve->y, (size_t)curve->n_point * sizeof table->y[0]);
    table->given = true;
}

void cz_bind_table(CzReader *reader, const CzKey *key, const CzNode *node, const CzTrail *trail,
                   CzTable *table) {
    Curve curve = {.reader = reader, .key = key, .trail = trail};
    if (node->kind != CZ_NODE_MAPPING) {
        cz_mistake(&reader->mistakes, node, trail,
                   "'%s' needs {columns, points, basis} or {file, basis}", key->stem);
        return;
    }
    check_keys(&curve, node);
    const CzEntry *file = cz_node_find(node, "file");
    const bool has_basis = read_basis(&curve, node, table);
    bool is_read = false;
    if (file != NULL && cz_node_find(node, "points") != NULL)
        cz_mistake(&reader->mistakes, file->key, trail,
                   "'%s' has points here or in a file, not both", key->stem);
    else if (file != NULL)
        is_read = read_csv(&curve, file->value);
    else
        is_read = read_columns(&curve, node) && read_points(&curve, node);
    if (is_read && has_basis)
        reduce(&curve, node, table);
}
