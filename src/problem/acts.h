/* Keys that act in some cases only: on some models of vehicles, beside another key, or on a vehicle
 * end that meets something of a kind. */
#ifndef CZ_PROBLEM_ACTS_H
#define CZ_PROBLEM_ACTS_H

#include "problem/reading.h"

/* Whether a key does anything on a model of vehicle. */
bool cz_key_acts_on(const CzKey *key, CzVehicleModel model);

/* Whether a key needs something beside or against it. */
bool cz_key_is_conditional(const CzKey *key);

/* Whether the field of a key does something on the model of the vehicle that it belongs to; one
 * that belongs to none does. */
bool cz_field_acts_on_model(const CzProblem *problem, const CzKey *key, const void *field);

/* The same, and it is required or has what it needs beside and against it. */
bool cz_field_acts(const CzProblem *problem, const CzKey *key, const void *field);

/* Warns of written keys that do nothing. What is written once and used in several places does
 * something when it does so in one of them, but for models: there each place counts. */
void cz_acts_check(CzProblem *problem);

/* Writes behind a key's range where it acts; nothing when everywhere. */
void cz_acts_write(FILE *stream, const CzKey *key);

#endif
