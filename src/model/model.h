/* The parts of a model that a run reads. */
#ifndef CZ_MODEL_MODEL_H
#define CZ_MODEL_MODEL_H

#include "base/arena.h"
#include "crushzone/model.h"
#include "crushzone/names.h"
#include "model/lanes.h"
#include "model/track.h"
#include "problem/problem.h"

/* One car of the scenario, along +x. */
typedef struct CzCar {
    char name[CZ_NAME_SIZE];
    int vehicle; /* index into the problem's vehicle array */
    int train;   /* 0: behind, 1: ahead */
    CzVehicleModel model;
    const CzBrake
        *brake; /* of its train, with the scenario's ratio in `brake_ratio`; NULL if none */
    double brake_ratio;
    double speed;   /* [m/s] */
    bool has_stops; /* bump and lift stops of primary and secondary are declared */
} CzCar;

struct CzModel {
    CzArena arena;
    const CzProblem *problem;
    const CzScenario *scenario; /* never NULL: the default one when the file lists none */
    int train[2];               /* of the input: behind, ahead */
    int n_car;
    CzCar *car;
    int colliding; /* interface between the two trains */
    int perturbed; /* inner interface that the scenario perturbs; -1 for none */
    char (*interface_name)[CZ_INTERFACE_SIZE]; /* (n_car - 1) */
    const CzSimulation *simulation;
    const CzTrackModes *track; /* NULL on a rigid track, and without wheels */
    double friction;           /* peak wheel-rail friction of the scenario */
    double time_step;          /* [s] */
    double duration;           /* [s]; NaN: until the end criterion is met */
    double longest;            /* [s] */
    double hold; /* time for which the end criterion must be met: the longest body pitch period;
                    0.02 s without full cars (ours) [s] */
    int n_bound;
    CzStepBound *bound;           /* smallest first */
    CzLanesHave has;              /* in the lanes of the problem's own design */
    int n_breakpoint[CZ_N_CURVE]; /* breakpoints that suffice for every design, from the number of
                                     stages or points */
    CzVehicleProperties *properties;             /* (n_car) */
    CzInterfaceProperties *interface_properties; /* (n_car - 1) */
};

/* Memory for the lanes of n_design designs, neutral everywhere; NULL when there is none. */
static inline CzLanes *cz_model_lanes(const CzModel *model, int n_design, CzArena *arena) {
    return cz_lanes_create(model->n_car, n_design, model->n_breakpoint, arena);
}

/* Fills the lanes of one design from a vehicle array (the problem's own or a candidate's). Fails
 * with CZ_STATUS_INPUT and a sentence when the values are impossible (strokes not positive, masses
 * not positive, ...). */
CZ_MUST_CHECK CzStatus cz_model_fill(const CzModel *model, const CzVehicle *vehicles, int design,
                                     CzLanes *lanes, CzError *error);

#endif
