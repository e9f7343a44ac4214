/* Functions of an evaluator that are not public: for the optimiser and for reports. */
#ifndef CZ_EVALUATE_EVALUATOR_H
#define CZ_EVALUATE_EVALUATOR_H

#include <signal.h>

#include "crushzone/evaluate.h"
#include "problem/problem.h"

const CzProblem *cz_evaluator_problem(const CzEvaluator *evaluator);

/* How the runs of a design are made. */
typedef struct CzManner {
    double step_factor; /* factor on every time step */
    CzIntegrator integrator;
    CzTrackUse track;
    bool brief; /* runs may end once they have settled; not those of a fit */
} CzManner;

/* Evaluates one design in another manner, with its runs kept but no channels; x as in cz_evaluate.
 */
CZ_MUST_CHECK CzStatus cz_evaluator_again(const CzEvaluator *evaluator, const CzManner *manner,
                                          const double *x, CzEvaluation *evaluation,
                                          CzError *error);

/* Whether the parameters of the problem are fitted to measurements: the objective is a sum of
 * squares, and the last constraints are the matches. */
bool cz_evaluator_is_fit(const CzEvaluator *evaluator);

/* What a search makes of a constraint. */
typedef enum CzConstraintKind {
    CZ_CONSTRAINT_GRADED,
    CZ_CONSTRAINT_FLAG,      /* a yes or no, or a match, which the objective contains */
    CZ_CONSTRAINT_RULES,     /* a yes or no on all rules of files */
    CZ_CONSTRAINT_NAMED_RULE /* one of these rules, which the former covers */
} CzConstraintKind;
CzConstraintKind cz_evaluator_constraint_kind(const CzEvaluator *evaluator, int constraint);

/* Whether every variable starts within its bounds, and the search at a design that a file may hold.
 * Statuses: CZ_OK, CZ_STATUS_INPUT with the place, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_evaluator_check_start(const CzEvaluator *evaluator, CzError *error);

/* Combinations of the variables that choose, 1 without any; the numbers of one combination's
 * choices are written into a design x (n_variable), all else is left. */
int cz_evaluator_n_combination(const CzEvaluator *evaluator);
void cz_evaluator_set_combination(const CzEvaluator *evaluator, int combination, double *x);

/* Lets an evaluation end early, with CZ_STATUS_INTERRUPTED, once the flag is up; NULL: never. The
 * flag is borrowed. */
void cz_evaluator_set_stop(CzEvaluator *evaluator, const volatile sig_atomic_t *stop);

/* Details are constraints place by place: smooth where the worst of all places has breakpoints.
 * Those that are a yes or no have none. The details of a fit are its residuals, whose squares add
 * up to the objective. */
int cz_evaluator_n_detail(const CzEvaluator *evaluator);

/* As cz_evaluate without keeping runs, for a search: runs end once they have settled, and `detail`
 * (n_point x n_detail) gets the details, NaN for designs that failed. */
CZ_MUST_CHECK CzStatus cz_evaluator_search(const CzEvaluator *evaluator, int n_point,
                                           const double *x, CzEvaluation *evaluation,
                                           double *detail, CzError *error);

#endif
