/* Computing times of the scenarios of a problem. */
#ifndef CRUSHZONE_BENCHMARK_H
#define CRUSHZONE_BENCHMARK_H

#include <signal.h>

#include "crushzone/evaluate.h"

CZ_BEGIN_DECLARATIONS

/* Timed parts of a scenario. */
typedef enum CzTimed {
#define CZ_TIMED(constant, key, text, doc) constant,
#include "crushzone/timed.def"
#undef CZ_TIMED
    CZ_N_TIMED
} CzTimed;
CZ_API const char *cz_timed_key(CzTimed timed);  /* such as "batch" */
CZ_API const char *cz_timed_text(CzTimed timed); /* such as "run of a design in a batch of 8" */

enum { CZ_BENCHMARK_WIDTH = 8 }; /* designs of a batch */

typedef struct CzBenchmarkOptions {
    int n_round; /* number of alternating rounds; 5 by default */
    const volatile sig_atomic_t
        *stop; /* a flag that ends the computation when not 0; NULL when none */
    void (*progress)(int n_done, int n_all, void *data); /* rounds; NULL when none */
    void *progress_data;
} CzBenchmarkOptions;
CZ_API CzBenchmarkOptions cz_benchmark_options_default(void);

/* Processor time of one core. */
typedef struct CzTiming {
    double least, median; /* [s] */
    int n;
} CzTiming;

typedef struct CzScenarioTimes {
    const char *scenario; /* borrowed from the evaluator */
    int n_vehicle;
    long n_step;      /* of a run */
    double simulated; /* [s] */
    CzTiming time[CZ_N_TIMED];
} CzScenarioTimes;

/* Open result, owns its memory. */
typedef struct CzBenchmark {
    CzStatus status;   /* CZ_OK, or CZ_STATUS_RUN_FAILED when a run failed or is incomplete */
    char failure[320]; /* the first such scenario, and why; empty otherwise */
    int n_scenario;
    CzScenarioTimes *scenario; /* those that the evaluator runs (n_scenario) */
    double wall_s;
} CzBenchmark;

/* Times each scenario: set-up and runs as cz_evaluate makes them, on one thread. Statuses: CZ_OK,
 * CZ_STATUS_INTERRUPTED, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_benchmark(const CzEvaluator *evaluator,
                                           const CzBenchmarkOptions *options,
                                           CzBenchmark **benchmark, CzError *error);
CZ_API void cz_benchmark_free(CzBenchmark *benchmark);

CZ_END_DECLARATIONS
#endif
