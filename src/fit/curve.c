/* A measured curve of any two quantities, for figures. */
#include "crushzone/fit.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "text/curve_file.h"

/* A copy with its own memory; NULL without memory. */
static CzCurve *copy_points(const CzCurvePoints *points) {
    CzCurve *made = calloc(1, sizeof *made);
    const size_t size = (size_t)points->n * sizeof *points->x;
    if (made == NULL)
        return NULL;
    made->n = points->n;
    made->x = malloc(size);
    made->y = malloc(size);
    if (made->x == NULL || made->y == NULL) {
        cz_curve_free(made);
        return NULL;
    }
    memcpy(made->x, points->x, size);
    memcpy(made->y, points->y, size);
    return made;
}

/* A column of a quantity; without a dimension it has no unit. */
static CzCurveColumn column_of(const char *quantity, const char *title) {
    CzDimension dimension = 0;
    while (dimension < CZ_N_DIMENSION && strcmp(cz_dimension_text[dimension], quantity) != 0)
        dimension++;
    const bool has_none = dimension == CZ_N_DIMENSION || dimension == CZ_DIMENSION_NONE;
    return (CzCurveColumn){.name = quantity,
                           .dimension = has_none ? CZ_DIMENSION_NONE : dimension,
                           .title = title,
                           .without = has_none ? 1.0 : 0.0};
}

CzStatus cz_curve_read(const char *path, const CzCurveColumns *columns, CzCurve **curve,
                       CzError *error) {
    const CzCurveRequest request = {
        .column = {column_of(columns->x_quantity, columns->x),
                   column_of(columns->y_quantity, columns->y)},
        .separator = columns->separator,
        .decimal = columns->decimal,
        .column_help = "--column takes the titles of columns or their numbers from 1",
        .unit_help = "the first column is the abscissa, the second or --column the ordinate; a "
                     "title ends in its unit, as t_ms or \"force [kN]\", or a row of units is "
                     "below the titles",
        .decimal_help = "specify --csv-decimal . or --csv-decimal ,",
    };
    CzArena arena = {0};
    CzCurvePoints points;
    *curve = NULL;
    CzStatus status = cz_curve_points_read_file(&arena, path, &request, &points, error);
    if (status == CZ_OK) {
        *curve = copy_points(&points);
        if (*curve == NULL)
            status = cz_no_memory(error, "a curve");
    }
    cz_arena_free(&arena);
    return status;
}

void cz_curve_free(CzCurve *curve) {
    if (curve == NULL)
        return;
    free(curve->x);
    free(curve->y);
    free(curve);
}

/* ---- titles ---- */

/* The fields of a line as pointers followed by their texts, in one block; NULL without memory. */
static char **fields_of(const char *line, char separator, int n) {
    size_t n_byte = 0;
    for (CzFieldWalk walk = cz_fields_begin(line, separator); cz_fields_next(&walk);)
        n_byte += walk.field.n + 1;
    char **title = malloc((size_t)n * sizeof *title + n_byte);
    if (title == NULL)
        return NULL;
    char *text = (char *)(title + n);
    CzFieldWalk walk = cz_fields_begin(line, separator);
    while (walk.n < n && cz_fields_next(&walk)) {
        title[walk.n - 1] = memcpy(text, walk.field.text, walk.field.n);
        text[walk.field.n] = '\0';
        text += walk.field.n + 1;
    }
    return title;
}

CzStatus cz_curve_titles(const char *path, char separator, int *n, char ***title, CzError *error) {
    CzArena arena = {0};
    const char *line = NULL;
    CzStatus status = cz_curve_titles_read(&arena, path, &separator, &line, error);
    *n = 0;
    *title = NULL;
    if (status == CZ_OK) {
        *n = cz_fields_count(line, separator).all;
        *title = fields_of(line, separator, *n);
        if (*title == NULL)
            status = cz_no_memory(error, "the titles");
    }
    cz_arena_free(&arena);
    return status;
}
