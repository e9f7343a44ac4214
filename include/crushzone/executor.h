/* Executors: where the independent tasks of a study run.
 *
 * A study hands out batches of tasks, such as the runs of some designs, samples, or points of a
 * sweep. Results are kept by the number of their task and combined in that order, so that no
 * executor changes a bit of them.
 *
 * An executor may send tasks as plain data to workers in other processes of the same program:
 *
 *   this process   broadcast:                    message --> every worker: cz_worker_receive
 *                  submit, wait: cz_task_request request --> a worker:     cz_worker_answer
 *                                cz_task_take    answer  <--
 */
#ifndef CRUSHZONE_EXECUTOR_H
#define CRUSHZONE_EXECUTOR_H

#include <stdbool.h>
#include <stddef.h>

#include "crushzone/status.h"

CZ_BEGIN_DECLARATIONS

/* A batch of tasks, numbered from 0; they do not depend on one another. */
typedef struct CzTasks CzTasks;
CZ_API int cz_tasks_n(const CzTasks *tasks);

/* Runs one task in this thread; several threads may run tasks of a batch. A failure is kept in the
 * batch. */
CZ_API void cz_task_run(CzTasks *tasks, int task);

typedef struct CzBytes {
    size_t n;
    char *byte; /* (n) */
} CzBytes;
CZ_API void cz_bytes_free(CzBytes *bytes);

/* A task as plain data for a worker, to be freed; false for a task that only this process can run,
 * and without memory: then cz_task_run runs it. One thread at a time. */
CZ_API bool cz_task_request(CzTasks *tasks, int task, CzBytes *request);

/* Keeps the answer of a worker. One thread at a time. */
CZ_API void cz_task_take(CzTasks *tasks, int task, const CzBytes *answer);

typedef struct CzExecutor CzExecutor;
struct CzExecutor {
    int n_place; /* tasks that run side by side, at least 1: batches are made for this number */
    /* Begins a batch. Status: the executor's own failure, after which `wait` is not called. */
    CzStatus (*submit)(const CzExecutor *executor, CzTasks *tasks, CzError *error);
    /* Returns when every task of the batch was run once. Status: the executor's own failure. */
    CzStatus (*wait)(const CzExecutor *executor, CzTasks *tasks, CzError *error);
    /* Sends a message to all workers, which they receive before any later request; NULL
     * for an executor without workers. Status: the executor's own failure. */
    CzStatus (*broadcast)(const CzExecutor *executor, const CzBytes *message, CzError *error);
    void *data; /* the executor's own */
};

/* One task after another. */
CZ_API CzExecutor cz_executor_none(void);

/* Threads, the calling one among them; 0: one per processor. Fewer where some cannot be started. */
CZ_API CzExecutor cz_executor_threads(int n_thread);

/* ---- workers --------------------------------------------------------------------------------- */

/* What a worker knows: the studies that were sent to it. It needs no problem file, but the profiles
 * of limits and the measured histories that a problem names. */
typedef struct CzWorker CzWorker;

/* NULL without memory. */
CZ_API CzWorker *cz_worker_create(void);
CZ_API void cz_worker_free(CzWorker *worker);

/* Takes a message of `broadcast`. A study that cannot be made is reported by its answers. */
CZ_API void cz_worker_receive(CzWorker *worker, const CzBytes *message);

/* Runs the task of a request; the answer, to be freed, is its results or its failure. Status:
 * CZ_STATUS_NO_MEMORY when there is no answer. */
CZ_MUST_CHECK CZ_API CzStatus cz_worker_answer(CzWorker *worker, const CzBytes *request,
                                               CzBytes *answer);

CZ_END_DECLARATIONS
#endif
