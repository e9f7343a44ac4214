/* Curves of devices: by points, {columns, points, basis}, or in a separate file, {file, basis, ...}
 * with keys for its columns, part and signs. From a file the loading is read, with strokes that
 * rise from 0.
 *
 * A curve with more points than a table can store is reduced by its least significant points
 * (reduce_curve.h).
 */
#ifndef CZ_PROBLEM_BIND_CURVE_H
#define CZ_PROBLEM_BIND_CURVE_H

#include "problem/input.h"
#include "tree/reader.h"

/* Curves that were read, by node: a curve of a part is read once for all records that use the part,
 * and not again when the problem is reread, even if its file has changed. */
typedef struct CzReadCurve {
    const CzNode *node;
    const CzKey *key;
    CzTable table;
    const struct CzReadCurve *before; /* NULL for the first */
} CzReadCurve;

/* Reads a curve and adds it to the list; copies it when it is in the list already. */
void cz_bind_curve(CzReader *reader, const CzReadCurve **curves, const CzKey *key,
                   const CzNode *node, const CzTrail *trail, CzTable *table);

#endif
