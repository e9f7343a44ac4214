/* One search: every evaluation passes here, so that the budget, the history, the best design so far
 * and the wish to stop are kept in one place, whatever algorithm asks.
 *
 * Algorithms see variables scaled to 0..1 and finite numbers only. A design that failed is answered
 * by a ramp above everything seen, rising with the distance from the best design, and is never
 * the best one.
 */
#ifndef CZ_OPTIMISE_SEARCH_H
#define CZ_OPTIMISE_SEARCH_H

#include <stdbool.h>

#include "crushzone/optimise.h"

/* What is searched. Arrays are borrowed. */
typedef struct CzFunction {
    int n_variable, n_constraint;
    const double *min, *max, *start; /* in the variables' units (n_variable) */
    const double *step;              /* catalogue increments, 0 for none (n_variable) */
    const bool *is_flag; /* constraints that are a mere yes or no (n_constraint), NULL for none:
                            they count in what is kept, but no algorithm is shown such a step */
    const bool *is_rule; /* constraints without which a design could not be written down and read
                            back (n_constraint), NULL for none: one that breaks them is never the
                            best while another was seen */
    int n_detail; /* constraints again, place by place and so without the breakpoints of the worst
                     one; 0 when there are none */
    bool is_minimax; /* the objective is the largest constraint, up to a constant */
    bool is_fit;     /* the objective is a sum of squares, the details its residuals, and the flags
                        say whether they are small enough */

    /* Answers n_point designs: x is (n_point x n_variable), objective (n_point) with NaN for a
     * failed design, constraint (n_point x n_constraint), kept when at most 0, detail (n_point x
     * n_detail) unless NULL. The answer of a design must not depend on its neighbours. */
    CzStatus (*evaluate)(void *data, int n_point, const double *x, double *objective,
                         double *constraint, double *detail, CzError *error);
    void *data;
} CzFunction;

/* One evaluated design. */
typedef struct CzRecord {
    double objective; /* NaN when failed */
    double violation; /* largest positive constraint; infinite when failed */
    double penalty;   /* sum of the compressed positive constraints, of a fit beside the sum of
                         squares: what infeasible designs are ranked by */
    const char *phase;
    bool on_grid;   /* every variable lies on its catalogue increment */
    bool is_barred; /* a rule of files is broken */
    double missed;  /* largest positive constraint that is no yes or no; 0 when there is none */
} CzRecord;

typedef struct CzSearch {
    const CzFunction *function;
    long most_evaluations;
    const volatile sig_atomic_t *stop; /* NULL when none */
    void (*progress)(const CzProgress *progress, void *data);
    void *progress_data;

    long n_earlier, most_in_all; /* evaluations of earlier searches, and limit of all together, for
                                    the progress */

    long n_record, room;
    CzRecord *record;  /* history in order (n_record) */
    double *x;         /* (n_record x n_variable) */
    long best;         /* record of the best design so far, -1 when none */
    long best_on_grid; /* likewise among those on the catalogue increments */
    long last_gain;    /* number of evaluations when the best last improved by more than 0.1 % */

    double worst_objective, worst_constraint; /* over the designs that did not fail */
    bool is_over;         /* nothing more may be evaluated; `status` and `why` say why */
    bool is_snapped;      /* the catalogue increments around the best design have been evaluated */
    bool is_spent;        /* all evaluations but those for the catalogue increments were used */
    bool is_paused;       /* most of the latest designs failed: looking on from there is no use */
    long n_before_window; /* records that the watch on failures does not count any more */
    CzStatus status;
    CzError error;
    char why[128];
} CzSearch;

/* Starts a search; `options` gives limit, stop flag and progress. Frees nothing of the function. */
void cz_search_init(CzSearch *search, const CzFunction *function, const CzOptimiseOptions *options);
void cz_search_free(CzSearch *search);

/* Evaluations left; 0 when the search is over or paused. */
long cz_search_left(const CzSearch *search);

/* Ends the search when the stop flag is up; whether nothing more may be evaluated now. */
bool cz_search_is_stopped(CzSearch *search);

/* Goes on after a pause, from the best design. */
void cz_search_resume(CzSearch *search);

/* Memory for n numbers of the search; without any the search ends, which it reports. */
double *cz_search_numbers(CzSearch *search, size_t n);

/* Evaluates n designs, x in the variables' units (n x n_variable), in order. objective (n) and
 * constraint (n x n_constraint) get finite numbers; constraints far above 0 are compressed
 * logarithmically, flags are -1. Returns false when the search ended before all were evaluated; the
 * outputs are then not set. */
bool cz_search_evaluate(CzSearch *search, const char *phase, int n, const double *x,
                        double *objective, double *constraint);

/* The same with the details as they are (n x cz_search_n_detail), uncompressed; the constraints
 * are in for a function that has none. */
bool cz_search_evaluate_details(CzSearch *search, const char *phase, int n, const double *x,
                                double *objective, double *constraint, double *detail);
int cz_search_n_detail(const CzSearch *search);

/* How a violation counts: itself up to a tenth, its logarithm beyond. */
double cz_search_compressed(double constraint);

/* A constraint that a fit names beside its matches as one more residual: it pulls from a little
 * below 0 on. */
double cz_search_residual(double constraint);

/* Scaled to natural variables: u in 0..1 is clamped. */
void cz_search_unscale(const CzSearch *search, const double *u, double *x);
void cz_search_scale(const CzSearch *search, const double *x, double *u);

/* Whether a record's scaled point, which is put into u (n_variable), lies apart from all chosen
 * ones (n_chosen x n_variable): by their root mean square distance. */
bool cz_search_is_apart(const CzSearch *search, long record, int n_chosen, const double *chosen,
                        double apart, double *u);

/* Variables of a record (n_variable). */
const double *cz_search_x(const CzSearch *search, long record);

/* Whether a record is better: what can be written down first, then by kept constraints and the
 * objective; else the penalty. */
bool cz_search_is_better(const CzSearch *search, long record, long other);

/* Record with exactly these variables, -1 when there is none. */
long cz_search_find(const CzSearch *search, const double *x);

/* Nearest design on the catalogue increments within the bounds. */
void cz_search_round(const CzSearch *search, const double *x, double *rounded);
bool cz_search_has_steps(const CzSearch *search);

#endif
