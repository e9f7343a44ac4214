/* A curve file while it is read: its titles and units, shared by the files of the reader.
 */
#ifndef CZ_TEXT_CURVE_COLUMNS_H
#define CZ_TEXT_CURVE_COLUMNS_H

#include "text/curve_title.h"

/* Columns and format requested of a file. Texts are borrowed. */
typedef struct CzCurveRequest {
    CzCurveColumn column[2]; /* x and y */
    char separator;          /* between fields, ' ' for spaces; 0: found from the lines */
    char decimal;            /* '.' or ','; 0: found from the numbers */
    /* Options with which a user resolves an ambiguous file; NULL: only by changing the file. */
    const char *column_help, *unit_help, *decimal_help;
} CzCurveRequest;

/* The points in the order of the file. */
typedef struct CzCurvePoints {
    int n;
    double *x, *y;                    /* [SI] (n) */
    int *line;                        /* line of each, counted from 1 (n) */
    char title[2][CZ_MAX_FIELD_TEXT]; /* of both columns; "" without titles */
    double unit[2];                   /* SI values of the units */
    const char *other_unit[2]; /* unit in the file that differs from the requested one, or NULL */
    const CzSource *source;
} CzCurvePoints;

/* Lines are counted from 0. */
typedef struct CzCurveReading {
    CzMistakes *mistakes;
    CzSource source;
    const CzCurveRequest *request;
    CzCurvePoints *points;
    char separator, decimal;
    int *next; /* for each line, itself or the first line after it that is neither empty nor a
                  comment; n_line at the end (n_line + 1) */
    int first; /* line after the one that announces the separator */
    const char *titles; /* NULL if none */
    const char *units;  /* line of units; NULL if none */
    bool names_columns; /* the requested titles are those of a file without titles, whose two
                           columns are in this order */
    int title_line, unit_line;
    int data; /* first line of points */
    int index[2];
    int n_field[2]; /* of the titles, or of the first point: all, and up to the last filled one */
} CzCurveReading;

/* Lists the lines that are neither empty nor comments. False without memory. */
bool cz_reading_list_lines(CzArena *arena, CzCurveReading *reading);

/* The first line, not before `line`, that is neither empty nor a comment; n_line if none. */
int cz_reading_next(const CzCurveReading *reading, int line);

/* The column of a field, x (0) or y (1); -1 for another one. */
static inline int cz_reading_column(const CzCurveReading *reading, int field) {
    return field == reading->index[1] ? 1 : field == reading->index[0] ? 0 : -1;
}

/* Finds titles, row of units and the first line of points in the lines, else in the comments, and
 * the numbers of both columns, or reports what is missing. */
bool cz_reading_find_columns(CzCurveReading *reading);

/* Rejects a line with an opening quote and no closing one, because the ends of its fields are
 * unknown. */
bool cz_reading_has_whole_quotes(const CzCurveReading *reading, int line);

/* Finds titles alone, of any columns. */
bool cz_reading_find_titles(CzCurveReading *reading);

/* Finds the unit of one of the columns: from the request, the title, or the row of units. */
bool cz_reading_find_unit(CzCurveReading *reading, int column);

#endif
