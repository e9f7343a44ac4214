/* Curves by points: {columns, points, basis} in the file, or {file, basis, ...} in a file of its
 * own (bind_curve_file.h).
 *
 * A curve of more points than a table holds loses the points that matter least (reduce_curve.h).
 */
#ifndef CZ_PROBLEM_BIND_TABLE_H
#define CZ_PROBLEM_BIND_TABLE_H

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
void cz_bind_table(CzReader *reader, const CzReadCurve **curves, const CzKey *key,
                   const CzNode *node, const CzTrail *trail, CzTable *table);

#endif
