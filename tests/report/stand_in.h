/* A problem, an evaluator and runs made by hand, so that a report can have any content. */
#ifndef CZ_TESTS_REPORT_STAND_IN_H
#define CZ_TESTS_REPORT_STAND_IN_H

#include "crushzone/report.h"

enum { STAND_IN_RUNS = 2, STAND_IN_CHECKS = 5, STAND_IN_VARIABLES = 2 };

struct CzRun {
    CzRunSummary summary;
    int n_sample;
    double channel[2][8]; /* t_ms and v_A1_m_s */
};

/* Everything a test may change before it writes a report. */
typedef struct StandIn {
    CzElementResult element;
    CzInterfaceResult interface[2];
    CzVehicleResult vehicle[2];
    CzEvent event[4];
    CzRun run[STAND_IN_RUNS];
    CzRun *runs[STAND_IN_RUNS];
    CzCheckResult check[STAND_IN_CHECKS], start_check[STAND_IN_CHECKS];
    double constraint[STAND_IN_CHECKS];
    CzEvaluation evaluation; /* one run, completed, one check fails */
    double start[STAND_IN_VARIABLES], best[STAND_IN_VARIABLES];
    bool at_bound[STAND_IN_VARIABLES];
    CzTrial trial[2];
    double trial_x[2 * STAND_IN_VARIABLES];
    CzOutcome outcome; /* feasible */
} StandIn;

/* The only problem and the only evaluator. */
extern const CzProblem *stand_in_problem;
extern const CzEvaluator *stand_in_evaluator;
extern const char *stand_in_file; /* result of cz_problem_file */

void stand_in_fill(StandIn *stand_in);

/* The run and the search, to be written. */
CzReport stand_in_run(const StandIn *stand_in);
CzReport stand_in_search(const StandIn *stand_in);

#endif
