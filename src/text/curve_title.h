/* Titles of columns of curve files: the unit in them, and which column is the one that is wanted.
 *
 * A unit is the end of a title behind a blank, '_', '/', ',', ':' or in brackets: stroke_mm,
 * "Load (N)", "Kraft in kN", "F [kN]". A column is found by its title or number, else by the name
 * of its quantity, else by a usual word for it, else as the only one in a unit of its dimension.
 */
#ifndef CZ_TEXT_CURVE_TITLE_H
#define CZ_TEXT_CURVE_TITLE_H

#include "text/curve_fields.h"
#include "text/units.h"

/* Unit by its spelling, of a dimension or of any (CZ_N_DIMENSION); NULL when it is none. */
const CzUnit *cz_curve_unit_find(CzDimension dimension, const char *spelling);

/* Unit at the end of a title, whatever its dimension is; NULL without one. `n_title`, unless NULL,
 * becomes the length of the title without it [byte]. */
const CzUnit *cz_curve_unit_of_title(const char *title, size_t *n_title);

/* Unit that a field of a row of units is, with brackets or without; NULL when it is none. */
const CzUnit *cz_curve_unit_alone(const CzField *field);

/* Lists the spellings of a dimension: "mm, cm, m". */
void cz_curve_unit_list(CzDimension dimension, char *text, size_t size);

/* A column that is wanted. */
typedef struct CzCurveColumn {
    const char *name; /* of the quantity, such as "stroke": what titles begin with */
    CzDimension dimension;
    const char *title; /* the title or number that was requested; NULL: by the quantity */
    const char *unit;  /* that was given; NULL: from the title or the row of units */
    double without;    /* SI value of a unit that is not written; 0: it must be */
    double largest;    /* size beyond which no number can be meant [SI]; 0: any can be */
    double in;         /* SI value of the unit that numbers are wanted in; 0: the SI unit */
} CzCurveColumn;

/* Number from 0 of a column that is wanted by its number; -1 for a title or for none. */
int cz_curve_column_number(const CzCurveColumn *column);

/* Finds the column in a line of titles, with a line of units below it or NULL; returns its number
 * from 0, -1 when there is none, -2 when several are as good. */
int cz_curve_column_find(const CzCurveColumn *column, const char *titles, const char *units,
                         char separator);

#endif
