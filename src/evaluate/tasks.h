/* Independent tasks, run by an executor in no fixed order: a task writes only to its own results.
 */
#ifndef CZ_EVALUATE_TASKS_H
#define CZ_EVALUATE_TASKS_H

#include "evaluate/study.h"

/* One task; `index` counts from 0. */
typedef CzStatus (*CzTaskFunction)(int index, void *data, CzError *error);

/* Runs n_task tasks and returns when all are done: the status and error of the first one that
 * failed, or those of the executor.
 */
CZ_MUST_CHECK CzStatus cz_tasks_run(const CzExecutor *executor, int n_task, CzTaskFunction function,
                                    void *data, CzError *error);

/* Tasks as plain data. */
typedef struct CzTaskData {
    CzStudy *study; /* of whose executor's workers run them */
    /* Appends what a worker needs for a task; false where it must be run here. */
    bool (*request)(int index, void *data, CzMemoryText *request);
    /* Keeps the results of a task. */
    CzStatus (*take)(int index, void *data, CzReading *answer, CzError *error);
} CzTaskData;

/* The same for tasks that workers may run. */
CZ_MUST_CHECK CzStatus cz_tasks_share(const CzTaskData *plain, int n_task, CzTaskFunction function,
                                      void *data, CzError *error);

/* The executor that is given, else n_job threads. */
CzExecutor cz_executor_choose(const CzExecutor *given, int n_job);

/* Cuts n tasks, such as "samples", into shards: equal runs of tasks, some of them one longer where
 * they differ. Status: CZ_STATUS_INPUT where there is no such shard. */
CZ_MUST_CHECK CzStatus cz_tasks_cut(int n, const char *what, int shard, int n_shard, int *begin,
                                    int *end, CzError *error);

/* Number of processors, at least 1. */
int cz_processor_count(void);

#endif
