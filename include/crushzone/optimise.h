/* Search for a design that passes, with the algorithms of NLopt and a strategy of our own. */
#ifndef CRUSHZONE_OPTIMISE_H
#define CRUSHZONE_OPTIMISE_H

#include <signal.h>
#include <stddef.h>

#include "crushzone/verify.h"

CZ_BEGIN_DECLARATIONS

typedef enum CzOutcomeStatus {
    CZ_OUTCOME_FEASIBLE,
    CZ_OUTCOME_UNVERIFIED, /* designs satisfy every constraint, but none that was tried is verified
                            */
    CZ_OUTCOME_INFEASIBLE,
    CZ_OUTCOME_INTERRUPTED
} CzOutcomeStatus;
CZ_API const char *cz_outcome_text(CzOutcomeStatus status);

/* Argument of a progress callback after each evaluation. */
typedef struct CzProgress {
    long n_evaluation, most_evaluations;
    bool feasible;          /* whether the incumbent is */
    double best_objective;  /* of the incumbent */
    double best_violation;  /* of the incumbent */
    bool best_fails_a_flag; /* it fails only a yes-or-no check, which has no margin */
    const char *phase;      /* such as "screen", "descend", "polish" */
} CzProgress;

/* One evaluation as a search received it. With all of them a search is repeated without a run.
 * Arrays are borrowed; their values are NaN when the design failed. */
typedef struct CzAnswer {
    const double *x;            /* in the variables' units (n_variable) */
    double objective;           /* in its unit */
    int n_constraint, n_detail; /* more of them in later rounds of a robust search */
    const double *constraint;   /* as in CzEvaluation (n_constraint) */
    const double *detail;       /* constraints place by place (n_detail) */
} CzAnswer;

/* Evaluations that a search made side by side, in order. */
typedef struct CzNews {
    const char *phase;
    int n;
    const CzAnswer *answer;         /* (n) */
    const CzEvaluation *evaluation; /* without runs (n) */
    long n_evaluation;              /* of the search so far, with these */
    const double *best; /* the best design so far that a file may contain, in the variables' units,
                           when the last news did not have it; else NULL (n_variable) */
    double best_violation;
} CzNews;

/* Earlier evaluations of a search, and what keeps further ones. A search with the same problem,
 * algorithm, seed and limit asks for the same designs in the same order; with a higher limit it may
 * ask for others. */
typedef struct CzJournal {
    long n_answer;
    const CzAnswer *answer; /* (n_answer) */
    long n_earlier; /* the first of them are of a search with a lower limit: they answer the same
                       designs in any order. The others answer in order; a search that asks for
                       another design ends with CZ_STATUS_INPUT */
    CzStatus (*keep)(const CzNews *news, void *data,
                     CzError *error); /* called before the next evaluation begins; a failure ends
                                         the search with its status. NULL: none */
    void *keep_data;
} CzJournal;

enum { CZ_USUAL_WIDTH = 8, CZ_MAX_WIDTH = 1024 }; /* of searches */

typedef struct CzOptimiseOptions {
    const char *algorithm; /* "auto" or an NLopt name such as "LN_COBYLA"; NULL: that of the file */
    long evaluations;      /* largest number of evaluations; 0: that of the file */
    long seed;             /* -1 takes the file's */
    int width; /* designs that the default strategy asks for at once where it can: steps of
                  several lengths, points that fill the box; 0: CZ_USUAL_WIDTH. The results
                  depend on it, and not on the number of threads or ranks */
    const double *start;     /* design at which the search begins, in the variables' units; NULL:
                                that of the file (n_variable) */
    unsigned verify_methods; /* methods of verification of a design that passes, as in
                                CzVerifyOptions; by default all but Adams, 0 for none */
    bool no_sensitivities;   /* they, and the condition of an optimum, are left out */
    const volatile sig_atomic_t *stop; /* a flag that ends the search when not 0; NULL when none */
    void (*progress)(const CzProgress *progress, void *data); /* NULL when none */
    void *progress_data;
    const CzJournal *journal; /* NULL when none */
} CzOptimiseOptions;
CZ_API CzOptimiseOptions cz_optimise_options_default(void);

/* One evaluation of the search. */
typedef struct CzTrial {
    double objective, violation;
    bool feasible;
    const char *phase;
} CzTrial;

/* A limit, or a bound of a variable, that keeps the objective from a better value: a multiplier of
 * the condition of an optimum, positive. */
typedef struct CzMultiplier {
    int constraint; /* -1 for a bound */
    int variable;   /* -1 for a limit */
    double worth;   /* improvement of the objective, in its unit, by a margin that is larger by 0.01
                       or a bound that is further away by 1 unit of the variable */
} CzMultiplier;

/* A margin of the best design, where the smallest one is maximised. */
typedef struct CzOrderedMargin {
    int constraint;
    double margin;
    bool is_capped; /* no variable raises it within its bounds */
} CzOrderedMargin;

/* The smallest relaxation of one limit with which a design passes. */
typedef struct CzRelaxation {
    int constraint;
    double violation;  /* of the present limit by that design, as a margin */
    double limit;      /* with which it passes, in the unit of the constraint */
    double *x;         /* the design, in the variables' units; NULL when none is known
                          (n_variable) */
    long n_evaluation; /* designs that were evaluated for it after the search */
} CzRelaxation;

