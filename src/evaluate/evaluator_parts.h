/* The parts of an evaluator. */
#ifndef CZ_EVALUATE_EVALUATOR_PARTS_H
#define CZ_EVALUATE_EVALUATOR_PARTS_H

#include "evaluate/checks.h"
#include "evaluate/design.h"
#include "evaluate/evaluator.h"
#include "evaluate/match.h"
#include "evaluate/study.h"
#include "evaluate/variant.h"

/* A metric that the caller wants of every evaluation. */
typedef struct CzWanted {
    CzMetric metric;
    char name[CZ_PATH_SIZE];
    char scenario[CZ_NAME_SIZE]; /* only this scenario or family; empty for all */
} CzWanted;

struct CzEvaluator {
    CzArena arena;
    const CzProblem *problem;
    CzExecutor executor;
    CzStudy *study;   /* of its runs, for workers of the executor */
    CzManner manner;  /* of runs outside a search */
    const CzAim *aim; /* NULL: that of the file */
    CzObstacles obstacles;
    int n_scene;
    CzScene *scene;            /* (n_scene) */
    const char *only;          /* the only scenario that is run; NULL for all */
    int first_scenario;        /* scenarios before this one are not run */
    bool *is_left_out;         /* scenarios that the caller leaves out at present (n_scene) */
    const CzEvaluator *beside; /* whose tracks are used where they are the same; NULL for none */
    int n_variant;             /* one per combination of choices, 1 without any */
    CzVariant *variant;        /* (n_variant) */
    int own;                   /* variant of the file as written */
    CzModel *const *model;     /* its models; NULL for scenarios left out (n_scene) */
    int n_vehicle, n_variation;
    const CzVehicle *vehicles; /* its vehicles in each variation (n_variation x n_vehicle) */
    double *length; /* simulated time of the last run of each scenario, 0 before the first: for the
                       order of the runs only [s] (n_scene) */
    double *rate; /* crush rate for tube forces in each variation: half the largest closing speed of
                       its scenarios and of those without changes [m/s] (n_variation) */
    CzDesign design;
    CzChecklist list;
    int *constraint_check;        /* check behind each constraint (n_constraint) */
    const char **constraint_name; /* (n_constraint) */
    int n_detail;
    CzMatchList matches; /* of a fit: the last constraints */
    CzMetric objective;  /* kind NULL: the smallest margin */
    const char *objective_name, *objective_unit;
    CzObjective own_objective; /* the caller's; NULL when none */
    void *own_data;
    int n_wanted;
    CzWanted *wanted;                  /* not of the arena (n_wanted) */
    const volatile sig_atomic_t *stop; /* a flag that ends an evaluation; NULL when none */
};

/* Describes an evaluator to a worker; makes it there (evaluator_study.c). */
void cz_evaluator_describe(const void *evaluator, CzMemoryText *description);
CZ_MUST_CHECK CzStatus cz_evaluator_open(CzReading *description, void **study, CzError *error);
void cz_evaluator_close(void *study);
const CzEvaluator *cz_evaluator_opened(void *study);

/* Scenarios for the next variant, beside the first one. */
static inline CzVariantScenes cz_evaluator_scenes(const CzEvaluator *evaluator) {
    const CzEvaluator *of = evaluator->n_variant > 0 ? evaluator : evaluator->beside;
    return (CzVariantScenes){.problem = evaluator->problem,
                             .n = evaluator->n_scene,
                             .scene = evaluator->scene,
                             .only = evaluator->only,
                             .first = evaluator->first_scenario,
                             .beside = of != NULL ? &of->variant[0] : NULL};
}

/* Whether a metric is wanted of a scenario (wanted.c). */
bool cz_wanted_in_scenario(const CzWanted *wanted, const CzScene *scene);

/* The vehicles of a scenario among those of all variations of a design. */
static inline const CzVehicle *cz_vehicles_in(const CzEvaluator *evaluator,
                                              const CzVehicle *vehicles, int scenario) {
    return vehicles + evaluator->scene[scenario].variation * evaluator->n_vehicle;
}

#endif
