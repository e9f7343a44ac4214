/* The one reader of curve files: two columns of numbers out of what testing machines, spreadsheets
 * and programs write.
 *
 *   lines before the titles                 passed over (a preamble), as are comments
 *   one line of titles, perhaps one of units
 *   points to the end of the file
 *
 * A file without titles is read when columns and units are given. What can be read in two ways is
 * refused with both of them.
 */
#ifndef CZ_PROBLEM_CURVE_FILE_H
#define CZ_PROBLEM_CURVE_FILE_H

#include "problem/curve_title.h"

/* What is wanted of a file. Texts are borrowed. */
typedef struct CzCurveRequest {
    CzCurveColumn column[2]; /* x and y */
    char separator;          /* between fields, ' ' for blanks; 0: what the lines show */
    char decimal;            /* '.' or ','; 0: what the numbers show */
    /* How a user settles what the file leaves open; NULL: only in the file. */
    const char *column_help, *unit_help, *decimal_help;
} CzCurveRequest;

/* The points in the order of the file. */
typedef struct CzCurvePoints {
    int n;
    double *x, *y;                     /* [SI] (n) */
    int *line;                         /* where each is, counted from 1 (n) */
    char title[2][CZ_MOST_FIELD_TEXT]; /* of both columns; "" without titles */
    double unit[2];                    /* SI values of the units */
    const CzSource *source;
} CzCurvePoints;

/* Reads a text that was read from `source`, whose name goes into messages and whose lines become
 * those that are read: UTF-8, whatever the file is written in. False with a mistake, or without
 * memory. */
bool cz_curve_points_read(CzArena *arena, CzMistakes *mistakes, CzSource *source, const char *text,
                          size_t n_byte, const CzCurveRequest *request, CzCurvePoints *points);

/* Reads a file ("-" is standard input), and the same from memory, which `name` stands for in
 * messages. Statuses: CZ_OK, CZ_STATUS_INPUT with the first mistake, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_curve_points_read_file(CzArena *arena, const char *path,
                                                 const CzCurveRequest *request,
                                                 CzCurvePoints *points, CzError *error);
CZ_MUST_CHECK CzStatus cz_curve_points_read_memory(CzArena *arena, const char *name,
                                                   const char *text, size_t n_byte,
                                                   const CzCurveRequest *request,
                                                   CzCurvePoints *points, CzError *error);

/* The line of titles of a file, and the separator of its fields, which is looked for unless it is
 * given. Statuses as above. */
CZ_MUST_CHECK CzStatus cz_curve_titles_read(CzArena *arena, const char *path, char *separator,
                                            const char **titles, CzError *error);

#endif
