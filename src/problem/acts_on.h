/* Keys that act on some models of vehicles only: a height of what has no height, a mass of what
 * cannot move. */
#ifndef CZ_PROBLEM_ACTS_ON_H
#define CZ_PROBLEM_ACTS_ON_H

#include "problem/reading.h"

/* Whether a key does anything on a model of vehicle. */
bool cz_key_acts_on(const CzKey *key, CzVehicleModel model);

/* The vehicle that a field belongs to; NULL for one that lies elsewhere. */
const CzVehicle *cz_vehicle_of(const CzProblem *problem, const void *address);

/* Whether the field of a key does anything on the vehicle that it belongs to; one that belongs to
 * none does. */
bool cz_field_acts(const CzProblem *problem, const CzKey *key, const void *field);

/* Warns of keys that do nothing on the model that they are written for. */
void cz_acts_on_check(CzProblem *problem);

/* Writes on which models a key acts behind its range; nothing when on all. */
void cz_acts_on_write(FILE *stream, const CzKey *key);

#endif
