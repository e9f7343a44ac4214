/* Trains and speeds of a scenario for the checks. */
#ifndef CZ_EVALUATE_SCENE_H
#define CZ_EVALUATE_SCENE_H

#include "base/arena.h"
#include "crushzone/evaluate.h"
#include "problem/problem.h"

typedef struct CzScene {
    const char *name;           /* of the scenario */
    const char *family;         /* its family; NULL for none */
    const struct CzScene *like; /* scene whose limits apply here too; NULL for none */
    int variation; /* of the vehicles: 0 for those of the problem, else counted with the scenes that
                      change values */
    int train[2];  /* trains of the problem, the one behind first */
    int n_vehicle; /* of both trains */
    const CzVehicle *const *vehicle; /* as written, along +x (n_vehicle) */
    const int *record;               /* their places in the problem's vehicle array (n_vehicle) */
    int colliding;                   /* interface between the two trains */
    double closing_speed;            /* at the start [m/s] */
    double rise; /* of the train ahead over the one behind, compared with their files [m] */
    const CzTexts *judged_by; /* names of the only checks that apply to it; NULL for all */
    bool is_obstacle[2];      /* whether a train is one, and so not judged */
    bool is_overload;         /* heavier than the others: judged for bottoming only */
    bool has_reserves;        /* whether design rules require their reserves */
} CzScene;

/* Whether a name denotes this scenario: its own name or that of its family. */
bool cz_scene_is(const CzScene *scene, const char *name);

/* Whether a limit that names a scenario or family applies here: this scene, or one that it is like.
 */
bool cz_scene_is_like(const CzScene *scene, const char *name);

/* Number of variations of the vehicles, at least 1. */
size_t cz_scenes_n_variation(int n_scene, const CzScene *scene);

/* Whether a vehicle, counted as in `vehicle`, belongs to an obstacle. */
static inline bool cz_scene_has_obstacle_at(const CzScene *scene, int vehicle) {
    return scene->is_obstacle[vehicle > scene->colliding];
}

/* The obstacles of a problem. */
typedef struct CzObstacles {
    int n;
    const CzNotJudged *train; /* those that collide in some scene (n) */
    const bool *has_vehicle;  /* whether a vehicle of the problem's array is part of one */
} CzObstacles;

/* Finds the obstacles and marks them in the scenes; memory comes from the arena. Statuses: CZ_OK,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_obstacles_find(const CzProblem *problem, int n_scene, CzScene *scene,
                                         CzArena *arena, CzObstacles *obstacles, CzError *error);

/* Whether checks of this name apply to the scenario. */
bool cz_scene_is_judged_by(const CzScene *scene, const char *check);

/* Mass factor from which a scenario is an overload case, and factor on the largest speed of the
 * others that one overload case must reach. */
#define CZ_OVERLOAD_FACTOR 1.1

/* Fills n_scenario scenes from a problem; memory comes from the arena. Statuses: CZ_OK,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_scenes_build(const CzProblem *problem, CzArena *arena, int *n_scene,
                                       CzScene **scene, CzError *error);

#endif
