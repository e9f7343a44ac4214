/* A design problem as numbers: variables in, objective and constraints out. */
#ifndef CRUSHZONE_EVALUATE_H
#define CRUSHZONE_EVALUATE_H

#include <stdbool.h>

#include "crushzone/executor.h"
#include "crushzone/simulate.h"

CZ_BEGIN_DECLARATIONS

/* A place in the problem file that a variable drives. */
typedef struct CzVariablePlace {
    const char *path; /* with its unit, as `set:` takes it, such as
                         trains.A.vehicles.A1.front.stages[0].force_kN; of a variable that chooses,
                         it ends in `use` and takes the name of the choice */
    double factor; /* the place's value, in its unit, per unit of the variable: 1 unless tied places
                      have other units */
    double drawn_stroke; /* of the anti-climber whose stroke it is, which a file with this stroke
                            has to name beside it; NaN for other numbers [m] */
} CzVariablePlace;

/* One design variable, or parameter of a fit. Texts and arrays are borrowed. */
typedef struct CzVariableInfo {
    const char *name;    /* path or given name */
    const char *unit;    /* as in the file, such as "kN" */
    double min, max;     /* in that unit */
    double start;        /* in that unit */
    double increment;    /* catalogue increment in that unit; 0 when none */
    int n_value;         /* sizes in which it is available, of a list; 0 when there is no list */
    const double *value; /* these sizes in that unit, the smallest first (n_value) */
    bool is_fixed;       /* its bounds contain one value only, as a single increment or min = max */
    double fixed_at;     /* that value, in that unit; 0 when it can vary */
    int n_choice; /* number of parts to choose from; the variable is then the index of a part, from
                     0. 0 for a numerical variable */
    const char *const *choice; /* their names (n_choice) */
    int n_place;
    CzVariablePlace *place; /* (n_place) */
} CzVariableInfo;

typedef enum CzVerdict {
    CZ_VERDICT_PASS,
    CZ_VERDICT_PROVISIONAL, /* passes a limit that is not confirmed */
    CZ_VERDICT_FAIL,
    CZ_VERDICT_NOT_CHECKED
} CzVerdict;
CZ_API const char *cz_verdict_text(CzVerdict verdict);
CZ_API bool cz_verdict_passes(CzVerdict verdict); /* a pass, provisional or not */
/* Whether it is a pass while n_not_covered requirements of the profile cannot be checked, and its
 * words, such as "pass (screening)". */
CZ_API bool cz_verdict_is_screening(CzVerdict verdict, int n_not_covered);
CZ_API const char *cz_verdict_words(CzVerdict verdict, int n_not_covered);

/* One check of one scenario. Texts are borrowed from the evaluator. */
typedef struct CzCheckResult {
    const char *name;
    const char *scenario;      /* "design" for a check of the design itself */
    const char *family;        /* family of scenarios that it belongs to; NULL for none */
    const char *metric;        /* kind of metric that it judges, such as "vehicles.flange_share";
                                  NULL of a match, and where it cannot be checked */
    char where[CZ_WHERE_SIZE]; /* place of the worst value */
    double when[2]; /* start and end of the time of the value [s]; NaN when that is not known, or
                       there is no value */
    double limit;   /* in `unit` */
    double value;   /* in `unit`; NaN when not checked or when it does not apply */
    const char *unit;
    double margin;   /* (limit - value) / max(|limit|, scale), sign turned for lower limits; NaN
                        for a yes or no, and when not checked or when it does not apply */
    bool is_minimum; /* the limit is a lower one */
    bool is_flag;    /* a yes or no */
    bool is_omitted; /* its scenario was left out by CzEvaluatorOptions.scenario, so it is not
                        checked */
    bool has_no_run; /* not checked because its scenario was left out, failed or is incomplete */
    bool beyond_validity; /* its run went beyond the model's validity: the value may be of the time
                             after that, and a total is NaN */
    CzVerdict verdict;
    const char *why; /* why it was not checked, or does not apply, or that its run went beyond the
                        model's validity; NULL otherwise */
    const char *profile, *clause, *source, *confidence; /* NULL when none */
} CzCheckResult;

/* Residual of a run against one measured value or time history. Texts are borrowed from the
 * evaluator.
 */
