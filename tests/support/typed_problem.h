/* Problems made of typed records, without a file: defaults from keys.def, vehicles of round
 * numbers. */
#ifndef CZ_TESTS_TYPED_PROBLEM_H
#define CZ_TESTS_TYPED_PROBLEM_H

#include "problem/problem.h"

/* A record as the reader would leave it when nothing is given: default_CzTube() and so on. */
#define CZ_RECORD(type, name, doc, keys) type default_##type(void);
#include "problem/keys.def"

enum { TYPED_MAX_VEHICLE = 16, TYPED_MAX_SCENARIO = 4 };

/* Replaces the reader's result; link typed_problem.c. */
struct CzProblem {
    CzInput input;
    CzTrain train[2];
    CzVehicle vehicle[TYPED_MAX_VEHICLE];
    CzScenario scenario[TYPED_MAX_SCENARIO];
    const void *asked; /* field whose place was requested last */
};

/* Two trains of equal or unequal vehicles; speeds in m/s. The names are A1, A2, ... and B1, ... */
void typed_problem_init(struct CzProblem *problem, int n_behind, const CzVehicle *behind,
                        int n_ahead, const CzVehicle *ahead, double speed);

/* A rigid vehicle, a wall, and a full car with couplers and anti-climbers at both ends. */
CzVehicle typed_rigid(double mass);
CzVehicle typed_wall(void);
CzVehicle typed_full(void);

/* An end of a rigid vehicle, at its foremost plane. */
CzEnd typed_bare_end(void);

#endif
