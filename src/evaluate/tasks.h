/* Independent tasks on a few threads, in no fixed order: a task writes only to its own results. */
#ifndef CZ_EVALUATE_TASKS_H
#define CZ_EVALUATE_TASKS_H

#include "crushzone/status.h"

/* One task; `index` counts from 0. */
typedef CzStatus (*CzTaskFunction)(int index, void *data, CzError *error);

/* Runs n_task tasks on at most n_job threads, this one among them, and returns when all are done:
 * the status and error of the first one that failed. It uses fewer threads when some cannot be
 * started.
 */
CZ_MUST_CHECK CzStatus cz_tasks_run(int n_task, int n_job, CzTaskFunction function, void *data,
                                    CzError *error);

/* Number of processors, at least 1. */
int cz_processor_count(void);

#endif