/* A design that satisfies every constraint and is better than the result, but is not verified. */
typedef struct CzRejected {
    const double *x; /* in the variables' units (n_variable) */
    double objective;
    CzVerifyMethod method; /* by which it is refused, with the largest change */
    CzVerifiedValue value; /* that changes most, one that changes its verdict first; without a name
                              when a run failed */
    char failure[320];     /* of a run; empty otherwise */
} CzRejected;

/* Runs of a search in one scenario. */
typedef struct CzScenarioUse {
    const char *name; /* borrowed from the evaluator */
    long n_run;       /* designs of the search that were run in it */
    bool is_in_set;   /* it is in the working set at the end */
} CzScenarioUse;

/* Open result, owns its memory. The start and best evaluations were made from scratch after the
 * search. */
typedef struct CzOutcome {
    CzOutcomeStatus status;
    char why_stopped[160];
    long n_evaluation;
    int width; /* of the search; 0 when not known */
    int n_variable;
    double *start,
        *best; /* in the variables' units; best is on the catalogue increments unless the search
                  ended earlier or only designs between them pass (see why_stopped) (n_variable) */
    bool *at_bound;                /* (n_variable) */
    CzEvaluation best_evaluation;  /* with runs kept */
    CzEvaluation start_evaluation; /* with the run that decides `best_evaluation`, at the same
                                      place; with all runs in a fit and with an own objective */
    int n_alternative;             /* of a fit: further parameter sets that fit about as well */
    double *alternative; /* in the variables' units, best first (n_alternative x n_variable) */
    double *alternative_objective; /* (n_alternative) */
    CzVerification *verification;  /* of the best design; NULL when it does not pass or the search
                                      was interrupted */
    int n_rejected;
    CzRejected *rejected;    /* better designs that were not verified, in the order of their trial
                                (n_rejected) */
    long n_whole;            /* designs of the search that were run in all scenarios */
    int n_scenario;          /* 0 when every design was run in all scenarios */
    CzScenarioUse *scenario; /* (n_scenario) */
    bool is_cut_short; /* the search ended by itself, but the stop flag left out what follows it:
                          the relaxation of a limit or the sensitivities */
    double *sensitivity_increment; /* tried change of one variable at the best design, in its unit:
                                      negative at the upper bound, 0 when none was tried; NULL after
                                      an interruption (n_variable) */
    double *objective_change;      /* of the objective by each; NaN when not known (n_variable) */
    double *constraint_change;     /* likewise of each constraint (n_variable x n_constraint) */
    double stationarity; /* the part of the objective's slope that no active limit or bound
                            explains, 0 at an optimum, at most 1; of the largest violation when the
                            best design violates a constraint */
    int n_multiplier;
    CzMultiplier *multiplier; /* limits before bounds, largest first; NULL when the condition is not
                                 known (n_multiplier) */
    CzRelaxation relaxation;  /* when no design passes */
    int n_margin;            /* of the smallest margins, at most 8; 0 when they are not maximised */
    CzOrderedMargin *margin; /* smallest first; with the first ones that are capped the next one is
                                maximised (n_margin) */
    long n_trial;
    CzTrial *trial;  /* history in order (n_trial) */
    double *trial_x; /* its designs, in the variables' units (n_trial x n_variable) */
    double wall_s;
} CzOutcome;

/* Statuses: CZ_OK (look at outcome->status), CZ_STATUS_INPUT for an unknown algorithm or no
 * variables, CZ_STATUS_RUN_FAILED when the search ended before any design had a successful run,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_optimise(CzEvaluator *evaluator, const CzOptimiseOptions *options,
                                          CzOutcome **outcome, CzError *error);

/* The record of a search. Arrays are borrowed. */
typedef struct CzRecall {
    CzOutcomeStatus status;
    const char *why_stopped;
    const double *start; /* in the variables' units (n_variable) */
    long n_trial;
    const CzTrial *trial;  /* (n_trial) */
    const double *trial_x; /* (n_trial x n_variable) */
} CzRecall;

/* The outcome of an earlier search: the evaluator's start is its best design. Both are
 * evaluated and verified again, with new sensitivities. Statuses as above. */
CZ_MUST_CHECK CZ_API CzStatus cz_outcome_recall(CzEvaluator *evaluator, const CzRecall *recall,
                                                CzOutcome **outcome, CzError *error);

/* Refuses what cz_optimise would refuse, without a search. Statuses: CZ_OK, CZ_STATUS_INPUT. */
CZ_MUST_CHECK CZ_API CzStatus cz_optimise_check(const CzEvaluator *evaluator,
                                                const CzOptimiseOptions *options, CzError *error);

/* The same; replaces default values of algorithm, evaluations and seed by those of the file. */
CZ_MUST_CHECK CZ_API CzStatus cz_optimise_fill_defaults(const CzEvaluator *evaluator,
                                                        CzOptimiseOptions *options, CzError *error);

CZ_API void cz_outcome_free(CzOutcome *outcome);

/* NLopt algorithms that this build can run, by name. */
CZ_API int cz_n_algorithm(void);
CZ_API const char *cz_algorithm_name(int index);

/* Version of the NLopt library in use, such as "2.7.1". Writes at most n bytes. */
CZ_API void cz_nlopt_version(char *text, size_t n);

CZ_END_DECLARATIONS
#endif
