/* Curves of devices: by points, {columns, points, basis}, or in a file of their own, {file, basis,
 * ...} with what is needed to find columns, part and signs in it. Of a file the loading is taken,
 * with strokes that rise from 0.
 *
 * A curve of more points than a table holds loses the points that matter least (reduce_curve.h).
 */
#ifndef CZ_PROBLEM_BIND_CURVE_H
#define CZ_PROBLEM_BIND_CURVE_H

#include "problem/input.h"
#include "tree/reader.h"

/* Curves that were read, by their nodes: a curve of a part is read once for all records that use
 * the part, and not again when the problem is read again, even if its file has changed. */
typedef struct CzReadCurve {
    const CzNode *node;
    const CzKey *key;
    CzTable table;
    const struct CzReadCurve *before; /* NULL for the first */
} CzReadCurve;

/* Reads a curve, unless it is among those that were read: then a copy. It is added to them. */
void cz_bind_curve(CzReader *reader, const CzReadCurve **curves, const CzKey *key,
                   const CzNode *node, const CzTrail *trail, CzTable *table);

#endif
