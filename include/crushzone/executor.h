/* Executors: where the independent tasks of a study run.
 *
 * A study hands out batches of tasks, such as the runs of some designs, samples, or points of a
 * sweep. Results are kept by the number of their task and combined in that order, so that no
 * executor changes a bit of them.
 */
#ifndef CRUSHZONE_EXECUTOR_H
#define CRUSHZONE_EXECUTOR_H

#include "crushzone/status.h"

CZ_BEGIN_DECLARATIONS

/* A batch of tasks, numbered from 0; they do not depend on one another. */
typedef struct CzTasks CzTasks;
CZ_API int cz_tasks_n(const CzTasks *tasks);

/* Runs one task in this thread; several threads may run tasks of a batch. A failure is kept in the
 * batch. */
CZ_API void cz_task_run(CzTasks *tasks, int task);

typedef struct CzExecutor CzExecutor;
struct CzExecutor {
    int n_place; /* tasks that run side by side, at least 1: batches are made for this number */
    /* Begins a batch. Status: the executor's own failure, after which `wait` is not called. */
    CzStatus (*submit)(const CzExecutor *executor, CzTasks *tasks, CzError *error);
    /* Returns when every task of the batch was run once. Status: the executor's own failure. */
    CzStatus (*wait)(const CzExecutor *executor, CzTasks *tasks, CzError *error);
    void *data; /* the executor's own */
};

/* One task after another. */
CZ_API CzExecutor cz_executor_none(void);

/* Threads, the calling one among them; 0: one per processor. Fewer where some cannot be started. */
CZ_API CzExecutor cz_executor_threads(int n_thread);

CZ_END_DECLARATIONS
#endif