typedef struct CzMatchResult {
    const char *name;
    const char *scenario;
    char where[CZ_WHERE_SIZE]; /* place of the metric or event, or the channel */
    const char *unit;          /* of target, value and tolerance */
    double target;             /* measured value; 0 for a time history */
    double value; /* of the run, or its root mean square difference from a time history; NaN when
                     the run does not show it */
    double tolerance; /* largest acceptable difference */
    double weight;    /* of the square of its residual in the objective */
    double residual;  /* (value - target) / tolerance; at least 10 when the run does not show it */
    bool is_history;
} CzMatchResult;

/* Value of a metric that the caller asked for, over all scenarios that were run. Texts are borrowed
 * from the evaluator. */
typedef struct CzValueResult {
    const char *metric;
    const char *unit;
    double
        value; /* the largest, of a metric that ends in .min the smallest one, in `unit`; NaN when
                  it is not known, does not apply or is a total beyond the model's validity */
    char where[CZ_WHERE_SIZE];
    const char *scenario; /* NULL without a value */
} CzValueResult;

/* A train that limits do not judge. Texts are borrowed from the evaluator. */
typedef struct CzNotJudged {
    const char *train, *why;
    bool is_inferred; /* it has no role and is regarded as an obstacle by its properties */
} CzNotJudged;

/* Results of one design. Arrays are borrowed from the evaluation and freed with it. */
typedef struct CzEvaluation {
    CzStatus status;   /* CZ_OK, or CZ_STATUS_RUN_FAILED when a scenario failed or is incomplete */
    char failure[512]; /* the first such scenario, and why; empty otherwise */
    double objective;  /* in the objective's unit; NaN when failed, or not known */
    int n_constraint;
    double *constraint; /* -(margin - required margin): at most 0 when kept; NaN when failed
                           (n_constraint) */
    CzCheckResult *constraint_check; /* the check behind each constraint: a check, a target of the
                                        optimiser, or a match, whose limit is the measured value and
                                        whose margin is 1 - |residual| (n_constraint) */
    double violation; /* largest positive constraint, 0 when feasible, infinite when failed */
    int n_check;
    CzCheckResult *check; /* the matches of a fit last (n_check) */
    CzVerdict verdict;    /* over all checks: cz_verdict_over */
    bool beyond_validity; /* a vehicle climbed in a run */
    int n_not_covered; /* requirements of the profile that this program cannot check: a pass is then
                          one by screening (cz_verdict_is_screening) */
    const char *const *not_covered; /* borrowed from the evaluator (n_not_covered) */
    int n_not_applicable; /* scenarios of the profile that do not apply, each with the reason */
    const char *const *not_applicable; /* borrowed from the evaluator (n_not_applicable) */
    int n_changed_scenario; /* scenarios of the profile that the problem replaces or changes */
    const char *const *changed_scenario; /* borrowed from the evaluator (n_changed_scenario) */
    int n_not_judged;
    const CzNotJudged *not_judged; /* obstacles, borrowed from the evaluator (n_not_judged) */
    int n_match;                   /* the last constraints belong to them */
    CzMatchResult *match;          /* of a fit (n_match) */
    int n_value;
    CzValueResult *value; /* as cz_evaluator_set_values lists them (n_value) */
    int n_run;
    CzRun **run; /* one per scenario when requested, else NULL */
} CzEvaluation;
CZ_API void cz_evaluation_free(CzEvaluation *evaluation);

/* The verdict over the checks with these names, over all of them when n_name is 0: FAIL when one
 * fails or an override occurred; else NOT CHECKED when a run failed or is incomplete, a check could
 * not be made, or there is no check; else PROVISIONAL when one satisfies a limit that is not
 * confirmed; else a pass. */
CZ_API CzVerdict cz_verdict_over(const CzEvaluation *evaluation, int n_name,
                                 const char *const *name);

/* The same over the checks of a scenario or family, or of the "design". */
CZ_API CzVerdict cz_verdict_in(const CzEvaluation *evaluation, const char *scenario);

/* Whether a check is worse than another: fails by margin come first, then failed yes-or-no checks,
 * checks that were not made, passes by margin, checks that do not apply. */
CZ_API bool cz_check_is_worse(const CzCheckResult *check, const CzCheckResult *other);

/* Objective and constraints of a search in place of those of the file. Texts are borrowed. */
typedef struct CzAim {
    const char *minimise; /* a metric; NULL: the smallest margin is maximised */
    double margin;        /* required of every constraint, at least that of the file; NaN: that */
    const char *bounded;  /* a metric with a further upper limit; NULL when none */
    double bound;         /* that limit, in the metric's unit */
} CzAim;

typedef struct CzEvaluator CzEvaluator;

