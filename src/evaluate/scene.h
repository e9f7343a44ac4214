/* Who collides with whom in a scenario, and how fast: what the checks need to know of a problem. */
#ifndef CZ_EVALUATE_SCENE_H
#define CZ_EVALUATE_SCENE_H

#include "base/arena.h"
#include "problem/problem.h"

typedef struct CzScene {
    const char *name;                /* of the scenario */
    const char *family;              /* that it belongs to; NULL for none */
    int train[2];                    /* trains of the problem, the one behind first */
    int n_vehicle;                   /* of both trains */
    const CzVehicle *const *vehicle; /* as written, along +x (n_vehicle) */
    const int *record;               /* their places in the problem's vehicle array (n_vehicle) */
    int colliding;                   /* interface between the two trains */
    double closing_speed;            /* at the start [m/s] */
    const CzTexts *judged_by;        /* names of the only checks that judge it; NULL for all */
    bool is_overload;                /* heavier than the others: judged for bottoming only */
} CzScene;

/* Whether a name means this scenario: its own or that of its family. */
bool cz_scene_is(const CzScene *scene, const char *name);

/* Whether checks of this name judge the scenario. */
bool cz_scene_is_judged_by(const CzScene *scene, const char *check);

/* Mass factor from which a scenario is an overload case, and the factor on the speed that it must
 * reach to cover the others. */
#define CZ_OVERLOAD_FACTOR 1.1

/* Fills n_scenario scenes from a problem; memory comes from the arena. Statuses: CZ_OK,
 * CZ_STATUS_NO_MEMORY, CZ_STATUS_INPUT for a train that does not exist. */
CZ_MUST_CHECK CzStatus cz_scenes_build(const CzProblem *problem, CzArena *arena, int *n_scene,
                                       CzScene **scene, CzError *error);

#endif
