/* Profiles of limits: reading one and keeping what its category requires. */
#ifndef CZ_PROBLEM_PROFILE_H
#define CZ_PROBLEM_PROFILE_H

#include "problem/reading.h"

/* Reads the profile that the problem names, with the limits of its category. */
void cz_profile_read(CzProblem *problem);

#endif
