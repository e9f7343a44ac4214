/* Curves by points: {columns, points, basis} in the file, or {file, basis, ...} in a file of its
 * own (bind_curve_file.h).
 *
 * A curve of more points than a table holds loses the points that matter least (reduce_curve.h).
 */
#ifndef CZ_PROBLEM_BIND_TABLE_H
#define CZ_PROBLEM_BIND_TABLE_H

#include "problem/input.h"
#include "tree/reader.h"

void cz_bind_table(CzReader *reader, const CzKey *key, const CzNode *node, const CzTrail *trail,
                   CzTable *table);

#endif
