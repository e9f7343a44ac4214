/* Functions of an evaluator that are not public: for the optimiser and for reports. */
#ifndef CZ_EVALUATE_EVALUATOR_H
#define CZ_EVALUATE_EVALUATOR_H

#include <signal.h>
#include <stdbool.h>

#include "crushzone/evaluate.h"
#include "problem/problem.h"

const CzProblem *cz_evaluator_problem(const CzEvaluator *evaluator);

/* How the runs of a design are computed. */
typedef struct CzManner {
    double step_factor; /* factor on every time step */
    CzIntegrator integrator;
    CzTrackUse track;
    bool brief; /* runs may end as soon as their results are final; not those of a fit */
} CzManner;

/* Evaluates one design with each of n other settings of the runs, at least one, all of them side by
 * side; the runs are kept without channels. x as in cz_evaluate, evaluation (n).
 */
CZ_MUST_CHECK CzStatus cz_evaluator_repeat(const CzEvaluator *evaluator, int n,
                                           const CzManner *manner, const double *x,
                                           CzEvaluation *evaluation, CzError *error);

/* Whether the parameters of the problem are fitted to measurements: the objective is a sum of
 * squares, and the last constraints are the matches. */
bool cz_evaluator_is_fit(const CzEvaluator *evaluator);

/* Treatment of a constraint in a search. */
typedef enum CzConstraintKind {
    CZ_CONSTRAINT_GRADED,
    CZ_CONSTRAINT_FLAG,      /* a yes or no, or a match, which the objective contains */
    CZ_CONSTRAINT_RULES,     /* a yes or no on all rules of files */
    CZ_CONSTRAINT_NAMED_RULE /* one of these rules, covered by the former kind */
} CzConstraintKind;
CzConstraintKind cz_evaluator_constraint_kind(const CzEvaluator *evaluator, int constraint);

/* Checks that every variable starts within its bounds, and that the start is valid in a problem
 * file. Statuses: CZ_OK, CZ_STATUS_INPUT with the place, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_evaluator_check_start(const CzEvaluator *evaluator, CzError *error);

/* Name of a variable whose value a scenario without reserves replaces, so that no design changes it
 * there; NULL for none. */
const char *cz_evaluator_fixed_by_change(const CzEvaluator *evaluator);

/* The problem with a design's values, as read from a file with them; freed by the caller before the
 * evaluator's problem. Statuses: CZ_OK, CZ_STATUS_INPUT for a design that breaks a rule,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_evaluator_read_design(const CzEvaluator *evaluator, const double *x,
                                                CzProblem **problem, CzError *error);

/* Combinations of the variables that choose, 1 without any; writes the choices of one combination
 * into a design x (n_variable) and leaves the other variables unchanged. */
int cz_evaluator_n_combination(const CzEvaluator *evaluator);
void cz_evaluator_set_combination(const CzEvaluator *evaluator, int combination, double *x);

/* Ends evaluations early, with CZ_STATUS_INTERRUPTED, when the flag is set; NULL: never. The flag
 * is borrowed. */
void cz_evaluator_set_stop(CzEvaluator *evaluator, const volatile sig_atomic_t *stop);

/* Names the checks of every evaluation, in their order; `name` and `scenario` have room for
 * cz_evaluator_n_check, `scenario` gets NULL for a check of the design. */
int cz_evaluator_n_check(const CzEvaluator *evaluator);
void cz_evaluator_name_checks(const CzEvaluator *evaluator, const char **name,
                              const char **scenario);

/* What a detail is. */
typedef enum CzDetailKind {
    CZ_DETAIL_OF_RUN,    /* a margin that a run decides, or a residual */
    CZ_DETAIL_OF_DESIGN, /* a margin of the design alone, such as a ratio of two of its forces */
    CZ_DETAIL_ACTIVATION /* the distance to an activation, which is not a margin */
} CzDetailKind;

/* Fills the kinds of all details (n_detail). */
void cz_evaluator_detail_kinds(const CzEvaluator *evaluator, CzDetailKind *kind);

/* As cz_evaluate without keeping runs, for a search: runs end as soon as their results are final,
 * and `detail` (n_point x n_detail) gets the details, NaN for designs that failed. */
CZ_MUST_CHECK CzStatus cz_evaluator_search(const CzEvaluator *evaluator, int n_point,
                                           const double *x, CzEvaluation *evaluation,
                                           double *detail, CzError *error);

/* Runs one design (n_variable) in one scenario, recorded, and keeps this run in its evaluation,
 * which has none, as number `run`: that of the scenario where all runs are kept. Only where
 * cz_evaluator_can_select. */
CZ_MUST_CHECK CzStatus cz_evaluator_record_run(const CzEvaluator *evaluator, const double *x,
                                               int run, CzEvaluation *evaluation, CzError *error);

/* Whether a metric of cz_evaluator_set_values, by its number, has a place in any scenario. */
bool cz_evaluator_has_metric(const CzEvaluator *evaluator, int wanted);

/* Finds the design x (n_variable) whose evaluation has the bits of a file with these settings
 * "path" = number: each names the only place of a variable within its bounds, and the step of the
 * runs and the equipment remain. False when there is none, and the file must be read with them. */
bool cz_evaluator_take_settings(const CzEvaluator *evaluator, int n, const char *const *path,
                                const double *number, double *x);

/* ---- some scenarios ---- */

/* Whether a search may run designs in some scenarios: not that of a fit, nor with the caller's
 * objective, which are given all runs. */
bool cz_evaluator_can_select(const CzEvaluator *evaluator);

int cz_evaluator_n_scenario(const CzEvaluator *evaluator);
const char *cz_evaluator_scenario_name(const CzEvaluator *evaluator, int scenario);

/* Whether a scenario is run at all. */
bool cz_evaluator_has_run_of(const CzEvaluator *evaluator, int scenario);

/* Scenario of a constraint, -1 for one of the design; name of its check; number of its details. */
int cz_evaluator_constraint_scenario(const CzEvaluator *evaluator, int constraint);
const char *cz_evaluator_constraint_check(const CzEvaluator *evaluator, int constraint);
int cz_evaluator_n_detail_of(const CzEvaluator *evaluator, int constraint);

/* As cz_evaluator_search, in some scenarios (n_scenario) only, and with the runs kept. The
 * constraints and details of the others are without meaning; the objective is that of these runs.
 */
CZ_MUST_CHECK CzStatus cz_evaluator_search_some(const CzEvaluator *evaluator, const bool *some,
                                                int n_point, const double *x,
                                                CzEvaluation *evaluation, double *detail,
                                                CzError *error);

/* Runs one design in the scenarios that are left, and replaces its evaluation by that in all. */
CZ_MUST_CHECK CzStatus cz_evaluator_search_remaining(const CzEvaluator *evaluator, const bool *some,
                                                     const double *x, CzEvaluation *evaluation,
                                                     double *detail, CzError *error);

#endif
