/* One search. All algorithms evaluate designs through it, so that the limit of evaluations, the
 * history, the best design so far and the stop flag are in one place.
 *
 * Algorithms receive variables scaled to 0..1 and finite numbers only. The value of a failed design
 * is above all values so far and rises with the distance from the best design; a failed design is
 * never the best one.
 */
#ifndef CZ_OPTIMISE_SEARCH_H
#define CZ_OPTIMISE_SEARCH_H

#include <stdbool.h>

#include "crushzone/optimise.h"
#include "evaluate/evaluator.h"

/* The function to minimise. Arrays are borrowed. */
typedef struct CzFunction {
    int n_variable, n_constraint;
    const double *min, *max, *start; /* in the variables' units (n_variable) */
    const double *step;              /* catalogue increments, 0 for none (n_variable) */
    const CzConstraintKind *kind; /* of constraints (n_constraint); NULL: all are graded; algorithms
                                     do not see constraints that are a yes or no; an invalid design
                                     is the best only while all are */
    int n_detail; /* constraints place by place, so without the breakpoints of the worst place; 0
                     when there are none */
    const CzDetailKind *detail_kind; /* of details (n_detail); NULL: all are margins of runs */
    bool is_minimax;                 /* the objective is the largest constraint, up to a constant */
    bool is_fit; /* the objective is a sum of squares, the details are its residuals, and each flag
                    is whether one of them is small enough */

    /* Evaluates n_point designs: x is (n_point x n_variable), objective (n_point) with NaN for a
     * failed design, constraint (n_point x n_constraint), satisfied when at most 0, detail (n_point
     * x n_detail) unless NULL. The values of a design must not depend on its neighbours. */
    CzStatus (*evaluate)(void *data, int n_point, const double *x, double *objective,
                         double *constraint, double *detail, CzError *error);
    void *data;
    const bool *is_partial; /* designs of the last evaluation that were not run in all scenarios;
                               their details may be NaN; NULL for none */
} CzFunction;

/* Kind of a constraint. */
static inline CzConstraintKind cz_constraint_kind(const CzFunction *function, int constraint) {
    return function->kind != NULL ? function->kind[constraint] : CZ_CONSTRAINT_GRADED;
}

static inline CzDetailKind cz_detail_kind(const CzFunction *function, int detail) {
    return function->detail_kind != NULL ? function->detail_kind[detail] : CZ_DETAIL_OF_RUN;
}

enum { CZ_N_LARGEST = 8 };

/* One evaluated design. */
typedef struct CzRecord {
    double objective; /* NaN when failed */
    double violation; /* largest positive constraint; infinite when failed */
    double penalty;   /* sum of the compressed positive constraints, for a fit with the sum of
                         squares: infeasible designs are ranked by it */
    const char *phase;
    bool on_grid;    /* every variable is on its catalogue increment */
    bool is_barred;  /* a rule of problem files is violated */
    double missed;   /* largest positive constraint that is not a yes or no; 0 when there is none */
    bool is_partial; /* not run in all scenarios: objective, violation and penalty are lower bounds,
                        and a better design is known */
    double largest[CZ_N_LARGEST]; /* where the smallest margin is maximised, the largest graded
                                     constraints, in order: the first ones rank equal objectives */
} CzRecord;

typedef struct CzSearch {
    const CzFunction *function;
    long most_evaluations;
    int width; /* designs that are asked for at once where there is a choice */
    const volatile sig_atomic_t *stop; /* NULL when none */
    void (*progress)(const CzProgress *progress, void *data);
    void *progress_data;
    const char *phase; /* of the designs that are being evaluated */

    long n_earlier, most_in_all; /* evaluations of earlier searches, and limit of all searches, for
                                    the progress */

    long n_record, room;
    CzRecord *record;  /* history in order (n_record) */
    double *x;         /* (n_record x n_variable) */
    double *detail;    /* details, uncompressed (n_record x cz_search_n_detail) */
    long best;         /* record of the best design so far, -1 when none */
    long best_on_grid; /* likewise among those on the catalogue increments */
    long last_gain;    /* number of evaluations when the best last improved by more than 0.1 % */

    double worst_objective, worst_constraint; /* over the designs that did not fail */
    bool is_over;    /* no further evaluation is allowed; `status` and `why` give the reason */
    bool is_snapped; /* the catalogue increments around the best design have been evaluated */
    bool is_spent;   /* all evaluations except those for the catalogue increments have been used */
    bool is_paused;  /* most of the latest designs failed, so the phase ends */
    long n_before_window; /* records before the window in which failures are counted */
    CzStatus status;
    CzError error;
    char why[128];
} CzSearch;

