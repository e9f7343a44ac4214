/* The curve of a device that is in a file of its own: which columns, which part, which signs, and
 * from there the loading with rising strokes.
 */
#ifndef CZ_PROBLEM_BIND_CURVE_FILE_H
#define CZ_PROBLEM_BIND_CURVE_FILE_H

#include "problem/trace.h"
#include "tree/reader.h"

/* Whether a curve in a file takes a key. */
bool cz_curve_file_takes(const char *key);

/* Reads the file that a curve names: its loading, with strokes that rise from 0. False with a
 * mistake, or without memory. */
bool cz_bind_curve_file(CzReader *reader, const CzKey *key, const CzNode *node,
                        const CzTrail *trail, CzTrace *trace);

#endif
