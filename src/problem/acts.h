/* Keys that have an effect in some cases only: on some vehicle models, with another key, or on a
 * vehicle end with a certain partner. */
#ifndef CZ_PROBLEM_ACTS_H
#define CZ_PROBLEM_ACTS_H

#include "problem/reading.h"

/* Whether a key has an effect on a vehicle model. */
bool cz_key_acts_on(const CzKey *key, CzVehicleModel model);

/* Whether a key requires another key or a partner. */
bool cz_key_is_conditional(const CzKey *key);

/* Whether the field of a key has an effect on the model of its vehicle; always true for fields
 * outside of vehicles. */
bool cz_field_acts_on_model(const CzProblem *problem, const CzKey *key, const void *field);

/* The same, and the key is required or the other key and the partner that it requires exist. */
bool cz_field_acts(const CzProblem *problem, const CzKey *key, const void *field);

/* Warns of written keys without effect. A key that is written once and used in several places has
 * an effect when it has one in any of them; for vehicle models each place counts. */
void cz_acts_check(CzProblem *problem);

/* Writes after a key's range where it has an effect; nothing when that is everywhere. */
void cz_acts_write(FILE *stream, const CzKey *key);

#endif