/* Starts a search; `options` gives limit, stop flag and progress. The function remains owned by the
 * caller. */
void cz_search_init(CzSearch *search, const CzFunction *function, const CzOptimiseOptions *options);
void cz_search_free(CzSearch *search);

/* The values of a design as a record; whether it is `on_grid` remains open. */
CzRecord cz_search_judge(const CzFunction *function, const char *phase, double objective,
                         const double *constraint);

/* Whether a record is better: valid designs first, then by smaller penalty, then by smaller
 * objective; where the smallest margins are equal, by the next ones. */
bool cz_record_is_better(const CzRecord *record, const CzRecord *other);

/* Evaluations left; 0 when the search is over or paused. */
long cz_search_left(const CzSearch *search);

/* Ends a pause. */
void cz_search_resume(CzSearch *search);

/* Ends the search because memory is short. */
void cz_search_end_without_memory(CzSearch *search);

/* Memory for n numbers, freed by the caller; without memory NULL, and the search ends with that
 * status. */
double *cz_search_numbers(CzSearch *search, size_t n);

/* Evaluates n designs, x in the variables' units (n x n_variable), in order. objective (n) and
 * constraint (n x n_constraint) get finite numbers; constraints far above 0 are compressed
 * logarithmically, flags are -1. `detail`, unless NULL, gets the uncompressed details
 * (n x cz_search_n_detail), which are the constraints where the function has no details. Returns
 * false when the search ended before all were evaluated; the outputs are then not set. */
bool cz_search_evaluate(CzSearch *search, const char *phase, int n, const double *x,
                        double *objective, double *constraint, double *detail);
int cz_search_n_detail(const CzSearch *search);

/* Evaluates the start exactly as given. */
bool cz_search_evaluate_start(CzSearch *search, const char *phase);

/* A constraint on the scale of penalties: unchanged up to 0.1, logarithmic above. */
double cz_search_compressed(double constraint);
double cz_search_compressed_slope(double constraint);
double cz_search_expanded(double compressed); /* the inverse, up to the exponential of 10 */

/* The residual of a further constraint of a fit: above 0 from slightly below the limit on. */
double cz_search_residual(double constraint);

/* Converts scaled variables of n designs to natural ones; u is clamped to 0..1. */
void cz_search_unscale(const CzSearch *search, int n, const double *u, double *x);
void cz_search_scale(const CzSearch *search, const double *x, double *u);

/* Step of a scaled variable for a secant: negative where a positive step would leave the bounds. */
static inline double cz_search_secant(double at, double step) {
    return at + step <= 1 ? step : -step;
}

/* Whether the scaled design of a record, which is written to u (n_variable), is at a root mean
 * square distance of `apart` or more from each of the chosen ones (n_chosen x n_variable). */
bool cz_search_is_apart(const CzSearch *search, long record, int n_chosen, const double *chosen,
                        double apart, double *u);

/* Variables of a record (n_variable). */
const double *cz_search_x(const CzSearch *search, long record);

/* Details of a record (cz_search_n_detail); those of a scenario that was left out are NaN. */
const double *cz_search_detail(const CzSearch *search, long record);

/* The same for records of a search by number; a number below 0 is worse than any. */
bool cz_search_is_better(const CzSearch *search, long record, long other);

/* Whether it is better by enough to continue a search from there. */
bool cz_search_is_gain(const CzSearch *search, long record, long other);

/* Record with exactly these variables, -1 when there is none. */
long cz_search_find(const CzSearch *search, const double *x);

/* Whether every variable of a design is on its catalogue increment. */
bool cz_search_is_on_grid(const CzSearch *search, const double *x);

/* Nearest design on the catalogue increments within the bounds. */
void cz_search_round(const CzSearch *search, const double *x, double *rounded);
bool cz_search_has_steps(const CzSearch *search);

#endif
