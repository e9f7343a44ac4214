/* The curve of a device that is in a file of its own: which columns, which part, which signs, and
 * from there the loading with rising strokes.
 */
#ifndef CZ_PROBLEM_BIND_CURVE_FILE_H
#define CZ_PROBLEM_BIND_CURVE_FILE_H

#include "tree/reader.h"

/* Whether a curve in a file takes a key. */
bool cz_curve_file_takes(const char *key);

/* Where the points of a curve go. */
typedef struct CzCurveInFile {
    int *n_point;
    double **x, **y; /* [SI] (n_point) */
} CzCurveInFile;

/* Reads the file that a curve names: its loading, with strokes that rise from 0. False with a
 * mistake, or without memory. */
bool cz_bind_curve_file(CzReader *reader, const CzKey *key, const CzNode *node,
                        const CzTrail *trail, const CzCurveInFile *points);

#endif
