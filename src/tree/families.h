/* Families of scenarios written out: a scenario with `sweep` becomes one scenario per combination
 * of the values that are listed there.
 *
 *   {name: climb, sweep: {speed_km_h: [20, 25], height_offset_mm: [-40, 40]}}
 *     -> climb_20km_h_-40mm, climb_20km_h_40mm, climb_25km_h_-40mm, climb_25km_h_40mm
 *
 * Members keep everything else that the family says and name it in `family`.
 */
#ifndef CZ_TREE_FAMILIES_H
#define CZ_TREE_FAMILIES_H

#include "tree/parts.h"

/* The root with every scenario that has `sweep` written out as its members; NULL without memory. */
const CzNode *cz_families_write_out(CzReader *reader, const CzTree *tree);

#endif
