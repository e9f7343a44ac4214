/* Candidate changes: one value of the vehicles, changed in all of them by the same share. */
#ifndef CZ_EVALUATE_CANDIDATE_CHANGES_H
#define CZ_EVALUATE_CANDIDATE_CHANGES_H

#include "crushzone/explain.h"
#include "problem/input.h"

int cz_n_candidate_kind(void);

/* Fills name, key, cause and value of a candidate; false when no vehicle has the value. */
bool cz_candidate_find(int kind, const CzVehicle *vehicles, int n_vehicle,
                       CzCandidateChange *candidate);

/* Changes the value in all vehicles by a share of itself, or of the candidate's reference where
 * that is larger; values stay in the range of their key. Returns the new value of the first vehicle
 * that has one, in the key's unit. */
double cz_candidate_apply(int kind, double change, CzVehicle *vehicles, int n_vehicle);

#endif