typedef struct CzEvaluatorOptions {
    int n_job;                  /* threads; 0: one per processor */
    const CzExecutor *executor; /* where its tasks run; NULL: in n_job threads */
    double step_factor;         /* factor on every time step; 1 for production runs */
    CzIntegrator integrator;    /* CZ_INTEGRATOR_ZHAI for production runs */
    const char *scenario; /* only this scenario or family; NULL for all. Checks of the others are
                             then NOT CHECKED */
    int first_scenario;   /* scenarios before this one, counted from 0, are left out likewise */
    const CzAim *aim;     /* NULL: objective and constraints of the file */
    const CzEvaluator *beside; /* its tracks are used where they are the same, which saves their
                                  set-up; it must live longer; NULL for none */
} CzEvaluatorOptions;
CZ_API CzEvaluatorOptions cz_evaluator_options_default(void);

/* The problem must outlive the evaluator. A problem without `optimise:` has no variables and can
 * still be checked. Statuses: CZ_OK, CZ_STATUS_INPUT, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_evaluator_build(const CzProblem *problem,
                                                 const CzEvaluatorOptions *options,
                                                 CzEvaluator **evaluator, CzError *error);
CZ_API void cz_evaluator_free(CzEvaluator *evaluator);

/* A step of the force ladder that is out of order in a train as written. */
typedef struct CzForceStep {
    char where[CZ_WHERE_SIZE]; /* "A4 front" */
    const char *what;          /* "the tube over the shear-off" */
    double ratio;              /* of the two forces, above 1 */
} CzForceStep;

/* Lists up to `most` of them, each at the first of equal ends; returns their number. */
CZ_API int cz_evaluator_force_order(const CzEvaluator *evaluator, int most, CzForceStep *step);

CZ_API int cz_evaluator_n_variable(const CzEvaluator *evaluator);
CZ_API const CzVariableInfo *cz_evaluator_variable(const CzEvaluator *evaluator, int variable);

CZ_API int cz_evaluator_n_constraint(const CzEvaluator *evaluator);
CZ_API const char *cz_evaluator_constraint_name(const CzEvaluator *evaluator, int constraint);

/* Details are constraints place by place: they are smooth where the worst of all places has
 * breakpoints. A yes or no has none. The details of a fit are its residuals, whose squares add up
 * to the objective. */
CZ_API int cz_evaluator_n_detail(const CzEvaluator *evaluator);

CZ_API const char *cz_evaluator_objective_name(const CzEvaluator *evaluator);
/* Whether the objective is the smallest margin with its sign reversed, so that it is minimised: the
 * largest constraint up to a constant. */
CZ_API bool cz_evaluator_maximises_margin(const CzEvaluator *evaluator);
CZ_API const char *cz_evaluator_objective_unit(const CzEvaluator *evaluator);

/* Evaluates n_point designs side by side; x is (n_point x n_variable) in the variables' units, NULL
 * for the file's own values. `evaluation` is (n_point), filled by the call, each to be freed by the
 * caller. The result of a design depends neither on its neighbours nor on the number of threads.
 * `keep_runs` records channels and keeps the runs. */
CZ_MUST_CHECK CZ_API CzStatus cz_evaluate(CzEvaluator *evaluator, int n_point, const double *x,
                                          bool keep_runs, CzEvaluation *evaluation, CzError *error);

/* Replaces the objective by one of the caller's own; called for each design with all its run
 * summaries (n_scenario). */
typedef double (*CzObjective)(int n_scenario, const CzRunSummary *const *summary, void *data);
CZ_API void cz_evaluator_set_objective(CzEvaluator *evaluator, const char *name, const char *unit,
                                       CzObjective objective, void *data);

/* Further metrics of every later evaluation, such as "interfaces.A4-B1.peak_force_kN", with
 * "@SCENARIO" behind it of this scenario or family; none with n_metric 0. Statuses: CZ_OK,
 * CZ_STATUS_INPUT with the nearest name as help, and then there are none; CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_evaluator_set_values(CzEvaluator *evaluator, int n_metric,
                                                      const char *const *metric, CzError *error);

/* The only scenarios or families of every later evaluation; all of the evaluator with n_scenario 0.
 * Checks of the others are then NOT CHECKED. Statuses: CZ_OK, CZ_STATUS_INPUT with the nearest name
 * as help, and then all are run. */
CZ_MUST_CHECK CZ_API CzStatus cz_evaluator_set_scenarios(CzEvaluator *evaluator, int n_scenario,
                                                         const char *const *scenario,
                                                         CzError *error);

CZ_END_DECLARATIONS
#endif
