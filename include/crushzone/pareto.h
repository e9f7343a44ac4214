/* Fronts: what one objective costs in another one.
 *
 * Each objective is minimised alone; between these two ends the first one is minimised with upper
 * limits on the second one, evenly spaced (epsilon-constraint method). Each of these searches
 * begins at the design of its neighbour with the stricter limit, which satisfies its own limit too.
 * Every point is the outcome of a search of its own, verified as any optimum.
 */
#ifndef CRUSHZONE_PARETO_H
#define CRUSHZONE_PARETO_H

#include "crushzone/optimise.h"

CZ_BEGIN_DECLARATIONS

/* Name of an objective that is not a metric: the smallest margin of all constraints, which is
 * maximised. */
#define CZ_PARETO_MARGIN "margin"

typedef struct CzParetoOptions {
    const char *minimise[2];    /* metrics, one of them may be CZ_PARETO_MARGIN */
    int n_point;                /* with the ends, at least 2 */
    int n_job;                  /* threads; 0: one per processor */
    const CzExecutor *executor; /* where its tasks run; NULL: in n_job threads */
    CzOptimiseOptions search;   /* of each point; `start` has no meaning, `journal` is that of all
                                   searches in their order, without earlier ones */
    void (*begins)(int point, int n_point, void *data); /* before each search for a point, counted
                                                           from 0; NULL when none */
    void *begins_data;
} CzParetoOptions;
CZ_API CzParetoOptions cz_pareto_options_default(void);

/* State of a point. */
typedef enum CzParetoState {
    CZ_PARETO_VERIFIED,
    CZ_PARETO_NOT_VERIFIED, /* it satisfies every constraint, but its verification fails or was
                               interrupted */
    CZ_PARETO_INFEASIBLE,   /* the search found no design that does */
    CZ_PARETO_FAILED,       /* the search ended without any successful run */
    CZ_PARETO_NOT_NEEDED,   /* both ends are one design, so there is nothing between them */
    CZ_PARETO_NOT_RUN       /* interrupted before, or without the ends it has no limit */
} CzParetoState;
CZ_API const char *cz_pareto_state_text(CzParetoState state);

/* An objective. Texts are borrowed from the front. */
typedef struct CzParetoObjective {
    const char *name, *unit;
    bool is_margin; /* larger is better */
} CzParetoObjective;

typedef struct CzParetoPoint {
    CzParetoState state;
    double bound;    /* limit on the bounded objective, in its unit; NaN for the ends */
    double value[2]; /* of the objectives, in their units; NaN without a design */
    double *x; /* the design, of the least violation when infeasible, in the variables' units; NULL
                  without a design (n_variable) */
    bool between_increments; /* a variable is between its catalogue increments */
    int dominated_by;  /* a feasible point that is as good in both objectives and better in one, or
                          one of several equal ones; -1 for none */
    CzVerdict verdict; /* of all checks */
    double violation; /* largest, of checks and limit; 0 when feasible, infinite without a design */
    long n_evaluation;
    char why[512]; /* why the search ended, or failed */
} CzParetoPoint;

/* Open result, owns its memory. */
typedef struct CzPareto {
    CzParetoObjective objective[2];
    int bounded;            /* the objective that has the limits: the second one, or the margin */
    CzEvaluator *evaluator; /* of the first objective alone, for the variables */
    int n_variable;
    int n_point;
    CzParetoPoint
        *point; /* from the least of the first objective to that of the second (n_point) */
    bool is_interrupted;
    double wall_s;
} CzPareto;

/* Finds a front. The problem must outlive it. *pareto is created whenever CZ_OK is returned, also
 * for an interrupted one. Statuses: CZ_OK (look at the points), CZ_STATUS_INPUT as cz_optimise,
 * also for equal objectives or a fit, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_pareto(const CzProblem *problem, const CzParetoOptions *options,
                                        CzPareto **pareto, CzError *error);
CZ_API void cz_pareto_free(CzPareto *pareto);

/* Whether the design of a point satisfies every constraint. */
CZ_API bool cz_pareto_is_feasible(const CzParetoPoint *point);

CZ_END_DECLARATIONS
#endif
