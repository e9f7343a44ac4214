/* Independent tasks on a few threads. Which thread takes which task is open, so a task writes only
 * into its own place. */
#ifndef CZ_EVALUATE_TASKS_H
#define CZ_EVALUATE_TASKS_H

/* One task; `index` counts from 0. */
typedef void (*CzTaskFunction)(int index, void *data);

/* Runs n_task tasks on at most n_job threads, this one among them, and returns when all are done.
 * Threads that cannot be started are done without. */
void cz_tasks_run(int n_task, int n_job, CzTaskFunction function, void *data);

/* Number of processors, at least 1. */
int cz_processor_count(void);

#endif
