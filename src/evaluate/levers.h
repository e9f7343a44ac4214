/* Levers: values of the vehicles that are changed in all of them alike, to see what a result hangs
 * on. */
#ifndef CZ_EVALUATE_LEVERS_H
#define CZ_EVALUATE_LEVERS_H

#include "crushzone/explain.h"
#include "problem/input.h"

int cz_n_lever_kind(void);

/* Fills name, key, cause and value of a lever; false when no vehicle has the value. */
bool cz_lever_find(int kind, const CzVehicle *vehicles, int n_vehicle, CzLever *lever);

/* Changes the value in all vehicles by a share of itself, or of the lever's reference where that is
 * larger; values stay in the range of their key. Returns the new value of the first vehicle that
 * has one, in the key's unit. */
double cz_lever_apply(int kind, double change, CzVehicle *vehicles, int n_vehicle);

#endif
