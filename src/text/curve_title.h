/* Titles of columns of curve files: their units, and the choice of a requested column.
 *
 * A unit is the end of a title after a blank, '_', '/', ',', ':' or in brackets: stroke_mm, "Load
 * (N)", "Kraft in kN", "F [kN]". A column is found by its title or number, else by the name of its
 * quantity, else by a common word for it, else as the only one with a unit of its dimension.
 */
#ifndef CZ_TEXT_CURVE_TITLE_H
#define CZ_TEXT_CURVE_TITLE_H

#include "text/curve_fields.h"
#include "text/units.h"

/* Unit by its spelling, of a dimension or of any (CZ_N_DIMENSION); NULL when it is not a unit. */
const CzUnit *cz_curve_unit_find(CzDimension dimension, const char *spelling);

/* Unit at the end of a title, of any dimension; NULL without one. `n_title`, unless NULL, becomes
 * the length of the title without it [byte]. */
const CzUnit *cz_curve_unit_of_title(const char *title, size_t *n_title);

/* Unit in a field of a row of units, with brackets or without; NULL when it is not a unit. */
const CzUnit *cz_curve_unit_alone(const CzField *field);

/* Lists the spellings of a dimension: "mm, cm, m". */
void cz_curve_unit_list(CzDimension dimension, char *text, size_t size);

/* A requested column. */
typedef struct CzCurveColumn {
    const char *name; /* of the quantity, such as "stroke": beginning of its titles */
    CzDimension dimension;
    const char *title; /* the title or number that was requested; NULL: by the quantity */
    const char *unit;  /* requested unit; NULL: from the title or the row of units */
    double without;    /* SI value of the unit if none is written; 0: a unit is required */
    double largest;    /* largest plausible magnitude [SI]; 0: no limit */
    double in;         /* SI value of the unit of the returned numbers; 0: the SI unit */
} CzCurveColumn;

/* Number from 0 of a column that is requested by number; -1 for a title or for none. */
int cz_curve_column_number(const CzCurveColumn *column);

/* Finds the column in a line of titles, with a line of units below it or NULL; returns its number
 * from 0, -1 when there is none, -2 when several have the same rank. */
int cz_curve_column_find(const CzCurveColumn *column, const char *titles, const char *units,
                         char separator);

#endif
