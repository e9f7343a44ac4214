/* crushzone: design of the crush zones of railway trains.
 *
 *   problem file --> CzProblem --> CzModel --> cz_simulate --> CzRun
 *                        |
 *                        +--> CzEvaluator --> cz_evaluate --> CzEvaluation
 *                                  |
 *                                  +--> cz_optimise --> CzOutcome --> report
 *                                  +--> cz_verify --> CzVerification (by other steps and solvers)
 *                                  |
 *                                  +--> cz_benchmark --> CzBenchmark (times)
 *                                  |
 *                                  +--> cz_explain --> CzExplanation --> report
 *
 *   problem file --> cz_sweep --> CzSweep (the same line for every value of a path) --> report
 *
 *   problem file --> cz_corridor --> CzCorridor (what a supplier may deliver) --> report
 *
 *   CzProblem --> cz_pareto --> CzPareto (a front of optima) --> report
 *
 *   CzProblem --> CzServer: requests of a design loop --> answers, lines of JSON
 *
 *   measured curve --> CzFit --> stages of a problem file
 *
 * SI units inside; compression positive, x forward, z up, pitch positive nose-up.
 */
#ifndef CRUSHZONE_CRUSHZONE_H
#define CRUSHZONE_CRUSHZONE_H

#include "crushzone/benchmark.h"
#include "crushzone/challenge.h"
#include "crushzone/channel.h"
#include "crushzone/corridor.h"
#include "crushzone/dakota.h"
#include "crushzone/evaluate.h"
#include "crushzone/executor.h"
#include "crushzone/explain.h"
#include "crushzone/fit.h"
#include "crushzone/model.h"
#include "crushzone/optimise.h"
#include "crushzone/pareto.h"
#include "crushzone/parts.h"
#include "crushzone/problem.h"
#include "crushzone/report.h"
#include "crushzone/simulate.h"
#include "crushzone/status.h"
#include "crushzone/sample.h"
#include "crushzone/shards.h"
#include "crushzone/serve.h"
#include "crushzone/sweep.h"
#include "crushzone/verify.h"

#endif
