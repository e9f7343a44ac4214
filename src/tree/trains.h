/* Trains written out: `copy`, `repeat` and `reversed` become plain vehicles with names.
 *
 * Vehicles are listed along +x. The names of a repeated vehicle are numbered on (A2 three times:
 * A2, A3, A4). A train that is reversed has its last vehicle first and every vehicle reversed. A
 * copy has the other's vehicles; names that begin with the other train's name are replaced along
 * +x, so that the copy of A1 to A6 is B1 to B6 in either direction; other names are prefixed with
 * the train's name.
 */
#ifndef CZ_TREE_TRAINS_H
#define CZ_TREE_TRAINS_H

#include "tree/parts.h"

enum { CZ_MAX_VEHICLES = 1000 };

/* The root with the vehicles of all trains written out; NULL without memory. */
const CzNode *cz_trains_write_out(CzReader *reader, const CzTree *tree);

/* The root with names for the vehicles of its trains that have none, so that an overlay can name
 * them; NULL without memory. */
const CzNode *cz_trains_name_vehicles(CzArena *arena, const CzNode *root);

/* Number of vehicles that an item of a list of vehicles represents. */
int cz_vehicle_repeat(const CzNode *vehicle);

/* Writes the name of the k-th vehicle of an item: `given` (may be NULL) counted on, or the train's
 * name and the position in the train. */
void cz_vehicle_name(char *text, size_t size, const CzNode *vehicle, const char *train,
                     int position, int k);

#endif
